"""Outputs and counts in README are those of the current programs; pages show the pictures of docs/gallery."""
import re

import pytest

from nlmech_tree import SOURCE, program, run, text_of
from printed import blocks_of, without_numbers

README = text_of("README.md")


def block(language):
    """The only block of a language in README."""
    found, = [block.lines for block in blocks_of(README) if block.language == language]
    return found


def test_shows_the_example_as_it_is_compiled():
    assert "\n".join(block("cpp")) == text_of("examples/every_integrator.cpp").split("// [example]\n")[1].rstrip("\n")


def test_links_as_the_examples_do():
    used = [line.strip() for line in text_of("examples/CMakeLists.txt").splitlines()]
    assert [line for line in block("cmake") if line not in used] == []


def close(a, b):
    return a == b or (b / 2 < a < 2 * b)


def alike(a, b):
    """Are two lines the same but for numbers within a factor of two?"""
    (words_a, a), (words_b, b) = without_numbers(a), without_numbers(b)
    return words_a == words_b and all(close(float(x), float(y)) for x, y in zip(a, b))


def test_prints_what_the_example_says():
    """A few lines of its output, within a factor of two in their numbers: compilers round differently."""
    if not program("every_integrator").exists():
        pytest.skip("the components for integration are not built")
    output = run(program("every_integrator")).stdout
    assert [line for line in block("text") if not any(alike(said, line) for said in output.splitlines())] == [], output


def verdicts():
    """The sums of the columns of the first table of tables/REPRODUCTION.md, as README prints them."""
    table = re.search(r"(?:^\|.*\n)+", text_of("tables/REPRODUCTION.md"), re.MULTILINE)[0]
    head, _, *rows = ([cell.strip() for cell in row.split("|")[2:-1]] for row in table.splitlines())
    sums = [(name, sum(map(int, column))) for name, *column in zip(head, *rows)]
    columns = [(name, "---:", str(count)) for name, count in sums if count]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in zip(*columns))


def test_counts_the_verdicts_of_the_reproduction():
    assert re.search(r"<!-- verdicts -->\n(.*?)<!-- end -->", README, re.DOTALL)[1] == verdicts(), "put the second text between the markers"


def test_pictures_of_the_gallery_are_shown_and_small():
    """README shows eight; pages on forges show those of their chapter."""
    pictures = sorted((SOURCE / "docs/gallery").iterdir())
    of_readme = [file for file in pictures if f"(docs/gallery/{file.name})" in README]
    others = [file for file in pictures if file not in of_readme]
    assert len(of_readme) == 8
    assert [file for file in others if f"(../gallery/{file.name})" not in text_of(f"docs/chapters/{file.name.partition('-')[0]}.md")] == []
    assert [file for file in pictures if file.stat().st_size >= (500_000 if file in of_readme else 60_000)] == []
    assert sum(file.stat().st_size for file in pictures) < 3_000_000
