"""Random initial value problems of `integrators`: the problems of the library that are not stiff, written anew, and what is known of their
solutions."""
import dataclasses
import math
import operator
import typing

import taylor
from cases import EPS
from mpmath import mp
from taylor import Cosine, Exponential, Power

# Error that a run by a tolerance may have, as the commands' page says: 100 tolerances, or, if it says its digits, those.
MOST_TOLERANCES = 100


@dataclasses.dataclass
class Problem:
    parameters: dict  # with the library's values
    x0: list
    rates: typing.Callable  # (parameters, time, state as nodes, a time inside of the smooth piece)
    longest: float = 100  # time beyond which a run is of no use
    is_near_own: bool = False  # any other state would be meaningless
    is_second_order: bool = True
    breaks: typing.Callable = lambda p: ()  # times at which the right-hand side is not smooth


def cube(x):
    return x * x * x


def duffing(p, _t, x, _piece):
    return [x[1], x[0] * -mp.mpf(p["natural_frequency"]) ** 2 - cube(x[0]) * p["hardening"]]


def impact(p, t, x, piece):
    force = t if 0 < piece < p["duration"] / 2 else -t + p["duration"] if 0 < piece < p["duration"] else t * 0
    return [x[1], force * p["slope"] + duffing(p, t, x, piece)[1]]


def three_dof(p, t, x, _piece):
    x1, x2, x3, v1, v2, v3 = x

    def element(i, stretch, rate):
        return stretch * p[f"k{i}"] + rate * p[f"c{i}"] + cube(stretch) * p[f"l{i}"]

    e1, e2, e3 = element(1, x1, v1), element(2, x1 - x2, v1 - v2), element(3, x2 - x3, v2 - v3)
    e4 = t * 0 + p["e4"] if "e4" in p else element(4, x3, v3)
    pull = Cosine(t, p["frequency"]) * p["force"]
    return [v1, v2, v3, (-e1 - e2) * (1 / mp.mpf(p["m1"])), (pull + e2 - e3) * (1 / mp.mpf(p["m2"])), (e3 - e4) * (1 / mp.mpf(p["m3"]))]


def van_der_pol(p, _t, x, _piece):
    return [x[1], (1 - x[0] * x[0]) * x[1] * p["mu"] - x[0]]


def driven(p, t, x):
    """The force on Duffing's oscillators and their damping."""
    return Cosine(t, p["frequency"]) * p["force"] - x * p["damping"]


def driven_duffing(p, t, x, _piece):
    return [x[1], driven(p, t, x[1]) - x[0] * p["stiffness"] - cube(x[0]) * p["hardening"]]


def forced_duffing(p, t, x, _piece):
    return [x[1], driven(p, t, x[1]) - cube(x[0]) * p["hardening"]]


def two_dof(p, t, x, _piece):
    pull = (x[0] - x[1]) * p["coupling"]
    return [x[2], x[3], driven(p, t, x[2]) - x[0] * p["stiffness"] - cube(x[0]) * p["hardening"] - pull,
            pull - x[3] * p["damping"] - x[1] * p["stiffness"] - cube(x[1]) * p["hardening"]]


def linear(p, t, x, _piece):
    w = mp.mpf(p["natural_frequency"])
    return [x[1], Cosine(t, p["frequency"]) * p["force"] - x[1] * (2 * p["damping_ratio"] * w) - x[0] * w**2]


def lorenz(p, _t, x, _piece):
    u, v, w = x
    return [(v - u) * p["sigma"], u * p["r"] - v - u * w, u * v - w * p["b"]]


def oscillator(p, t, x, _piece):
    sine = Cosine(t, 2, -mp.pi / 2)
    return [x[1], x[0] * -p["stiffness"] - x[1] * (x[0] * x[0]) * sine * p["epsilon"]]


def projectile(p, _t, x, _piece):
    resistance = Exponential(x[2] * (-1 / mp.mpf(p["scale_height"]))) * p["drag"]
    return [*x[3:], -(resistance * (x[3] - x[2] * p["wind_x"])), -(resistance * (x[4] - x[2] * p["wind_y"])), -(resistance * x[5]) - p["gravity"]]


