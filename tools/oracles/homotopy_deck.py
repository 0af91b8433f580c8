"""Reference values for the frames of chapters/homotopy/frames (tables/frames/deck.csv), without elements: the members as Euler's elastica that
shortens, integrated from node to node in decimal arithmetic, or a closed form.

A frame is a chain of rods, straight or circular at rest, with dead loads at their ends and along them. With the force (h, v) across every section and the moment m:
theta' = m/EI + kappa, x' = (1 + N/EA) cos theta, y' = (1 + N/EA) sin theta, m' = (1 + N/EA) (h sin theta - v cos theta),
N = h cos theta + v sin theta, over the length at rest. Force, moment (or rotation) at the first end and the load factor are found by shooting, for a given
displacement of a node: roughly in doubles, then in all digits."""
import decimal
import math
import pathlib
import tomllib
from decimal import Decimal as D

from shared.chain import linear
from shared.extrapolation import Extrapolation, cosine_sine, digits
from shared.rows import head, row

digits(26)
FILES = pathlib.Path(__file__).resolve().parents[2] / "chapters/homotopy/frames"


def arcsine(x):
    """Of a Decimal, from the double by Newton's iteration."""
    a = D(math.asin(x))
    for _ in range(3):
        cosine, sine = cosine_sine(a)
        a -= (sine - x) / cosine
    return a


def direction(dx, dy):
    """The angle of a vector of Decimals."""
    a = D(math.atan2(dy, dx))
    for _ in range(3):
        cosine, sine = cosine_sine(a)
        a -= (sine * dx - cosine * dy) / (cosine * dx + sine * dy)
    return a


class Rod:
    def __init__(self, member, a, b):
        dx, dy = b[0] - a[0], b[1] - a[1]
        self.length, self.angle, self.bend = (dx * dx + dy * dy).sqrt(), direction(dx, dy), D(0)
        self.ea, self.ei = D(str(member["EA"])), D(str(member["EI"]))
        if "radius" in member:  # clockwise if positive
            radius = D(str(member["radius"]))
            half = arcsine(self.length / (2 * radius))
            self.length, self.angle, self.bend = 2 * half * radius, self.angle + half, -1 / radius
        self.start = cosine_sine(self.angle)
        self.rough = tuple(map(float, (self.length, self.angle, self.bend, self.ea, self.ei)))


