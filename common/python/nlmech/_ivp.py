"""Initial value problems as typed: integrate, compare, choose."""
from __future__ import annotations

import csv
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple, overload

import numpy as np

from . import _core
from ._failure import Failure
from ._text import Number, assignments_of, file_of, lines_of, text_of


class Event(NamedTuple):
    """An event of a run."""

    name: str  # as typed; with " after" for the state after a change
    t: float  # its time
    x: dict[str, float]  # all columns


class Run(NamedTuple):
    """One method in a comparison."""

    method: str
    setting: str  # "tolerance 1e-09"
    status: str  # "success", the outcome of a failure, or "unsuitable"
    digits: float  # correct digits at the end; nan if unknown
    seconds: float  # median run time, s
    right_hand_sides: int  # evaluations of the equations
    note: str  # why it failed, or by how much it misses its tolerance


class Choice(NamedTuple):
    """One method in a ranking."""

    rank: int
    method: str
    tolerance: float  # at which it should reach the digits
    seconds: float  # estimated run time, s
    reason: str


class Solution:
    """A run of integrate().

    t: times of the rows, shape (m,): the start, rows at `every` and `at`, events, the end.
    names: names of the columns: components, then further columns.
    x: values, shape (columns, m). `solution["x'"]` is one column.
    events: list of Event.
    status, sentence: "success", or the outcome of a failure and its sentence.
    verified: True if an independent computation confirms the run; False if none could; None if none was asked for.
    method: name of the method.
    remarks: messages on the run, as the command prints on standard error.
    `solution(t)` evaluates the solution at other times.
    """

    def __init__(self, found: tuple, again: Callable[[list[float]], Solution]):
        (header, table, events), (self.status, self.sentence), self.method, self.verified, self.remarks = found
        self.names: tuple[str, ...] = tuple(header.split(",")[1:table.shape[0]])
        self.t: np.ndarray = table[0]
        self.x: np.ndarray = table[1:]
        self.events = [Event(name[0], float(self.t[k]), dict(zip(self.names, self.x[:, k].tolist())))
                       for k, name in enumerate(csv.reader(events)) if name]
        self._again = again

    def __getitem__(self, name: str) -> np.ndarray:
        """The values of a column at `t`."""
        if name not in self.names:
            raise KeyError(f"there is no column {name}; the columns are {', '.join(self.names)}")
        return self.x[self.names.index(name)]

    def __call__(self, t) -> dict[str, np.ndarray]:
        """Dense output: each column at times between the start and the end of the run, in the shape of t.

        The values are those of rows at these times (`at=t`), bit for bit. For them the run is repeated: ask for many times
        in one call.
        """
        t = np.asarray(t, dtype=float)
        low, high = min(self.t[0], self.t[-1]), max(self.t[0], self.t[-1])
        if t.size and not (low <= t.min() and t.max() <= high):
            raise ValueError(f"t: {t.min()} to {t.max()} is not within the run, from {low} to {high}")
        rows = self._again(t.ravel().tolist())
        sign = 1 if rows.t[0] <= rows.t[-1] else -1
        times, wanted = sign * rows.t, sign * t.ravel()
        # The last row at or before a time; an event within rounding of it has replaced a row.
        found = np.clip(np.searchsorted(times, wanted, side="right") - 1, 0, None)
        after = np.minimum(found + 1, times.size - 1)
        found = np.where(np.abs(times[after] - wanted) < np.abs(times[found] - wanted), after, found)
        return {name: column[found].reshape(t.shape) for name, column in zip(self.names, rows.x)}

    def __repr__(self) -> str:
        return f"<Solution: {', '.join(self.names)} at {self.t.size} times, {self.status}>"


def _options(given: dict) -> _core.Options:
    """The arguments of a call as options of the command, which are text, lists of texts, numbers or nothing."""
    options = _core.Options()
    initial = given.pop("initial")
    if isinstance(initial, Mapping):
        initial = ", ".join(f"{name}={text_of(value)}" for name, value in initial.items())
    given |= {"initial": initial, "set": assignments_of(given["set"]), "file": file_of(given["file"])}
    for name, value in given.items():
        if value is None:
            continue
        owner = options if hasattr(options, name) else options.settings
        if hasattr(owner, name):
            now = getattr(owner, name)
            if isinstance(now, list):
                value = lines_of(value)
            elif isinstance(now, str):
                value = text_of(value) if np.isscalar(value) else ",".join(map(text_of, value))
            setattr(owner, name, value)
    return options


