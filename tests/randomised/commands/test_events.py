"""Random events by `integrators integrate`: all zeros of functions whose zeros have closed forms, by all methods, and state changes."""
import math
import re

from cases import EPS, failed, randomised_test, judged, needs, number, ran, undecided, wrong

needs_integrators = needs("integrators")
METHODS = ["", "", "series", "ode45", "dop853", "adaptive-collocation", "laier"]
TOLERANCE = 1e-9
MOST_TOLERANCES = 100
LONGEST = 40.0


class Motion:
    """x'' = -w^2 x from x = A cos(c), x' = -w A sin(c): x = A cos(w t + c)."""

    def __init__(self, draw):
        self.w, self.size, self.phase = draw.log_uniform(0.1, 10), draw.log_uniform(0.1, 10), draw.uniform(-3, 3)
        self.end = draw.log_uniform(1, LONGEST) / min(self.w, 1)
        self.x, self.v = self.size * math.cos(self.phase), -self.w * self.size * math.sin(self.phase)

    def options(self):
        return ["--equation", f"x'' = -{self.w!r}^2 x", "--initial", f"x={self.x!r}, x'={self.v!r}", "--until", repr(self.end)]

    def angles(self, angles):
        """The times at which w t + c is one of these angles up to whole turns."""
        first, last = self.phase, self.w * self.end + self.phase
        return [(a + 2 * math.pi * k - self.phase) / self.w for a in angles
                for k in range(math.floor((first - a) / (2 * math.pi)), math.ceil((last - a) / (2 * math.pi)) + 1)]


