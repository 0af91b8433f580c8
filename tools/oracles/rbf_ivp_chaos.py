"""Collocation by Gaussians on u'' + u'/20 + u^3 = B cos t from (3, 4), with a derivative matrix free of rounding (60 digits): errors of u at
t = 50 and 100 for B = 7.5, which is chaotic, and B = 0, a transient. The exact motions are found by extrapolation of the midpoint rule. Velocities
are eliminated, and Newton's iteration starts from the constant position at every step."""
import math
from decimal import Decimal as D

from mpmath import mp

from shared.chain import linear
from shared.extrapolation import Extrapolation, digits
from shared.rows import head, row

mp.dps = 60
digits(44)


def nodes(n):
    """Ends and the extremes of Legendre's polynomial of degree n - 1, in [0, 1]."""
    inner = mp.polyroots([mp.mpf(c) for c in slope_of_legendre(n - 1)], maxsteps=500, extraprec=400) if n > 2 else []
    return [mp.mpf(0)] + sorted((mp.re(x) + 1) / 2 for x in inner) + [mp.mpf(1)]


def slope_of_legendre(n):
    """Coefficients of P_n', highest first."""
    before, p = [mp.mpf(1)], [mp.mpf(1), mp.mpf(0)]
    for k in range(2, n + 1):
        shifted, padded = p + [mp.mpf(0)], [mp.mpf(0)] * 2 + before
        before, p = p, [((2 * k - 1) * a - (k - 1) * b) / k for a, b in zip(shifted, padded)]
    return [c * (n - i) for i, c in enumerate(p[:-1])]


def derivative(n, c):
    """Nodes and D = Phi' Phi^-1 on the unit interval, rounded at the end."""
    s = nodes(n)
    phi = mp.matrix(n, n)
    slope = mp.matrix(n, n)
    for i in range(n):
        for j in range(n):
            phi[i, j] = mp.exp(-((c * (s[i] - s[j])) ** 2))
            slope[i, j] = -2 * c * c * (s[i] - s[j]) * phi[i, j]
    d = slope * phi ** -1
    return [float(x) for x in s], [[float(d[i, j]) for j in range(n)] for i in range(n)]


def step(s, d, square, force, t, h, u0, v0):
    """The state at the end of a step, or nothing where Newton's iteration does not converge."""
    n = len(s)
    times, u = [t + h * x for x in s], [u0] * n
    for _ in range(50):
        v = [v0] + [sum(d[i][j] * u[j] for j in range(n)) / h for i in range(1, n)]
        lack = [sum(d[i][j] * v[j] for j in range(n)) / h + v[i] / 20 + u[i] ** 3 - force * math.cos(times[i]) for i in range(1, n)]
        jacobian = [[square[i][j] / h**2 + d[i][j] / (20 * h) + (3 * u[i] ** 2 if i == j else 0) for j in range(1, n)] for i in range(1, n)]
        move = linear(jacobian, lack)
        u = [u0] + [a - b for a, b in zip(u[1:], move)]
        size = max(map(abs, move))
        if size < 1e-11:
            return u[-1], sum(d[-1][j] * u[j] for j in range(n)) / h
        if not size < 1e6:
            return None
    return None


def integrate(n, c, force, steps):
    """States at t = 50 and 100 by so many steps to 50, or how many steps were made before one failed."""
    s, d = derivative(n, c)
    square = [[sum(d[i][k] * d[k][j] for k in range(1, n)) for j in range(n)] for i in range(n)]
    h, u, v, ends = 50 / steps, 3.0, 4.0, []
    for k in range(2 * steps):
        end = step(s, d, square, force, k * h, h, u, v)
        if end is None:
            return k
        u, v = end
        if k + 1 in (steps, 2 * steps):
            ends.append(u)
    return ends


def exact(force):
    def f(_, s):
        u, v, c, z = s
        return [v, D(force) * c - v / 20 - u * u * u, -z, c]

    method = Extrapolation(f, "1e-30")
    half = method.run(0, [3, 4, 1, 0], 50)
    return half, method.run(50, half, 100)


def main():
    head()
    half, end = exact("0")
    for t, state in ((50, half), (100, end)):
        row(f"transient u({t})", state[0], 16)
    short = mp.mpf("0.77") * 4 * mp.ellipk(mp.mpf(1) / 4) / mp.sqrt(2) / 10  # c h of Table 4.2 with 7 nodes
    chaotic = ("chaotic", 7.5, exact("7.5"), ((35, 8), (35, 23), (35, 27), (7, 215), (7, 256)))
    transient = ("transient", 0.0, (half, end), ((35, 8), (35, 27), (35, 32), (7, 256)))
    for name, force, exact_states, runs in (chaotic, transient):
        for n, steps in runs:
            c = mp.mpf(n - 1) / 4 if n == 35 else short
            what = f"{name} N = {n} {steps} steps to 50"
            ends = integrate(n, c, force, steps)
            if isinstance(ends, int):
                row(f"{what}: made", ends, 3)
                continue
            for t, u, state in zip((50, 100), ends, exact_states):
                row(f"{what}: error at {t}", abs(u - float(state[0])), 2)


main()
