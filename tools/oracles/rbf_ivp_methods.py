"""Errors of classical methods in Tables 4.2, 4.4 and 4.6 of Elgohary 2015, in doubles: the step of each method written out for the three
problems. RMS of a position over the ends of steps (MCPI: over all nodes; ode45: over four values a step), with the start, not normalised.
The exact motion is an elliptic function by its Fourier series where it is free, else Runge and Kutta's rule with short steps."""
import math

from mpmath import mp

from shared.chain import linear
from shared.rows import head, row


class Free:
    """X cn(omega t + phase | m) of x'' + x + x^3 = 0, by the series of cn in the nome."""

    def __init__(self, amplitude, phase=0.0):
        square = amplitude * amplitude
        m = square / (2 * (1 + square))
        omega, k = mp.sqrt(1 + square), mp.ellipk(m)
        nome = mp.exp(-mp.pi * mp.ellipk(1 - m) / k)
        self.rate = float(mp.pi * omega / (2 * k))
        self.shift = float(mp.pi * mp.mpf(phase) / (2 * k))
        scale = 2 * mp.pi * amplitude / (mp.sqrt(m) * k)
        self.terms = [float(scale * nome ** (n + mp.mpf(1) / 2) / (1 + nome ** (2 * n + 1))) for n in range(12)]
        self.period = float(4 * k / omega)

    def __call__(self, t):
        a = self.rate * t + self.shift
        return sum(c * math.cos((2 * n + 1) * a) for n, c in enumerate(self.terms))


def force(t):
    return 2 * t if t <= 0.5 else 2 * (1 - t) if t < 1 else 0.0


class Impact:
    """Exact position: a table of short steps to t = 1, then free from the state there."""

    def __init__(self):
        self.h, self.table, x, v = 1e-3, [(0.0, 0.0)], 0.0, 0.0
        for k in range(1000):
            for i in range(4):
                x, v = runge_kutta(self.acceleration, k * self.h + i * self.h / 4, x, v, self.h / 4)
            self.table.append((x, v))
        energy = mp.mpf(v) ** 2 / 2 + mp.mpf(x) ** 2 / 2 + mp.mpf(x) ** 4 / 4
        amplitude = mp.sqrt(mp.sqrt(1 + 4 * energy) - 1)
        square = amplitude**2
        m, omega = square / (2 * (1 + square)), mp.sqrt(1 + square)
        phase = -mp.ellipf(mp.acos(x / amplitude), m)  # still rising
        self.free = Free(amplitude, phase)

    def __call__(self, t):
        if t >= 1:
            return self.free(t - 1)
        k = int(t / self.h + 1e-9)
        return runge_kutta(self.acceleration, k * self.h, *self.table[k], t - k * self.h)[0]

    @staticmethod
    def acceleration(t, x):
        return force(t) - x - x**3


def runge_kutta(a, t, x, v, h):
    k1, l1 = v, a(t, x)
    k2, l2 = v + h / 2 * l1, a(t + h / 2, x + h / 2 * k1)
    k3, l3 = v + h / 2 * l2, a(t + h / 2, x + h / 2 * k2)
    k4, l4 = v + h * l3, a(t + h, x + h * k3)
    return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)


class Errors:
    """Squares of errors in the order of time."""

    def __init__(self, exact):
        self.exact, self.squares = exact, []
        self.add(0.0, exact(0.0))

    def add(self, t, x):
        self.squares.append((t, (x - self.exact(t)) ** 2))

    def rms(self, end):
        kept = [s for t, s in self.squares if t <= end + 1e-9]
        return math.sqrt(sum(kept) / len(kept))


def by_runge_kutta(errors, a, t, x, v, h, n):
    for k in range(n):
        x, v = runge_kutta(a, t + k * h, x, v, h)
        errors.add(t + (k + 1) * h, x)
    return x, v


def by_central_differences(errors, a, t, x, v, h, n, half_at_begin=False, half_at_end=False):
    """Velocities half a step before positions; with the flags a given or reported velocity is taken for that."""
    if not half_at_begin:
        v -= h / 2 * a(t, x)
    for k in range(n):
        v += h * a(t + k * h, x)
        x += h * v
        errors.add(t + (k + 1) * h, x)
    return (x, v) if half_at_end else (x, v + h / 2 * a(t + n * h, x))


