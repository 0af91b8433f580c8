"""Random everyday equations by the method that `integrators integrate` takes without --method: quadratures, pulses, decay, growth, oscillators, orbits,
forces that switch, tanks. Their solutions have closed forms, here in 40 digits; none has a reason to be refused, but a tank that runs on past empty."""
import math
import re

from cases import EPS, failed, randomised_test, judged, needs, number, ran, undecided, wrong
from mpmath import mp, mpc, mpf

MOST_TOLERANCES, MOST_AMPLIFIED, SLACK = 100, 10, 1.1  # what a run without a word is right to; the command compares rows with 100 of them
DIGITS = 40


class Case:
    """An equation, its start and end, and its solution: time -> components. Of a solution that ends: when, and by which error of x it may end earlier
    or later by how much."""

    def __init__(self, text, x0, t1, solution, t0=0.0, ends=math.inf, moved=None):
        self.text, self.x0, self.t0, self.t1, self.solution, self.ends, self.moved = text, x0, t0, t1, solution, ends, moved


def quadrature(draw):
    a, w, t1 = draw.signed_log(0.1, 10), draw.log_uniform(0.5, 50), draw.log_uniform(0.5, 20)
    c = draw.one_of([0.0, draw.log_uniform(1e-3, 1)])
    A, W, C = mpf(a), mpf(w), mpf(c)
    kind = draw.whole(0, 4)
    if kind == 0:
        return Case(f"x' = {a!r}*cos({w!r}*t)", [0.0], t1, lambda t: [A / W * mp.sin(W * t)])
    if kind == 1:
        return Case(f"x'' = {a!r}*cos({w!r}*t)", [0.0, 0.0], t1, lambda t: [A / W**2 * (1 - mp.cos(W * t)), A / W * mp.sin(W * t)])
    if kind == 2:
        return Case(f"x' = {a!r}/(1 + {w!r}*t^2)", [0.0], t1, lambda t: [A / mp.sqrt(W) * mp.atan(mp.sqrt(W) * t)])
    if kind == 3:
        return Case(f"x' = {a!r}*sqrt(t + {c!r})", [0.0], t1, lambda t: [A * 2 / 3 * ((t + C)**mpf(1.5) - C**mpf(1.5))])
    t0 = draw.log_uniform(1e-3, 1)
    T = mpf(t0)
    return Case(f"x' = {a!r}*log(t)", [0.0], t0 + t1, lambda t: [A * (t * mp.log(t) - t - T * mp.log(T) + T)], t0)


def shape_of_pulse(draw, time, width):
    """A pulse about t = 0: its text, and its integral from -infinity."""
    W = mpf(width)
    text, integral = draw.one_of([
        ("exp(-({t}/{w})^2)", lambda s: W * mp.sqrt(mp.pi) / 2 * mp.erfc(-s / W)),
        ("1/cosh({t}/{w})^2", lambda s: W * (1 + mp.tanh(s / W))),
        ("1/(1 + ({t}/{w})^2)", lambda s: W * (mp.pi / 2 + mp.atan(s / W))),
        ("if({t} >= 0, exp(-{t}/{w}), 0)", lambda s: W * -mp.expm1(-s / W) if s > 0 else mpf(0)),
        ("if(abs({t}) <= {w}, 1, 0)", lambda s: min(max(s + W, mpf(0)), 2 * W))])
    return text.format(t=time, w=repr(width)), integral


