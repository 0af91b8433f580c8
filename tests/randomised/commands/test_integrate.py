"""Random runs of `integrators integrate` and `compare` on all problems that are not stiff, by all methods, tolerances and steps, forwards and
backwards: checked against Taylor series in 25 digits."""
import math
import re

from cases import EPS, failed, randomised_test, judged, needs, number, ran, refused, undecided, wrong
from ivp import HERMITIAN, METHODS, MOST_TOLERANCES, Question, one_tolerance
from mpmath import mp

needs_integrators = needs("integrators")
# The command knows the condition by differences. Of more than 48 rows it looks at some: the others may be off by as much again.
SLACK, SLACK_BETWEEN, MOST_VERIFIED = 1.1, 2, 48


def with_settings(draw, name, ranges):
    """The words of a method, and of what it takes besides: (share of the cases, least, greatest) of each setting."""
    words = f" --method {name}"
    for setting in METHODS[name].settings:
        share, low, high = ranges[setting]
        if draw.chance(share):
            words += f" --{setting} {draw.log_uniform(low, high) if setting == 'shape' else draw.whole(low, high)!r}"
    return words


def inner_times(t0, t1, every):
    """t0 + every, t0 + 2 every, ...: the times between start and end."""
    sign, times, k = math.copysign(1, t1 - t0), [], 1
    while abs(t1 - t0) - k * every > 1e-9 * every:
        times.append(t0 + sign * k * every)
        k += 1
    return times


def numbers_of(r, count):
    """The rows as numbers, the first one is the start; what is wrong with them if their number is not this one."""
    rows = [[number(cell) for cell in row] for row in r.rows]
    if len(rows) != count or any(len(row) != len(r.header) for row in rows):
        return None, wrong(f"{r.words}: {len(rows)} rows where there should be {count}")
    if not all(math.isfinite(x) for row in rows for x in row):
        return None, wrong(r.words + ": no number")
    return rows, None


class Asked:
    """A run by a tolerance, and the rows that it should print."""

    def __init__(self, draw, has_rows):
        self.question = q = Question(draw)
        self.relative = self.absolute = draw.log_uniform(1e-10, 1e-3)
        way = draw.log_uniform(1e-4, 1) * q.problem.longest * (-1 if has_rows and draw.chance(0.3) else 1)
        self.t0 = draw.uniform(-10, 10) if has_rows and draw.chance(0.3) else 0.0
        t1 = self.t0 + way
        self.words = f"integrators integrate {q.words} --from {self.t0!r} --until {t1!r} --tolerance {self.relative!r}"
        self.words += with_settings(draw, q.method(draw, False), {"nodes": (0.3, 3, 24), "shape": (0.3, 0.1, 10), "order": (0.3, 6, 40)})
        self.times = [t1]
        if has_rows:
            if draw.chance(0.2):
                self.absolute *= draw.log_uniform(1e-3, 1)
                self.words += f" --absolute-tolerance {self.absolute!r}"
            # More than 48, of which not all are verified, in one case of five.
            every = abs(way) / (draw.uniform(48, 200) if draw.chance(0.2) else draw.uniform(0.5, 48))
            self.words += f" --every {every!r}"
            self.times = [*inner_times(self.t0, t1, every), t1]

    def with_parts(self):
        """Their times with 32 equal parts of the way, at which the condition is sampled: the command has half of them."""
        t1 = self.times[-1]
        return sorted({*self.times, *(self.t0 + k * (t1 - self.t0) / 32 for k in range(1, 32))}, reverse=t1 < self.t0)

    def scales(self, known, k):
        """What digits at a time are relative to. The command has other times for the size: twice a thousandth of it is beyond its doubt."""
        return [self.absolute / self.relative if s <= self.absolute else abs(c) if abs(c) >= 2e-3 * s else s
                for c, s in zip(known.truth(k), known.size)]


