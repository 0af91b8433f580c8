"""A page of the book: Markdown that reads well by itself, made ready for Doxygen. What is replaced:

  {{geodesy/fig-2.27: max latitude error | 3}}    a number of results/geodesy/fig-2.27.json
  {{ratios: table-4.2, RK4-1 (P/10), reproduced | 2}}   a number of tables/ratios.json
  [@elgohary2015, Eq. 2.45]                       a citation
  ![caption](../../figures/geodesy/fig-2.27.svg)  on lines of its own: the figure; after the path, optionally: "alternative text",
                                                  if the texts in the picture do not describe it
  [caption](../../tables/geodesy/table-2.6.md)    on lines of its own: the table; a long one is folded away in chapters
  [Fig. 2.27](../../figures/geodesy/fig-2.27.svg) within a sentence: a link to the figure in the book; so for
                                                  tables, pages, headers; any other file is copied
  [Fig. 2.27](../geodesy/geodesy.md#fig-2.27)     a link to what the chapter's page shows of that scene
  <a id="x"></a>, <details>, $`x`$                as forges show them: a mark to link to, what is folded away, a formula
  {{chapters}}, {{map}}, {{references}}  on a line of its own: the chapters; the map of chapters and components; the
                                                  works cited on this page

Line numbers are kept, from the end of each paragraph at the latest, so that Doxygen's warnings point into the source. Code, in
fences or backticks, stays as it is.
"""
import html
import os
import re

import components
import pictures
import references
from book import Complaint
from quantities import quantity_text

FENCE = re.compile(r"[ \t]*(```|~~~)")
OPEN = re.compile(r"\{\{[^{}]*$|\[@[^]]*$|^!\[.*[^)]$|^!?\[[^]]*$")  # a mark, citation or caption that continues in the next line
FIGURE = re.compile(r'!\[(.*)\]\(([^() ]+)(?: +"([^"]*)")?\)[ \t]*')
FIGURE_PARAGRAPH = re.compile(r'!\[[^\0]*\]\([^() ]+(?:\s+"[^"]*")?\)\s*')
ROUNDING = "depends on rounding"  # behind the path of a table: forge.py
TABLE = re.compile(r'\[([^]]*)\]\(([^() ]*tables/[^/() ]+/[^/() ]+\.md)(?: +"(' + ROUNDING + r'(?:: [^"]+)?)")?\)[ \t]*')
SNIPPET = re.compile(r"[@\\]snippet(?:\{[^}]*\})?[ \t]+([^ \t]+)(.*)")
FOLD = re.compile(r"(?:<details>|<summary>.*</summary>|</details>)")
SECTION = re.compile(r'<a id="(\w+)"></a>')
MARK = re.compile(r"\$`[^`]*`\$|`[^`]*`|\{\{[^{}]*\}\}|\[@[^]]*\]|\]\([^()#@: ][^():@ ]*\)")  # code first: it stays as it is
QUANTITY = re.compile(r"\{\{([\w.-]+(?:/[\w.-]+)?): *([^|]*[^| ]) *(?:\| *(.*))?\}\}", re.ASCII)
CITATION = re.compile(r"\[@([A-Za-z0-9_-]+)(?:, *(.*))?\]")
LIST_MARK = re.compile(r"^([0-9]+)([.)])(?=\s|$)")
MOST_ROWS = 16  # of a published table or of errata that a chapter shows unfolded
MOST_RUNS = 6  # of any other, so that the conclusion stays close to the picture
LEAST_FIGURES = 3  # one after another that stand side by side
WIDE = ("reproduction", "completeness", "claims", "errata")  # pages whose tables need the list of sections' width
WORKS_CITED = "@BOOK_WORKS_CITED@"  # placeholder until the whole page is read


def advice(path):
    """The command that writes a missing file."""
    if re.fullmatch(r"tables/([^/]+/errata|REPRODUCTION|COMPLETENESS|CLAIMS|ERRATA)\.md", path):
        return "; `make check` writes it"
    scene = re.fullmatch(r"(?:figures|tables)/([^/]+)/([^/]+)\.[a-z]+", path)
    return f"; `{scene[1]} run {scene[2]}` writes it" if scene else ""


