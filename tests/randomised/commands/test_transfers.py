"""Random transfers by `rbf_inverse lambert`, propagated by Kepler's equation or by Taylor series, and random porkchops, whose cells are compared with
the least of all arcs by universal variables."""
import itertools
import math
import tempfile

import taylor
from cases import EPS, failed, randomised_test, judged, needs, number, ran, undecided, worst_of, wrong
from kepler import DIGITS, Transition, combined, condition, conic, cross, direction, distance, dot, norm, state_of, triple
from mpmath import mp

needs_rbf_inverse = needs("rbf_inverse")


class Arc:
    """As the command takes it."""

    def __init__(self, draw):
        self.mu = draw.log_uniform(1e-3, 1e18)
        r, ratio = draw.log_uniform(1e-3, 1e12), 1 if draw.chance(0.2) else draw.log_uniform(0.05, 20)
        self.begin, self.end = [r * x for x in direction(draw)], [r * ratio * x for x in direction(draw)]
        size = max(r, r * ratio)
        self.time = size * math.sqrt(size / self.mu) * draw.log_uniform(1e-2, 1e3 if draw.chance(0.2) else 30)
        self.words = f"rbf_inverse lambert --from {triple(self.begin)} --to {triple(self.end)} --time {self.time!r} --mu {self.mu!r}"
        if dot(self.begin, self.end) < 0 and norm(cross(self.begin, self.end)) <= 8 * EPS * norm(self.begin) * norm(self.end):
            self.words += f" --plane {triple(direction(draw))}"
        if draw.chance(0.3):
            self.words += " --long-way"
        if draw.chance(0.3):
            self.words += f" --revolutions {draw.whole(1, 8)} --branch {draw.one_of(['low', 'high'])}"
        if draw.chance(0.15):
            self.words += " --method collocation"
        self.j2 = self.radius = 0
        if draw.chance(0.3):
            self.j2, self.radius = draw.signed_log(1e-6, 1e-2), min(r, r * ratio) * draw.log_uniform(0.1, 1)
            self.words += f" --zonal {self.j2!r} --radius {self.radius!r}"

    def passages(self, v):
        """When it passes the periapsis on the way, without zonal terms."""
        with mp.workdps(60):
            r, v, mu = [mp.mpf(x) for x in self.begin], [mp.mpf(x) for x in v], mp.mpf(self.mu)
            along, alpha = dot(r, v) / mp.sqrt(mu), 2 / norm(r) - dot(v, v) / mu
            size = mp.sqrt(abs(alpha))
            rate, sine, cosine = mp.sqrt(mu) * size**3, along * size, 1 - norm(r) * alpha
            if alpha > 0:
                mean, turn = mp.atan2(sine, cosine) - sine, 2 * mp.pi
                first = (-mean / turn - mp.floor(-mean / turn)) * turn / rate
                return [first + k * turn / rate for k in range(int((self.time - first) * rate / turn) + 1)] if first < self.time else []
            first = (mp.atanh(sine / cosine) - sine) / rate
            return [first] if 0 < first < self.time else []

    def rounding(self, v):
        """How far 16 roundings of the data may move the arrival; with zonal terms, where the command takes steps, one rounding at each periapsis
        too, where it changes the energy most."""
        kappa = 16 * condition(Transition(self.begin, v, self.time, self.mu))[0]
        if self.j2:
            with mp.workdps(60):
                for t in self.passages(v):
                    kappa += condition(Transition(*conic(self.begin, v, t, self.mu), self.time - t, self.mu))[0]
        return kappa * EPS * norm(self.end)

    def arrival(self, v):
        """Where a departure with this velocity leads to; nothing if it takes too many steps."""
        if not self.j2:
            with mp.workdps(DIGITS):
                return conic(self.begin, v, self.time, self.mu)
        with mp.workdps(60):  # in units of the first distance and of the circular motion there
            unit = norm([mp.mpf(x) for x in self.begin])
            speed, flattening = mp.sqrt(self.mu / unit), 1.5 * mp.mpf(self.j2) * (self.radius / unit) ** 2

            def rates(_t, x, _piece):
                r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2]
                pull, of_j2 = taylor.Power(r2, -3), taylor.Power(r2, -5) * flattening
                z = x[2] * x[2] * taylor.Power(r2, -2) * 5
                across = pull + of_j2 * (1 - z)
                return [*x[3:], -(x[0] * across), -(x[1] * across), -(x[2] * (pull + of_j2 * (3 - z)))]

            start = [x / unit for x in self.begin] + [x / speed for x in v]
            end = taylor.states(rates, start, 0.0, [self.time * speed / unit], order=28, digits=20)
            if not end:
                return None
            state = [mp.ldexp(x, -taylor.BITS) for x in end[0]]
            return [unit * x for x in state[:3]], [speed * x for x in state[3:]]


