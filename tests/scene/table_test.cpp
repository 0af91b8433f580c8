#include "nlmech/scene/table.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "nlmech/scene/program/csv.hpp"

namespace nlmech::scene::table_test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Any pattern of 64 bits that is a finite number: subnormals, negative zero and the largest are among them.
rc::Gen<double> any_finite() {
  return rc::gen::suchThat(rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                                        [](std::uint64_t bits) { return std::bit_cast<double>(bits); }),
                           [](double x) { return std::isfinite(x); });
}

/// Texts made of what CSV and Markdown find hard.
rc::Gen<std::string> hard_text() {
  return rc::gen::container<std::string>(
      rc::gen::element(',', '"', '\n', '\r', '|', '\\', ' ', 'a', ';', '#', '\t'));
}

TEST(Table, NeedsAColumn) { EXPECT_THROW(Table({}), std::invalid_argument); }

TEST(Table, RefusesARowOfAnotherLength) {
  Table table({{"a"}, {"b"}});
  try {
    table.add({1.0, 2.0, 3.0});
    FAIL() << "three cells for two columns";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("3 cells for 2 columns"), std::string::npos) << error.what();
  }
  EXPECT_THROW(table.add({}), std::invalid_argument);
  EXPECT_TRUE(table.rows().empty());
}

TEST(Table, WritesEveryKindOfCellAsCsv) {
  Table table({{"text"}, {"real"}, {"whole"}, {"nothing"}});
  table.add({std::string("a,b"), 0.1, std::int64_t{-3}, Cell{}});
  table.add({std::string("say \"x\""), -0.0, std::numeric_limits<std::int64_t>::min(), Cell{}});
  table.add({std::string("two\nlines"), inf, std::int64_t{0}, Cell{}});
  EXPECT_EQ(table.csv(),
            "text,real,whole,nothing\n"
            "\"a,b\",0.10000000000000001,-3,\n"
            "\"say \"\"x\"\"\",-0,-9223372036854775808,\n"
            "\"two\nlines\",inf,0,\n");
}

RC_GTEST_PROP(Table, CsvGivesBackEveryDoubleBitForBit, ()) {
  const auto values = *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(any_finite()));
  Table table({{"x"}, {"y"}});
  for (const double x : values) table.add({x, x});
  const auto read = parse_csv(table.csv(), "table");
  RC_ASSERT(read.size() == values.size() + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double back = std::strtod(read[i + 1].cells.at(1).c_str(), nullptr);
    RC_ASSERT(std::bit_cast<std::uint64_t>(back) == std::bit_cast<std::uint64_t>(values[i]));
  }
}

RC_GTEST_PROP(Table, CsvGivesBackEveryText, ()) {
  const auto texts = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::string>>(hard_text()));
  Table table({{"a"}, {"hard \"name\", with\nall"}});
  for (const std::string& text : texts) table.add({text, text});
  const auto read = parse_csv(table.csv(), "table");
  RC_ASSERT(read.size() == texts.size() + 1);
  RC_ASSERT(read[0].cells.at(1) == table.columns()[1].name);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    RC_ASSERT(read[i + 1].cells == (std::vector<std::string>{texts[i], texts[i]}));
  }
}

TEST(Table, PutsABlankLineBetweenScanLines) {
  Table table({{"x"}, {"height", 3, true}});
  for (const double height : {1.0, 1.0, 2.0, 1.0}) table.add({0.5, height});
  EXPECT_EQ(table.csv(), "x,height\n0.5,1\n0.5,1\n\n0.5,2\n\n0.5,1\n");
}

TEST(Table, PutsNoBlankLinesWithoutScanLines) {
  Table table({{"x"}, {"height"}});
  for (const double height : {1.0, 2.0}) table.add({0.5, height});
  EXPECT_EQ(table.csv(), "x,height\n0.5,1\n0.5,2\n");
}

