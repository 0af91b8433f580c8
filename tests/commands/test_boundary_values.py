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


def transfer_guess(end, turned, share, time):
    """Levi-Civita's variables move harmonically: through (1, 0) and `end` with the phase pi (turned + share), scaled to the time."""
    phase = math.pi * (turned + share)
    sines = [(math.sin(phase * (1 - q)) / math.sin(phase), math.sin(phase * q) / math.sin(phase)) for q in [(i + 0.5) / 400 for i in range(400)]]
    length = time / (sum((a + b * end[0]) ** 2 + (b * end[1]) ** 2 for a, b in sines) / 400)
    w, s = phase / length, math.sin(phase)
    return (f"u = (sin({phase!r} - {w!r} t) + {end[0]!r} sin({w!r} t))/({s!r}), v = {end[1]!r} sin({w!r} t)/({s!r}), "
            f"clock = {time!r} t/{length!r}, h = {-2 * w * w!r}, S = {length!r}")


def collocated_transfers(radius, angle, time, revolutions):
    """Velocities at (1, 0) of all orbits to the radius and angle found by collocation. With x + i y = (u + i v)^2 and dt = r ds Kepler's
    equations are u'' = h u/2, without the singularity of the centre; the energy h and the length S in s are unknown."""
    found = []
    for direction in (1, -1):
        swept = angle if direction > 0 else angle - 2 * math.pi
        for k in range(revolutions + 1):
            half = (swept + direction * 2 * math.pi * k) / 2
            end = math.sqrt(radius) * math.cos(half), math.sqrt(radius) * math.sin(half)
            for share in (0.1, 0.25, 0.4, 0.6, 0.75, 0.9):
                done = run(program("rbf_inverse"), "bvp", "--equation", "u'' = h u/2; v'' = h v/2; clock' = u^2 + v^2", "--unknown", "h",
                           "--until", "S", "--guess", transfer_guess(end, k, share, time), "--conditions",
                           f"u(0) = 1; v(0) = 0; clock(0) = 0; u(S) = {end[0]!r}; v(S) = {end[1]!r}; clock(S) = {time!r}; "
                           "h (u(0)^2 + v(0)^2) = 2 (u'(0)^2 + v'(0)^2) - 1", code=None)
                if done.returncode == 0:
                    first = next(csv.DictReader(done.stdout.splitlines()))
                    found.append((2 * float(first["u'"]), 2 * float(first["v'"])))
    return found


@pytest.mark.parametrize("radius, angle, time", [(1.5, math.pi / 2, 26), (0.7, 2.5, 17), (2.2, 1, 60)])
def test_transfers_of_up_to_three_revolutions(radius, angle, time):
    """Every arc of `lambert`, a closed form, is found from starts that nobody typed, and nothing else."""
    end = f"{radius * math.cos(angle)!r},{radius * math.sin(angle)!r},0"
    known = []
    for way in ([], ["--long-way"]):
        for k in range(4):
            for branch in [[]] if k == 0 else [["--branch", "low"], ["--branch", "high"]]:
                done = run(program("rbf_inverse"), "lambert", "--from", "1,0,0", "--to", end, "--time", repr(time), "--mu", "1",
                           "--revolutions", str(k), *branch, *way, code=None)
                if done.returncode == 0:
                    row = next(csv.DictReader(done.stdout.splitlines()))
                    known.append((float(row["vx0"]), float(row["vy0"])))
    found = collocated_transfers(radius, angle, time, 3)
    assert len(known) >= 8
    assert all(any(math.dist(a, b) < 1e-6 for b in found) for a in known)
    assert all(any(math.dist(a, b) < 1e-6 for a in known) for b in found)
