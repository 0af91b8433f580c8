"""Orbits of Elgohary 2015, section 3.2: a day with J_2 by extrapolation of the midpoint rule, the force in closed form; and the elements
of the printed states."""
from decimal import Decimal as D

from mpmath import mp

from shared.extrapolation import Extrapolation, digits
from shared.rows import head, row

digits(36)
mp.dps = 40
MU, RADIUS, J2 = D("3.986004418e14"), D(6378137), D("1.08262668e-3")

DAYS = {
    "LEO": ("1702547.136867679", "6353992.417071098", "0", "-7886.014053829254", "2113.051097224035", "0"),
    "tilted": ("1702547.136867679", "6353992.417071098", "0", "-3943.007026914627", "1056.5255486120175", "7070.406775"),
    "circular": ("7000000", "0", "0", "0", "4700", "5900"),
}


def oblate(_, s):
    x, y, z, vx, vy, vz = s
    r2 = x * x + y * y + z * z
    pull = -MU / (r2 * r2.sqrt())
    bulge = D("1.5") * J2 * RADIUS**2 / r2
    polar = 5 * z * z / r2
    return [vx, vy, vz, pull * x * (1 + bulge * (1 - polar)), pull * y * (1 + bulge * (1 - polar)), pull * z * (1 + bulge * (3 - polar))]


def days():
    for name, start in DAYS.items():
        end = Extrapolation(oblate, "1e-29", 14, "300").run(0, start, 86400)
        for what, value in zip(("x", "y", "z", "vx", "vy", "vz"), end):
            if value or what not in ("z", "vz"):
                row(f"day of {name} {what}", value, 20)


def vector(*words):
    return mp.matrix([mp.mpf(w) for w in words])


def elements(position, velocity, mu):
    """Semi-major axis, eccentricity, period."""
    r, v2 = mp.norm(position), sum(v * v for v in velocity)
    a = 1 / (2 / r - v2 / mu)
    dot = sum(p * v for p, v in zip(position, velocity))
    e = mp.norm(((v2 - mu / r) * position - dot * velocity) / mu)
    return a, e, 2 * mp.pi * mp.sqrt(a**3 / mu)


def printed():
    low = vector(*DAYS["LEO"][:2]), vector(*DAYS["LEO"][3:5])
    high = vector("2096434.265330419", "7823999.192941453"), vector("-8834.757074967362", "2367.266023562654")
    wgs, older = mp.mpf("3.986004418e14"), mp.mpf("3.98600433e14")
    row("LEO eccentricity", elements(*low, wgs)[1], 9)
    row("LEO period", elements(*low, wgs)[2], 8)
    row("LEO axis with the implied mu", elements(*low, older)[0], 10)
    row("LEO period with the implied mu", elements(*low, older)[2], 8)
    row("HEO eccentricity", elements(*high, wgs)[1], 10)
    row("HEO period with the implied mu", elements(*high, older)[2], 9)


def main():
    head()
    days()
    printed()


main()
