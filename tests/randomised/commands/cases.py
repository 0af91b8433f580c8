"""Random cases of whole commands in search of silent failures: draws with corners, verdicts, counts.

    @randomised_test(quick=8, full=1000)
    def test_every_row_is_right(draw):
        height = draw.log_uniform(0.02, 12.9)
        r = ran(f"homotopy toggle --height {height!r}")
        if r.exit_code:
            return failed(r)
        return judged(error, bound, r.words)

It is the test RandomisedCommands.EveryRowIsRight. The quick share runs in `make test`; with NLMECH_RANDOMISED=full in the environment (label
`long`, `make randomised`) all cases run, and the counts are written to the build for tables/RANDOMISED.md. NLMECH_RANDOMISED_SEED draws other
cases, NLMECH_RANDOMISED_CASE=n runs the n-th one alone, prints it and, if it is wrong, looks for a simpler one.

Draws are Hypothesis strategies. Hypothesis does not count or number what it generates, so each case is handed its bytes (fuzz_one_input) by a
generator that is seeded with the randomised test's name, the seed and the number: the same case on every machine with the same version of Hypothesis.
Its shrinking serves the case that is run alone; its database stays in memory."""
import csv
import dataclasses
import io
import math
import os
import random
import shlex
import subprocess
import traceback

import pytest
from hypothesis import HealthCheck, Phase, given, settings, strategies
from hypothesis.database import InMemoryExampleDatabase

from nlmech_tree import BUILD, program

EPS = 2.0**-52
CORNER_SHARE = 0.125
SHOWN = 8  # wrong cases that are printed


class Draw:
    """The random numbers of one case."""

    _part = strategies.integers(0, 2**24 - 1)  # of this range and smaller ones Hypothesis draws uniformly

    def __init__(self, data):
        self._data = data

    def _unit(self):
        """In [0, 1)."""
        return (self._data.draw(self._part) * 2**24 + self._data.draw(self._part)) * 2.0**-48

    def whole(self, low, high):
        """A whole number, both ends included; at most 2**24 of them."""
        return self._data.draw(strategies.integers(low, high))

    def chance(self, probability):
        """True in this share of the cases."""
        return self._data.draw(self._part) < probability * 2**24

    def one_of(self, choices):
        return choices[self.whole(0, len(choices) - 1)]

    def uniform(self, low, high):
        """One case in eight is an end of the range or its middle."""
        if self.chance(CORNER_SHARE):
            return self.one_of([low, high, low / 2 + high / 2])
        return low + (high - low) * self._unit()

    def log_uniform(self, low, high):
        """The logarithm is uniform; one case in eight is an end of the range or a power of ten."""
        begin, end = math.log10(low), math.log10(high)
        if self.chance(CORNER_SHARE):
            ten = 10.0 ** self.whole(math.ceil(begin), math.floor(max(end, math.ceil(begin))))
            return self.one_of([low, high, min(max(ten, low), high)])
        return min(max(10 ** (begin + (end - begin) * self._unit()), low), high)

    def signed_log(self, low, high):
        size = self.log_uniform(low, high)
        return size if self.chance(0.5) else -size

    def any_finite(self):
        """Any finite double: Hypothesis' own corners (whole numbers, limits, subnormal numbers), or any bit pattern."""
        if self.chance(0.5):
            return self._data.draw(strategies.floats(allow_nan=False, allow_infinity=False))
        size = math.ldexp(1 + self._unit(), self.whole(-1074, 1023))
        return size if self.chance(0.5) else -size

    def normal(self):
        """A normal deviate (Box and Muller)."""
        return math.sqrt(-2 * math.log1p(-self._unit())) * math.cos(math.tau * self._unit())


@dataclasses.dataclass
class Case:
    """What became of one case."""

    verdict: str  # right; wrong: what a randomised test looks for; refused: a sentence says why; undecided: the oracle does not know
    what: str  # all that is needed to repeat it by hand
    ratio: float = 0  # error over its bound, of right and wrong ones


def judged(error, bound, what):
    """Right if error <= bound; wrong otherwise, also for a NaN."""
    error, bound = float(error), float(bound)
    ratio = error / bound if bound > 0 else 0 if error <= bound else math.inf
    if error <= bound:
        return Case("right", what, ratio)
    return Case("wrong", f"error {error:.3g}, allowed {bound:.3g}; {what}", ratio)


def wrong(what):
    return Case("wrong", what, math.inf)


def refused(what):
    return Case("refused", what)


def undecided(what):
    return Case("undecided", what)


def worst_of(cases, what):
    """A wrong case, else the right one nearest to its bound, else undecided."""
    worst = undecided(what)
    for case in cases:
        if case.verdict == "wrong":
            return case
        if case.verdict == "right" and (worst.verdict != "right" or case.ratio > worst.ratio):
            worst = case
    return worst


EVERY_CASE = settings(database=None, deadline=None, suppress_health_check=list(HealthCheck))


