"""The printed numbers: how their lists and the chapters' verdicts are read, and the page of all."""
import random

import pytest
from conftest import CHECKED, PLACES, PUBLISHED, SOURCE

import claims
import errata
import lists
import markdown
import values
from guide import Guide
from lists import Refused


@pytest.fixture
def page(folder):
    """The page of rows of tables/published and of checks."""
    folder.put("tables/places.csv", f"{PLACES}elgohary,table-1,sun,table,its light,\nroy,fig-2,moon,figure,its path,fig-2a\n"
               "roy,claim-3,moon,claim,its speed,\nlaier,table-9,mars,table,its moons,\n")

    def make(published, checked):
        for source, rows in published.items():
            folder.put(f"tables/published/{source}.csv", PUBLISHED + rows)
        for chapter, rows in checked.items():
            folder.put(f"results/{chapter}/check.csv", CHECKED + rows)
        return values.page(folder.values(*checked), Guide(folder.path, folder.places()))
    return make


ONE = "table-1,a,x,1.5,lb,value,,,reproduced,digits,,,,,\n"


def test_the_page_has_a_section_a_chapter_with_contents_that_lead_to_it(page):
    text = page({"roy": "claim-3,a,x,1.5,1,value,,,reproduced,digits,,,,,\n",
                 "elgohary": "table-1,t|u,x,1.5,lb,value,,,differs,digits,noise,3,1 of 2,,as printed\n",
                 "laier": "table-9,b,x,1,1,value,,,reproduced,digits,,,,,\n"},
                {"moon": "roy/claim-3/a/x,1.51,,reproduced,1,\n", "sun": "elgohary/table-1/t|u/x,1.51,1.234567,differs,1,\n"})
    assert "| [The Sun](#reproduction_sun) | 0 | 0 | 0 | 0 | 1 | 0 | 0 | 0 | 0 | 0 | 0 |" in text
    assert "| [moon](#reproduction_moon) | 1 |" in text
    assert (text.index('<a id="reproduction_sun"></a>\n## The Sun\n\nT. A. Elgohary')
            < text.index('<a id="reproduction_moon"></a>\n## moon\n\nD. Roy')), "the order of places.csv"
    assert ("| [table-1](../docs/chapters/sun.md#table-1) | t\\|u | x | 1.5 lb | digits | 1.51 | 1.235 | differs | "
            "as printed (3 tried; explains 1 of 2 rows); tolerance: noise |") in text
    assert "| [claim-3](../docs/chapters/moon.md) | a | x | 1.5 | digits |" in text, "a claim has no scene"
    assert "-R '^elgohary/table-1/'" in text
    assert "| [table-9](../docs/chapters/mars.md#table-9) | b | x | 1 | digits |  |  | not built |" in text


def test_a_reading_begins_with_the_setting_that_ran(page):
    text = page({"elgohary": ONE.replace(",,,,,", ",,,,,after 499 s")}, {"sun": "elgohary/table-1/a/x,1.5,,reproduced,1,at all nodes\n"})
    assert "| reproduced | at all nodes; after 499 s |" in text


def test_a_text_that_cannot_be_run_says_so_in_place_of_a_number(page):
    row = 'table-1,a,x,1.5,1,value,cannot be run: no load,,differs,digits,,,,,\n'
    assert "| digits | cannot be run: no load | 2 | differs |" in page({"elgohary": row}, {"sun": "elgohary/table-1/a/x,,2,differs,1,\n"})


def test_a_miss_names_the_verdict_that_is_expected(page):
    assert "| 7 |  | differs (FAILS: expected reproduced) |" in page({"elgohary": ONE}, {"sun": "elgohary/table-1/a/x,7,,differs,0,\n"})


def test_what_is_context_is_folded_away(page):
    rows = [f"table-1,{row},x,1.5,lb,time,,,{expected},,,,,,{reading}\n"
            for row, expected, reading in (("a", "context", "in MATLAB"), ("b", "reproduced", ""), ("c", "context", ""))]
    text = page({"elgohary": "".join(rows)}, {"sun": "".join(f"elgohary/table-1/{row}/x,,,context,1,\n" for row in "abc")})
    judged, fold = text.split("<details>\n<summary>")
    assert "2 run times" in fold and "| a | x | 1.5 lb | in MATLAB |" in fold.split("</details>")[0]
    assert "| b | x |" in judged and "| a |" not in judged and "| b |" not in fold


