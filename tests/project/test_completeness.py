"""Every figure and table of the sources is a scene, or belongs to a chapter that is not built, and vice versa. A problem means the same in
all chapters."""
import csv
import re
from collections import Counter

import pytest

from nlmech_tree import SOURCE, chapters, program, run, scenes, text_of


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
    shown = [row for row in places if row["kind"] in ("figure", "table", "algorithm") and row["chapter"] in built]
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


@pytest.fixture(scope="module")
def published():
    """The rows of tables/published with their sources."""
    files = sorted((SOURCE / "tables/published").glob("*.csv"))
    return [row | {"source": file.stem} for file in files for row in csv.DictReader(text_of(file).splitlines())]


def twice(names):
    return [name for name, count in Counter(names).items() if count > 1]


def test_printed_numbers_are_named_once(published):
    assert len(published) > 200
    names = ["/".join(row[column] for column in ("source", "place", "row", "quantity")) for row in published]
    assert not twice(names)
    assert not [name for name, row in zip(names, published) if not (row["place"] and row["row"] and row["quantity"]) or "\n" in name]


def test_printed_numbers_stand_in_places_that_are_listed_once(published, places):
    listed = [(row["source"], row["place"]) for row in places]
    assert not twice(listed)
    assert not {(row["source"], row["place"]) for row in published} - set(listed)


def test_printed_numbers_use_their_words_rightly(published):
    kinds = {"parameter", "value", "error", "count", "time", "claim", "rounding", "bound"}
    assert not [row for row in published if row["kind"] not in kinds]
    assert not [row for row in published if not row["unit"]], "a number without a unit has unit 1"
    assert not [row for row in published if (row["kind"] == "parameter") != (row["expected"] == "input")]
    assert not [row for row in published if row["kind"] == "time" and row["expected"] != "context"]
    assert not [row for row in published if row["expected"] in ("differs", "not stated") and not row["reading"]], "needs a cause"


def test_places_use_their_words_rightly(places):
    assert not [row for row in places if row["kind"] not in {"figure", "table", "algorithm", "claim", "equation"}]
    for kind, start in (("figure", "fig-"), ("table", "table-")):
        assert not [row for row in places if (row["kind"] == kind) != row["place"].startswith(start)]
    assert not [row for row in places if not (row["chapter"] and row["subject"])]
