"""Limit points of the toggle of Elgohary 2015, Table 2.1, and its drops under 36 lb, as an extensible elastica: half of it by shooting from the clamped base.

With the constant force (h, v) across every section: theta' = m/EI, x' = (1 + N/EA) cos theta, y' = (1 + N/EA) sin theta,
m' = (1 + N/EA) (h sin theta - v cos theta), N = h cos theta + v sin theta, over the length of the unloaded member."""
from decimal import Decimal as D

from shared.chain import linear
from shared.extrapolation import Extrapolation, cosine_sine, digits
from shared.rows import head, row

digits(30)
LENGTH, EA, EI = D("12.94"), D("1.885e6"), D("9.27e3")


class Half:
    def __init__(self, height):
        self.sine = D(height) / LENGTH
        self.cosine = (1 - self.sine**2).sqrt()
        self.span, self.rise = LENGTH * self.cosine, D(height)

    def misses(self, unknown, drop):
        """Of the apex: x, sine of the rotation, y."""
        h, v, moment = unknown

        def f(_, s):
            x, y, c, z, m = s
            stretch = 1 + (h * c + v * z) / EA
            bend = m / EI
            return [stretch * c, stretch * z, -z * bend, c * bend, stretch * (h * z - v * c)]

        x, y, c, z, _ = Extrapolation(f, "1e-24", 12, "6.5").run(0, [0, 0, self.cosine, self.sine, moment], LENGTH)
        return [x - self.span, z * self.cosine - c * self.sine, y - self.rise + drop]

    def solve(self, unknown, drop):
        """Newton's iteration. Returns the unknowns and their slopes over the drop; the load is -2 v."""
        x, h = list(unknown), D("1e-12")
        for _ in range(20):
            f = self.misses(x, drop)
            columns = [[(a - b) / h for a, b in zip(self.misses([c + h * (i == j) for j, c in enumerate(x)], drop), f)] for i in range(3)]
            rows = [[columns[j][i] for j in range(3)] for i in range(3)]
            move = linear(rows, f)
            x = [a - b for a, b in zip(x, move)]
            if max(map(abs, move)) < D("1e-9"):  # and the next would be as small as its square
                return x, linear(rows, [D(0), D(0), D(-1)])
        raise ArithmeticError("no convergence")

    def fold(self, unknown, a, b):
        """The drop near a and b at which the load is stationary, and the load there."""
        x, slope = self.solve(unknown, a)
        before = slope[1]
        for _ in range(20):
            x, slope = self.solve(x, b)
            a, b, before = b, b - slope[1] * (b - a) / (slope[1] - before), slope[1]
            if abs(b - a) < D("1e-9"):
                x, _ = self.solve(x, b)
                return b, -2 * x[1]
        raise ArithmeticError("no convergence")

    def under(self, unknown, load, drop):
        """The drop near a given one at which the half carries a load, by Newton's iteration."""
        x = unknown
        for _ in range(20):
            x, slope = self.solve(x, drop)
            move = (-2 * x[1] - load) / (-2 * slope[1])
            drop -= move
            if abs(move) < D("1e-9"):  # and the next would be as small as its square
                return drop
        raise ArithmeticError("no convergence")


def main():
    head()
    for height, folds in (("0.38", ("0.234", "0.380")), ("0.44", ("0.227", "0.480"))):
        half, x, drop = Half(height), [D(-1), D(-1), D(1)], D(0)
        for name, near in zip(("maximum", "minimum"), folds):
            while drop < D(near) - D("0.04"):
                drop += D("0.04")
                x, _ = half.solve(x, drop)
            _, load = half.fold(x, D(near), D(near) + D("0.001"))
            row(f"elastica {height} {name}", load, 12)
    half, x, drop = Half("0.44"), [D(-1), D(-1), D(1)], D(0)
    for branch, near in (("rising", "0.12"), ("falling", "0.36")):
        while drop < D(near):
            drop += D("0.04")
            x, _ = half.solve(x, drop)
        row(f"elastica 0.44 36 lb {branch}", half.under(x, D(36), drop), 9)


main()
