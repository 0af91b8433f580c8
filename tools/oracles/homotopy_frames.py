"""Limit points of plane frames with linear beam-columns as members (Elgohary 2015, section 2.3): toggles of Table 2.1, Lee's frame, arches."""
import math as doubles

from mpmath import mp

from shared.chain import Chain, Member, Path, Problem
from shared.fixed_point import on_falling_branch
from shared.rows import head, row

mp.dps = 32


def toggle(height, elements, ea="1.885e6", drops=None):
    """Half of it: clamped base, apex held against moving sideways and turning. The load on the whole is -2 v."""
    def make(m):
        number = mp.mpf if m is mp else float
        h, length = number(height), number("12.94")
        angle = m.asin(h / length)
        return Chain([Member(length / elements, angle, number(ea), number("9.27e3")) for _ in range(elements)], -1, True, m)

    chain = make(mp)
    span, rise = mp.sqrt(mp.mpf("12.94") ** 2 - mp.mpf(height) ** 2), mp.mpf(height)
    problem = Problem(make, lambda nodes: [nodes[-1][0] - (span if chain_is(nodes) else float(span)), nodes[-1][2]],
                      lambda nodes: (rise if chain_is(nodes) else float(rise)) - nodes[-1][1])
    steps = drops or [0.01 * k for k in range(1, 70)]
    return Path(problem, lambda x: -2 * x[1], steps, [-1.0, -1.0, 0.1])


def chain_is(nodes):
    """Are these numbers mpmath's?"""
    return isinstance(nodes[-1][1], mp.mpf)


def as_number(m, value):
    return value if m is mp else float(value)


