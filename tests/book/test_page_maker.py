"""The page maker, scripts/book, on a small book."""
import decimal

import pytest

import components
import forge
import references
import search
from book import Book, Complaint
from nlmech_tree import SOURCE, write
from quantities import formatted
from small_book import ALT, JSON, MAP, PAGE, PICTURE, SEEN, WORKS, SmallBook


@pytest.fixture
def small(folder):
    """A small book of one scene."""
    return SmallBook(folder)


@pytest.mark.parametrize("value, digits, tex, wanted", [
    ("2.4169999999999999e-11", 3, True, r"2.42 \times 10^{-11}"),
    ("2.4169999999999999e-11", 3, False, "2.42&nbsp;&times;&nbsp;10<sup>&minus;11</sup>"),
    ("2.4169999999999999e-11", None, True, r"2.42 \times 10^{-11}"),
    ("-1.5e-07", 2, True, r"-1.5 \times 10^{-7}"),
    ("9.996e-8", 3, True, r"1.00 \times 10^{-7}"),
    ("0.99999999999999989", 3, True, "1.00"),
    ("0.00012349", 3, True, r"1.23 \times 10^{-4}"),
    ("0.0012349", 3, True, "0.00123"),
    ("46.82999999999999", None, True, "46.8"),
    ("0.5", 3, True, "0.500"),
    ("2.5", 1, True, "3"),
    ("1424.4", 3, True, "1420"),
    ("1424.4", 5, True, "1424.4"),
    ("123456.7", 3, False, "123\u202f000"),
    ("123456.7", 3, True, r"123\,000"),
    ("6378137.0", None, False, "6\u202f378\u202f137"),
    ("6378137", 3, True, r"6.38 \times 10^{6}"),
    ("9999.0", None, False, "9999"),
    ("12", None, False, "12"),
    ("7.0", 2, False, "7"),
    ("10", 1, False, "10"),
    ("0.5", 2, False, "0.50"),
    ("-12", None, False, "&minus;12"),
    ("0.0", 3, True, "0"),
    ("1.7976931348623157e+308", 17, True, r"1.7976931348623157 \times 10^{308}"),
    ("5e-324", 1, True, r"5 \times 10^{-324}")])
def test_numbers_rounded_by_hand(value, digits, tex, wanted):
    assert formatted(decimal.Decimal(value), digits, tex) == wanted


@pytest.mark.parametrize("body, wanted", [
    ("is {{geodesy/fig-2.27: max error | 2}}.", "is 2.4&nbsp;&times;&nbsp;10<sup>&minus;11</sup>&nbsp;deg."),
    ("{{ratios: table-4.4, RK4-1 (0.1; 0.5), reproduced | 2}} {{ratios: table-4.4, RK4-1 (0.1; 0.5), verdict | 3}}",
     "0.022 does not hold"),
    ("is {{geodesy/fig-2.27: max error|2|no unit}}.", "is 2.4&nbsp;&times;&nbsp;10<sup>&minus;11</sup>."),
    ("{{geodesy/fig-2.27: acceleration | 6}}; a [b]", "9.80665&nbsp;m/s<sup>2</sup>; a [b]"),
    (r"\f$e < {{geodesy/fig-2.27: max error}}\f$", r"\f$e < 2.42 \times 10^{-11}\,\mathrm{deg}\f$"),
    ("\\f[\ne < {{geodesy/fig-2.27: acceleration}}\n\\f]", "\\f[\ne < 9.81\\,\\mathrm{m/s^{2}}\n\\f]"),
    (r"\f$a\f$ is {{geodesy/fig-2.27: acceleration | 1 | no unit}}", r"\f$a\f$ is 10"),
    ("a {{geodesy/fig-2.27:\nacceleration}} b\n\nnext", "a 9.81&nbsp;m/s<sup>2</sup> b\n\n\nnext")])
def test_quantities(small, body, wanted):
    small.expect_page(body, wanted)


CODE = "```\n{{1}}\n```"


