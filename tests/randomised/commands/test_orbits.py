"""Random orbits by `two_body_series propagate`, forwards and backwards, with rows between and as catalogues: each row beside Kepler's classical
equation."""
import math
import operator
import tempfile

from cases import EPS, failed, randomised_test, judged, needs, number, ran, refused, undecided, worst_of, wrong
from kepler import DIGITS, Transition, any_motion, condition, conic, distance, norm, state_of, triple
from mpmath import mp


MOST_STEPS = 1000


def off_by(start, t, mu, printed):
    """How far a printed place is from the right one, as a share of the distance."""
    with mp.workdps(DIGITS):
        truth, _ = conic(*start, t, mu)
        return float(distance(printed, truth) / norm(truth))


def convolved(a, b, k):
    return sum(map(operator.mul, a[:k + 1], b[k::-1]))


def step_length(r, v, mu, tolerance):
    """What a Taylor series of the order that suits the tolerance can be long: the last term of the velocity is the tolerance times the speed, or
    the circular speed if that is larger."""
    unit, order = norm(r), min(max(int(-math.log(tolerance) / 2) + 2, 12), 40)
    rate = math.sqrt(mu / unit) / unit
    x = [[float(c / unit), float(w / (unit * rate))] for c, w in zip(r, v)]
    s, q = [1.0], [1.0]  # r.r and |r|^-3
    for k in range(order - 1):
        for c in x:
            c.append(-convolved(c, q, k) / ((k + 1) * (k + 2)))
        s.append(sum(convolved(c, c, k + 1) for c in x))
        q.append(sum((-1.5 * j - (k + 1 - j)) * s[j] * q[k + 1 - j] for j in range(1, k + 2)) / (k + 1))
    speed = max(1, math.hypot(*(c[1] for c in x)))
    lengths = []
    for k in (order - 1, order):
        term = k * math.hypot(*(c[k] for c in x)) / speed
        lengths.append((tolerance / term) ** (1 / (k - 1)) if term > 0 else math.inf)
    return min(lengths) / rate


def steps_of(start, mu, end, tolerance):
    """The ends of the steps of a series on the way; None if they are too many."""
    steps, t, sign = [], 0, math.copysign(1, end)
    r, v = start
    while True:
        t += sign * step_length(r, [sign * x for x in v], mu, tolerance)
        if not abs(t) < abs(end):
            return steps
        steps.append(Transition(*start, t, mu))
        r, v = ([float(x) for x in part] for part in (steps[-1].r, steps[-1].v))
        if len(steps) == MOST_STEPS:
            return None


def allowed_at(way, steps, method, tolerance):
    """How far off the distance may be at the end of a way, as a share: what the data determine, and for steps what each of them adds
    (AnalyticContinuation: two tolerances and nine roundings), times the condition of the rest of the way."""
    allowed = 8 * EPS * condition(way)[0]
    if method == "kepler":
        return allowed
    # RKN12(10) takes as many steps as the series within a factor of a few, and an estimate of an error is not a bound of it.
    of_step = (2 if method == "series" else 50) * tolerance + 9 * EPS
    allowed += 2 * of_step  # of the row's own series
    for step in steps:
        if abs(step.time) > abs(way.time):
            break
        circular = math.sqrt(way.mu / norm(step.r))
        allowed += of_step * max(1, circular / float(norm(step.v))) * condition(way, step)[0]
    return allowed


def times_of(end, every):
    """0, every, ...: the times of the rows."""
    times, k = [0.0], 1
    while abs(end) - k * every > 1e-9 * every:
        times.append(math.copysign(k * every, end))
        k += 1
    return times + [end]


def words_of(start, end, mu):
    return f"--position {triple(start[0])} --velocity {triple(start[1])} --until {end!r} --mu {mu!r}"


@needs("two_body_series")
@randomised_test(quick=20, full=3_000)
def test_orbits_row_by_row(draw):
    start, end, mu = any_motion(draw)
    method, tolerance = draw.one_of(["kepler", "series", "rkn1210"]), 1e-15
    if method != "kepler":  # some hundred revolutions at most
        r = norm(start[0])
        most = 300 * r * math.sqrt(r / mu)
        end = min(max(end, -most), most)
        tolerance = 1e-15 if draw.chance(0.3) else draw.log_uniform(1e-16, 1e-4)
    every = abs(end) / draw.uniform(0.5, 24)
    words = f"two_body_series propagate {words_of(start, end, mu)} --every {every!r} --method {method}"
    r = ran(words if method == "kepler" else f"{words} --tolerance {tolerance!r}")
    if r.exit_code:
        return failed(r)
    times = times_of(end, every)
    rows = [[number(cell) for cell in row] for row in r.rows]
    if [row[0] for row in rows] != times or any(len(row) != 7 for row in rows):
        return wrong(r.words + ": times")
    if not all(math.isfinite(x) for row in rows for x in row):
        return wrong(r.words + ": no number")
    steps = [] if method == "kepler" else steps_of(start, mu, end, tolerance)
    if steps is None:
        return undecided(r.words)

    def judged_rows():
        for t, row in zip(times[1:], rows[1:]):
            allowed = allowed_at(Transition(*start, t, mu), steps, method, tolerance)
            if allowed < 0.1:
                yield judged(off_by(start, t, mu, row[1:4]), allowed, f"{r.words}: at t = {t!r}")

    return worst_of(judged_rows(), r.words)


def nearly_parabolic(draw):
    """An orbit, and when it is asked for: up to where rounding of its energy leaves no digit."""
    speed = math.sqrt(2) * (1 + draw.signed_log(1e-18, 1e-3))
    return state_of(draw, draw.log_uniform(0.1, 10), 1, speed, draw.uniform(0, math.pi)), draw.signed_log(1e3, 1e30)


def judged_row(start, end, cells):
    """`success` has six digits (8 kappa eps with kappa eps < 1e-6), `low_accuracy` one."""
    status = cells[-1]
    what = f"{words_of(start, end, 1)}: {','.join(cells)}"
    if status not in ("success", "low_accuracy"):
        return refused(what)
    if number(cells[1]) != end:
        return wrong(what + ": another time")
    return judged(off_by(start, end, 1, [number(cell) for cell in cells[2:5]]), 8e-6 if status == "success" else 0.125, what)


@needs("two_body_series")
@randomised_test(quick=10, full=500)
def test_nearly_parabolic_catalogues(draw):
    motions = [nearly_parabolic(draw) for _ in range(40)]
    with tempfile.NamedTemporaryFile("w", prefix="nlmech-test-", suffix=".csv") as file:
        file.write("x,y,z,vx,vy,vz,until\n" + "".join(f"{triple(r)},{triple(v)},{end!r}\n" for (r, v), end in motions))
        file.flush()
        r = ran(f"two_body_series propagate --states {file.name} --mu 1 --method {draw.one_of(['kepler', 'series'])}")
    if len(r.rows) != len(motions):
        return wrong(f"{r.words}: rows are missing: {r.errors}")
    worst = worst_of((judged_row(*motion, row) for motion, row in zip(motions, r.rows)), r.words)
    return refused(r.words) if worst.verdict == "undecided" else worst
