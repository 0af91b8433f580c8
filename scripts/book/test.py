"""Tests of the page maker: python3 scripts/book/test.py"""
import contextlib
import decimal
import io
import unittest

import components
import forge
import references
import search
from book import Book, Complaint
from quantities import formatted
from test_house import ALT, HOUSE, InAHouse, JSON, MAP, PAGE, PICTURE, SEEN, WORKS


class Numbers(unittest.TestCase):
    """Rounded by hand."""

    def test_text(self):
        for value, digits, tex, wanted in (
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
                ("5e-324", 1, True, r"5 \times 10^{-324}")):
            with self.subTest(value=value, digits=digits, tex=tex):
                self.assertEqual(formatted(decimal.Decimal(value), digits, tex), wanted)


class Pages(InAHouse):

    def test_quantities(self):
        for body, wanted in (
                ("is {{geodesy/fig-2.27: max error | 2}}.", "is 2.4&nbsp;&times;&nbsp;10<sup>&minus;11</sup>&nbsp;deg."),
                ("{{ratios: table-4.4, RK4-1 (0.1; 0.5), ours | 2}} {{ratios: table-4.4, RK4-1 (0.1; 0.5), verdict | 3}}",
                 "0.022 does not hold"),
                ("is {{geodesy/fig-2.27: max error|2|no unit}}.", "is 2.4&nbsp;&times;&nbsp;10<sup>&minus;11</sup>."),
                ("{{geodesy/fig-2.27: acceleration | 6}}; a [b]", "9.80665&nbsp;m/s<sup>2</sup>; a [b]"),
                (r"\f$e < {{geodesy/fig-2.27: max error}}\f$", r"\f$e < 2.42 \times 10^{-11}\,\mathrm{deg}\f$"),
                ("\\f[\ne < {{geodesy/fig-2.27: acceleration}}\n\\f]", "\\f[\ne < 9.81\\,\\mathrm{m/s^{2}}\n\\f]"),
                (r"\f$a\f$ is {{geodesy/fig-2.27: acceleration | 1 | no unit}}", r"\f$a\f$ is 10"),
                ("a {{geodesy/fig-2.27:\nacceleration}} b\n\nnext", "a 9.81&nbsp;m/s<sup>2</sup> b\n\n\nnext")):
            self.expect_page(body, wanted)

    def test_code_stays(self):
        code = "```\n{{1}}\n```"
        for body, wanted in (
                ("```cpp\nint a[2][2]{{1, 2}, {3, 4}};\n```", "```cpp\nint a[2][2]{{1, 2}, {3, 4}};\n```"),
                (f"{code}\n\n{code}\n\n{{{{geodesy/fig-2.27: acceleration | 2 | no unit}}}}", f"{code}\n\n{code}\n\n9.8"),
                ("`{{1, 2}, {3}}` and `[@x]`", "`{{1, 2}, {3}}` and `[@x]`"),
                ("| `x'`, `x''` | `x` |", "| ``x'``, ``x''`` | `x` |")):
            self.expect_page(body, wanted)

    def test_links(self):
        for body, wanted in (
                ("by [@one2001, Eq. 3]", r'by \ref work_one2001 "One &amp; Two (2001, Eq. 3)"'),
                ("see [Figure 2.27](../../figures/geodesy/fig-2.27.svg).", "see [Figure 2.27](#figures_geodesy_fig_2_27)."),
                ("see [values](../../tables/a.csv)", "see [values](sources/tables/a.csv)"),
                ("see [words](../../docs/glossary.md#part)", "see [words](@ref glossary)"),
                ("see [code](../../common/nlmech/geodesy/a.hpp)", "see [code](@ref nlmech/geodesy/a.hpp)"),
                ("[a](https://b.org/c), [d](#e), [f](@ref g)", "[a](https://b.org/c), [d](#e), [f](@ref g)")):
            self.expect_page(body, wanted)
        self.assertTrue((self.book.folder / "html/sources/tables/a.csv").exists())

    def test_tables(self):
        frame = (r'\anchor tables_geodesy_table_2_{} \htmlonly[block]<div class="table-caption">\endhtmlonly *Cap* '
                 r"\htmlonly[block]</div>\endhtmlonly ")
        self.expect_page("[*Cap*](../../tables/geodesy/table-2.6.md)",
                         frame.format(6) + r"\include{doc} tables/geodesy/table-2.6.md")
        self.expect_page("[*Cap*](../../tables/geodesy/table-2.7.md)", frame.format(7) + "\n\n| \\f$a\\f$ |\n| --- |")

    def test_figure(self):
        page = self.made('![A "c"\nover two](../../figures/geodesy/fig-2.27.svg)')
        self.assertIn(rf'alt="{ALT}" width="760" height="520"/></a><figcaption>\endhtmlonly A "c" over two ', page)
        self.assertTrue((self.book.folder / "html/figures/geodesy/fig-2.27.svg").exists())
        self.assertNotIn("All curves", page)

    def test_what_is_seen_may_be_told_and_must_be(self):
        told = "A circle in an ellipse that it touches at both ends."
        self.assertIn(f'alt="{told}"', self.made(f'![a](../../figures/geodesy/fig-9.svg "{told}")'))
        for text in ("", ' "Too few words."'):
            self.expect_complaint(f"![a](../../figures/geodesy/fig-9.svg{text})", "3: error: neither figures/geodesy/fig-9.svg nor the "
                                  'page says in 8 words what is seen: ![caption](path "what is seen")')
        self.made(f"![{SEEN[:-1]}](../../figures/geodesy/fig-2.27.svg)")  # no more than the caption
        self.assertEqual(len(self.book.complaints), 1)

    def test_figures_one_after_another_stand_side_by_side(self):
        figures = [f"![a](../../figures/geodesy/{name}.svg)" for name in ("fig-2.27", "fig-10", "error-vs-time")]
        page = self.made("\n\n".join(figures) + "\n\ntext\n\n" + "\n\n".join(figures[:2]))
        self.assertEqual(page.count('<div class="plates">'), 1)
        begin, end = page.index('<div class="plates">'), page.index("</figcaption></figure>\\endhtmlonly \\htmlonly[block]</div>")
        self.assertEqual(page.index("<figure"), page.index("<figure", begin))
        self.assertEqual(page[begin:end].count("<figure"), 3)

    def test_a_long_table_is_folded(self):
        rows = "".join(f"| {i} |\n" for i in range(30))
        self.write(self.book.out / "tables/geodesy/long.md", "| a |\n| --- |\n" + rows)
        self.expect_page("[*Cap*](../../tables/geodesy/long.md)",
                         '\\htmlonly[block]<details class="table"><summary>\\endhtmlonly \\anchor tables_geodesy_long *Cap* (30 rows) '
                         f"\\htmlonly[block]</summary>\\endhtmlonly \n\n| a |\n| --- |\n{rows}\n\\htmlonly[block]</details>\\endhtmlonly")

    def test_a_published_table_may_be_longer_than_one_of_runs(self):
        for name, rows, folded in (("runs", 6, False), ("runs", 7, True), ("table-4.2", 7, False), ("table-4.2", 17, True),
                                   ("errata", 16, False)):
            self.write(self.book.out / f"tables/geodesy/{name}.md", "| a |\n| --- |\n" + "| 1 |\n" * rows)
            page = self.made(f"[Cap](../../tables/geodesy/{name}.md)")
            self.assertEqual('<details class="table">' in page, folded, f"{name}: {rows} rows")

    def test_code_is_looked_for_below_the_folder_that_doxygen_knows(self):
        for path, given in (("common/nlmech/geodesy/a.hpp", "nlmech/geodesy/a.hpp"), ("examples/a.cpp", "examples/a.cpp"),
                            ("chapters/common/a.cpp", "common/a.cpp")):
            self.write(self.book.source / path, "")
            self.expect_page(f"\\snippet {path} part", f"\\snippet {given} part")

    def test_a_number_at_the_begin_of_a_line_is_no_item_of_a_list(self):
        self.expect_page("is\n{{geodesy/fig-2.27: twelve | 5}}. So\n\n12. x", "is\n12\\. So\n\n12. x")

    def test_a_figure_that_answers_is_linked_as_such(self):
        page = self.made("![a](../../figures/geodesy/error-vs-time.svg)")
        self.assertIn(r'\htmlonly[block]<a class="curves" href="figures/geodesy/error-vs-time.svg">All curves by name</a>'
                      "</figcaption>", page)

    def test_works_cited(self):
        self.expect_page("[@old1900]\n\n{{references}}", '\\ref work_old1900 "Old (1900)"\n\n<ul><li>Old, C. (1900). *U*. '
                         '<a href="https://doi.org/10.1/x">doi:10.1/x</a></li></ul>')

    def test_a_figure_that_no_chapter_shows_travels_with_the_book(self):
        self.made("![a](../../figures/geodesy/fig-2.27.svg)")
        page = self.made("| [a](../figures/geodesy/fig-2.27.svg) | [b](../figures/geodesy/fig-9.svg) |",
                         "tables/ERRATA.md", "errata")
        self.assertIn("[a](#figures_geodesy_fig_2_27) | [b](sources/figures/geodesy/fig-9.svg)", page)
        self.assertTrue((self.book.folder / "html/sources/figures/geodesy/fig-9.svg").exists())

    def test_a_link_to_a_scene_leads_to_what_its_chapter_shows(self):
        self.made("![a](../../figures/geodesy/fig-2.27.svg)\n\n[b](../../tables/geodesy/table-2.6.md)")
        page = self.made("[a](../chapters/geodesy/geodesy.md#fig-2.27) [b](../chapters/geodesy/geodesy.md#table-2.6)",
                         "tables/ERRATA.md", "errata")
        self.assertIn("[a](#figures_geodesy_fig_2_27) [b](#tables_geodesy_table_2_6)", page)
        self.expect_complaint("[a](geodesy.md#fig-7)", "3: error: the page of geodesy does not show fig-7")

    def test_what_forges_write_in_another_way(self):
        for body, wanted in (
                ("| $`a + b`$, `c'` |", r"| \f$a + b\f$, ``c'`` |"),
                ('<a id="errata_geodesy"></a>', r"\anchor errata_geodesy"),
                ("<details>\n<summary>More</summary>\n\na\n\n</details>",
                 "\\htmlonly[block]<details>\\endhtmlonly\n\\htmlonly[block]<summary>More</summary>\\endhtmlonly\n\na\n\n"
                 "\\htmlonly[block]</details>\\endhtmlonly")):
            self.expect_page(body, wanted)

    def test_what_is_refused_with_page_and_line(self):
        known = "'max error', 'acceleration', 'twelve', 'empty', 'infinite', 'twice', 'twice', 'nothing'"
        for body, wanted in (
                ("\n{{geodesy/fig-2.27: max eror}}", f"4: error: {JSON} has no quantity 'max eror'; it has {known}"),
                ("{{geodesy/fig-9.9: a}}",
                 "3: error: there is no results/geodesy/fig-9.9.json; `geodesy run fig-9.9` writes it"),
                ("{{geodesy/fig-2.27: twice}}", f"3: error: {JSON} has several quantities 'twice'"),
                ("{{geodesy/fig-2.27: nothing}}", f"3: error: 'nothing' of {JSON} has no value (null)"),
                ("{{geodesy/fig-2.27: empty}}", f"3: error: 'empty' of {JSON} is '', which says nothing"),
                ("{{geodesy/fig-2.27: infinite}}", f"3: error: 'infinite' of {JSON} is inf, which says nothing"),
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
                 "3: error: there is no tables/geodesy/errata.md; `make check` writes it")):
            self.expect_complaint(body, wanted)

    def test_all_complaints_of_a_line_are_shown(self):
        self.made("[@two2002] and {{geodesy/fig-2.27: twice}}")
        self.assertEqual(len(self.book.complaints), 2)


