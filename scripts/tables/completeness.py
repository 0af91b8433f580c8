"""tables/COMPLETENESS.md: the scene of each figure and table of the sources, with its curves and checks, and the state of the
future work that the sources name."""
import re

from guide import chapter_page
from lists import Refused, read_quantities, read_rows
from markdown import table

# Gnuplot gives every curve a group of its own, named by the terminal of style.gp; one without a stroke or a mark shows nothing.
CURVE = re.compile(r'id="nlmech_plot_1.*?<(?:path|use|polygon|image)', re.DOTALL)
INTRODUCTION = """# What is shown

Every figure and table of the sources is a scene: redrawn, with quantities that are checked against independent values each time. \
*Complete* means that there are curves or rows, at least one such quantity, and that all pass. The CMES paper prints the numbers of \
Tables 4.2, 4.4 and 4.6 without the rows of MCPI: they are counted for both sources and judged in [Published beside \
reproduced](REPRODUCTION.md) once. Written by `make check`.

"""
FUTURE = """
## Future work of the sources

What the sources name as possible or to be done. The list is `tables/future_work.csv`.

"""
FUTURE_HEADER = ["source", "place", "item", "chapter", "scene", "state", "reason"]


def rows_of(file):
    """Rows of a CSV file without its header; none if there is no such file."""
    return len(read_rows(file)) if file.exists() else 0


class Shown:
    """A figure or table of a source, and what its chapter left on disk for it. What is missing is not an error: it is not complete."""

    def __init__(self, place, out, built, values):
        self.place, self.built = place, built
        self.drawn, self.numbers, self.checked, self.passed = True, 0, 0, 0
        # A paper that repeats another source's table has no method that came later.
        self.published = sum(value.place in place.scenes and (value.source == place.source or not value.row.startswith("MCPI"))
                             for value in values if value.chapter == place.chapter)
        for scene in place.scenes:
            self.add_scene(out, f"{place.chapter}/{scene}")

    def add_scene(self, out, scene):
        figure, picture = self.place.kind == "figure", out / f"figures/{scene}.svg"
        numbers = rows_of(out / f"{'results' if figure else 'tables'}/{scene}.csv")
        quantities = read_quantities(out / f"results/{scene}.json")
        self.numbers += numbers
        self.checked += len(quantities)
        self.passed += sum(quantity.get("passes", False) for quantity in quantities)
        curves = not figure or (picture.exists() and CURVE.search(picture.read_text(encoding="utf-8")))
        self.drawn = self.drawn and numbers > 0 and bool(curves)

    def lacks(self):
        """Why it is not complete; empty if it is, or its chapter is not built."""
        if not self.built:
            return ""
        return ("nothing is drawn" if not self.drawn else "nothing is checked" if not self.checked
                else "a check fails" if self.passed < self.checked else "")

    def state(self):
        return "INCOMPLETE" if self.lacks() else "complete" if self.built else "not built"

    def links(self):
        if not self.built or not self.drawn:
            return self.place.name
        text = ", ".join(f"[{scene}]({chapter_page(self.place.chapter)}#{scene})" for scene in self.place.scenes)
        return text if self.place.scenes[0] == self.place.name else f"{self.place.name}: {text}"


def collect(places, values, out, chapters):
    return [Shown(place, out, place.chapter in chapters, values) for place in places if place.kind in ("figure", "table", "algorithm")]


def read_future(source, out, chapters):
    """Rows of tables/future_work.csv with links. A scene of a chapter that is built has to be there."""
    rows = []
    for where, (name, place, item, chapter, scene, state, reason) in read_rows(source / "tables/future_work.csv", len(FUTURE_HEADER),
                                                                              FUTURE_HEADER):
        for wrong, what in ((state not in ("done", "in part", "not done"), f"{state!r} is no state"),
                            ((state == "done") != (not reason), "a reason for all that is not done, and for nothing else"),
                            (state == "done" and not scene, "done, and no scene"),
                            (scene and chapter in chapters and not (out / f"results/{chapter}/{scene}.json").exists(),
                             f"no scene {scene!r} of {chapter}")):
            if wrong:
                raise Refused(f"{where}: {what}")
        rows.append([name, place, item, chapter, f"[{scene}]({chapter_page(chapter)}#{scene})" if scene else "", state, reason])
    return rows


def page(shown, future):
    """Counts by source, one row a figure or table, and the future work."""
    sources = {source: [s for s in shown if s.place.source == source] for source in sorted({s.place.source for s in shown})}
    totals = [[source, sum(s.place.kind == "figure" for s in group), sum(s.place.kind == "table" for s in group),
               sum(s.checked for s in group), sum(s.state() == "INCOMPLETE" for s in group)] for source, group in sources.items()]
    text = INTRODUCTION + table(["source", "figures", "tables", "quantities checked", "incomplete"], totals)
    for source, group in sources.items():
        text += f"\n## Figures and tables of {source}\n\n" + table(
            ["scene", "chapter", "subject", "rows of data", "checks that pass", "numbers printed", "state"],
            [[s.links(), s.place.chapter, s.place.subject, s.numbers, s.passed, s.published, s.state()] for s in group])
    return text + FUTURE + table(FUTURE_HEADER, future)
