"""Random toggles by `homotopy toggle` and `limit-points`: forces, stability, limit points and bifurcations by beam-columns written anew, Williams'
equation by its closed form."""
import dataclasses
import math

from cases import EPS, failed, randomised_test, judged, needs, number, ran, undecided, wrong
from half_toggle import EA, EI, LENGTH, HalfToggle, flexibility
from mpmath import mp

needs_homotopy = needs("homotopy")
SOLVERS = ["newton", "damped-newton", "continuous-newton", "broyden", "least-squares", "steepest-descent", "fictitious-time", "vector-homotopy",
           "chow-yorke", "scalar-homotopy", "fixed-point", "newton-homotopy", "optimal-iterative", "levenberg-marquardt", "dogleg",
           "energy-trust-region", "riks", "crisfield", "gdc"]


class Asked:
    """A toggle as typed."""

    def __init__(self, draw, command):
        self.height = draw.uniform(0.2, 1.2) if draw.chance(0.5) else draw.log_uniform(0.02, 12.93)
        self.words, self.elements = f"homotopy {command} --height {self.height!r}", 4
        self.is_williams = draw.chance(0.2)
        if self.is_williams:
            self.words += " --model williams"
        elif draw.chance(0.7):
            self.elements = draw.whole(1, 14 if draw.chance(0.2) else 6)
            self.words += f" --elements {self.elements}"


class Williams:
    """Williams' equation (2.17 to 2.21), in doubles or in mpmath's numbers."""

    def __init__(self, height):
        self.h = height

    def compression(self, d):
        return EA / LENGTH * (d * self.h / LENGTH - 6 * d * d / (10 * LENGTH))

    def n(self, d):
        """The compression in units of EI/l^2."""
        return self.compression(d) * LENGTH**2 / EI

    def load(self, d):
        n = -self.n(d)
        return 2 * (EI / LENGTH**3 * (4 / self.u(n / 4)[0] + n) * d + self.compression(d) * self.h / LENGTH)

    def slope(self, d):
        n, p = -self.n(d), EA / LENGTH * (self.h / LENGTH - 12 * d / (10 * LENGTH))
        u, by_y = self.u(n / 4)[:2]
        return 2 * (EI / LENGTH**3 * (4 / u + n - (1 - by_y / u**2) * p * LENGTH**2 / EI * d) + p * self.h / LENGTH)

    def u(self, y):
        return flexibility(y)

    def last(self, end):
        """The drop at the pole of d_5, if there is one before the end."""
        most = 80.762914225706519903  # 4 x^2, tan x = x
        low, high = 0, min(self.h / 1.2, end)  # the latter is the top of the compression
        if self.n(high) < most:
            return end
        for _ in range(64):
            middle = (low + high) / 2
            low, high = (middle, high) if self.n(middle) < most else (low, middle)
        return low


class WilliamsInDigits(Williams):
    def u(self, y):
        r = mp.sqrt(y)  # imaginary under compression
        c = (r * mp.coth(r)).real
        u = (c - 1) / y
        return u, (1 - 3 * u - y * u * u) / (2 * y)


class Solved:
    """The printed success."""

    def __init__(self, cells):
        self.drop, self.residual, self.bound, self.stability, self.critical = number(cells[1]), number(cells[2]), number(cells[4]), *cells[5:]


def judged_closed(a, s, r):
    scale = abs(a.load) / 2
    with mp.workdps(60):
        w, d = WilliamsInDigits(mp.mpf(a.height)), mp.mpf(s.drop)
        rest = abs(w.load(d) - a.load) / 2
        rounding = 64 * EPS * (abs(d) * (abs(w.slope(d)) + abs(w.slope(mp.mpf(10) ** -30))) + abs(a.load))
        return judged(rest / (s.bound * scale * (1 + 1e-5) + rounding), 1, r.words)


def path_to(toggle, a):
    """From rest up to the load, or to the first change of stability; nothing if it does not come so far."""
    sign = -1 if a.load < 0 else 1
    share = min(0.02, 0.1 * abs(a.load) / toggle.rest().slope / a.height + 1e-9)
    path = toggle.path(sign, share, lambda p: len(p) < 3000 and p[-1].is_stable() and sign * p[-1].load < abs(a.load))
    return path if len(path) > 1 and (not path[-1].is_stable() or sign * path[-1].load >= abs(a.load)) else None


