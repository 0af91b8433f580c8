"""tables/REPRODUCTION.md: all printed numbers with the computed ones."""
from guide import chapter_page, section_link, section_mark, source_title
from markdown import nominal, number, table

PAGE = "reproduction"
VERDICTS = ["reproduced", "reproduced, inferred reading", "same rounding level", "better", "differs", "not stated", "holds",
            "does not hold", "context", "input", "not built"]
INTRODUCTION = """# What was reproduced

One row for every number that a source prints. *Nominal* is the result of the text taken literally, *inferred* that of a \
reading for which there is evidence, *within* the tolerance of the comparison: `digits` is one unit of the last printed digit. A range *by \
rounding* replaces a number that differs from machine to machine within this range. The verdicts are explained in the \
[glossary](../docs/glossary.md). Written by `make check`.

"""


def reading(value):
    """The setting of the run and the reading of the text, with its evidence."""
    text = "; ".join(part for part in (value.setting, value.reading) if part)
    return f"{text} ({value.tried} tried; explains {value.explains} rows)" if value.tried else text


def reading_and_reason(value):
    reason = f"tolerance: {value.because}" if value.because else ""
    return "; ".join(text for text in (reading(value), reason) if text)


def verdict(value):
    return f"{value.verdict} (FAILS: expected {value.expected})" if value.fails else value.verdict


def first_cells(value, guide):
    printed = value.printed if value.unit == "1" else f"{value.printed} {value.unit}"
    return [guide.link(value.chapter, value.source, value.place, value.place), value.row, value.quantity, printed]


def judged_table(values, guide):
    return table(["place", "row", "quantity", "published", "within", "nominal", "inferred", "verdict", "reading"],
                 [[*first_cells(v, guide), v.tolerance, nominal(v), "" if v.inferred is None else number(v.inferred, 4), verdict(v),
                   reading_and_reason(v)] for v in values])


def folded_table(values, guide):
    """Quoted values without verdict, in a folded section."""
    rows = table(["place", "row", "quantity", "published", "reading"], [[*first_cells(v, guide), reading(v)] for v in values])
    return (f"<details>\n<summary>For context, not judged: {len(values)} run times on machines that are not known</summary>\n\n"
            f"{rows}\n</details>\n")


def section(chapter, values, guide):
    """Where the numbers are from, what judges them again, and the numbers."""
    sources = "; ".join(map(source_title, dict.fromkeys(value.source for value in values)))
    context = [value for value in values if value.expected == "context"]
    judged = [value for value in values if value.expected != "context"]
    tables = ([judged_table(judged, guide)] if judged else []) + ([folded_table(context, guide)] if context else [])
    return (f"\n{section_mark(PAGE, chapter)}\n## {guide.title(chapter)}\n\n{sources}. Shown by [the chapter]({chapter_page(chapter)}). "
            f"Judged again by `build/bin/{chapter} check`, and each row by a test: those of a place with "
            f"`ctest --test-dir build -R '^{values[0].source}/{values[0].place}/'`.\n\n" + "\n".join(tables))


def page(values, guide):
    """Counts by chapter and verdict, which are its contents, then a section per chapter with one row per number. Contains no measured times."""
    chapters = guide.by_chapter(values)
    counts = [[section_link(PAGE, chapter, guide.title(chapter)), *(sum(v.verdict == verdict for v in group) for verdict in VERDICTS)]
              for chapter, group in chapters.items()]
    return (INTRODUCTION + table(["chapter", *VERDICTS], counts)
            + "".join(section(chapter, group, guide) for chapter, group in chapters.items()))
