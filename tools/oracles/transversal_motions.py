"""Transversal linearisation (Roy) and Hermite's operators (Laier): ends and peaks of their examples by extrapolation of the midpoint rule, and
the area that a block of MTL does not keep."""
from decimal import Decimal as D

from mpmath import mp

from shared.extrapolation import Extrapolation, digits
from shared.rows import head, row

digits(40)
mp.dps = 40


def driven(_, s):
    """x'' + x + x^3 = cos t."""
    x, v, c, z = s
    return [v, c - x - x**3, -z, c]


def van_der_pol(mu):
    return lambda _, s: [s[1], mu * (1 - s[0] * s[0]) * s[1] - s[0]]


def laier(_, s):
    """y'' + 0.4 y' + y + 0.5 y^3 = 0.5 cos 0.5 t."""
    y, v, c, z = s
    return [v, c / 2 - D("0.4") * v - y - y**3 / 2, -z / 2, c / 2]


def peak(f, start, before):
    """The time after `before` at which the velocity vanishes, and the place there: Newton's iteration."""
    t, y = D(before), Extrapolation(f, "1e-30").run(0, start, before)
    for _ in range(8):
        move = -y[1] / f(t, y)[1]
        y, t = Extrapolation(f, "1e-30").run(t, y, t + move), t + move
    return t, y[0]


def block_determinant(p):
    """det of the derivative of one MTL block of p steps h = 0.1 of x'' + x + x^3 = 0 at (1, 0.3), less 1: x(t) is the answer of x'' + x to
    minus the polynomial through the cubes at the p + 1 points. Fixed-point iteration, weights by quadrature."""
    h = mp.mpf("0.1")
    points = [k * h for k in range(p + 1)]

    def basis(k, s):
        return mp.fprod((s - t) / (points[k] - t) for i, t in enumerate(points) if i != k)

    weights = {(l, k): (mp.quad(lambda s: mp.sin(points[l] - s) * basis(k, s), [0, points[l]]),
                        mp.quad(lambda s: mp.cos(points[l] - s) * basis(k, s), [0, points[l]]))
               for l in range(1, p + 1) for k in range(p + 1)}

    def block(x, v):
        places = [x] * (p + 1)
        for _ in range(80):
            places = [x] + [x * mp.cos(t) + v * mp.sin(t) - sum(weights[l, k][0] * places[k] ** 3 for k in range(p + 1))
                            for l, t in enumerate(points) if l]
        t = points[p]
        return places[p], -x * mp.sin(t) + v * mp.cos(t) - sum(weights[p, k][1] * places[k] ** 3 for k in range(p + 1))

    d, x, v = mp.mpf("1e-12"), mp.mpf(1), mp.mpf("0.3")
    (a, b), (c, e) = block(x + d, v), block(x - d, v)
    (f, g), (i, j) = block(x, v + d), block(x, v - d)
    return ((a - c) * (g - j) - (b - e) * (f - i)) / (4 * d * d) - 1


def main():
    head()
    row("driven Duffing x(50)", Extrapolation(driven, "1e-32").run(0, [1, 0, 1, 0], 50)[0], 22)
    row("van der Pol mu = 10 x(40)", Extrapolation(van_der_pol(10), "1e-30").run(0, [2, 0], 40)[0], 19)
    for name, f, start, before in (("Duffing", laier, [0, 0, 1, 0], "2.4"), ("van der Pol", van_der_pol(D("1.5")), [D("0.01"), 0], "4.6")):
        t, y = peak(f, start, before)
        row(f"Laier's {name} peak at", t, 15)
        row(f"Laier's {name} peak", y, 17)
    for p in (1, 2, 3):
        row(f"MTL p = {p} determinant", block_determinant(p), 2)


main()
