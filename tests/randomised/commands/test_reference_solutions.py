"""The oracles of the randomised tests beside closed forms and each other."""
import math
import re

import pytest
import taylor
from cases import needs
from half_toggle import HalfToggle
from ivp import METHODS
from kepler import Transition, condition, conic, distance, norm
from mpmath import mp
from test_transfers import arcs

from nlmech_tree import program, run


def oscillator(_t, x, _piece):
    return [x[1], -x[0] - x[0] * x[0] * x[0]]


@pytest.mark.parametrize("end", [1.0, 50.0, -100.0])
@pytest.mark.parametrize("order, digits", [(32, 25), (24, 19)])
def test_duffings_oscillator_is_an_elliptic_function(end, order, digits):
    with mp.workdps(50):
        found = taylor.states(oscillator, [1, 0], 0.0, [end / 2, end], order=order, digits=digits)
        for state, t in zip(found, (end / 2, end)):
            error = mp.ldexp(mp.mpf(state[0]), -taylor.BITS) - mp.ellipfun("cn", mp.sqrt(2) * t, m=mp.mpf(1) / 4)
            assert abs(error) < 100 * mp.mpf(10) ** -digits * abs(end)  # of each step, in some hundred of them that shift the phase


def test_functions_of_a_series():
    """x = exp(sin t)^(-3/2) written as an equation for itself: sin t is the integral of cos t."""
    def rates(t, x, _piece):
        return [taylor.Cosine(t, 1), taylor.Cosine(t, 1) * taylor.Power(taylor.Exponential(x[0]), -3) * -1.5]

    with mp.workdps(50):
        state = taylor.states(rates, [0, 1], 0.0, [5.0])[0]
        assert abs(mp.ldexp(mp.mpf(state[1]), -taylor.BITS) - mp.exp(mp.sin(5)) ** -1.5) < mp.mpf(10) ** -23


@pytest.mark.parametrize("end", [0.01, 3.0])
def test_a_motion_from_rest_at_zero_has_a_size(end):
    """x'' = cos 3t, whose state at the start gives no scale."""
    with mp.workdps(50):
        state = taylor.states(lambda t, x, _piece: [x[1], taylor.Cosine(t, 3)], [0, 0], 0.0, [end])[0]
        assert abs(mp.ldexp(mp.mpf(state[0]), -taylor.BITS) * 9 / (1 - mp.cos(3 * mp.mpf(end))) - 1) < mp.mpf(10) ** -22


def test_a_piece_ends_where_it_is_said_to():
    state = taylor.states(lambda t, x, piece: [t * (1 if piece < 1 else -2)], [0], 0.0, [3.0], breaks=(1.0, 7.0))[0]
    assert taylor.floating(state[0]) == pytest.approx(0.5 - 8, abs=1e-25)


@needs("integrators")
def test_every_method_is_tried():
    listed = re.search("^Methods: (.*)", run(program("integrators"), "integrate", "--help").stdout, re.MULTILINE)[1]
    assert set(listed.split()) == set(METHODS)


START = [1.0, 0.2, -0.3], [0.1, 0.8, 0.4]


def test_the_condition_of_the_rest_of_a_way_is_that_of_a_way_from_there():
    end, middle = Transition(*START, 20.0, 1.3), Transition(*START, 8.0, 1.3)
    assert condition(end, middle) == pytest.approx(condition(Transition(middle.r, middle.v, 12.0, 1.3)), rel=1e-12)


def test_the_condition_is_that_of_changed_data():
    kappa, data, by = 0, [*START[0], *START[1], 20.0, 1.3], mp.mpf(10) ** -20
    with mp.workdps(60):
        place = conic(*START, *data[6:])[0]
        for i, size in enumerate([norm(START[0])] * 3 + [norm(START[1])] * 3 + data[6:]):
            changed = [x + (size * by if i == j else 0) for j, x in enumerate(data)]
            kappa += distance(conic(changed[:3], changed[3:6], *changed[6:])[0], place) / by / norm(place)
    assert condition(Transition(*START, 20.0, 1.3))[0] == pytest.approx(float(kappa), rel=1e-12)


def test_all_arcs_arrive_and_none_is_missing():
    r1, r2, time = [1, 0, 0.2], [-0.3, 1.5, 0.4], 40
    with mp.workdps(30):
        found = list(arcs(mp, [mp.mpf(x) for x in r1], [mp.mpf(x) for x in r2], mp.mpf(time), mp.mpf(1), 9))
        for v1, v2 in found:
            place, velocity = conic(r1, v1, time, 1)
            assert distance(place, r2) < mp.mpf(10) ** -22 and distance(velocity, v2) < mp.mpf(10) ** -22
    # Each number of revolutions but 0 has two arcs on each way, or none.
    # A revolution on the smallest ellipse through both places takes 7.8: four and a part fit in the time on either way, with two axes each.
    assert len(found) == 2 + 4 * 4
    assert len({float(norm(v1)) for v1, _ in found}) == len(found)


def test_forces_of_tiny_motions_have_all_digits():
    """They are linear in the motions, and as exact as others."""
    toggle, x = HalfToggle(6.1, 11), [1e-15 * math.sin(i + 1) for i in range(33)]
    once, twice = toggle.force_and_stiffness(x)[0], toggle.force_and_stiffness([2 * c for c in x])[0]
    # 33 motions' roundings, and what is not linear, 1e-15 of the force.
    assert math.hypot(*(b - 2 * a for a, b in zip(once, twice))) < 1e-13 * math.hypot(*once)


@pytest.mark.parametrize("bent", [1e-3, 0.3])
def test_stiffness_is_the_derivative_of_forces(bent):
    toggle, x, by = HalfToggle(6.1, 3), [bent * math.sin(7 * i) for i in range(9)], 1e-6
    k = toggle.force_and_stiffness(x)[1]
    largest = max(map(max, k))
    for j in range(9):
        low, high = ([c + side * (i == j) for i, c in enumerate(x)] for side in (-by, by))
        forces = (toggle.force_and_stiffness(shape)[0] for shape in (high, low))
        # Differences leave the cube root of a rounding twice over, and as much of the third derivative.
        assert [(p - q) / (2 * by) for p, q in zip(*forces)] == pytest.approx([row[j] for row in k], abs=1e-7 * largest)
