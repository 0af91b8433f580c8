"""The examples of Filipich and Rosales by extrapolation of the midpoint rule: ends, extremes, and what fixed steps of the paper's series and
of Euler's method make of them."""
import math
from decimal import Decimal as D

from shared.extrapolation import Extrapolation, cosine_sine, digits
from shared.rows import head, row

digits(44)
PI = D("3.14159265358979323846264338327950288419717")


def lorenz(b):
    def f(_, s):
        u, v, w = s
        return [10 * (v - u), u * (28 - w) - v, u * v - w * b]

    return f


def duffing(damping):
    """u'' + u'/20 + u^3 = 7.5 cos t; the cosine and sine are carried along."""

    def f(_, s):
        u, v, c, z = s
        return [v, D("7.5") * c - damping * v - u * u * u, -z, c]

    return f


def oscillator(stiffness):
    """x'' + 0.306 x + 5 x' x^2 sin 2t = 0."""

    def f(_, s):
        x, v, c, z = s
        return [v, -stiffness * x - 5 * v * x * x * z, -2 * z, 2 * c]

    return f


def projectile(wind):
    def f(_, s):
        x, y, z, vx, vy, vz = s
        drag = (-z / 1000).exp() / 100
        return [vx, vy, vz, -drag * (vx - 1000 * wind * z), -drag * (vy - 500 * wind * z), -drag * vz - 10]

    return f


def bodies(_, s):
    mass, n = (1, 1, 5, 1), 4
    a = [D(0)] * 12
    for i in range(n):
        for k in range(i + 1, n):
            d = [s[3 * k + c] - s[3 * i + c] for c in range(3)]
            square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
            pull = D("1e-6") / (square * square.sqrt())
            for c in range(3):
                a[3 * i + c] += mass[k] * pull * d[c]
                a[3 * k + c] -= mass[i] * pull * d[c]
    return list(s[12:]) + a


START = {"Lorenz": [0, 1, 0], "Duffing": [3, 4, 1, 0], "oscillator": [D("-0.5"), 0, 1, 0]}
FIELD = {"Lorenz": lorenz(D(8) / 3), "Duffing": duffing(D("0.05")), "oscillator": oscillator(D("0.306"))}
# With the doubles next to these numbers, as a program has them. The oscillator's begins at the double next to pi.
cosine, sine = cosine_sine(2 * (D(math.pi) - PI))
START |= {f"{name} as doubles": start for name, start in START.items()}
START["oscillator as doubles"] = [D("-0.5"), 0, cosine, sine]
FIELD |= {"Lorenz as doubles": lorenz(D(8 / 3)), "Duffing as doubles": duffing(D(0.05)),
          "oscillator as doubles": oscillator(D(0.306))}


def states_at(name, times, tolerance="1e-28"):
    """States at times after the start (of the oscillator: pi)."""
    method, t, y = Extrapolation(FIELD[name], tolerance), D(0), [D(v) for v in START[name]]
    for next_time in times:
        y = method.run(t, y, next_time)
        t = D(next_time)
        yield y


def ends():
    for which in ("", " as doubles"):
        times = [20, 40] if which else [20]
        for t, state in zip(times, states_at(f"Lorenz{which}", times, "1e-36")):
            for name, value in zip("uvw", state):
                row(f"Lorenz{which} {name}({t})", value, 16)
        for t, state in zip((50, 100), states_at(f"Duffing{which}", [50, 100], "1e-30")):
            row(f"Duffing{which} u({t})", state[0], 16)
            row(f"Duffing{which} v({t})", state[1], 16)
        duration = D(375 + math.pi) - D(math.pi) if which else D(375)
        (end,) = states_at(f"oscillator{which}", [duration])
        row(f"oscillator{which} x", end[0], 15)
        row(f"oscillator{which} v", end[1], 15)
    y = [0, 0, 0, 3, 0, 0, 3, 4, 0, D("1.5"), D("1.5"), 0] + [0] * 9 + [D("-0.00125"), D("0.0005"), D("0.0005")]
    y = Extrapolation(bodies, "1e-24", 11, "20").run(0, y, 3000)
    for body in (1, 4):
        for c in range(3):
            row(f"bodies {'xyz'[c]} of {body}", y[3 * (body - 1) + c], 16)