def by_hht(errors, a, t, x, v, h, n, alpha=-0.1):
    """x'' of the end by Newton's iteration on (1 + alpha) g(x1) - alpha g(x0) (1977); Newmark for alpha = 0."""
    beta, gamma = (1 - alpha) ** 2 / 4, 0.5 - alpha
    acceleration = a(t, x)
    for k in range(n):
        old, end = a(t + k * h, x), t + (k + 1) * h
        base, new = x + h * v + h * h * (0.5 - beta) * acceleration, acceleration
        for _ in range(30):
            x1 = base + h * h * beta * new
            lack = new - (1 + alpha) * a(end, x1) + alpha * old
            move = lack / (1 + (1 + alpha) * h * h * beta * (1 + 3 * x1 * x1))
            new -= move
            if abs(move) < 1e-15:
                break
        x, v, acceleration = base + h * h * beta * new, v + h * ((1 - gamma) * acceleration + gamma * new), new
        errors.add(end, x)
    return x, v


class Mcpi:
    """Picard's iteration to its end on Chebyshev's points, every right-hand side to the degree order - 1."""

    def __init__(self, order):
        self.n = n = order
        self.points = [-math.cos(j * math.pi / n) for j in range(n + 1)]
        half = lambda j: 0.5 if j in (0, n) else 1.0
        fit = [[2 / n * half(j) * half(k) * math.cos(k * math.pi * (n - j) / n) for j in range(n + 1)] for k in range(n)]
        cosines = [[math.cos(k * math.pi * (n - j) / n) for k in range(n + 1)] for j in range(n + 1)]
        columns = [self.integral([line[j] for line in fit]) for j in range(n + 1)]
        self.weights = [[sum(c * q for c, q in zip(columns[j], line)) for j in range(n + 1)] for line in cosines]

    @staticmethod
    def integral(c):
        """Chebyshev coefficients of the integral from -1."""
        c = c + [0.0, 0.0]
        out = [0.0] + [((2 * c[0] if k == 1 else c[k - 1]) - c[k + 1]) / (2 * k) for k in range(1, len(c) - 1)]
        out[0] = -sum(b * (-1) ** k for k, b in enumerate(out))
        return out

    def step(self, f, t, y, h):
        """Times and states at the nodes after the start."""
        times, states = [t + h * (s + 1) / 2 for s in self.points], [y] * (self.n + 1)
        for _ in range(80):
            g = [f(time, state) for time, state in zip(times, states)]
            new = [[q + h / 2 * sum(w * r[i] for w, r in zip(line, g)) for i, q in enumerate(y)] for line in self.weights]
            change, states = max(abs(p - q) for a, b in zip(new, states) for p, q in zip(a, b)), new
            if change < 1e-15:
                break
        return times[1:], states[1:]


def mcpi(errors, a, t, x, v, h, n, order):
    method, y = Mcpi(order), [x, v]
    for k in range(n):
        times, states = method.step(lambda s, z: (z[1], a(s, z[0])), t + k * h, y, h)
        for s, z in zip(times, states):
            errors.add(s, z[0])
        y = states[-1]
    return y


def free_acceleration(_, x):
    return -x - x * x * x