class Asked:
    """An event: its text, times at which it rises, falls and touches zero, and by how much these times may be off: by `state`, the error of x in
    units of the amplitude, over the rate at which the function passes zero, and by its rounding."""

    def __init__(self, draw, motion):
        self.rising, self.falling, self.touching = [], [], []
        self.by_state = lambda state: 0.0  # of the time alone
        self.by_rounding = 0.0
        getattr(self, draw.one_of(["level", "product", "square", "wave", "pulse", "polynomial", "touch", "peak", "pole", "jump"]))(draw, motion)

    def times(self):
        return self.rising + self.falling + self.touching

    def crossings(self, m, up, down):
        self.rising, self.falling = m.angles(up), m.angles(down)

    def level(self, draw, m):
        share = draw.uniform(-0.95, 0.95)
        self.text, angle = f"x = {share * m.size!r}", math.acos(share)
        self.crossings(m, [-angle], [angle])
        self.passing(m, math.sin(angle))

    def passing(self, m, sine):
        """x passes a level where x' = -w A sine."""
        self.by_state = lambda state: state / (m.w * sine)
        self.by_rounding = 4 * EPS / (m.w * sine)

    def product(self, draw, m):
        """x x' = -A^2 w sin(2 (w t + c))/2"""
        share = draw.uniform(-0.95, 0.95)
        self.text, angle = f"x x' = {share * m.size**2 * m.w / 2!r}", math.asin(-share)
        self.crossings(m, [(math.pi - angle) / 2, (3 * math.pi - angle) / 2], [angle / 2, angle / 2 + math.pi])
        rate = m.w * math.cos(angle)  # of x x'/(A^2 w); an error of both factors changes that by 2^(1/2) times as much at most
        self.by_state, self.by_rounding = lambda state: math.sqrt(2) * state / rate, 4 * EPS / rate

    def square(self, draw, m):
        share = draw.uniform(0.05, 0.95)
        self.text, angle = f"x^2 = {(share * m.size)**2!r}", math.acos(share)
        self.crossings(m, [-angle, math.pi - angle], [angle, math.pi + angle])
        self.passing(m, math.sin(angle))
        self.by_rounding /= share

    def wave(self, draw, m):
        """Of time alone, up to 300 periods of the motion's steps."""
        share, k = draw.uniform(-0.95, 0.95), draw.log_uniform(0.1, 100)
        self.text, angle, turn = f"sin({k!r} t) = {share!r}", math.asin(share), 2 * math.pi
        for n in range(math.ceil(k * m.end / turn) + 2):
            self.rising.append((angle + turn * n) / k)
            self.falling.append((math.pi - angle + turn * n) / k)
        self.by_rounding = 4 * EPS / (k * math.cos(angle))

    def pulse(self, draw, m):
        middle, width, level = draw.uniform(0, m.end), draw.log_uniform(1e-6, 1) * m.end, draw.uniform(0.05, 0.95)
        self.text, off = f"exp(-((t - {middle!r})/{width!r})^2) = {level!r}", width * math.sqrt(-math.log(level))
        self.rising, self.falling = [middle - off], [middle + off]
        self.by_rounding = 4 * EPS * width**2 / (2 * off)

    def polynomial(self, draw, m):
        """Two zeros near to each other, and a third."""
        a, gap, c = draw.uniform(0, m.end), draw.log_uniform(1e-6, 0.1) * m.end, draw.uniform(0, m.end)
        zeros = sorted([a, a + gap, c])
        self.text = "*".join(f"(t - {z!r})" for z in zeros)
        if min(zeros[1] - zeros[0], zeros[2] - zeros[1]) > 1e-7 * m.end:
            self.rising, self.falling = [zeros[0], zeros[2]], [zeros[1]]
        else:
            self.text = "t - 2*t"

    def touch(self, draw, m):
        """Double zeros. Where the square is within a rounding of what it is a difference of, nothing tells it from zero."""
        which = draw.whole(0, 2)
        if which == 0:
            at = draw.uniform(0, m.end)
            self.text, self.touching, self.by_rounding = f"(t - {at!r})^2", [at], math.sqrt(EPS) * m.end
        else:
            self.text = ["x^2 = 0", "abs(x) = 0"][which - 1]
            self.touching = m.angles([math.pi / 2, -math.pi / 2])
            self.passing(m, 1)

    def pole(self, draw, m):
        """tan has a pole at pi/2 and one at -pi/2, which x passes."""
        self.text = f"tan({draw.uniform(1.7, 3) / m.size!r} x) = 0"
        self.crossings(m, [-math.pi / 2], [math.pi / 2])
        self.passing(m, 1)

    def jump(self, draw, m):
        """From above zero to below it where x = 0."""
        low, high = draw.uniform(-0.9, -0.1), draw.uniform(0.1, 0.9)
        self.text, angles = f"if(x < 0, x - ({low * m.size!r}), x - {high * m.size!r}) = 0", [math.acos(low), math.acos(high)]
        self.crossings(m, [-a for a in angles], angles)
        self.passing(m, min(math.sin(a) for a in angles))

    def peak(self, draw, m):
        """At the greatest x, which the run has to within its error: A (w t)^2/2 below it."""
        self.text, self.touching = f"x = {m.size!r}", m.angles([0])
        self.by_state, self.by_rounding = lambda state: math.sqrt(2 * state) / m.w, math.sqrt(8 * EPS) / m.w


def error_of_state(m, errors):
    """Of x in units of its amplitude, at any phase: 100 tolerances of x and of x', or what the digits say that the command knows."""
    said = re.search(r"verified: (.*?) digits", errors)
    state = MOST_TOLERANCES * TOLERANCE * math.hypot(1 + 1 / m.size, 1 + 1 / (m.w * m.size))
    return max(state, 2 * 10**-number(said[1])) if said else state


def ratio_of(found, times, within):
    """How far off the times are; nothing if they are not these, each once."""
    return max((abs(a - b) / within for a, b in zip(found, sorted(times))), default=0) if len(found) == len(times) else math.inf


