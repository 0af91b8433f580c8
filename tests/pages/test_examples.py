"""The programs of examples/ compared with results that do not use the library."""
import math
import re

import pytest

from nlmech_tree import chapters, program, run

FIXED_STEP = "euler backward-euler explicit rk4 rk6 newmark hht generalized-alpha mtl mcpi rbf-coll lgl-coll radau-coll".split()


def lines_of(example):
    return run(program(example)).stdout.splitlines()


def numbers_in(text):
    return [float(number) for number in re.findall(r"-?\d+\.?\d*", text)]


def test_every_integrator_brings_the_pendulum_back():
    """The pendulum returns after the period that elliptic integrals give. Single steps are held to 1e-8, and the end of a period collects
    some: 1e-5. A thousand equal steps leave h^2 by order 2, that is 7e-5, and h = 8e-3, times ten or so, by order 1 and by radial functions,
    which do not contain the linear ones."""
    rows = [re.fullmatch(r"(\S+) +error (\S+), .*, success", line).groups() for line in lines_of("every_integrator")]
    bounds = {name: 7e-5 if name in FIXED_STEP else 1e-5 for name, _ in rows} | dict.fromkeys(("euler", "backward-euler", "rbf-coll"), 0.1)
    assert [(name, error) for name, error in rows if not float(error) < bounds[name]] == []
    for chapter in chapters():
        names = re.search(r"^Methods: (.*)$", run(program(chapter), "integrate", "--help", code=None).stdout, re.MULTILINE)
        if names:  # those that are not from other libraries
            assert [name for name, _ in rows] == re.sub(r" (cvode|arkode|gsl|odeint)-\S+", "", names[1]).split()


def lorenz(x, y, z, step):
    """The state at t = 10, by Taylor series of order 24 over steps of this length."""
    for _ in range(round(10 / step)):
        a, b, c = [x], [y], [z]
        for k in range(24):
            ac, ab = (sum(a[i] * other[k - i] for i in range(k + 1)) for other in (c, b))
            a.append(10 * (b[k] - a[k]) / (k + 1))
            b.append((28 * a[k] - b[k] - ac) / (k + 1))
            c.append((ab - 8 / 3 * c[k]) / (k + 1))
        x, y, z = (sum(coefficient * step**k for k, coefficient in enumerate(series)) for series in (a, b, c))
    return [x, y, z]


def test_many_starts_end_where_another_method_ends():
    """An error grows by some e^9 to t = 10, so that tolerances of 1e-12 leave 1e-8; six digits are printed. Half the step of the
    other method shows that its own error is smaller."""
    lines = lines_of("many_starts")
    assert len(lines) == 4
    for line, start in zip(lines, ([0, 1, 0], [0, 1.0001, 0], [1, 1, 1], [-1, 2, 20])):
        end = lorenz(*start, 0.02)
        assert lorenz(*start, 0.01) == pytest.approx(end, abs=1e-8, rel=0)
        assert line.startswith("success: ")
        assert numbers_in(line) == pytest.approx(end, abs=2e-6, rel=0)


def moved(position, velocity, time, mu):
    """Along a Kepler orbit, an ellipse, by Lagrange's coefficients of the eccentric anomaly."""
    r = math.hypot(*position)
    axis = 1 / (2 / r - math.dist(velocity, (0, 0, 0))**2 / mu)
    motion = math.sqrt(mu / axis**3)
    sine, cosine = sum(map(float.__mul__, position, velocity)) / math.sqrt(mu * axis), 1 - r / axis
    change = motion * time
    for _ in range(50):  # Newton's method for Kepler's equation in the change of the anomaly
        change -= ((change + sine * (1 - math.cos(change)) - cosine * math.sin(change) - motion * time)
                   / (1 + sine * math.sin(change) - cosine * math.cos(change)))
    f, g = 1 - axis / r * (1 - math.cos(change)), time - (change - math.sin(change)) / motion
    return [f * x + g * v for x, v in zip(position, velocity)]


def test_lamberts_arcs_arrive():
    """Every printed velocity leads to the target. Velocities are printed to 5e-7 m/s, which is at most a few mm after 4320 s: the growth of
    an error over less than a revolution or two is some ten times t."""
    lines = lines_of("lambert")
    assert len(lines) == 4
    for line in lines:
        end = moved([2.87e6, 5.19e6, 2.85e6], numbers_in(line.partition("v = ")[2]), 4320, 3.986004418e14)
        assert math.dist(end, (2.09e6, 7.82e6, 0)) < 10 * 5e-7 * 4320, line


def test_porkchop_finds_hohmanns_transfer():
    """No transfer between circles is cheaper than Hohmann's. Steps of a hundredth of a year are 0.03 rad of the synodic angle at most, and
    the sum is flat at its minimum: one part in a hundred."""
    leave, arrive, speeds = numbers_in(lines_of("porkchop")[0])
    outer = 1.5
    axis = (1 + outer) / 2
    hohmann = math.sqrt(2 - 1 / axis) - 1 + math.sqrt(1 / outer) - math.sqrt(2 / outer - 1 / axis)
    assert hohmann - 1e-6 <= speeds <= 1.01 * hohmann
    assert arrive - leave == pytest.approx(math.sqrt(axis**3) / 2, abs=0.05, rel=0)
