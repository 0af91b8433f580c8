"""A toggle of beam-columns written anew: forces and stiffness by closed forms in doubles, the symmetric path by prescribed drops. Members, inch and
pound as in Table 2.1. Nothing of nlmech."""
import dataclasses
import math

from mpmath import mp

LENGTH, EA, EI = 12.94, 1.885e6, 9.27e3
HALF_TURN = math.pi
BAND = 5  # motions of neighbouring nodes
# u = 2 sum (-1)^k zeta(2 k + 2) y^k/pi^(2 k + 2)
BERNOULLI = [float((-1) ** k * 2 * mp.zeta(2 * k + 2) / mp.pi ** (2 * k + 2)) for k in range(40)]


def flexibility(y):
    """u of y^(1/2) coth y^(1/2) = 1 + y u = c, and its first two derivatives. 2 y c' = c - c^2 + y gives those."""
    if abs(y) < 1:
        u = slope = bend = 0.0
        for term in reversed(BERNOULLI):
            bend, slope, u = bend * y + 2 * slope, slope * y + u, u * y + term
        return u, slope, bend
    r = math.sqrt(abs(y))
    u = ((r / math.tanh(r) if y > 0 else r / math.tan(r)) - 1) / y
    slope = (1 - 3 * u - y * u * u) / (2 * y)
    return u, slope, (-3 * slope - u * u - 2 * y * u * slope) / (2 * y) - slope / y


def bendings(n):
    """Stiffnesses of both bendings of a member under the normal force n EI/l^2: 4/u and 4 (1 + y u), y = n/4; each with two derivatives by n."""
    u, slope, bend = flexibility(n / 4)
    return ((4 / u, -slope / u**2, (2 * slope**2 / u - bend) / (4 * u**2)), (4 + n * u, u + n / 4 * slope, (2 * slope + n / 4 * bend) / 4))


def axial_of(strain, a, s, softness):
    """The normal force of a stretch under both bendings: the root of a function that falls between the pole at -4 pi^2 and infinity."""
    low, high = -4 * math.pi**2 * (1 - 1e-15), max(1.0, 2 * (abs(strain) + 1) / softness)
    n = min(max(strain / softness, low / 2), high / 2)
    for _ in range(200):
        of_a, of_s = bendings(n)
        value = strain + (a * a * of_a[1] + s * s * of_s[1]) / 2 - softness * n
        slope = (a * a * of_a[2] + s * s * of_s[2]) / 2 - softness
        low, high = (n, high) if value > 0 else (low, n)
        before, n = n, n - value / slope if slope < 0 else low
        if not low < n < high:
            n = low + (high - low) / 2
        if abs(n - before) <= 4e-16 * abs(n):
            break
    return n


def outer(a, b, factor, k):
    """k += factor a b^T."""
    for row, x in zip(k, a):
        if x:
            for j, z in enumerate(b):
                row[j] += factor * x * z


class Element:
    """A beam-column along (dx, dy)."""

    def __init__(self, dx, dy):
        self.dx, self.dy, self.length = dx, dy, math.hypot(dx, dy)

    def force_and_stiffness(self, d):
        """Of x, y and rotation of both ends: derivatives of the energy by stretch, antisymmetric and symmetric bending, times theirs by the motions.
        The normal force is the one that makes the energy stationary."""
        dx, dy, l = self.dx, self.dy, self.length
        u, v = d[3] - d[0], d[4] - d[1]
        x, y = dx + u, dy + v
        reach = math.hypot(x, y)
        stretch = (2 * (dx * u + dy * v) + u * u + v * v) / (reach + l)
        turned = math.atan2(dx * v - dy * u, dx * x + dy * y)  # without cancellation
        a, s = math.remainder((d[2] + d[5]) / 2 - turned, 2 * math.pi), (d[2] - d[5]) / 2
        n = axial_of(stretch / l, a, s, EI / (EA * l * l))
        (ga, ga1, ga2), (gs, gs1, gs2) = bendings(n)
        unit = EI / l
        axial, of_a, of_s = n * unit / l, unit * ga * a, unit * gs * s
        c, q = x / reach, y / reach
        along, across = (-c, -q, 0.0, c, q, 0.0), (q, -c, 0.0, -q, c, 0.0)
        by_a = tuple(h - t / reach for h, t in zip((0, 0, 0.5, 0, 0, 0.5), across))
        by_s = (0.0, 0.0, 0.5, 0.0, 0.0, -0.5)
        force = [axial * r + of_a * p + of_s * t for r, p, t in zip(along, by_a, by_s)]
        by_n = [unit * (r / l + ga1 * a * p + gs1 * s * t) for r, p, t in zip(along, by_a, by_s)]
        k = [[0.0] * 6 for _ in range(6)]
        outer(by_a, by_a, unit * ga, k)
        outer(by_s, by_s, unit * gs, k)
        outer(by_n, by_n, -1 / (unit * ((a * a * ga2 + s * s * gs2) / 2 - EI / (EA * l * l))), k)
        outer(across, across, axial / reach, k)
        outer(along, across, of_a / reach**2, k)
        outer(across, along, of_a / reach**2, k)
        return force, k


def factored(k, places):
    """L and D of the part of a symmetric matrix of neighbours, eliminated in the order of its rows."""
    rows = [[k[i][j] for j in places] for i in places]
    for i, row in enumerate(rows):
        end = min(i + BAND + 1, len(rows))
        for j in range(i + 1, end):
            share = rows[j][i] / row[i] if row[i] else math.inf
            for p in range(i + 1, end):
                rows[j][p] -= share * row[p]
            rows[j][i] = share
    return rows


