"""The four arcs of Elgohary 2015, Eq. 5.38, and all arcs of a public problem, by iteration on the semi-latus rectum (Bate, Mueller and White 1971, section 5.4)."""
from mpmath import mp

from shared.rows import head, row

mp.dps = 40
# mu, time, departure, arrival
PRINTED = mp.mpf("3.986e14"), mp.mpf(4320), mp.matrix(["2.87e6", "5.19e6", "2.85e6"]), mp.matrix(["2.09e6", "7.82e6", "0"])
PUBLIC = mp.mpf("398600.4418"), mp.mpf(86400), mp.matrix([20000, 20000, 0]), mp.matrix([-20000, 10000, 0])


class Arc:
    def __init__(self, problem, long_way, revolutions):
        self.mu, self.time, self.start, self.end = problem
        self.revolutions, self.r1, self.r2 = revolutions, mp.norm(self.start), mp.norm(self.end)
        cosine = mp.fdot(self.start, self.end) / (self.r1 * self.r2)
        self.angle = 2 * mp.pi - mp.acos(cosine) if long_way else mp.acos(cosine)
        self.k, self.l, self.m = self.r1 * self.r2 * (1 - cosine), self.r1 + self.r2, self.r1 * self.r2 * (1 + cosine)

    def at(self, p):
        """f, g, g', semi-major axis and time of flight of the ellipse with the semi-latus rectum p."""
        a = self.m * self.k * p / ((2 * self.m - self.l**2) * p**2 + 2 * self.k * self.l * p - self.k**2)
        f = 1 - self.r2 / p * (1 - mp.cos(self.angle))
        g = self.r1 * self.r2 * mp.sin(self.angle) / mp.sqrt(self.mu * p)
        f1 = mp.sqrt(self.mu / p) * mp.tan(self.angle / 2) * ((1 - mp.cos(self.angle)) / p - 1 / self.r1 - 1 / self.r2)
        g1 = 1 - self.r1 / p * (1 - mp.cos(self.angle))
        swept = mp.atan2(-self.r1 * self.r2 * f1 / mp.sqrt(self.mu * a), 1 - self.r1 / a * (1 - f))
        swept += 2 * mp.pi * (self.revolutions + (1 if swept < 0 else 0))
        return f, g, g1, a, g + mp.sqrt(a**3 / self.mu) * (swept - mp.sin(swept))

    def solutions(self):
        """All p at which the time of flight is the given one, between those of the two parabolas."""
        low, high = (self.k / (self.l + s * mp.sqrt(2 * self.m)) for s in (1, -1))
        grid = [low + (high - low) * (1 - mp.cospi(mp.mpf(i) / 800)) / 2 for i in range(1, 800)]
        miss = lambda p: self.at(p)[4] - self.time
        values = [miss(p) for p in grid]
        for p, q, a, b in zip(grid, grid[1:], values, values[1:]):
            if (a < 0) != (b < 0) and abs(a - b) < self.time:
                yield mp.findroot(miss, (p, q), solver="anderson", tol=mp.mpf(10) ** -60)

    def velocities(self, p):
        f, g, g1, _, _ = self.at(p)
        return (self.end - f * self.start) / g, (g1 * self.end - self.start) / g


def main():
    head()
    for name, long_way, revolutions in (("short", False, 0), ("long", True, 0), ("one revolution", False, 1)):
        arc = Arc(PRINTED, long_way, revolutions)
        found = sorted(arc.solutions(), key=lambda p: arc.at(p)[3])
        for i, p in enumerate(found):
            a, (v1, v2) = arc.at(p)[3], arc.velocities(p)
            what = name if len(found) == 1 else f"{name} {('low', 'high')[i]}"
            for axis, value in zip("xyz", v1):
                row(f"{what} v1 {axis}", value, 16)
            if name == "short":
                for axis, value in zip("xyz", v2):
                    row(f"{what} v2 {axis}", value, 16)
            row(f"{what} axis", a, 7)
            row(f"{what} eccentricity", mp.sqrt(1 - p / a), 5)
    for way in ("short", "long"):
        for revolutions in range(4):
            arc = Arc(PUBLIC, way == "long", revolutions)
            for i, p in enumerate(sorted(arc.solutions(), key=lambda p: arc.at(p)[3])):
                for axis, value in zip("xy", arc.velocities(p)[0]):
                    row(f"public {way} {revolutions} {i} v{axis}", value, 16)


main()