@pytest.mark.parametrize("body, wanted", [
    ("```cpp\nint a[2][2]{{1, 2}, {3, 4}};\n```", "```cpp\nint a[2][2]{{1, 2}, {3, 4}};\n```"),
    (f"{CODE}\n\n{CODE}\n\n{{{{geodesy/fig-2.27: acceleration | 2 | no unit}}}}", f"{CODE}\n\n{CODE}\n\n9.8"),
    ("`{{1, 2}, {3}}` and `[@x]`", "`{{1, 2}, {3}}` and `[@x]`"),
    ("| `x'`, `x''` | `x` |", "| ``x'``, ``x''`` | `x` |")])
def test_code_stays(small, body, wanted):
    small.expect_page(body, wanted)


@pytest.mark.parametrize("body, wanted", [
    ("by [@one2001, Eq. 3]", r'by \ref work_one2001 "One &amp; Two (2001, Eq. 3)"'),
    ("see [Figure 2.27](../../figures/geodesy/fig-2.27.svg).", "see [Figure 2.27](#figures_geodesy_fig_2_27)."),
    ("see [values](../../tables/a.csv)", "see [values](sources/tables/a.csv)"),
    ("see [words](../../docs/glossary.md#part)", "see [words](@ref glossary)"),
    ("see [code](../../common/nlmech/geodesy/a.hpp)", "see [code](@ref nlmech/geodesy/a.hpp)"),
    ("[a](https://b.org/c), [d](#e), [f](@ref g)", "[a](https://b.org/c), [d](#e), [f](@ref g)")])
def test_links(small, body, wanted):
    small.expect_page(body, wanted)
    assert (small.folder / "html/sources/tables/a.csv").exists() == ("a.csv" in body)


def test_tables(small):
    frame = (r'\anchor tables_geodesy_table_2_{} \htmlonly[block]<div class="table-caption">\endhtmlonly *Cap* '
             r"\htmlonly[block]</div>\endhtmlonly ")
    small.expect_page("[*Cap*](../../tables/geodesy/table-2.6.md)",
                     frame.format(6) + r"\include{doc} tables/geodesy/table-2.6.md")
    small.expect_page("[*Cap*](../../tables/geodesy/table-2.7.md)", frame.format(7) + "\n\n| \\f$a\\f$ |\n| --- |")


def test_figure(small):
    page = small.made('![A "c"\nover two](../../figures/geodesy/fig-2.27.svg)')
    assert rf'alt="{ALT}" width="760" height="520"/></a><figcaption>\endhtmlonly A "c" over two ' in page
    assert (small.folder / "html/figures/geodesy/fig-2.27.svg").exists()
    assert "All curves" not in page


def test_what_is_seen_may_be_told_and_must_be(small):
    told = "A circle in an ellipse that it touches at both ends."
    assert f'alt="{told}"' in small.made(f'![a](../../figures/geodesy/fig-9.svg "{told}")')
    for text in ("", ' "Too few words."'):
        small.expect_complaint(f"![a](../../figures/geodesy/fig-9.svg{text})", "3: error: neither figures/geodesy/fig-9.svg nor the "
                              'page says in 8 words what is seen: ![caption](path "what is seen")')
    small.made(f"![{SEEN[:-1]}](../../figures/geodesy/fig-2.27.svg)")  # no more than the caption
    assert len(small.complaints) == 1


def test_figures_one_after_another_stand_side_by_side(small):
    figures = [f"![a](../../figures/geodesy/{name}.svg)" for name in ("fig-2.27", "fig-10", "error-vs-time")]
    page = small.made("\n\n".join(figures) + "\n\ntext\n\n" + "\n\n".join(figures[:2]))
    assert page.count('<div class="plates">') == 1
    begin, end = page.index('<div class="plates">'), page.index("</figcaption></figure>\\endhtmlonly \\htmlonly[block]</div>")
    assert page.index("<figure") == page.index("<figure", begin)
    assert page[begin:end].count("<figure") == 3