@overload
def integrate(equation: str | None, initial: str | Mapping[str, Number] | Sequence[float] | None = None, **given) -> Solution: ...
@overload
def integrate(equation: str | None, initial: np.ndarray, **given) -> Solution | list[Solution]: ...
def integrate(equation: str | None = None, initial=None, *, until: Number | None = None, start: Number | None = None,
              every: Number | None = None, at: Iterable[float] = (), method: str | None = None, tolerance: float | None = None,
              absolute_tolerance: float | None = None, step: Number | None = None, largest_step: float | None = None,
              nodes: int | None = None, shape: float | None = None, order: int | None = None, points: int | None = None,
              set: Mapping[str, float] | None = None, events: str | Iterable[str] | None = None,
              changes: str | Iterable[str] | None = None, section: str | None = None, columns: str | Iterable[str] | None = None,
              problem: str | None = None, file: str | os.PathLike | None = None, verify: bool = True, limit: float | None = None,
              threads: int | None = None, progress: Callable[[float], object] | None = None):
    """Integrates equations as typed: integrate("x'' + x + x^3 = 0", "x=1, x'=0", until=50, tolerance=1e-9).

    Arguments are the options of `integrators integrate`; numbers may be expressions such as "2 pi/w". Same bits as the command.
    equation: equations and definitions, separated by ";". Or `problem`, the name of a problem of the library, or `file`.
    initial: initial state: "x=1, x'=0", a dictionary, or numbers in the order of the state. An array of shape (n, components)
        starts n runs.
    until, start: end and start time (default of the text; 0). The end may be before the start.
    every, at: interval and further times of rows (default: only start and end).
    method: name of a method (default: chosen by the problem and the tolerance, another one if its run fails).
    tolerance, absolute_tolerance: bounds of the error of each step (default 1e-9 and `tolerance`).
    step, largest_step: step size of methods with fixed steps; bound of adaptive steps.
    nodes, shape, order, points: settings of some methods.
    set: values of parameters, {"a": 3}.
    events: "x = 0", "apex: x' = 0 falling", "x = 0 rising end"; one text or several. Each occurrence makes a row.
    changes: changes of the state at events: "apex: x' = -0.8 x'".
    section: Poincare section, "x = 0 rising": only its rows.
    columns: further columns: "E = x'^2/2 + x^2/2; x''".
    verify: compare the run with an independent computation.
    limit: wall time, s (default 60 for each run; a given one is for all of many runs).
    threads: number of threads for many runs (default: one for each processor).
    progress: called about every 50 ms with the share of the time that is done, from 0 to 1. Its exceptions end the run.

    Returns a Solution; with n initial states a list of n, where each has its own status and a failure does not raise.
    Raises Failure with the rows up to there as `partial`, ValueError for wrong arguments, KeyboardInterrupt after Ctrl-C.
    """
    options = _options(locals() | {"initial": None if np.ndim(initial) == 2 else initial})
    options.no_verify = not verify
    times = [float(t) for t in np.ravel(at)]
    if np.ndim(initial) == 2:
        states = np.ascontiguousarray(initial, dtype=float)
        found = _core.integrate_all(options, states, times, progress)
        return [Solution(one, lambda t, x=x: Solution(_core.integrate_all(options, x[None], t, None)[0], None))
                for one, x in zip(found, states)]

    def run(times: list[float], progress: Callable[[float], object] | None = None) -> Solution:
        found = Solution(_core.integrate(options, times, progress), run)
        if found.status != "success":
            raise Failure(found.sentence, found.status, found)
        return found
    return run(times, progress)


def compare(equation: str | None = None, initial=None, *, until: Number | None = None, start: Number | None = None,
            methods: str | Iterable[str] | None = None, tolerance: float | None = None,
            tolerances: str | Iterable[float] | None = None, absolute_tolerance: float | None = None, step: Number | None = None,
            largest_step: float | None = None, nodes: int | None = None, shape: float | None = None, order: int | None = None,
            points: int | None = None, set: Mapping[str, float] | None = None, problem: str | None = None,
            file: str | os.PathLike | None = None, limit: float | None = None,
            progress: Callable[[float], object] | None = None) -> list[Run]:
    """Runs several methods on one problem and compares their ends with a reference in extended precision.

    methods: names (default: those that suit the problem), or "all". tolerances: "1e-3:1e-12" by decades, or numbers.
    limit: wall time of all runs together, s (default 60). Other arguments as for integrate().
    progress: called about every 50 ms with the share of the current run. Returns a Run for each method and tolerance.
    """
    rows = _core.compare(_options(locals() | {"method": methods}), progress)
    return [Run(row["method"], row["setting"], row["status"], float(row["digits"] or "nan"), float(row["seconds"] or "nan"),
                int(row["right_hand_sides"] or 0), row["note"]) for row in csv.DictReader(rows.splitlines())]


def choose(equation: str | None = None, initial=None, *, until: Number | None = None, start: Number | None = None, digits: int = 9,
           absolute_tolerance: float | None = None, largest_step: float | None = None, set: Mapping[str, float] | None = None,
           problem: str | None = None, file: str | os.PathLike | None = None) -> list[Choice]:
    """Ranks methods for so many correct digits at the end, from 1 to 14, by a list of rules and a short run of each.

    Other arguments as for integrate(). Returns a Choice for each method, best first.
    """
    rows = _core.choose(_options(locals()))
    return [Choice(int(row["rank"]), row["method"], float(row["tolerance"]), float(row["seconds"] or "nan"), row["reason"])
            for row in csv.DictReader(rows.splitlines())]