class Chain:
    def __init__(self, name, motion):
        frame = tomllib.loads((FILES / f"{name}.toml").read_text())
        places = {node: tuple(D(c) for c in at) for node, at in frame["nodes"].items()}  # the doubles of the file
        members = frame["members"]
        self.rods = [Rod(m, *(places[n] for n in m["nodes"])) for m in members]
        self.loads = [[D(str(frame["loads"].get(m["nodes"][1], {}).get(k, 0))) for k in "xy"] for m in members]
        self.lines = [[D(str(frame["loads"].get("-".join(m["nodes"]), {}).get(k, 0))) for k in "xy"] for m in members]
        first, last = members[0]["nodes"][0], members[-1]["nodes"][1]
        self.rest = [tuple(p - q for p, q in zip(places[m["nodes"][1]], places[first])) for m in members]
        held = frame["supports"]
        self.clamped = "rotation" in held[first]
        self.fixed = [k if word in held.get(last, []) else k + 3 for k, word in enumerate(("x", "y", "rotation"))]
        node, word = motion.split(".")
        self.at, self.part = [m["nodes"][1] for m in members].index(node), ("x", "y", "rotation").index(word)

    def along(self, rod, s, h, v, line, number):
        """(x, y, rotation, moment) at the end of a rod under a load along it: in doubles by Runge and Kutta's rule, else to all digits."""
        if number is D:
            c, z = cosine_sine(s[2])
            c0, z0 = rod.start

            def slopes(arc, w):
                p, q = h - line[0] * arc, v - line[1] * arc
                stretch, turn = 1 + (p * w[2] + q * w[3]) / rod.ea, w[5] / rod.ei + rod.bend
                return [stretch * w[2], stretch * w[3], -w[3] * turn, w[2] * turn, turn - rod.bend, stretch * (p * w[3] - q * w[2])]

            start = [s[0], s[1], c0 * c - z0 * z, z0 * c + c0 * z, s[2], s[3]]
            x, y, _, _, rotation, m = Extrapolation(slopes, "1e-21", 10, rod.length / 2).run(0, start, rod.length)
            return [x, y, rotation, m]
        length, angle, bend, ea, ei = rod.rough
        steps, w = 24, list(s)
        step = length / steps

        def slope(arc, w):
            c, z = math.cos(angle + bend * arc + w[2]), math.sin(angle + bend * arc + w[2])
            p, q = h - line[0] * arc, v - line[1] * arc
            stretch = 1 + (p * c + q * z) / ea
            return stretch * c, stretch * z, w[3] / ei, stretch * (p * z - q * c)

        for k in range(steps):
            arc = k * step
            a = slope(arc, w)
            b = slope(arc + step / 2, [p + step / 2 * q for p, q in zip(w, a)])
            c = slope(arc + step / 2, [p + step / 2 * q for p, q in zip(w, b)])
            d = slope(arc + step, [p + step * q for p, q in zip(w, c)])
            w = [p + step / 6 * (i + 2 * (j + l) + n) for p, i, j, l, n in zip(w, a, b, c, d)]
        return w

    def shoot(self, u, number):
        """What the conditions at the last end miss, and the displacement."""
        h, v, free, load = u
        s = [number(0), number(0), number(0) if self.clamped else free, free if self.clamped else number(0)]
        for k, (rod, rest) in enumerate(zip(self.rods, self.rest)):
            line = [load * number(c) for c in self.lines[k]]
            s = self.along(rod, s, h, v, line, number)
            moved = [s[0] - number(rest[0]), s[1] - number(rest[1]), s[2]]
            if k == self.at:
                displacement = moved[self.part]
            h, v = (force - p * number(rod.length) - load * number(at) for force, p, at in zip((h, v), line, self.loads[k]))
        every = [*moved, h, v, s[3]]
        return [every[k] for k in self.fixed] + [displacement]

    def slopes(self, u, number, base):
        """Differences of shoot() by the unknowns, a row each."""
        small, columns = D("1e-12") if number is D else 1e-7, []
        for i in range(4):
            step = small * max(abs(u[i]), number(1) / 1000)
            there = self.shoot([c + step * (i == k) for k, c in enumerate(u)], number)
            columns.append([(p - q) / step for p, q in zip(there, base)])
        return list(zip(*columns))

    def solve(self, u, displacement, number):
        """By Newton's iteration: the unknowns and the slope of the load over the displacement."""
        fine = D("1e-12") if number is D else 1e-6  # the next step would be as small as its square
        for _ in range(30):
            misses = self.shoot(u, number)
            rows = self.slopes(u, number, misses)
            misses[3] -= displacement
            move = linear(rows, misses)
            u = [p - q for p, q in zip(u, move)]
            if max(abs(q) / (abs(p) + number(1) / 1000000) for p, q in zip(u, move)) < fine:
                return u, linear(rows, [number(0)] * 3 + [number(1)])
        raise ArithmeticError("no convergence")

    def reach(self, displacement, parts, u=(0.0,) * 4):
        """In doubles, along the displacement."""
        first, u = self.shoot(u, float)[3], list(u)
        slope, step = [0.0] * 4, (displacement - first) / parts
        for k in range(1, parts + 1):
            u, slope = self.solve([p + step * q for p, q in zip(u, slope)], first + k * step, float)
        return u

    def singular(self, u):
        """The determinant of the end conditions under a fixed load: 0 where an equilibrium has a neighbour. By central differences."""
        columns = []
        for i in range(3):
            step = D("1e-7") * max(abs(u[i]), D("1e-3"))
            ahead, behind = (self.shoot([c + sign * step * (i == k) for k, c in enumerate(u)], D) for sign in (1, -1))
            columns.append([(p - q) / (2 * step) for p, q in zip(ahead, behind)])
        (a, b, c), (d, e, f), (g, h, i) = (column[:3] for column in columns)
        return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def root(chain, u, low, high, value):
    """The load at which value(unknowns, slope) vanishes between two displacements: the secant rule."""
    a, b = D(str(low)), D(str(high))
    u, slope = chain.solve([D(c) for c in u], a, D)
    fa = value(u, slope)
    b = a + (b - a) / 16
    for _ in range(30):
        u, slope = chain.solve(u, b, D)
        fb = value(u, slope)
        move = fb * (b - a) / (fb - fa)
        if abs(move) < D("1e-9") * abs(b):
            # A limit point is stationary; where branches cross the load is not, and the last move counts.
            return u[3] - slope[3] * move
        a, b, fa = b, b - move, fb
    raise ArithmeticError("no convergence")


def shot(name, motion, low, high=None, parts=10, first=None, whole=None, wanted=3):
    """The load at a displacement, or between two of them a limit point of the chain or a branch point of the whole. @param first motion and
    displacement by which to set out, where `motion` is of second order at rest
    @param wanted at a displacement: 2 for the moment at the clamped first end instead of the load"""
    chain = Chain(name, motion)
    u = Chain(name, first[0]).reach(first[1], 10) if first else (0.0,) * 4
    u = chain.reach(low, parts, u)
    if high is None:
        return chain.solve([D(c) for c in u], D(str(low)), D)[0][wanted]
    if whole is None:
        return root(chain, u, low, high, lambda u, slope: slope[3])
    every = Chain(whole, motion)
    return root(chain, u, low, high, lambda u, slope: every.singular(u))


def falling_zero(value, low, high):
    """Where a function changes its sign between two Decimals, by bisection to all digits."""
    sign = value(low) > 0
    for _ in range(90):
        middle = (low + high) / 2
        low, high = (middle, high) if (value(middle) > 0) == sign else (low, middle)
    return low