def judged_way(a, s, toggle, r):
    """What the command says of the way from rest, beside the independent one; nothing if that is not known."""
    path = path_to(toggle, a)
    if not path:
        return None
    if not path[-1].is_stable():
        critical = toggle.between(path[-2], path[-1], lambda p: not p.is_stable())[0].load
        if abs(critical / a.load - 1) < 1e-5:
            return None
        if critical < a.load:
            if not s.critical:
                return wrong(f"{r.words}: a critical load, {critical!r}")
            return judged(abs(number(s.critical) / critical - 1), 1e-6, f"{r.words}: critical load {s.critical}, {critical!r}")
    if s.critical:
        return wrong(f"{r.words}: no critical load, and not {s.critical}")
    drop = toggle.between(path[-2], path[-1], lambda p: abs(p.load) >= abs(a.load))[1].drop
    # Is it said that the shape is another one than that on the path from rest?
    other = abs(drop - s.drop) / (1e-3 * a.height)
    if ("not on the path from rest" in r.errors) != (other > 1) and abs(other - 1) > 1e-3:
        return wrong(f"{r.words}: from rest a drop of {drop!r}; {r.errors}")
    return judged(0, 1, r.words)


def shape_at(toggle, drop, most=3000):
    """On the path from rest, followed to this drop; nothing if it does not come so far."""
    share = max(0.01, abs(drop) / toggle.height / 1000)
    sign = math.copysign(1, drop)
    path = toggle.path(sign, share, lambda p: len(p) < most and abs(p[-1].drop) < abs(drop))
    return toggle.at(drop, min(path, key=lambda p: abs(p.drop - drop)).x) if abs(path[-1].drop) >= abs(drop) else None


def judged_shape(a, s, r):
    """The load that the independent toggle carries at the printed drop: it is off by the residual times the motions that go with a drop, to first
    order. And what is said of stability and of the way from rest."""
    toggle = HalfToggle(a.height, a.elements)
    p = shape_at(toggle, s.drop)
    if not p:
        return undecided(r.words)
    # F in double is rounded with every displacement, with the load, and with the places of nodes, which an element of a share 1/m of the member has
    # m times as much of.
    rounding = 16 * (4 + a.elements) * EPS * (p.rounding + abs(a.load))
    ratio = abs(p.load - a.load) / 2 / ((s.bound * abs(a.load) / 2 * (1 + 1e-5) + rounding) * math.hypot(*p.way))
    way = judged_way(a, s, toggle, r)
    if not ratio <= 1:
        # Members may have bowed, or have looped: another shape of the same drop, of which nothing is printed. The command has to say so.
        if "not on the path from rest" in r.errors or "lies beyond" in r.errors:
            return way if way and way.verdict == "wrong" else undecided(r.words)
        if s.bound > 1e-6 and ratio < 2:  # what is of second order in a large residual
            return undecided(r.words)
        return judged(ratio, 1, f"{r.words}: a drop of {s.drop!r}, at which the load is {p.load!r}")
    if p.least > 1e-6 and s.stability != "unknown" and p.is_stable() != (s.stability == "stable"):
        return wrong(f"{r.words}: {s.stability}, and there are {p.symmetric} and {p.antisymmetric} motions")
    found = way or judged(0, 1, r.words)
    found.ratio = max(found.ratio, ratio)
    return found


@needs_homotopy
@randomised_test(quick=10, full=3_000)
def test_toggles_carry_their_load(draw):
    a = Asked(draw, "toggle")
    a.load = draw.signed_log(1e-3, 1e4 if draw.chance(0.3) else 300)
    if draw.chance(0.7):
        a.load = abs(a.load)
    a.solver = draw.one_of(SOLVERS) if draw.chance(0.7) else None
    a.words += f" --solver {a.solver}" if a.solver else ""
    a.words += f" --load {a.load!r}"
    if draw.chance(0.5):
        a.words += f" --tolerance {draw.log_uniform(1e-14, 1e-2)!r}"
    r = ran(a.words)
    if r.exit_code:
        return failed(r)
    if len(r.rows) != 1 or len(r.rows[0]) != 7 or r.rows[0][0] != "success":
        return wrong(r.words + ": rows")
    s = Solved(r.rows[0])
    if not math.isfinite(s.drop) or not s.residual <= s.bound:
        return wrong(f"{r.words}: {','.join(r.rows[0])}")
    return judged_closed(a, s, r) if a.is_williams else judged_shape(a, s, r)