def test_a_long_table_is_folded(small):
    rows = "".join(f"| {i} |\n" for i in range(30))
    write(small.out / "tables/geodesy/long.md", "| a |\n| --- |\n" + rows)
    small.expect_page("[*Cap*](../../tables/geodesy/long.md)",
                     '\\htmlonly[block]<details class="table"><summary>\\endhtmlonly \\anchor tables_geodesy_long *Cap* (30 rows) '
                     f"\\htmlonly[block]</summary>\\endhtmlonly \n\n| a |\n| --- |\n{rows}\n\\htmlonly[block]</details>\\endhtmlonly")


@pytest.mark.parametrize("name, rows, folded", [("runs", 6, False), ("runs", 7, True), ("table-4.2", 7, False), ("table-4.2", 17, True),
                       ("errata", 16, False)])
def test_a_published_table_may_be_longer_than_one_of_runs(small, name, rows, folded):
    write(small.out / f"tables/geodesy/{name}.md", "| a |\n| --- |\n" + "| 1 |\n" * rows)
    page = small.made(f"[Cap](../../tables/geodesy/{name}.md)")
    assert ('<details class="table">' in page) == folded


@pytest.mark.parametrize("path, given", [("common/nlmech/geodesy/a.hpp", "nlmech/geodesy/a.hpp"), ("examples/a.cpp", "examples/a.cpp"),
                ("chapters/common/a.cpp", "common/a.cpp")])
def test_code_is_looked_for_below_the_folder_that_doxygen_knows(small, path, given):
    write(small.source / path, "")
    small.expect_page(f"\\snippet {path} part", f"\\snippet {given} part")


def test_a_number_at_the_begin_of_a_line_is_no_item_of_a_list(small):
    small.expect_page("is\n{{geodesy/fig-2.27: twelve | 5}}. So\n\n12. x", "is\n12\\. So\n\n12. x")


def test_a_figure_that_answers_is_linked_as_such(small):
    page = small.made("![a](../../figures/geodesy/error-vs-time.svg)")
    assert (r'\htmlonly[block]<a class="curves" href="figures/geodesy/error-vs-time.svg">All curves by name</a>'
            "</figcaption>") in page


def test_works_cited(small):
    small.expect_page("[@old1900]\n\n{{references}}", '\\ref work_old1900 "Old (1900)"\n\n<ul><li>Old, C. (1900). *U*. '
                     '<a href="https://doi.org/10.1/x">doi:10.1/x</a></li></ul>')


def test_a_figure_that_no_chapter_shows_travels_with_the_book(small):
    small.made("![a](../../figures/geodesy/fig-2.27.svg)")
    page = small.made("| [a](../figures/geodesy/fig-2.27.svg) | [b](../figures/geodesy/fig-9.svg) |",
                     "tables/ERRATA.md", "errata")
    assert "[a](#figures_geodesy_fig_2_27) | [b](sources/figures/geodesy/fig-9.svg)" in page
    assert (small.folder / "html/sources/figures/geodesy/fig-9.svg").exists()


def test_a_link_to_a_scene_leads_to_what_its_chapter_shows(small):
    small.made("![a](../../figures/geodesy/fig-2.27.svg)\n\n[b](../../tables/geodesy/table-2.6.md)")
    page = small.made("[a](../chapters/geodesy/geodesy.md#fig-2.27) [b](../chapters/geodesy/geodesy.md#table-2.6)",
                     "tables/ERRATA.md", "errata")
    assert "[a](#figures_geodesy_fig_2_27) [b](#tables_geodesy_table_2_6)" in page
    small.expect_complaint("[a](geodesy.md#fig-7)", "3: error: the page of geodesy does not show fig-7")


@pytest.mark.parametrize("body, wanted", [
    ("| $`a + b`$, `c'` |", r"| \f$a + b\f$, ``c'`` |"),
    ('<a id="errata_geodesy"></a>', r"\anchor errata_geodesy"),
    ("<details>\n<summary>More</summary>\n\na\n\n</details>",
     "\\htmlonly[block]<details>\\endhtmlonly\n\\htmlonly[block]<summary>More</summary>\\endhtmlonly\n\na\n\n"
     "\\htmlonly[block]</details>\\endhtmlonly")])