class ForForges(InAHouse):
    """The same pages as Markdown that forges show."""

    def setUp(self):
        super().setUp()
        self.write(self.book.out / "results/geodesy/error-vs-time.csv", "method,time_s\n")
        self.write(self.book.out / "results/geodesy/error-vs-time.json", '{"quantities":[{"name":"factor","value":3}]}')
        self.write(self.book.out / "tables/geodesy/error-vs-time.md", "| a |\n| --- |\n| 1 |\n")
        self.write(self.book.out / "tables/geodesy/table-2.8.md", "| m | \\|c\\| |\n| --- | ---: |\n| a | 1 |\n| b | 2 |\n")
        self.write(self.book.source / "docs/gallery/geodesy-fig-2.27.svg", PICTURE)
        self.write(self.book.source / "chapters/geodesy/a.cpp", "  // [ex]\n  int a;\n\n    a = 1;\n  // [ex]\n")

    def page(self, body):
        """With results between their marks, without title and note."""
        self.write(self.book.source / PAGE, f"# Title\n\n{body}\n")
        self.book.complaints.clear()
        with contextlib.redirect_stderr(io.StringIO()):
            text = forge.ForgePage(self.book, PAGE, "geodesy").text()
        return text.split("`make book`.*\n", 1)[1].strip()

    def test_what_a_page_becomes(self):
        for body, wanted in (
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
                ("<details>\n<summary>More</summary>\n\n</details>", "<details>\n<summary>More</summary>\n\n</details>")):
            with self.subTest(page=body):
                self.assertEqual(forge.without_marks(self.page(body)), wanted)
                self.assertEqual(self.book.complaints, [])

    def test_run_times_may_differ_and_results_by_rounding(self):
        made = self.page("{{geodesy/error-vs-time: factor}} times, {{geodesy/fig-2.27: acceleration}}, "
                         "{{geodesy/fig-2.27: max error}}")
        kept = "{} times, {}&nbsp;m/s<sup>2</sup>, {}&nbsp;deg"
        noise = "2.42&nbsp;&times;&nbsp;10<sup>&minus;11</sup>"
        for values, wanted in ((("3", "9.81", noise), True), (("4000", "9.81", noise), True),
                               (("3", "9.82", noise), True), (("3", "20", noise), False), (("3", "&minus;9.81", noise), False),
                               (("3", "9.81", "3&nbsp;&times;&nbsp;10<sup>&minus;15</sup>"), True),
                               (("3", "9.81", "2.42&nbsp;&times;&nbsp;10<sup>&minus;9</sup>"), False)):
            with self.subTest(values=values):
                self.assertEqual([line for line, _ in forge.differences(made, kept.format(*values))], [] if wanted else [1])
        page = kept.format("3", "9.81", noise)
        for other, words in ((page.replace("9.81", "99"), "99&nbsp;m/s<sup>2</sup> on the page, 9.81&nbsp;m/s<sup>2</sup> now"),
                             (page.replace("times", "time"), f"the page says\n  {page.replace('times', 'time')}\nand would say\n  "
                              f"{forge.without_marks(made)}")):
            self.assertEqual(forge.differences(made, other), [(1, words)])
        self.assertEqual(forge.differences(made, page + "\nmore"), [(2, "2 lines on the page, 1 now")])


