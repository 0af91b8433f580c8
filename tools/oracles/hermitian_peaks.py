"""First peaks of Laier's two oscillators by the operators of his Table 1 (misprints corrected), with fixed steps, in doubles.

Each operator is A y0 + B y1 + h (C v0 + D v1) + h^2 (E a0 + F a1) + h^3 (G j0 + H j1) = 0; two of them give y1 and v1 by Newton's iteration
with differences. Between ends the solution is the polynomial of degree 5 through positions, velocities and accelerations."""
import math

from shared.chain import linear
from shared.rows import head, row

OPERATORS = {
    "Laier": ((12, -12, 6, 6, 1, -1, 0, 0), (0, 0, 12, -12, 6, 6, 1, -1)),
    "Argyris": ((1, -1, 1, 0, 21 / 60, 9 / 60, 3 / 60, -2 / 60), (0, 0, 1, -1, 6 / 12, 6 / 12, 1 / 12, -1 / 12)),
    "Newmark": ((0, 0, -1, 1, -1 / 2, -1 / 2, 0, 0), (-1, 1, -1, 0, -1 / 4, -1 / 4, 0, 0)),
}


def duffing(t, y, v):
    """Acceleration and jerk of y'' + 0.4 y' + y + 0.5 y^3 = 0.5 cos 0.5 t."""
    a = 0.5 * math.cos(0.5 * t) - 0.4 * v - y - 0.5 * y**3
    return a, -0.25 * math.sin(0.5 * t) - 0.4 * a - v - 1.5 * y * y * v


def van_der_pol(t, y, v):
    """Of y'' - 1.5 (1 - y^2) y' + y = 0."""
    a = 1.5 * (1 - y * y) * v - y
    return a, 1.5 * ((1 - y * y) * a - 2 * y * v * v) - v


def step(pair, f, t, y, v, h):
    a0, j0 = f(t, y, v)

    def lacks(z):
        a1, j1 = f(t + h, *z)
        values = (y, z[0], h * v, h * z[1], h * h * a0, h * h * a1, h**3 * j0, h**3 * j1)
        return [sum(c * q for c, q in zip(operator, values)) for operator in pair]

    z, d = [y + h * v, v], 1e-6
    for _ in range(30):
        r = lacks(z)
        columns = [[(p - q) / (2 * d) for p, q in zip(lacks([c + d * (i == k) for k, c in enumerate(z)]),
                                                      lacks([c - d * (i == k) for k, c in enumerate(z)]))] for i in range(2)]
        move = linear([[columns[j][i] for j in range(2)] for i in range(2)], r)
        z = [p - q for p, q in zip(z, move)]
        if max(map(abs, move)) < 1e-15:
            break
    return z


def first_peak(pair, f, y, v, h, sign):
    t = 0.0
    while True:
        y1, v1 = step(pair, f, t, y, v, h)
        if sign * v > 0 >= sign * v1:
            return between(f, t, h, (y, v), (y1, v1))
        y, v, t = y1, v1, t + h


def between(f, t, h, begin, end):
    """The place where the quintic's slope vanishes, by bisection."""
    (y0, v0), (y1, v1) = begin, end
    a0, a1 = f(t, y0, v0)[0], f(t + h, y1, v1)[0]
    p, q, r = y1 - y0 - h * v0 - h * h * a0 / 2, h * (v1 - v0 - h * a0), h * h * (a1 - a0)
    c = (y0, h * v0, h * h * a0 / 2, 10 * p - 4 * q + r / 2, -15 * p + 7 * q - r, 6 * p - 3 * q + r / 2)
    slope = lambda s: sum(k * b * s ** (k - 1) for k, b in enumerate(c) if k)
    low, high, rising = 0.0, 1.0, slope(0.0) > 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (slope(middle) > 0) == rising else (low, middle)
    return sum(b * low**k for k, b in enumerate(c))


def main():
    head()
    for h in (0.2, 0.1, 0.05):
        for name, pair in OPERATORS.items():
            row(f"Duffing {name} h = {h}", first_peak(pair, duffing, 0.0, 0.0, h, 1), 9 if name != "Newmark" else 6)
            row(f"van der Pol {name} h = {h}", first_peak(pair, van_der_pol, 0.01, 0.0, h, -1), 9 if name != "Newmark" else 6)


main()
