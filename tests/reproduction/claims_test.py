"""Claims in prose: the one thing that scripts/tables judges."""
import math

import pytest
from conftest import CHECKED, PLACES, PUBLISHED

import claims
from lists import Refused

HEADER = ",".join(claims.HEADER) + "\n"


def test_words_are_ranges():
    for words, value, wanted in (("at least 2", 2, True), ("at least 2", 1.99, False), ("at most -1e-3", -0.001, True),
                                 ("at most -1e-3", 0, False), ("0.5 to 2", 0.5, True), ("0.5 to 2", 2.01, False),
                                 ("at least 2", math.nan, False), ("at most 2", math.nan, False), ("1 to 2", math.nan, False),
                                 ("at least 2", math.inf, True)):  # a method that overflows
        assert claims.within(words, value) == wanted, (words, value)


@pytest.mark.parametrize("words", ["", "2", "at least", "at least two", "2 to 1", "1 to", "about 2", "at most nan", "at least inf"])
def test_other_words_are_refused(words):
    with pytest.raises(Refused):
        claims.within(words, 1)


@pytest.mark.parametrize("row, wanted", [
    ("roy,1,moon,round,fig-1,radius,at least 2,holds,", None),
    ("roy,1,moon,round,,,,not stated,no radius", None),
    ("roy,1,moon,round,fig-1,radius,at least 2", "7 of 9 cells"),
    ("roy,1,moon,,fig-1,radius,at least 2,holds,", "no claim"),
    ("roy,1,moon,round,fig-1,radius,at least 2,better,", "'better' is no verdict on a claim"),
    ("roy,1,moon,round,fig-1,,at least 2,holds,", "a verdict without evidence"),
    ("roy,1,moon,round,fig-1,radius,,holds,", "what a claim means for its quantity: of each that is judged"),
    ("roy,1,moon,round,,,,not stated,", "not stated, and not said what is left out"),
    ("roy,1,moon,round,fig-1,radius,two,holds,", "'two' is not of the form 'at least 2', 'at most 2' or '1 to 2'")])
def test_rows_that_say_too_little_are_refused(folder, row, wanted):
    file = folder.put("claims.csv", HEADER + row + "\n")
    if wanted is None:
        claims.read_claims(file)
        return
    with pytest.raises(Refused) as refused:
        claims.read_claims(file)
    assert str(refused.value) == f"{file}: line 2: {wanted}"


@pytest.fixture
def judged(folder):
    """Judges rows in a folder with a chapter that is built, one that is not, and each kind of evidence."""
    folder.put("tables/places.csv", f"{PLACES}roy,table-1,moon,table,tides,\nroy,table-2,sun,table,heat,\n")
    folder.put("tables/published/roy.csv", f"{PUBLISHED}table-1,low,height,1,m,value,,,differs,digits,,,,,\n")
    folder.put("results/moon/check.csv", f"{CHECKED}roy/table-1/low/height,3,4,differs,1,\n")
    folder.put("results/moon/fig-1.json", '{"quantities": [{"name": "radius", "value": 2.5}]}')
    folder.put("tables/ratios.json", '{"quantities": [{"name": "faster", "value": 10}, {"name": "word", "value": "holds"}]}')

    def assess(rows):
        folder.put("tables/claims.csv", f"{HEADER}{rows}\n")
        return claims.collect(folder.places(), folder.values("moon"), folder.path, folder.path, ["moon"])
    return assess


@pytest.mark.parametrize("evidence, value, verdict", [
    ("fig-1,radius,at least 2,holds", 2.5, "holds"), ("fig-1,radius,at most 2,does not hold", 2.5, "does not hold"),
    ("REPRODUCTION,table-1/low/height,1 to 3,holds", 3, "holds"), ("RATIOS,faster,at least 30,does not hold", 10, "does not hold"),
    ("fig-1,radius,,not stated", 2.5, "not stated")])
def test_are_judged_by_their_evidence(judged, evidence, value, verdict):
    claim, = judged(f"roy,1,moon,round,{evidence},why")
    assert (claim.value, claim.verdict, claim.fails) == (value, verdict, False)


def test_a_range_stands_in_place_of_a_number_that_depends_on_rounding(folder, judged):
    folder.put("tables/published/roy.csv", f"{PUBLISHED}table-1,low,height,1,m,value,2..40 by rounding,,differs,digits,,,,,\n")
    claim, = judged("roy,1,moon,round,REPRODUCTION,table-1/low/height,1 to 3,holds,why")
    assert (claim.value, claim.fails) == (3, False), "which the verdict is of"
    assert "height | 2..40 by rounding | 1 to 3 | holds | why |" in claims.page([claim])


def test_another_verdict_or_no_evidence_is_a_miss(judged):
    claim, = judged("roy,1,moon,round,fig-1,radius,at least 3,holds,")
    assert claims.failure(claim) == "FAILS roy 1, fig-1: radius = 2.5, does not hold; expected: holds"
    for evidence in ("fig-1,colour,at most 2,does not hold", "fig-2,radius,at most 2,does not hold",
                     "RATIOS,word,at most 2,does not hold", "fig-1,colour,,not stated"):
        claim, = judged(f"roy,1,moon,round,{evidence},why")
        assert math.isnan(claim.value) and claim.fails, f"{evidence}: a missing number is no evidence"
        assert "no such quantity" in claims.failure(claim)


def test_of_a_chapter_that_is_not_built_are_left_open(judged):
    claim, = judged("roy,1,sun,hot,fig-1,heat,at least 1,holds,")
    assert (claim.verdict, claim.fails) == ("not built", False)


def test_of_a_chapter_that_there_is_not_are_refused(judged):
    with pytest.raises(Refused, match="no chapter 'mooon' in places.csv"):
        judged("roy,1,mooon,round,fig-1,radius,at least 2,holds,")


def test_the_page_counts_and_links_them(judged):
    page = claims.page(judged("roy,1,moon,round,fig-1,radius,at least 2,holds,of the disc\n"
                              "roy,2,moon,fast,RATIOS,faster,at least 30,does not hold,"))
    for line in ("| roy | 1 | 1 | 0 |",
                 "| 1 | moon | round | [fig-1](../docs/chapters/moon.md#fig-1): radius | 2.5 | at least 2 | holds | of the disc |",
                 "[RATIOS](RATIOS.md): faster | 10 | at least 30 | does not hold |"):
        assert line in page
