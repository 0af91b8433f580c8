"""Where the pages of evidence lead: sources and chapters as readers know them, links to pages, scenes and tests."""
import re

SOURCES = {
    "cmes": "T. A. Elgohary, L. Dong, J. L. Junkins and S. N. Atluri, CMES 100(3) (2014)",
    "elgohary": "T. A. Elgohary, dissertation, Texas A&M University (2015)",
    "filipich-rosales": "C. P. Filipich and M. B. Rosales, A straightforward approach to solve ordinary nonlinear differential systems",
    "laier": "J. E. Laier, High-order algorithm for non-linear dynamics",
    "roy": "D. Roy, A multi-step transversal linearization method in nonlinear dynamics"}
TEST = re.compile(r"\nTEST(?:_F|_P)?\((\w+),\s*(\w+)\)")
PLACE_IN_WORDS = re.compile(r"(Table|Figure|Fig\.) (\w+(?:\.\w+)?)((?:,| ).*)?")


def source_title(source):
    return SOURCES.get(source, source)


def chapter_page(chapter):
    """The chapter's page as forges show it, as a page in tables/ links to it. The book leads to its own."""
    return f"../docs/chapters/{chapter}.md"


def section_link(page, chapter, text):
    return f"[{text}](#{page}_{chapter})"


def section_mark(page, chapter):
    """The line to which section_link() leads."""
    return f'<a id="{page}_{chapter}"></a>'


def in_words(name):
    """The name of a test as a sentence, which a narrow column may break: "Table2_6_TheSign" is "Table 2.6 the sign"."""
    text = re.sub(r"(?<=\d)_(?=\d)", ".", name).replace("_", " ")
    text = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|(?<=[a-z])(?=\d)", " ", text)
    return text[:1] + re.sub(r"[A-Z](?=[a-z])|(?<=[a-z] )A(?= [A-Z])", lambda letter: letter[0].lower(), text[1:])


class Guide:
    """Names and links of the pages in tables/."""

    def __init__(self, source, places):
        self.places = {(place.chapter, place.source, place.name): place for place in reversed(places)}
        self.order = list(dict.fromkeys(place.chapter for place in places))
        names = (source / "docs/chapters.txt").read_text(encoding="utf-8")
        self.titles = dict(re.findall(r"^(?!#)(.*?): (.*)$", names, re.MULTILINE))
        self.tests = {}  # files by "Suite.Name"
        for file in sorted((source / "tests").rglob("*.cpp")):
            for suite, name in TEST.findall(file.read_text(encoding="utf-8")):
                self.tests.setdefault(f"{suite}.{name}", []).append(file.relative_to(source))

    def title(self, chapter):
        """"Limit points" for homotopy."""
        return self.titles.get(chapter, chapter)

    def by_chapter(self, entries):
        """The entries of each chapter, in the order of the sources."""
        chapters = {chapter: [] for chapter in [*self.order, *sorted({entry.chapter for entry in entries})]}
        for entry in entries:
            chapters[entry.chapter].append(entry)
        return {chapter: group for chapter, group in chapters.items() if group}

    def link(self, chapter, source, place, text):
        """To the chapter's page; to what it shows for a place of the source, if that is a figure or a table."""
        known = self.places.get((chapter, source, place))
        scene = f"#{known.scenes[0]}" if known and known.kind in ("figure", "table") else ""
        return f"[{text}]({chapter_page(chapter)}{scene})"

    def link_words(self, chapter, source, words):
        """The same for a place in the words of a list of misprints: "Table 2.6, C3" is of table-2.6. Words that are no place of
        the source are no link."""
        match = PLACE_IN_WORDS.fullmatch(words)
        place = match and f"{'table' if match[1] == 'Table' else 'fig'}-{match[2]}"
        if (chapter, source, place) not in self.places:
            return words
        return self.link(chapter, source, place, f"{match[1]} {match[2]}") + (match[3] or "")

    def test_link(self, test):
        """"unit_frames:Errata.BeamColumn" as "Beam column", linked to the file that holds the test; as code where there is none.
        Several programs may have a test of one name: unit_frames is made of the folder "frames"."""
        program, _, name = test.partition(":")
        files = self.tests.get(name)
        if not files:
            return f"`{test}`"
        folder = program.partition("_")[2]
        file = next((file for file in files if folder in file.parts), files[0])
        return f"[{in_words(name.partition('.')[2])}](../{file.as_posix()})"
