"""What the tests of the page maker share: a small book of one scene, with what its page may name."""
import references
from book import Book
from nlmech_tree import write
from pages import Page

PAGE = "chapters/geodesy/geodesy.md"
JSON = "results/geodesy/fig-2.27.json"
QUANTITIES = """{"quantities":[
  {"name":"max error","value":2.417e-11,"unit":"deg"}, {"name":"acceleration","value":9.80665,"unit":"m/s^2"},
  {"name":"twelve","value":12}, {"name":"empty","value":""}, {"name":"infinite","value":Infinity}, {"name":"twice","value":1}, {"name":"twice","value":2}, {"name":"nothing","value":null}]}"""
RATIOS = """{"quantities":[
  {"name":"table-4.4, RK4-1 (0.1; 0.5), reproduced","value":0.0216,"unit":"1"},
  {"name":"table-4.4, RK4-1 (0.1; 0.5), verdict","value":"does not hold","unit":""}]}"""
WORKS = """% Words above the first
@book{one2001,
  author = {One, A. and Two, B.},
  title = {T},
  year = {2001},
  isbn = {1-23},
}
@misc{old1900,
  author = {Old, C.},
  title = {U},
  year = {1900},
  doi = {10.1/x},
}
@misc{lost1800,
  author = {Lost, D.},
  title = {V},
  year = {1800},
}
"""
def label(x, y, text, more="", size=14, anchor="middle"):
    """A text as gnuplot writes it."""
    return (f'<g transform="translate({x},{y}){more}" stroke="none" fill="ink" font-size="{size}.00"  text-anchor="{anchor}">\n'
            f"\t\t<text>{text}</text>\n\t</g>\n")


PICTURE = ('<svg \n width="760" height="520"\n>' + label(380, 30, '<tspan font-weight="bold" >Errors "fall" &lt; 1</tspan>', size=15)
           + label(74, 400, '<tspan >10</tspan><tspan font-size="11.2" dy="-7.00px">−9</tspan><tspan font-size="14.0" dy="7.00"></tspan>',
                   anchor="end")
           + label(74, 90, "<tspan >1</tspan>", anchor="end") + label(90, 485, "<tspan >0</tspan>") + label(700, 485, "<tspan >500</tspan>")
           + label(20, 270, "<tspan >error</tspan>", " rotate(270)") + label(400, 516, "<tspan >time (s)</tspan>")
           + label(300, 60, '<tspan >x</tspan><tspan  font-size="11.2" dy="4.20px">1</tspan><tspan font-size="14.0" dy="-4.20px"> a</tspan>',
                   anchor="start"))
SEEN = 'Errors "fall" < 1. Vertical axis: error, 10^−9 to 1. Horizontal axis: time (s), 0 to 500. Shown: x1 a.'
ALT = SEEN.replace('"', "&quot;").replace("<", "&lt;")
MAP = (r'<div class="map"><ul class="floor chapter-floor">'
       r'<li>\ref chapter_one "First" <span class="uses">high</span></li>'
       r'<li>\ref chapter_two_three "Two three" </li></ul>'
       r'<ul class="floor"><li>\ref nlmech::high "high" <span class="uses">low, ground</span></li></ul>'
       r'<ul class="floor"><li>\ref common/nlmech/low "low" <span class="uses">ground</span></li></ul>'
       r'<ul class="floor"><li>\ref common/nlmech/ground "ground" </li></ul>'
       r'<div class="note">Each box names what it stands on. '
       r'Every chapter also stands on <span class="common">ground</span>.</div></div>')


class SmallBook(Book):
    """In a folder that is empty."""

    def __init__(self, top):
        super().__init__(top / "source", top / "build", top / "out", top / "book", [])
        for file, text in ((f"out/{JSON}", QUANTITIES),
                           ("out/figures/geodesy/fig-2.27.svg", PICTURE + "</svg>"),
                           ("out/figures/geodesy/fig-9.svg", "<svg/>"),
                           ("out/figures/geodesy/fig-10.svg", PICTURE + "</svg>"),
                           ("out/figures/geodesy/error-vs-time.svg", PICTURE + "<script/></svg>"),
                           ("out/tables/geodesy/table-2.6.md", "| a |\n| --- |\n"),
                           ("out/tables/geodesy/table-2.7.md", "| \\f$a\\f$ |\n| --- |\n"),
                           ("source/docs/references.bib", WORKS),
                           ("source/docs/glossary.md", "# Words\n"),
                           ("source/tables/ratios.json", RATIOS),
                           ("source/tables/a.csv", "a\n"),
                           ("source/common/nlmech/geodesy/a.hpp", "")):
            write(top / file, text)
        references.load(self, self.source / "docs/references.bib")
        self.labels["docs/glossary.md"] = "glossary"

    def made(self, body, source=PAGE, label="chapter_geodesy"):
        """The page of this text under a title, without the title's two lines."""
        write(self.source / source, f"# Title: more\n\n{body}\n")
        self.complaints.clear()
        text = Page(self, source, label).text()
        return text.replace(f"# Title: more {{#{label}}}\n\\tableofcontents\n", "").strip()

    def expect_page(self, body, wanted):
        assert self.made(body) == wanted
        assert self.complaints == []

    def expect_complaint(self, body, wanted):
        self.made(body)
        assert self.complaints == [f"{PAGE}:{wanted}"]