class Search(unittest.TestCase):

    PAGE = ('<div class="title">A &amp; <b>B</b> </div><div class="contents">\n<div class="toc"><h3>Contents</h3></div>\n'
            '<p>First \\(x\\) word.</p><script>no</script><h1><a class="anchor" id="auto_1"></a>\nOne</h1><p>of<br/>it</p>'
            '<table><tr><td>1</td><td>2</td></tr></table><h2>Two</h2><p>end</p></div><!-- contents --><p>foot</p>')

    def test_sections(self):
        page = search.with_places(self.PAGE)
        self.assertEqual(search.title_of(page), "A & B")
        self.assertEqual(search.sections_of(page), [("", "", "First word.", ""), ("auto_1", "One", "of it", "1 2"),
                                                    ("section_2", "Two", "end", "")])

    def test_names(self):
        script = ("var searchData=\n[\n  ['b_0',['b&lt;',['../a.html#x',1,'n::A::b()'],['../page.html#y',1,'']]],\n"
                  "  ['c_1',['c',['../c.html',1,'']]]\n];\n")
        self.assertEqual(search.names_in(script, ["page.html"]), [("b<", "a.html#x", "n::A"), ("c", "c.html", "")])


class House(InAHouse):

    def setUp(self):
        super().setUp()
        self.write(self.book.build / "components.txt", "ground: \nhigh: low ground\nlow: ground\nlow: ground\n")
        self.write(self.book.build / "chapter_uses.txt", "one: ground high\ntwo_three: ground\n")
        self.write(self.book.source / "docs/chapters.txt", "# names\none: First\n")
        self.write(self.book.source / "common/nlmech/high/a.hpp", "namespace nlmech::high {\n}\n")
        self.book.chapters = ["one", "two_three"]

    def test_map_has_floors_by_what_stands_on_what(self):
        self.assertEqual(components.map_of_the_house(self.book), MAP)

    def test_components_in_a_circle_are_refused(self):
        with self.assertRaisesRegex(Complaint, "no floor for a, b: "):
            components.floors_of({"a": ["b"], "b": ["a"], "c": []})


