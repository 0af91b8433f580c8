"""What may stand in the sources: who includes whom, how long a file is, no macros; which tests are run; what programs are linked with."""
import re

import pytest

from nlmech_tree import BUILD, SOURCE, chapters, program, run, sources_under, text_of

LIBRARY = SOURCE / "common/nlmech"


def components():
    """The components and those that each one uses directly."""
    return {name: set(used.split()) for name, used in re.findall("^(.*?):(.*)$", text_of(BUILD / "components.txt"), re.MULTILINE)}


def reached(uses, component):
    """A component, what it uses, and what those use in turn."""
    found, left = set(), [component]
    while left:
        if (name := left.pop()) not in found:
            found.add(name)
            left += uses[name]
    return found


def includes():
    """The component that includes, what it includes ("nlmech/geodesy/ellipsoid.hpp"), and file and line."""
    for file in sources_under("common/nlmech"):
        place = file.relative_to(LIBRARY)
        if len(place.parts) == 1:  # lists the components
            continue
        for at, line in enumerate(text_of(file).splitlines(), 1):
            if match := re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', line):
                yield place.parts[0], match[1], f"{place}:{at}"


def test_components_are_there_as_folders():
    uses = components()
    assert {"support", "scene"} <= set(uses)
    assert [name for name in uses if not (LIBRARY / name).is_dir()] == []
    assert [(name, other) for name, used in uses.items() for other in used if other not in uses] == []


def test_components_use_each_other_without_circles():
    uses = components()
    assert [(name, other) for name, used in uses.items() for other in used if name in reached(uses, other)] == []


def test_components_include_only_what_they_use():
    uses = components()
    allowed = {name: reached(uses, name) for name in uses}
    # A component that is not in this build is skipped, like the peer that includes it.
    found = [(where, what) for name, what, where in includes()
             if what.startswith("nlmech/") and name in uses and what.split("/")[1] in uses]
    assert len(found) > 20
    assert [(where, what) for where, what in found if what.split("/")[1] not in allowed[where.split("/")[0]]] == []


def test_components_include_each_other_by_their_full_names():
    assert [(where, what) for name, what, where in includes() if (LIBRARY / name / what).exists() or ".." in what] == []


def test_components_know_nothing_of_scenes_and_command_lines():
    """But for the two top floors: scenes, and what all chapters on initial value problems show with them."""
    assert [(where, what) for name, what, where in includes()
            if name not in ("scene", "comparison") and what.startswith(("nlmech/scene/", "CLI/", "nlohmann/"))] == []


def test_sources_are_short():
    files = sources_under("common", "chapters", "tests", "tools", ends=(".hpp", ".cpp", ".cmake", ".txt", ".py"))
    assert [file for file in files if len(text_of(file).splitlines()) > 800] == []


def test_sources_define_no_function_macros():
    assert [(file, macro) for file in sources_under("common", "chapters", "tools")
            for macro in re.findall(r"^\s*#\s*define\s+\w+\(", text_of(file), re.MULTILINE)] == []


def test_headers_begin_with_their_guard_and_their_description():
    texts = {file: text_of(file).splitlines() for file in sources_under("common", "chapters", "tools", ends=(".hpp",))}
    assert [file for file, lines in texts.items() if lines[:1] != ["/// @file"] or lines.count("#pragma once") != 1] == []


@pytest.mark.parametrize("kind, least", [("*_test.cpp", 100), ("test_*.py", 15), ("*.t", 15)])
def test_tests_are_all_run(kind, least):
    """A file of tests that no CMakeLists.txt names is not run, and nobody misses it."""
    named = {(file.parent / word).resolve() for file in (SOURCE / "tests").rglob("CMakeLists.txt")
             for word in re.split(r"[()\s]+", text_of(file))}
    files = list((SOURCE / "tests").rglob(kind))
    assert [file for file in files if file not in named] == []
    assert len(files) > least


def test_geodesy_is_linked_with_nothing_foreign():
    if "geodesy" not in chapters():
        pytest.skip("geodesy is not built")
    libraries = run("ldd", program("geodesy")).stdout.lower()
    assert "libc.so" in libraries
    assert [name for name in ("sundials", "gsl", "boost", "ipopt") if name in libraries] == []