def judged_run(a, r, rows):
    times = a.with_parts()
    known = a.question.known(a.t0, times)
    if not known:
        return undecided(r.words)
    places = [times.index(t) for t in a.times]
    errors = [known.error(k, row[1:]) for k, row in zip(places, rows)]
    allowed = [[MOST_TOLERANCES * c for c in one_tolerance(known.truth(k), known.size, a.relative, a.absolute)] for k in places]
    said = re.search("verified: (.*?) digits", r.errors)
    if said:
        allowed = [[max(b, 10**-number(said[1]) * s) for b, s in zip(bound, a.scales(known, k))] for k, bound in zip(places, allowed)]
    if any(d > 0.1 * b for k, bound in zip(places, allowed) for d, b in zip(known.doubt[k], bound)):
        return undecided(r.words)
    ratio, t, i = max((e / b, t, i) for t, error, bound in zip(a.times, errors, allowed) for i, (e, b) in enumerate(zip(error, bound)))
    return judged(ratio, SLACK_BETWEEN if len(a.times) > MOST_VERIFIED else SLACK, f"{r.words}: component {i + 1} at t = {t!r}")


def tried(draw, has_rows):
    a = Asked(draw, has_rows)
    r = ran(a.words)
    if r.exit_code:
        return failed(r)
    rows, fault = numbers_of(r, len(a.times) + 1)
    if fault:
        return fault
    for t, row in zip(a.times, rows[1:]):  # rounding of k DT and of the sum
        if not abs(row[0] - t) <= 4 * EPS * (abs(a.t0) + abs(t)):
            return wrong(f"{r.words}: a row at {row[0]!r}")
    return undecided(r.words) if "not verified" in r.errors else judged_run(a, r, rows[1:])


@needs_integrators
@randomised_test(quick=8, full=3_000)
def test_integrate_prints_what_is_right(draw):
    return tried(draw, has_rows=False)


@needs_integrators
@randomised_test(quick=12, full=3_000)
def test_every_row_is_right(draw):
    return tried(draw, has_rows=True)


# Runs by a step are not judged by the command: their error is what the step makes of it. But they are runs of that method with that step. Whatever
# the step, the simplest methods print powers of a matrix on a linear problem. Runs that come nearer to each other with every halving of the
# step come nearer to the solution.

def apart(a, b, size):
    """Greatest difference, in units of each component's size."""
    return max(abs(x - y) / s for p, q in zip(a, b) for x, y, s in zip(p, q, size))


def judged_halvings(runs, known, words):
    """If the differences shrink as those of an order one or more do (by a half, with room for the higher terms), the rest of the series of
    halvings is no longer than four times the last difference."""
    size = [max(s, 1e-3 * max(known.size), 1e-300) for s in known.size]
    first, second = apart(runs[0], runs[1], size), apart(runs[1], runs[2], size)
    if not (first < 0.05 and second < first / 1.8):
        return undecided(words)
    bound = 4 * second + 1e-9  # rounding of up to 4000 steps, and of radial bases
    if max(d / s for doubt in known.doubt for d, s in zip(doubt, size)) > 0.1 * bound:
        return undecided(words)
    error = max(e / s for k, row in enumerate(runs[2]) for e, s in zip(known.error(k, row), size))
    return judged(error, bound, f"{words}: differences {first:.3g} and {second:.3g}")


@needs_integrators
@randomised_test(quick=20, full=3_000)
def test_halved_steps_lead_to_the_solution(draw):
    q = Question(draw)
    way = draw.log_uniform(1e-4, 0.3) * q.problem.longest * (-1 if draw.chance(0.3) else 1)
    t0 = draw.uniform(-10, 10) if draw.chance(0.3) else 0.0
    # A whole number of steps more often than its share, and with it of steps a row.
    steps, count = draw.whole(4, 200) if draw.chance(0.5) else draw.uniform(4, 1000), draw.whole(1, 12)
    method = q.method(draw, True)
    # With a shape that follows the step radial functions do not converge, so that they are always given one.
    words = f"integrators integrate {q.words} --from {t0!r} --until {t0 + way!r} --every {abs(way) / count!r}"
    words += with_settings(draw, method, {"nodes": (0.3, 3, 16), "shape": (1, 0.3, 30), "order": (0.5, 3, 24), "points": (0.3, 1, 6)})
    # Within a step the velocities of Hermitian operators are derivatives of an interpolated position, off by the step's error of that per length,
    # 30 s^2 (1 - s)^2 times. Near an end this is as the square of the row's distance from it, whatever the step, so that no halving shows it:
    # such a run is judged at its end.
    is_between = method in HERMITIAN and abs(steps / count - round(steps / count)) > 1e-9 * steps / count
    runs, times = [], []
    for part in (1, 2, 4):
        r = ran(f"{words} --step {abs(way) / steps / part!r}")
        if r.exit_code:
            return failed(r)
        rows, fault = numbers_of(r, count + 1)
        if fault:
            return fault
        rows = rows[-1:] if is_between else rows[1:]
        runs.append([row[1:] for row in rows])
        times = [row[0] for row in rows]
    known = q.known(t0, times)
    return judged_halvings(runs, known, r.words) if known else undecided(words)