def flight():
    """Landing and highest point by Newton's iteration on the time."""
    start = [0, 0, 0, 400, 0, 50]
    calm = Extrapolation(projectile(0), "1e-26")
    method = Extrapolation(projectile(1), "1e-26")

    def meet(f, place, t, y):
        for _ in range(8):
            at = -y[place] / f(t, y)[place]
            y, t = Extrapolation(f, "1e-26").run(t, y, t + at), t + at
        return t, y

    t, y = meet(projectile(1), 5, D("4.9"), method.run(0, start, "4.9"))
    row("projectile highest at", t, 18)
    row("projectile height", y[2], 18)
    t, y = meet(projectile(1), 2, D("9.8"), method.run(D("4.9"), method.run(0, start, "4.9"), "9.8"))
    row("projectile lands at", t, 15)
    row("projectile x", y[0], 15)
    row("projectile y", y[1], 15)
    _, y = meet(projectile(0), 2, D("9.8"), calm.run(0, start, "9.8"))
    row("projectile x without wind", y[0], 15)


def extremes():
    """Least and greatest first component, by parabolas through samples 0.005 apart."""
    for name, end in (("Lorenz", 20), ("Duffing", 100), ("oscillator", 375 - math.pi)):
        h = D("0.005") if name == "Lorenz" else D("0.02")
        states = [START[name]] + list(states_at(name, [k * h for k in range(1, int(end / float(h)) + 1)], "1e-18"))
        values = [float(s[0]) for s in states]
        tops, lows = [], []
        for a, b, c in zip(values, values[1:], values[2:]):
            if (b - a) * (b - c) > 0:
                (tops if b > a else lows).append(b - (c - a) ** 2 / (8 * (a - 2 * b + c)))
        row(f"{name} least", min(lows), 5)
        row(f"{name} greatest", max(tops), 5)


# ---------------------------------------------------------------------------------- fixed steps of the paper's series

def lorenz_series(s, n):
    u, v, w = [s[0]], [s[1]], [s[2]]
    for k in range(n):
        uw, uv = sum(u[i] * w[k - i] for i in range(k + 1)), sum(u[i] * v[k - i] for i in range(k + 1))
        u.append(10 * (v[k] - u[k]) / (k + 1))
        v.append((28 * u[k] - uw - v[k]) / (k + 1))
        w.append((uv - w[k] * 8 / 3) / (k + 1))
    return [u, v, w]


def product(a, b, k):
    return sum(a[i] * b[k - i] for i in range(k + 1))


def duffing_series(s, n):
    u, v, c, z, square = [s[0]], [s[1]], [s[2]], [s[3]], []
    for k in range(n):
        square.append(product(u, u, k))
        v.append((D("7.5") * c[k] - v[k] / 20 - product(square, u, k)) / (k + 1))
        u.append(v[k] / (k + 1))
        c.append(-z[k] / (k + 1))
        z.append(c[k] / (k + 1))
    return [u, v[:n], c, z]  # the velocity is the derivative of u's series (57)


SERIES = {"Lorenz": lorenz_series, "Duffing": duffing_series}


def printed(name, step, order, end):
    """Errors, the largest of the components, at the ends of steps, those of the first component, and the last state."""
    times = [k * D(step) for k in range(1, int(D(end) / D(step)) + 1)]
    s, errors, first, components = [D(v) for v in START[name]], [], [], 3 if name == "Lorenz" else 2
    for t, exact in zip(times, states_at(name, times, "1e-30" if name == "Lorenz" else "1e-24")):
        s = [sum(c * D(step) ** k for k, c in enumerate(a)) for a in SERIES[name](s, order)]
        errors.append((t, max(abs(a - b) for a, b in zip(s[:components], exact))))
        first.append((t, abs(s[0] - exact[0])))
    return errors, first, s


