"""The configuration asks for what was selected, and says what is missing."""
import re

import pytest

from nlmech_tree import BUILD, SOURCE, run, sources_under, text_of, write

CACHE = dict(re.findall(r"^(\w+):\w+=(.*)$", text_of(BUILD / "CMakeCache.txt"), re.MULTILINE))


def configure(source, build, *settings, code=0):
    return run(CACHE["CMAKE_COMMAND"], "-S", source, "-B", build, "-G", CACHE["CMAKE_GENERATOR"],
               f"-DCMAKE_CXX_COMPILER={CACHE['CMAKE_CXX_COMPILER']}", *settings, code=code)


def test_geodesy_needs_no_numerical_library(folder):
    absent = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("SUNDIALS", "GSL", "Boost", "Eigen3")]
    configure(SOURCE, folder, "-DNLMECH_TESTS=OFF", "-DNLMECH_CHAPTERS=geodesy", *absent)
    assert text_of(folder / "chapters.txt").split() == ["geodesy"]


def test_no_chapter_at_all_is_fine(folder):
    configure(SOURCE, folder, "-DNLMECH_TESTS=OFF", "-DNLMECH_CHAPTERS=none", "-DNLMECH_PEERS=none")


def test_within_another_project_it_is_the_library_alone(folder):
    """As FetchContent does it with a downloaded source: add_subdirectory()."""
    write(folder / "CMakeLists.txt",
          "cmake_minimum_required(VERSION 3.25)\nproject(mine LANGUAGES CXX)\ninclude(FetchContent)\n"
          f'FetchContent_Declare(nlmech SOURCE_DIR "{SOURCE}")\nFetchContent_MakeAvailable(nlmech)\n')
    configure(folder, folder / "build")
    targets = run(CACHE["CMAKE_COMMAND"], "--build", folder / "build", "--target", "help").stdout
    assert [name for name in ("nlmech_ivp", "nlmech_frames", "nlmech_geodesy") if name not in targets] == []
    foreign = ("homotopy", "reproduction", "unit_", "figures", "nlmech_scene", "every_integrator")
    assert [name for name in foreign if name in targets] == []


@pytest.mark.parametrize("setting, words", [
    ("-DNLMECH_CHAPTERS=geodesy,astrology", "there is no 'astrology'; there is homotopy"),
    ("-DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON", "fmt was not found. On Debian: apt-get install libfmt-dev")])
def test_what_is_refused(folder, setting, words):
    done = configure(SOURCE, folder, "-DNLMECH_TESTS=OFF", setting, code=None)
    assert done.returncode != 0
    assert words in " ".join(done.stderr.split())  # CMake wraps its messages


def test_packages_that_the_build_names_are_listed():
    """packages.txt is the only list: what the build asks for by name must be in it."""
    listed = text_of("packages.txt").splitlines()
    calls = [(file, kind, words.split()) for file in sources_under("common", "chapters", "tests", "cmake", "tools", ends=(".cmake", ".txt"))
             for kind, words in re.findall(r"^ *nlmech_require(\w*)\(([^)]*)\)", text_of(file), re.MULTILINE)]
    assert len(calls) >= 5
    assert not [call for call in calls if call[2][2 if call[1] == "" else 1] not in listed]
