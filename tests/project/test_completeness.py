"""Every figure and table of the sources is a scene, or belongs to a chapter that is not built, and vice versa. A problem means the same in
all chapters."""
import csv
import re

import pytest

from nlmech_tree import chapters, program, run, scenes, text_of


@pytest.fixture(scope="module")
def built():
    """The names of the scenes of this build, by chapter."""
    return {chapter: {row["scene"] for row in scenes(chapter)} for chapter in chapters()}


@pytest.fixture(scope="module")
def places():
    """The rows of tables/places.csv; a place without scenes is shown by the one of its own name."""
    rows = list(csv.DictReader(text_of("tables/places.csv").splitlines()))
    return [row | {"scenes": row["scenes"].split() or [row["place"]]} for row in rows]


def test_every_figure_and_table_is_a_scene(built, places):
    shown = [row for row in places if row["kind"] in ("figure", "table") and row["chapter"] in built]
    assert shown or not built
    assert not [(row["source"], row["place"], row["subject"], scene) for row in shown for scene in row["scenes"]
                if scene not in built[row["chapter"]]]


def test_every_numbered_scene_stands_in_a_source(built, places):
    listed = {(row["chapter"], scene) for row in places for scene in row["scenes"]}
    assert not [(chapter, scene) for chapter, names in built.items() for scene in sorted(names)
                if scene.startswith(("fig-", "table-")) and (chapter, scene) not in listed], "tables/places.csv does not list these"


def problems_of(chapter):
    """Problems of `integrate` and their equations: what its help says between "Problems" and "Methods"."""
    done = run(program(chapter), "integrate", "--help", code=None)
    section = re.search(r"^Problems.*?(?=^Methods|\Z)", done.stdout, re.MULTILINE | re.DOTALL)
    return re.findall(r"^  (\S.*?): (.*)$", section[0], re.MULTILINE) if done.returncode == 0 and section else []


def test_one_name_is_one_equation():
    """A command from the page of one chapter means the same in another, or is refused there."""
    equations = {}
    for chapter in chapters():
        for name, equation in problems_of(chapter):
            equations.setdefault(name, {}).setdefault(equation, []).append(chapter)
    assert not {name: found for name, found in equations.items() if len(found) > 1}
    with_problems = {"rbf_ivp", "algebraic_series", "hermitian", "transversal", "integrators"}
    assert ("duffing" in equations) == bool(with_problems & set(chapters())), "the help is read"
