"""Roots of classical systems of n equations (J. J. More, B. S. Garbow, K. E. Hillstrom, ACM Trans. Math. Softw. 7 (1981) 17-41), by Newton's method with
40 digits from the standard starts, equations written from the paper. Of each the first and the last unknown."""
from mpmath import chebyt, exp, findroot, mp, mpf

from shared.rows import head, row

mp.dps = 40


def badly_scaled(x, y):
    return [10**4 * x * y - 1, exp(-x) + exp(-y) - mpf("1.0001")]


def boundary_value(*x):
    n, h = len(x), mpf(1) / (len(x) + 1)
    z = (0, *x, 0)
    return [2 * z[i] - z[i - 1] - z[i + 1] + h**2 * (z[i] + i * h + 1) ** 3 / 2 for i in range(1, n + 1)]


def integral_equation(*x):
    n, h = len(x), mpf(1) / (len(x) + 1)
    t = [i * h for i in range(n + 1)]
    c = [0] + [(x[j - 1] + t[j] + 1) ** 3 for j in range(1, n + 1)]
    return [x[i - 1] + h / 2 * ((1 - t[i]) * sum(t[j] * c[j] for j in range(1, i + 1))
                                + t[i] * sum((1 - t[j]) * c[j] for j in range(i + 1, n + 1))) for i in range(1, n + 1)]


def tridiagonal(*x):
    z = (0, *x, 0)
    return [(3 - 2 * z[i]) * z[i] - z[i - 1] - 2 * z[i + 1] + 1 for i in range(1, len(x) + 1)]


def banded(*x):
    n = len(x)
    return [x[i] * (2 + 5 * x[i] ** 2) + 1 - sum(x[j] * (1 + x[j]) for j in range(max(0, i - 5), min(n, i + 2)) if j != i)
            for i in range(n)]


def chebyquad(*x):
    n = len(x)
    return [sum(chebyt(i, 2 * z - 1) for z in x) / n - (-mpf(1) / (i * i - 1) if i % 2 == 0 else 0) for i in range(1, n + 1)]


def watson(*x):
    """Half the gradient, written out."""
    n, f = len(x), [mpf(0)] * len(x)
    for i in range(1, 30):
        t = mpf(i) / 29
        inner = sum(x[j - 1] * t ** (j - 1) for j in range(1, n + 1))
        r = sum((j - 1) * x[j - 1] * t ** (j - 2) for j in range(2, n + 1)) - inner**2 - 1
        for j in range(1, n + 1):
            f[j - 1] += r * ((j - 1) * t ** (j - 2) - 2 * inner * t ** (j - 1) if j > 1 else -2 * inner)
    last = x[1] - x[0] ** 2 - 1
    f[0] += x[0] - 2 * x[0] * last
    f[1] += last
    return f


def root(name, f, start):
    x = findroot(f, start, tol=1e-60, maxsteps=100)
    row(f"{name} first", x[0], 17)
    row(f"{name} last", x[len(start) - 1], 17)


head()
h = mpf(1) / 11
root("powell-badly-scaled", badly_scaled, [mpf("1.0981593e-5"), mpf("9.1061467")])
root("watson", watson, [mpf(s) for s in ("-0.0157", "1.0124", "-0.2330", "1.2604", "-1.5137", "0.9930")])
root("chebyquad-7", chebyquad, [mpf(i) / 8 for i in range(1, 8)])
root("discrete-boundary-value", boundary_value, [i * h * (i * h - 1) for i in range(1, 11)])
root("discrete-integral-equation", integral_equation, [i * h * (i * h - 1) for i in range(1, 11)])
root("broyden-tridiagonal", tridiagonal, [mpf(-1)] * 10)
root("broyden-banded", banded, [mpf(-1)] * 10)
