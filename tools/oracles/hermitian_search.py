"""Search for settings of a program that print Laier's Tables 4 and 5. The paper states neither its start nor how its program iterates and reads a peak.

A combination is one choice for all nine numbers of a table: the start (rest, or a position or velocity alone, of plus or minus 0.001, 0.002,
0.005 to 2); the load, plus or minus cosine or sine, ahead by -2 to 2 steps in halves; the first step, with the acceleration and jerk of the
start or with none; Newton's iteration from the state before, with one update, one with the load of the step's start, two, or to
convergence; the reading, an end of a step or between ends. Table 5 has no load and cannot start at rest. The miss of a combination is its greatest of nine, in units of the last
printed digit.

Chance is judged by 499 tables that no program made: the distances of a printed column from the peak, times a number from 0.5 to 1.5 drawn for
each column, rounded like the printed ones; with any peak, the peak times such a number, too. A share is that of the tables, the printed one
counted, that some combination fits as well as the printed one is fitted."""
import bisect
import csv
import math
import pathlib
import random

from shared.rows import head, row

STEPS, UNIT, LATEST, TABLES, NONE = (0.2, 0.1, 0.05), 1e-4, 20, 499, (math.nan,) * 5
PRINTED = pathlib.Path(__file__).resolve().parents[2] / "tables/published/laier.csv"
# Of Laier's, Argyris' and Newmark's operators, solved for the end of a step: the factors of h^2 a0, h^2 a1, h^3 j0, h^3 j1 in y1 - y0 - h v0 and
# those of h a0, h a1, h^2 j0, h^2 j1 in v1 - v0.
OPERATORS = (((1 / 3, 1 / 6, 1 / 24, -1 / 24), (1 / 2, 1 / 2, 1 / 12, -1 / 12)),
             ((7 / 20, 3 / 20, 1 / 20, -1 / 30), (1 / 2, 1 / 2, 1 / 12, -1 / 12)),
             ((1 / 4, 1 / 4, 0, 0), (1 / 2, 1 / 2, 0, 0)))


def duffing(t, y, v):
    """Acceleration and jerk of y'' + 0.4 y' + y + 0.5 y^3 = 0.5 cos 0.5 t, and their derivatives by y and v."""
    a = 0.5 * math.cos(0.5 * t) - 0.4 * v - y - 0.5 * y * y * y
    slope = -1 - 1.5 * y * y
    return a, -0.25 * math.sin(0.5 * t) - 0.4 * a + slope * v, slope, -0.4, -0.4 * slope - 3 * y * v, 0.16 + slope


def van_der_pol(t, y, v):
    """Of y'' - 1.5 (1 - y^2) y' + y = 0."""
    q = 1.5 * (1 - y * y)
    a, slope = q * v - y, -3 * y * v - 1
    return a, q * a - 3 * y * v * v - v, slope, q, q * slope - 3 * y * a - 3 * v * v, q * q - 6 * y * v - 1


def ends(f, program, weights, h):
    """Position and velocity at the ends of steps."""
    start, begin, ahead, no_first, updates, old_load = program
    (p0, p1, p2, p3), (w0, w1, w2, w3) = weights
    y, v = start
    a, j = (0.0, 0.0) if no_first else f(begin + ahead * h, y, v)[:2]
    ya, yj, va, vj = h * h * p1, h**3 * p3, h * w1, h * h * w3
    for n in range(round(LATEST / h) + 1):
        yield y, v
        t = begin + (ahead + n + (not old_load)) * h
        y0, v0 = y + h * v + h * h * (p0 * a + h * p2 * j), v + h * (w0 * a + h * w2 * j)
        for _ in range(updates):
            a, j, ay, av, jy, jv = f(t, y, v)
            ry, rv = y - y0 - ya * a - yj * j, v - v0 - va * a - vj * j
            m, n1, o, q = 1 - ya * ay - yj * jy, -ya * av - yj * jv, -va * ay - vj * jy, 1 - va * av - vj * jv
            d = m * q - n1 * o
            dy, dv = (ry * q - rv * n1) / d, (m * rv - o * ry) / d
            y, v = y - dy, v - dv
            if abs(dy) + abs(dv) < 1e-13 or abs(y) > 1e6:
                break
        a, j = f(t, y, v)[:2]


