"""A rigid hub with two equal flexible appendages (Elgohary 2015, section 3.1), from the equation of the beam itself.

The inertial deflection w(x) = (r + x) theta + y(x) of one appendage obeys EI w'''' + rho s^2 w = 0 with w(0) = r theta, w'(0) = theta,
EI w''(L) = -I_tip s^2 w'(L), EI w'''(L) = m s^2 w(L). Four functions span its solutions: cos qx, sin qx, e^(-qx), e^(-q(L-x))
with q^4 = -rho s^2/EI; a linear system of four gives their shares for theta = 1. `math` is mpmath.mp or PLAIN (doubles)."""
import cmath
import types

from mpmath import mp

PLAIN = types.SimpleNamespace(cos=cmath.cos, sin=cmath.sin, exp=cmath.exp, sqrt=cmath.sqrt, mpf=float, pi=cmath.pi)


class Craft:
    """The numbers of Table 3.1, with or without tips."""

    def __init__(self, tip=True, math=mp):
        number = math.mpf
        self.math, self.hub, self.rho, self.length, self.radius = math, number(8), number("0.0271875"), number(4), number(1)
        self.stiffness = number("0.1584e10") * number("0.47095e-7")
        self.mass, self.inertia = (number("0.1569"), number("0.0018")) if tip else (number(0), number(0))

    def wave_number(self, s):
        return self.math.sqrt(self.math.sqrt(-self.rho * s * s / self.stiffness))

    def derivatives(self, q, x):
        """Of the four functions at x, orders 0 to 3."""
        m, length = self.math, self.length
        c, s, left, right = m.cos(q * x), m.sin(q * x), m.exp(-q * x), m.exp(-q * (length - x))
        return [[c, s, left, right], [-q * s, q * c, -q * left, q * right],
                [-q * q * c, -q * q * s, q * q * left, q * q * right], [q**3 * s, -(q**3) * c, -(q**3) * left, q**3 * right]]

    def matrix(self, s):
        """The boundary conditions, each divided by the power of q that its largest term has."""
        q = self.wave_number(s)
        root, tip = self.derivatives(q, 0), self.derivatives(q, self.length)
        s2 = s * s / self.stiffness
        bend = [(a + self.inertia * s2 * b) / q**2 for a, b in zip(tip[2], tip[1])]
        shear = [(a - self.mass * s2 * b) / q**3 for a, b in zip(tip[3], tip[0])]
        return [root[0], [v / q for v in root[1]], bend, shear], q

    def determinant(self, s):
        rows, _ = self.matrix(s)
        return eliminated([row + [0] for row in rows])[1]

    def shares(self, s):
        """Of the four functions in w for theta = 1, with the determinant of the system and the wave number."""
        rows, q = self.matrix(s)
        solution, determinant = solved(rows, [self.radius, 1 / q, 0, 0])
        return solution, determinant, q

    def motion(self, s, x=None):
        """B(s) of one appendage, y(x) for theta = 1, and the determinant that vanishes where the hub is locked."""
        shares, determinant, q = self.shares(s)
        root = [sum(a * b for a, b in zip(shares, values)) for values in self.derivatives(q, 0)]
        inertia = self.stiffness * (self.radius * root[3] - root[2]) / (s * s)
        if x is None:
            return inertia, None, determinant
        w = sum(a * b for a, b in zip(shares, self.derivatives(q, self.math.mpf(x))[0]))
        return inertia, w - (self.radius + x), determinant


def eliminated(a):
    """Rows of a matrix, with further columns, brought to triangular form with pivots; and its determinant."""
    n, determinant = len(a), 1
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(a[i][k]))
        if pivot != k:
            a[k], a[pivot], determinant = a[pivot], a[k], -determinant
        determinant *= a[k][k]
        for i in range(k + 1, n):
            factor = a[i][k] / a[k][k]
            for j in range(k, len(a[i])):
                a[i][j] -= factor * a[k][j]
    return a, determinant


def solved(rows, right):
    """The solution of a linear system, and its determinant."""
    a, determinant = eliminated([list(row) + [b] for row, b in zip(rows, right)])
    n = len(a)
    x = [0] * n
    for k in reversed(range(n)):
        x[k] = (a[k][n] - sum(a[k][j] * x[j] for j in range(k + 1, n))) / a[k][k]
    return x, determinant


def crossing(f, a, b):
    """The zero of f between a and b, by the Illinois rule."""
    fa, fb = f(a), f(b)
    for _ in range(200):
        c = b - fb * (b - a) / (fb - fa)
        fc = f(c)
        if (fc < 0) != (fb < 0):
            a, fa = b, fb
        else:
            fa /= 2
        b, fb = c, fc
        if fb == 0 or abs(b - a) <= abs(b) * mp.mpf(10) ** (8 - mp.dps):
            return b
    raise ArithmeticError("no zero found")