def pulse(draw):
    """Of time alone, as short as a millionth of the interval, with or without decay beside it."""
    a, t1 = draw.signed_log(0.1, 10), draw.log_uniform(0.5, 1000)
    c, width = draw.uniform(0, 1) * t1, draw.log_uniform(1e-6, 0.3) * t1
    k = draw.log_uniform(0.1, 10) / t1
    A, C, W, K = mpf(a), mpf(c), mpf(width), mpf(k)
    if draw.chance(0.7):
        text, integral = shape_of_pulse(draw, f"(t - {c!r})", width)
        return Case(f"x' = {a!r}*{text}", [0.0], t1, lambda t: [A * (integral(t - C) - integral(-C))])

    def erf(t):
        return mp.erf((t - C) / W - K * W / 2)

    return Case(f"x' = {a!r}*exp(-((t - {c!r})/{width!r})^2) - {k!r}*x", [0.0], t1,
                lambda t: [A * W * mp.sqrt(mp.pi) / 2 * mp.exp(-K * (t - C) + (K * W / 2)**2) * (erf(t) - erf(0))])


def train(draw):
    """A pulse in each period."""
    a, period = draw.signed_log(0.1, 10), draw.log_uniform(0.1, 10)
    width, c = draw.log_uniform(1e-3, 0.2) * period, draw.uniform(0.2, 0.8) * period
    text, integral = shape_of_pulse(draw, f"(mod(t, {period!r}) - {c!r})", width)
    A, P, C = mpf(a), mpf(period), mpf(c)

    def solution(t):
        turns = mp.floor(t / P)
        return [A * (turns * (integral(P - C) - integral(-C)) + integral(t - turns * P - C) - integral(-C))]

    return Case(f"x' = {a!r}*{text}", [0.0], draw.log_uniform(0.5, 60) * period, solution)


def tank(draw):
    """h' = -k h^p: h^(1-p) falls at a constant rate. When it is empty the equation ends, unless it says that the tank stays so."""
    k, h0 = draw.log_uniform(0.1, 10), draw.log_uniform(0.01, 10)
    text, p, rests = draw.one_of([("sqrt(h)", mpf(1) / 2, False), ("h^0.5", mpf(1) / 2, False), ("h^0.75", mpf(3) / 4, False),
                                  ("sqrt(max(h, 0))", mpf(1) / 2, True), ("if(h > 0, sqrt(h), 0)", mpf(1) / 2, True)])
    K, H, q = mpf(k), mpf(h0), 1 - p
    empty = H**q / (q * K)
    return Case(f"h' = -{k!r}*{text}", [h0], float(empty) * draw.log_uniform(0.3, 5),
                lambda t: [(H**q - q * K * t) ** (1 / q) if t < empty else mpf(0)],
                ends=math.inf if rests else empty, moved=lambda error: mpf(error)**q / (q * K))


def decay(draw):
    a, k, x0 = draw.one_of([0.0, draw.signed_log(0.1, 10)]), draw.log_uniform(1e-2, 100), draw.signed_log(0.1, 10)
    A, K = mpf(a), mpf(k)
    return Case(f"x' = {a!r} - {k!r}*x", [x0], draw.log_uniform(0.5, 50), lambda t: [A / K + (x0 - A / K) * mp.exp(-K * t)])


def growth(draw):
    r, most, x0 = draw.log_uniform(0.1, 10), draw.log_uniform(0.1, 100), draw.log_uniform(1e-3, 10)
    R, M, X = mpf(r), mpf(most), mpf(x0)
    return Case(f"x' = {r!r}*x*(1 - x/{most!r})", [x0], draw.log_uniform(0.5, 50), lambda t: [M * X / (X + (M - X) * mp.exp(-R * t))])


def drag(draw):
    g, c, v0 = draw.log_uniform(1, 20), draw.log_uniform(1e-3, 1), draw.one_of([0.0, draw.log_uniform(0.01, 1)])
    G, C = mpf(g), mpf(c)
    last = mp.sqrt(G / C)
    return Case(f"v' = {g!r} - {c!r}*v^2", [v0], draw.log_uniform(0.5, 50), lambda t: [last * mp.tanh(mp.sqrt(G * C) * t + mp.atanh(v0 / last))])