class RandomisedTest:
    """The cases of one randomised test, by their numbers."""

    def __init__(self, trial):
        self.trial = trial
        self.name = "RandomisedCommands." + trial.__name__.removeprefix("test_").title().replace("_", "")
        self.seed = int(os.environ.get("NLMECH_RANDOMISED_SEED", 1))

        @EVERY_CASE
        @given(strategies.data())
        def keep(data):
            self.found = trial(Draw(data))

        self._keep = keep.hypothesis.fuzz_one_input

    def bytes_of(self, number):
        return random.Random(f"{self.name} {self.seed} {number}").randbytes(8192)

    def case(self, number):
        self.found = None
        try:
            self._keep(self.bytes_of(number))
        except Exception:  # what the randomised test itself does not expect of an answer is worth a look
            return wrong(traceback.format_exc(limit=-3))
        assert self.found, "a case draws more numbers than Hypothesis has bytes for"
        return self.found

    def shrunk(self, number):
        """Fails with the simplest case that Hypothesis finds to be wrong as this one is."""
        @settings(EVERY_CASE, database=InMemoryExampleDatabase(), phases=[Phase.reuse, Phase.shrink])
        @given(strategies.data())
        def is_not_wrong(data):
            found = self.trial(Draw(data))
            assert found.verdict != "wrong", found.what

        try:
            is_not_wrong.hypothesis.fuzz_one_input(self.bytes_of(number))  # which puts it into the database
        except AssertionError:
            is_not_wrong()

    def run(self, count, least_right):
        """Runs so many cases. Too few right ones fail it too: three standard deviations below the stated share are no chance."""
        counts, worst, finds = dict.fromkeys(("right", "refused", "undecided", "wrong"), 0), 0, []
        for number in range(count):
            found = self.case(number)
            counts[found.verdict] += 1
            if found.verdict == "right":
                worst = max(worst, found.ratio)
            if found.verdict == "wrong" and len(finds) < SHOWN:
                finds.append(f"case {number} (NLMECH_RANDOMISED_SEED={self.seed} NLMECH_RANDOMISED_CASE={number}): {found.what}")
        print(f"randomised {self.name}: {count} cases, {counts['right']} right (worst {worst:.2g} of its bound), {counts['refused']} refused, "
              f"{counts['undecided']} undecided, {counts['wrong']} wrong")
        if is_full():
            (BUILD / "randomised").mkdir(exist_ok=True)
            row = [self.name, self.seed, count, *counts.values(), f"{worst:.2g}"]
            (BUILD / "randomised" / f"{self.name}.{self.seed}.csv").write_text(",".join(map(str, row)) + "\n", encoding="utf-8")
        assert not finds, f"{counts['wrong']} successes are wrong\n" + "\n".join(finds)
        mean = least_right * count
        assert counts["right"] >= (max(1, mean - 3 * math.sqrt(mean)) if mean else 0), "too few cases come to a judgement: the randomised test is empty"


def is_full():
    return os.environ.get("NLMECH_RANDOMISED") == "full"


def randomised_test(quick, full, least_right=0.1):
    """Makes a test of a function from draws to a case."""
    def decorate(trial):
        def test():
            this = RandomisedTest(trial)
            alone = os.environ.get("NLMECH_RANDOMISED_CASE")
            if alone is None:
                this.run(full if is_full() else quick, least_right)
                return
            found = this.case(int(alone))
            print(f"case {alone}: {found.verdict}, {found.ratio:.3g} of its bound; {found.what}")
            if found.verdict == "wrong":
                this.shrunk(int(alone))

        return test

    return decorate


@dataclasses.dataclass
class Ran:
    """A command that has ended."""

    words: str  # as typed
    exit_code: int
    errors: str  # on standard error
    header: list  # the first row of its CSV
    rows: list  # those below it


def ran(words, limit=5):
    """Runs a command of the build, a text or a list of words; it has so many seconds, and as many again to say that they are over."""
    name, *options = words.split(" ") if isinstance(words, str) else words
    words = words if isinstance(words, str) else shlex.join(words)
    try:
        done = subprocess.run([program(name), *options, "--limit", str(limit)], stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8",
                              timeout=2 * limit + 10, check=False)
    except subprocess.TimeoutExpired:
        return Ran(words, -1, "goes on beyond its limit", [], [])
    header, *rows = list(csv.reader(io.StringIO(done.stdout))) or [[]]
    return Ran(words, done.returncode, done.stderr, header, rows)


def failed(r):
    """Of a command without success: a failure that says something, or something worse."""
    if r.exit_code not in (1, 2) or r.header or not r.errors:
        return wrong(f"{r.words}: exit code {r.exit_code}, {r.errors}")
    return refused(f"{r.words}: {r.errors}")


def number(cell):
    """The number of a cell; not a number if it is none."""
    try:
        return float(cell)
    except ValueError:
        return math.nan


def needs(*names):
    """Skips the tests of a file if one of these programs is not built."""
    absent = [name for name in names if not program(name).exists()]
    return pytest.mark.skipif(bool(absent), reason=f"{', '.join(absent)} not built")
