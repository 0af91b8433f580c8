"""python3 scripts/book SOURCE BUILD OUT VERSION CHAPTER...: makes the book, BUILD/book/html/index.html.

SOURCE is the source tree, OUT the folder with the generated figures/, tables/, results/; the chapters are in reading order.
Steps: look for the tools; turn the pages into what Doxygen reads; run Doxygen, where any warning is a failure; copy what the
pages need from MathJax; write the index of the search. All errors are shown, each with its file and line, before it stops with exit code 1."""
import pathlib
import re
import shutil
import subprocess
import sys

import components
import references
import search
from book import Book
from pages import Page, advice

SHARE = (pathlib.Path("/usr/share"), pathlib.Path("/usr/local/share"))
SCRIPT_OF_MATHJAX = re.compile(rb'<script[^>]*src="mathjax/MathJax.js"></script>\n')


def find_tools():
    """Doxygen's program and the folders of its style sheet and of MathJax. An error message names all missing packages."""
    def folder(name, file):
        return next((share / name for share in SHARE if (share / name / file).exists()), None)

    tools = {"doxygen": shutil.which("doxygen"),
             "doxygen-awesome-css": folder("doxygen-awesome-css", "doxygen-awesome.css"),
             "libjs-mathjax": folder("javascript/mathjax", "jax/output/SVG/fonts/TeX/fontdata.js")}
    missing = [package for package, found in tools.items() if not found]
    if missing:
        sys.exit(f"The book needs Debian packages that are not installed: apt install {' '.join(missing)}")
    return tools.values()


def label_pages(book):
    """The pages' labels by source. Those of evidence come after the chapters, because they link to figures that these show; the
    start page comes last, because it shows the first paragraphs of the others."""
    book.labels = {"docs/glossary.md": "glossary", "docs/architecture.md": "architecture"}
    book.labels |= {f"chapters/{chapter}/{chapter}.md": f"chapter_{chapter}" for chapter in book.chapters}
    book.labels |= {source: "choosing" for source in book.choosing()}
    for name in ("reproduction", "completeness", "claims", "errata", "bench", "ratios", "randomised"):
        book.labels[f"tables/{name.upper()}.md"] = name
    book.labels["docs/index.md"] = "mainpage"


def make_pages(book):
    references.load(book, book.source / "docs/references.bib")
    label_pages(book)
    for source, label in book.labels.items():
        if (book.source / source).exists():
            book.write(f"pages/{source}", Page(book, source, label).text())
        else:
            book.complain(source, 1, f"this page of the book does not exist{advice(source)}")
    works = references.list_works(book, book.works, anchors=True)
    book.write("pages/docs/references.md", f"# Bibliography {{#references}}\n\n{works}\n")
    book.write("pages/docs/components.dox", components.api_comments(book))
    if book.complaints:
        sys.exit(f"The book was not built. Errors in its pages, listed above: {len(book.complaints)}")


def chapter_tabs(book):
    """The chapters for the sidebar, behind how to choose a method, as tabs of Doxygen's layout file."""
    names = {chapter: components.short_name(book, chapter).replace("&", "&amp;") for chapter in book.chapters}
    tabs = ['      <tab type="user" url="@ref choosing" title="Choosing a method"/>' for _ in book.choosing()]
    tabs += [f'      <tab type="user" url="@ref chapter_{chapter}" title="{name}"/>' for chapter, name in names.items()]
    return "\n".join(tabs)


def run_doxygen(book, doxygen, awesome, version):
    values = {"SOURCE_DIR": book.source, "OUT": book.out, "FOLDER": book.folder, "VERSION": version, "AWESOME": awesome,
              "CHAPTER_TABS": chapter_tabs(book)}
    for template, name in (("layout.xml", "layout.xml"), ("Doxyfile.in", "Doxyfile")):
        text = (book.source / "docs" / template).read_text(encoding="utf-8")
        book.write(name, re.sub("@BOOK_([A-Z_]+)@", lambda mark: str(values[mark[1]]), text))
    result = subprocess.run([doxygen, book.folder / "Doxyfile"], cwd=book.source, stdout=subprocess.DEVNULL).returncode
    log = book.folder / "warnings.txt"
    warnings = log.read_text(encoding="utf-8") if log.exists() else ""
    if result != 0 or warnings:  # with paths of the source tree
        print(warnings.replace(f"{book.folder}/pages/", "").replace(f"{book.source}/", ""), file=sys.stderr)
        sys.exit(f"The book was not built. Doxygen's warnings, listed above, count as errors ({result}).")
    start = book.folder / "html/index.html"
    start.write_bytes(start.read_bytes().replace(b"<title>nlmech - nlmech</title>", b"<title>nlmech</title>"))


def copy_mathjax(mathjax, target):
    """Only what TeX input and SVG output load. No web fonts: some browsers refuse them to local pages."""
    def copy(name, *left_out):
        shutil.copytree(mathjax / name, target / name, ignore=shutil.ignore_patterns(*left_out))

    copy("jax/input/TeX")
    copy("jax/element/mml")
    copy("jax/output/SVG", "fonts")
    copy("jax/output/SVG/fonts/TeX")
    copy("extensions/TeX", "mhchem*")
    for name in ("MathJax.js", *(f"extensions/{script}.js" for script in ("tex2jax", "MathEvents", "AssistiveMML", "toMathML"))):
        shutil.copyfile(mathjax / name, target / name)


def main(source, build, out, version, *chapters):
    source, build, out = (pathlib.Path(folder).absolute() for folder in (source, build, out))
    book = Book(source, build, out, build / "book", chapters)
    doxygen, awesome, mathjax = find_tools()
    (book.folder / "book.stamp").unlink(missing_ok=True)  # after a failure there is no finished book
    for name in ("html", "pages"):
        shutil.rmtree(book.folder / name, ignore_errors=True)
        (book.folder / name).mkdir(parents=True)
    make_pages(book)
    run_doxygen(book, doxygen, awesome, version)
    copy_mathjax(mathjax, book.folder / "html/mathjax")
    search.write_index(book.folder / "html", [f"{'index' if label == 'mainpage' else label}.html" for label in book.labels.values()]
                       + ["references.html"])
    for page in (book.folder / "html").glob("*.html"):
        text = page.read_bytes()
        if b"\\(" not in text and b"\\[" not in text:  # without formulas, as most of the API reference: need not wait for it
            page.write_bytes(SCRIPT_OF_MATHJAX.sub(b"", text))
    # What the book was made from, for the next build.
    files = [str(file).replace(" ", "\\ ") for file in (book.folder / "book.stamp", *book.files_read)]
    (book.folder / "book.d").write_text(f"{files[0]}: " + " \\\n  ".join(files[1:]) + "\n", encoding="utf-8")
    (book.folder / "book.stamp").touch()


if len(sys.argv) < 5:
    sys.exit(__doc__)
main(*sys.argv[1:])
