"""Orbits about a point mass or a body with zonal harmonics; transfers. Any consistent units."""
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from . import _core
from ._failure import Failure
from ._text import each, rows_of

EARTH_MU: float = _core.EARTH_MU  # m^3/s^2, WGS 84


class Orbits(NamedTuple):
    """Propagated orbits; for a single state without the first axis."""

    t: np.ndarray  # times of the rows, (rows,); without `every` the time that each orbit reached, (n,)
    x: np.ndarray  # x, y, z, vx, vy, vz: (n, rows, 6); without `every` the last state, (n, 6)
    status: list[str]  # "success", "low_accuracy" (less than six digits), or the outcome of a failure
    sentence: list[str]  # what is wrong; "" after success
    stm: np.ndarray | None  # d x[..., i]/d(initial state)[j] as [..., i, j], (n, rows, 6, 6) or (n, 6, 6); None without stm=True


class Transfer(NamedTuple):
    """Arcs of Lambert's problem; for a single pair without the first axis."""

    v1: np.ndarray  # velocity at the departure, (n, 3)
    v2: np.ndarray  # velocity at the arrival, (n, 3)
    miss: np.ndarray  # distance from the arrival if v1 is propagated by another method, (n,)
    status: list[str]  # "success", or the outcome of a failure
    sentence: list[str]  # why it failed; "" after success


class Porkchop(NamedTuple):
    """Best transfers by departure (rows) and arrival (columns); nan and -1 where there is none."""

    departures: np.ndarray
    arrivals: np.ndarray
    v_departure: np.ndarray  # speed relative to the departure body
    v_arrival: np.ndarray  # speed relative to the arrival body
    revolutions: np.ndarray  # whole revolutions


def _positive(name: str, value: float) -> float:
    if not (value > 0 and math.isfinite(value)):
        raise ValueError(f"{name} {value}: must be positive and finite")
    return float(value)


def _field(zonal: Sequence[float], radius: float | None) -> tuple[float, list[float]]:
    if bool(len(zonal)) != (radius is not None):
        raise ValueError("zonal J2, J3, ... and radius: give both or neither")
    return (1.0 if radius is None else _positive("radius", radius)), [float(j) for j in zonal]


def _texts(count: int, faults: dict[int, tuple[str, str]]) -> tuple[list[str], list[str]]:
    """Statuses and sentences of so many orbits."""
    status, sentence = ["success"] * count, [""] * count
    for i, (outcome, why) in faults.items():
        status[i], sentence[i] = outcome, why
    return status, sentence


def propagate(states, until, *, mu=None, zonal: Sequence[float] = (), radius: float | None = None, every: float | None = None,
              stm: bool = False, tolerance: float = 1e-15, threads: int = 0, limit: float = math.inf, verify: bool = True,
              progress: Callable[[float], object] | None = None) -> Orbits:
    """Propagates orbits from t = 0: propagate([7e6, 0, 0, 0, 4700, 5900], until=86400).

    states: x, y, z, vx, vy, vz, shape (6,) or (n, 6). until: end time of either sign, one or n numbers.
    mu: gravitational parameter, one or n numbers (default the Earth's, in metres and seconds).
    zonal, radius: coefficients J2 to J6, the axis along z, and their reference radius.
    every: time between rows (default: only the last state); then `until` is one number.
    stm: add state-transition matrices, in closed form about a point mass, with zonal terms by Taylor series; orbits then run one by
        one, with the bits of `--stm`. After a failure about a point mass the last one is 1.
    tolerance: of a step, relative, from 1e-18 to 0.1. threads: 0: one for each processor. limit: wall time of all orbits, s.
    verify: compare states about a point mass with Kepler's solution, which takes about a microsecond for each.
    progress: called with the share of the orbits that is done, about every 50 ms.
    Same bits as `two_body_series propagate --states`. A single orbit that fails raises Failure with its Orbits as `partial`; of
    many, each has a status, and the last row of a failed one is its last good state.
    """
    x0, single = rows_of("states", states, 6)
    if not x0[:, :3].any(axis=1).all():
        raise ValueError("states: a position is 0, the centre of attraction")
    n = len(x0)
    ends, times = each("until", until, n), np.empty(0)
    if every is not None:
        span, every = abs(float(until)), _positive("every", every)
        if not span / every <= 1e7:
            raise ValueError(f"every {every}: more than 10 million rows")
        inner = every * np.arange(1, span / every + 1)
        inner = inner[span - inner > 1e-9 * every]  # rounding adds no row next to the end
        times = np.concatenate([[0.0] if span else [], np.copysign(inner, until), [float(until)]])
    mus = np.full(n, np.nan) if mu is None else each("mu", mu, n)
    if mu is not None and not np.all((mus > 0) & np.isfinite(mus)):
        raise ValueError(f"mu {mu}: must be positive and finite")
    x, reached, phi, faults = _core.propagate(x0, ends, mus, _field(zonal, radius), every or math.inf, times, tolerance, threads,
                                              float(limit), verify, stm, progress)
    status, sentence = _texts(n, faults)
    shape = (n,) if every is None else (n, len(times))
    x, phi = x.reshape(*shape, 6), phi.reshape(*shape, 6, 6) if stm else None
    if not single:
        return Orbits(reached if every is None else times, x, status, sentence, phi)
    found = Orbits(reached[0] if every is None else times, x[0], status, sentence, phi[0] if stm else None)
    if status[0] not in ("success", "low_accuracy"):
        raise Failure(sentence[0], status[0], found)
    return found


