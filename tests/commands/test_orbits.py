"""`two_body_series` on orbits about a point mass, against Kepler's problem in 50 digits. Bounds are in kappa eps: what the data, rounded to
double precision, leave open. A tolerance of 1e-15 is 4.5 eps a step, some 30 of them an orbit; kappa counts the same again for later orbits."""
import csv
import functools
import math

import mpmath
import pytest
from mpmath import mpf

from nlmech_tree import program, run

EPS, EARTH = 2.0**-52, 3.986004418e14
LOW = (1702547.136867679, 6353992.417071098, 0.0, -7886.014053829254, 2113.051097224035, 0.0)


def stumpff(z):
    """c2 and c3 of Kepler's equation in universal variables."""
    root = mpmath.sqrt(abs(z))
    if abs(z) < mpf("1e-12"):
        return mpf(1) / 2 - z / 24 + z * z / 720, mpf(1) / 6 - z / 120 + z * z / 5040
    if z > 0:
        return (1 - mpmath.cos(root)) / z, (root - mpmath.sin(root)) / root**3
    return (mpmath.cosh(root) - 1) / -z, (mpmath.sinh(root) - root) / root**3


def kepler(state, time, mu):
    """The position of a state (x, y, z, vx, vy, vz) after a time. The time is a growing function of the universal anomaly."""
    position, velocity, time, mu = state[:3], state[3:], mpf(time), mpf(mu)
    r, root = mpmath.norm(position), mpmath.sqrt(mu)
    alpha, sigma = 2 / r - mpmath.fdot(velocity, velocity) / mu, mpmath.fdot(position, velocity) / root

    def late(chi):
        c2, c3 = stumpff(alpha * chi * chi)
        return sigma * chi**2 * c2 + (1 - alpha * r) * chi**3 * c3 + r * chi - root * time

    far = mpmath.sign(time) * mpmath.sqrt(r)
    while late(far) * mpmath.sign(time) < 0:
        far *= 2
    chi = mpmath.findroot(late, (0, far), solver="anderson", tol=mpf(10)**-80, verify=False)
    c2, c3 = stumpff(alpha * chi * chi)
    f, g = 1 - chi**2 * c2 / r, time - chi**3 * c3 / root
    return [f * p + g * v for p, v in zip(position, velocity)]


def condition(state, time, mu):
    """kappa: the sum over the data of |d position / d datum| |datum| / |position|, components with the length of their vector."""
    data = [*state, time, mu]
    size = [mpmath.norm(state[:3])] * 3 + [mpmath.norm(state[3:])] * 3 + [abs(time), mu]
    end, step, total = kepler(state, time, mu), mpf(10)**-20, 0
    for i, scale in enumerate(size):
        moved = list(data)
        moved[i] += step * scale
        total += mpmath.norm([a - b for a, b in zip(kepler(moved[:6], moved[6], moved[7]), end)]) / step
    return total / mpmath.norm(end)


@functools.cache
def exact(state, time, mu):
    """Position and kappa."""
    with mpmath.workdps(50):
        state = [mpf(number) for number in state]
        return kepler(state, mpf(time), mpf(mu)), condition(state, mpf(time), mpf(mu))


def off(row, state, mu):
    """The error of a row's position in units of kappa eps."""
    with mpmath.workdps(50):
        place, kappa = exact(state, float(row["t"]), mu)
        miss = mpmath.norm([mpf(float(row[name])) - number for name, number in zip("xyz", place)])
        return miss / mpmath.norm(place) / (EPS * kappa)


def numbers(row):
    return tuple(float(row[name]) for name in ("x", "y", "z", "vx", "vy", "vz"))


def propagate(state, *words, mu=EARTH):
    start = [",".join(map(repr, part)) for part in (state[:3], state[3:])]
    text = run(program("two_body_series"), "propagate", "--position", start[0], "--velocity", start[1], "--mu", repr(mu), *words).stdout
    return list(csv.DictReader(text.splitlines()))


@pytest.mark.parametrize("method, bound", [("series", 100), ("kepler", 8), ("rkn1210", 100)])
@pytest.mark.parametrize("state, mu, time", [
    (LOW, EARTH, 124374.5),
    (LOW, EARTH, -3000.0),
    ((2096434.265330419, 7823999.192941453, 0.0, -8834.757074967362, 2367.266023562654, 0.0), EARTH, 1e5),
    ((-7e6, 1e6, 2e6, -3e3, -12e3, 1e3), EARTH, 20000.0),
    ((-1.0, -2.0, 0.5, 0.6, 1.2, 0.0), 1.0, 2.5)])
