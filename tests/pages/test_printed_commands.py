"""Every command that README, CONTRIBUTING and the chapters' pages print is run as a reader would type it, in a folder with the build and the
chapters, or is one of a stated few that something else runs (test_printed_output.py). On the chapters' pages each is followed by its output,
as scripts/book/outputs.py writes it."""
import pathlib
import re

import pytest

from nlmech_tree import BUILD, SOURCE, chapters, program, run, text_of
from printed import blocks_of, differs_from

PAGES = ["README.md", "CONTRIBUTING.md", *(f"chapters/{chapter}/{chapter}.md" for chapter in chapters())]
each_page = pytest.mark.parametrize("page", PAGES, ids=[pathlib.Path(page).stem for page in PAGES])
EXAMPLE = re.compile(r"\\snippet (?:chapters/(\w+)/example|examples/(\w+))\.cpp example")


def commands_of(page):
    """Of all ```sh blocks: block, line of the page, command. A backslash at the end continues a command on the next line."""
    for block in blocks_of(page):
        if block.language == "sh":
            for match in re.finditer(r"^(?!#)(?:.*\\\n)*.+", "\n".join(block.lines), re.MULTILINE):
                yield block, block.line + 1 + match.string.count("\n", 0, match.start()), match[0]


def program_of(command):
    """The program of the build that a command calls; empty if it calls none."""
    match = re.search(r"\bbuild/bin/([a-z0-9_]+)", command)
    return match[1] if match else ""


def output_below(page, line):
    """The block of output two lines below."""
    for block in blocks_of(text_of(page)):
        if block.line == line + 2 and block.language == "text":
            return block
    raise AssertionError(f"{page}:{line}: no ```text block with the output stands below")


def expect_printed(page, line, output):
    printed = output_below(page, line)
    assert differs_from(output, printed.lines) == "", f"{page}:{printed.line}: scripts/book/outputs.py"


@each_page
def test_commands_end_with_zero_and_stand_with_their_output(page, folder):
    (folder / "build").symlink_to(BUILD)
    (folder / "chapters").symlink_to(SOURCE / "chapters")
    calls = [call for call in commands_of(text_of(page)) if program_of(call[2])]
    assert calls or page == "CONTRIBUTING.md"
    for block, line, command in calls:
        if page == "README.md" and not program(program_of(command)).exists():
            continue  # it refers to all chapters; a build may have fewer
        done = run("sh", "-c", command, cwd=folder, code=None)
        assert done.returncode == 0, f"{page}:{line}: {command}\n{done.stderr}"
        if page.startswith("chapters/") and done.stdout:
            assert sum(other is block for other, _, _ in calls) == 1, f"{page}:{line}: one command a block, with its output below"
            expect_printed(page, block.end, done.stdout)


@each_page
def test_examples_stand_with_their_output(page):
    """The program of a chapter, and those of examples/, where a page shows their code."""
    for line, text in enumerate(text_of(page).splitlines(), 1):
        if match := EXAMPLE.fullmatch(text):
            example = program(f"{match[1]}_example" if match[1] else match[2])
            output_below(page, line)
            if example.exists():  # else it needs components of another chapter
                expect_printed(page, line, run(example).stdout)