def test_what_forges_write_in_another_way(small, body, wanted):
    small.expect_page(body, wanted)


KNOWN = "'max error', 'acceleration', 'twelve', 'empty', 'infinite', 'twice', 'twice', 'nothing'"


@pytest.mark.parametrize("body, wanted", [
    ("\n{{geodesy/fig-2.27: max eror}}", f"4: error: {JSON} has no quantity 'max eror'; it has {KNOWN}"),
    ("{{geodesy/fig-9.9: a}}",
     "3: error: there is no results/geodesy/fig-9.9.json; `geodesy run fig-9.9` writes it"),
    ("{{geodesy/fig-2.27: twice}}", f"3: error: {JSON} has several quantities 'twice'"),
    ("{{geodesy/fig-2.27: nothing}}", f"3: error: 'nothing' of {JSON} has no value (null)"),
    ("{{geodesy/fig-2.27: empty}}", f"3: error: 'empty' of {JSON} is '', which is no number and no text"),
    ("{{geodesy/fig-2.27: infinite}}", f"3: error: 'infinite' of {JSON} is inf, which is no number and no text"),
    ("{{geodesy/fig-2.27: max error | 18}}",
     "3: error: '18' is neither a number of digits (1 to 17) nor 'no unit'"),
    ("{{max error}}", "3: error: {{max error}} is not of the form {{chapter/scene: quantity | digits}}"),
    ("{{geodesy/fig-2.27: max error", "3: error: {{ without }} in the same paragraph"),
    ("[@two2002]", "3: error: docs/references.bib has no work 'two2002'"),
    ("[@one 2001]", "3: error: [@one 2001] is not of the form [@work] or [@work, place]"),
    ("a [b](../c.md)", "3: error: the link to chapters/c.md leads to no file"),
    ("![a](../../figures/geodesy/fig-3.svg)",
     "3: error: there is no figures/geodesy/fig-3.svg; `geodesy run fig-3` writes it"),
    ("[a](../../tables/geodesy/t.md)", "3: error: there is no tables/geodesy/t.md; `geodesy run t` writes it"),
    ("[a](../../tables/geodesy/errata.md)",
     "3: error: there is no tables/geodesy/errata.md; `make check` writes it")])
def test_what_is_refused_with_page_and_line(small, body, wanted):
    small.expect_complaint(body, wanted)


def test_all_complaints_of_a_line_are_shown(small):
    small.made("[@two2002] and {{geodesy/fig-2.27: twice}}")
    assert len(small.complaints) == 2


@pytest.fixture
def forged(small):
    """A function that makes Markdown for forges of a page, with results between their marks and without title and note."""
    write(small.out / "results/geodesy/error-vs-time.csv", "method,time_s\n")
    write(small.out / "results/geodesy/error-vs-time.json", '{"quantities":[{"name":"factor","value":3}]}')
    write(small.out / "tables/geodesy/error-vs-time.md", "| a |\n| --- |\n| 1 |\n")
    write(small.out / "tables/geodesy/table-2.8.md", "| m | \\|c\\| |\n| --- | ---: |\n| a | 1 |\n| b | 2 |\n")
    write(small.source / "docs/gallery/geodesy-fig-2.27.svg", PICTURE)
    write(small.source / "chapters/geodesy/a.cpp", "  // [ex]\n  int a;\n\n    a = 1;\n  // [ex]\n")

    def page(body):
        write(small.source / PAGE, f"# Title\n\n{body}\n")
        small.complaints.clear()
        text = forge.ForgePage(small, PAGE, "geodesy").text()
        return text.split("`make book`.*\n", 1)[1].strip()

    return page


