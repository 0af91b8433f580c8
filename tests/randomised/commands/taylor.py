"""Solutions of initial value problems in 25 digits: Taylor series in fixed point, whose numbers are Python's whole numbers. mpmath's floating
point would take twenty times as long. Nothing of nlmech: a right-hand side is a Python function of nodes, each of which finds the coefficients
of its own series one after the other.

    def duffing(p, t, x):
        return [x[1], -p["w"] * p["w"] * x[0] - x[0] * x[0] * x[0]]
"""
import math
import operator
import time

from mpmath import mp

BITS = 192  # behind the point
ONE = 1 << BITS


def fixed(x):
    """A double, a whole number or one of mpmath's in fixed point."""
    return int(mp.ldexp(x, BITS)) if isinstance(x, mp.mpf) else int(math.ldexp(x, BITS))


def floating(x):
    """The double next to a number in fixed point."""
    return x / ONE


class Node:
    """A function of time by its series about the start of a step, in units of the step: `c`, to which next(k) adds the coefficient k."""

    nodes = None  # of the right-hand side that is being built, in the order in which their coefficients can be found

    def __init__(self):
        self.c = []
        Node.nodes.append(self)

    def __add__(self, other):
        return Sum(self, other)

    def __mul__(self, other):
        return Product(self, other) if isinstance(other, Node) else Multiple(self, other)

    def __sub__(self, other):
        return self + other * -1

    def __rsub__(self, other):
        return self * -1 + other

    def __neg__(self):
        return self * -1

    __radd__, __rmul__ = __add__, __mul__


class Unknown(Node):
    def next(self, k):
        pass  # Run.expand() does it


class Time(Node):
    def restart(self, t, step):
        self.t, self.step = t, step

    def next(self, k):
        self.c.append(self.t if k == 0 else self.step if k == 1 else 0)


class Sum(Node):
    def __init__(self, a, b):
        super().__init__()
        self.a, self.b = a, b

    def next(self, k):
        if isinstance(self.b, Node):
            self.c.append(self.a.c[k] + self.b.c[k])
        else:
            self.c.append(self.a.c[k] + (fixed(self.b) if k == 0 else 0))


class Multiple(Node):
    def __init__(self, a, factor):
        super().__init__()
        self.a, self.factor = a, fixed(factor)

    def next(self, k):
        self.c.append(self.a.c[k] * self.factor >> BITS)


def convolved(a, b, k):
    return sum(map(operator.mul, a[:k + 1], b[k::-1])) >> BITS


class Product(Node):
    def __init__(self, a, b):
        super().__init__()
        self.a, self.b = a, b

    def next(self, k):
        self.c.append(convolved(self.a.c, self.b.c, k))


