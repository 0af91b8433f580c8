"""The Python package: the bits that the commands print, errors, interruption, threads, documentation."""
import concurrent.futures
import csv
import inspect
import io
import math
import os
import pickle
import signal
import threading
import time

import pytest

from nlmech_tree import SOURCE, program, run, write
from package import nlmech, np

DUFFING, START = "x'' + 0.1 x' + x + a x^3 = 0.2 cos(1.1 t); a = 3", "x=1, x'=0"
LOW = [1702547.136867679, 6353992.417071098, 0.0, -7886.014053829254, 2113.051097224035, 0.0]
EARTH = [-2.5e10, 1.45e11, 0, -2.98e4, -5.0e3, 0.0]  # in m and m/s about the Sun, roughly
MARS = [2.08e11, -2.0e9, -5.1e9, 1.2e3, 2.6e4, 5.2e2]
SUN = 1.32712440018e20
ZONAL, FIELD = ["--zonal", "1.08262668e-3,-2.5e-6", "--radius", "6378137"], {"zonal": [1.08262668e-3, -2.5e-6], "radius": 6378137}


def command(name, *words, **options):
    """Columns that a command prints, as arrays of numbers where all cells are numbers."""
    if not program(name).exists():
        pytest.skip(f"the chapter {name} is not built")
    rows = list(csv.DictReader(io.StringIO(run(program(name), *words, **options).stdout)))
    columns = {}
    for column in rows[0]:
        cells = [row[column] for row in rows]
        try:
            columns[column] = np.array([float(cell) for cell in cells])
        except ValueError:
            columns[column] = cells
    return columns


def table(file, names, rows):
    """Writes a CSV file."""
    write(file, "\n".join([",".join(names), *(",".join(repr(float(v)) for v in row) for row in rows)]) + "\n")
    return file


def same(found, printed):
    np.testing.assert_array_equal(np.asarray(found), np.asarray(printed))


# Initial values

@pytest.mark.parametrize("words, arguments", [
    ([], {}),
    (["--every", "0.5"], {"every": 0.5}),
    (["--method", "dop853", "--tolerance", "1e-6"], {"method": "dop853", "tolerance": 1e-6}),
    (["--method", "rk4", "--step", "0.01"], {"method": "rk4", "step": 0.01}),
    (["--columns", "E = x'^2/2 + x^2/2; x''", "--set", "a=2.5"], {"columns": "E = x'^2/2 + x^2/2; x''", "set": {"a": 2.5}}),
    (["--event", "top: x' = 0 falling", "--event", "x = 0"], {"events": ["top: x' = 0 falling", "x = 0"]}),
    (["--section", "x = 0 rising"], {"section": "x = 0 rising"})])
def test_integrate_has_the_bits_of_the_command(words, arguments):
    printed = command("integrators", "integrate", "--equation", DUFFING, "--initial", START, "--until", "12", *words)
    found = nlmech.integrate(DUFFING, START, until=12, **arguments)
    same(found.t, printed.pop("t"))
    events = printed.pop("event", [])
    assert [event.name for event in found.events] == [name for name in events if name]
    assert list(found.names) == list(printed)
    for name, column in printed.items():
        same(found[name], column)
    assert found.status == "success" and found.verified is (None if "step" in arguments else True)


def test_dense_output_has_the_bits_of_rows():
    found = nlmech.integrate(DUFFING, START, until=12, tolerance=1e-10)
    times = np.array([[0, 3.25, 7.0], [12, 0.1, 3.25]])
    dense = found(times)
    rows = nlmech.integrate(DUFFING, START, until=12, tolerance=1e-10, at=times.ravel())
    for name in ("x", "x'"):
        same(dense[name], [[rows[name][list(rows.t).index(t)] for t in line] for line in times])
    with pytest.raises(ValueError, match="not within the run, from 0.0 to 12.0"):
        found(12.5)


def test_dense_output_backwards_and_of_a_run_that_an_event_ends():
    """x'' = -x from (1, 0): cos t, by a tolerance of 1e-10 over less than two radians, times the 100 that a verified run may have."""
    back = nlmech.integrate("x'' = -x", "x=1, x'=0", until=-1.5, tolerance=1e-10)
    np.testing.assert_allclose(back([-1.2, -0.3])["x"], np.cos([1.2, 0.3]), atol=1e-8)
    ended = nlmech.integrate("x'' = -x", "x=1, x'=0", until=9, tolerance=1e-10, events="x = 0 end")
    assert ended.t[-1] == pytest.approx(math.pi / 2, abs=1e-8) and ended.events[0].t == ended.t[-1]
    np.testing.assert_allclose(ended(1.0)["x"], math.cos(1), atol=1e-8)
    with pytest.raises(ValueError):
        ended(1.6)


