"""Derivatives of Kepler's motion in the plane by initial values and the parameter of attraction: central differences of the closed
form in 60 digits."""
from mpmath import mp, mpf, sqrt, sin, cos, findroot

from shared.rows import head, row

mp.dps = 60


def moved(mu, x, y, u, v, t):
    """The state at t by Lagrange's coefficients; the ellipse from x, y, u, v at 0."""
    r, energy = sqrt(x * x + y * y), (u * u + v * v) / 2
    a = -mu / (2 * (energy - mu / r))
    n, sigma = sqrt(mu / a**3), (x * u + y * v) / sqrt(mu)
    d = findroot(lambda e: e - (1 - r / a) * sin(e) + sigma / sqrt(a) * (1 - cos(e)) - n * t, n * t)
    f, g = 1 - a / r * (1 - cos(d)), a * sigma / sqrt(mu) * (1 - cos(d)) + r * sqrt(a / mu) * sin(d)
    p, q = f * x + g * u, f * y + g * v
    s = sqrt(p * p + q * q)
    df, dg = -sqrt(mu * a) / (r * s) * sin(d), 1 - a / s * (1 - cos(d))
    return p, q, df * x + dg * u, df * y + dg * v


def main():
    """By mu, x, y, x', y' at t = 5/4 from the pericentre of the ellipse of eccentricity 1/2 and semi-major axis 1 with mu = 1."""
    head()
    start = [mpf(1), mpf("0.5"), mpf(0), mpf(0), sqrt(mpf(3))]
    step = mpf(10)**-20
    for j, by in enumerate(("mu", "x", "y", "x'", "y'")):
        ends = []
        for side in (1, -1):
            there = list(start)
            there[j] += side * step
            ends.append(moved(*there, mpf("1.25")))
        for name, after, before in zip(("x", "y", "x'", "y'"), *ends):
            row(f"d{name}/d{by}", (after - before) / (2 * step), 20)


main()