@needs_rbf_inverse
@randomised_test(quick=20, full=5_000)
def test_transfers_arrive_as_printed(draw):
    """The miss is no more than a millionth of the distance, as the page says, and it is the one that is printed: to its three digits and to what
    rounding leaves. So is the velocity at the arrival, to what a millionth of the distance changes it."""
    a = Arc(draw)
    r = ran(a.words, 10)
    if r.exit_code:
        return failed(r)
    row = [number(cell) for cell in r.rows[0]]
    if len(r.rows) != 1 or len(row) != 7:
        return wrong(r.words + ": rows")
    end, far, rounding = a.arrival(row[:3]), norm(a.end), a.rounding(row[:3])
    of_speed = condition(Transition(a.begin, row[:3], a.time, a.mu))[1]
    if not end or rounding > 1e-7 * far:
        return undecided(r.words)
    miss, printed, speed = float(distance(a.end, end[0])), row[6], norm(row[3:6])
    apart = float(distance(row[3:6], end[1])) / (speed * (16 * of_speed * EPS + 1e-6 * (1 + of_speed)))
    unsaid = abs(miss - printed) / (rounding + 0.01 * printed)
    return judged(max(miss / (1e-6 * far + rounding), unsaid, apart), 1,
                  f"{r.words}: printed {','.join(r.rows[0])}, miss {miss:.3g}, rounding {rounding:.3g}, velocity {apart:.3g}")


def stumpff(m, z):
    """c2(z) and c3(z), in numbers of m: math, or mpmath's mp."""
    if abs(z) < 1:
        c2, c3, term = 0, 0, m.mpf(1) / 2 if m is mp else 0.5
        for k in range(1, 20):  # z^k/(2 k)! and z^k/(2 k + 1)!
            c2, c3 = c2 + term, c3 + term / (2 * k + 1)
            term *= -z / ((2 * k + 1) * (2 * k + 2))
        return c2, c3
    s = m.sqrt(abs(z))
    return (2 * m.sin(s / 2) ** 2 / z, (s - m.sin(s)) / (z * s)) if z > 0 else (2 * m.sinh(s / 2) ** 2 / -z, (m.sinh(s) - s) / (-z * s))


def crossing(f, low, high, tiny):
    """A sign change of f between two bounds, by the method of Illinois; f(low) and f(high) are of either sign or infinite."""
    a, b = f(low), f(high)
    if (a > 0) == (b > 0):
        return None
    for i in range(300):
        x = (low + high) / 2
        if math.isfinite(a) and math.isfinite(b) and i % 3:
            x = high - b * (high - low) / (b - a)
            if not min(low, high) < x < max(low, high):
                x = (low + high) / 2
        y = f(x)
        if y == 0 or abs(high - low) <= tiny * abs(x):
            return x
        if (y > 0) == (b > 0):
            high, b, a = x, y, a / 2 if i % 3 else a
        else:
            low, a, high, b = high, b, x, y
    return x


