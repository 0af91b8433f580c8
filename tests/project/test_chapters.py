"""What every chapter of this build must be able to do."""
import csv
import json
import re

import pytest

from nlmech_tree import BUILD, SOURCE, chapters, program, run, scenes

KINDS = ("figures/{}.svg", "results/{}.csv", "results/{}.gp", "results/{}.json", "tables/{}.csv", "tables/{}.md")
STYLE = "figures/style.gp"  # loaded by all scripts
pytestmark = pytest.mark.parametrize("chapter", chapters())


def files_of(chapter, scene):
    return [kind.format(f"{chapter}/{scene}") for kind in KINDS]


def files_in(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def has_rows(table):
    return sum(1 for _ in csv.reader(table.decode().splitlines())) > 1


def missing(files, chapter, scene):
    """A scene has a picture with something drawn in it and the script that draws it, a table with rows, or both."""
    svg, data, script, _, table, page = (files.get(file) for file in files_of(chapter, scene))
    if data is None and table is None:
        yield "neither figure nor table"
    if data is not None:
        if svg is None:
            yield "data without a picture"
            svg = b""
        if script is None:
            yield "a picture without a script"
        if not any(element in svg for element in (b"<path", b"<polyline", b"<image", b"<text")) or b"</svg>" not in svg:
            yield "an empty picture"
        if not has_rows(data):
            yield "data without rows"
    if table is not None and (page is None or not has_rows(table)):
        yield "an empty table"


def wrong_provenance(files, chapter, scene, declared):
    """Names of the runs, with the declared ones among them; at least one check, each with its reason and unit."""
    found = json.loads(files[f"results/{chapter}/{scene}.json"], parse_constant=str)  # NaN and Infinity are no numbers of JSON
    if (found["chapter"], found["scene"], found["effort"]) != (chapter, scene, "quick"):
        yield "chapter, scene or effort of another run"
    runs = [each["name"] for each in found["runs"]]
    if runs != sorted(set(runs)):
        yield f"runs are not sorted, or there is one twice: {runs}"
    if not set(declared) <= set(runs) or (runs and not declared):
        yield f"lists the runs {declared} and has {runs}"
    if not found["quantities"]:
        yield "no checks"
    for quantity in found["quantities"]:
        if not quantity["reason"] or not quantity["unit"] or type(quantity["value"]) not in (int, float):
            yield f"a check without reason, unit or number: {quantity}"


def is_timed(data):
    """Data, tables and figures of a scene with a column of measured times differ from run to run."""
    return re.search(rb'(^|,)"?time[_ ]', data.partition(b"\n")[0]) is not None


def test_lists_its_scenes(chapter):
    names = [row["scene"] for row in scenes(chapter)]
    assert names and len(set(names)) == len(names)
    run(program(chapter), "--help")
    run(program(chapter), "run", code=2)
    run(program(chapter), "run", "no-such-scene", code=2)


def test_shows_all_its_scenes_the_same_twice(chapter, folder):
    first = run(program(chapter), "run", "--all", "--quick", "--out", folder / "first")
    assert first.stderr == ""
    files = files_in(folder / "first")
    files.pop(STYLE, None)
    assert sorted(first.stdout.splitlines()) == sorted(files), "files that are named and files that are there"
    complaints, known, timed = [], set(), set()
    for row in scenes(chapter):
        scene, names = row["scene"], files_of(chapter, row["scene"])
        for complaint in (*missing(files, chapter, scene), *wrong_provenance(files, chapter, scene, row["runs"].split())):
            complaints.append(f"{scene}: {complaint}")
        known.update(names)
        if any(is_timed(files.get(f"{kind}/{chapter}/{scene}.csv", b"")) for kind in ("results", "tables")):
            timed.update(name for name in names if not name.endswith(".json"))
    complaints += [f"{name} belongs to no scene" for name in files if name not in known]
    complaints += [f"{name} contains the path {path}" for name, content in files.items()
                   for path in (SOURCE, BUILD, folder) if str(path).encode() in content]
    # A picture is what its script makes of its data.
    files = {name: content for name, content in files.items() if not name.endswith(".svg")}
    run(program(chapter), "run", "--all", "--quick", "--no-plots", "--out", folder / "second")
    again = files_in(folder / "second")
    again.pop(STYLE, None)
    assert sorted(again) == sorted(files)
    complaints += [f"{name} differs in a second run" for name in files if name not in timed and again[name] != files[name]]
    assert not complaints, "\n".join(complaints)


def test_writes_only_the_scene_that_is_asked_for(chapter, folder):
    rows = scenes(chapter)
    runs = [row["runs"] for row in rows]
    scene = min(rows, key=lambda row: runs.count(row["runs"]))["scene"]  # runs that many scenes share take long
    run(program(chapter), "run", scene, "--quick", cwd=folder)
    files = set(files_in(folder))
    assert f"results/{chapter}/{scene}.json" in files
    assert files <= {STYLE, *files_of(chapter, scene)}