def ode45(tolerance, errors, end):
    """MATLAB's: Dormand and Prince's pair, its first step and step control, four values a step by its interpolation."""
    c = (1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1)
    b = ((1 / 5,), (3 / 40, 9 / 40), (44 / 45, -56 / 15, 32 / 9), (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
         (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656), (35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84))
    e = (71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40)
    mid = ((1, -183 / 64, 37 / 12, -145 / 128), (0, 0, 0, 0), (0, 1500 / 371, -1000 / 159, 1000 / 371), (0, -125 / 32, 125 / 12, -375 / 64),
           (0, 9477 / 3392, -729 / 106, 25515 / 6784), (0, -11 / 7, 11 / 3, -55 / 28), (0, 3 / 2, -4, 5 / 2))
    f = lambda y: (y[1], -y[0] - y[0] ** 3)
    t, y, steps = 0.0, (1.0, 0.0), 0
    k0 = f(y)
    rate = max(abs(a) / max(abs(q), 1.0) for a, q in zip(k0, y)) / (0.8 * tolerance**0.2)  # threshold atol/rtol = 1
    h = min(0.1 * end, 1 / rate if rate * 0.1 * end > 1 else 0.1 * end)
    while t < end:
        h = min(0.1 * end, h)
        if 1.1 * h >= end - t:
            h = end - t
        failed = False
        while True:
            k = [k0]
            for weights in b:
                z = tuple(q + h * sum(w * s[i] for w, s in zip(weights, k)) for i, q in enumerate(y))
                k.append(f(z))
            error = h * max(abs(sum(w * s[i] for w, s in zip(e, k))) / max(abs(y[i]), abs(z[i]), 1.0) for i in range(2))
            if error <= tolerance:
                break
            h *= 0.5 if failed else max(0.1, 0.8 * (tolerance / error) ** 0.2)
            failed = True
        steps += 1
        for quarter in (0.25, 0.5, 0.75):
            share = [sum(w * quarter ** (i + 1) for i, w in enumerate(line)) for line in mid]
            errors.add(t + quarter * h, y[0] + h * sum(w * s[0] for w, s in zip(share, k)))
        t, y, k0 = t + h, z, k[-1]
        errors.add(t, y[0])
        if not failed:
            grow = 1.25 * (error / tolerance) ** 0.2
            h = h / grow if grow > 0.2 else 5 * h
    return steps


def table_4_2():
    exact = Free(mp.mpf(1))
    period = exact.period

    def rms(method, h, name, digits, **more):
        errors = Errors(exact)
        method(errors, free_acceleration, 0.0, 1.0, 0.0, h, round(500 / h - 0.5), **more)
        row(f"4.2 {name} to 100 P", errors.rms(100 * period), digits)
        row(f"4.2 {name} to 500", errors.rms(500), digits)

    def literal(method, h, name, digits, **more):
        errors = Errors(exact)
        method(errors, free_acceleration, 0.0, 1.0, 0.0, h, round(500 / h - 0.5), **more)
        row(f"4.2 {name} with P = 4.77", errors.rms(500), digits)

    for run, p in ((rms, period), (literal, 4.77)):
        run(by_central_differences, p / 10, "Explicit-1", 4)
        run(by_central_differences, p / 500, "Explicit-2", 4)
        run(by_runge_kutta, p / 10, "RK4-1", 4)
        run(by_runge_kutta, p / 250, "RK4-2", 4)
        run(by_hht, p / 10, "Newmark-1", 4, alpha=0)
        run(by_hht, p / 500, "Newmark-2", 4, alpha=0)
        run(mcpi, p / 10, "MCPI-1", 3, order=8)
        run(mcpi, p / 2, "MCPI-2", 3, order=16)
    rms(by_hht, period / 10, "HHT-1", 4)
    rms(by_hht, period / 500, "HHT-2", 4)
    for name, tolerance in (("ODE45-1", 1e-6), ("ODE45-2", 1e-9)):
        for what, end in (("100 P", 100 * period), ("500", 500.0)):
            errors = Errors(exact)
            steps = ode45(tolerance, errors, end)
            row(f"4.2 {name} to {what}", errors.rms(end), 4)
            if what == "100 P":
                row(f"4.2 {name} steps", steps, 5)


def table_4_4():
    exact = Impact()
    a = lambda t, x: force(t) - x - x**3

    def run(method, during, after, first={}, second={}, twice=True, **more):
        """Two runs; the end of the first is the start of the second and counts twice, or once."""
        errors = Errors(exact)
        x, v = method(errors, a, 0.0, 0.0, 0.0, during, round(1 / during), **first, **more)
        if twice:
            errors.add(1.0, x)
        method(errors, free_acceleration, 1.0, x, v, after, round(499 / after), **second, **more)
        return errors

    rows = {"RK4-1": run(by_runge_kutta, 0.1, 0.5), "RK4-2": run(by_runge_kutta, 0.05, 0.03),
            "Newmark-1": run(by_hht, 0.1, 0.5, alpha=0), "Newmark-2": run(by_hht, 0.05, 0.03, alpha=0),
            "HHT-1": run(by_hht, 0.1, 0.5), "HHT-2": run(by_hht, 0.05, 0.03)}
    for name, errors in rows.items():
        row(f"4.4 {name} to 499", errors.rms(499), 4)
        row(f"4.4 {name} to 500", errors.rms(500), 4)
    for name, during, after in (("Explicit-1", 0.1, 0.5), ("Explicit-2", 0.005, 0.006)):
        once = run(by_central_differences, during, after, twice=False)
        row(f"4.4 {name} to 500 with its end once", once.rms(500), 4)
        faulty = run(by_central_differences, during, after, {"half_at_end": True}, {"half_at_begin": True})
        row(f"4.4 {name} with the restart fault to 499", faulty.rms(499), 3)
    for name, order, during, after in (("MCPI-1", 6, 0.1, 0.5), ("MCPI-2", 10, 0.5, 2)):
        row(f"4.4 {name} to 500", run(mcpi, during, after, order=order).rms(500), 2)
    # The end time at which most of these come out as printed, to half a unit of their last digit.
    printed = {"RK4-1": ("0.399", 1e-3), "RK4-2": ("2.88e-6", 1e-8), "Newmark-1": ("0.457", 1e-3), "Newmark-2": ("1.46e-2", 1e-4),
               "HHT-1": ("0.405", 1e-3)}
    count = {end: sum(abs(rows[n].rms(end) - float(v)) <= u / 2 for n, (v, u) in printed.items()) for end in range(490, 501)}
    best = max(count, key=count.get)
    row("4.4 end time", best, 3)
    row("4.4 rows as printed at that end", count[best], 1)


def chain(t, y):
    """Table 4.5 with F = 0.2, Omega = sqrt(1/2): y = (x1, x2, x3, v1, v2, v3)."""
    x1, x2, x3, v1, v2, v3 = y
    wall, first, second = 2 * x1 + x1**3 / 5, x1 - x2 + (v1 - v2) / 20, (x2 - x3) / 2
    return [v1, v2, v3, (-wall - first) / 2, 0.2 * math.cos(math.sqrt(0.5) * t) + first - second, 2 * second]


def chain_runge_kutta(t, y, h):
    move = lambda k, s: [a + s * b for a, b in zip(y, k)]
    k1 = chain(t, y)
    k2 = chain(t + h / 2, move(k1, h / 2))
    k3 = chain(t + h / 2, move(k2, h / 2))
    k4 = chain(t + h, move(k3, h))
    return [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4)]


