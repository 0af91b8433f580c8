"""Random problems of optimal control with a cost in closed form: a mass on a line, freely, between bounds of its force, under a bound of its
position, and in least time; linear systems with quadratic costs by the exponential of their Hamiltonian."""
import re

from cases import failed, judged, needs, number, randomised_test, ran, wrong
from mpmath import mp, mpf, sqrt


def given(**values):
    return "; ".join(f"{name} = {value!r}" for name, value in values.items())


def free_mass(draw):
    """From (x, v) to (y, w) in the time T: the least integral of u^2/2."""
    x, v, y, w = (draw.signed_log(1e-3, 10) for _ in range(4))
    time = draw.log_uniform(0.05, 20)
    off, change = mpf(y) - x - mpf(v) * time, mpf(w) - v
    scale = max(abs(off) / time, abs(change))
    return (["--equation", "x'' = u", "--conditions", f"x(0) = {x!r}; x'(0) = {v!r}; x({time!r}) = {y!r}; x'({time!r}) = {w!r}", "--minimise",
             "integral(u^2/2)"], 2 * (3 * off**2 - 3 * off * change * time + change**2 * time**2) / mpf(time)**3, scale**2 / time)


def bounded_mass(draw):
    """From rest to rest over d in the time T with |u| <= m, which is at the bound for two arcs and linear between them."""
    time, share, d = draw.log_uniform(0.1, 10), draw.uniform(0.67, 0.98), draw.signed_log(0.01, 100)
    m = abs(d) * 4 / time**2 / share  # 4 d/T^2 is the least possible, 6 d/T^2 that of the free motion
    between = sqrt(3 * mpf(time)**2 - 12 * abs(mpf(d)) / m)
    return (["--equation", "x'' = u", "--bounds", f"{-m!r} <= u <= {m!r}", "--conditions",
             f"x(0) = 0; x'(0) = 0; x({time!r}) = {d!r}; x'({time!r}) = 0", "--minimise", "integral(u^2/2)"],
            mpf(m)**2 * (mpf(time) - between * 2 / 3) / 2, m**2 * time)


def walled_mass(draw):
    """Breakwell's problem for any speed and time: out and back below a wall at l v T."""
    v, time, share = draw.log_uniform(0.1, 10), draw.log_uniform(0.1, 10), draw.uniform(0.02, 0.24)
    wall = share * v * time
    l = mpf(wall) / (mpf(v) * time)
    cost = 4 / (9 * l) if l <= mpf(1) / 6 else 2 + 6 * (1 - 4 * l)**2
    return (["--equation", "x'' = u", "--state-bounds", f"x <= {wall!r}", "--conditions",
             f"x(0) = 0; x'(0) = {v!r}; x({time!r}) = 0; x'({time!r}) = {-v!r}", "--minimise", "integral(u^2/2)"],
            cost * mpf(v)**2 / time, cost * v**2 / time)


def fast_mass(draw):
    """Least time to rest at 0 with |u| <= m."""
    x, v, m = draw.signed_log(0.01, 10), draw.signed_log(0.01, 10), draw.log_uniform(0.1, 10)
    side = 1 if x + mpf(v) * abs(v) / (2 * m) > 0 else -1
    time = side * mpf(v) / m + 2 * sqrt(mpf(v)**2 / (2 * mpf(m)**2) + side * mpf(x) / m)
    return (["--equation", "x'' = u", "--bounds", f"{-m!r} <= u <= {m!r}", "--until", "T", "--conditions",
             f"x(0) = {x!r}; x'(0) = {v!r}; x(T) = 0; x'(T) = 0", "--minimise", "T"], time, time)


def regulator(draw):
    """x'' = a x + b x' + u with the integral of (q x^2 + p x'^2 + u^2)/2 and s x(T)^2/2: with Z' = H Z, Z(T) = (1, S), the cost is x P x/2 with
    P = Z2 Z1^-1 at 0."""
    a, b = draw.uniform(-9, 4), draw.uniform(-2, 1)
    q, p, s = (0.0 if draw.chance(0.2) else draw.log_uniform(1e-3, 100) for _ in range(3))
    time, x, v = draw.log_uniform(0.05, 5), draw.signed_log(1e-3, 10), draw.signed_log(1e-3, 10)
    hamiltonian = mp.matrix([[0, 1, 0, 0], [a, b, 0, -1], [-mpf(q), 0, 0, -mpf(a)], [0, -mpf(p), -1, -mpf(b)]])
    z = mp.expm(-hamiltonian * time) * mp.matrix([[1, 0], [0, 1], [s, 0], [0, 0]])
    riccati, start = z[2:4, 0:2] * mp.inverse(z[0:2, 0:2]), mp.matrix([x, v])
    return (["--equation", f"x'' = a x + b x' + u; {given(a=a, b=b)}", "--conditions", f"x(0) = {x!r}; x'(0) = {v!r}", "--until", repr(time),
             "--minimise", f"integral(({q!r}*x^2 + {p!r}*x'^2 + u^2)/2) + {s!r}*x({time!r})^2/2"], (start.T * riccati * start)[0] / 2,
            (q * x**2 + p * v**2 + 1e-8 * (x**2 + v**2)) * time + s * x**2)  # errors of u count where nothing else costs


@needs("rbf_inverse")
@randomised_test(quick=10, full=2_000, least_right=0.5)
def test_controls_have_their_least_cost(draw):
    with mp.workdps(40):
        words, cost, size = draw.one_of([free_mass, bounded_mass, walled_mass, fast_mass, regulator])(draw)
        r = ran(["rbf_inverse", "control", *words, "--control", "u"], 20)
        if r.exit_code:
            return failed(r)
        printed = re.search(r"cost ([^,;]+)", r.errors)
        if not printed or len(r.rows) < 3:
            return wrong(r.words + ": no cost, or no rows")
        # The residual is 1e-9 of each size; 12 digits are printed.
        return judged(abs(number(printed[1]) - cost), 1e-8 * max(abs(cost), abs(size)), r.words)