@pytest.mark.parametrize("method", [None, "series", "ode45"])
def test_many_runs_have_the_bits_of_a_file_of_states(folder, method):
    states = np.column_stack([np.linspace(-2, 2, 700), np.linspace(1, -1, 700)])  # three portions
    file = table(folder / "states.csv", ["x", "x'"], states)
    printed = command("integrators", "integrate", "--equation", DUFFING, "--until", "5", "--at", "2.5", "--states", file,
                      *(["--method", method] if method else []))
    found = nlmech.integrate(DUFFING, states, until=5, at=[2.5], method=method)
    assert {one.status for one in found} == set(printed["status"]) == {"success"}
    for name in ("x", "x'"):
        same([one[name] for one in found], printed[name].reshape(700, 3))
    same(found[3](2.5)["x"], found[3]["x"][1])


def test_one_of_many_that_fails_does_not_spoil_the_others():
    found = nlmech.integrate("x' = x^2", np.array([[0.5], [2.0]]), until=1)  # 1/(2 - t), and a pole at 1/2
    assert found[0]["x"][-1] == pytest.approx(1, abs=1e-7)
    assert found[1].status != "success" and found[1].sentence and found[1].t.size == 0


def test_compare_and_choose():
    runs = nlmech.compare("x'' = -x", "x=1, x'=0", until=10, methods=["ode45", "series"], tolerances=[1e-6, 1e-9])
    assert [(r.method, r.setting) for r in runs] == [(m, f"tolerance {t}") for m in ("ode45", "series") for t in ("1e-06", "1e-09")]
    assert all(r.status == "success" and r.digits > 4 and r.right_hand_sides > 0 for r in runs)
    ranked = nlmech.choose("x'' = -x", "x=1, x'=0", until=10, digits=6)
    assert [one.rank for one in ranked] == list(range(1, len(ranked) + 1)) and ranked[0].reason


@pytest.mark.parametrize("arguments, words", [
    ({}, "until: missing"),
    ({"until": 1, "method": "rk5"}, "method: .*rk4"),
    ({"until": 1, "tolerance": 1e-6, "step": 0.1}, "step 0.1 tolerance 1e-06: give a step or a tolerance"),
    ({"until": 1, "at": [2.0]}, "at 2: is outside the run"),
    ({"until": 1, "set": {"b": 1}}, "b"),
    ({"until": 1, "initial": "y=1"}, "initial:1:1: no component")])
def test_wrong_arguments_are_value_errors(arguments, words):
    with pytest.raises(ValueError, match=words) as raised:
        nlmech.integrate(DUFFING, **{"initial": START, **arguments})
    assert "--" not in str(raised.value)


@pytest.mark.parametrize("wrong", [
    lambda: nlmech.integrate(DUFFING, np.ones((3, 4)), until=1), lambda: nlmech.geodesy.reverse([1.0, 2.0]),
    lambda: nlmech.orbit.propagate(np.ones((2, 5)), 1), lambda: nlmech.orbit.propagate([LOW, LOW], [1, 2, 3]),
    lambda: nlmech.geodesy.reverse([1.0, 2, 3], "mars"), lambda: nlmech.geodesy.forward([91.0, 0, 0])])
def test_wrong_shapes_are_value_errors(wrong):
    pytest.raises(ValueError, wrong)


def test_a_failure_carries_what_was_computed():
    with pytest.raises(nlmech.Failure, match="t = 0.[45]") as raised:
        nlmech.integrate("x' = x^2", "x=2", until=1, method="ode45")  # a pole at 1/2
    part = raised.value.partial
    assert raised.value.status == part.status != "success"
    # 1/(1/2 - t) up to the last good step, to the digits that the pole leaves
    assert 0.4 < part.t[-1] < 0.5 and part["x"][-1] > 10
    assert pickle.loads(pickle.dumps(nlmech.Failure("s", "step_limit"))).status == "step_limit"


# Interruption, progress, threads

LONG = {"equation": "x'' + sin(x) = 0", "initial": "x=3, x'=0", "until": 1e6, "method": "rk4", "step": 1e-3, "limit": 1e6}


