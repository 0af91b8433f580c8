"""The chapters' pages for GitHub and other forges, tracked as docs/chapters/<chapter>.md: the page maker of the book, writing Markdown.

  python3 scripts/book/forge.py write SOURCE OUT CHAPTER...   writes them, with the numbers and tables of OUT
  python3 scripts/book/forge.py check SOURCE OUT CHAPTER...   exit code 1 if one is not what it would write, line by line

A page shows the few of its figures that are kept in docs/gallery (`make gallery` draws them, a test compares them with their scenes) and
names the command for the others; likewise for long tables and tables of run times. Tables of the sources are shown without their run times. A table
whose numbers depend on rounding is marked by the chapter's page and left out, [caption](path "depends on rounding"), or loses the rows and columns that are named there,
[caption](path "depends on rounding: row; column"). Run times differ at each run, and rounding from machine to machine. So a check accepts any number for a result of a scene with run times; other results may differ by a factor of two, or
by any factor if both are below 1e-10, which is rounding. All other text is compared exactly.
"""
import pathlib
import re
import sys

import references
from book import Book, Complaint
from pages import ROUNDING, WORKS_CITED, Page, chapter_of, plain_text

# Around results, until the page is whole: those of scenes with run times, and all others. Private characters of Unicode.
TIMED, COMPUTED, END = "\ue000", "\ue001", "\ue002"
SPAN = re.compile(f"([{TIMED}{COMPUTED}])([^{END}]*){END}")
NUMBER = re.compile(r"(-?[0-9][0-9.]*(?:e[+-]?[0-9]+)?)(?:(?:&times;|\\times)10(?:<sup>|\^\{)(-?[0-9]+))?(.*)")
IN_TABLE = re.compile(r"(?<![\w.#-])-?[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?(?![\w.])")
IDENTIFIER = re.compile(r"(`[^`]*`|\[[^]]*\]\([^)]*\))|\bnlmech::\w+(?:::\w+)*")
LIST_MARK = re.compile(f"^([{TIMED}{COMPUTED}][0-9]+{END})([.)])(?=\\s|$)")
MOST_ROWS = 24
ADVICE = ("If you changed a result or a page: `make pages`, and review the difference. If not, the number depends on rounding: let its "
          'scene show the median of perturbed runs, or mark its table on the chapter\'s page, [caption](path "depends on rounding"), and print no such number.')
NOISE = 1e-10


def is_timed(book, scene):
    """Has the scene a column of run times? Their data, tables and figures differ from run to run."""
    files = [book.out / f"{folder}/{scene}.csv" for folder in ("results", "tables")]
    return any(re.search(r"(^|,)\"?time[_ ]", file.open(encoding="utf-8").readline()) for file in files if file.exists())


def run_times(rows):
    """Headings of the columns with run times, of a table of a source."""
    return [heading.strip() for heading in re.split(r"(?<!\\)\|", rows[0])[1:-1] if re.search(r"\btime\b", heading)]


def drawn_by(path):
    """figures/homotopy/fig-2.1.svg -> homotopy, fig-2.1"""
    _, chapter, file = path.split("/")
    return chapter, re.sub(r"\.[a-z]+$", "", file)


def without(rows, names, path):
    """The rows of a table without those columns and rows, which are named by their heading and their first cell."""
    cells = [re.split(r"(?<!\\)\|", row.strip())[1:-1] for row in rows]
    headings, firsts = ([cell.strip().replace("\\|", "|") for cell in line] for line in (cells[0], [row[0] for row in cells]))
    if unknown := set(names) - set(headings) - set(firsts):
        raise Complaint(f"{path} has no row or column {', '.join(sorted(unknown))}")
    return ["|" + "|".join(cell for cell, heading in zip(row, headings) if heading not in names) + "|"
            for row, first in zip(cells, firsts) if first not in names]


