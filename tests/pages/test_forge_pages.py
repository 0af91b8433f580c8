"""On a forge every link of a page leads to a file that is tracked, and to a part of it that exists."""
import os
import re

import pytest

from nlmech_tree import SOURCE, run, text_of

PAGES = sorted(["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "KNOWN_ISSUES.md", "docs/architecture.md", "docs/glossary.md", "docs/python.md",
                *(str(file.relative_to(SOURCE)) for folder in ("docs/chapters", "tables") for file in (SOURCE / folder).glob("*.md"))])
each_page = pytest.mark.parametrize("page", PAGES)


@pytest.fixture(scope="module")
def tracked():
    """What git tracks, folders included; empty where git knows nothing of the folder."""
    files = run("git", "ls-files", "--cached", "--others", "--exclude-standard", cwd=SOURCE, code=None).stdout.splitlines()
    return {"/".join(parts[:n]) for parts in (file.split("/") for file in files) for n in range(1, len(parts) + 1)}


def prose(page):
    """A page without its code."""
    text = re.sub(r"^.*```.*\n(?:.*\n)*?.*```.*\n", "", text_of(page), flags=re.MULTILINE)
    return re.sub("`[^`\n]*`", "", text)


def parts(page):
    """Where links to a part of the page can lead: its marks, and its headings as forges name them."""
    text = text_of(page)
    marks = re.findall('<a id="([^"]+)">', text)
    assert len(set(marks)) == len(marks), f"{page} has two marks of one name"
    headings = re.findall("^#+ (.+)", text, re.MULTILINE)
    return {*marks, *(re.sub(r"[^A-Za-z0-9_-]", "", heading.replace(" ", "-")).lower() for heading in headings)}


@each_page
def test_links_lead_to_what_is_there(page, tracked):
    wrong = []
    for path, part in re.findall(r"\]\(([^)#: ]*)(?:#([^) ]*))?\)", prose(page)):
        file = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        exists = (SOURCE / file).exists()
        if not exists or (tracked and file not in tracked):
            wrong.append(file)
        if exists and part and part not in parts(file):
            wrong.append(f"{file}#{part}")
    assert wrong == []


@each_page
def test_pages_are_markdown(page):
    """Nothing is left of what only the book understands."""
    text = prose(page)
    assert [words for words in ("{{", "[@", "\\f$", "\\f[", "\\snippet", "{#", "@ref") if words in text] == []
