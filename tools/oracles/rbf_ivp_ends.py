"""End states of the three examples of Elgohary 2015, chapter 4, by extrapolation of the midpoint rule, and closed forms by mpmath."""
import math
from decimal import Decimal as D

from mpmath import mp

from shared.extrapolation import Extrapolation, digits
from shared.rows import head, row

digits(62)
mp.dps = 60


def free(_, s):
    return [s[1], -s[0] - s[0] ** 3]


def rising(t, s):
    return [s[1], 2 * t - s[0] - s[0] ** 3]


def falling(t, s):
    return [s[1], 2 * (1 - t) - s[0] - s[0] ** 3]


def three_masses(fifth, twentieth, omega):
    """Table 4.5 with F = 0.2, Omega = sqrt(1/2); the load's cosine and sine are carried along."""

    def f(_, s):
        x1, x2, x3, v1, v2, v3, c, z = s
        wall, first, second = 2 * x1 + fifth * x1**3, x1 - x2 + twentieth * (v1 - v2), (x2 - x3) / 2
        return [v1, v2, v3, (-wall - first) / 2, fifth * c + first - second, 2 * second, -omega * z, omega * c]

    return f


# The decimals, and the doubles next to them.
CHAINS = {
    "three masses": three_masses(D("0.2"), D("0.05"), D("0.5").sqrt()),
    "three masses as doubles": three_masses(D(0.2), D(0.05), D(math.sqrt(0.5))),
}


def impact():
    run = lambda f, t, y, end: Extrapolation(f, "1e-50", 18, "0.25").run(t, y, end)
    half = run(rising, 0, [0, 0], "0.5")
    one = run(falling, "0.5", half, 1)
    for t, (x, v) in (("1/2", half), ("1", one), ("500", run(free, 1, one, 500))):
        row(f"impact x({t})", x, 40)
        row(f"impact v({t})", v, 40)
    x, v = (mp.mpf(str(a)) for a in one)
    energy = v * v / 2 + x * x / 2 + x**4 / 4
    amplitude = mp.sqrt(mp.sqrt(1 + 4 * energy) - 1)
    row("impact energy", energy, 40)
    row("impact amplitude", amplitude, 40)
    row("impact period", 4 * mp.ellipk(amplitude**2 / (2 * (1 + amplitude**2))) / mp.sqrt(1 + amplitude**2), 40)


def main():
    head()
    row("Duffing period", 4 * mp.ellipk(mp.mpf(1) / 4) / mp.sqrt(2), 50)
    u = mp.sqrt(2) * 500
    cn, sn, dn = (mp.ellipfun(name, u, m=mp.mpf(1) / 4) for name in ("cn", "sn", "dn"))
    row("Duffing x(500)", cn, 40)
    row("Duffing v(500)", -mp.sqrt(2) * sn * dn, 40)
    impact()
    for chain, field in CHAINS.items():
        end = Extrapolation(field, "1e-50", 18, "0.25").run(0, [0] * 6 + [1, 0], 200)
        for name, value in zip(("x1", "x2", "x3", "v1", "v2", "v3"), end):
            row(f"{chain} {name}", value, 40)


main()