@pytest.mark.parametrize("body, wanted", [
    ("is {{geodesy/fig-2.27: max error | 2}}.", "is 2.4&nbsp;&times;&nbsp;10<sup>&minus;11</sup>&nbsp;deg."),
    (r"\f$e < {{geodesy/fig-2.27: max error}}\f$", r"$`e < 2.42 \times 10^{-11}\,\mathrm{deg}`$"),
    ("\\f[\n  a\n\\f]\n\n   \\f[ b \\f]", "```math\na\n```\n\n   ```math\n   b\n   ```"),
    ("is\n{{geodesy/fig-2.27: acceleration | 1 | no unit}}. So", "is\n10\\. So"),
    ("a nlmech::geodesy::A, `nlmech::b`", "a `nlmech::geodesy::A`, `nlmech::b`"),
    ("by [@one2001, Eq. 3]\n\n{{references}}", "by [One &amp; Two (2001, Eq. 3)](#work_one2001)\n\n"
     '- <a id="work_one2001"></a>One, A., Two, B. (2001). *T*. ISBN 1-23.'),
    (r"\snippet chapters/geodesy/a.cpp ex", "```cpp\nint a;\n\n  a = 1;\n```"),
    ("[*Cap*](../../tables/geodesy/table-2.6.md)", '<a id="table-2.6"></a>*Cap*\n\n| a |\n| --- |'),
    ("[C.](../../tables/geodesy/error-vs-time.md)",
     '> <a id="error-vs-time"></a>C. `geodesy run error-vs-time` writes it.'),
    ('[C.](../../tables/geodesy/table-2.8.md "depends on rounding: b; |c|")',
     '<a id="table-2.8"></a>C.\n\n| m |\n| --- |\n| a |\n\n*Without what depends on rounding; `geodesy run table-2.8` writes all.*'),
    ('[C.](../../tables/geodesy/table-2.6.md "depends on rounding")',
     '> <a id="table-2.6"></a>C. `geodesy run table-2.6` writes it.'),
    ("![C.](../../figures/geodesy/fig-9.svg)", '> <a id="fig-9"></a>C. `geodesy run fig-9` draws it.'),
    ("![A [b]](../../figures/geodesy/fig-2.27.svg)\n\n[C.](../../tables/geodesy/table-2.6.md)",
     f'<a id="fig-2.27"></a>![{ALT}](../gallery/geodesy-fig-2.27.svg)\n\nA [b]\n\n'
     '<a id="table-2.6"></a>C.\n\n| a |\n| --- |'),
    ("[a](../../figures/geodesy/fig-9.svg) [b](../../figures/moon/fig-1.svg) [c](../../tables/a.csv) "
     "[d](../moon/moon.md#fig-1)", "[a](#fig-9) [b](moon.md#fig-1) [c](../../tables/a.csv) [d](moon.md#fig-1)"),
    ("<details>\n<summary>More</summary>\n\n</details>", "<details>\n<summary>More</summary>\n\n</details>")])
def test_what_a_page_becomes(small, forged, body, wanted):
    assert forge.without_marks(forged(body)) == wanted
    assert small.complaints == []


KEPT = "{} times, {}&nbsp;m/s<sup>2</sup>, {}&nbsp;deg"
NOISE = "2.42&nbsp;&times;&nbsp;10<sup>&minus;11</sup>"
RESULTS = "{{geodesy/error-vs-time: factor}} times, {{geodesy/fig-2.27: acceleration}}, {{geodesy/fig-2.27: max error}}"


@pytest.mark.parametrize("values, same", [
    (("3", "9.81", NOISE), True), (("4000", "9.81", NOISE), True), (("3", "9.82", NOISE), True), (("3", "20", NOISE), False),
    (("3", "4", NOISE), False), (("3", "&minus;9.81", NOISE), False), (("3", "9.81", "3&nbsp;&times;&nbsp;10<sup>&minus;15</sup>"), True),
    (("3", "9.81", "2.42&nbsp;&times;&nbsp;10<sup>&minus;9</sup>"), False)])
def test_run_times_may_differ_and_results_by_rounding(forged, values, same):
    assert [line for line, _ in forge.differences(forged(RESULTS), KEPT.format(*values))] == ([] if same else [1])