class Bibliography(InAHouse):

    def test_entries(self):
        works = self.book.works
        self.assertEqual(works["one2001"].text, "One, A., Two, B. (2001). *T*. ISBN 1-23.")
        self.assertEqual(works["old1900"].text,
                         'Old, C. (1900). *U*. <a href="https://doi.org/10.1/x">doi:10.1/x</a>')
        self.assertEqual([key for key, work in works.items() if not work.linked], ["lost1800"])

    def test_what_is_refused_with_its_line(self):
        file = self.book.source / "docs/references.bib"
        for entry, wanted in (("@misc{a b,\n}", "cannot read the entry that begins with: @misc{a b,\n}"),
                              ("@misc{a,\n  year = {1},\n}", "'a' lacks author, title or year, each on one line"),
                              (WORKS[WORKS.index("@misc"):].replace("10.1/x", "x"), "'old1900' has a DOI that is none: x")):
            self.write(file, "% Words\n" + entry)
            self.book.complaints.clear()
            with contextlib.redirect_stderr(io.StringIO()):
                references.load(self.book, file)
            self.assertEqual(self.book.complaints, [f"docs/references.bib:2: error: {wanted}"])

    def test_that_of_the_book(self):
        book = Book(HOUSE, HOUSE, HOUSE, HOUSE, [])
        references.load(book, HOUSE / "docs/references.bib")
        self.assertEqual(book.complaints, [])
        unlinked = [key for key, work in book.works.items() if not work.linked]
        print("works of docs/references.bib without DOI, URL or ISBN:", *unlinked)


if __name__ == "__main__":
    unittest.main()