def solved(rows, right):
    """The solution by what factored() returns; not finite if a pivot is zero."""
    x = list(right)
    for i in range(len(x)):
        for j in range(max(0, i - BAND), i):
            x[i] -= rows[i][j] * x[j]
    for i in reversed(range(len(x))):
        x[i] = x[i] / rows[i][i] if rows[i][i] else math.inf
        for j in range(i + 1, min(i + BAND + 1, len(x))):
            x[i] -= rows[j][i] * x[j]
    return x


@dataclasses.dataclass
class AtDrop:
    """An equilibrium under a prescribed drop."""

    x: list  # three motions of each node from the first above the base to the apex
    drop: float
    load: float
    slope: float  # dW/ddrop
    way: list  # dx/ddrop
    symmetric: int  # negative eigenvalues of the whole toggle's stiffness, of both kinds of motions
    antisymmetric: int
    least: float  # smallest pivot over its diagonal; near 0: the counts are open
    rounding: float  # of the load in doubles, if each force is rounded once: |K| |x|

    def is_stable(self):
        return self.symmetric + self.antisymmetric == 0


class HalfToggle:
    """The left member with m beam-columns."""

    def __init__(self, height, elements):
        self.m, self.height, self.apex = elements, height, 3 * elements - 2
        self.element = Element(math.sqrt((LENGTH - height) * (LENGTH + height)) / elements, height / elements)
        # Where a straight member would carry 20.19 EI/l^2.
        self.buckling_drop = 20.19 * EI / EA / height

    def force_and_stiffness(self, x):
        """Forces that hold it, and their derivatives."""
        size = 3 * self.m
        force, k = [0.0] * size, [[0.0] * size for _ in range(size)]
        for i in range(self.m):
            begin = 3 * i - 3
            f, own = self.element.force_and_stiffness([0.0] * 3 + x[:3] if i == 0 else x[begin:begin + 6])
            for p in range(3 if i == 0 else 0, 6):
                force[begin + p] += f[p]
                for q in range(3 if i == 0 else 0, 6):
                    k[begin + p][begin + q] += own[p][q]
        return force, k

    def turned(self, x):
        """The mean of a shape and of itself after half a turn: no member bows."""
        mean = list(x)
        for i in range(1, self.m):
            here, there = 3 * i - 3, 3 * (self.m - i) - 3
            for k in (0, 1):
                mean[here + k] = (x[here + k] + x[k - 3] - x[there + k]) / 2
            mean[here + 2] = (x[here + 2] + x[there + 2]) / 2
        return mean

    def described(self, x, force, k):
        """What goes with an equilibrium."""
        inner, a = list(range(3 * self.m - 3)), self.apex
        way = [*solved(factored(k, inner), [k[i][a] for i in inner]), 0.0, -1.0, 0.0]
        way = self.turned(way)
        found = []
        for places in ([*inner, a], [*inner, a - 1, a + 1]):
            rows = factored(k, places)
            pivots = [rows[i][i] for i in range(len(places))]
            found.append((sum(p < 0 for p in pivots), min(abs(p / (k[j][j] or 1)) for p, j in zip(pivots, places))))
        (symmetric, least), (antisymmetric, other) = found
        rounding = math.sqrt(sum(sum(abs(c * d) for c, d in zip(row, x)) ** 2 for row in k))
        return AtDrop(x, -x[a], -2 * force[a], -2 * sum(c * d for c, d in zip(k[a], way)), way, symmetric, antisymmetric, min(least, other), rounding)

    def rest(self):
        x = [0.0] * (3 * self.m)
        return self.described(x, *self.force_and_stiffness(x))

    def at(self, drop, near):
        """On the path from rest, on which half a turn about its middle maps the member on itself, from a shape nearby; nothing if Newton's iteration
        does not converge."""
        x = list(near)
        x[self.apex] = -drop
        x, inner = self.turned(x), list(range(3 * self.m - 3))
        for _ in range(12):
            force, k = self.force_and_stiffness(x)
            if not inner:
                return self.described(x, force, k)
            move = solved(factored(k, inner), [force[i] for i in inner])
            x = self.turned([c - d for c, d in zip(x, move)] + x[-3:])
            size = math.hypot(*move)
            if not math.isfinite(size):
                return None
            if size <= 1e-9 * math.hypot(*x):  # what is left goes with its square
                return self.described(x, *self.force_and_stiffness(x))
        return None

    def next_of(self, here, step):
        guess = [c + step * w for c, w in zip(here.x, here.way)]
        found = self.at(here.drop + step, guess)
        if not found or not math.isfinite(found.load):
            return None
        # No jump to a neighbouring branch: what the straight guess was off by is a small part of the way.
        return found if math.dist(found.x, guess) <= 0.1 * math.dist(guess, here.x) else None

    def path(self, sign, share, goes_on):
        """From rest, upwards or downwards, by steps of a share of the height and less. Members that have dropped by much less than they buckle at
        take a share of that: a long step would stay on the straight shape."""
        points, part = [self.rest()], 1
        while goes_on(points):
            most = min(share * self.height, (self.buckling_drop + abs(points[-1].drop)) / 20)
            found = self.next_of(points[-1], sign * part * most)
            if found:
                points.append(found)
                part = min(2 * part, 1)
            else:
                part /= 2
                if part < 1e-4:
                    break
        return points

    def between(self, low, high, has):
        """The place between two neighbours on a path where a property of the second begins, to 2e-10 of a step."""
        for _ in range(32):
            guess = [(a + b) / 2 for a, b in zip(low.x, high.x)]
            # Where Newton's iteration does not converge, a mean will do.
            middle = self.at((low.drop + high.drop) / 2, guess) or self.described(guess, *self.force_and_stiffness(guess))
            low, high = (low, middle) if has(middle) else (middle, high)
        return low, high
