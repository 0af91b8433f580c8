"""Input of the pages of evidence: the lists of tables/, and the files that the chapters' checks wrote under OUT. An error in a list
is reported with file, line and value. Whether a number agrees with a printed one is decided by `CHAPTER check` alone: its
results/<chapter>/check.csv has the verdict."""
import csv
import dataclasses
import json
import os
import re

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
BY_ROUNDING = re.compile(rf"{NUMBER}\.\.{NUMBER} by rounding")
NOT_BUILT = "not built"


class Refused(Exception):
    """What is wrong with a list, with its file and line."""


def read_rows(file, columns=None, header=None):
    """The rows below the first: of each "FILE: line N" and its cells. Blank lines count for nothing.
    @param columns how many cells a row must have, where that is known
    @param header the first row, where it must be this one"""
    rows, line = [], 1
    try:
        with open(file, encoding="utf-8", newline="") as text:
            reader = csv.reader(text, strict=True)
            for cells in reader:
                if len(cells) > 1 or "".join(cells).strip():
                    rows.append((f"{file}: line {line}", cells))
                line = reader.line_num + 1
    except csv.Error as error:
        raise Refused(f"{file}: line {line}: {'a quote is never closed' if 'end of data' in str(error) else error}") from error
    except UnicodeDecodeError as error:
        raise Refused(f"{file}: is not UTF-8 text") from error
    if header and (not rows or rows[0][1] != header):
        raise Refused(f"{file}: has another header than expected")
    for where, cells in rows[1:]:
        if columns and len(cells) != columns:
            raise Refused(f"{where}: {len(cells)} of {columns} cells")
    return rows[1:]


def read_json(file):
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise Refused(f"{file}: is not JSON") from error


def read_quantities(file):
    """What a scene or a measurement left in its JSON file; none without a file."""
    return read_json(file).get("quantities", []) if file.exists() else []


def write(file, text):
    """By renaming: a file is whole, or as it was."""
    file.parent.mkdir(parents=True, exist_ok=True)
    new = file.with_name(file.name + ".new")
    new.write_text(text, encoding="utf-8")
    os.replace(new, file)


@dataclasses.dataclass
class Place:
    """A figure, table, claim or equation of a source: a row of tables/places.csv."""
    source: str
    name: str  # "fig-2.23"
    chapter: str  # that owns it
    kind: str
    subject: str
    scenes: list  # that show it: the one of its own name, if none is named

    def __post_init__(self):
        self.scenes = self.scenes.split() or [self.name]


def read_places(source):
    return [Place(*cells) for _, cells in read_rows(source / "tables/places.csv", 6)]


@dataclasses.dataclass
class Value:
    """A printed number, a row of tables/published/<source>.csv, with what its chapter's check says of it."""
    source: str
    place: str
    row: str
    quantity: str
    printed: str
    unit: str
    kind: str
    found: str  # by the text as it stands, when the list was made: "2.4e-11"
    found_inferred: str
    expected: str  # verdict
    tolerance: str
    because: str
    tried: str
    explains: str
    erratum: str
    reading: str
    chapter: str = ""
    nominal: float = None
    inferred: float = None
    verdict: str = NOT_BUILT
    fails: bool = False
    setting: str = ""  # of the runs behind both numbers

    @property
    def name(self):
        return f"{self.source}/{self.place}/{self.row}/{self.quantity}"

    def range_by_rounding(self):
        """"0.03..1e5 by rounding": rounding decides which number of the range is found, and pages show the range; else empty."""
        match = BY_ROUNDING.match(self.found)
        return match[0] if match else ""


def read_values(source, places):
    """All printed numbers, with the chapters that own them; their verdict is "not built"."""
    owners = {(place.source, place.name): place.chapter for place in reversed(places)}
    values = []
    for file in sorted((source / "tables/published").glob("*.csv")):
        for _, cells in read_rows(file, 15):
            value = Value(file.stem, *cells)
            if (value.source, value.place) not in owners:
                raise Refused(f"tables/places.csv does not list {value.place} of {value.source}")
            value.chapter = owners[value.source, value.place]
            values.append(value)
    return values


def add_verdicts(values, out, chapters):
    """What the checks of these chapters left under `out`."""
    checks = {}
    for chapter in chapters:
        rows = read_rows(out / f"results/{chapter}/check.csv", 6)
        checks[chapter] = {cells[0]: (where, *cells[1:]) for where, cells in rows}
    for value in values:
        if value.chapter not in checks:
            continue
        if value.name not in checks[value.chapter]:
            raise Refused(f"results/{value.chapter}/check.csv does not list {value.name}")
        where, nominal, inferred, value.verdict, passes, value.setting = checks[value.chapter][value.name]
        try:
            value.nominal, value.inferred = (float(cell) if cell else None for cell in (nominal, inferred))
        except ValueError as error:
            raise Refused(f"{where}: {error}") from error
        value.fails = passes != "1"