def crossings(f, low, high, steps):
    """Zeros of f(p^2) for p between low and high, seen by equal steps of p; the squares."""
    grid = [(low + (high - low) * k / steps) ** 2 for k in range(steps + 1)]
    signs = [f(w) < 0 for w in grid]
    return [crossing(f, grid[k], grid[k + 1]) for k in range(steps) if signs[k] != signs[k + 1]]


def locked(craft, count, kappa=2):
    """The first frequencies at which the hub is locked, and of the free craft: zeros of I_hub + kappa B, one between two of them."""
    determinant = lambda w: mp.re(craft.determinant(mp.mpc(0, w)))
    zeros = crossings(determinant, mp.mpf("0.7"), mp.sqrt(52.4) * mp.pi * (count + 1) / 4, 20 * (count + 2))[:count + 1]

    def free(w):
        inertia, _, d = craft.motion(mp.mpc(0, w))
        return mp.re((craft.hub + kappa * inertia) * d)

    tiny = mp.mpf(10) ** -8
    poles = [crossing(free, a * (1 + tiny), b * (1 - tiny)) for a, b in zip(zeros, zeros[1:])]
    return zeros[:count], poles


def deflection_zeros(craft, x, high):
    def f(w):
        _, y, d = craft.motion(mp.mpc(0, w), x)
        return mp.re(y * d)

    return crossings(f, mp.mpf(1), mp.sqrt(high), 60)


def legendre(n):
    """Nodes and weights of Gauss and Legendre's rule, by Newton's iteration on the three-term recurrence."""
    points = []
    for i in range(1, n + 1):
        x = mp.cos(mp.pi * (i - mp.mpf(1) / 4) / (n + mp.mpf(1) / 2))
        for _ in range(8):
            before, p = mp.mpf(1), x
            for k in range(2, n + 1):
                before, p = p, ((2 * k - 1) * x * p - (k - 1) * before) / k
            slope = n * (before - x * p) / (1 - x * x)
            x -= p / slope
        points.append((x, 2 / ((1 - x * x) * slope * slope)))
    return points


class AssumedModes:
    """(3.45) to (3.49): the hub's angle and shapes phi_i = 1 - cos(i pi x/L) + (-1)^(i+1) (i pi x/L)^2/2, diagonalised:
    theta/u = sum of angle_i^2/(s^2 + squares_i), y(x)/u = sum of angle_i deflection_i(x)/(s^2 + squares_i)."""

    def __init__(self, craft, count):
        self.craft, self.waves = craft, [(i * mp.pi / craft.length, (-1) ** (i + 1)) for i in range(1, count + 1)]
        mass, stiffness = self.matrices()
        inverse = mp.inverse(mp.cholesky(mass))
        values, vectors = mp.eigsy(inverse * stiffness * inverse.T)
        vectors = inverse.T * vectors
        order = sorted(range(count + 1), key=lambda i: values[i])
        self.squares = [abs(values[i]) for i in order]
        self.modes = [[vectors[k, i] for k in range(count + 1)] for i in order]

    def shape(self, x):
        return [1 - mp.cos(k * x) + sign * (k * x) ** 2 / 2 for k, sign in self.waves]

    def slope(self, x):
        return [k * mp.sin(k * x) + sign * k * k * x for k, sign in self.waves]

    def bend(self, x):
        return [k * k * (mp.cos(k * x) + sign) for k, sign in self.waves]

    def deflection(self, i, x):
        return sum(a * b for a, b in zip(self.modes[i][1:], self.shape(x)))

    def matrices(self):
        """Mass and stiffness: each velocity w' = (r + x) theta' + y', for two appendages."""
        c, n = self.craft, len(self.waves) + 1
        mass, stiffness = mp.zeros(n), mp.zeros(n)
        mass[0, 0] = c.hub

        def add(matrix, vector, factor):
            for i in range(n):
                for j in range(n):
                    matrix[i, j] += 2 * factor * vector[i] * vector[j]

        for x, weight in legendre(60):
            x, weight = (1 + x) * c.length / 2, weight * c.length / 2
            add(mass, [c.radius + x] + self.shape(x), weight * c.rho)
            add(stiffness, [0] + self.bend(x), weight * c.stiffness)
        add(mass, [c.radius + c.length] + self.shape(c.length), c.mass)
        add(mass, [1] + self.slope(c.length), c.inertia)
        return mass, stiffness