def bodies(p, _t, x, _piece):
    rates = [None] * 12
    for i in range(4):
        for j in range(i):
            apart = [x[3 * j + k] - x[3 * i + k] for k in range(3)]
            pull = Power(apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2], -3) * p["gravity"]
            for k in range(3):
                for body, mass, sign in ((i, j, 1), (j, i, -1)):
                    part = pull * apart[k] * (sign * p[f"m{mass + 1}"])
                    rates[3 * body + k] = part if rates[3 * body + k] is None else rates[3 * body + k] + part
    return [*x[12:], *rates]


PROBLEMS = {
    "duffing": Problem({"natural_frequency": 1, "hardening": 1}, [1, 0], duffing),
    "impact": Problem({"natural_frequency": 1, "hardening": 1, "slope": 2, "duration": 1}, [0, 0], impact,
                      breaks=lambda p: (0.0, p["duration"] / 2, p["duration"])),
    "three-dof": Problem({"m1": 2, "m2": 1, "m3": 0.5, "c1": 0, "c2": 0.05, "c3": 0, "c4": 0, "k1": 2, "k2": 1, "k3": 0.5, "k4": 0, "l1": 0.2,
                          "l2": 0, "l3": 0, "l4": 0, "force": 0.2, "frequency": math.sqrt(0.5), "e4": 0}, [0] * 6, three_dof),
    "van-der-pol": Problem({"mu": 10}, [2, 0], van_der_pol, 20),
    "driven-duffing": Problem({"damping": 0, "stiffness": 1, "hardening": 1, "force": 1, "frequency": 1}, [1, 0], driven_duffing),
    "two-dof": Problem({"damping": 0.1, "stiffness": 1, "hardening": 1, "coupling": 0.5, "force": 1, "frequency": 1}, [1, 0, 0, 0], two_dof),
    "linear": Problem({"natural_frequency": 1, "damping_ratio": 0, "force": 0, "frequency": 1}, [1, 0], linear),
    "lorenz": Problem({"sigma": 10, "r": 28, "b": 8 / 3}, [0, 1, 0], lorenz, 30, is_second_order=False),
    "oscillator": Problem({"stiffness": 0.306, "epsilon": 5}, [-0.5, 0], oscillator, 30),
    "projectile": Problem({"drag": 0.01, "gravity": 10, "scale_height": 1000, "wind_x": 1000, "wind_y": 500}, [0, 0, 0, 400, 0, 50], projectile, 30,
                          is_near_own=True),
    "bodies": Problem({"gravity": 1e-6, "m1": 1, "m2": 1, "m3": 5, "m4": 1},
                      [0, 0, 0, 3, 0, 0, 3, 4, 0, 1.5, 1.5, 0] + [0] * 9 + [-0.00125, 0.0005, 0.0005], bodies, 1000, is_near_own=True),
    "forced-duffing": Problem({"damping": 0.05, "hardening": 1, "force": 7.5, "frequency": 1}, [3, 4], forced_duffing)}


@dataclasses.dataclass
class Method:
    takes_step: bool = False
    chooses_steps: bool = False  # by a tolerance
    is_for_accelerations: bool = False
    settings: tuple = ()  # of a command line, besides


METHODS = (
    {name: Method(takes_step=True) for name in ("euler", "backward-euler", "rk4", "rk6")} |
    {name: Method(takes_step=True, is_for_accelerations=True) for name in ("explicit", "newmark", "hht", "generalized-alpha")} |
    {name: Method(takes_step=True, chooses_steps=True, is_for_accelerations=True) for name in ("laier", "argyris", "hoff", "bazzi")} |
    {name: Method(takes_step=True, settings=("nodes",)) for name in ("mcpi", "lgl-coll", "radau-coll")} |
    {name: Method(chooses_steps=True) for name in (
        "ode45", "dop853", "cvode-adams", "cvode-bdf", "arkode-erk", "arkode-dirk", "gsl-rkf45", "gsl-rk8pd", "gsl-bsimp", "gsl-msadams", "gsl-msbdf",
        "odeint-dopri5", "odeint-fehlberg78", "odeint-bulirsch-stoer", "odeint-rosenbrock4")} |
    {"rkn1210": Method(chooses_steps=True, is_for_accelerations=True), "series": Method(takes_step=True, chooses_steps=True, settings=("order",)),
     "mtl": Method(takes_step=True, settings=("points",)), "rbf-coll": Method(takes_step=True, settings=("nodes", "shape")),
     "adaptive-collocation": Method(chooses_steps=True, settings=("nodes", "shape"))})
HERMITIAN = ("laier", "newmark", "argyris", "hoff", "bazzi")