def step_of(method, w, h):
    """What a step of the length h does to the state of x'' + w^2 x = 0."""
    one, z = mp.eye(2), mp.matrix([[0, h], [-w * w * h, 0]])
    if method == "euler":
        return one + z
    if method == "backward-euler":
        return (one - z) ** -1
    if method == "newmark":  # constant average acceleration is the trapezoidal rule
        return (one - z / 2) ** -1 * (one + z / 2)
    return one + z + z**2 / 2 + z**3 / 6 + z**4 / 24  # rk4


@needs_integrators
@randomised_test(quick=20, full=3_000)
def test_steps_are_powers_of_a_matrix(draw):
    w, x, v = draw.log_uniform(1e-2, 1e2), draw.signed_log(1e-3, 10), draw.signed_log(1e-3, 10)
    method = draw.one_of(["euler", "backward-euler", "newmark", "rk4"])
    h = draw.log_uniform(1e-3, 3) / w  # any step, of those that leave the numbers finite
    count, stride = draw.whole(1, 200), draw.whole(1, 5)
    sign, rest = -1 if draw.chance(0.3) else 1, draw.uniform(0.1, 0.9) if draw.chance(0.5) else 0
    t1 = sign * (count + rest) * h
    r = ran(f"integrators integrate --problem duffing --set hardening=0 --set natural_frequency={w!r} --initial {x!r},{v!r} --until {t1!r} "
            f"--step {h!r} --every {stride * h!r} --method {method}")
    if r.exit_code:
        return failed(r)
    whole = list(range(0, count + 1, stride))
    is_last_apart = whole[-1] != count or rest > 0
    rows, fault = numbers_of(r, len(whole) + is_last_apart)
    if fault:
        return fault
    with mp.workdps(30):
        step, state = step_of(method, mp.mpf(w), sign * mp.mpf(h)), mp.matrix([x, v])
        # In units of the amplitude; each step rounds by some eps of what it adds up, and so does its length.
        growth = max(1, mp.mnorm(mp.matrix([[step[0, 0], step[0, 1] * w], [step[1, 0] / w, step[1, 1]]]), "f"))
        expected, amplitude = [], mp.hypot(x, v / mp.mpf(w))
        for k in range(count + 1):
            if k in whole:
                expected.append((state, 4 * EPS * (k + 1) * amplitude))
            if k < count:
                state, amplitude = step * state, amplitude * growth
        if rest:
            state = step_of(method, mp.mpf(w), mp.mpf(t1) - sign * count * mp.mpf(h)) * state
        if is_last_apart:
            expected.append((state, 4 * EPS * (count + 2) * amplitude * growth))
        ratios = [abs(row[i + 1] - state[i]) / (allowed * (w if i else 1)) for row, (state, allowed) in zip(rows, expected) for i in range(2)]
    return judged(max(ratios), 1, r.words)


# Comparisons: the digits of each row of `compare` are those of the same run by `integrate`, and no more than its reference is said to know; a row
# without digits says why, and one that is off by more than a hundred tolerances says so.
MOST_UNSURE = 4


def digits_known(errors):
    """How many digits the reference has, by its own words; nothing if there is none."""
    found = re.search(" agree to (.*?) digits", errors)
    return number(found[1]) if found else None


def relative(difference, x, size):
    """Relative to the component or, below a thousandth of its size, to its size."""
    return max(abs(d) / ((abs(c) if abs(c) >= 1e-3 * s else s) or 1) for d, c, s in zip(difference, x, size))


def malformed(row, has_reference):
    """What is wrong with the form of a row."""
    if len(row) != 7:
        return "cells"
    if row[2] != "success":
        return "a failure without a reason" if not row[6] else "digits of a failure" if row[3] else ""
    return "no digits" if (not row[3]) == has_reference else ""