def heavy(weight, load=D(0), ea=D(10) ** 6):
    """The rotation at the clamped base of a column under its weight and a load on its free top, where it is 1; 0 where the column branches: the
    power series of theta'' = -p (1 - p/EA) theta with p = P + w s over the distance s from the top."""
    factors = load - load**2 / ea, weight - 2 * load * weight / ea, -(weight**2) / ea
    a = [D(1), D(0)]
    for n in range(80):
        a.append(-sum(f * a[n - k] for k, f in enumerate(factors) if k <= n) / ((n + 1) * (n + 2)))
    return sum(a)


def shortened(load, ea=D(10) ** 6):
    """P with P (1 - P/EA) = load."""
    return 2 * load / (1 + (1 - 4 * load / ea).sqrt())


def on_spring(x):
    c, z = cosine_sine(x)
    return x * z - c


def braced(x):
    """0 where a clamped column with a spring of stiffness 2 across its top branches: P = 2 a (1 - tan(x)/x), a = 1 - P/EA, x^2 = a P."""
    load = shortened(x * x)
    c, z = cosine_sine(x)
    return load * x * c - 2 * (1 - load / 10**6) * (x * c - z)


def main():
    head()
    down, aside = ("load.y", -20), ("B.x", 0.002)
    for name, load in (
            ("toggle first maximum", shot("toggle", "B.y", -0.2, -0.25)),
            ("toggle first minimum", shot("toggle", "B.y", -0.45, -0.5, 20)),
            ("toggle load at -0.1", shot("toggle", "B.y", -0.1, parts=5)),
            ("toggle load at -0.625", shot("toggle", "B.y", -0.625, parts=30)),
            ("lee first maximum", shot("lee", "load.x", 24, 30, 10, down)),
            ("lee first minimum", shot("lee", "load.x", 88, 93, 160, down)),
            ("lee load at 10", shot("lee", "load.x", 10, None, 10, down)),
            ("lee load at 60", shot("lee", "load.x", 60, None, 100, down)),
            ("half-shallow-arch first maximum", shot("half-shallow-arch", "crown.y", -0.36, -0.42, 20)),
            ("half-shallow-arch first minimum", shot("half-shallow-arch", "crown.y", -1.3, -1.45, 60)),
            ("half-shallow-arch load at -1", shot("half-shallow-arch", "crown.y", -1, parts=50)),
            ("shallow-arch first bifurcation", shot("half-shallow-arch", "crown.y", -0.74, -0.8, 40, whole="shallow-arch")),
            ("shallow-arch second bifurcation", shot("half-shallow-arch", "crown.y", -0.93, -0.97, 50, whole="shallow-arch")),
            ("deep-arch first maximum", shot("deep-arch", "crown.y", -110, -120, 60)),
            ("deep-arch load at -50", shot("deep-arch", "crown.y", -50, parts=30)),
            ("portal first maximum", shot("portal", "B.x", 0.76, 0.768, 125, aside)),
            ("heavy-cantilever load at -0.5", shot("heavy-cantilever", "tip.y", -0.5, parts=20)),
            ("heavy-cantilever moment at -0.5", shot("heavy-cantilever", "tip.y", -0.5, parts=20, wanted=2))):
        row(name, load, 12)
    slope = (D(5) / 4).sqrt() ** -1
    truss = 2 * (1 - slope ** (D(2) / 3)) ** (D(3) / 2)
    row("truss first maximum", truss, 12)
    row("truss first minimum", -truss, 12)
    row("cantilever load at 2/pi", D("0.25"), 12)  # a quarter of the moment that makes a circle makes a quarter of one
    brace = 1 / D(8).sqrt()  # of rigid columns of EA = 1e6
    row("inclined-brace first bifurcation", brace / (1 + brace / 10**6), 12)
    row("level-brace first bifurcation", 1 / (1 + D("1e-6")), 12)
    squared = D("9.869604401089358618834490999876")  # pi^2
    for mode, name in enumerate(("first", "second", "third"), 1):
        euler = squared * mode**2  # P (1 - P/EA) = pi^2 EI n^2/l^2
        row(f"column {name} bifurcation", shortened(euler) / D("9.869604401089358"), 12)  # the load of the file
    # The bent column vibrates with (2 pi a f)^2 = pi^2 (pi^2 - a P), a = 1 - P/EA.
    load = D("9.869604401089358") / 2
    stretch = 1 - load / 10**6
    row("column first frequency at 0.5", (squared - stretch * load).sqrt() / (2 * stretch), 12)
    row("spring-column first bifurcation", shortened(falling_zero(on_spring, D("0.8"), D("0.9")) ** 2), 12)
    row("braced-column first bifurcation", shortened(falling_zero(braced, D("1.6"), D("2.2")) ** 2), 12)
    row("heavy-column first bifurcation", falling_zero(heavy, D(7), D(8)), 12)
    row("loaded-column first bifurcation", falling_zero(lambda load: heavy(D(4), load), D(1), D(2)), 12)
    # A moment of pi/4 turns a joint of stiffness 1 and bends the cantilever by pi/4 each.
    row("joint-cantilever load at 0.9003163", D("0.25"), 12)


main()