def orbit(draw):
    mu, r = draw.log_uniform(0.1, 10), draw.log_uniform(0.1, 10)
    M, R = mpf(mu), mpf(r)
    v = float(mp.sqrt(M / R))
    # By the speed as it is typed, circular but for its rounding, which moves the phase by 3 eps n t.
    n = mpf(v) / R
    text = f"x'' = -{mu!r}*x/(x^2 + y^2)^1.5; y'' = -{mu!r}*y/(x^2 + y^2)^1.5"
    return Case(text, [r, 0.0, 0.0, v], draw.log_uniform(0.1, 20) * float(1 / n),
                lambda t: [R * mp.cos(n * t), R * mp.sin(n * t), -R * n * mp.sin(n * t), R * n * mp.cos(n * t)])


def bistable(draw):
    x0 = draw.signed_log(1e-3, 5)
    X = mpf(x0)
    return Case("x' = x - x^3", [x0], draw.log_uniform(0.5, 50), lambda t: [X / mp.sqrt(X**2 + (1 - X**2) * mp.exp(-2 * t))])


def tangent(draw):
    x0 = draw.signed_log(1e-2, 3)
    phase = mp.atan(x0)
    return Case("x' = 1 + x^2", [x0], float((mp.pi / 2 - phase) * draw.uniform(0.05, 0.99)), lambda t: [mp.tan(t + phase)])


def smoothed(draw):
    k, c = draw.log_uniform(1, 200), draw.uniform(0.5, 5)
    K, C = mpf(k), mpf(c)
    return Case(f"x' = tanh({k!r}*(t - {c!r}))", [0.0], c * draw.log_uniform(0.5, 5), lambda t: [mp.log(mp.cosh(K * (t - C)) / mp.cosh(K * C)) / K])


def relay(draw):
    """It reaches zero and stays there."""
    a, share, x0 = draw.log_uniform(0.1, 10), draw.uniform(-0.9, 0.9), draw.signed_log(0.1, 10)
    b = a * share
    text = draw.one_of([f"x' = {b!r} - {a!r}*sign(x)", f"x' = {b + a!r} - {2 * a!r}*max(sign(x), 0)"])
    upper, lower = (mpf(b) - mpf(a), mpf(b) + mpf(a)) if "max" not in text else (mpf(b + a) - mpf(2 * a), mpf(b + a))
    rate = upper if x0 > 0 else lower
    return Case(text, [x0], float(-x0 / rate) * draw.log_uniform(0.3, 5), lambda t: [x0 + rate * t if t < -x0 / rate else mpf(0)])


def loads(draw, w):
    """A force that switches at times of its own: its text; its switches to a time; on the piece about a time, its constant part and that of sin."""
    kind, W = draw.whole(0, 3), mpf(w)
    if kind == 0:  # half wave rectifier
        return f"max(sin({w!r}*t), 0)", [0], lambda t: (0, int(mp.sin(W * t) > 0))
    if kind == 1:  # full wave rectifier
        return f"abs(sin({w!r}*t))", [0], lambda t: (0, 1 if mp.sin(W * t) > 0 else -1)
    if kind == 2:
        return f"sign(sin({w!r}*t))", [0], lambda t: (1 if mp.sin(W * t) > 0 else -1, 0)
    c = draw.uniform(-0.9, 0.9)  # pulses
    return f"max(sign(sin({w!r}*t) - {c!r}), 0)", [mp.asin(c), mp.pi - mp.asin(c)], lambda t: (int(mp.sin(W * t) > c), 0)


