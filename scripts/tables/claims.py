"""tables/CLAIMS.md: what the sources claim in prose, and the evidence for or against it. Only claims are judged here: a claim
holds if a number lies in a range."""
import dataclasses
import math
import re

from guide import chapter_page
from lists import NOT_BUILT, NUMBER, Refused, read_quantities, read_rows
from markdown import nominal, table

HEADER = ["source", "place", "chapter", "claim", "scene", "quantity", "means", "verdict", "reading"]
HOLDS, FAILS, NOT_STATED = VERDICTS = ["holds", "does not hold", "not stated"]
RANGE = re.compile(rf"at least (?P<least>{NUMBER})|at most (?P<most>{NUMBER})|(?P<low>{NUMBER}) to (?P<high>{NUMBER})")
PRINTED, RATIOS = "REPRODUCTION", "RATIOS"  # evidence that is no scene: pages beside this one
INTRODUCTION = """# Claims in prose

Claims in the text of the sources that a computation can decide, one per row, reworded. The claim *holds* if the quantity of the \
named scene lies in the claimed range; it is *not stated* if the text omits what is needed to decide. Formulas have the misprints of \
[the errata](ERRATA.md) corrected unless a row says otherwise. Numbers in tables are judged one \
by one in [Published beside reproduced](REPRODUCTION.md). Written by `make check` from `tables/claims.csv`.

"""


@dataclasses.dataclass
class Claim:
    """A row of tables/claims.csv, which tables/published/README.md explains, and its evidence."""
    source: str
    place: str
    chapter: str  # that has the evidence
    text: str
    scene: str  # of that chapter, PRINTED or RATIOS
    quantity: str  # of that scene, or "table-4.4/HHT-1/RMS error"
    means: str  # claimed range: "at least 2", "at most 1e-7", "0.9 to 1.1"
    expected: str
    reading: str
    value: float = math.nan
    range: str = ""  # in place of the value, where rounding decides which number of it is found
    verdict: str = NOT_BUILT
    fails: bool = False


def parse_range(words):
    if match := RANGE.fullmatch(words):
        low, high = float(match["least"] or match["low"] or "-inf"), float(match["most"] or match["high"] or "inf")
        if low <= high:
            return low, high
    raise Refused(f"{words!r} is not of the form 'at least 2', 'at most 2' or '1 to 2'")


def within(words, value):
    """Is the value what the words say? Never for NaN."""
    low, high = parse_range(words)
    return low <= value <= high


def checked_claim(where, cells):
    claim = Claim(*cells)
    judged = claim.expected != NOT_STATED
    for wrong, what in ((claim.expected not in VERDICTS, f"{claim.expected!r} is no verdict on a claim"),
                        (not claim.text, "no claim"),
                        (judged and not (claim.scene and claim.quantity), "a verdict without evidence"),
                        (judged != bool(claim.means), "what a claim means for its quantity: of each that is judged"),
                        (not judged and not claim.reading, "not stated, and not said what is left out")):
        if wrong:
            raise Refused(f"{where}: {what}")
    try:
        if judged:
            parse_range(claim.means)
    except Refused as refused:
        raise Refused(f"{where}: {refused}") from refused
    return claim


def read_claims(file):
    return [checked_claim(where, cells) for where, cells in read_rows(file, len(HEADER), HEADER)]


def find_evidence(claim, values, source, out):
    """Sets the claim's value and range, where they are found."""
    if claim.scene == PRINTED:  # by the text as it stands, where that says enough
        for value in values:
            reproduced = value.inferred if value.nominal is None else value.nominal
            if value.name == f"{claim.source}/{claim.quantity}" and reproduced is not None:
                claim.value, claim.range = reproduced, nominal(value) if value.range_by_rounding() else ""
        return
    file = source / "tables/ratios.json" if claim.scene == RATIOS else out / f"results/{claim.chapter}/{claim.scene}.json"
    for quantity in read_quantities(file):
        number = quantity.get("value")
        if quantity.get("name") == claim.quantity and isinstance(number, (int, float)) and not isinstance(number, bool):
            claim.value = float(number)


def assess(claim, values, source, out):
    find_evidence(claim, values, source, out)
    claim.verdict = (NOT_STATED if claim.expected == NOT_STATED
                     else HOLDS if within(claim.means, claim.value) else FAILS)
    claim.fails = claim.verdict != claim.expected or (bool(claim.quantity) and math.isnan(claim.value))


def failure(claim):
    found = "no such quantity" if math.isnan(claim.value) else claim.verdict
    return (f"FAILS {claim.source} {claim.place}, {claim.scene}: {claim.quantity} = {claim.value:.6g}, {found}; "
            f"expected: {claim.expected}")


def collect(places, values, source, out, chapters):
    """All claims; those of the chapters are judged."""
    file = source / "tables/claims.csv"
    claims = read_claims(file)
    for claim in claims:
        if all(place.chapter != claim.chapter for place in places):
            raise Refused(f"{file}: no chapter {claim.chapter!r} in places.csv")
        if claim.chapter in chapters:
            assess(claim, values, source, out)
    return claims


def evidence(claim):
    """Where it can be read, as a link from the folder tables."""
    page = f"{claim.scene}.md" if claim.scene in (PRINTED, RATIOS) else f"{chapter_page(claim.chapter)}#{claim.scene}"
    link = f"[{claim.scene}]({page})" if claim.scene else ""
    return f"{link}: {claim.quantity}" if link and claim.quantity else link


def page(claims):
    """Counts, then a table a source, in the order of the list."""
    sources = dict.fromkeys(claim.source for claim in claims)
    text = INTRODUCTION + table(["source", *VERDICTS], [
        [source, *(sum((claim.source, claim.expected) == (source, verdict) for claim in claims) for verdict in VERDICTS)]
        for source in sources])
    for source in sources:
        text += f"\n## Claims of {source}\n\n" + table(
            ["place", "chapter", "claim", "evidence", "value", "claimed", "verdict", "reading"],
            [[c.place, c.chapter, c.text, evidence(c), c.range or ("" if math.isnan(c.value) else c.value), c.means, c.verdict,
              c.reading] for c in claims if c.source == source])
    return text
