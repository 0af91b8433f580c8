"""Analytic continuation of Elgohary 2015, Tables 3.2 and 3.3, with fixed steps: position to degree K, velocity to degree L of Taylor's
series of Kepler's motion, free of rounding. Energy errors are |E/E(0) - 1| after each step, their norm the root of the sum of squares."""
import math as doubles
from decimal import Decimal as D

from mpmath import mp

from shared.extrapolation import digits
from shared.rows import head, row

digits(30)
mp.dps = 30
MU = D("3.986004418e14")
ORBITS = {"LEO": (("1702547.136867679", "6353992.417071098"), ("-7886.014053829254", "2113.051097224035")),
          "HEO": (("2096434.265330419", "7823999.192941453"), ("-8834.757074967362", "2367.266023562654"))}


def series(r, v, n):
    """Coefficients of x and y to degree n: with q = r.r and w = q^(-3/2), w' q = -3/2 q' w, order by order."""
    x, y = [r[0], v[0]], [r[1], v[1]]
    q, w = [], []
    for k in range(n - 1):
        q.append(sum(x[i] * x[k - i] + y[i] * y[k - i] for i in range(k + 1)))
        if k == 0:
            w.append(1 / (q[0] * q[0].sqrt()))
        else:
            w.append(sum((D("-1.5") * i - (k - i)) * q[i] * w[k - i] for i in range(1, k + 1)) / (k * q[0]))
        for c in (x, y):
            c.append(-MU * sum(c[i] * w[k - i] for i in range(k + 1)) / ((k + 1) * (k + 2)))
    return x, y


def energy(r, v):
    return (v[0] ** 2 + v[1] ** 2) / 2 - MU / (r[0] ** 2 + r[1] ** 2).sqrt()


def period(r, v):
    a = -MU / (2 * energy(r, v))
    return D(str(2 * mp.pi * mp.sqrt(mp.mpf(str(a)) ** 3 / mp.mpf(str(MU)))))


def norms(name, degrees, steps, orbits=(5, 10, 20)):
    """The norms after these orbits, and the last state."""
    r, v = [[D(a) for a in pair] for pair in ORBITS[name]]
    start, h, found, total = energy(r, v), period(r, v) / D(str(steps)), [], D(0)
    high = max(degrees) + 1
    powers = [h**i for i in range(high + 1)]
    for k in range(1, round(max(orbits) * steps + 1)):
        both = series(r, v, high)
        r = [sum(c[i] * powers[i] for i in range(degrees[0] + 1)) for c in both]
        v = [sum((i + 1) * c[i + 1] * powers[i] for i in range(degrees[1] + 1)) for c in both]
        total += (energy(r, v) / start - 1) ** 2
        if k in [int(n * steps + 0.5) for n in orbits]:
            found.append(total.sqrt())
    return found, r


def printed(name, order, steps, orbits=(5, 10, 20)):
    """The norms with derivatives by (3.62), (3.66) and (3.68) as printed, in doubles: C(3, 2) for 3/2, and no bracket in the sum."""
    (x, y), (u, v) = [[float(a) for a in pair] for pair in ORBITS[name]]
    mu, step = float(MU), float(period(*[[D(a) for a in pair] for pair in ORBITS[name]])) / steps
    at = lambda: (u * u + v * v) / 2 - mu / doubles.hypot(x, y)
    start, found, total = at(), [], 0.0
    for k in range(1, max(orbits) * steps + 1):
        r, f, g = [(x, y), (u, v)], [], []
        for n in range(order - 1):
            f.append(sum(doubles.comb(n, m) * (r[m][0] * r[n - m][0] + r[m][1] * r[n - m][1]) for m in range(n + 1)))
            if n == 0:
                g.append(f[0] ** -1.5)
            else:
                terms = [doubles.comb(n - 1, m) * 3 * f[m + 1] * g[n - 1 - m] + f[m] * g[n - m] for m in range(1, n)]
                g.append(-(1.5 * f[1] * g[n - 1] + sum(terms)) / f[0])
            r.append(tuple(-mu * sum(doubles.comb(n, m) * r[m][c] * g[n - m] for m in range(n + 1)) for c in (0, 1)))
        terms = [step**j / doubles.factorial(j) for j in range(order + 1)]
        x, y = (sum(terms[j] * r[j][c] for j in range(order + 1)) for c in (0, 1))
        u, v = (sum(terms[j] * r[j + 1][c] for j in range(order)) for c in (0, 1))
        total += (at() / start - 1) ** 2
        if k in [n * steps for n in orbits]:
            found.append(doubles.sqrt(total))
    return found


def kepler(name, time):
    """Position by Kepler's equation. Both states stand at their periapsis or apoapsis to rounding: elements from the state."""
    r, v = [[mp.mpf(a) for a in pair] for pair in ORBITS[name]]
    mu, radius = mp.mpf(str(MU)), mp.hypot(*r)
    a = 1 / (2 / radius - (v[0] ** 2 + v[1] ** 2) / mu)
    sigma, motion = (r[0] * v[0] + r[1] * v[1]) / mp.sqrt(mu), mp.sqrt(mu / a**3)
    f = lambda e: e - (1 - radius / a) * mp.sin(e) + sigma / mp.sqrt(a) * (1 - mp.cos(e)) - motion * time
    e = mp.findroot(f, motion * time)
    big_f, big_g = 1 - a / radius * (1 - mp.cos(e)), time + (mp.sin(e) - e) / motion
    return [big_f * p + big_g * q for p, q in zip(r, v)]


def main():
    head()
    for name, degrees, steps, count in (("LEO", (10, 9), 25, 3), ("LEO", (10, 10), 25, 3), ("LEO", (12, 11), 25, 2), ("LEO", (9, 8), 25, 3),
                                        ("LEO", (8, 8), 25, 2), ("LEO", (9, 9), 19.75, 4), ("HEO", (30, 29), 100, 3),
                                        ("HEO", (17, 18), 100, 4), ("HEO", (30, 29), 72, 4)):
        found, end = norms(name, degrees, steps)
        for orbits, value in zip((5, 10, 20), found):
            row(f"{name} ({degrees[0]} {degrees[1]}) {steps} steps {orbits} orbits", value, count)
        if degrees in ((10, 9), (30, 29)) and steps != 72:
            r, v = [[D(a) for a in pair] for pair in ORBITS[name]]
            exact_position = kepler(name, mp.mpf(str(20 * period(r, v))))
            row(f"{name} position error after 20 orbits", mp.hypot(*[mp.mpf(str(a)) - b for a, b in zip(end, exact_position)]), 2)
    for name, order, steps, count in (("LEO", 10, 25, 3), ("HEO", 30, 100, 2)):
        for orbits, value in zip((5, 10, 20), printed(name, order, steps)):
            row(f"{name} by (3.66) as printed {orbits} orbits", value, count)


main()