def switched(draw, roots, text, x0, t1, w):
    """An equation of first or second order with these roots, under such a force."""
    force, phases, on = loads(draw, w)
    W, n = mpf(w), len(roots)
    period = mp.pi if phases == [0] else 2 * mp.pi

    def response(s, t):  # to exp(s t)
        value = mp.exp(s * t)
        for root in roots:
            value /= s - root
        return [value * s**i for i in range(n)]

    def particular(t, constant, sine):
        p = [mp.im(c) * sine for c in response(mpc(0, W), t)]
        if constant and not all(roots):  # x' = constant
            p[0] += constant * t
        elif constant:
            p[0] += constant * mp.re(response(mpf(0), t)[0])
        return p

    def move(x, t, to):
        parts = on((t + to) / 2)
        rest = [c - p for c, p in zip(x, particular(t, *parts))]
        if n == 1:
            free = [rest[0] * mp.exp(roots[0] * (to - t))]
        else:  # of two roots that differ
            r, q = roots
            one = (rest[1] - q * rest[0]) / (r - q)
            two = rest[0] - one
            e, f = one * mp.exp(r * (to - t)), two * mp.exp(q * (to - t))
            free = [mp.re(e + f), mp.re(r * e + q * f)]
        return [mp.re(a) + b for a, b in zip(free, particular(to, *parts))]

    def solution(t):
        turns = range(-1, int(W * t / period) + 2)
        times = sorted(s for k in turns for phase in phases for s in [(phase + k * period) / W] if 0 < s < t)
        x, now = [mpf(c) for c in x0], mpf(0)
        for to in [*times, t]:
            x, now = move(x, now, to), to
        return x

    return Case(text.format(force), x0, t1, solution)


def filtered(draw):
    k, w = draw.one_of([0.0, draw.log_uniform(0.05, 5)]), draw.log_uniform(0.5, 5)
    text = "x' = {} - " + repr(k) + "*x" if k else "x' = {}"
    return switched(draw, [mpf(-k)], text, [draw.one_of([0.0, 1.0])], draw.log_uniform(1, 100) / w, w)


def shaken(draw):
    d, s, w = draw.log_uniform(0.01, 0.5), draw.log_uniform(0.5, 5), draw.log_uniform(0.5, 5)
    half = mpf(d) / 2
    root = mpc(-half, mp.sqrt(mpf(s) - half**2))
    return switched(draw, [root, mp.conj(root)], f"x'' + {d!r}*x' + {s!r}*x = {{}}", [draw.one_of([0.0, 1.0]), 0.0], draw.log_uniform(1, 100) / w, w)


def oscillator(draw):
    d, s, a = draw.log_uniform(1e-3, 0.5), draw.log_uniform(0.5, 100), draw.signed_log(0.1, 10)
    w, x0, v0 = draw.log_uniform(0.1, 20), draw.signed_log(0.1, 3), draw.signed_log(0.1, 3)
    half, force = mpf(d) / 2, mpf(a) / mpc(mpf(s) - mpf(w)**2, mpf(d) * w)
    r, f = mpc(-half, mp.sqrt(mpf(s) - half**2)), mpc(0, w)
    start = x0 - force.real
    free = (v0 - (f * force).real - mp.conj(r) * start) / (r - mp.conj(r))
    return Case(f"x'' + {d!r}*x' + {s!r}*x = {a!r}*cos({w!r}*t)", [x0, v0], draw.log_uniform(0.5, 100),
                lambda t: [mp.re(2 * free * r**i * mp.exp(r * t) + force * f**i * mp.exp(f * t)) for i in range(2)])


def stairs(draw):
    """x' = a floor(b x) from b x > 1: the slope between n/b and (n + 1)/b is a n; down to 1/b, below which it rests."""
    a, b, x0 = draw.signed_log(0.1, 10), draw.log_uniform(0.1, 10), draw.uniform(1.1, 5)
    A, B, start = mpf(a), mpf(b), mpf(x0 / b)

    def solution(t):
        x, left = start, t
        n = mp.floor(B * x)
        while True:
            edge = (n + 1 if A > 0 else n) / B
            time = (edge - x) / (A * n)
            if time >= left:
                return [x + A * n * left]
            x, left, n = edge, left - time, n + (1 if A > 0 else -1)
            if n == 0:
                return [x]

    text = draw.one_of([f"x' = {a!r}*floor({b!r}*x)", f"x' = {a!r}*({b!r}*x - frac({b!r}*x))", f"x' = {a!r}*{b!r}*(x - mod(x, 1/{b!r}))",
                        f"x' = {a!r}*(ceil({b!r}*x) - 1)"])
    return Case(text, [x0 / b], draw.log_uniform(0.2, 4) / abs(a * b), solution)


