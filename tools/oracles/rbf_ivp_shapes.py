"""Differentiation by Gaussians on Legendre, Gauss and Lobatto's nodes (Elgohary 2015, chapter 4), free of rounding: 150 digits.

The interpolant of f is Phi a = f with Phi_ij = exp(-(c h)^2 (s_i - s_j)^2) over nodes s in [0, 1]; its slopes are Phi' a. Without a shape the
interpolant is the polynomial. f is the free Duffing oscillator from t = 1.1 on, by Jacobi's functions."""
from mpmath import mp

from shared.rows import head, row

mp.dps = 150
PERIOD = 4 * mp.ellipk(mp.mpf(1) / 4) / mp.sqrt(2)


def nodes(n):
    """Ends and the extremes of Legendre's polynomial of degree n - 1, by Newton's iteration, in [0, 1]."""
    found = []
    for i in range(n):
        x = -mp.cos(mp.pi * i / (n - 1))
        for _ in range(12 if 0 < i < n - 1 else 0):
            before, p = mp.mpf(1), x
            for k in range(2, n):
                before, p = p, ((2 * k - 1) * x * p - (k - 1) * before) / k
            slope = (n - 1) * (before - x * p) / (1 - x * x)
            curve = (2 * x * slope - n * (n - 1) * p) / (1 - x * x)
            x -= slope / curve
        found.append((x + 1) / 2)
    return found


def arc(n, periods):
    """Values and slopes (per step) at the nodes."""
    h, m = periods * PERIOD, mp.mpf(1) / 4
    values, slopes = [], []
    for s in nodes(n):
        u = mp.sqrt(2) * (mp.mpf(1.1) + h * s)
        sn, cn, dn = (mp.ellipfun(name, u, m=m) for name in ("sn", "cn", "dn"))
        values.append(cn)
        slopes.append(-mp.sqrt(2) * h * sn * dn)
    return values, slopes


def gaussian_slopes(s, f, c):
    n = len(s)
    phi = mp.matrix(n, n)
    for i in range(n):
        for j in range(n):
            phi[i, j] = mp.exp(-((c * (s[i] - s[j])) ** 2))
    a = mp.lu_solve(phi, mp.matrix(f))
    return [sum(-2 * c * c * (s[i] - s[j]) * phi[i, j] * a[j] for j in range(n)) for i in range(n)]


def polynomial_slopes(s, f):
    """Barycentric weights."""
    n = len(s)
    w = [1 / mp.fprod(s[i] - s[j] for j in range(n) if j != i) for i in range(n)]
    return [sum(w[j] / w[i] / (s[i] - s[j]) * (f[j] - f[i]) for j in range(n) if j != i) for i in range(n)]


def error(n, periods, c):
    """Largest of a slope at a node, relative to the largest slope."""
    s, (f, slopes) = nodes(n), arc(n, mp.mpf(periods))
    found = gaussian_slopes(s, f, mp.mpf(c)) if c else polynomial_slopes(s, f)
    return max(abs(a - b) for a, b in zip(found, slopes)) / max(map(abs, slopes))


def best(n, periods, low, high, steps):
    """The shape of least error, by a grid and golden sections."""
    s, (f, slopes) = nodes(n), arc(n, mp.mpf(periods))
    top = max(map(abs, slopes))
    miss = lambda c: max(abs(a - b) for a, b in zip(gaussian_slopes(s, f, c), slopes)) / top
    low, high = mp.mpf(low), mp.mpf(high)
    grid = [low + (high - low) * k / steps for k in range(steps + 1)]
    at = min(range(1, steps), key=lambda k: miss(grid[k]))
    a, b, g = grid[at - 1], grid[at + 1], (mp.sqrt(5) - 1) / 2
    for _ in range(16):
        c, d = b - g * (b - a), a + g * (b - a)
        if miss(c) < miss(d):
            b = d
        else:
            a = c
    return (a + b) / 2, miss((a + b) / 2)


def constants(n, c):
    """The largest slope that is made of the constant 1."""
    return max(map(abs, gaussian_slopes(nodes(n), [mp.mpf(1)] * n, mp.mpf(c))))


def main():
    head()
    for n, periods, shapes in ((7, "0.1", (0, "0.05", "0.367", "1", "2")), (15, "0.5", (0, "1", "2", "4")),
                               (35, "1", (0, "1", "4", "6", "8.5", "12")), (60, "1", (0, "14.75"))):
        for c in shapes:
            row(f"N = {n} c h = {c}" if c else f"N = {n} polynomials", error(n, periods, c), 3)
    for n, periods, low, high in ((7, "0.1", "0.3", "0.6"), (15, "0.5", "2", "3")):
        with mp.workdps(60 if n == 7 else 80):
            shape, least = best(n, periods, low, high, 30)
        row(f"N = {n} best c h", shape, 3)
        if n == 15:  # with 7 nodes it is a cusp, as low as the search is fine
            row("N = 15 least error", least, 2)
    row("N = 7 c h = 0.367 slope of 1", constants(7, "0.367"), 2)
    row("N = 35 c h = 8.5 slope of 1", constants(35, "8.5"), 2)


main()
