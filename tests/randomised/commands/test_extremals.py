"""Random boundary value problems of the Duffing oscillator under an unknown force: the initial state that `rbf_inverse duffing` prints is
integrated by Taylor series in 20 digits."""
import math

import taylor
from cases import EPS, failed, randomised_test, judged, needs, number, ran, wrong
from mpmath import mp


def prescribed(which):
    """Which of x1, x2 are prescribed at the start, and at the end."""
    if which == "free":
        return (True, True), (False, False)
    if which in ("fixed", "harmonic"):
        return (True, True), (True, True)
    if which == "final-only":
        return (False, False), (True, True)
    return (which[1] == "1", which[1] == "2"), (which[3] == "1", which[3] == "2")


class Asked:
    def __init__(self, draw):
        self.which = draw.one_of(["free", "fixed", "x1x1", "x1x2", "x2x1", "x2x2", "final-only", "harmonic"])
        self.time = draw.log_uniform(1e-2, 20 if draw.chance(0.2) else 4)
        self.beta = 0.0 if draw.chance(0.1) else draw.log_uniform(1e-3, 1e3 if draw.chance(0.2) else 10)
        self.words = f"rbf_inverse duffing --case {self.which} --final-time {self.time!r} --beta {self.beta!r}"
        self.weights, self.bound = [1.0, 1.0], math.inf
        if self.which == "harmonic":
            w, t = 3, self.time  # Eq. 5.34 with amplitudes 1.5, 2, 3
            self.target = [1.5 * math.cos(w * t) + 2 * math.cos(3 * w * t) + 3 * math.cos(w * t / 3),
                           -(1.5 * w * math.sin(w * t) + 6 * w * math.sin(3 * w * t) + w * math.sin(w * t / 3))]
        else:
            self.target = [0.0 if draw.chance(0.15) else draw.signed_log(1e-8 if draw.chance(0.2) else 1e-2, 10) for _ in range(2)]
            self.words += f" --target {self.target[0]!r},{self.target[1]!r}"
            if not all(prescribed(self.which)[1]) and draw.chance(0.5):
                self.weights = [0.0 if draw.chance(0.1) else draw.log_uniform(1e-3, 1e4) for _ in range(2)]
                self.words += f" --weights {self.weights[0]!r},{self.weights[1]!r}"
        if draw.chance(0.2):
            self.bound = draw.log_uniform(1e-6 if draw.chance(0.3) else 0.1, 100)
            self.words += f" --bound {self.bound!r}"


def rates_of(beta, force):
    """Of x1, x2, lambda1, lambda2 and the cost under -lambda2, or under a force on its bound."""
    def rates(t, x):
        u = -x[3] if force is None else t * 0 + force
        square = x[0] * x[0] * beta
        return [x[1], u - x[0] - square * x[0], x[3] + x[3] * square * 3, -x[2], u * u * 0.5]

    return rates


def force_at(x, bound):
    """The force if it is on its bound, in fixed point."""
    return None if abs(x[3]) <= bound else -bound if x[3] > 0 else bound


def first_change(at, begin, end, bound, force):
    """The time of a step from which on the force is another one, to 2^-60 of it; its end if there is none."""
    places = [begin + (end - begin) * k // 16 for k in range(17)]
    for low, high in zip(places, places[1:]):
        if force_at(at(high), bound) != force:
            for _ in range(60):
                middle = (low + high) // 2
                low, high = (middle, high) if force_at(at(middle), bound) == force else (low, middle)
            return high
    return end


class Flight:
    """The motion from the printed initial state: state and cost at the end, and the greatest |x| and |lambda|."""

    def __init__(self, a, start):
        with mp.workdps(60):
            x, t, end = [taylor.fixed(c) for c in start], 0, taylor.fixed(a.time)
            bound = taylor.fixed(a.bound) if math.isfinite(a.bound) else math.inf
            most, size = [abs(c) for c in x], [abs(c) for c in x]
            self.arrives = False
            while t != end:
                force, before = force_at(x, bound), t
                run = taylor.Run(rates_of(a.beta, None if force is None else mp.ldexp(force, -taylor.BITS)), 5, 28)
                for begin, last, at in taylor.steps(run, x, t, end, digits=20, seconds=60, size=size):
                    t = first_change(at, begin, last, bound, force)
                    x = at(t)
                    most = [max(m, abs(c), abs(d)) for m, c, d in zip(most, x, at((begin + t) // 2))]
                    if t != last:
                        break
                if t == before:
                    return
            self.arrives, self.end = True, [taylor.floating(c) for c in x]
            self.x, self.costate = (taylor.floating(max(pair)) for pair in (most[:2], most[2:4]))


def left_of(a, p, flight):
    """The largest residual of all conditions, relative to the largest state and co-state of the motion. `p`: cost, x1_0, x2_0, lambda1_0,
    lambda2_0, x1_T, x2_T, miss."""
    is_bounded = math.isfinite(a.bound)
    # The smoothing of a bound is 1e-5 of it, for a tenth of the way or less near a corner; else the solver's share.
    share, force = (1e-6, 1e-6 * a.bound) if is_bounded else (1e-9, 0)
    natural = flight.x * (1 + a.beta * flight.x**2 + 1 / a.time**2)
    x_unit = 1e-9 * flight.x + force * a.time * max(1, a.time) + 1e-20
    # Co-states that vanish have the rounding of what they might be.
    l_unit = share * flight.costate + 4 * EPS * natural * max(1, 1 / a.time) + 1e-300
    at_begin, at_end = prescribed(a.which)
    left, cost = [], flight.end[4]
    for i in range(2):
        off, s = flight.end[i] - a.target[i], a.weights[i]
        left.append((abs(p[i + 1]) / x_unit if at_begin[i] else abs(p[i + 3]) / l_unit, f"start of {i + 1}"))
        left.append((abs(flight.end[i] - p[i + 5]) / x_unit, f"printed end of x{i + 1}"))
        if at_end[i]:
            left.append((abs(off) / x_unit, f"end of x{i + 1}"))
        else:
            cost += s * off**2 / 2
            left.append((abs(flight.end[i + 2] - s * off) / (l_unit + s * x_unit), f"transversality of {i + 1}"))
    left.append((abs(cost - p[0]) / (share * cost + 1e-20), "cost"))
    return max(left)


@needs("rbf_inverse")
@randomised_test(quick=8, full=1_000)
def test_extremals_arrive_at_their_cost(draw):
    a = Asked(draw)
    r = ran(a.words, 20)
    if r.exit_code:
        return failed(r)
    p = [number(cell) for cell in r.rows[0]]
    if len(r.rows) != 1 or len(p) != 8 or not all(map(math.isfinite, p)):
        return wrong(r.words + ": rows")
    flight = Flight(a, [*p[1:5], 0])
    if not flight.arrives:
        return wrong(r.words + ": cannot be integrated")
    left, what = left_of(a, p, flight)
    return judged(left, 1, f"{r.words}: {what}; printed {','.join(r.rows[0])}")
