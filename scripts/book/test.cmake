# Tests of the book's scripts: cmake -DWORK=<folder to write in> -P test.cmake
cmake_minimum_required(VERSION 3.25)
set(BOOK_SOURCE_DIR "${WORK}/source")
set(BOOK_OUT "${WORK}/out")
set(BOOK_FOLDER "${WORK}/book")
set(BOOK_BUILD_DIR "${WORK}/build")
set(BOOK_CHAPTERS "")
include("${CMAKE_CURRENT_LIST_DIR}/page.cmake")
file(REMOVE_RECURSE "${WORK}")

function(expect what got wanted)
  if(NOT got STREQUAL wanted)
    message("FAILED ${what}\n  got    ${got}\n  wanted ${wanted}")
    set_property(GLOBAL APPEND PROPERTY failures x)
  endif()
endfunction()

# --- Numbers: value, digits, text. Rounded by hand. -----------------------------------------------
function(expect_number value digits style wanted)
  book_format(_got "${value}" "${digits}" ${style})
  expect("book_format(${value}, '${digits}')" "${_got}" "${wanted}")
endfunction()
set(sp " ")  # U+202F
expect_number("2.4169999999999999e-11" 3 tex "2.42 \\times 10^{-11}")
expect_number("2.4169999999999999e-11" 3 html "2.42&nbsp;&times;&nbsp;10<sup>&minus;11</sup>")
expect_number("2.4169999999999999e-11" "" tex "2.42 \\times 10^{-11}")
expect_number("-1.5e-07" 2 tex "-1.5 \\times 10^{-7}")
expect_number("9.996e-8" 3 tex "1.00 \\times 10^{-7}")
expect_number("0.99999999999999989" 3 tex "1.00")
expect_number("0.00012349" 3 tex "1.23 \\times 10^{-4}")
expect_number("0.0012349" 3 tex "0.00123")
expect_number("46.82999999999999" "" tex "46.8")
expect_number("0.5" 3 tex "0.500")
expect_number("1424.4" 3 tex "1420")
expect_number("1424.4" 5 tex "1424.4")
expect_number("123456.7" 3 html "123${sp}000")
expect_number("6378137.0" "" html "6${sp}378${sp}137")
expect_number("6378137" 3 tex "6.38 \\times 10^{6}")
expect_number("9999.0" "" html "9999")
expect_number("12" "" html "12")
expect_number("-12" "" html "&minus;12")
expect_number("0.0" 3 tex "0")
expect_number("1.7976931348623157e+308" 17 tex "1.7976931348623157 \\times 10^{308}")
expect_number("5e-324" 1 tex "5 \\times 10^{-324}")
expect_number("not stated" 3 html "not stated")

# --- A page with everything on it -----------------------------------------------------------------
file(WRITE "${BOOK_OUT}/results/geodesy/fig-2.27.json" [=[{"quantities":[
  {"name":"max error","value":2.417e-11,"unit":"deg"}, {"name":"acceleration","value":9.80665,"unit":"m/s^2"},
  {"name":"twice","value":1}, {"name":"twice","value":2}, {"name":"nothing","value":null}]}]=])
file(WRITE "${BOOK_OUT}/figures/geodesy/fig-2.27.svg" "<svg/>")
file(WRITE "${BOOK_OUT}/tables/geodesy/table-2.6.md" "| a |\n| --- |\n")
file(WRITE "${BOOK_SOURCE_DIR}/r.bib"
  "@book{one2001,\n  author = {One, A. and Two, B.},\n  title = {T},\n  year = {2001},\n  isbn = {1-23},\n}\n")
file(APPEND "${BOOK_SOURCE_DIR}/r.bib"
  "@misc{old1900,\n  author = {Old, C.},\n  title = {U},\n  year = {1900},\n  doi = {10.1/x},\n}\n")
file(APPEND "${BOOK_SOURCE_DIR}/r.bib" "@misc{lost1800,\n  author = {Lost, D.},\n  title = {V},\n  year = {1800},\n}\n")
book_load_references("${BOOK_SOURCE_DIR}/r.bib")
book_work(got one2001)
expect("work with ISBN" "${got}" "One, A., Two, B. (2001). *T*. ISBN 1-23.")
book_work(got old1900)
expect("work with DOI" "${got}" "Old, C. (1900). *U*. <a href=\"https://doi.org/10.1/x\">doi:10.1/x</a>")
get_property(got GLOBAL PROPERTY "works not linked")
expect("works not linked" "${got}" "lost1800")