@needs_integrators
@randomised_test(quick=40, full=10_000, least_right=0.7)
def test_events_are_all_there(draw):
    m = Motion(draw)
    a = Asked(draw, m)
    crossing, method = draw.one_of(["", "", " rising", " falling"]), draw.one_of(METHODS)
    words = ["integrators", "integrate", *m.options(), "--event", a.text + crossing, "--tolerance", repr(TOLERANCE)]
    words += ["--method", method] if method else []
    r = ran(words)
    if r.exit_code:
        return failed(r)
    # The time itself, and angles of it, are rounded.
    within = a.by_state(error_of_state(m, r.errors)) + a.by_rounding + 8 * EPS * m.end
    if any(abs(t) <= within or abs(t - m.end) <= within for t in a.times()):
        return undecided(r.words)  # at an end
    inside = [t for t in {"": a.times(), " rising": a.rising, " falling": a.falling}[crossing] if 0 < t < m.end]
    found = [number(row[0]) for row in r.rows if row[-1]]
    if a.touching:
        # A double zero is a row, or named on standard error, or by rounding two zeros; with a direction none, but for rounding there.
        stray = [f for f in found if all(abs(t - f) > within for t in a.touching)]
        is_named = crossing or "cannot be distinguished" in r.errors or "touches" in r.errors
        missed = [] if is_named else [t for t in inside if all(abs(t - f) > within for f in found)]
        return wrong(f"{r.words}: {stray}, {missed}") if stray or missed else judged(0, 1, r.words)
    if "cannot be distinguished" in r.errors:
        return undecided(r.words)
    return judged(ratio_of(found, inside, within), 1, f"{r.words}: {len(found)} zeros, {found[:9]}, for {len(inside)}, {sorted(inside)[:9]}")


@needs_integrators
@randomised_test(quick=10, full=3_000, least_right=0.7)
def test_doses_add_up(draw):
    """c' = -k c with a dose at each of some times: a sum of exponential functions."""
    k, dose, c0 = draw.log_uniform(0.01, 10), draw.log_uniform(0.1, 10), draw.one_of([0.0, draw.log_uniform(0.1, 10)])
    first, interval, count = draw.uniform(0.1, 5), draw.log_uniform(0.1, 10), draw.whole(1, 20)
    times = [first + n * interval for n in range(count)]
    end = times[-1] + interval * draw.uniform(0.01, 3)
    method = draw.one_of(METHODS)
    words = ["integrators", "integrate", "--equation", f"c' = -{k!r} c", "--initial", repr(c0), "--until", repr(end), "--tolerance", "1e-9",
             "--event", f"dose: t = {first!r}:{interval!r}:{times[-1] + interval / 2!r}", "--set-at", f"dose: c = c + {dose!r}"]
    r = ran(words + (["--method", method] if method else []))
    if r.exit_code:
        return failed(r)
    found = [number(row[0]) for row in r.rows if row[-1] == "dose"]
    exact = c0 * math.exp(-k * end) + sum(dose * math.exp(-k * (end - t)) for t in times)
    errors = [abs(a - b) for a, b in zip(found, times)] + [abs(number(r.rows[-1][1]) - exact)]
    return judged(max(errors) if len(found) == count else math.inf, 100e-9 * (1 + c0 + count * dose), r.words)


@needs_integrators
@randomised_test(quick=15, full=3_000, least_right=0.7)
def test_balls_bounce(draw):
    """From height h, with restitution e: the k-th time of flight is 2 e^k (2 h/g)^(1/2)."""
    h, g, e = draw.log_uniform(1e-2, 1e3), draw.log_uniform(0.1, 100), draw.uniform(0.3, 1)
    count = draw.whole(1, 12)
    first = math.sqrt(2 * h / g)
    times = [first * (1 + 2 * sum(e**k for k in range(1, n + 1))) for n in range(count)]
    end = times[-1] + first * e**count * draw.uniform(0.2, 1.8)
    method = draw.one_of(METHODS)
    words = ["integrators", "integrate", "--equation", f"y'' = -{g!r}", "--initial", f"y={h!r}, y'=0", "--until", repr(end), "--tolerance", "1e-9",
             "--event", "bounce: y = 0 falling", "--set-at", f"bounce: y' = -{e!r} y'"]
    r = ran(words + (["--method", method] if method else []))
    if r.exit_code:
        return failed(r)
    found = [number(row[0]) for row in r.rows if row[-1] == "bounce"]
    y, v = map(number, r.rows[-1][1:3])
    since = end - times[-1]
    up = e**count * g * first
    # 100 tolerances of each flight, relative to the first.
    size = 100e-9 * count * (h + g * first + 1)
    errors = [abs(a - b) * g * first for a, b in zip(found, times)] + [abs(y - (up * since - g * since**2 / 2)) / (1 + since), abs(v - (up - g * since))]
    return judged(max(errors) if len(found) == count else math.inf, size * (1 + 1 / (g * first)), r.words)