def wrapped(draw):
    """A phase of which mod makes a saw-tooth u from 0 to p: u' = w + k u."""
    w, k, p = draw.log_uniform(0.1, 10), draw.log_uniform(0.1, 10), draw.log_uniform(0.1, 10)
    W, K, P = mpf(w), mpf(k), mpf(p)
    turn = mp.log1p(K * P / W) / K

    def solution(t):
        turns = mp.floor(t / turn)
        return [turns * P + W / K * mp.expm1(K * (t - turns * turn))]

    return Case(f"x' = {w!r} + {k!r}*mod(x, {p!r})", [0.0], float(turn) * draw.uniform(0.2, 12), solution)


def woken(draw):
    """A smoothed switch of a state that rests first: x = v t wakes y' = 1/(1 + exp(-k (x - c)))."""
    k, c, v = draw.log_uniform(1, 300), draw.uniform(0.5, 5), draw.log_uniform(0.1, 10)
    K, C, V = mpf(k), mpf(c), mpf(v)
    return Case(f"x' = {v!r}; y' = (1 + tanh({k!r}*(x - {c!r})))/2", [0.0, 0.0], c / v * draw.log_uniform(0.5, 50),
                lambda t: [V * t, (t + (mp.log(mp.cosh(K * (V * t - C))) - mp.log(mp.cosh(K * C))) / (K * V)) / 2])


def ellipse(draw):
    """From its far end, with an eccentricity up to 0.99: a near miss of the centre."""
    mu, r, miss = draw.log_uniform(0.1, 10), draw.log_uniform(0.1, 10), draw.log_uniform(0.01, 1)
    v = float(mp.sqrt(miss * mpf(mu) / r))
    M, R, V = mpf(mu), mpf(r), mpf(v)
    e = 1 - V**2 * R / M
    a = R / (1 + e)
    b, n = a * mp.sqrt(1 - e**2), mp.sqrt(M / a**3)

    def solution(t):
        mean = mp.pi + n * t
        E = mp.findroot(lambda E: E - e * mp.sin(E) - mean, [mean - 1, mean + 1], solver="anderson")
        rate = n / (1 - e * mp.cos(E))
        return [-a * (mp.cos(E) - e), -b * mp.sin(E), a * mp.sin(E) * rate, -b * mp.cos(E) * rate]

    text = f"x'' = -{mu!r}*x/(x^2 + y^2)^1.5; y'' = -{mu!r}*y/(x^2 + y^2)^1.5"
    return Case(text, [r, 0.0, 0.0, v], draw.log_uniform(0.1, 5) * float(2 * mp.pi / n), solution)


KINDS = [quadrature, pulse, train, tank, decay, growth, drag, orbit, bistable, tangent, smoothed, relay, filtered, shaken, oscillator, stairs, wrapped,
         woken, ellipse]


def relative(error, x, size):
    """To the component or, where that is below a thousandth of its size, to that."""
    return error / ((abs(x) if abs(x) >= 1e-3 * size else size) or 1)


@needs("integrators")
@randomised_test(quick=24, full=3_000, least_right=0.9)
def test_everyday_equations_are_answered(draw):
    with mp.workdps(DIGITS):
        return answered(draw, draw.one_of(KINDS)(draw))