def readings(f, program, weights, h, sign):
    """The first peak: the end of a step that is furthest, the last before the turn, the first after it, the vertex of a parabola through three ends,
    the top of the cubic between two."""
    earlier = before = (math.nan, math.nan)
    run = ends(f, program, weights, h)
    for after in run:
        if not abs(after[0]) < 1e6:
            return NONE
        if sign * before[1] > 0 >= sign * after[1]:
            (y1, v1), (y2, v2) = before, after
            y0, y3 = earlier[0], next(run, after)[0]
            early = sign * y1 >= sign * y2
            low, middle, high = (y0, y1, y2) if early else (y1, y2, y3)
            bend = high - 2 * middle + low
            rise, s1, s2 = sign * (y2 - y1), sign * h * v1, sign * h * v2
            b, c = 3 * rise - 2 * s1 - s2, s1 + s2 - 2 * rise
            root = b * b - 3 * c * s1
            s = s1 / (-b + math.sqrt(root)) if root >= 0 else math.nan
            return (y1 if early else y2, y1, y2, middle - (high - low) ** 2 / (8 * bend) if bend else math.nan,
                    y1 + sign * s * (s1 + s * (b + s * c)))
        earlier, before = before, after
    return NONE


def starts():
    sizes = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2)
    return [(0, 0)] + [each for size in sizes for value in (size, -size) for each in ((value, 0), (0, value))]


def programs(loaded):
    iterations = [(1, False), (2, False), (50, False)] + [(1, True)] * loaded
    for start in starts()[not loaded:]:
        for quarter in range(4 if loaded else 1):
            for halves in range(-4, 5) if loaded else (0,):
                for no_first in (False, True):
                    for iteration in iterations:
                        yield start, quarter * math.pi, halves / 2, no_first, *iteration


def combinations(f, loaded, sign):
    """The nine numbers of each, row by row: by the steps, and then by the operators."""
    found = []
    for program in programs(loaded):
        found += zip(*(readings(f, program, weights, h, sign) for h in STEPS for weights in OPERATORS))
    return found


def miss(computed, table):
    # A number that ends on the edge of a unit is within.
    return max(abs(p - q) for p, q in zip(computed, table)) / UNIT * (1 - 1e-9)


def numbers_given(computed, table):
    return sum(abs(p - q) / UNIT * (1 - 1e-9) <= 1 for p, q in zip(computed, table))


def by_chance(table, peak, moves, draw):
    there = peak * draw.uniform(0.5, 1.5) if moves else peak
    factors = [draw.uniform(0.5, 1.5) for _ in range(3)]
    return [round((there + factors[i % 3] * (number - peak)) / UNIT) * UNIT for i, number in enumerate(table)]


def share(known, table, peak, best, moves):
    """Of tables by chance that are fitted as well as the printed one, which counts, too. @param known combinations in the order of their last number"""
    draw, fitted, last = random.Random(1), 1, [each[8] for each in known]
    for _ in range(TABLES):
        other = by_chance(table, peak, moves, draw)
        near = known[bisect.bisect_left(last, other[8] - (best + 1) * UNIT):bisect.bisect_right(last, other[8] + (best + 1) * UNIT)]
        fitted += any(miss(each, other) <= best for each in near)
    return fitted / (TABLES + 1)


def printed(place):
    with PRINTED.open(newline="") as file:
        values = {r["row"]: float(r["value"]) for r in csv.DictReader(file) if r["place"] == place}
    return [values[f"dt = {h} {name}"] for h in STEPS for name in ("Laier", "Argyris", "Newmark")]


def search(place, f, loaded, sign, peak):
    table, every = printed(place), combinations(f, loaded, sign)
    known = sorted((each for each in every if not any(map(math.isnan, each))), key=lambda each: each[8])
    best = min(miss(each, table) for each in known)
    row(f"{place} combinations", len(every), 5)
    row(f"{place} most numbers given", max(numbers_given(each, table) for each in every), 1)
    row(f"{place} miss of the best", best, 3)
    row(f"{place} share with the same peak", share(known, table, peak, best, False), 2)
    row(f"{place} share with any peak", share(known, table, peak, best, True), 2)


def main():
    head()
    # The peaks of the motions: oracle transversal_motions.
    search("table-4", duffing, True, 1, 0.53826530480162931)
    search("table-5", van_der_pol, False, -1, -0.31932967523380421)


if __name__ == "__main__":
    main()
