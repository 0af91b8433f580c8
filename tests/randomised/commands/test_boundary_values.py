"""Random boundary value problems with a known solution X, x'' = a (x - X) + g (x' - V) + A + k - K, and conditions of all kinds. What is off
by them is c1 e1 + c2 e2 + c3 with exponentials e1, e2 and a constant, so that the conditions are a matrix of at most 3 by 3."""
from cases import failed, judged, needs, number, randomised_test, ran, undecided, wrong
from mpmath import mp, mpf


ORDER = {"value": 0, "slope": 1, "bend": 2}


class Known:
    """The solution p + q sin(w t + r), with a change of its second derivative at `jump` if there is one, and deviations from it."""

    def __init__(self, draw):
        self.until = draw.log_uniform(0.1, 5)
        self.p, self.q, self.w, self.r = draw.signed_log(1e-3, 10), draw.signed_log(1e-3, 10), draw.log_uniform(0.1, 10), draw.uniform(-3, 3)
        self.a, self.g = draw.log_uniform(0.01, 400), draw.uniform(-3, 3)
        self.jump = draw.uniform(0.1, 0.9) * self.until if draw.chance(0.25) else None
        self.load = draw.signed_log(0.1, 10) if self.jump else 0.0
        self.k = draw.signed_log(1e-3, 10) if draw.chance(0.4) else None
        root = mp.sqrt(mpf(self.g)**2 / 4 + self.a)
        self.growth = [mpf(self.g) / 2 - root, mpf(self.g) / 2 + root]

    def text(self):
        wave, rest = f"{self.w!r} t + {self.r!r}", f"max(t - {self.jump!r}, 0)" if self.jump else "(0 t)"
        text = (f"x'' = {self.a!r} (x - X) + {self.g!r} (x' - V) + A; X = {self.p!r} + {self.q!r} sin({wave}) + {self.load!r} {rest}^2; "
                f"V = {self.q * self.w!r} cos({wave}) + {2 * self.load!r} {rest}; A = {-self.q * self.w**2!r} sin({wave})")
        if self.jump:
            text += f" + {2 * self.load!r} step(t - {self.jump!r})"
        return text if self.k is None else text.replace("+ A;", f"+ A + k - {self.k!r};")

    def at(self, t, order):
        """X or its derivative of first or second order."""
        t, rest = mpf(t), max(mpf(t) - self.jump, 0) if self.jump else mpf(0)
        wave = mpf(self.w) * t + self.r
        if order == 2:
            return mpf(-self.q * self.w**2) * mp.sin(wave) + (2 * self.load if self.jump and t >= self.jump else 0)
        if order:
            return mpf(self.q * self.w) * mp.cos(wave) + mpf(2 * self.load) * rest
        return self.p + mpf(self.q) * mp.sin(wave) + self.load * rest**2

    def most(self, order):
        """The largest |X| or derivative at 33 times."""
        return max(abs(self.at(self.until * mpf(i) / 32, order)) for i in range(33))

    def moved_by(self, slope, bend):
        """Bounds of a deviation and of its derivative that vanish at infinity, for defects of x' and of x'': by the integrals of Green's
        function (e^(r1 t) or e^(r2 t))/(r2 - r1) and of its derivative."""
        r1, r2 = -self.growth[0], self.growth[1]
        own, twice = min(1 / (r1 * r2), self.until / (r1 + r2)), min(mpf(self.until), 2 * (1 / r1 + 1 / r2))
        return bend * own + slope * twice, bend * twice + slope * (1 + max(r1, r2) * twice)

    def deviation(self, i, t, order):
        """A solution of the homogeneous equation of size 1; the last one is that of k."""
        if i == 2:
            return mpf(0) if order else mpf(1)
        rate = self.growth[i]
        return rate**order * mp.exp(rate * (mpf(t) - (self.until if rate > 0 else 0)))


class Condition:
    """A sum of values and integrals, or an increasing function of it."""

    def __init__(self, draw, known):
        self.parts = []
        for _ in range(draw.whole(1, 3)):
            what = draw.one_of(["value", "value", "slope", "bend", "integral"])
            time = draw.one_of([0.0, known.until, draw.uniform(0, 1) * known.until])
            self.parts.append((draw.signed_log(0.1, 10), what, time))
        self.function = draw.one_of(["{}", "{}", "sinh({})", "({0}) + ({0})^3"])

    def of(self, function, known):
        """The sum for a function of time and order of derivative."""
        total = mpf(0)
        for factor, what, time in self.parts:
            if what == "integral":
                total += factor * mp.quad(lambda t: function(t, 0), [0, *([known.jump] if known.jump else []), known.until])
            else:
                total += factor * function(time, ORDER[what])
        return total

    def moved_by(self, value, slope, bend, until):
        """Bound of its change for changes of x, x' and x''."""
        return sum(abs(f) * {"value": value, "slope": slope, "bend": bend, "integral": until * value}[what] for f, what, _ in self.parts)

    def text(self, value):
        words = {"value": "x({!r})", "slope": "x'({!r})", "bend": "x''({!r})", "integral": "integral(x)"}
        total = " + ".join(f"{factor!r} {words[what].format(time)}" for factor, what, time in self.parts)
        size = max(1, abs(float(value)))  # of the argument of the function
        return f"{self.function.format(f'({total} - {float(value)!r})/{size!r}')} = 0"


@needs("rbf_inverse")
@randomised_test(quick=25, full=10_000)
def test_boundary_values_are_the_known_ones(draw):
    with mp.workdps(25):
        known = Known(draw)
        count = 2 if known.k is None else 3
        conditions = [Condition(draw, known) for _ in range(count)]
        values = [c.of(known.at, known) for c in conditions]
        matrix = mp.matrix(count, count)
        for row, c in enumerate(conditions):
            for column in range(count):
                matrix[row, column] = c.of(lambda t, order, i=column: known.deviation(i, t, order), known)
        r = ran(["rbf_inverse", "bvp", "--equation", known.text(), "--from", "0", "--until", repr(known.until), "--conditions",
                 "; ".join(c.text(v) for c, v in zip(conditions, values)), *(["--unknown", "k"] if count == 3 else [])], 20)
        if r.exit_code:
            return failed(r)
        x, v, f = (known.most(order) for order in range(3))
        terms = known.a * x + abs(known.g) * v + abs(known.k or 0)
        # Defects: 1e-9 of the largest slope, of 2e-5 of its terms where these are larger; a hundredth of 1e-9 of the terms.
        slope, bend = 1e-9 * v, 1e-9 * max(f, 2.3e-5 * terms) + 1e-11 * terms
        value, rate = known.moved_by(slope, bend)
        value, rate = value + 1e-14 * x, rate + 1e-14 * v
        try:
            inverse = mp.inverse(matrix)
        except ZeroDivisionError:
            return undecided(r.words)
        bent = known.a * value + abs(known.g) * rate + bend
        rows = [c.moved_by(value, rate, bent, known.until) + 1e-15 * abs(total) for c, total in zip(conditions, values)]
        bound = value + sum(abs(inverse[i, j]) * rows[j] for i in range(count) for j in range(count))
        if bound > 1e-3 * (x + v):
            return undecided(r.words)
        if len(r.rows) < 3:
            return wrong(r.words + ": rows")
        column, t = r.header.index("x"), r.header.index("t")
        error = max(abs(number(row[column]) - known.at(number(row[t]), 0)) for row in r.rows)
        if count == 3:
            error = max(error, abs(number(r.rows[0][r.header.index("k")]) - known.k) / max(1, known.a))
        return judged(error, bound, r.words)