def notes_its_error(row, tolerance, error, known):
    """A success says in its note if it is off by more than a hundred of the tolerances that it was given."""
    one = [tolerance * (1 + abs(c)) for c in known.truth(-1)]
    most, doubt = max(e / o for e, o in zip(error, one)), max(d / o for d, o in zip(known.doubt[-1], one))
    if most > 110 + doubt:  # a tenth for what neither side knows
        return bool(row[6])
    return most > 90 - doubt or not row[6]


class Comparison:
    """What was asked of all methods, and what is known of the solution."""

    def __init__(self, draw):
        self.question = q = Question(draw)
        way = draw.log_uniform(1e-4, 0.3) * q.problem.longest
        self.t0 = draw.uniform(-10, 10) if draw.chance(0.3) else 0.0
        self.t1 = self.t0 + way * (-1 if draw.chance(0.2) else 1)
        self.is_by_steps = draw.chance(0.4)
        self.setting = way / draw.log_uniform(4, 2000) if self.is_by_steps else draw.log_uniform(1e-12, 1e-2)
        self.methods = list(dict.fromkeys(q.method(draw, self.is_by_steps) for _ in range(draw.whole(1, 4))))
        self.same = f"{q.words} --from {self.t0!r} --until {self.t1!r} --{'step' if self.is_by_steps else 'tolerance'} {self.setting!r}"
        self.times = [self.t0 + (self.t1 - self.t0) * (k / 64) for k in range(1, 64)] + [self.t1]

    def end_of(self, method):
        """The end of the same run; nothing if it fails by its wall time."""
        r = ran(f"integrators integrate {self.same} --method {method}" + ("" if self.is_by_steps else " --no-verify"))
        return [number(cell) for cell in r.rows[-1][1:]] if r.exit_code == 0 else None

    def ratio_of(self, row, error, reference_digits, known):
        """How far the error is from what the digits of a row say, in units of what is not known."""
        truth = known.truth(-1)
        # Steps round the time: by the state's rate, from the last of 64 parts of the way.
        rounding = 64 * EPS * (abs(self.t0) + abs(self.t1)) / (self.t1 - self.t0)
        rate = [(a - b) * rounding for a, b in zip(truth, known.truth(-2))]
        error, doubt = relative(error, truth, known.size), relative(known.doubt[-1], truth, known.size) + 4 * relative(rate, truth, known.size)
        said, reference = 10 ** -number(row[3]), 10**-reference_digits
        least = max(error, reference, EPS / 2)
        # Besides the doubt: that a reference is off by what its two computations differ, and the rounding of the printed digits (0.0005, and 0.05
        # for the reference's).
        unsure = doubt + reference / MOST_UNSURE + 0.002 * error + (0.15 * least if reference > error / 2 else 0)

        def over(more):
            return abs(said - least) / (unsure + more) if unsure + more > 0 else 0

        if over(0) <= MOST_UNSURE:
            return over(0)
        # Errors of the two computations, which are made with tolerances of 1e-13 at best, may grow alike, so that their difference does not show
        # them.
        moved = self.question.moved(self.t0, self.times, known, 1e-13, 1e-15)
        return over(max(relative(moved[-1], truth, known.size), 1e-13) / 4) if moved else over(0)


@needs_integrators
@randomised_test(quick=8, full=2_000)
def test_compared_digits_are_there(draw):
    a = Comparison(draw)
    r = ran(f"integrators compare {a.same} --methods {','.join(a.methods)}")
    if r.exit_code:
        return failed(r)
    digits = digits_known(r.errors)
    faults = [f"{','.join(row)}: {malformed(row, digits is not None)}" for row in r.rows if malformed(row, digits is not None)]
    if faults or {row[0] for row in r.rows} != set(a.methods) or len(r.rows) != len(a.methods):
        return wrong(f"{r.words}: rows; {'; '.join(faults)}")
    known = a.question.known(a.t0, a.times) if digits is not None else None
    if not known:
        return undecided(r.words)
    worst = None
    for row in r.rows:
        end = a.end_of(row[0]) if row[2] == "success" else None
        if not end:
            continue
        error = known.error(-1, end)
        if not a.is_by_steps and not notes_its_error(row, a.setting, error, known):
            return wrong(f"{r.words}: {','.join(row)}: the note")
        ratio = a.ratio_of(row, error, digits, known)
        worst = max(worst or (-1, ""), (ratio, ",".join(row)))
    return judged(worst[0], MOST_UNSURE, f"{r.words}: {worst[1]}; reference {digits} digits") if worst else refused(r.words)