def test_differences_are_named(forged):
    made, page = forged(RESULTS), KEPT.format("3", "9.81", NOISE)
    assert forge.differences(made, page.replace("9.81", "99")) == [
        (1, "99&nbsp;m/s<sup>2</sup> on the page, 9.81&nbsp;m/s<sup>2</sup> now")]
    other = page.replace("times", "time")
    assert forge.differences(made, other) == [(1, f"the page has\n  {other}\nand should have\n  {forge.without_marks(made)}")]
    assert forge.differences(made, page + "\nmore") == [(2, "2 lines on the page, 1 now")]


HTML = ('<div class="title">A &amp; <b>B</b> </div><div class="contents">\n<div class="toc"><h3>Contents</h3></div>\n'
        '<p>First \\(x\\) word.</p><script>no</script><h1><a class="anchor" id="auto_1"></a>\nOne</h1><p>of<br/>it</p>'
        '<table><tr><td>1</td><td>2</td></tr></table><h2>Two</h2><p>end</p></div><!-- contents --><p>foot</p>')


def test_sections_of_the_search():
    page = search.with_places(HTML)
    assert search.title_of(page) == "A & B"
    assert search.sections_of(page) == [("", "", "First word.", ""), ("auto_1", "One", "of it", "1 2"), ("section_2", "Two", "end", "")]


def test_names_of_the_search():
    script = ("var searchData=\n[\n  ['b_0',['b&lt;',['../a.html#x',1,'n::A::b()'],['../page.html#y',1,'']]],\n"
              "  ['c_1',['c',['../c.html',1,'']]]\n];\n")
    assert search.names_in(script, ["page.html"]) == [("b<", "a.html#x", "n::A"), ("c", "c.html", "")]


def test_map_has_floors_by_what_stands_on_what(small):
    write(small.build / "components.txt", "ground: \nhigh: low ground\nlow: ground\nlow: ground\n")
    write(small.build / "chapter_uses.txt", "one: ground high\ntwo_three: ground\n")
    write(small.source / "docs/chapters.txt", "# names\none: First\n")
    write(small.source / "common/nlmech/high/a.hpp", "namespace nlmech::high {\n}\n")
    small.chapters = ["one", "two_three"]
    assert components.map_of_the_house(small) == MAP


def test_components_in_a_circle_are_refused():
    with pytest.raises(Complaint, match="no floor for a, b: "):
        components.floors_of({"a": ["b"], "b": ["a"], "c": []})


@pytest.mark.parametrize("chapters, pages", [([], []), (["geodesy"], []), (["orbit", "geodesy"], ["docs/choosing.md"])])
def test_choosing_needs_its_chapters(small, chapters, pages):
    assert small.choosing() == []
    write(small.source / "docs/choosing.md", "[a](../figures/geodesy/fig-9.svg) [b](../figures/orbit/fig-1.svg)")
    small.chapters = chapters
    assert small.choosing() == pages


def test_entries_of_the_bibliography(small):
    works = small.works
    assert works["one2001"].text == "One, A., Two, B. (2001). *T*. ISBN 1-23."
    assert works["old1900"].text == 'Old, C. (1900). *U*. <a href="https://doi.org/10.1/x">doi:10.1/x</a>'
    assert [key for key, work in works.items() if not work.linked] == ["lost1800"]


@pytest.mark.parametrize("entry, wanted", [
    ("@misc{a b,\n}", "cannot read the entry that begins with: @misc{a b,\n}"),
    ("@misc{a,\n  year = {1},\n}", "'a' lacks author, title or year, each on one line"),
    (WORKS[WORKS.index("@misc"):].replace("10.1/x", "x"), "'old1900' has an invalid DOI: x")])
def test_an_entry_that_is_refused_is_named_with_its_line(small, entry, wanted):
    file = small.source / "docs/references.bib"
    write(file, "% Words\n" + entry)
    references.load(small, file)
    assert small.complaints == [f"docs/references.bib:2: error: {wanted}"]


def test_bibliography_of_the_book(capsys):
    book = Book(SOURCE, SOURCE, SOURCE, SOURCE, [])
    references.load(book, SOURCE / "docs/references.bib")
    assert book.complaints == []
    with capsys.disabled():
        print("works of docs/references.bib without DOI, URL or ISBN:", *(key for key, work in book.works.items() if not work.linked))
