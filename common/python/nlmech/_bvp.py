"""Boundary value problems as typed."""
from __future__ import annotations

import os
from collections.abc import Mapping

import numpy as np

from . import _core
from ._text import Number, file_of, text_of


class BoundarySolution:
    """A solution of bvp(), verified by integration.

    t: times of the nodes, shape (m,). names: names of the components, unknown constants among them.
    x: values, shape (components, m). `solution["x"]` is one of them. residual: largest residual between the nodes, relative.
    `solution(t)` evaluates it at other times, with the accuracy of the nodes.
    """

    def __init__(self, solved: _core.Solved):
        self._solved = solved
        self.t: np.ndarray = np.array(solved.times)
        self.names: tuple[str, ...] = tuple(solved.names)
        self.x: np.ndarray = solved.at(self.t)
        self.residual: float = solved.residual

    def __getitem__(self, name: str) -> np.ndarray:
        """The values of a component at `t`."""
        if name not in self.names:
            raise KeyError(f"there is no component {name}; the components are {', '.join(self.names)}")
        return self.x[self.names.index(name)]

    def __call__(self, t) -> dict[str, np.ndarray]:
        """Each component at times within the interval, in the shape of t."""
        t = np.asarray(t, dtype=float)
        if t.size and not (self.t[0] <= t.min() and t.max() <= self.t[-1]):
            raise ValueError(f"t: {t.min()} to {t.max()} is not within the interval, from {self.t[0]} to {self.t[-1]}")
        return {name: row.reshape(t.shape) for name, row in zip(self.names, self._solved.at(t.ravel()))}

    def __repr__(self) -> str:
        return f"<BoundarySolution: {', '.join(self.names)} from {self.t[0]:g} to {self.t[-1]:g}>"


def bvp(equation: str | None = None, conditions: str = "", *, unknown: str = "", start: Number | None = None,
        until: Number | None = None, guess: str | Mapping[str, np.ndarray] | BoundarySolution = "", starts: int | None = None,
        from_parameter: tuple[str, float, float] | None = None, tolerance: float = 1e-9, set: Mapping[str, float] | None = None,
        file: str | os.PathLike | None = None) -> BoundarySolution | list[BoundarySolution]:
    """Solves a boundary value problem: bvp("x'' + exp(x) = 0", "x(0) = 0; x(1) = 0").

    Arguments are the options of `rbf_inverse bvp`; the same bits at its nodes.
    equation: equations, definitions and conditions, separated by ";"; or `file`. conditions: further ones.
    unknown: names of unknown constants, separated by commas. start, until: the interval (default: that of the conditions);
        the end may be the name of an unknown constant, or "inf".
    guess: functions of t, "x = sin(pi t), k = 10"; or arrays {"t": ..., "x": ...}; or another solution, to follow it in a
        parameter. Default: zeros, then random cubics.
    starts: solve from so many starts; the result is then a list of all different solutions.
    from_parameter: follow the solution in a parameter from one value to another, through folds: ("eps", 1, 1e-4).
    tolerance: of the residual x' - f, relative, from 1e-13 to 0.1. set: values of parameters.
    Raises Failure if there is no solution from these starts, ValueError for wrong arguments. Ctrl-C takes effect at the end.
    """
    if not 1e-13 <= tolerance <= 0.1:
        raise ValueError(f"tolerance {tolerance}: must be from 1e-13 to 0.1")
    if (equation is None) == (file is None):
        raise ValueError("give one of equation and file")
    if starts is not None and not 1 <= starts <= 10_000:
        raise ValueError(f"starts {starts}: must be from 1 to 10000")
    if starts is not None and from_parameter is not None:
        raise ValueError("starts: cannot be combined with from_parameter")
    name = "equation"
    if file is not None:
        name = file_of(file)
        with open(file, encoding="utf-8") as source:
            equation = source.read()
    settings = {name: float(value) for name, value in (set or {}).items()}
    text = _core.BoundaryText(name, equation, settings, conditions, unknown, "", text_of(start), text_of(until))
    times: list[float] = []
    values = np.empty((0, 0))
    if isinstance(guess, BoundarySolution):
        guess = {"t": guess.t, **dict(zip(guess.names, guess.x))}
    if not isinstance(guess, str):
        times = [float(t) for t in guess["t"]]
        if len(times) < 2 or not np.all(np.diff(times) > 0):
            raise ValueError('guess: "t" needs two times or more, ascending')
        rows = [np.broadcast_to(np.asarray(guess.get(name, 0.0), dtype=float), (len(times),)) for name in _core.bvp_names(text)]
        values, guess = np.array(rows), ""
    found = [BoundarySolution(solved) for solved in _core.bvp(text, guess, times, values, starts, from_parameter, tolerance)]
    return found if starts is not None else found[0]