class ForgePage(Page):
    """The page while it is made."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.marked = set()  # scenes that can be linked to: where they are first shown

    def text(self):
        works = "\n".join(f'- <a id="work_{key}"></a>{self.book.works[key].text}'
                          for key in references.sorted_keys(self.book, self.find_cited()))
        page = super().text().replace(references.list_works(self.book, self.cited), works)
        return with_forge_formulas(page)

    def find_cited(self):
        return set(re.findall(r"\[@([A-Za-z0-9_-]+)", "\n".join(self.lines)))

    def title(self, line):
        name = pathlib.Path(self.source).name
        return (f"{line}\n\n*Written by `make pages` from [{name}](../../{self.source}) with the results of a run. A few of the "
                "figures are here, all of them in the book: `make book`.*")

    def list_or_picture(self, line, number):
        made = super().list_or_picture(line, number)
        return line if made and made.startswith(("\\htmlonly", "\\anchor ")) else made  # as forges write it already

    def grouped(self, figure, number):
        return figure

    def picture(self, caption, path, is_table, given=None):
        path, file = self.resolved(path)
        chapter, scene = drawn_by(path)
        if path.endswith("/errata.md"):
            return f"{caption} They stand with their tests [in the list of all](../../tables/ERRATA.md#errata_{chapter})."
        if not file.exists():
            raise Complaint(f"there is no {path}")
        mark = "" if scene in self.marked else f'<a id="{scene}"></a>'
        self.marked.add(scene)
        kept = self.book.source / f"docs/gallery/{chapter}-{scene}.svg"
        timed = is_timed(self.book, f"{chapter}/{scene}")
        if is_table and given != ROUNDING and (not timed or scene.startswith("table-")):
            rows = self.book.text(file).rstrip("\n").split("\n")
            if len(rows) <= MOST_ROWS + 2:
                left_out = given.removeprefix(f"{ROUNDING}: ").split("; ") if given else []
                what = ["what depends on rounding"] if given else []
                if timed:
                    left_out += run_times(rows)
                    what.append("run times")
                rows = without(rows, left_out, path)
                note = f"\n\n*Without {' and '.join(what)}; `{chapter} run {scene}` writes all.*" if what else ""
                table = "\n".join(rows[:2] + [IN_TABLE.sub(rf"{COMPUTED}\g<0>{END}", row) for row in rows[2:]])
                return f"{mark}{caption}\n\n{table}{note}"
        elif not is_table and kept.exists():
            svg = self.book.text(kept)
            alt = self.alternative(svg, given, SPAN.sub(r"\2", caption), path).replace("[", "(").replace("]", ")")
            return f"{mark}![{alt}](../gallery/{kept.name})\n\n{caption}"
        return f"> {mark}{caption} `{chapter} run {scene}` {'writes' if is_table else 'draws'} it."

    def snippet(self, path, marker, _line):
        parts = re.split(rf"^[ \t]*//[!/]? *\[{re.escape(marker)}\]\n", self.book.text(self.book.source / path), flags=re.MULTILINE)
        if len(parts) != 3:
            raise Complaint(f"{path} has no two lines // [{marker}]")
        lines = parts[1].rstrip().split("\n")
        indent = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
        return "\n".join(["```cpp", *(line[indent:] for line in lines), "```"])

    def quantity(self, scene, name, options, in_tex):
        kind = TIMED if is_timed(self.book, scene) else COMPUTED
        return kind + super().quantity(scene, name, options, in_tex) + END

    def citation(self, key, place):
        return f"[{references.cited(self.book, key, place)}](#work_{key})"

    formula = code = staticmethod(lambda mark: mark)

    def inline(self, line, number):
        """Names of the library, which Doxygen links, are code. A result with a full stop at the start of a line is no list."""
        line = IDENTIFIER.sub(lambda name: name[1] or f"`{name[0]}`", super().inline(line, number))
        return LIST_MARK.sub(r"\1\\\2", line)

    def target(self, path, part=""):
        path, file = self.resolved(path)
        if match := re.fullmatch(r"(?:figures|tables)/([^/]+)/([^/]+)\.(?:svg|md)", path):
            own = self.source == f"chapters/{match[1]}/{match[1]}.md"
            return f"{'' if own else match[1] + '.md'}#{match[2]}"
        part = part and "#" + part
        if chapter := chapter_of(path):
            return f"{chapter}.md{part}"
        if not file.exists():
            raise Complaint(f"the link to {path} leads to no file")
        return f"../../{path}{part}"


def with_forge_formulas(page):
    r"""\f$ \f$ and \f[ \f] in the form of GitHub and similar forges. A formula ends on the line on which it starts."""
    page = re.sub(r"\\f\$(.*?)\\f\$", lambda formula: f"$`{' '.join(formula[1].split())}`$", page, flags=re.DOTALL)
    return re.sub(r"^([ \t]*)\\f\[(.*?)\\f\]",
                  lambda formula: f"{formula[1]}```math\n{formula[1]}{formula[2].strip()}\n{formula[1]}```",
                  page, flags=re.DOTALL | re.MULTILINE)


def plain_number(text):
    """The number at the start of a result as a page shows it, and the text after it; None if it starts with text."""
    for shown, meant in (("&nbsp;", ""), ("&minus;", "-"), ("\u202f", ""), ("\\,", ""), (" ", "")):
        text = text.replace(shown, meant)
    match = NUMBER.fullmatch(text)
    return match and (float(match[1]) * 10.0 ** int(match[2] or 0), match[3].removeprefix("</sup>").removeprefix("}"))


def agree(made, kept):
    """Are two results the same but for rounding?"""
    a, b = plain_number(made), plain_number(kept)
    if a is None or b is None:
        return made == kept
    noise = max(abs(a[0]), abs(b[0])) < NOISE
    return a[1] == b[1] and (noise or a[0] == b[0] or (a[0] * b[0] > 0 and 0.5 <= a[0] / b[0] <= 2))


def without_marks(made):
    return SPAN.sub(r"\2", made)


def disagreement(made, kept):
    """How the tracked line differs from the generated one; results are compared with their tolerance. Empty if they agree."""
    parts = SPAN.split(made)  # text, kind, result, text, ...
    pattern = "(.*?)".join(re.escape(text) for text in parts[::3])
    match = re.fullmatch(pattern, kept)
    if not match:
        return f"the page has\n  {kept}\nand should have\n  {without_marks(made)}"
    pairs = [f"{found} on the page, {result} now" for kind, result, found in zip(parts[1::3], parts[2::3], match.groups())
             if kind == COMPUTED and not agree(result, found)]
    return "; ".join(pairs)


def differences(made, kept):
    """(line from 1, difference) for all lines that differ; only the first if the numbers of lines differ."""
    made, kept = made.split("\n"), kept.split("\n")
    found = [(number, words) for number, lines in enumerate(zip(made, kept), 1) if (words := disagreement(*lines))]
    if len(made) == len(kept):
        return found
    return found[:1] or [(min(len(made), len(kept)) + 1, f"{len(kept)} lines on the page, {len(made)} now")]


def main(command, source, out, *chapters):
    source, out = pathlib.Path(source).absolute(), pathlib.Path(out).absolute()
    book = Book(source, None, out, None, chapters)
    references.load(book, source / "docs/references.bib")
    stale = False
    for page in [f"chapters/{chapter}/{chapter}.md" for chapter in chapters] + book.choosing():
        name = pathlib.Path(page).stem
        made = ForgePage(book, page, name).text()
        file = source / f"docs/chapters/{name}.md"
        if command == "write":
            file.parent.mkdir(exist_ok=True)
            file.write_text(without_marks(made), encoding="utf-8")
        elif not file.exists():
            print(f"docs/chapters/{name}.md does not exist: make pages", file=sys.stderr)
            stale = True
        else:
            for line, words in differences(made, file.read_text(encoding="utf-8")):
                print(f"docs/chapters/{name}.md:{line}: {words}", file=sys.stderr)
                stale = True
    if stale:
        print(ADVICE, file=sys.stderr)
    if book.complaints or stale:
        sys.exit(1)


if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[1] not in ("write", "check"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
