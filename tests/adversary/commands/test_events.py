"""Random events by `integrators integrate`: all zeros of functions whose zeros have closed forms, by all methods, and state changes."""
import math

from cases import EPS, failed, hunt, judged, needs, number, ran, undecided, wrong

needs_integrators = needs("integrators")
METHODS = ["", "", "series", "ode45", "dop853", "adaptive-collocation", "laier"]
TOLERANCE = 1e-9
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
    """An event: its text, times at which it rises, falls and touches zero, and how much errors of x and of t move these, at most."""

    def __init__(self, draw, motion):
        self.rising, self.falling, self.touching = [], [], []
        getattr(self, draw.one_of(["level", "product", "square", "wave", "pulse", "polynomial", "touch", "peak"]))(draw, motion)
        self.is_whole = all(t == 0 or abs(t - motion.end) > 1e-6 * motion.end for t in self.times())

    def times(self):
        return self.rising + self.falling + self.touching

    def crossings(self, m, up, down):
        self.rising, self.falling = m.angles(up), m.angles(down)

    def level(self, draw, m):
        share = draw.uniform(-0.95, 0.95)
        self.text, angle = f"x = {share * m.size!r}", math.acos(share)
        self.crossings(m, [-angle], [angle])

    def product(self, draw, m):
        """x x' = -A^2 w sin(2 (w t + c))/2"""
        share = draw.uniform(-0.95, 0.95)
        self.text, angle = f"x x' = {share * m.size**2 * m.w / 2!r}", math.asin(-share)
        self.crossings(m, [(math.pi - angle) / 2, (3 * math.pi - angle) / 2], [angle / 2, angle / 2 + math.pi])

    def square(self, draw, m):
        share = draw.uniform(0.05, 0.95)
        self.text, angle = f"x^2 = {(share * m.size)**2!r}", math.acos(share)
        self.crossings(m, [-angle, math.pi - angle], [angle, math.pi + angle])

    def wave(self, draw, m):
        """Of time alone, up to 300 periods of the motion's steps."""
        share, k = draw.uniform(-0.95, 0.95), draw.log_uniform(0.1, 100)
        self.text, angle, turn = f"sin({k!r} t) = {share!r}", math.asin(share), 2 * math.pi
        for n in range(math.ceil(k * m.end / turn) + 2):
            self.rising.append((angle + turn * n) / k)
            self.falling.append((math.pi - angle + turn * n) / k)

    def pulse(self, draw, m):
        middle, width, level = draw.uniform(0, m.end), draw.log_uniform(1e-6, 1) * m.end, draw.uniform(0.05, 0.95)
        self.text, off = f"exp(-((t - {middle!r})/{width!r})^2) = {level!r}", width * math.sqrt(-math.log(level))
        self.rising, self.falling = [middle - off], [middle + off]

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
        """Double zeros."""
        which = draw.whole(0, 2)
        if which == 0:
            at = draw.uniform(0, m.end)
            self.text, self.touching = f"(t - {at!r})^2", [at]
        else:
            self.text = ["x^2 = 0", "abs(x) = 0"][which - 1]
            self.touching = m.angles([math.pi / 2, -math.pi / 2])

    def peak(self, draw, m):
        """At the greatest x, which the run has to within its tolerance."""
        self.text, self.touching = f"x = {m.size!r}", m.angles([0])


def matched(found, times, within):
    """Are these the times, each once?"""
    return len(found) == len(times) and all(abs(a - b) <= within for a, b in zip(found, sorted(times)))


@needs_integrators
@hunt(quick=40, full=10_000, least_right=0.7)
def test_events_are_all_there(draw):
    m = Motion(draw)
    a = Asked(draw, m)
    crossing, method = draw.one_of(["", "", " rising", " falling"]), draw.one_of(METHODS)
    words = ["integrators", "integrate", *m.options(), "--event", a.text + crossing, "--tolerance", repr(TOLERANCE)]
    words += ["--method", method] if method else []
    r = ran(words)
    if r.exit_code:
        return failed(r)
    if any(abs(t) <= 1e-6 * m.end or abs(t - m.end) <= 1e-6 * m.end for t in a.times()):
        return undecided(r.words)  # at an end
    inside = [t for t in {"": a.times(), " rising": a.rising, " falling": a.falling}[crossing] if 0 < t < m.end]
    found = [number(row[0]) for row in r.rows if row[-1]]
    # Errors of steps add up over the way; where the function is flat, the time of a zero goes with the root of these.
    error = 100 * TOLERANCE * (1 + m.w * m.end)
    flat = math.sqrt(error) if crossing == "" and a.touching else error / 0.3
    within = (flat * (1 + 1 / m.w) if "x" in a.text else 0) + 1e-7 * flat + 1e-9 * m.end
    if a.touching and crossing == "":
        # A double zero is a row, or named on standard error, or by rounding two zeros.
        named = "cannot be told" in r.errors or "touches" in r.errors
        close = all(any(abs(t - f) <= within for f in found) or named for t in inside)
        return judged(0, 1, r.words) if close and all(any(abs(t - f) <= within for t in inside) for f in found) else wrong(f"{r.words}: {found}, {inside}")
    if "cannot be told" in r.errors:
        return undecided(r.words)
    if a.touching:  # with a direction none, but for rounding there
        stray = [f for f in found if all(abs(t - f) > within for t in inside + a.touching)]
        return wrong(f"{r.words}: {stray}") if stray else judged(0, 1, r.words)
    if not matched(found, inside, max(within, 4 * EPS * m.end)):
        return wrong(f"{r.words}: {len(found)} zeros, {found[:9]}, for {len(inside)}, {sorted(inside)[:9]}")
    return judged(0, 1, r.words)


@needs_integrators
@hunt(quick=15, full=3_000, least_right=0.7)
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