def test_ctrl_c_ends_a_run():
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        nlmech.integrate(**LONG)  # 1e9 steps: minutes
    timer.join()


def test_a_verification_can_be_interrupted():
    """Seconds in extended precision after a run of milliseconds, with the share 1; progress is told every 50 ms."""
    def watch(share):
        if share == 1:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        nlmech.integrate("x'' + sin(x) = 0", "x=3, x'=0", until=3000, progress=watch)


def test_progress_grows_other_threads_run_and_an_exception_ends_a_run():
    """A thread counts while another one computes: with Python's lock held it would not."""
    shares, counts = [], []

    def watch(share):
        shares.append(share)
        if len(counts) > 20 and len(shares) > 3:
            raise LookupError("enough")

    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        computed = pool.submit(nlmech.integrate, **LONG, progress=watch)
        while not computed.done():
            counts.append(1)
            time.sleep(0.001)
    with pytest.raises(LookupError, match="enough"):
        computed.result()
    assert shares == sorted(shares) and 0 <= shares[0] < shares[-1] < 1


def test_threads_give_the_same_bits():
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        first, *others = pool.map(lambda _: nlmech.integrate(DUFFING, START, until=20, every=1)["x"], range(4))
    for other in others:
        same(first, other)


# Boundary values

def test_bvp_has_the_bits_of_the_command():
    printed = command("rbf_inverse", "bvp", "--equation", "x'' + exp(x) = 0; x(0) = 0; x(1) = 0", "--starts", "20")
    found = nlmech.bvp("x'' + exp(x) = 0", "x(0) = 0; x(1) = 0", starts=20)
    assert len(found) == 2  # Bratu's problem
    for i, one in enumerate(found):
        chosen = printed["solution"] == i + 1
        same(one.t, printed["t"][chosen])
        # The command prints values below 1e-18 of the largest as 0.
        np.testing.assert_allclose(one["x"], printed["x"][chosen], rtol=0, atol=1e-18 * np.abs(one["x"]).max())
    # x = 2 ln(cosh(c)/cosh(c (1 - 2 t))) with c = sqrt(2)/4 cosh(c) at the lower one: the residual 1e-9 bounds the error here.
    c = 0.0
    for _ in range(100):
        c = math.sqrt(2) / 4 * math.cosh(c)
    t = np.linspace(0, 1, 33)
    lower = min(found, key=lambda one: one["x"].max())
    np.testing.assert_allclose(lower(t)["x"], 2 * np.log(np.cosh(c) / np.cosh(c * (1 - 2 * t))), atol=1e-8)
    again = nlmech.bvp("x'' + exp(x) = 0", "x(0) = 0; x(1) = 0", guess=found[-1])
    np.testing.assert_allclose(again(t)["x"], found[-1](t)["x"], atol=1e-8)


def test_bvp_with_an_unknown_constant_and_in_a_parameter():
    """x'' + k^2 x = 0 with x(0) = x(1) = 0 and x'(0) = 1: k = pi from a guess near it."""
    found = nlmech.bvp("x'' + k^2 x = 0", "x(0) = 0; x(1) = 0; x'(0) = 1", unknown="k", guess="x = sin(3 t), k = 3")
    assert found["k"][0] == pytest.approx(math.pi, rel=1e-9)
    printed = command("rbf_inverse", "bvp", "--equation", "eps x'' = x; x(0) = 1; x(1) = 0", "--from-parameter", "eps = 1 : 0.01")
    followed = nlmech.bvp("eps x'' = x; x(0) = 1; x(1) = 0", from_parameter=("eps", 1, 0.01))
    same(followed.t, printed["t"])
    np.testing.assert_allclose(followed["x"], printed["x"], rtol=0, atol=1e-18)
    t = np.array([0.05, 0.3])
    np.testing.assert_allclose(followed(t)["x"], np.sinh((1 - t) / 0.1) / math.sinh(10), atol=1e-9)
    with pytest.raises(ValueError, match="set gives eps too"):
        nlmech.bvp("eps x'' = x; x(0) = 1; x(1) = 0", from_parameter=("eps", 1, 0.01), set={"eps": 1})
    with pytest.raises(nlmech.Failure, match="a = [0-9.]+ was reached"):  # the branch turns back at 3.51
        nlmech.bvp("x'' + a exp(x) = 0", "x(0) = 0; x(1) = 0", from_parameter=("a", 1, 4))
    with pytest.raises(nlmech.Failure):
        nlmech.bvp("x'' + 4 exp(x) = 0", "x(0) = 0; x(1) = 0", guess="x = 0")  # beyond the fold at 3.51
    with pytest.raises(ValueError, match="condition"):
        nlmech.bvp("x'' + exp(x) = 0", "x(0) = 0")