def lambert(r1, r2, time, *, mu: float = EARTH_MU, long_way: bool = False, revolutions: int = 0, branch: str | None = None,
            normal: Sequence[float] | None = None, zonal: Sequence[float] = (), radius: float | None = None,
            threads: int = 0) -> Transfer:
    """Solves Lambert's problem: the orbit from r1 to r2 in a given time.

    r1, r2: positions from the centre, shape (3,) or (n, 3). time: time of flight, positive, one or n numbers.
    long_way: by more than 180 degrees. revolutions: whole ones before the arrival; then branch "low" or "high", by the
    semi-major axis. normal: of the plane, for opposite positions. zonal, radius: as for propagate().
    Same bits as `rbf_inverse lambert`. A single arc that fails raises Failure; of many, each has a status.
    """
    start, single = rows_of("r1", r1, 3)
    end, _ = rows_of("r2", r2, 3)
    if start.shape != end.shape:
        raise ValueError(f"r1 and r2: shapes {start.shape} and {end.shape} differ")
    if (revolutions > 0) != (branch is not None) or branch not in (None, "low", "high"):
        raise ValueError(f'revolutions {revolutions}, branch {branch}: branch "low" or "high" is for one revolution or more')
    *found, faults = _core.lambert(start, end, each("time", time, len(start)), _positive("mu", mu), _field(zonal, radius), long_way,
                                   revolutions, branch == "high", normal, threads)
    status, sentence = _texts(len(start), faults)
    if not single:
        return Transfer(*found, status, sentence)
    if faults:
        raise Failure(sentence[0], status[0])
    return Transfer(*(array[0] for array in found), status, sentence)


def porkchop(departure, arrival, departures: tuple[float, float, int], arrivals: tuple[float, float, int], *, mu: float,
             epochs: tuple[float, float] = (0.0, 0.0), revolutions: int = 0, threads: int = 0) -> Porkchop:
    """Speeds of the best transfers between two orbits on a grid of times.

    departure, arrival: states x, y, z, vx, vy, vz of the two bodies at their `epochs`. departures, arrivals: first time, last
    time and number of times. mu: of the centre. revolutions: largest number of whole ones. Same bits as `rbf_inverse porkchop`.
    """
    bodies = (rows_of("departure", departure, 6)[0][0], rows_of("arrival", arrival, 6)[0][0])
    return Porkchop(*map(np.asarray, _core.porkchop(bodies, tuple(map(float, epochs)), _positive("mu", mu), departures, arrivals,
                                                    revolutions, threads)))