@dataclasses.dataclass
class Known:
    """States at several times, in fixed point."""

    x: list
    doubt: list  # differences to a computation of another order with fewer digits, as doubles
    size: list  # greatest |x_i| at these times and at the start

    def error(self, k, printed):
        """How far off each component of a state at the time k is."""
        return [abs(taylor.floating(taylor.fixed(a) - b)) for a, b in zip(printed, self.x[k])]

    def truth(self, k):
        return [taylor.floating(x) for x in self.x[k]]


class Question:
    """A problem with other parameters and a random initial state, or one near the problem's own."""

    def __init__(self, draw):
        self.name = draw.one_of(list(PROBLEMS))
        self.problem = PROBLEMS[self.name]
        self.p = {name: any_parameter(draw, value) for name, value in self.problem.parameters.items()}
        if "e4" in self.p and draw.chance(0.5):  # a spring and damper that the library's text names; without it they have their own values
            del self.p["e4"]
        self.x0 = [x * draw.uniform(0.9, 1.1) if self.problem.is_near_own else 0.0 if draw.chance(0.2) else draw.signed_log(1e-3, 3)
                   for x in map(float, self.problem.x0)]
        self.words = f"--problem {self.name}" + "".join(f" --set {name}={value!r}" for name, value in self.p.items())
        self.words += " --initial " + ",".join(map(repr, self.x0))

    def method(self, draw, takes_step):
        """The name of one that takes a step, or chooses its steps, and suits the problem."""
        return draw.one_of([name for name, m in METHODS.items() if (m.takes_step if takes_step else m.chooses_steps) and
                            (self.problem.is_second_order or not m.is_for_accelerations)])

    def _states(self, x0, t0, times, **options):
        def rates(t, x, piece):
            return self.problem.rates(self.p, t, x, piece)

        with mp.workdps(60):
            return taylor.states(rates, x0, t0, times, self.problem.breaks(self.p), **options)

    def known(self, t0, times):
        """The states at times one after the other; nothing if the solution does not arrive in bounded work."""
        x, other = self._states(self.x0, t0, times), self._states(self.x0, t0, times, order=24, digits=19)
        if not x or not other:
            return None
        doubt = [[abs(taylor.floating(a - b)) for a, b in zip(p, q)] for p, q in zip(x, other)]
        size = [max(abs(taylor.floating(state[i])) for state in [*x, list(map(taylor.fixed, self.x0))]) for i in range(len(self.x0))]
        return Known(x, doubt, size)

    def moved(self, t0, times, known, relative, absolute):
        """What the problem makes of errors of one tolerance in all components at any time before: the greatest up to each of these times."""
        made, most, x, n = [], [], [taylor.fixed(c) for c in self.x0], len(self.x0)
        budget = 2e7  # products of numbers
        for k, t in enumerate(times):
            d = self._derivative(x, t0, t, known, k)
            budget -= n**3 * (len(made) + 1)
            if not d or budget < 0:
                return None
            one = one_tolerance([taylor.floating(c) for c in x], known.size, relative, absolute)
            made = [[[sum(map(operator.mul, row, column)) for column in zip(*error)] for row in d] for error in made]
            made.append([[c * s for c, s in zip(row, one)] for row in d])
            most.append([max(sum(map(abs, error[i])) for error in made) for i in range(n)])
            t0, x = t, known.x[k]
        return most

    def _derivative(self, x, t0, t1, known, k):
        """d x(t1)/d x(t0) by differences, of which 13 digits are right."""
        columns = []
        for j, size in enumerate(known.size):
            by = taylor.fixed(1e-12 * (max(abs(taylor.floating(x[j])), 1e-3 * size) or 1))
            start = [mp.ldexp(c + by * (i == j), -taylor.BITS) for i, c in enumerate(x)]
            end = self._states(start, t0, [t1], seconds=2)
            if not end:
                return None
            columns.append([taylor.floating((a - b << taylor.BITS) // by) for a, b in zip(end[0], known.x[k])])
        return list(zip(*columns))


def any_parameter(draw, value):
    """A parameter times a factor."""
    if draw.chance(0.4):
        value = value * draw.log_uniform(0.1, 10) + (0.5 if draw.chance(0.1) else 0)
    return float(max(value, 0))


def one_tolerance(x, size, relative, absolute):
    """One tolerance of each component: with the rounding that steps leave, sixteen units of its size."""
    return [absolute + relative * abs(c) + 16 * EPS * s for c, s in zip(x, size)]
