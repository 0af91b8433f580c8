"""tables/ERRATA.md and tables/<chapter>/errata.md: misprints and refuted claims of the sources, each with the test that proves it."""
import dataclasses
import re

from guide import chapter_page, section_link, section_mark, source_title
from lists import Refused, read_rows
from markdown import table

PAGE = "errata"
HEADER = ["id", "source", "place", "kind", "printed", "correct", "effect", "scan", "test", "misses", "within"]
KINDS = ["formula", "number", "setting", "wording", "refuted"]
COLUMNS = ["place", "printed", "correct", "printed misses by", "corrected within", "effect"]
INTRODUCTION = """# Errata of the sources

{} misprints, and {} claims that are refuted. A test evaluates each printed form and its correction beside an oracle that uses neither: a closed form, another program \
in more digits, another set of equations, or, where the question is which setting a table belongs to, the other numbers that it \
prints. It fails if the printed form comes closer than ten times the tolerance, or the correction does not come within it. Both \
distances are listed, relative to the oracle or to the scale that the test names; `nan` marks a printed form that cannot be evaluated. \
The {} entries without numbers are errors of wording without a computation. A refuted claim is not a misprint: it is judged in [Claims in \
prose](CLAIMS.md), and the result found instead is listed here. The sources at hand are scanned text: where scanning may have made the \
misprint, the entry says so. Written by `make check` from `tables/errata`.

"""


@dataclasses.dataclass
class Erratum:
    """A misprint or a refuted claim: the columns of tables/errata/<chapter>.csv, which its README explains."""
    chapter: str  # name of the file
    id: str  # "geodesy-2.45"
    source: str
    place: str
    kind: str
    printed: str  # in the syntax of the pages; of a refuted claim, its text in tables/claims.csv
    correct: str
    effect: str
    scan: str
    tests: list  # "unit_frames:Errata.BeamColumn"; none for wording
    misses: str  # how far the printed form is from the oracle, as the test reports
    within: str  # how close to it the test holds the corrected form


def checked_erratum(where, chapter, cells):
    entry = Erratum(chapter, *cells)
    test, entry.tests = entry.tests, entry.tests.split()
    computed = entry.kind != "wording"
    for wrong, what in (
            (not entry.id.startswith(f"{chapter}-"), f"{entry.id!r} does not begin with '{chapter}-'"),
            (entry.kind not in KINDS, f"{entry.kind!r} is no kind of entry"),
            (entry.scan not in ("no", "perhaps"), f"{entry.scan!r} is neither no nor perhaps"),
            (computed != bool(entry.tests), f"{entry.id}: a test for all but wording"),
            (not all(re.match(r"[^:]*:[^.]*\.", name) for name in entry.tests), f"{test!r} is not of the form program:Suite.Name"),
            (not computed == bool(entry.misses) == bool(entry.within), f"{entry.id}: misses and within for all but wording")):
        if wrong:
            raise Refused(f"{where}: {what}")
    return entry


def read_errata(source):
    """All entries of tables/errata/*.csv, files in alphabetical order. Each id begins with its file's name: one file cannot repeat
    an id of another."""
    errata, ids = [], set()
    for file in sorted((source / "tables/errata").glob("*.csv")):
        for where, cells in read_rows(file, len(HEADER), HEADER):
            errata.append(checked_erratum(where, file.stem, cells))
            if errata[-1].id in ids:
                raise Refused(f"{where}: {errata[-1].id!r} is there twice")
            ids.add(errata[-1].id)
    return errata


def cells(entry):
    """"no" is not worth a word."""
    scan = "perhaps an error of the scan" if entry.scan == "perhaps" else ""
    refuted = "a claim, refuted" if entry.kind == "refuted" else ""
    effect = "; ".join(text for text in (refuted, entry.effect, scan) if text)
    return [entry.place, entry.printed, entry.correct, entry.misses, entry.within, effect]


def chapter_table(errata, chapter):
    """For the chapter's own page: without links and tests."""
    return table(COLUMNS, [cells(entry) for entry in errata if entry.chapter == chapter])


def linked_table(entries, guide):
    return table([*COLUMNS, "test"], [
        [guide.link_words(e.chapter, e.source, e.place), *cells(e)[1:], " ".join(map(guide.test_link, e.tests))] for e in entries])


def page(errata, guide):
    r"""Counts by chapter and kind, which are its contents, then a section a chapter. Formulas of a page, \f$x\f$, are written as forges
    show them: $`x`$. The book turns them back."""
    chapters = guide.by_chapter(errata)
    contents = table(["chapter", "formulas", "numbers", "settings", "wording", "refuted claims"], [
        [section_link(PAGE, chapter, guide.title(chapter)), *(sum(e.kind == kind for e in entries) for kind in KINDS)]
        for chapter, entries in chapters.items()])
    refuted = sum(e.kind == "refuted" for e in errata)
    text = INTRODUCTION.format(len(errata) - refuted, refuted, sum(not e.tests for e in errata)) + contents
    for chapter, entries in chapters.items():
        text += (f"\n{section_mark(PAGE, chapter)}\n## {guide.title(chapter)}\n\n{source_title(entries[0].source)}. What they change, "
                 f"[the chapter]({chapter_page(chapter)}) shows.\n\n{linked_table(entries, guide)}")
    return re.sub(r"\\f\$(.*?)\\f\$", r"$`\1`$", text)
