"""The library's components, in the API reference and on the component map.

A component has a sentence in docs/components.txt, lines "name: sentence", and a worked example in docs/examples.txt, lines
"name: source marker". Who stands on whom was written by the configuration:

  components.txt    lines "ivp: support series collocation algebraic"
  chapter_uses.txt  lines "rbf_ivp: scene comparison ivp problems peers"
"""
import re

from book import Complaint


def reference_to(book, name):
    r"""What \ref calls a component's page: most are a namespace; those of namespace nlmech itself are shown as their folder of
    headers."""
    folder = book.source / "common/nlmech" / name
    opening = re.compile(rf"^namespace nlmech::{name}( |\{{|$)", re.MULTILINE)
    for header in [*folder.glob("*.hpp"), *folder.glob("*/*.hpp")]:
        if opening.search(header.read_text(encoding="utf-8")):
            return f"nlmech::{name}"
    return f"common/nlmech/{name}"


def example_text(book, example):
    """A worked example, "source marker", as lines of a comment for Doxygen."""
    source = example.split()[0]
    book.copy(book.source / source, f"sources/{source}")
    return (f'///\n/// Out of <a href="sources/{source}">{source}</a>, which the tests compile and run:\n'
            f"/// \\snippet {example}\n")


def api_comments(book):
    """The comments by which Doxygen knows the components. Only those with headers in this tree, because Doxygen rejects comments
    about namespaces that it does not find."""
    sentences = dict(book.entries(book.source / "docs/components.txt"))
    examples = dict(book.entries(book.source / "docs/examples.txt"))
    folders = sorted(path.name for path in (book.source / "common/nlmech").iterdir() if path.is_dir())
    for list_name, names in (("components", sentences), ("examples", examples)):
        for folder in folders:
            if folder not in names:
                book.complain(f"docs/{list_name}.txt", 1, f"has no line for the component '{folder}'")
    text = "/// \\namespace nlmech\n/// The library: everything that a program uses.\n"
    for name, sentence in sentences.items():
        if name not in folders:
            continue
        example = example_text(book, examples[name]) if name in examples else ""
        reference = reference_to(book, name)
        text += f"\n/// \\dir common/nlmech/{name}\n/// {sentence}\n"
        if "::" in reference:
            text += f"\n/// \\namespace {reference}\n/// {sentence}\n"
        text += example
    return text


def short_name(book, chapter):
    """A chapter's name in docs/chapters.txt, else its folder's."""
    names = dict(book.entries(book.source / "docs/chapters.txt"))
    return names.get(chapter) or chapter.replace("_", " ").capitalize()


def read_uses(book, file):
    """Names and what each uses, in the file's order; a name that comes twice uses both."""
    uses = {}
    for name, used in book.entries(file):
        known = uses.setdefault(name, [])
        known += [other for other in used.split() if other not in known]
    return uses


def floors_of(uses):
    """Components by floor, the ground first: each is one above the highest that it uses. Those that use each other in a circle,
    or one that is not listed, would have no floor: this is an error."""
    floors, built = [], set()
    while left := [name for name in uses if name not in built]:
        floor = [name for name in left if built.issuperset(uses[name])]
        if not floor:
            raise Complaint(f"no floor for {', '.join(left)}: they use each other, or what is not listed")
        floors.append(floor)
        built.update(floor)
    return floors


def box(link, uses):
    """A link that fills the box, and the components that it uses."""
    words = f'<span class="uses">{", ".join(uses)}</span>' if uses else ""
    return f"<li>{link} {words}</li>"


def map_of_the_house(book):
    """Chapters on top, the components below, each on the lowest floor above all that it uses: one line of HTML."""
    uses = read_uses(book, book.build / "components.txt")
    all_of_chapters = read_uses(book, book.build / "chapter_uses.txt")
    of_chapters = {chapter: all_of_chapters.get(chapter, []) for chapter in book.chapters}
    # Components that every chapter uses are listed once instead of in each box.
    first = next(iter(of_chapters.values()), [])
    common = [name for name in first if all(name in used for used in of_chapters.values())]
    boxes = [box(f'\\ref chapter_{chapter} "{short_name(book, chapter)}"', [name for name in used if name not in common])
             for chapter, used in of_chapters.items()]
    text = f'<ul class="floor chapter-floor">{"".join(boxes)}</ul>'
    for floor in reversed(floors_of(uses)):
        boxes = [box(f'\\ref {reference_to(book, name)} "{name}"', uses[name]) for name in floor]
        text += f'<ul class="floor">{"".join(boxes)}</ul>'
    note = "Each box names what it stands on."
    if common:
        note += f' Every chapter also stands on <span class="common">{", ".join(common)}</span>.'
    return f'<div class="map">{text}<div class="note">{note}</div></div>'
