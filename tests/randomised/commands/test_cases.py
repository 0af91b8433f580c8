"""The machine itself: it finds what is wrong, says how to repeat it, and is not content with nothing."""
import math

import pytest
from cases import RandomisedTest, judged, refused


def test_the_one_wrong_case_of_a_hundred_is_found():
    count = 0

    def one_wrong(_draw):
        nonlocal count
        count += 1
        return judged(2 if count == 42 else 0.5, 1, "the answer")

    with pytest.raises(AssertionError, match=r"case 41 \(NLMECH_RANDOMISED_SEED=\d+ NLMECH_RANDOMISED_CASE=41\): error 2, allowed 1; the answer"):
        RandomisedTest(one_wrong).run(100, 0.1)


def test_refusals_alone_are_not_enough():
    with pytest.raises(AssertionError, match="the randomised test is empty"):
        RandomisedTest(lambda _draw: refused("no")).run(10, 0.1)


def test_a_nan_and_an_exception_are_wrong():
    assert judged(math.nan, 1, "").verdict == "wrong"
    with pytest.raises(AssertionError, match="IndexError"):
        RandomisedTest(lambda _draw: [][0]).run(1, 0)


def test_corners_are_drawn_and_the_range_is_kept():
    drawn = []

    def trial(draw):
        drawn.append(draw.log_uniform(1e-3, 1e5))
        assert math.isfinite(draw.any_finite())
        return judged(0, 1, "")

    RandomisedTest(trial).run(1000, 0.1)
    assert all(1e-3 <= x <= 1e5 for x in drawn)
    # A corner's share: 1000 / 8 / 3 = 42 on average and a power of ten now and then, standard deviation 6.
    assert drawn.count(1e-3) > 20 and drawn.count(1e5) > 20


def test_a_case_is_the_same_every_time_and_can_be_made_simpler():
    def trial(draw):
        x = draw.uniform(0, 10)
        return judged(x, 2, f"x = {x!r}")

    cases = RandomisedTest(trial)
    number = next(n for n in range(100) if cases.case(n).verdict == "wrong")
    assert cases.case(number) == cases.case(number)
    with pytest.raises(AssertionError, match=r"x = (2\.0|5\.0|10)"):
        cases.shrunk(number)