def first_above(errors, bound):
    return next(t for t, error in errors if error > D(bound))


def fixed_steps():
    errors, _, end = printed("Lorenz", "0.1", 20, 20)
    row("Lorenz T = 0.1: u(20)", end[0], 3)
    row("Lorenz T = 0.1: error at 0.5", errors[4][1], 2)
    row("Lorenz T = 0.1: above 0.1 from", first_above(errors, "0.1"), 1)
    row("Lorenz T = 0.1: above 1 from", first_above(errors, 1), 2)
    row("Lorenz T = 0.05: above 0.1 from", first_above(printed("Lorenz", "0.05", 20, 28)[0], "0.1"), 3)
    errors, first, _ = printed("Duffing", "0.35", 20, 100)
    row("Duffing T = 0.35: greatest error to 100", max(e for _, e in errors), 3)
    row("Duffing T = 0.35: greatest error to 50", max(e for t, e in errors if t <= 50), 3)
    row("Duffing T = 0.35: greatest error of u to 50", max(e for t, e in first if t <= 50), 3)
    row("Duffing T = 0.35: above 1e-3 from", first_above(errors, "1e-3"), 3)
    row("Duffing T = 0.35: above 0.1 from", first_above(errors, "0.1"), 4)


# ---------------------------------------------------------------------------------- Euler's method and sections, in doubles

def acceleration(t, x, v):
    return -0.306 * x - 5 * v * x * x * math.sin(2 * t)


def runge_kutta(t, x, v, h, steps):
    for _ in range(steps):
        k1, l1 = v, acceleration(t, x, v)
        k2, l2 = v + h / 2 * l1, acceleration(t + h / 2, x + h / 2 * k1, v + h / 2 * l1)
        k3, l3 = v + h / 2 * l2, acceleration(t + h / 2, x + h / 2 * k2, v + h / 2 * l2)
        k4, l4 = v + h * l3, acceleration(t + h, x + h * k3, v + h * l3)
        x, v, t = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4), t + h
    return x, v


def euler(h, is_over):
    """The first time, counted from 0, at which is_over(x by Euler, x exact)."""
    t, x, v, exact = math.pi, -0.5, 0.0, (-0.5, 0.0)
    parts = max(1, round(h / 0.005)) * 2
    while True:
        exact = runge_kutta(t, *exact, h / parts, parts)
        x, v, t = x + h * v, v + h * acceleration(t, x, v), t + h
        if is_over(x, exact[0]):
            return t


def divergence():
    for h in (0.125, 0.1, 0.05, 0.02, 0.01, 0.005):
        row(f"Euler departs with h = {h}", euler(h, lambda x, y: abs(x - y) > 0.05), 2 if h == 0.125 else 3)
    for h in (0.125, 0.1):
        row(f"Euler above 1 with h = {h}", euler(h, lambda x, _: abs(x) > 1), 3)


def sections():
    """The orbit of 31 sections, symmetric in time: v vanishes half-way. And the island round it through x = -0.5."""
    half = PI * 31 / 2

    def v(x):
        return Extrapolation(FIELD["oscillator"], "1e-24").run(0, [x, 0, 1, 0], half)[1]

    a, b = D("-0.5001357"), D("-0.5001358")
    fa, fb = v(a), v(b)
    for _ in range(6):
        a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
        fb = v(b)
        if abs(b - a) < D("1e-18"):
            break
    row("period 31 at", b, 15)
    x, y, xs, ys = -0.5, 0.0, [-0.5], [0.0]
    for _ in range(90):  # a turn round the island takes 81
        for k in range(31):
            x, y = runge_kutta(math.pi, x, y, math.pi / 200, 200)
        xs.append(x)
        ys.append(y)
    row("island width along x", max(xs) - min(xs), 2)
    row("island width along v", max(ys) - min(ys), 2)


def main():
    head()
    ends()
    flight()
    extremes()
    fixed_steps()
    divergence()
    sections()


main()
