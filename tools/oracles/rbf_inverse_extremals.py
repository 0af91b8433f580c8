"""Extremals of the controlled Duffing oscillator (Elgohary 2015, section 5.3) with S = I, by shooting.

Pontryagin: x1' = x2, x2' = -x1 - beta x1^3 - l2, l1' = l2 (1 + 3 beta x1^2), l2' = -l1, f = -l2; where a component of x is free at the end,
its l is that of x(T) - x_F; where it is free at the start, its l vanishes there. J = int f^2/2 + |x(T) - x_F|^2/2."""
from decimal import Decimal as D

from shared.chain import linear
from shared.extrapolation import Extrapolation, cosine_sine, digits
from shared.rows import head, row

digits(34)


def flow(beta):
    def f(_, s):
        x1, x2, l1, l2, _ = s
        square = beta * x1 * x1
        return [x2, -x1 - square * x1 - l2, l2 * (1 + 3 * square), -l1, l2 * l2 / 2]

    return f


class Case:
    """`begin` and `end`: which of x1, x2 are prescribed there, at 0 and `time`."""

    def __init__(self, time, beta, begin, end, target=(D(5), D(2))):
        self.time, self.f, self.begin, self.end, self.target = time, flow(D(beta)), begin, end, target

    def start(self, unknown):
        """Prescribed components are 0 and leave l unknown; free ones are unknown and have l = 0."""
        x, l = [D(0)] * 2, [D(0)] * 2
        for i in range(2):
            (l if self.begin[i] else x)[i] = unknown[i]
        return x + l

    def fly(self, unknown):
        return Extrapolation(self.f, "1e-27", 12, "0.05").run(0, self.start(unknown) + [D(0)], self.time)

    def misses(self, unknown):
        end = self.fly(unknown)
        off = [a - b for a, b in zip(end, self.target)]
        return [off[i] if self.end[i] else end[2 + i] - off[i] for i in range(2)]

    def solve(self, guess):
        """Newton's iteration with differences from a guess of a few digits."""
        x, h = [D(v) for v in guess], D("1e-11")
        for _ in range(30):
            f = self.misses(x)
            columns = [[(a - b) / h for a, b in zip(self.misses([v + h * (i == j) for j, v in enumerate(x)]), f)] for i in range(2)]
            move = linear([[columns[j][i] for j in range(2)] for i in range(2)], f)
            x = [a - b for a, b in zip(x, move)]
            if max(map(abs, move)) < D("1e-15"):
                break
        else:
            raise ArithmeticError("no convergence")
        end = self.fly(x)
        free = sum((end[i] - self.target[i]) ** 2 for i in range(2) if not self.end[i]) + D(0)
        return self.start(x), end[:2], end[4] + free / 2


def harmonic(time):
    """Eq. 5.34 with a = (1.5, 2, 3), omega = 3."""
    (c1, s1), (c3, s3), (c, s) = (cosine_sine(v * time) for v in (3, 9, 1))
    return (D("1.5") * c1 + 2 * c3 + 3 * c, -(D("4.5") * s1 + 18 * s3 + 3 * s))


# Which of x1, x2 are prescribed at the start and the end, and beta (section 5.3).
KINDS = {"free": ((1, 1), (0, 0), "0.9"), "fixed": ((1, 1), (1, 1), "0.9"), "x1x1": ((1, 0), (1, 0), "0.94"),
         "x1x2": ((1, 0), (0, 1), "0.94"), "x2x1": ((0, 1), (1, 0), "0.97"), "x2x2": ((0, 1), (0, 1), "0.9"),
         "harmonic": ((1, 1), (1, 1), "0.9"), "strong": ((1, 1), (1, 1), "100")}
# Case, T, and the two unknowns at the start to a few digits: which of many extremals is meant.
GUESSES = [
    ("free", 1, "-0.969711", "-2.98782"),
    ("fixed", 1, "68.6029", "7.69059"),
    ("x1x1", 1, "11.8533", "-20.8915"),
    ("x1x2", 1, "0.142557", "-21.6855"),
    ("x2x1", 1, "-3.48887", "11.424"),
    ("x2x2", 1, "-3.51431", "0.160814"),
    ("harmonic", 1, "-47.5205", "-12.9152"),
    ("free", 2, "2.0605", "0.215892"),
    ("fixed", 2, "-20.3785", "1.33555"),
    ("x1x1", 2, "5.85092", "14.0882"),
    ("x1x2", 2, "0.076467", "14.9784"),
    ("x2x1", 2, "-5.5633", "-0.704997"),
    ("x2x2", 2, "-5.69093", "-0.0119188"),
    ("harmonic", 2, "-14.533", "-0.8646"),
    ("free", 5, "0.57701", "-1.44665"),
    ("fixed", 5, "3.67688", "-4.32594"),
    ("x1x1", 5, "0.535433", "15.8071"),
    ("x1x2", 5, "0.0137628", "16.4592"),
    ("x2x1", 5, "-5.15285", "-0.0328729"),
    ("x2x2", 5, "-5.30953", "-0.00232576"),
    ("harmonic", 5, "-4.49217", "1.74081"),
    ("strong", 2, "-363.733", "79.0137"),
]


def main():
    head()
    for kind, time, *guess in GUESSES:
        begin, end, beta = KINDS[kind]
        case = Case(time, beta, begin, end, harmonic(time) if kind == "harmonic" else (D(5), D(2)))
        name = f"{kind} T = {time}"
        start, end, cost = case.solve(guess)
        row(f"{name} cost", cost, 16)
        for what, value in zip(("x1(0)", "x2(0)", "l1(0)", "l2(0)"), start):
            if value:
                row(f"{name} {what}", value, 15)
        for what, value, prescribed in zip(("x1(T)", "x2(T)"), end, case.end):
            if not prescribed or kind == "harmonic":
                row(f"{name} {what}", value, 15)


main()