@needs("integrators")
@randomised_test(quick=6, full=3_000, least_right=0.8)
def test_collisions_are_named(draw):
    """A central fall in the plane, r' = -c r^p with p < 1, meets the centre at r0^(1 - p)/((1 - p) c) by any method that chooses its steps."""
    c, p, r0, angle = draw.log_uniform(0.1, 10), draw.one_of([-2, -1, -0.5]), draw.log_uniform(0.1, 10), draw.uniform(0, 6.28)
    factor = {-2: "(x^2 + y^2)^1.5", -1: "(x^2 + y^2)", -0.5: "(x^2 + y^2)^0.75"}[p]
    x, y = r0 * math.cos(angle), r0 * math.sin(angle)
    ends = math.hypot(x, y)**(1 - p) / ((1 - p) * c)
    method, tolerance = draw.one_of(["", "--method dop853", "--method series", "--method ode45"]), draw.log_uniform(1e-11, 1e-4)
    r = ran(["integrators", "integrate", "--equation", f"x' = -{c!r}*x/{factor}; y' = -{c!r}*y/{factor}", "--initial", f"{x!r},{y!r}",
             "--until", repr(ends * draw.uniform(1.1, 5)), "--tolerance", repr(tolerance), *method.split()])
    said = re.search(r"becomes zero at t = ([^ ,:]+)", r.errors)
    if r.exit_code != 1 or not said:
        return wrong(f"{r.words}: {r.errors}") if r.exit_code == 0 else failed(r)
    return judged(abs(number(said[1]) - ends), ends * (MOST_TOLERANCES * tolerance + 1e-2), f"{r.words}: {r.errors}")


def judged_end(case, r, tolerance):
    """A solution that ends before the run does: the message names the time."""
    said = re.search(r"becomes zero at t = (\S+?):", r.errors)
    if r.exit_code != 1 or not said:
        return failed(r)
    # Towards the end errors grow without bound; nine digits are printed.
    bound = case.moved(MOST_AMPLIFIED * MOST_TOLERANCES * tolerance) + 1e-8 * case.ends
    return judged(abs(number(said[1]) - case.ends), bound, f"{r.words}: {r.errors}")


def answered(draw, case):
    tolerance = draw.log_uniform(1e-11, 1e-3) if draw.chance(0.3) else None
    words = ["integrators", "integrate", "--equation", case.text.replace(" ", ""), "--initial", ",".join(map(repr, case.x0)),
             "--from", repr(case.t0), "--until", repr(case.t1)]
    if tolerance:
        words += ["--tolerance", repr(tolerance)]
    if draw.chance(0.3):
        words += ["--every", repr((case.t1 - case.t0) / draw.whole(2, 12))]
    r = ran(" ".join(words))
    if case.ends < case.t1 and r.exit_code:  # else it is to be empty
        return judged_end(case, r, tolerance or 1e-9)
    if r.exit_code:
        return failed(r)
    if "not verified" in r.errors:
        return undecided(f"{r.words}: {r.errors}")
    rows = [[number(cell) for cell in row] for row in r.rows]
    if not all(math.isfinite(c) for row in rows for c in row) or rows[-1][0] != case.t1:
        return wrong(r.words + ": rows")
    truth = [[mpf(x) for x in case.x0]] + [case.solution(mpf(row[0])) for row in rows[1:]]
    size = [max(map(abs, column)) for column in zip(*truth)]
    said = re.search(r"verified: (.*?) digits", r.errors)
    tolerance, worst = tolerance or 1e-9, 0
    for row, x in zip(rows, truth):
        for found, exact, most in zip(row[1:], x, size):
            error = abs(found - exact)
            if said:
                # At components within the tolerances digits are not asked for.
                worst = max(worst, min(relative(error, exact, most) / mpf(10)**-number(said[1]),
                                       error / (tolerance * (1 + abs(exact))) / MOST_TOLERANCES))
            else:
                one = tolerance * (1 + abs(exact)) + 16 * EPS * most
                worst = max(worst, error / one / MOST_TOLERANCES)
    return judged(worst, SLACK, f"{r.words}: {r.errors}")