@pytest.mark.parametrize("found, nominal, passes, wanted", [
    ("5..70 by rounding: why", "12.5", 1, "5..70 by rounding"), ("0.03..1e5 by rounding", "12.5", 1, "0.03..1e5 by rounding"),
    ("5..70 by rounding", "100", 0, "100"),  # which fails
    ("5..70 by rounding", "", 1, ""), ("5..70 of twelve", "12.5", 1, "12.5"), ("12.5 by rounding", "12.5", 1, "12.5"),
    ("", "-inf", 1, "-inf"), ("", "nan", 0, "nan"), ("", "0.00012345678", 1, "0.0001235")])
def test_a_range_stands_in_place_of_a_number_that_depends_on_rounding(folder, page, found, nominal, passes, wanted):
    page({"elgohary": f"table-1,a,x,1,1,value,{found},,differs,digits,,,,,\n"},
         {"sun": f"elgohary/table-1/a/x,{nominal},,differs,{passes},\n"})
    assert markdown.nominal(folder.values("sun")[0]) == wanted


def test_names_have_every_character(folder, page):
    page({"elgohary": 'table-1,"a; ""b"", c","two\nlines",1,1,value,,,context,,,,,,\n'},
         {"sun": '"elgohary/table-1/a; ""b"", c/two\nlines",1.0000000000000002,,context,1,\n'})
    value, = folder.values("sun")
    assert (value.name, value.nominal) == ('elgohary/table-1/a; "b", c/two\nlines', 1 + 2**-52)


def test_what_lacks_a_verdict_or_is_broken_is_refused_with_its_place(folder, page):
    results = folder.path / "results/sun/check.csv"
    published = folder.path / "tables/published/elgohary.csv"
    for rows, checked, wanted in (
            (ONE, "", "results/sun/check.csv does not list elgohary/table-1/a/x"),
            (ONE, "elgohary/table-1/a/x,1\n", f"{results}: line 2: 2 of 6 cells"),
            (ONE, "elgohary/table-1/a/x,one,,differs,0,\n", f"{results}: line 2: could not convert string to float: 'one'"),
            ("table-1,a\n", "", f"{published}: line 2: 2 of 15 cells"),
            ('\n\ntable-1,"a\n', "", f"{published}: line 4: a quote is never closed"),
            (ONE.replace(",a,", ',"a\nb",') + "\ntable-1\n", "", f"{published}: line 5: 1 of 15 cells"),
            (ONE.replace("table-1", "table-7"), "", "tables/places.csv does not list table-7 of elgohary")):
        with pytest.raises(Refused) as refused:
            page({"elgohary": rows}, {"sun": checked})
        assert str(refused.value) == wanted


def test_numbers_have_no_needless_zeros():
    for value, digits, wanted in ((1.508e-3, 4, "0.001508"), (1.508e-13, 4, "1.508e-13"), (1e6, 3, "1e6"), (2e-7, 3, "2e-7"),
                                  (1.5e100, 3, "1.5e100"), (0.0, 3, "0"), (float("-inf"), 3, "-inf")):
        assert markdown.number(value, digits) == wanted


def test_columns_without_a_text_are_aligned_as_numbers():
    assert markdown.table(["a", "b", "c"], [["x|y\\|z\n", 1, 0.12345], ["", None, 2.0]], {"c": 2}) == (
        "| a | b | c |\n| :--- | ---: | ---: |\n| x\\|y\\\\\\|z  | 1 | 0.12 |\n|  |  | 2 |\n")


def damaged(text, chance):
    """The text with a few bytes or lines taken out, repeated or replaced."""
    for _ in range(chance.randint(1, 4)):
        at, length = chance.randrange(len(text) + 1), chance.choice((1, 1, 5, 40))
        text = text[:at] + chance.choice((b"", b'"', b",", b"\n", b"\r", b"\0", b"\xff", b"1e999", b"nan", text[:80])) + text[at + length:]
    return text


@pytest.mark.parametrize("name", ["places.csv", "claims.csv", "published/laier.csv", "errata/hermitian.csv"])
def test_a_damaged_list_is_read_or_refused(folder, name):
    """Never anything else: 400 cases of its first rows, the same at each run."""
    chance, refusals = random.Random(name), 0
    places = lists.read_places(SOURCE)
    original = b"".join((SOURCE / "tables" / name).read_bytes().splitlines(True)[:20])
    file = folder.put(f"tables/{name}", "")
    for _ in range(400):
        file.write_bytes(damaged(original, chance))
        try:
            if name == "places.csv":
                lists.read_places(folder.path)
            elif name == "claims.csv":
                claims.read_claims(file)
            elif name.startswith("published"):
                lists.read_values(folder.path, places)
            else:
                errata.read_errata(folder.path)
        except Refused as refused:
            assert str(refused).isprintable(), str(refused)
            refusals += 1
    assert 0 < refusals < 400
