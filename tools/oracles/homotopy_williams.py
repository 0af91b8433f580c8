"""Williams' toggle (Elgohary 2015, Table 2.1) by equations 2.17 to 2.19 and the stability functions of the textbook, and one element a
member by section 2.3, with one unknown: the drop of the apex."""
import math as doubles

from mpmath import mp

from shared.fixed_point import on_falling_branch
from shared.rows import head, row

mp.dps = 30


def antisymmetric(m, n):
    """End moments s + c s of both ends turned by 1, times 2 l/EI, at the axial force n = N l^2/EI (tension positive)."""
    if abs(n) < 1e-3:
        return 12 + n / 5 - n * n / 700
    u = m.sqrt(abs(n))
    half = u / 2
    ratio = 1 / m.tanh(half) if n > 0 else m.cos(half) / m.sin(half)
    # M = EI/l n/(u coth(u/2) - 2) for both ends turned alike; cot and a sign for compression.
    return 2 * n / (u * ratio - 2)


class Williams:
    """W/2 = F + P sin beta, P = (EA/l) (delta sin beta - bowing delta^2/l), F = 6 EI d5 delta/l^3, 6 d5 = 2 s (1 + c) - pi^2 rho."""

    def __init__(self, m, height, length="12.94", bowing="0.6", linear=False, cosine=False):
        number = mp.mpf if m is mp else float
        self.m, self.l, self.ea, self.ei = m, number(length), number("1.885e6"), number("9.27e3")
        self.sine, self.bowing, self.linear = number(height) / self.l, number(bowing), linear
        self.factor = m.sqrt(1 - self.sine**2) if cosine else 1

    def six_d5(self, n):
        return 12 + 6 * n / 5 if self.linear else antisymmetric(self.m, n) + n

    def load(self, d, of=None):
        """With `of`, d5 is that of another drop."""
        p = lambda x: self.ea / self.l * (x * self.sine - self.bowing * x * x / self.l)
        n = -p(d if of is None else of) * self.l**2 / self.ei
        return 2 * (self.ei / self.l**3 * self.six_d5(n) * d * self.factor + p(d) * self.sine)

    def slope(self, d, of=None):
        h = mp.mpf(10) ** -10 if self.m is mp else 1e-5
        f = lambda x: self.load(x, of)
        return (8 * (f(d + h) - f(d - h)) - f(d + 2 * h) + f(d - 2 * h)) / (12 * h)


def root(f, a, b):
    return mp.findroot(f, (mp.mpf(a), mp.mpf(b)), solver="anderson", tol=mp.mpf("1e-36"))


def williams():
    for height, folds in (("0.38", ("0.2", "0.3", "0.35", "0.45")), ("0.44", ("0.2", "0.3", "0.4", "0.6"))):
        w = Williams(mp, height)
        for name, a, b in (("maximum", *folds[:2]), ("minimum", *folds[2:])):
            at = root(w.slope, a, b)
            row(f"Williams {height} {name}", w.load(at), 14)
            row(f"Williams {height} {name} at", at, 13)
    low, high = Williams(mp, "0.32"), Williams(mp, "0.44")
    h = mp.mpf(10) ** -6
    soft = root(lambda d: (low.slope(d + h) - low.slope(d - h)) / h, "0.25", "0.28")
    row("Williams 0.32 least slope", low.slope(soft), 10)
    row("Williams 0.32 least slope at", soft, 8)
    row("Williams 0.32 load at the least slope", low.load(soft), 9)
    row("Williams 0.32 drop under 27.11", root(lambda d: low.load(d) - mp.mpf("27.11"), "0.25", "0.28"), 12)
    for load in ("43.79", "44"):
        row(f"Williams 0.44 drop under {load}", root(lambda d: high.load(d) - mp.mpf(load), "0.6", "0.7"), 12)
    span = mp.sqrt(mp.mpf("12.94") ** 2 + mp.mpf("0.44") ** 2)
    for name, w in (("d5 linearised", Williams(mp, "0.44", linear=True)), ("0.5 for 0.6", Williams(mp, "0.44", bowing="0.5")),
                    ("F cos(beta)", Williams(mp, "0.44", cosine=True)), ("l the half span", Williams(mp, "0.44", length=span))):
        row(f"Williams 0.44 limit with {name}", w.load(root(w.slope, "0.2", "0.3")), 5)


def falling():
    """As in homotopy_frames.py, of this equation."""
    w = Williams(doubles, "0.44")
    count = sum(on_falling_branch(lambda d: (w.load(d), w.slope(d)), load, start, 0.22819, 0.49473)
                for load in (34, 36, 38, 41) for start in (0.25, 0.3, 0.35, 0.4, 0.45))
    row("Williams 0.44 starts that lead to the falling branch", count, 2)