class Flights:
    """The times of flight between two distances a and b on the short way (c = (2 a b)^(1/2) cos of half of the angle) or the long way (-c), by
    universal variables (R. R. Bate, D. D. Mueller and J. E. White, Fundamentals of Astrodynamics, section 5.3), in numbers of m."""

    def __init__(self, m, a, b, c, mu):
        self.m, self.a, self.b, self.c, self.mu = m, a, b, c, mu

    def y(self, z):
        c2, c3 = stumpff(self.m, z)
        return self.a + self.b + self.c * (z * c3 - 1) / self.m.sqrt(c2), c2, c3

    def time(self, z):
        """0 below the z from which on there are such arcs."""
        y, c2, c3 = self.y(z)
        return (self.m.sqrt(y / c2) ** 3 * c3 + self.c * self.m.sqrt(y)) / self.m.sqrt(self.mu) if y > 0 else 0

    def rounded(self):
        return Flights(math, float(self.a), float(self.b), float(self.c), float(self.mu))

    def roots(self, time, most_revolutions):
        """All z with this time of flight."""
        tiny, turn = (mp.mpf(10) ** -27 if self.m is mp else 1e-15), 2 * self.m.pi

        def late(z):
            return self.time(z) - time

        low = -4 * self.m.mpf(1) if self.m is mp else -4.0
        while late(low) > 0 and low > -1e5:
            low *= 4
        yield crossing(late, low, turn**2 * (1 - 4 * tiny), tiny)
        for n in range(1, most_revolutions + 1):
            bottom, top = (turn * n) ** 2 * (1 + 4 * tiny), (turn * (n + 1)) ** 2 * (1 - 4 * tiny)
            least = lowest(self.rounded().time, float(bottom), float(top))
            if late(least) < 0:
                yield crossing(late, bottom, least, tiny)
                yield crossing(late, least, top, tiny)


def arcs(m, r1, r2, time, mu, most_revolutions):
    """Velocities at both ends of all arcs between two places, in numbers of m."""
    a, b = m.sqrt(dot(r1, r1)), m.sqrt(dot(r2, r2))
    c = m.sqrt(max(a * b + dot(r1, r2), 0))
    for flights in (Flights(m, a, b, c, mu), Flights(m, a, b, -c, mu)):
        for z in flights.roots(time, most_revolutions):
            g = flights.c * m.sqrt(flights.y(z)[0] / mu) if z is not None else 0
            if g:
                f, rate = 1 - flights.y(z)[0] / a, 1 - flights.y(z)[0] / b
                yield [(q - f * p) / g for p, q in zip(r1, r2)], [(rate * q - p) / g for p, q in zip(r1, r2)]


def lowest(f, low, high):
    """The place of the minimum of a function with one, by thirds of the square root of its argument, to what its value needs."""
    low, high = math.sqrt(low), math.sqrt(high)
    for _ in range(60):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        if f(a * a) < f(b * b):
            high = b
        else:
            low = a
    return low * high


