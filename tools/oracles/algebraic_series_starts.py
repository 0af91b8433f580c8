"""Filipich and Rosales' forced Duffing oscillator from (3, 4) and from (3.1, 4.1), by extrapolation of the midpoint rule: how far the two
motions are apart, and how a small distance grows."""
import math
from decimal import Decimal as D

from shared.extrapolation import Extrapolation, digits
from shared.rows import head, row

digits(50)


def duffing(_, s):
    """u'' + u'/20 + u^3 = 7.5 cos t with cosine and sine, and the linear equations of a small distance (p, q)."""
    u, v, c, z, p, q = s
    return [v, D("7.5") * c - v / 20 - u * u * u, -z, c, q, -q / 20 - 3 * u * u * p]


def integrate(u, v, step, end):
    method, y = Extrapolation(duffing, "1e-34"), [D(u), D(v), D(1), D(0), D(1), D(1)]
    for k in range(round(end / float(step))):
        y = method.run(k * D(step), y, (k + 1) * D(step))
        yield (k + 1) * D(step), y


def main():
    head()
    first, second = list(integrate(3, 4, "0.05", 100)), list(integrate("3.1", "4.1", "0.05", 100))
    apart = [(t, math.hypot(float(a[0] - b[0]), float(a[1] - b[1]))) for (t, a), (_, b) in zip(first, second)]
    for t, state in second:
        if t in (50, 100):
            row(f"u({t:.0f}) from 3.1 and 4.1", state[0], 16)
            row(f"v({t:.0f}) from 3.1 and 4.1", state[1], 16)
    row("distance above 1 from", next(t for t, d in apart if d > 1), 3)
    row("distance at 50", next(d for t, d in apart if t == 50), 6)
    row("greatest distance to 50", max(d for t, d in apart if t <= 50), 6)
    end = first[-1][1]
    row("growth of a small distance to 100", math.log(math.hypot(float(end[4]), float(end[5])) / math.sqrt(2)), 6)


main()