# The text of one page `body` under a title, without the title's two lines.
function(make_page variable body)
  set_property(GLOBAL PROPERTY "last complaint" "")
  file(WRITE "${BOOK_SOURCE_DIR}/chapters/geodesy/geodesy.md" "# Title: more\n\n${body}\n")
  book_page(chapters/geodesy/geodesy.md "${BOOK_FOLDER}/page.md" chapter_geodesy)
  file(READ "${BOOK_FOLDER}/page.md" text)
  string(REPLACE "# Title: more {#chapter_geodesy}\n\\tableofcontents\n" "" text "${text}")
  string(STRIP "${text}" text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()
function(expect_page body wanted)
  make_page(_got "${body}")
  expect("page: ${body}" "${_got}" "${wanted}")
  get_property(_complaint GLOBAL PROPERTY "last complaint")
  expect("complaint about: ${body}" "${_complaint}" "")
endfunction()
function(expect_complaint body wanted)
  make_page(_got "${body}")
  get_property(_complaint GLOBAL PROPERTY "last complaint")
  expect("complaint about: ${body}" "${_complaint}" "chapters/geodesy/geodesy.md:${wanted}")
endfunction()

expect_page("is {{geodesy/fig-2.27: max error | 2}}."
  "is 2.4&nbsp;&times;&nbsp;10<sup>&minus;11</sup>&nbsp;deg.")
file(WRITE "${BOOK_SOURCE_DIR}/tables/ratios.json" [=[{"quantities":[
  {"name":"table-4.4, RK4-1 (0.1; 0.5), ours","value":0.0216,"unit":"1"},
  {"name":"table-4.4, RK4-1 (0.1; 0.5), verdict","value":"does not hold","unit":""}]}]=])
expect_page("{{ratios: table-4.4, RK4-1 (0.1; 0.5), ours | 2}} {{ratios: table-4.4, RK4-1 (0.1; 0.5), verdict}}"
            "0.022 does not hold")
expect_page("is {{geodesy/fig-2.27: max error|2|no unit}}." "is 2.4&nbsp;&times;&nbsp;10<sup>&minus;11</sup>.")
expect_page("{{geodesy/fig-2.27: acceleration | 6}}; a [b]" "9.80665&nbsp;m/s<sup>2</sup>; a [b]")
set(f "\\f$")
expect_page("${f}e < {{geodesy/fig-2.27: max error}}${f}" "${f}e < 2.42 \\times 10^{-11}\\,\\mathrm{deg}${f}")
expect_page("${f}a${f} is {{geodesy/fig-2.27: acceleration | 1 | no unit}}" "${f}a${f} is 10")
expect_page("a {{geodesy/fig-2.27:\nacceleration}} b\n\nnext" "a 9.81&nbsp;m/s<sup>2</sup> b\n\n\nnext")
expect_page("```cpp\nint a[2][2]{{1, 2}, {3, 4}};\n```" "```cpp\nint a[2][2]{{1, 2}, {3, 4}};\n```")
set(code "```\n{{1}}\n```")
expect_page("${code}\n\n${code}\n\n{{geodesy/fig-2.27: acceleration | 2 | no unit}}"
  "${code}\n\n${code}\n\n9.8")
expect_page("`{{1, 2}, {3}}` and `[@x]`" "`{{1, 2}, {3}}` and `[@x]`")
expect_page("by [@one2001, Eq. 3]" "by \\ref work_one2001 \"One &amp; Two (2001, Eq. 3)\"")
expect_page("see [Figure 2.27](../../figures/geodesy/fig-2.27.svg)."
  "see [Figure 2.27](#figures_geodesy_fig_2_27).")
file(WRITE "${BOOK_SOURCE_DIR}/tables/a.csv" "a\n")
file(WRITE "${BOOK_SOURCE_DIR}/common/nlmech/geodesy/a.hpp" "")
set_property(GLOBAL PROPERTY "label|docs/glossary.md" glossary)
expect_page("see [values](../../tables/a.csv)" "see [values](sources/tables/a.csv)")
expect_page("see [words](../../docs/glossary.md#part)" "see [words](@ref glossary)")
expect_page("see [code](../../common/nlmech/geodesy/a.hpp)" "see [code](@ref nlmech/geodesy/a.hpp)")
expect_page("[a](https://b.org/c), [d](#e), [f](@ref g)" "[a](https://b.org/c), [d](#e), [f](@ref g)")
string(CONCAT table
  "\\anchor tables_geodesy_table_2_6 "
  "\\htmlonly[block]<div class=\"table-caption\">\\endhtmlonly *Cap* "
  "\\htmlonly[block]</div>\\endhtmlonly \\include{doc} tables/geodesy/table-2.6.md")
expect_page("[*Cap*](../../tables/geodesy/table-2.6.md)" "${table}")
make_page(got "![A \"c\"\nover two](../../figures/geodesy/fig-2.27.svg)")
if(NOT got MATCHES "alt=\"A &quot;c&quot; over two\"/></a><figcaption>.endhtmlonly A \"c\" over two "
   OR NOT EXISTS "${BOOK_FOLDER}/html/figures/geodesy/fig-2.27.svg")
  expect("figure" "${got}" "an image with its caption, and a copy of the file")
endif()

# --- Pages that come after the chapters: a figure that none of them shows travels with the book ----
file(WRITE "${BOOK_OUT}/figures/geodesy/fig-9.svg" "<svg/>")
file(WRITE "${BOOK_SOURCE_DIR}/tables/ERRATA.md"
  "# E\n\n| [a](../figures/geodesy/fig-2.27.svg) | [b](../figures/geodesy/fig-9.svg) |\n")
book_page(tables/ERRATA.md "${BOOK_FOLDER}/errata.md" errata)
file(READ "${BOOK_FOLDER}/errata.md" got)
if(NOT got MATCHES "\\[a\\]\\(#figures_geodesy_fig_2_27\\) . \\[b\\]\\(sources/figures/geodesy/fig-9.svg\\)"
   OR NOT EXISTS "${BOOK_FOLDER}/html/sources/figures/geodesy/fig-9.svg")
  expect("links to figures" "${got}" "one to the chapter's page, one to the file")
endif()

# --- The map: floors by what stands on what; what all chapters use is said once ---------------------
file(WRITE "${BOOK_BUILD_DIR}/components.txt" "ground: \nhigh: low ground\nlow: ground\nlow: ground\n")
file(WRITE "${BOOK_BUILD_DIR}/chapter_uses.txt" "one: ground high\ntwo_three: ground\n")
file(WRITE "${BOOK_SOURCE_DIR}/docs/chapters.txt" "# names\none: First\n")
file(WRITE "${BOOK_SOURCE_DIR}/common/nlmech/high/a.hpp" "namespace nlmech::high {\n}\n")
set(BOOK_CHAPTERS one two_three)
book_map(got)
string(CONCAT map
  "<div class=\"map\"><ul class=\"floor chapter-floor\">"
  "<li>\\ref chapter_one \"First\" <span class=\"uses\">high</span></li>"
  "<li>\\ref chapter_two_three \"Two three\" </li></ul>"
  "<ul class=\"floor\"><li>\\ref nlmech::high \"high\" <span class=\"uses\">low, ground</span></li></ul>"
  "<ul class=\"floor\"><li>\\ref common/nlmech/low \"low\" <span class=\"uses\">ground</span></li></ul>"
  "<ul class=\"floor\"><li>\\ref common/nlmech/ground \"ground\" </li></ul>"
  "<div class=\"note\">Each box names what it stands on. "
  "Every chapter also stands on <span class=\"common\">ground</span>.</div></div>")
expect("map" "${got}" "${map}")

# --- What must be refused, with page and line -----------------------------------------------------
set(json "results/geodesy/fig-2.27.json")
set(known "'max error', 'acceleration', 'twice', 'twice', 'nothing'")
expect_complaint("\n{{geodesy/fig-2.27: max eror}}"
  "4: error: ${json} has no quantity 'max eror'; it has ${known}")
expect_complaint("{{geodesy/fig-9.9: a}}"
  "3: error: there is no results/geodesy/fig-9.9.json; `geodesy run fig-9.9` writes it")
expect_complaint("{{geodesy/fig-2.27: twice}}" "3: error: ${json} has several quantities 'twice'")
expect_complaint("{{geodesy/fig-2.27: nothing}}" "3: error: 'nothing' of ${json} has no value (NULL)")
expect_complaint("{{geodesy/fig-2.27: max error | 18}}"
  "3: error: '18' is neither a number of digits (1 to 17) nor 'no unit'")
expect_complaint("{{max error}}"
  "3: error: {{max error}} is not of the form {{chapter/scene: quantity | digits}}")
expect_complaint("{{geodesy/fig-2.27: max error" "3: error: {{ without }} in the same paragraph")
expect_complaint("[@two2002]" "3: error: docs/references.bib has no work 'two2002'")
expect_complaint("[@one 2001]" "3: error: [@one 2001] is not of the form [@work] or [@work, place]")
expect_complaint("a [b](../c.md)" "3: error: the link to chapters/c.md leads to no file")
expect_complaint("![a](../../figures/geodesy/fig-3.svg)"
  "3: error: there is no figures/geodesy/fig-3.svg; `geodesy run fig-3` writes it")
expect_complaint("[a](../../tables/geodesy/t.md)"
  "3: error: there is no tables/geodesy/t.md; `geodesy run t` writes it")

# --- The bibliography of the book: each DOI is well formed, and what has no link is listed ----------
set_property(GLOBAL PROPERTY "works not linked" "")
book_load_references("${CMAKE_CURRENT_LIST_DIR}/../../docs/references.bib")
get_property(unlinked GLOBAL PROPERTY "works not linked")
list(JOIN unlinked " " unlinked)
message("works of docs/references.bib without DOI, URL or ISBN: ${unlinked}")

expect_complaint("[a](../../tables/geodesy/errata.md)"
  "3: error: there is no tables/geodesy/errata.md; `make check` writes it")

get_property(failures GLOBAL PROPERTY failures)
if(failures)
  list(LENGTH failures failures)
  message(FATAL_ERROR "${failures} tests of the book's scripts failed")
endif()
message("all tests of the book's scripts passed")