def chapter_of(path):
    """The chapter of a page, its source or what forges show of it; None if it is no chapter's."""
    match = re.fullmatch(r"(?:chapters/(\w+)/\1|docs/chapters/(\w+))\.md", path)
    return match and (match[1] or match[2])


def anchor(path):
    """figures/geodesy/fig-2.27.svg -> figures_geodesy_fig_2_27, the name that links use."""
    return re.sub("[^A-Za-z0-9_]", "_", re.sub(r"\.[a-z]+$", "", path))


def plain_text(caption):
    """A caption as the alternative text of the picture: without links, formulas and emphasis."""
    text = re.sub(r'[@\\]ref [^ ]+ "([^"]*)"', r"\1", caption)
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\\f[][$]|[*`]|<[^<>]*>", "", text.replace("<sup>", "^"))
    return escaped(html.unescape(text).replace("\u00a0", " "))


def escaped(text):
    """As the value of an attribute of HTML."""
    return html.escape(text, quote=False).replace('"', "&quot;")


def in_formula(text):
    r"""Is the end of the text inside \f$ \f$ or \f[ \f]?"""
    return text.count("\\f$") % 2 == 1 or text.count("\\f[") > text.count("\\f]")


def is_blank(line):
    return line.strip(" \t") == ""


def groups_of_figures(lines):
    """First line of the first figure and of the last one of all groups of figures that stand side by side: those that follow each other
    with nothing between. Lines count from 1."""
    groups, group, paragraph = {}, [], []
    for number, line in enumerate([*lines, "", "end"], 1):
        if not is_blank(line):
            paragraph.append((number, line))
            if number <= len(lines):
                continue
        if not paragraph:
            continue
        if FIGURE_PARAGRAPH.fullmatch("\n".join(text for _, text in paragraph)):
            group.append(paragraph[0][0])
        else:
            if len(group) >= LEAST_FIGURES:
                groups[group[0]] = group[-1]
            group = []
        paragraph = []
    return groups


def summary_of(page):
    """The first paragraph under the title of a finished page; the start page shows it below the chapter's name."""
    text = re.sub(r"^# .*\n(\\.*\n)?", "", page, count=1)
    return text.strip().partition("\n\n")[0].replace("\n", " ")


class Page:
    """The page while it is made."""

    def __init__(self, book, source, label):
        self.book, self.source, self.label = book, source, label
        self.lines = book.text(book.source / source).split("\n")
        self.groups = groups_of_figures(self.lines)
        self.number = 0  # of lines that were read
        self.made = []
        self.owed = ""  # line breaks that joined lines had, given back at the end of the paragraph
        self.cited = set()

    def text(self):
        """The page for Doxygen."""
        in_fence = titled = False
        while self.number < len(self.lines):
            line = self.next_line()
            if FENCE.match(line):
                in_fence = not in_fence
            elif in_fence:
                pass
            elif not titled and line.startswith("# "):
                titled = True
                line = self.title(line)
            elif is_blank(line):
                line += self.owed
                self.owed = ""
            else:
                line = self.paragraph_line(line)
            self.made.append(line + "\n")
        if not titled:
            self.book.complain(self.source, 1, "the page has no title (a line that begins with '# ')")
        page = "".join(self.made)
        self.book.summaries[self.source] = summary_of(page)
        return page.replace(WORKS_CITED, references.list_works(self.book, self.cited))

    def next_line(self):
        self.number += 1
        return self.lines[self.number - 1]

    def next_is(self, blank):
        """Is there a next line, and is it blank, or not?"""
        return self.number < len(self.lines) and is_blank(self.lines[self.number]) == blank

    def title(self, line):
        """With the page's label. The list of sections replaces the blank line under it."""
        line = re.sub(r"[ \t]*\{#[^}]*\}[ \t]*$", "", line) + f" {{#{self.label}}}"
        if self.label == "mainpage" or not self.next_is(blank=True):
            return line
        self.next_line()
        if self.label in WIDE:
            return line + "\n\\htmlonly[block]<style>html { --content-maxwidth: 1500px; }</style>\\endhtmlonly"
        return line + "\n\\tableofcontents"

    def paragraph_line(self, line):
        """The replacement of a line of text, joined with the next ones as long as a mark is open."""
        first = self.number
        while OPEN.search(line) and self.next_is(blank=False):
            line += " " + self.next_line().strip(" \t")
            self.owed += "\n"
        try:
            return self.list_or_picture(line, first) or self.inline(line, first)
        except Complaint as complaint:
            self.book.complain(self.source, first, complaint)
            return line

    def list_or_picture(self, line, number):
        """The replacement of a line that consists of a list, a figure or a table; else None."""
        mark = line.rstrip(" \t")
        if mark == "{{chapters}}":
            return self.list_of_chapters()
        if mark == "{{map}}":
            return components.map_of_the_house(self.book)
        if mark == "{{references}}":
            return WORKS_CITED
        if match := FIGURE.fullmatch(line):
            return self.grouped(self.picture(self.inline(match[1], number), match[2], False, match[3]), number)
        if match := TABLE.fullmatch(line):
            return self.picture(self.inline(match[1], number), match[2], True, match[3])
        if FOLD.fullmatch(mark):
            return f"\\htmlonly[block]{mark}\\endhtmlonly"
        if match := SECTION.fullmatch(mark):
            return f"\\anchor {match[1]}"
        if match := SNIPPET.match(line):
            return self.snippet(match[1], match[2].strip(), line)
        return None

    def snippet(self, path, _marker, line):
        """Code of a source, which Doxygen cuts out. It looks for a path below each of its folders first, and then for the name alone,
        which more than one file may have."""
        self.book.reads(self.book.source / path)
        folder = path.partition("/")[0] + "/"
        return line.replace(folder, "", 1) if folder in ("chapters/", "common/") else line

    def list_of_chapters(self):
        items = ""
        for chapter in self.book.chapters:
            summary = self.book.summaries.get(f"chapters/{chapter}/{chapter}.md", "")
            items += f"<li>\\subpage chapter_{chapter} <br/>{summary}</li>"
        return f'<ul class="chapters">{items}</ul>'

    def resolved(self, path):
        """A path written on the page: relative to the top of the project, and the file that it names."""
        path = os.path.normpath(os.path.join(os.path.dirname(self.source), path))
        generated = re.match("(figures|tables)/[^/]+/", path)
        return path, (self.book.out if generated else self.book.source) / path

    def grouped(self, figure, number):
        """A figure with the start or the end of a group of figures side by side, if it is the first or the last of one."""
        if number in self.groups:
            figure = f'\\htmlonly[block]<div class="plates">\\endhtmlonly {figure}'
        return figure + (" \\htmlonly[block]</div>\\endhtmlonly" if number in self.groups.values() else "")

    def picture(self, caption, path, is_table, given=None):
        r"""A figure or a table. \htmlonly around the frame, so that the caption itself is Doxygen's: formulas and links work in
        it. (\image of Doxygen 1.9.4 takes no formula in a caption, and puts the pictures of all chapters under their bare names
        into one folder.)"""
        path, file = self.resolved(path)
        if not file.exists():
            raise Complaint(f"there is no {path}{advice(path)}")
        self.book.shown.add(path)
        if is_table:
            rows = self.book.text(file).count("\n|") - 1  # without heading and rule
            most = MOST_ROWS if file.name.startswith(("table-", "errata")) else MOST_RUNS
            if self.source.startswith("chapters/") and rows > most:
                return self.folded_table(caption, path, file, rows)
            before, after = '<div class="table-caption">', "</div>"
        else:
            self.book.copy(file, path)
            svg = self.book.text(file)
            size = pictures.size_of(svg)
            size = f' width="{size[0]}" height="{size[1]}"' if size else ""
            image = f'<a href="{path}"><img src="{path}" alt="{self.alternative(svg, given, caption, path)}"{size}/></a>'
            before, after = f'<figure class="plate">{image}<figcaption>', "</figcaption></figure>"
            if "<script" in svg:  # its curves show their names if it is opened by itself
                after = f'<a class="curves" href="{path}">All curves by name</a>{after}'
        text = (f"\\anchor {anchor(path)} \\htmlonly[block]{before}\\endhtmlonly {caption} "
                f"\\htmlonly[block]{after}\\endhtmlonly")
        return text + self.included(path, file) if is_table else text

    def alternative(self, svg, given, caption, path):
        """The alternative text of a picture."""
        text = pictures.alternative(svg, given, html.unescape(plain_text(caption)))
        if not text:
            raise Complaint(f"neither {path} nor the page says in {pictures.LEAST_WORDS} words what is seen: ![caption](path \"what is seen\")")
        return escaped(text)

    def folded_table(self, caption, path, file, rows):
        r"""A long table behind its caption. Put in whole: \include takes all of its line."""
        return (f'\\htmlonly[block]<details class="table"><summary>\\endhtmlonly \\anchor {anchor(path)} {caption} '
                f"({rows} rows) \\htmlonly[block]</summary>\\endhtmlonly \n\n{self.book.text(file)}\n"
                "\\htmlonly[block]</details>\\endhtmlonly")

    def included(self, path, file):
        """A table's text. Doxygen looks for formulas before it includes: a table that has some is put in whole, and the lines
        of the page after it are counted from there."""
        table = self.book.text(file)
        return f" \n\n{table}" if "\\f$" in table else f" \\include{{doc}} {path}"

    def inline(self, line, number):
        """A line with its numbers, citations and links replaced. An error message for each that cannot be replaced."""
        def replaced(mark):
            try:
                return self.replacement(mark[0], "".join(self.made) + line[:mark.start()])
            except Complaint as complaint:
                self.book.complain(self.source, number, complaint)
                return mark[0]

        if "{{" in MARK.sub("", line):
            self.book.complain(self.source, number, "{{ without }} in the same paragraph")
        filled = MARK.sub(replaced, line)
        return LIST_MARK.sub(r"\1\\\2", filled) if line.startswith("{{") else filled  # a number and a full stop are no list

    def replacement(self, mark, before):
        """The text for one mark {{...}}, citation [@...] or end of a link ](...). `before` is the page up to there."""
        if mark.startswith("{{"):
            match = QUANTITY.fullmatch(mark)
            if not match:
                raise Complaint(f"{mark} is not of the form {{{{chapter/scene: quantity | digits}}}}")
            return self.quantity(*match.groups(), in_formula(before))
        if mark.startswith("[@"):
            match = CITATION.fullmatch(mark)
            if not match:
                raise Complaint(f"{mark} is not of the form [@work] or [@work, place]")
            self.cited.add(match[1])
            return self.citation(*match.groups())
        if mark.startswith("]("):
            path, _, part = mark[2:-1].partition("#")
            return f"]({self.target(path, part)})"
        return self.formula(mark) if mark.startswith("$") else self.code(mark)

    def quantity(self, scene, name, options, in_tex):
        return quantity_text(self.book, scene, name, options, in_tex)

    def citation(self, key, place):
        return references.cite(self.book, key, place)

    @staticmethod
    def formula(mark):
        """$`x`$, as forges write it."""
        return f"\\f${mark[2:-2]}\\f$"

    @staticmethod
    def code(mark):
        """Doxygen would end it at an apostrophe."""
        return f"`{mark}`" if "'" in mark else mark

    def target(self, path, part=""):
        """Where a link to a file of the project leads in the book: to a page, to a figure or table on its page, to what a
        chapter's page shows of the scene that the part of a link names, to a header's reference; any other file travels with the book. So does a figure that no chapter shows, if a page that comes after
        the chapters links to it."""
        path, file = self.resolved(path)
        if (chapter := chapter_of(path)) and part:
            return f"#{self.scene_anchor(chapter, part)}"
        if chapter:
            path = f"chapters/{chapter}/{chapter}.md"
        if path in self.book.labels:
            return f"@ref {self.book.labels[path]}"
        may_be_shown = path in self.book.shown or self.source.startswith("chapters/")
        if may_be_shown and re.fullmatch(r"(figures|tables)/[^/]+/[^/]+\.(svg|md)", path):
            return f"#{anchor(path)}"
        if not file.is_file():
            raise Complaint(f"the link to {path} leads to no file")
        if re.fullmatch(r"common/nlmech/([a-z_]+/)+[a-z_0-9]+\.hpp", path):
            return f"@ref {path.removeprefix('common/')}"
        self.book.copy(file, f"sources/{path}")
        return f"sources/{path}"

    def scene_anchor(self, chapter, scene):
        """Where a chapter's page, made before, shows a scene: its figure, else its table."""
        for shown in (f"figures/{chapter}/{scene}.svg", f"tables/{chapter}/{scene}.md"):
            if shown in self.book.shown:
                return anchor(shown)
        raise Complaint(f"the page of {chapter} does not show {scene}")