class Element:
    """One element: Pi(d, N) = EI/(2 l) theta^2 g(n) + N delta - N^2 l/(2 EA), stationary in N; theta the turn of the chord."""

    def __init__(self, height, length=12.94, ea=1.885e6):
        self.h, self.l, self.ea, self.ei = height, length, ea, 9.27e3
        self.b = doubles.sqrt(length**2 - height**2)

    def g(self, n, order=0):
        """Its derivatives by the series of u coth(u/2) would cancel; central differences are good to 1e-9."""
        e = 1e-2
        values = [antisymmetric(doubles, n + k * e) for k in (-2, -1, 0, 1, 2)]
        if order == 0:
            return values[2]
        if order == 1:
            return (values[0] - 8 * values[1] + 8 * values[3] - values[4]) / (12 * e)
        return (-values[0] + 16 * values[1] - 30 * values[2] + 16 * values[3] - values[4]) / (12 * e * e)

    def shape(self, d):
        """Turn and lengthening of the chord with their derivatives over the drop."""
        y = self.h - d
        chord = doubles.hypot(self.b, y)
        turn = doubles.atan2(self.h, self.b) - doubles.atan2(y, self.b)
        return (turn, self.b / chord**2, 2 * self.b * y / chord**4), (chord - self.l, -y / chord, self.b**2 / chord**3)

    def force(self, d, n=-1.0, below=-80.0):
        """n at which Pi is stationary, by Newton's iteration."""
        (turn, _, _), (longer, _, _) = self.shape(d)
        for _ in range(100):
            f = longer + self.l / 2 * turn**2 * self.g(n, 1) - n * self.ei / (self.l * self.ea)
            step = f / (self.l / 2 * turn**2 * self.g(n, 2) - self.ei / (self.l * self.ea))
            n = max(n - step, (n + below) / 2)
            if abs(step) < 1e-13 * max(1, abs(n)):
                break
        return n

    def state(self, d, printed=False):
        """Load and stiffness of the whole; with `printed` the mixed derivative lacks a factor l, as (2.35) has it."""
        n = self.force(d)
        (t, t1, t2), (_, e1, e2) = self.shape(d)
        g, g1, g2 = (self.g(n, k) for k in range(3))
        k = self.ei / self.l
        mixed = e1 + (1 if printed else self.l) * t * t1 * g1
        own = self.l**3 / (2 * self.ei) * t * t * g2 - self.l / self.ea
        stiffness = k * g * (t1 * t1 + t * t2) + n * self.ei / self.l**2 * e2 - mixed**2 / own
        return 2 * (k * g * t * t1 + n * self.ei / self.l**2 * e1), 2 * stiffness


def elements():
    row("element 0.44 with 1000 EA: straight branch at 0.2", straight_branch(), 5)
    for name, load, element in (("44 lb", 44, Element(0.44)), ("43.79 lb", 43.79, Element(0.44)),
                                ("44 lb with l the half span", 44, Element(0.44, doubles.hypot(12.94, 0.44)))):
        d, seen = 0.0, {}
        for k in range(1, 1001):
            now, stiffness = element.state(d, printed=True)
            d -= (now - load) / stiffness
            seen[k] = abs(element.state(d)[0] - load) / load
        scale = load if name == "43.79 lb" else 1
        for what, choose in (("larger", max), ("smaller", min)):  # which of the two comes at 1000 is decided by rounding
            row(f"cycle under {name}: {what} residual", choose(seen[999], seen[1000]) * scale, 5 if scale == 1 else 4)
    near = Element(0.44)
    d = 0.621922545486
    row("element 0.44 slope of the half at the drop under 43.79", near.state(d)[1] / 2, 4)
    row("element 0.44 slope of the half as printed at the drop under 43.79", near.state(d, printed=True)[1] / 2, 4)


def straight_branch():
    """A member that stays straight but for the S of its ends, past its clamped buckling load: n between -80.76 and -39.48."""
    e = Element(0.44, ea=1.885e9)
    d = 0.2
    (t, t1, _), (longer, e1, _) = e.shape(d)
    f = lambda n: longer + e.l / 2 * t**2 * e.g(float(n), 1) - float(n) * e.ei / (e.l * e.ea)
    low, high = -80.5, -39.5
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(middle) > 0) == (f(low) > 0) else (low, middle)
    return 2 * (e.ei / e.l * e.g(low) * t * t1 + low * e.ei / e.l**2 * e1)


def newton(held):
    """Iterations from 20 001 starts in [0, 1] to |F| < 1e-6 lb under 43.79 lb; with `held`, d5 is constant in the derivative."""
    w, counts, residuals = Williams(doubles, 0.44), [], []
    half = 43.79 / 2
    for i in range(0, 20001, 20 if held else 1):
        d, k = i / 20000, 0
        while True:
            f = w.load(d) / 2 - half
            if abs(f) < 1e-6 or k == (1000 if held else 2500):
                break
            d -= f / (w.slope(d, d if held else None) / 2)
            k += 1
        counts.append(k)
        residuals.append(abs(f) / half)
    return sorted(counts), sorted(residuals)


def census():
    counts, _ = newton(False)
    row("Newton over starts median", counts[10000], 1)
    row("Newton over starts 90 percent", counts[18000], 2)
    counts, residuals = newton(True)
    row("Newton with d5 held: starts that converge", sum(k < 1000 for k in counts), 1)
    row("Newton with d5 held: median residual", residuals[500], 1)


def main():
    head()
    williams()
    falling()
    elements()
    census()


main()