def lee(elements):
    """Column and beam of 120, both ends pinned, load at a fifth of the beam."""
    def make(m):
        number = mp.mpf if m is mp else float
        length = number(120) / elements
        members = [Member(length, a, number(4320), number(1440)) for a in [as_number(m, mp.pi / 2)] * elements + [number(0)] * elements]
        return Chain(members, elements + elements // 5, False, m)

    at = elements + elements // 5
    problem = Problem(make, lambda nodes: [nodes[-1][0] - 120, nodes[-1][1] - 120, nodes[-1][3]], lambda nodes: nodes[at][0] - 24)
    return problem, at


def arch(radius, degrees, ea, ei, elements, right_clamped):
    half = mp.mpf(degrees) * mp.pi / 180

    def make(m):
        number = mp.mpf if m is mp else float
        members = []
        for k in range(elements):
            a = half * (1 - mp.mpf(2 * k + 1) / elements)  # chords of a circle, falling from left to right
            members.append(Member(as_number(m, 2 * mp.mpf(radius) * mp.sin(half / elements)), as_number(m, a), number(ea), number(ei)))
        return Chain(members, elements // 2, True, m)

    width, rise, crown = 2 * mp.mpf(radius) * mp.sin(half), mp.mpf(radius) * (1 - mp.cos(half)), elements // 2
    turned = 3 if not right_clamped else 2
    of = lambda nodes, v: v if chain_is(nodes) else float(v)
    return Problem(make, lambda nodes: [nodes[-1][0] - of(nodes, width), nodes[-1][1], nodes[-1][turned]],
                   lambda nodes: of(nodes, rise) - nodes[crown][1]), crown


def toggles():
    for height in ("0.38", "0.44"):
        for elements in (1, 4, 8, 16, 32) if height == "0.44" else (1, 4, 16, 32):
            path = toggle(height, elements)
            for name, (drop, point) in zip(("maximum", "minimum"), path.folds(mp.mpf("1e-14") if elements == 1 else mp.mpf("1e-8"))):
                row(f"toggle {height} of {elements} {name}", point[0], 14 if elements == 1 else 12)
                if elements == 1:
                    row(f"toggle {height} of 1 {name} at", drop, 12)
    low = toggle("0.32", 1)
    slope = lambda d: low.at(d)[1]
    e = mp.mpf("1e-5")
    soft = mp.findroot(lambda d: slope(d + e) - slope(d - e), (mp.mpf("0.26"), mp.mpf("0.261")), solver="secant", tol=mp.mpf("1e-20"))
    row("toggle 0.32 of 1 least slope", slope(soft), 10)
    row("toggle 0.32 of 1 load at the least slope", low.at(soft)[0], 9)
    row("toggle 0.32 of 1 drop under 27.11", low.root(lambda p: p[0] - mp.mpf("27.11"), mp.mpf("0.26"), mp.mpf("0.27"), mp.mpf("1e-15")), 12)
    high = toggle("0.44", 1)
    for load in ("43.79", "44"):
        row(f"toggle 0.44 of 1 drop under {load}", high.root(lambda p: p[0] - mp.mpf(load), mp.mpf("0.61"), mp.mpf("0.63"), mp.mpf("1e-15")), 12)
    four = toggle("0.44", 4)
    limit = mp.mpf("42.4387099966")
    row("toggle 0.44 of 4 drop just below the limit load",
        four.root(lambda p: p[0] - limit * (1 - mp.mpf("1e-9")), mp.mpf("0.22711"), mp.mpf("0.227119"), mp.mpf("1e-13")), 7)
    row("toggle 0.44 of 4 drop just above the limit load",
        four.root(lambda p: p[0] - limit * (1 + mp.mpf("1e-9")), mp.mpf("0.61"), mp.mpf("0.62"), mp.mpf("1e-13")), 9)


def falling():
    """Starts between the limit points from which the fixed-point homotopy (2.15, corrected) by Euler's rule comes to the falling branch."""
    path = toggle("0.44", 1)
    count = sum(on_falling_branch(lambda d: path.at(d)[:2], load, start, 0.22711, 0.48003)
                for load in (34, 36, 38, 41) for start in (0.25, 0.3, 0.35, 0.4, 0.45))
    row("toggle 0.44 of 1 starts that lead to the falling branch", count, 2)


def others():
    for elements in (5, 10, 20):
        problem, at = lee(elements)
        path = Path(problem, lambda x: x[3], [1 + 0.5 * k for k in range(186)], ["-1e-9", "-1e-9", 0, "1e-9"],
                    ["1e-6", "1e-4", "1e-3", "0.01", "0.03", "0.06", "0.1", "0.2", "0.4", "0.6", "0.8"])
        (drop, point), (_, last) = list(path.folds(mp.mpf("1e-9")))[:2]
        row(f"Lee's frame of {elements} limit", point[0], 11)
        row(f"Lee's frame of {elements} lower limit", last[0], 10)
        if elements == 10:
            row("Lee's frame of 10 limit at v", 120 - point[2][at][1], 10)
            row("Lee's frame of 10 limit at u", drop, 10)
    problem, _ = arch(100, "107.5", "1e8", "1e6", 20, False)
    path = Path(problem, lambda x: x[3], [], [-1e-3, -1e-3, 0, 1e-3], ["0.001", "0.01", "0.1", "1", *range(4, 120, 5)])
    row("deep arch of 20 limit", next(path.folds(mp.mpf("1e-9")))[1][0], 11)
    for elements in (16, 32):
        problem, _ = arch("133.114", "7.3397", "1.875e6", mp.mpf("1e7") * (mp.mpf(3) / 16) ** 3 / 12, elements, True)
        path = Path(problem, lambda x: x[3], [0.02 * k for k in range(1, 80)], [-1e-3, -1e-3, 0, 1e-3], ["1e-4", "0.001", "0.01"])
        for name, (_, point) in zip(("limit", "lower limit"), path.folds(mp.mpf("1e-9"))):
            row(f"shallow arch of {elements} {name}", point[0], 12)


def main():
    head()
    toggles()
    falling()
    others()


main()
