"""Plane frames that are one chain of members, by shooting along it: no stiffness matrix, no assembly.

A member of length l, EA, EI carries a constant force (h, v). Along its chord, at the angle a, that is the normal force
N = h cos a + v sin a; its slope s(x) against the chord obeys the beam-column's EI s'' - N s = const with a mean of 0, its chord has the
length l + N l/EA - (1/2) int s^2, and moments balance: m(l) - m(0) + (v cos a - h sin a) chord = 0, m = EI s'. That last equation gives
the angle a; the other end's place, rotation and moment start the next member. Numbers of `math`: mpmath.mp, or math for doubles."""
import math as doubles

from mpmath import mp


class Member:
    def __init__(self, length, angle, ea, ei):
        self.length, self.angle, self.ea, self.ei = length, angle, ea, ei

    def bent(self, m, n, start, moment):
        """With the normal force n: slope and moment at the end and the chord, from the slope and moment at the start."""
        l, of_force = self.length, n
        if m is doubles and abs(n) * l * l < 1e-3 * self.ei:  # doubles would cancel; accurate enough for the path in doubles
            n = doubles.copysign(1e-3 * self.ei / (l * l), n)
        k = m.sqrt(abs(n) / self.ei)
        c, s, sign = (m.cosh(k * l), m.sinh(k * l), 1) if n > 0 else (m.cos(k * l), m.sin(k * l), -1)
        # s(x) = p C(kx) + q S(kx) + r; C' = sign k S, S' = k C; S/k and sign (C - 1)/k are the integrals of C and S.
        q = moment / (self.ei * k)
        ic, ss = s / k, sign * (c - 1) / k
        p = -(start * l + q * ss) / (ic - l)
        r = start - p
        end = p * c + q * s + r
        square = (p * p * (l + s * c / k) / 2 + q * q * sign * (s * c / k - l) / 2 + r * r * l + p * q * s * s / k +
                  2 * r * (p * ic + q * ss))
        return end, self.ei * k * (sign * p * s + q * c), l + of_force * l / self.ea - square / 2

    def across(self, m, h, v, rotation, moment, guess):
        """Chord angle, chord, rotation and moment at the end."""
        def balance(a):
            n = h * m.cos(a) + v * m.sin(a)
            end, there, chord = self.bent(m, n, self.angle + rotation - a, moment)
            return there - moment + (v * m.cos(a) - h * m.sin(a)) * chord, end, there, chord

        tiny = mp.mpf(10) ** (4 - mp.dps) if m is mp else 1e-13
        a, b = guess, guess + (mp.mpf(10) ** -6 if m is mp else 1e-6)
        fa, fb = balance(a), balance(b)
        for _ in range(60):
            if fa[0] == fb[0]:
                break
            a, b, fa = b, b - fb[0] * (b - a) / (fb[0] - fa[0]), fb
            fb = balance(b)
            if abs(b - a) <= tiny:
                break
        return b, fb[3], fb[1] + b - self.angle, fb[2]


class Chain:
    """Members from (0, 0). The first end is clamped, or pinned and turned by an unknown angle."""

    def __init__(self, members, loaded, clamped, m):
        self.members, self.loaded, self.clamped, self.m = members, loaded, clamped, m
        self.angles = [e.angle for e in members]

    def shoot(self, unknown, load):
        """(x, y, rotation, moment) of every node; unknown: force (h, v) and moment or rotation at the start. The load pulls down at the
        node `loaded`."""
        h, v, other = unknown
        rotation, moment = (0, other) if self.clamped else (other, 0)
        x = y = self.m.cos(0) * 0
        nodes = [(x, y, rotation, moment)]
        for k, e in enumerate(self.members):
            if k == self.loaded:
                v = v + load
            a, chord, rotation, moment = e.across(self.m, h, v, rotation, moment, self.angles[k])
            self.angles[k] = a
            x, y = x + chord * self.m.cos(a), y + chord * self.m.sin(a)
            nodes.append((x, y, rotation, moment))
        return nodes