def chain_hht(h, n, alpha):
    beta, gamma = (1 - alpha) ** 2 / 4, 0.5 - alpha
    y, acceleration = [0.0] * 6, chain(0.0, [0.0] * 6)[3:]
    for k in range(n):
        old = chain(k * h, y)[3:]
        x0 = [y[i] + h * y[3 + i] + h * h * (0.5 - beta) * acceleration[i] for i in range(3)]
        v0 = [y[3 + i] + h * (1 - gamma) * acceleration[i] for i in range(3)]
        ends = lambda new: [x0[i] + h * h * beta * new[i] for i in range(3)] + [v0[i] + h * gamma * new[i] for i in range(3)]
        lack = lambda new: [a - (1 + alpha) * b + alpha * c for a, b, c in zip(new, chain((k + 1) * h, ends(new))[3:], old)]
        new = list(acceleration)
        for _ in range(30):
            f, d = lack(new), 1e-6
            columns = [[(p - q) / d for p, q in zip(lack([b + d * (i == j) for j, b in enumerate(new)]), f)] for i in range(3)]
            move = linear([[columns[j][i] for j in range(3)] for i in range(3)], f)
            new = [p - q for p, q in zip(new, move)]
            if max(map(abs, move)) < 1e-14:
                break
        y, acceleration = ends(new), new
        yield y


def chain_central(h, n):
    """Started with v(-h/2) = -h/2 a(0); the damping sees velocities extrapolated to the time of the step, the first time v(-h/2)."""
    x, before = [0.0] * 3, None
    half = [-h / 2 * a for a in chain(0.0, [0.0] * 6)[3:]]
    for k in range(n):
        seen = half if before is None else [1.5 * a - 0.5 * b for a, b in zip(half, before)]
        before, half = half, [v + h * a for v, a in zip(half, chain(k * h, x + seen)[3:])]
        x = [p + h * v for p, v in zip(x, half)]
        yield x + half


def table_4_6():
    h = 0.003125
    exact = [[0.0] * 6]
    for k in range(64000):
        exact.append(chain_runge_kutta(k * h, exact[-1], h))

    def rms(states, step, component):
        squares = [0.0] + [(y[component] - exact[round((k + 1) * step / h)][component]) ** 2 for k, y in enumerate(states)]
        return math.sqrt(sum(squares) / len(squares))

    def runge(step, n):
        y = [0.0] * 6
        for k in range(n):
            y = chain_runge_kutta(k * step, y, step)
            yield y

    for number, step in ((1, 0.625), (2, 0.0625)):
        n = round(200 / step)
        for name, states in (("RK4", runge(step, n)), ("Newmark", chain_hht(step, n, 0.0)), ("HHT", chain_hht(step, n, -0.1))):
            states = list(states)
            row(f"4.6 {name}-{number} x1", rms(states, step, 0), 4)
            row(f"4.6 {name}-{number} v1", rms(states, step, 3), 5)
    for number, step in ((1, 0.625), (2, 0.00625)):
        states = list(chain_central(step, round(200 / step)))
        for i in range(3):
            row(f"4.6 Explicit-{number} x{i + 1}", rms(states, step, i), 5)
    for number, order, step in ((1, 6, 0.625), (2, 12, 4.0)):
        method, y, squares = Mcpi(order), [0.0] * 6, {0: [0.0], 3: [0.0]}
        for k in range(round(200 / step)):
            times, states = method.step(chain, k * step, y, step)
            for t, z in zip(times, states):
                near = int(t / h + 1e-9)
                exact_state = chain_runge_kutta(near * h, exact[near], t - near * h)
                for i in (0, 3):
                    squares[i].append((z[i] - exact_state[i]) ** 2)
            y = states[-1]
        for i, what in ((0, "x1"), (3, "v1")):
            row(f"4.6 MCPI-{number} {what}", math.sqrt(sum(squares[i]) / len(squares[i])), 3)


def main():
    head()
    table_4_6()
    table_4_2()
    table_4_4()


main()
