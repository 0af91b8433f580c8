"""The index of the book's search, html/search_index.js: the text of its pages by sections, and the names that Doxygen knows. A script
instead of data, because a page opened from the file system may read nothing else. docs/search.js searches it."""
import ast
import html
import html.parser
import json
import re

CONTENTS = re.compile(r'<div class="contents">(.*)</div><!-- contents -->', re.DOTALL)
LIST_OF_SECTIONS = re.compile(r'<div class="toc">.*?</div>', re.DOTALL)
TITLE = re.compile(r'<div class="title">(.*?)</div>', re.DOTALL)
HEADING = re.compile(r"<h([23])>(?!<a )")  # without an anchor
FORMULA = re.compile(r"\\\(.*?\\\)|\\\[.*?\\\]", re.DOTALL)
SILENT = ("script", "style")
APART = ("p", "li", "td", "th", "tr", "div", "br", "h1", "h2", "h3", "figcaption")  # words before and after are two


class Sections(html.parser.HTMLParser):
    """The text of a page's contents, in sections that start at headings: [place, heading, text, text of tables]."""

    def __init__(self):
        super().__init__()
        self.found = [["", "", "", ""]]
        self.silent = self.tables = 0
        self.in_heading = False

    def handle_starttag(self, tag, attributes):
        if tag in ("h1", "h2", "h3"):
            self.found.append(["", "", "", ""])
            self.in_heading = True
        place = dict(attributes).get("id")
        if self.in_heading and place:
            self.found[-1][0] = place
        self.silent += tag in SILENT
        self.tables += tag == "table"
        self.part(tag)

    def handle_endtag(self, tag):
        if tag in ("h1", "h2", "h3"):
            self.in_heading = False
        self.silent -= tag in SILENT
        self.tables -= tag == "table"
        self.part(tag)

    def part(self, tag):
        if tag in APART:
            self.handle_data(" ")

    def handle_data(self, data):
        if not self.silent:
            self.found[-1][1 if self.in_heading else 3 if self.tables else 2] += data


def one_line(text):
    return " ".join(FORMULA.sub(" ", text).split())


def with_places(page):
    """The page, each of whose headings can be linked to."""
    numbers = iter(range(1, 10**6))
    return HEADING.sub(lambda heading: f'<h{heading[1]} id="section_{next(numbers)}">', page)


def sections_of(page):
    """Place, heading, text and text of tables of each section that has any."""
    contents = CONTENTS.search(page)
    parser = Sections()
    parser.feed(LIST_OF_SECTIONS.sub("", contents[1]) if contents else "")
    parser.close()
    return [(place, *map(one_line, words)) for place, *words in parser.found if one_line("".join(words))]


def title_of(page):
    title = TITLE.search(page)
    return one_line(html.unescape(re.sub("<[^>]*>", "", title[1]))) if title else ""


def names_in(script, pages):
    """Name, address and scope of all that a script of Doxygen's search lists, but for pages and their sections."""
    found = []
    for _, entry in ast.literal_eval(script[script.index("["):script.rindex("]") + 1]):
        for address, _, scope in entry[1:]:
            address, scope = address.removeprefix("../"), html.unescape(scope)
            if address.partition("#")[0] not in pages:
                qualified = re.sub(r"\(.*", "", scope).rpartition("::")[0]
                found.append((html.unescape(entry[0]), address, qualified))
    return found


def write_index(folder, pages):
    """Of the pages, names of files of the book's folder of HTML, which then have a place at every heading."""
    sections, names = [], []
    for name in pages:
        page = with_places((folder / name).read_text(encoding="utf-8"))
        (folder / name).write_text(page, encoding="utf-8")
        title = title_of(page)
        sections += [(f"{name}#{place}" if place else name, title, *words) for place, *words in sections_of(page)]
    for script in sorted((folder / "search").glob("all_*.js")):
        names += names_in(script.read_text(encoding="utf-8"), pages)
    index = {"sections": sections, "names": list(dict.fromkeys(names))}
    text = json.dumps(index, ensure_ascii=False, separators=(",", ":"))
    (folder / "search_index.js").write_text(f"window.book_index = {text};\n", encoding="utf-8")
