"""`rbf_inverse duffing` on the cases that the text solves against tools/oracles/rbf_inverse_extremals.py, a Taylor method in 40 digits, and
`rbf_inverse bvp` on random linear problems with known solutions."""
import csv
import math
import random
import re

import pytest

from nlmech_tree import SOURCE, program, run, text_of

KNOWN = {}  # values by case, T and name; the other four are prescribed or natural conditions
for _row in csv.DictReader(text_of("tables/reference/oracles/rbf_inverse_extremals.csv").splitlines()):
    if _match := re.fullmatch(r"(\w+) T = (\d) (\S+)", _row["name"]):
        KNOWN.setdefault((_match[1], _match[2]), {})[_match[3]] = float(_row["value"])
ENDS = {"free": {"x1(0)": 0, "x2(0)": 0}, "fixed": {"x1(0)": 0, "x2(0)": 0, "x1(T)": 5, "x2(T)": 2}, "harmonic": {"x1(0)": 0, "x2(0)": 0},
        "x1x1": {"x1(0)": 0, "l2(0)": 0, "x1(T)": 5}, "x1x2": {"x1(0)": 0, "l2(0)": 0, "x2(T)": 2}, "x2x1": {"x2(0)": 0, "l1(0)": 0, "x1(T)": 5}}
COLUMN = {"x1(0)": "x1_0", "x2(0)": "x2_0", "l1(0)": "lambda1_0", "l2(0)": "lambda2_0", "x1(T)": "x1_T", "x2(T)": "x2_T"}
BETA = {"x1x1": "0.94", "x1x2": "0.94", "x2x1": "0.97"}  # as printed, else 0.9


def row_of(*words):
    rows = list(csv.DictReader(run(program("rbf_inverse"), *words).stdout.splitlines()))
    return {name: float(cell) for name, cell in rows[-1].items()}


@pytest.mark.parametrize("case, time", [key for key in KNOWN if key[0] in ENDS])
def test_extremals_are_found(case, time):
    """From the program's own starts: a cost no higher than the best known, initial values to ten digits, the integrated end to 1e-9."""
    found, known = row_of("duffing", "--case", case, "--final-time", time, "--beta", BETA.get(case, "0.9")), KNOWN[case, time] | ENDS[case]
    assert found["cost"] <= known["cost"] * (1 + 1e-9) and found["miss"] <= 1e-9
    for name, column in COLUMN.items():
        bound = (1e-10 if name.endswith("(0)") else 1e-9) * max(1, abs(known[name]))
        assert found[column] == pytest.approx(known[name], abs=bound), name


COST = {"free": " + ((x(T) - 5)^2 + (x'(T) - 2)^2)/2", "x1x1": " + (x'(T) - 2)^2/2", "x1x2": " + (x(T) - 5)^2/2", "x2x1": " + (x'(T) - 2)^2/2"}
STATES = {"x1": "x", "x2": "x'", "l1": "lambda_x", "l2": "lambda_x'"}


@pytest.mark.parametrize("case, time", [key for key in KNOWN if key[0] in ENDS])
def test_typed_extremals_are_found(case, time):
    """`rbf_inverse control` with the files of the cases, which contain no starts for them."""
    done = run(program("rbf_inverse"), "control", "--file", str(SOURCE / f"chapters/rbf_inverse/duffing/{case}.ode"), "--control", "f",
               "--minimise", "integral(f^2/2)" + COST.get(case, ""), "--set", f"T={time}")
    known, rows = KNOWN[case, time] | ENDS[case], list(csv.DictReader(done.stdout.splitlines()))
    assert float(re.search(r"cost ([^,;]+)", done.stderr)[1]) == pytest.approx(known["cost"], rel=1e-9)
    for name, value in known.items():
        if name != "cost":
            found = float(rows[0 if name.endswith("(0)") else -1][STATES[name[:2]]])
            assert found == pytest.approx(value, abs=1e-8 * max(1, abs(value))), name


@pytest.mark.parametrize("seed", range(100))
def test_linear_problems_with_known_solutions(seed):
    """x = p sin(q t + r) solves x'' = g x - (q^2 + g) x_p, which is well posed for g >= 0 with these conditions. The residual is 1e-9 of
    1 + |x''|, and moves a solution by the square of the time over 8, or less."""
    draw = random.Random(seed).uniform
    p, q, r, g, c, until = draw(0.1, 10), draw(0.1, 20), draw(-3, 3), draw(0, 400), draw(0, 2), draw(0.1, 5)

    def x(t):
        return p * math.sin(q * t + r)

    text = run(program("rbf_inverse"), "bvp", "--equation", f"x'' = {g!r} x - {(q * q + g) * p!r} sin({q!r} t + {r!r})",
               "--conditions", f"x(0) - {c!r} x'(0) = {x(0) - c * p * q * math.cos(r)!r}, x({until!r}) = {x(until)!r}").stdout
    rows = list(csv.DictReader(text.splitlines()))
    assert len(rows) > 2
    for row in rows:
        assert abs(float(row["x"]) - x(float(row["t"]))) <= 1e-9 * (1 + p * q * q) * (1 + until * until)
