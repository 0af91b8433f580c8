"""The bibliography: reads docs/references.bib, which is BibTeX in a plain dialect, so that no TeX is needed:
one field a line,  name = {value},  ; authors "Last, F. M. and Last, F."; accents as UTF-8, no TeX commands."""
import dataclasses
import re

from book import Complaint


@dataclasses.dataclass
class Work:
    short: str  # "Turner &amp; Elgohary"
    year: str  # 2014b, if the key ends so
    text: str  # the full entry, one line of Markdown
    order: str  # by which the works are sorted
    linked: bool  # has a DOI, a URL or an ISBN


def fields_of(entry):
    """The values of an entry by their names, without braces."""
    found = re.findall(r"^[ \t]*(\w+)[ \t]*=[ \t]*\{(.*)\}[ \t]*,?[ \t]*$", entry, re.MULTILINE)
    return {name: re.sub("[{}]", "", value).replace("--", "–") for name, value in found if value}


def short_authors(authors):
    """"Turner, J. D. and Elgohary, T. A." as "Turner &amp; Elgohary"; the first of three and more."""
    names = [person.partition(",")[0] for person in authors.split(" and ")]
    if len(names) == 2:
        return f"{names[0]} &amp; {names[1]}"
    return names[0] if len(names) == 1 else f"{names[0]} et al."


def appeared(field):
    """Everything behind the title: where it appeared, volume, pages, links."""
    parts = [field[name] for name in ("journal", "booktitle", "school", "publisher", "howpublished") if name in field]
    if "volume" in field:
        parts.append(field["volume"] + (f"({field['number']})" if "number" in field else ""))
    if "pages" in field:
        parts.append(field["pages"])
    text = f" {', '.join(parts)}." if parts else ""
    if "note" in field:
        text += f" {field['note']}."
    if "isbn" in field:
        text += f" ISBN {field['isbn']}."
    if "doi" in field:
        text += f' <a href="https://doi.org/{field["doi"]}">doi:{field["doi"]}</a>'
    elif "url" in field:
        text += f' <a href="{field["url"]}">{re.sub("^https?://", "", field["url"])}</a>'
    return text


def read_work(entry):
    """The key of an entry and its work."""
    head = re.match(r"@[a-zA-Z]+\{([A-Za-z0-9_-]+),[ \t]*\n", entry)
    if not head:
        raise Complaint(f"cannot read the entry that begins with: {entry[:40]}")
    key, field = head[1], fields_of(entry)
    if not all(field.get(name) for name in ("author", "title", "year")):
        raise Complaint(f"'{key}' lacks author, title or year, each on one line")
    if "doi" in field and not re.fullmatch(r"10\.[0-9]+/[^ ]+", field["doi"]):
        raise Complaint(f"'{key}' has an invalid DOI: {field['doi']}")
    author, year = field["author"], field["year"]
    if letter := re.search("[0-9]([a-z])$", key):  # elgohary2014b
        year += letter[1]
    return key, Work(
        short=short_authors(author),
        year=year,
        text=f"{author.replace(' and ', ', ')} ({year}). *{field['title']}*.{appeared(field)}",
        order=f"{author.lower()}!{year}!{key}",  # '!' sorts before every letter, so that "Roy" comes before "Royer"
        linked=any(field.get(name) for name in ("doi", "url", "isbn")))


def load(book, file):
    """Reads all works; reports an error for each entry that cannot be used."""
    line = 1
    for entry in re.split("^(?=@)", book.text(file), flags=re.MULTILINE):
        try:
            if entry.startswith("@"):  # and not the words above the first
                key, work = read_work(entry)
                book.works[key] = work
        except Complaint as complaint:
            book.complain(file.relative_to(book.source), line, complaint)
        line += entry.count("\n")


def cited(book, key, place):
    """"Elgohary (2015, Eq. 2.45)\""""
    if key not in book.works:
        raise Complaint(f"docs/references.bib has no work '{key}'")
    work = book.works[key]
    return f"{work.short} ({work.year}, {place})" if place else f"{work.short} ({work.year})"


def cite(book, key, place):
    """The same, linked to the bibliography."""
    return f'\\ref work_{key} "{cited(book, key, place)}"'


def sorted_keys(book, keys):
    """By authors, then years."""
    return [key for key, _ in sorted(book.works.items(), key=lambda item: item[1].order) if key in keys]


def list_works(book, keys, anchors=False):
    """Works as HTML on one line, so that Doxygen's line numbers stay those of the page."""
    works = [(f"\\anchor work_{key} " if anchors else "") + book.works[key].text for key in sorted_keys(book, keys)]
    return f"<ul>{''.join(f'<li>{work}</li>' for work in works)}</ul>"