class Bodies:
    """Two bodies on ellipses, and one pair of times or a few."""

    def __init__(self, draw):
        self.mu = draw.log_uniform(1e-3, 1e18)
        r, ratio = draw.log_uniform(1e-3, 1e12), draw.log_uniform(0.1, 10)
        time = r * math.sqrt(r / self.mu)  # the scale of a circular motion
        self.states = [state_of(draw, far, self.mu, draw.uniform(0.6, 1.3), draw.uniform(1, 2)) for far in (r, r * ratio)]
        self.epochs = [0.0 if draw.chance(0.5) else time * draw.uniform(-20, 20) for _ in range(2)]
        self.revolutions = 0 if draw.chance(0.5) else draw.whole(1, 4)
        self.rows, self.columns = draw.whole(1, 3), draw.whole(1, 3)
        first = time * draw.uniform(-20, 20)
        self.departures = first, first + time * draw.uniform(0.01, 10)
        first += time * draw.uniform(-2, 10)
        self.arrivals = first, first + time * draw.uniform(0.01, 40)

    def toml(self):
        orbits = "".join(f"[{name}]\nposition = [{triple(r)}]\nvelocity = [{triple(v)}]\nepoch = {epoch!r}\n"
                         for name, (r, v), epoch in zip(("from", "to"), self.states, self.epochs))
        windows = "".join(f"[{name}]\nfirst = {first!r}\nlast = {last!r}\n"
                          for name, (first, last) in (("departures", self.departures), ("arrivals", self.arrivals)))
        return f"mu = {self.mu!r}\nrevolutions = {self.revolutions}\n{orbits}{windows}"

    def place(self, body, t):
        """Its state at a time, and how far its place may be off, with the rounding of the times."""
        way = Transition(*self.states[body], t - mp.mpf(self.epochs[body]), self.mu)
        turns = (abs(t) + abs(self.epochs[body])) * float(norm(way.v) / norm(way.r))
        return way, 16 * EPS * (condition(way)[0] + turns)

    def least(self, m, a, b, time, r1, r2):
        """The least sum of both speeds of all arcs between these places."""
        of = mp.mpf if m is mp else float
        speeds = [combined(1, v1, -1, a.v) + combined(1, v2, -1, b.v)
                  for v1, v2 in arcs(m, list(map(of, r1)), list(map(of, r2)), of(time), of(self.mu), self.revolutions)]
        return min((float(norm(s[:3]) + norm(s[3:])) for s in speeds), default=math.inf)

    def best(self, departure, arrival):
        """The least sum of both speeds, and how far rounded places move it."""
        (a, of_a), (b, of_b) = self.place(0, departure), self.place(1, arrival)
        with mp.workdps(30):
            time, part = mp.mpf(arrival) - departure, 1e-7
            found = self.least(mp, a, b, time, a.r, b.r)
            near, doubt = self.least(math, a, b, time, a.r, b.r), 0
            rounded = of_a + of_b + 16 * EPS * (1 + (abs(departure) + abs(arrival)) / float(time))
            for k in range(6):
                places = [list(a.r), list(b.r)]
                places[k // 3][k % 3] += part * norm(places[k // 3])
                doubt += abs(self.least(math, a, b, time, *places) - near) / part * rounded
        return found, doubt + 64 * EPS * (float(norm(a.v) + norm(b.v)) + found)


def times_of(window, count):
    first, last = window
    return [first if k == 0 else last if k == count - 1 else first + (last - first) * (k / (count - 1)) for k in range(count)]


@needs_rbf_inverse
@randomised_test(quick=20, full=3_000)
def test_porkchops_have_the_least_speeds(draw):
    p = Bodies(draw)
    with tempfile.NamedTemporaryFile("w", prefix="nlmech-test-", suffix=".toml") as file:
        file.write(p.toml())
        file.flush()
        r = ran(f"rbf_inverse porkchop {file.name} --grid {p.rows}x{p.columns} --threads 1")
    what = f"{r.words}\n{p.toml()}"
    if r.exit_code:
        return failed(r)
    cells = [pair for pair in itertools.product(times_of(p.departures, p.rows), times_of(p.arrivals, p.columns)) if pair[1] > pair[0]]
    rows = [[number(cell) for cell in row] for row in r.rows]
    if sorted(map(tuple, cells)) != sorted((row[0], row[1]) for row in rows) or any(len(row) != 5 for row in rows):
        return wrong("not the rows that were asked for: " + what)

    def judged_rows():
        for row in rows:
            found, doubt = p.best(row[0], row[1])
            if doubt < 1e-3 * found:
                yield judged(abs(row[2] + row[3] - found), 4 * doubt, f"{what}\n{row}, right {found!r}")

    return worst_of(judged_rows(), what)
