"""Comparison of printed outputs, and the tests that run those commands of README and CONTRIBUTING that call no program of the build."""
import re

import pytest

from nlmech_tree import text_of
from printed import differs_from
from test_printed_commands import commands_of, program_of

OUTPUT = "method,error,seconds,steps\nrk4,1.0e-5,0.5,1234567890.5\neuler,2e-17,3,-4\n"


@pytest.mark.parametrize("output, printed", [
    (OUTPUT, OUTPUT.splitlines()),
    (OUTPUT, ["method,error,seconds,steps", "..."]),
    (OUTPUT, ["...", "euler,-9e-17,7,-4"]),
    (OUTPUT, ["...", "rk4,1.8e-5,70,1234567890.6 ...", "..."]),
    ("a,1\nb,2\nb,2\n", ["a,1", "...", "b,2"]),
    ("a: -infinite 12345678901\n", ["a: -infinite 12345678902"])])
def test_outputs_may_differ_by_rounding_and_in_run_times(output, printed):
    assert differs_from(output, printed) == ""


@pytest.mark.parametrize("printed", [
    ["method,error,seconds,steps"],
    ["...", "rk4,2.2e-5,0.5,1234567890.5", "..."],
    ["...", "rk4,1.0e-5,0.5,1234667890.5", "..."],
    ["...", "euler,2e-17,3,4"],
    ["...", "euler,2e-17,3,-4", "more"],
    ["...", "Euler ...", "..."]])
def test_other_outputs_differ(printed):
    assert differs_from(OUTPUT, printed) != ""


# A pattern that the whole command matches, and a file with words that show that something runs it; \1 is the pattern's first group.
ELSEWHERE = [
    # Targets of the Makefile, and its words.
    (r"make ([a-z]+)( [A-Z_]+=\S+)*( +#.*)?", "Makefile", "\n\\1: "),
    (r"make (chapter-)[a-z_]+( [A-Z_]+=\S+)*( +#.*)?", "Makefile", "\n\\1%: "),
    # What `make oracles` runs, and its sister that keeps the rows.
    (r"(scripts/oracles) (record|uses).*", "Makefile", r"\1"),
    # Installing and building on it: README alone, whose lines that test runs.
    (r"(cmake --install|cmake -S|cmake --build build-mine|build-mine/).*", "tests/consumer/consumer_test.cmake", "cmake |build-mine/"),
    # Installing the package, in a bare root: what Dockerfile does with it.
    (r"sudo (apt-get install) \./build/nlmech_\*\.deb", "scripts/package", r"\1"),
    (r"docker build -t nlmech \.", "Dockerfile", "RUN /tmp/package install"),
    # Parts of what runs before a change lands.
    (r"(cmake --preset asan)", ".ci/run", r"\1"),
    (r"(scripts/lint) HEAD~1", ".ci/run", r"\1 "),
    (r"(scripts/weight)", ".ci/run", r"\1"),
    (r"cmake --build build(-asan)? --target (unit_tests_)[a-z]+", "tests/CMakeLists.txt", r"\2"),
    (r"(ctest --test-dir) build.*", ".ci/run", r"\1"),
    (r"(\.ci/run)", ".ci/run", "#!"),
    (r"(git ls-files '\*\.hpp' '\*\.cpp' \| xargs clang-format) -i", ".ci/run", r"\1"),
    (r"(clang-tidy -p build-dev --quiet --checks=-clang-analyzer-\*) \S+", ".ci/run", r"\1"),
    # Tests of pages and commands by hand: the same files that ctest runs.
    (r"(pytest-3) tests/[a-z/_]+(\.py)?", "tests/CMakeLists.txt", r"\1"),
    (r"PATH=\S+ (cram3) -i tests/commands/[a-z_]+\.t", "tests/commands/CMakeLists.txt", r"\1"),
]


def runs_elsewhere(command):
    return any(match.expand(words) in text_of(file) for pattern, file, words in ELSEWHERE if (match := re.fullmatch(pattern, command)))


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md"])
def test_commands_without_a_program_run_elsewhere(page):
    assert [(line, command) for block, line, command in commands_of(text_of(page))
            if not program_of(command) and not runs_elsewhere(command)] == []


def test_readme_begins_with_commands_that_run_at_every_change():
    first = [command for _, _, command in commands_of(text_of("README.md"))][:2]
    for target in ("figures", "test"):
        assert any(command.startswith(f"make {target}") for command in first)
        assert re.search(rf"step \w+ make (-j2 )?{target}", text_of(".ci/run"))


@pytest.mark.parametrize("command, known", [("make figures   # a remark", True), ("make breakfast", False), ("rm -rf build", False)])
def test_targets_are_known(command, known):
    assert runs_elsewhere(command) == known