# Geodesy

def test_geodesy_has_the_bits_of_the_command(folder):
    draws = np.random.default_rng(1)
    points = 6.4e6 * draws.uniform(-1.2, 1.2, (2000, 3))
    printed = command("geodesy", "reverse", table(folder / "points.csv", "xyz", points))
    found = nlmech.geodesy.reverse(points)
    same(found.T, [printed[name] for name in ("latitude_deg", "longitude_deg", "height_m")])
    printed = command("geodesy", "forward", table(folder / "back.csv", ["lat", "lon", "h"], found), "--ellipsoid", "GRS 80")
    same(nlmech.geodesy.forward(found, "GRS 80").T, [printed[name] for name in "xyz"])
    same(nlmech.geodesy.reverse(points[7]), found[7])
    many = np.tile(points, (150, 1))  # more than one portion
    same(nlmech.geodesy.reverse(many)[-2000:], found)
    for view in (np.asfortranarray(points), np.repeat(points, 2, axis=1)[:, ::2]):  # other orders in memory
        same(nlmech.geodesy.reverse(view), found)
        same(nlmech.geodesy.reverse(view[::-1]), found[::-1])
    with pytest.raises(nlmech.Failure, match="index 1") as raised:
        nlmech.geodesy.reverse([points[0], [math.nan, 0, 0], points[2]])
    same(raised.value.partial[[0, 2]], found[[0, 2]])


# Orbits

@pytest.mark.parametrize("words, arguments", [
    ([], {}), (["--every", "700"], {"every": 700}), (["--stm"], {"stm": True}), (["--every", "700", *ZONAL], {"every": 700, **FIELD}),
    (["--every", "700", "--stm", *ZONAL], {"every": 700, "stm": True, **FIELD})])
def test_orbits_have_the_bits_of_the_command(folder, words, arguments):
    states = np.array(LOW) * np.linspace(1, 1.1, 50)[:, None]
    file = table(folder / "states.csv", ["x", "y", "z", "vx", "vy", "vz"], states)
    printed = command("two_body_series", "propagate", "--states", file, "--until", "5000", *words)
    found = nlmech.orbit.propagate(states, 5000, **arguments)
    rows = np.column_stack([printed[name] for name in ("x", "y", "z", "vx", "vy", "vz")])
    same(found.x, rows.reshape(found.x.shape))
    same(np.broadcast_to(found.t, found.x.shape[:-1]), printed["t"].reshape(found.x.shape[:-1]))
    single = nlmech.orbit.propagate(states[3], 5000, threads=1, **arguments)
    same(single.x, found.x[3])
    if "stm" in arguments:
        phi = np.column_stack([printed[f"phi_{i}{j}"] for i in range(1, 7) for j in range(1, 7)])
        same(found.stm, phi.reshape(found.stm.shape))
        same(single.stm, found.stm[3])


def test_an_orbit_that_fails():
    with pytest.raises(nlmech.Failure) as raised:
        nlmech.orbit.propagate([1, 0, 0, 0, 0, 0.0], 3, mu=1)  # falls into the centre at pi/sqrt(8)
    assert raised.value.status == "collision" and 1 < float(raised.value.partial.t) < 1.2
    states = [[1, 0, 0, 0, 0, 0.0], [1, 0, 0, 0, 1, 0], [1, math.nan, 0, 0, 1, 0]]
    for stm in (False, True):
        found = nlmech.orbit.propagate(states, [3, 2 * math.pi, 1], mu=1, stm=stm)
        assert found.status == ["collision", "success", "non_finite"] and found.sentence[1] == ""
        np.testing.assert_allclose(found.x[1], [1, 0, 0, 0, 1, 0], atol=1e-13)  # a circle
    with pytest.raises(ValueError, match="kilometres"):
        nlmech.orbit.propagate([7000, 0, 0, 0, 7.5, 0.0], 100)