class Power(Node):
    """a^(n/2) = y: a y' = n/2 a' y."""

    def __init__(self, a, n):
        super().__init__()
        self.a, self.n = a, n

    def next(self, k):
        a, y, n = self.a.c, self.c, self.n
        if k == 0:
            y.append(fixed(mp.ldexp(mp.mpf(a[0]), -BITS) ** (mp.mpf(n) / 2)))
        else:
            y.append(sum((n * j - 2 * (k - j)) * a[j] * y[k - j] for j in range(1, k + 1)) // (2 * k * a[0]))


class Exponential(Node):
    """exp(a) = y: y' = a' y."""

    def __init__(self, a):
        super().__init__()
        self.a = a

    def next(self, k):
        a, y = self.a.c, self.c
        if k == 0:
            y.append(fixed(mp.exp(mp.ldexp(mp.mpf(a[0]), -BITS))))
        else:
            y.append((sum(j * a[j] * y[k - j] for j in range(1, k + 1)) >> BITS) // k)


class Cosine(Node):
    """cos(w t + phase), of Time alone."""

    def __init__(self, t, w, phase=0):
        super().__init__()
        self.t, self.w, self.phase = t, mp.mpf(w), phase

    def next(self, k):
        if k == 0:
            angle = self.w * mp.ldexp(mp.mpf(self.t.t), -BITS) + self.phase
            self.rate, self.pair = fixed(self.w * mp.ldexp(mp.mpf(self.t.step), -BITS)), [fixed(x) for x in mp.cos_sin(angle)]
        else:
            c, s = self.pair
            self.pair = [-(s * self.rate >> BITS) // k, (c * self.rate >> BITS) // k]
        self.c.append(self.pair[0])


class Run:
    """The series of a right-hand side, begun anew at each step."""

    def __init__(self, right_hand_side, size, order):
        Node.nodes = []
        self.order, self.t, self.x = order, Time(), [Unknown() for _ in range(size)]
        self.f, self.nodes = right_hand_side(self.t, self.x), Node.nodes

    def expand(self, t, x, step):
        for node in self.nodes:
            node.c = []
        self.t.restart(t, step)
        for node, value in zip(self.x, x):
            node.c.append(value)
        for k in range(self.order):
            for node in self.nodes:
                node.next(k)
            for node, rate in zip(self.x, self.f):
                node.c.append((rate.c[k] * step >> BITS) // (k + 1))

    def longest(self, size, digits):
        """The step, in units of the one of the series, of which the last two terms leave so many digits of the sizes."""
        most = 1e9
        for k in (self.order - 1, self.order):
            for node, s in zip(self.x, size):
                if node.c[k]:
                    most = min(most, math.exp((math.log(max(s, 1)) - math.log(abs(node.c[k])) - digits * math.log(10)) / k))
        return most

    def fit(self, t, x, step, size, digits, way):
        """Expands in a unit near the longest step, in which no coefficient is too small or too large for fixed point, or longer than the way that
        is left. Returns the unit, and the longest step in it."""
        for _ in range(60):
            self.expand(t, x, step)
            longest = self.longest(size, digits)
            if 0.25 <= longest <= 4 or (longest > 4 and abs(step) >= way):
                return step, longest
            step = step * fixed(min(longest, 8)) >> BITS
        self.expand(t, x, step)
        return step, self.longest(size, digits)

    def at(self, s):
        """The state after so many of the series' steps, in fixed point."""
        state = []
        for node in self.x:
            total = 0
            for c in reversed(node.c):
                total = (total * s >> BITS) + c
            state.append(total)
        return state


def steps(run, x, t, end, digits, seconds, size=None):
    """The steps of a series from the state x at t to the end, all in fixed point: start and end of each, and a function that gives the state at any
    time between. They stop early if they become too many, or the solution grows beyond all bounds."""
    sign, last, step = 1 if end > t else -1, time.process_time() + seconds, (end - t) // 64
    size = size or [abs(c) for c in x]
    if not any(size):  # from rest at 0: what the first rates make of it on the way
        run.expand(t, x, step)
        size[:] = [abs(rate.c[0] * (end - t) >> BITS) for rate in run.f]
    while t != end:
        largest = max(size)
        if time.process_time() > last or largest > ONE << 200:
            return
        step, longest = run.fit(t, x, step, [max(s, largest >> 40) for s in size], digits, abs(end - t))
        there = t + (step * fixed(min(longest, 4)) >> BITS)
        if there == t:
            return
        if (end - there) * sign <= 0:
            there = end

        def at(time_, begin=t, unit=step):
            return run.at(((time_ - begin) << BITS) // unit)

        x, begin, t = at(there), t, there
        yield begin, t, at
        size[:] = [max(abs(c), s) for c, s in zip(x, size)]


def states(right_hand_side, x0, t0, times, breaks=(), order=32, digits=25, seconds=10.0):
    """States in fixed point at these times, which lie one after the other in one direction from t0; None if they are not reached.
    `right_hand_side` takes the time, the nodes of the state, and a double inside of the piece between two `breaks` that it is to be smooth in."""
    sign, end = (1 if times[-1] >= t0 else -1), times[-1]
    ends = sorted({b for b in breaks if (b - t0) * sign > 0 and (end - b) * sign > 0} | {end}, key=lambda b: sign * b)
    x, found, wanted = [fixed(c) for c in x0], [], [fixed(t) for t in times]
    found += [x for t in times if t == t0]
    size = [abs(c) for c in x]
    for begin, last in zip([t0, *ends], ends):
        t, middle = fixed(begin), (begin + last) / 2
        run = Run(lambda t, x: right_hand_side(t, x, middle), len(x), order)
        for _, t, at in steps(run, x, t, fixed(last), digits, seconds, size):
            while len(found) < len(wanted) and (t - wanted[len(found)]) * sign >= 0:
                found.append(at(wanted[len(found)]))
            x = at(t)
        if t != fixed(last):
            return None
    return found
