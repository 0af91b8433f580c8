"""Gragg, Bulirsch and Stoer's method in decimal arithmetic: the modified midpoint rule with 2, 4, 6, ... substeps, extrapolated in h^2.

It shares nothing with Taylor series, Runge-Kutta formulas or collocation. Right-hand sides take t and a list of Decimals."""
import decimal
from decimal import Decimal


def midpoint(f, t, y, slope, h, n):
    """n substeps over h, without the smoothing at the end: an expansion in even powers of the substep for even n."""
    s = h / n
    before, now = y, [a + s * b for a, b in zip(y, slope)]
    twice = 2 * s
    for k in range(1, n):
        before, now = now, [a + twice * b for a, b in zip(before, f(t + k * s, now))]
    return now


class Extrapolation:
    """Steps to a relative local error `tolerance` of the largest component; `columns` of the table."""

    def __init__(self, f, tolerance, columns=12, step="0.1"):
        self.f, self.tolerance, self.columns, self.step = f, Decimal(tolerance), columns, Decimal(step)

    def table(self, t, y, h):
        slope, rows = self.f(t, y), []
        for j in range(self.columns):
            row = [midpoint(self.f, t, y, slope, h, 2 * (j + 1))]
            for k in range(j):
                q = Decimal((j + 1) ** 2) / Decimal((j - k) ** 2) - 1
                row.append([a + (a - b) / q for a, b in zip(row[k], rows[j - 1][k])])
            rows.append(row)
        return rows[-1][-1], max(abs(a - b) for a, b in zip(rows[-1][-1], rows[-1][-2]))

    def run(self, t, y, end, seen=None):
        """The state at `end`. `seen(t, y)` is called after every step."""
        t, end, y = Decimal(t), Decimal(end), [Decimal(v) for v in y]
        while t != end:
            h = self.step if abs(self.step) < abs(end - t) else end - t
            if (h > 0) != (end > t):
                h = -h
            new, error = self.table(t, y, h)
            share = error / (self.tolerance * max(max(map(abs, new)), Decimal("1e-300")))
            factor = Decimal("0.9") / (share ** (Decimal(1) / (2 * self.columns - 1)) if share else Decimal("0.1"))
            factor = min(max(factor, Decimal("0.2")), Decimal(4))
            if share <= 1:
                t, y = (end if h == end - t else t + h), new
                if seen:
                    seen(t, y)
                if abs(h) == abs(self.step) or factor < 1:
                    self.step = abs(h) * factor
            else:
                self.step = abs(h) * factor
        return y


def digits(count):
    decimal.getcontext().prec = count


def cosine_sine(x):
    """Of a Decimal, by their series; for starts of states that carry an angle's cosine and sine along."""
    x, term, terms = Decimal(x), Decimal(1), []
    k = 0
    while abs(term) > Decimal(10) ** -(decimal.getcontext().prec + 5) or k < 4:
        terms.append(term)
        k += 1
        term = term * x / k
    cosine = sum((-1) ** (i // 2) * v for i, v in enumerate(terms) if i % 2 == 0)
    sine = sum((-1) ** (i // 2) * v for i, v in enumerate(terms) if i % 2 == 1)
    return cosine, sine