class Problem:
    """A chain whose end conditions and drop of the loaded node determine forces and load. `ends(nodes)` vanishes; the unknowns are the
    three at the start and, where `free_load`, the load; else the load is `factor` times -v at the start."""

    def __init__(self, make, ends, drop):
        self.make, self.ends, self.drop = make, ends, drop

    def solve(self, chain, start, drop, fine):
        """Newton's iteration with differences. Returns the unknowns, the load's slope over the drop, and the nodes."""
        x = list(start)
        h = mp.mpf(10) ** (-mp.dps // 2) if chain.m is mp else 1e-7
        for _ in range(25):
            f, nodes = self.residual(chain, x, drop)
            columns = []
            for i in range(len(x)):
                step = h * max(1, abs(x[i]))
                y = list(x)
                y[i] += step
                columns.append([(a - b) / step for a, b in zip(self.residual(chain, y, drop)[0], f)])
            rows = [[columns[j][i] for j in range(len(x))] for i in range(len(x))]
            move, slopes = linear(rows, f), linear(rows, [0] * (len(x) - 1) + [1])
            size, share = max(map(abs, f)), 1
            while size > 1e-6 and share > 1e-3 and max(map(abs, self.residual(chain, [a - share * b for a, b in zip(x, move)], drop)[0])) > 2 * size:
                share /= 2
            x = [a - share * b for a, b in zip(x, move)]
            if share == 1 and max(abs(a) / max(1, abs(b)) for a, b in zip(move, x)) < fine:
                return x, slopes, nodes
        raise ArithmeticError("no convergence")

    def residual(self, chain, x, drop):
        nodes = chain.shoot(x[:3], x[3] if len(x) == 4 else 0)
        return [*self.ends(nodes), self.drop(nodes) - drop], nodes


def linear(rows, right):
    """Gaussian elimination with pivots."""
    a = [list(row) + [b] for row, b in zip(rows, right)]
    n = len(a)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[pivot] = a[pivot], a[k]
        for i in range(k + 1, n):
            factor = a[i][k] / a[k][k]
            for j in range(k, n + 1):
                a[i][j] -= factor * a[k][j]
    x = [0] * n
    for k in reversed(range(n)):
        x[k] = (a[k][n] - sum(a[k][j] * x[j] for j in range(k + 1, n))) / a[k][k]
    return x


class Path:
    """The path of equilibria over the drop: traced in doubles, refined in mpmath's precision. Its first drops, `tiny`, where forces are so
    small that doubles cancel, are found in mpmath's too, from the guess `start`."""

    def __init__(self, problem, load_of, steps, start, tiny=()):
        self.problem, self.load_of, self.points = problem, load_of, []
        chain, x = problem.make(mp), [mp.mpf(v) for v in start]
        for drop in tiny:
            x, slopes, _ = problem.solve(chain, x, mp.mpf(drop), mp.mpf("1e-12"))
            self.points.append((mp.mpf(drop), list(x), load_of(slopes), list(chain.angles)))
        chain, x, angles = problem.make(doubles), [float(v) for v in x], chain.angles
        chain.angles = [float(a) for a in angles]
        slopes = [0] * len(x)
        for k, drop in enumerate(steps):
            ahead = [a + (drop - steps[k - 1]) * b if k else a for a, b in zip(x, slopes)]
            x, slopes, _ = problem.solve(chain, ahead, drop, 1e-7)
            self.points.append((drop, list(x), load_of(slopes), list(chain.angles)))

    def at(self, drop):
        """Load, slope and nodes at a drop near one of the path, in all digits."""
        near = min(self.points, key=lambda p: abs(p[0] - drop))
        chain = self.problem.make(mp)
        chain.angles = [mp.mpf(a) for a in near[3]]
        x, slopes, nodes = self.problem.solve(chain, [mp.mpf(v) for v in near[1]], mp.mpf(drop), mp.mpf(10) ** (8 - mp.dps))
        return self.load_of(x), self.load_of(slopes), nodes

    def root(self, value, a, b, fine):
        """A drop between a and b at which value((load, slope, nodes)) vanishes, by secants."""
        fa, fb = value(self.at(a)), value(self.at(b))
        for _ in range(30):
            a, b, fa = b, b - fb * (b - a) / (fb - fa), fb
            if abs(b - a) < fine:
                return b
            fb = value(self.at(b))
        raise ArithmeticError("no convergence")

    def folds(self, fine):
        """Drops with a slope of 0 and the loads there. The load is stationary: `fine` of the drop is the square root of its error."""
        for (a, _, s, _), (b, _, t, _) in zip(self.points, self.points[1:]):
            if (s > 0) != (t > 0):
                drop = self.root(lambda p: p[1], mp.mpf(a), mp.mpf(b), fine)
                yield drop, self.at(drop)
