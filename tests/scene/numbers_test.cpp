#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene::numbers_test {
namespace {

const std::vector<std::string> xyz = {"x", "y", "z"};

/// What is said about a text that is refused; "" if it is accepted.
std::string complaint(const std::string& text) {
  try {
    static_cast<void>(parse_numbers(text, "points.csv", xyz));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(ParseNumber, TakesDecimalsWithSignAndExponent) {
  const std::vector<std::pair<std::string, double>> good = {
      {"0", 0},         {"+1.5", 1.5},
      {"-1.5", -1.5},   {" 2 ", 2},
      {"\t2\r", 2},     {"1e-3", 1e-3},
      {"1E+3", 1e3},    {"+1e3", 1e3},
      {".5", 0.5},      {"5.", 5},
      {"007", 7},       {"-0", 0},
      {"1e308", 1e308}, {"4.9e-324", 4.9e-324},
      {"0.1", 0.1},     {"123456789012345678901234567890", 123456789012345678901234567890.}};
  for (const auto& [text, expected] : good) {
    double value = 42;
    EXPECT_TRUE(parse_number(text, value)) << "'" << text << "'";
    EXPECT_EQ(value, expected) << "'" << text << "'";
  }
}

TEST(ParseNumber, RefusesAnythingElseAndLeavesTheValueAlone) {
  for (const std::string text :
       {"",     " ",     "+",       "-",    "+-1",      "-+1",    "++1",   "+ 1",  "1 2",
        "1,5",  "1.5.2", "1e",      "e5",   "1e999",    "-1e999", "nan",   "NaN",  "-nan",
        "+nan", "inf",   "+inf",    "-inf", "infinity", "0x10",   "0x1p3", "1f",   "1d3",
        "one",  "1_000", "\u22121", "1\n",  "--1",      "1..2",   ".",     "1e5.0"}) {
    double value = 42;
    EXPECT_FALSE(parse_number(text, value)) << "'" << text << "'";
    EXPECT_EQ(value, 42) << "'" << text << "'";
  }
}

TEST(ParseNumber, RefusesTextThatGoesOnBehindANul) {
  double value = 42;
  EXPECT_FALSE(parse_number(std::string_view("1\0", 2), value));
}

RC_GTEST_PROP(ParseNumber, GivesBackEveryDoubleThatATableWrites, ()) {
  const double x = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
  RC_PRE(std::isfinite(x));
  double back = 0;
  RC_ASSERT(parse_number(format_number(x, 17), back));
  RC_ASSERT(std::bit_cast<std::uint64_t>(back) == std::bit_cast<std::uint64_t>(x));
}

TEST(ParseNumbers, ReadsColumns) {
  const NumberColumns read = parse_numbers("1,2,3\n-4,+5.5,6e-2\n", "points.csv", xyz);
  ASSERT_EQ(read.rows(), 2U);
  EXPECT_EQ(read.column, (std::vector<std::vector<double>>{{1, -4}, {2, 5.5}, {3, 6e-2}}));
  EXPECT_EQ(read.line, (std::vector<std::size_t>{1, 2}));
}

TEST(ParseNumbers, SkipsHeaderCommentsAndBlankLines) {
  const NumberColumns read =
      parse_numbers("# made up\n\nx, y ,z\r\n  # more\r\n1,2,3\r\n \t\r\n4,5,6", "points.csv", xyz);
  EXPECT_EQ(read.column, (std::vector<std::vector<double>>{{1, 4}, {2, 5}, {3, 6}}));
  EXPECT_EQ(read.line, (std::vector<std::size_t>{5, 7}));
}

TEST(ParseNumbers, SkipsTheMarkThatSpreadsheetsPutFirst) {
  EXPECT_EQ(parse_numbers("\xEF\xBB\xBFx,y,z\n1,2,3\n", "points.csv", xyz).rows(), 1U);
}

TEST(ParseNumbers, ReadsNothingFromNothing) {
  for (const std::string text : {"", "\n\n", "# only a remark", "x,y,z\n"}) {
    const NumberColumns read = parse_numbers(text, "points.csv", xyz);
    EXPECT_EQ(read.rows(), 0U) << text;
    EXPECT_EQ(read.column.size(), 3U) << text;
  }
}

TEST(ParseNumbers, KnowsItsOwnHeaderOnly) {
  EXPECT_EQ(complaint("x,y\n"), "points.csv: line 1, column 1 (x): 'x' is not a finite number");
  EXPECT_EQ(complaint("x,z,y\n"), "points.csv: line 1, column 1 (x): 'x' is not a finite number");
  EXPECT_EQ(complaint("x,y,z,w\n"), "points.csv: line 1, column 1 (x): 'x' is not a finite number");
  EXPECT_EQ(complaint("1,2,3\nx,y,z\n"), "points.csv: line 2, column 1 (x): 'x' is not a finite number");
}

TEST(ParseNumbers, NamesFileLineColumnAndTextOfWhatIsNoNumber) {
  for (const char* cell : {"nan", "inf", "-inf", "0x1F", "1e999", "", "five", "1.2.3"}) {
    EXPECT_EQ(complaint(fmt::format("x,y,z\n1,2,3\n\n4, {} ,6\n", cell)),
              fmt::format("points.csv: line 4, column 2 (y): '{}' is not a finite number", cell));
  }
}

TEST(ParseNumbers, ReportsTheFirstFaultOfTheFile) {
  EXPECT_EQ(complaint("1,b,c\na,2,3\n"), "points.csv: line 1, column 2 (y): 'b' is not a finite number");
}

TEST(ParseNumbers, CountsTheCellsOfARowThatIsTooShort) {
  EXPECT_EQ(complaint("1,2,3\n4,5\n"), "points.csv: line 2: 2 of 3 cells");
  EXPECT_EQ(complaint("7\n"), "points.csv: line 1: 1 of 3 cells");
}

TEST(ParseNumbers, ShowsWhatIsTooMuch) {
  EXPECT_EQ(complaint("1,2,3\n4,5,6,7\n"), "points.csv: line 2, column 4: '7' is beyond the 3 columns x,y,z");
  EXPECT_EQ(complaint("4,5,6,\n"), "points.csv: line 1, column 4: '' is beyond the 3 columns x,y,z");
  EXPECT_EQ(complaint("4,5,6, 7 ,8\n"), "points.csv: line 1, column 4: '7 ,8' is beyond the 3 columns x,y,z");
}

RC_GTEST_PROP(ParseNumbers, GivesBackATableBitForBit, ()) {
  const auto bits = *rc::gen::container<std::vector<std::uint64_t>>(rc::gen::arbitrary<std::uint64_t>());
  Table table({{"x"}, {"y"}, {"z"}});
  std::vector<double> values;
  for (const std::uint64_t b : bits) {
    if (!std::isfinite(std::bit_cast<double>(b))) continue;
    values.push_back(std::bit_cast<double>(b));
    table.add({values.back(), -values.back(), 1.0});
  }
  const NumberColumns read = parse_numbers(table.csv(), "table", xyz);
  RC_ASSERT(read.rows() == values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    RC_ASSERT(std::bit_cast<std::uint64_t>(read.column[0][i]) == std::bit_cast<std::uint64_t>(values[i]));
    RC_ASSERT(std::bit_cast<std::uint64_t>(read.column[1][i]) == std::bit_cast<std::uint64_t>(-values[i]));
    RC_ASSERT(read.line[i] == i + 2);
  }
}

}  // namespace
}  // namespace nlmech::scene::numbers_test
