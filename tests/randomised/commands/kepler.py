"""Kepler's motion by its classical equation in many digits, its condition by differences, and random states."""
import math

from mpmath import mp

# For revolutions up to 1e20 and cancellation near the parabola and near the centre.
DIGITS = 100


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return mp.sqrt(dot(a, a)) if isinstance(a[0], mp.mpf) else math.hypot(*a)


def distance(a, b):
    return norm([mp.mpf(x) - y for x, y in zip(a, b)])


def combined(a, x, b, y):
    """a x + b y."""
    return [a * u + b * v for u, v in zip(x, y)]


def root_of(value_and_slope, low, high, x):
    """The root of a growing function between two bounds, by Newton's iteration kept inside a bracket."""
    for i in range(1, 2000):
        value, slope = value_and_slope(x)
        if value < 0:
            low = x
        else:
            high = x
        change = value / slope if slope > 0 else mp.inf
        x -= change
        if abs(change) <= mp.sqrt(mp.eps) / 1000 * abs(x):  # what is left goes with its square
            break
        if not low < x < high or i % 16 == 0:
            x = (low + high) / 2
    return x


def conic(r, v, t, mu):
    """Position and velocity where Kepler's motion leads to from r and v in the time t: E - e sin E = M, e sinh H - H = N, or Barker's equation,
    in the frame of the periapsis. A straight line passes through the centre as the limit of thin ellipses does: it returns. In the digits of
    mpmath's context."""
    r, v, t, mu = [mp.mpf(x) for x in r], [mp.mpf(x) for x in v], mp.mpf(t), mp.mpf(mu)
    r0 = norm(r)
    alpha, h, along = 2 / r0 - dot(v, v) / mu, cross(r, v), dot(r, v) / mp.sqrt(mu)
    p = dot(h, h) / mu
    apse = combined(1 / mu, cross(v, h), -1 / r0, r)
    e = norm(apse)
    x = [c / (e or r0) for c in (apse if e else r)]
    y = cross([c / norm(h) for c in h], x) if p else [mp.mpf(0)] * 3

    def in_frame(px, py, vx, vy):
        return combined(px, x, py, y), combined(vx, x, vy, y)

    if alpha > 0:
        a, n = 1 / alpha, mp.sqrt(mu * alpha) * alpha
        b, turn = mp.sqrt(a * p), 2 * mp.pi
        e0 = mp.atan2(along * mp.sqrt(alpha), 1 - r0 * alpha) if e else mp.mpf(0)
        m = e0 - e * mp.sin(e0) + n * t
        m -= turn * mp.floor(m / turn + 0.5)

        def ellipse(u):
            c, s = mp.cos_sin(u)
            return u - e * s - m, 1 - e * c

        # From above: E - e sin E is at least E^3/pi^2 up to a half turn.
        c, s = mp.cos_sin(root_of(ellipse, m - 2, m + 2, mp.sign(m) * min(abs(m) + e, mp.cbrt(mp.pi**2 * abs(m)))))
        rate = n / (1 - e * c)
        return in_frame(a * (c - e), b * s, -a * s * rate, b * c * rate)
    if alpha < 0:
        a, n = -1 / alpha, mp.sqrt(-mu * alpha) * -alpha
        b = mp.sqrt(a * p)
        h0 = mp.asinh(along * mp.sqrt(-alpha) / e)
        m = e * mp.sinh(h0) - h0 + n * t
        # From above: e sinh H - H is at least e H^3/6, and e sinh H is N + H.
        bound = mp.asinh((abs(m) + mp.cbrt(6 * abs(m) / e)) / e)
        u = root_of(lambda u: (e * mp.sinh(u) - u - m, e * mp.cosh(u) - 1), -2 * bound, 2 * bound, mp.sign(m) * bound)
        c, s = mp.cosh(u), mp.sinh(u)
        rate = n / (e * c - 1)
        return in_frame(a * (e - c), b * s, -a * s * rate, b * c * rate)
    m = p * along + along**3 / 3 + 2 * mp.sqrt(mu) * t
    bound = mp.cbrt(3 * abs(m))
    d = root_of(lambda u: (p * u + u**3 / 3 - m, p + u * u), -2 * bound, 2 * bound, mp.sign(m) * bound)
    rate = 2 * mp.sqrt(mu) / (p + d * d)
    return in_frame((p - d * d) / 2, mp.sqrt(p) * d, -d * rate, mp.sqrt(p) * rate)


