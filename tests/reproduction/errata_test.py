"""The lists of misprints and their pages."""
import pytest
from conftest import PLACES

import errata
from guide import Guide
from lists import Refused

HEADER = ",".join(errata.HEADER) + "\n"
SIGN = ('moon-1.2-sign,elgohary,(1.2),formula,"$+a$, twice",$-a$,the other side,perhaps,'
        "unit_moon:Errata.Sign unit_moon:Errata.Twice,0.5,1e-12\n")
CAPTION = "moon-caption,elgohary,Figure 3,wording,left,right,,no,,,\n"


@pytest.fixture
def read(folder):
    folder.put("tables/errata/README.md", "no list")
    folder.put("tables/places.csv", f"{PLACES}elgohary,table-1,sun,table,its light,\nroy,fig-2,moon,figure,its path,fig-2a\n")
    folder.put("tests/chapters/moon/errata_test.cpp", "\nTEST(Errata, Sign) {}\n")
    folder.put("tests/chapters/sun/errata_test.cpp", "\nTEST_F(Errata, Sign) {}\n")

    def read_lists(**chapters):
        for chapter, rows in chapters.items():
            folder.put(f"tables/errata/{chapter}.csv", HEADER + rows)
        return errata.read_errata(folder.path)
    return read_lists


@pytest.fixture
def page(folder, read):
    return lambda **chapters: errata.page(read(**chapters), Guide(folder.path, folder.places()))


def test_every_column_is_read(read):
    sign, caption = read(moon=SIGN + CAPTION)
    assert sign == errata.Erratum("moon", "moon-1.2-sign", "elgohary", "(1.2)", "formula", "$+a$, twice", "$-a$", "the other side",
                                  "perhaps", ["unit_moon:Errata.Sign", "unit_moon:Errata.Twice"], "0.5", "1e-12")
    assert caption.tests == []


@pytest.mark.parametrize("rows, wanted", [
    (SIGN + SIGN, "line 3: 'moon-1.2-sign' is there twice"),
    ("moon-1,elgohary,(1),formula,a,b,,no,,,\n", "line 2: moon-1: a test for all but wording"),
    ("moon-1,elgohary,(1),wording,a,b,,no,unit_moon:A.B,1,1e-9\n", "line 2: moon-1: a test for all but wording"),
    ("moon-1,elgohary,(1),formula,a,b,,no,unit_moon:A.B,,\n", "line 2: moon-1: misses and within for all but wording"),
    ("moon-1,elgohary,(1),formula,a,b,,no,unit_moon:A.B,1,\n", "line 2: moon-1: misses and within for all but wording"),
    ("moon-1,elgohary,(1),wording,a,b,,no,,1,1e-9\n", "line 2: moon-1: misses and within for all but wording"),
    ("moon-1,elgohary,(1),formula,a,b,,no,A.B,1,1e-9\n", "line 2: 'A.B' is not of the form program:Suite.Name"),
    ("moon-1,elgohary,(1),slip,a,b,,no,,,\n", "line 2: 'slip' is no kind of entry"),
    ("moon-1,elgohary,(1),wording,a,b,,ocr,,,\n", "line 2: 'ocr' is neither no nor perhaps"),
    ("sun-1,elgohary,(1),wording,a,b,,no,,,\n", "line 2: 'sun-1' does not begin with 'moon-'"),
    ("moon-1,elgohary\n", "line 2: 2 of 11 cells")])
def test_what_no_test_proves_is_refused(folder, read, rows, wanted):
    with pytest.raises(Refused) as refused:
        read(moon=rows)
    assert str(refused.value) == f"{folder.path}/tables/errata/moon.csv: {wanted}"


def test_another_header_is_refused(folder, read):
    folder.put("tables/errata/moon.csv", "id,source\n")
    with pytest.raises(Refused, match="has another header than expected"):
        read()


def test_pages_show_both_forms_with_their_distances(page, read):
    text = page(moon=SIGN.replace("Sign ", "Other ") + CAPTION, sun="sun-a,roy,(7),refuted,3,4,,no,unit_sun:A.B,0.25,1e-9\n")
    assert "2 misprints, and 1 claims that are refuted" in text and "The 1 entries without numbers" in text
    assert "| 0.25 | 1e-9 | a claim, refuted | `unit_sun:A.B` |" in text
    assert ("| 0.5 | 1e-12 | the other side; perhaps an error of the scan | `unit_moon:Errata.Other` `unit_moon:Errata.Twice` |" in text)
    table = errata.chapter_table(read(), "moon")
    assert "unit_" not in table, "names of tests are for the page of all"
    assert "(7)" not in table, "another chapter's"


def test_the_page_has_a_section_a_chapter_with_links_to_scenes_and_tests(page, read):
    sun = r'sun-1,elgohary,"Table 1, C3",formula,\f$+|a|\f$,"\f$-a\f$, \f$b\f$",,no,chapter_sun:Errata.Sign unit_sun:A.B,2,1e-9' + "\n"
    text = page(moon="moon-2,roy,before (2),wording,left,right,,no,,,\n", sun=sun)
    assert "| [The Sun](#errata_sun) | 1 | 0 | 0 | 0 | 0 |" in text and "| [moon](#errata_moon) | 0 | 0 | 0 | 1 | 0 |" in text
    assert text.index('<a id="errata_sun"></a>\n## The Sun') < text.index('<a id="errata_moon"></a>\n## moon'), "as in places.csv"
    assert (r"| [Table 1](../docs/chapters/sun.md#table-1), C3 | $`+\|a\|`$ | $`-a`$, $`b`$ | 2 | 1e-9 |  | "
            "[Sign](../tests/chapters/sun/errata_test.cpp) `unit_sun:A.B` |") in text
    assert "| before (2) | left | right |" in text
    assert r"| Table 1, C3 | \f$+\|a\|\f$ | \f$-a\f$, \f$b\f$ |" in errata.chapter_table(read(), "sun")


def test_tests_are_called_by_sentences(folder, read):
    folder.put("tests/moon/more_test.cpp", "\nTEST(Errata, Table2_6_TheSign) {}\n\nTEST(Errata, C8_ForAPoint3) {}\n\n"
               "TEST(Errata,\n     Sign) {}\n")
    guide = Guide(folder.path, folder.places())
    for test, wanted in (("unit_moon:Errata.Table2_6_TheSign", "[Table 2.6 the sign](../tests/moon/more_test.cpp)"),
                         ("unit_moon:Errata.C8_ForAPoint3", "[C8 for a point 3](../tests/moon/more_test.cpp)"),
                         ("chapter_sun:Errata.Sign", "[Sign](../tests/chapters/sun/errata_test.cpp)")):
        assert guide.test_link(test) == wanted


def test_words_are_linked_where_they_name_a_place_of_the_source(folder, read):
    guide = Guide(folder.path, folder.places())
    for words, wanted in (("Figure 2", "[Figure 2](../docs/chapters/moon.md#fig-2a)"), ("Figure 7", "Figure 7"), ("(2)", "(2)")):
        assert guide.link_words("moon", "roy", words) == wanted