def test_every_method_on_every_conic(state, mu, time, method, bound):
    rows = propagate(state, "--until", repr(time), "--method", method, mu=mu)
    assert [float(row["t"]) for row in rows] == [0, time] and numbers(rows[0]) == state
    assert off(rows[1], state, mu) <= bound


@pytest.mark.parametrize("method", ["series", "kepler", "rkn1210"])
@pytest.mark.parametrize("sign", ["", "-"])
def test_rows_at_equal_distances(method, sign):
    rows = propagate(LOW, "--until", sign + "6500", "--every", "1000", "--method", method)
    assert [abs(float(row["t"])) for row in rows] == [0, 1000, 2000, 3000, 4000, 5000, 6000, 6500]
    assert max(off(row, LOW, EARTH) for row in rows[1:]) <= 100


def test_units_do_not_matter():
    """Metres and seconds, or the initial distance and its circular speed: data rounded in either, times what the orbit amplifies."""
    length = 6378137
    rate = math.sqrt(EARTH / length) / length
    own = tuple(number / (length if i < 3 else length * rate) for i, number in enumerate(LOW))
    metres = propagate(LOW, "--until", "50000")[1]
    canonical = propagate(own, "--until", repr(50000 * rate), mu=1.0)[1]
    miss = mpmath.norm([float(canonical[name]) * length - float(metres[name]) for name in "xyz"])
    assert miss / mpmath.norm(numbers(metres)[:3]) <= 8 * EPS * exact(LOW, 50000.0, EARTH)[1]


def test_fly_by_and_back():
    start = (-7e6, 1e6, 2e6, -3e3, -12e3, 1e3)
    far = numbers(propagate(start, "--until", "1e6")[1])
    home = numbers(propagate(far, "--until", "-1e6")[1])
    miss = mpmath.norm([a - b for a, b in zip(home[:3], start)])
    assert miss / mpmath.norm(start[:3]) <= 100 * EPS * exact(far, -1e6, EARTH)[1]


def test_rows_of_a_file_are_orbits(folder):
    """Within what a single orbit keeps: 16 kappa eps, 8 of them those of Kepler's solution. Names come back as they were; --method kepler agrees."""
    starts = []
    for i in range(100):
        e = 0.8 * i / 100
        starts.append((1 - e, 0.0, 0.0, 0.0, math.sqrt((1 + e) / (1 - e)), 0.0))
    lines = [f'"body, {i}",0,{s[4]!r},0,{20 + 0.01 * i!r},{s[0]!r},0,0,1\n' for i, s in enumerate(starts)]
    (folder / "orbits.csv").write_text("# a comment\n\nname,vx,vy,vz,until,x,y,z,mu\n\n" + "".join(lines))
    text = run(program("two_body_series"), "propagate", "--states", folder / "orbits.csv").stdout
    assert text.startswith("row,t,x,y,z,vx,vy,vz,name,status\n")
    rows = list(csv.DictReader(text.splitlines()))
    for i, (row, start) in enumerate(zip(rows, starts, strict=True)):
        assert (row["row"], row["name"], row["status"], float(row["t"])) == (str(i + 1), f"body, {i}", "success", 20 + 0.01 * i)
        assert off(row, start, 1.0) <= 16
    closed = run(program("two_body_series"), "propagate", "--states", folder / "orbits.csv", "--method", "kepler").stdout
    assert float(list(csv.DictReader(closed.splitlines()))[6]["x"]) == pytest.approx(float(rows[6]["x"]), abs=1e-12)


def test_drawn_orbits_have_no_corners(folder):
    """Also in a quick look neighbouring points of `run zonal` lie less than 15 degrees apart as seen from the Earth: a polygon with such sides
    leaves its circle by a hundredth of the radius, a line's width in the figure."""
    run(program("two_body_series"), "run", "zonal", "--quick", "--no-plots", cwd=folder)
    rows = list(csv.DictReader((folder / "results/two_body_series/zonal.csv").read_text().splitlines()))
    places = [(row["orbit"], [float(row[name]) for name in ("x_km", "y_km", "z_km")]) for row in rows]
    angles = [math.degrees(math.acos(min(1, sum(x * y for x, y in zip(a, b)) / math.hypot(*a) / math.hypot(*b))))
              for (one, a), (other, b) in zip(places, places[1:]) if one == other]
    assert len(angles) > 10 and max(angles) < 15