@dataclasses.dataclass
class Event:
    """A limit point or bifurcation."""

    kind: str
    motion: str
    load: float
    drop: float


def changes(toggle, low, high):
    """Those of the inertia between two neighbours on the path."""
    def same(p, q):
        return p.symmetric == q.symmetric and p.antisymmetric == q.antisymmetric

    for _ in range(8):
        if same(low, high):
            return
        before, after = toggle.between(low, high, lambda p, low=low: not same(p, low))
        place = before
        # Beside a singular matrix rounding decides the slope and the counts: both are looked at away from it.
        off = 1e-7 * toggle.height
        behind, ahead = toggle.at(before.drop - off, before.x) or before, toggle.at(after.drop + off, after.x) or after
        if not same(behind, ahead) and ahead.drop <= high.drop:  # else two changes are near to each other, or one to the next point
            before, after = behind, ahead
        is_symmetric = before.antisymmetric == after.antisymmetric
        is_limit = is_symmetric and (behind.slope > 0) != (ahead.slope > 0)
        yield Event(("maximum" if behind.slope > 0 else "minimum") if is_limit else "bifurcation", "symmetric" if is_symmetric else "antisymmetric",
                    place.load, place.drop)
        low = after


def expected_events(toggle):
    """As long as the drop grows along the path; and whether that is as far as the command goes."""
    def is_through(p):
        return p.drop >= 2.2 * toggle.height and p.slope > 0 and p.is_stable()

    path = toggle.path(1, 0.01, lambda points: len(points) < 2000 and not is_through(points[-1]))
    return [event for low, high in zip(path, path[1:]) for event in changes(toggle, low, high)], is_through(path[-1])


def root(f, low, high):
    is_positive = f(low) > 0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (f(middle) > 0) == is_positive else (low, middle)
    return low


def expected_of_williams(w, end):
    sway, bow = 20.190728556426629975, 39.478417604357434475  # tan x = x, 2 pi
    functions = [("", "symmetric", w.slope), ("bifurcation", "antisymmetric", lambda d: w.n(d) - sway),
                 ("bifurcation", "symmetric", lambda d: w.n(d) - bow)]
    parts, events = 20_000, []
    for kind, motion, f in functions:
        values = [f(end * i / parts) for i in range(parts)]
        for i, (low, high) in enumerate(zip(values, values[1:])):
            if (low > 0) != (high > 0):
                d = root(f, end * i / parts, end * (i + 1) / parts)
                events.append(Event(kind or ("maximum" if low > 0 else "minimum"), motion, w.load(d), d))
    return sorted(events, key=lambda event: event.drop)


def compared(printed, expected, is_whole, r):
    """Both lists, as far as the expected one goes. critical_points() promises 1e-8 of loads."""
    what = f"{r.words}: {printed}; expected {expected}"
    if len(printed) < len(expected) or (is_whole and len(printed) > len(expected)):
        return wrong(what)
    if any((p.kind, p.motion) != (q.kind, q.motion) for p, q in zip(printed, expected)):
        return wrong(what)
    if not expected:
        return judged(0, 1e-8, what) if is_whole else undecided(what)
    return judged(max(abs(p.load - q.load) for p, q in zip(printed, expected)) / max(abs(e.load) for e in expected), 1e-8, what)


@needs_homotopy
@randomised_test(quick=5, full=1_000)
def test_limit_points_are_those_of_another_element(draw):
    a = Asked(draw, "limit-points")
    r = ran(a.words)
    if r.exit_code:
        return failed(r)
    if any(len(row) != 4 for row in r.rows):
        return wrong(r.words + ": rows")
    printed = [Event(row[0], row[3], number(row[1]), number(row[2])) for row in r.rows]
    if a.is_williams:
        w = Williams(a.height)
        return compared(printed, expected_of_williams(w, w.last(2.2 * a.height) * (1 - 1e-9)), True, r)
    return compared(printed, *expected_events(HalfToggle(a.height, a.elements)), r)