TEST(Table, WritesMarkdownWithTheDigitsOfEachColumn) {
  Table table({{"name"}, {"few", 2}, {"many", 6}, {"count"}});
  table.add({std::string("a"), 1.508e-3, 1.508e-3, std::int64_t{123456}});
  table.add({std::string("b"), Cell{}, inf, Cell{}});
  EXPECT_EQ(table.markdown(),
            "| name | few | many | count |\n"
            "| :--- | ---: | ---: | ---: |\n"
            "| a | 0.0015 | 0.001508 | 123456 |\n"
            "| b |  | inf |  |\n");
}

TEST(Table, AlignsAColumnWithATextToTheLeft) {
  Table table({{"x"}});
  table.add({1.0});
  table.add({std::string("none")});
  EXPECT_EQ(table.markdown(), "| x |\n| :--- |\n| 1 |\n| none |\n");
}

/// A pipe behind an even number of backslashes ends a cell (GitHub Flavored Markdown, section 4.10).
std::ptrdiff_t cell_ends(std::string_view line) {
  std::ptrdiff_t ends = 0, backslashes = 0;
  for (const char c : line) {
    if (c == '|' && backslashes % 2 == 0) ++ends;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return ends;
}

RC_GTEST_PROP(Table, MarkdownKeepsEveryTextInItsCell, ()) {
  const auto text = *hard_text();
  Table table({{"before"}, {text}, {"after"}});
  table.add({std::string("x"), text, std::string("y")});
  const std::string page = table.markdown();
  RC_ASSERT(std::count(page.begin(), page.end(), '\n') == 3);
  RC_ASSERT(page.find('\r') == std::string::npos);
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t end = page.find('\n', at);
    RC_ASSERT(cell_ends(page.substr(at, end - at)) == 4);
    at = end + 1;
  }
}

TEST(FormatNumber, DropsNeedlessZerosAndSigns) {
  EXPECT_EQ(format_number(1.508e-3, 3), "0.00151");
  EXPECT_EQ(format_number(1.5e-7, 3), "1.5e-7");
  EXPECT_EQ(format_number(1e6, 3), "1e6");
  EXPECT_EQ(format_number(1e10, 3), "1e10");
  EXPECT_EQ(format_number(-2.5e-100, 3), "-2.5e-100");
  EXPECT_EQ(format_number(10, 1), "1e1");
  EXPECT_EQ(format_number(0, 3), "0");
  EXPECT_EQ(format_number(-0.0, 3), "-0");
  EXPECT_EQ(format_number(100, 3), "100");
  EXPECT_EQ(format_number(999.9, 3), "1e3");
}

TEST(FormatNumber, ShowsWhatIsNoNumber) {
  EXPECT_EQ(format_number(inf, 3), "inf");
  EXPECT_EQ(format_number(-inf, 3), "-inf");
  EXPECT_EQ(format_number(nan, 3), "nan");
}

RC_GTEST_PROP(FormatNumber, WithSeventeenDigitsIsExact, ()) {
  const double x = *any_finite();
  const double back = std::strtod(format_number(x, 17).c_str(), nullptr);
  RC_ASSERT(std::bit_cast<std::uint64_t>(back) == std::bit_cast<std::uint64_t>(x));
}

RC_GTEST_PROP(FormatNumber, IsOffByHalfALastDigitAtMost, ()) {
  const double x =
      *rc::gen::suchThat(any_finite(), [](double v) { return std::abs(v) > 1e-300 && std::abs(v) < 1e300; });
  const int digits = *rc::gen::inRange(1, 15);
  const double back = std::strtod(format_number(x, digits).c_str(), nullptr);
  // half a unit of the last digit is at most 10^(1-digits)/2 of the number; a millionth more for this sum's
  // own rounding
  RC_ASSERT(std::abs(back - x) <= 0.500001 * std::pow(10.0, 1 - digits) * std::abs(x));
}

TEST(CsvField, QuotesOnlyWhatMustBeQuoted) {
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("plain; text #1 | x"), "plain; text #1 | x");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("\""), "\"\"\"\"");
  EXPECT_EQ(csv_field("a\r"), "\"a\r\"");
}

}  // namespace
}  // namespace nlmech::scene::table_test