def test_lambert_and_porkchop_have_the_bits_of_the_commands(folder):
    r1, r2, time = [2.87e6, 5.19e6, 2.85e6], [2.09e6, 7.82e6, 0], 4320
    printed = command("rbf_inverse", "lambert", "--from", "2.87e6,5.19e6,2.85e6", "--to", "2.09e6,7.82e6,0", "--time", 4320)
    found = nlmech.orbit.lambert(r1, r2, time)
    same([*found.v1, *found.v2], [printed[name][0] for name in ("vx0", "vy0", "vz0", "vx1", "vy1", "vz1")])
    many = nlmech.orbit.lambert([r1] * 40, [r2] * 40, time)
    same(many.v1, [found.v1] * 40)
    with pytest.raises(nlmech.Failure):
        nlmech.orbit.lambert(r1, r2, time, revolutions=5, branch="low")
    body = "position = [{}, {}, {}]\nvelocity = [{}, {}, {}]\n".format
    write(folder / "orbits.toml", f"mu = {SUN!r}\n[from]\n{body(*EARTH)}[to]\n{body(*MARS)}[departures]\nfirst = 0\nlast = 3e7\n"
                                  "[arrivals]\nfirst = 2e7\nlast = 6e7\n")
    printed = command("rbf_inverse", "porkchop", folder / "orbits.toml", "--grid", "9x11")
    grid = nlmech.orbit.porkchop(EARTH, MARS, (0, 3e7, 9), (2e7, 6e7, 11), mu=SUN)
    exists = grid.revolutions >= 0
    same(grid.v_departure[exists], printed["v_departure"])
    same(grid.v_arrival[exists], printed["v_arrival"])
    same(np.broadcast_to(grid.arrivals, exists.shape)[exists], printed["arrival"])
    assert np.isnan(grid.v_departure[~exists]).all() and not exists.all()


# Frames and spacecraft

def test_frames_and_spacecraft_have_the_bits_of_the_commands():
    toggle = SOURCE / "chapters/homotopy/frames/toggle.toml"
    printed = command("homotopy", "frame", toggle)
    found = nlmech.frames.path(toggle)
    assert [f"{v:.12g}" for v in found.load_factor] == [f"{v:.12g}" for v in printed["load_factor"]]
    assert [f"{v:.12g}" for v in found.displacement["B.y"]] == [f"{v:.12g}" for v in printed["B.y"]]
    assert found.kind == printed["kind"]
    same(found.negative_eigenvalues, printed["negative_eigenvalues"])
    with pytest.raises(nlmech.Failure) as raised:
        nlmech.frames.path(toggle, steps=3)
    assert len(raised.value.partial.load_factor) >= 3
    with pytest.raises(ValueError, match="no-such.toml"):
        nlmech.frames.path("no-such.toml")
    printed = command("gss_control", "response", "--omega", "0.3,7,40", "--at", "2,4", "--gains", "12,0,16")
    theta, y = nlmech.spacecraft.response([0.3, 7, 40], at=[2, 4], gains=[12, 0, 16])
    same(theta, printed["theta_re"] + 1j * printed["theta_im"])
    same(y[:, 1], printed["y@4_re"] + 1j * printed["y@4_im"])
    other, _ = nlmech.spacecraft.response([7], spacecraft={"tip_mass": 0, "tip_inertia": 0})
    assert other[0] != nlmech.spacecraft.response([7])[0][0]
    with pytest.raises(ValueError, match="hub_mass"):
        nlmech.spacecraft.response([7], spacecraft={"hub_mass": 1})


def public():
    modules = (nlmech, nlmech.geodesy, nlmech.orbit, nlmech.frames, nlmech.spacecraft)
    for module in modules:
        for name, value in vars(module).items():
            if name[0] != "_" and (name in nlmech.__all__ or getattr(value, "__module__", "") == module.__name__):
                yield f"{module.__name__}.{name}", value


@pytest.mark.parametrize("name, value", public(), ids=lambda value: value if isinstance(value, str) else "")
def test_everything_public_has_a_docstring_and_type_hints(name, value):
    assert inspect.getdoc(value)
    if inspect.isfunction(value):
        hints = value.__annotations__
        plain = {"initial", "states", "until", "mu", "r1", "r2", "time", "xyz", "geodetic", "departure", "arrival", "omega", "t"}  # arrays
        assert [p for p in inspect.signature(value).parameters if p not in hints and p not in plain] == []
        assert "return" in hints or name == "nlmech.integrate"  # by overloads