class Transition:
    """A state after some time and its derivatives by the state at the start, one row for each of the six."""

    def __init__(self, r, v, t, mu):
        self.start, self.time, self.mu = ([mp.mpf(x) for x in r], [mp.mpf(x) for x in v]), mp.mpf(t), mp.mpf(mu)
        with mp.workdps(60):  # of which the differences leave half, less the condition
            self.r, self.v = conic(*self.start, t, mu)
            self.rows = []
            for i in range(6):
                x = self.start[0] + self.start[1]
                step = mp.mpf(10) ** -25 * (norm(x[:3]) if i < 3 else norm(x[3:]) or mp.sqrt(self.mu / norm(x[:3])))
                x[i] += step
                self.rows.append([(a - b) / step for a, b in zip(sum(conic(x[:3], x[3:], t, mu), []), self.r + self.v)])

    def inverse(self):
        """Rows of the inverse: motion under a potential is symplectic, so that its blocks change places."""
        rows = [[None] * 6 for _ in range(6)]
        for i in range(3):
            for j in range(3):
                rows[i][j], rows[i][j + 3] = self.rows[j + 3][i + 3], -self.rows[j][i + 3]
                rows[i + 3][j], rows[i + 3][j + 3] = -self.rows[j + 3][i], self.rows[j][i]
        return rows


def condition(end, since=None):
    """How relative errors of the data of a motion (position and velocity, of which each component has the length of its vector, mu and the
    time) change the distance and the speed at its end: sums of |d(result)/d(d)| |d|/|result|. The motion begins at the start, or at an
    earlier Transition `since`."""
    with mp.workdps(60):
        rows, time, (r0, v0) = end.rows, end.time, end.start
        if since is not None:
            inverse, (r0, v0), time = since.inverse(), (since.r, since.v), end.time - since.time
            columns = list(zip(*end.rows))
            rows = [[mp.fdot(row, column) for column in columns] for row in inverse]
        pull = [-end.mu * x / norm(end.r) ** 3 for x in end.r]
        by_speed = [mp.fdot(v0, [rows[i + 3][k] for i in range(3)]) for k in range(6)]
        found = []
        for begin, result, rate, own in ((0, end.r, end.v, 0), (3, end.v, pull, 1)):
            part = slice(begin, begin + 3)
            kappa = sum(norm(row[part]) * norm(r0 if i < 3 else v0) for i, row in enumerate(rows)) + norm(rate) * abs(time)
            # mu changes what the units of speed and time do: r(r0, c v0, t/c, c^2 mu) = r, v(...) = c v.
            kappa += norm([own * x - s + time * d for x, s, d in zip(result, by_speed[part], rate)]) / 2
            found.append(float(kappa / norm(result)))
        return found


def direction(draw):
    """One in four along an axis."""
    if draw.chance(0.25):
        axis = [0.0, 0.0, 0.0]
        axis[draw.whole(0, 2)] = 1.0 if draw.chance(0.5) else -1.0
        return axis
    v = [draw.normal() for _ in range(3)]
    return [x / (norm(v) or 1) for x in v] if norm(v) else direction(draw)


def state_of(draw, r, mu, speed, angle):
    """A state at the distance r with a speed in units of the circular one, at an angle from outwards."""
    out = direction(draw)
    side = cross(out, direction(draw))
    while norm(side) < 1e-3:
        side = cross(out, direction(draw))
    v = speed * math.sqrt(mu / r)
    return [r * x for x in out], combined(v * math.cos(angle), out, v * math.sin(angle) / norm(side), side)


def any_motion(draw):
    """Position, velocity, time and mu of random conics with their corners: circles, parabolas, straight lines, at rest, grazing the centre."""
    mu, r = draw.log_uniform(1e-6, 1e20), draw.log_uniform(1e-6, 1e12)
    if draw.chance(0.3):
        speed = math.sqrt(2) * (1 + draw.signed_log(1e-17, 0.1))
    elif draw.chance(0.1):
        speed = 0.0
    else:
        speed = draw.log_uniform(1e-6, 1e8 if draw.chance(0.2) else 10)
    angle = draw.uniform(0, math.pi)
    if draw.chance(0.2):
        angle = draw.log_uniform(1e-18, 0.1)
    if draw.chance(0.2):
        angle = math.pi - draw.log_uniform(1e-18, 0.1)
    if draw.chance(0.1):
        angle = math.pi / 2
    start = state_of(draw, r, mu, speed, angle)
    scale = r * math.sqrt(r / mu) / (1 + (speed if draw.chance(0.5) else 0))
    return start, scale * draw.signed_log(1e-8, 1e18 if draw.chance(0.2) else 1e4), mu


def triple(v):
    return ",".join(repr(x) for x in v)
