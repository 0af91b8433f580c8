/// Tables and numbers: written CSV and Markdown, and parsed CSV.
#include "nlmech/scene/table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "nlmech/scene/catalogue/catalogue.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"
#include "tests/thrown.hpp"

namespace nlmech::scene::table_test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Any finite number by its 64 bits, including subnormals, negative zero and the largest number.
rc::Gen<double> any_finite() {
  return rc::gen::suchThat(rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                                        [](std::uint64_t bits) { return std::bit_cast<double>(bits); }),
                           [](double x) { return std::isfinite(x); });
}

/// Texts of characters that need quoting in CSV or Markdown.
rc::Gen<std::string> hard_text() {
  return rc::gen::container<std::string>(
      rc::gen::element(',', '"', '\n', '\r', '|', '\\', ' ', 'a', ';', '#', '\t'));
}

TEST(Table, NeedsAColumn) { EXPECT_THROW(Table({}), std::invalid_argument); }

TEST(Table, RefusesARowOfAnotherLength) {
  Table table({{"a"}, {"b"}});
  EXPECT_TRUE(tests::holds(tests::thrown<std::invalid_argument>([&] {
                             table.add({1.0, 2.0, 3.0});
                           }),
                           "3 cells for 2 columns"));
  EXPECT_THROW(table.add({}), std::invalid_argument);
  EXPECT_TRUE(table.rows().empty());
}

TEST(Table, WritesEveryKindOfCellAsCsv) {
  Table table({{"hard \"name\", with\nall"}, {"real"}, {"whole"}, {"nothing"}});
  table.add({std::string("a,b"), 0.1, std::int64_t{-3}, Cell{}});
  table.add({std::string("say \"x\""), -0.0, std::numeric_limits<std::int64_t>::min(), Cell{}});
  table.add({std::string("two\nlines"), inf, std::int64_t{0}, Cell{}});
  EXPECT_EQ(table.csv(),
            "\"hard \"\"name\"\", with\nall\",real,whole,nothing\n"
            "\"a,b\",0.10000000000000001,-3,\n"
            "\"say \"\"x\"\"\",-0,-9223372036854775808,\n"
            "\"two\nlines\",inf,0,\n");
}

TEST(Table, PutsABlankLineBetweenScanLines) {
  Table table({{"x"}, {"height", 3, true}});
  for (const double height : {1.0, 1.0, 2.0, 1.0}) table.add({0.5, height});
  EXPECT_EQ(table.csv(), "x,height\n0.5,1\n0.5,1\n\n0.5,2\n\n0.5,1\n");
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

/// A pipe after an even number of backslashes ends a cell (GitHub Flavored Markdown, section 4.10).
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
  // half a unit of the last digit is at most 10^(1-digits)/2 of the number; a millionth more for the rounding
  // of this expression
  RC_ASSERT(std::abs(back - x) <= 0.500001 * std::pow(10.0, 1 - digits) * std::abs(x));
}

TEST(CsvField, QuotesOnlyWhatMustBeQuoted) {
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("plain; text #1 | x"), "plain; text #1 | x");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("\""), "\"\"\"\"");
  EXPECT_EQ(csv_field("a\r"), "\"a\r\"");
}

using Cells = std::vector<std::string>;

TEST(ParseCsv, NeedsNoLastLineEnd) {
  EXPECT_EQ(parse_csv("a,b", "file").at(0).cells, (Cells{"a", "b"}));
  EXPECT_EQ(parse_csv("a,", "file").at(0).cells, (Cells{"a", ""}));
  EXPECT_TRUE(parse_csv("", "file").empty());
}

TEST(ParseCsv, SkipsBlankLinesAndCountsThem) {
  const auto records = parse_csv("a,b\n\n  \t\n1,2\n", "file");
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[1].line, 4U);
}

TEST(ParseCsv, TakesLineEndsOfBothKinds) {
  const auto records = parse_csv("a,b\r\n\r\n1,\"2\r\n3\"\r\n4,5", "file");
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[0].cells, (Cells{"a", "b"}));
  EXPECT_EQ(records[1].cells, (Cells{"1", "2\r\n3"}));
  EXPECT_EQ(records[2].cells, (Cells{"4", "5"}));
  EXPECT_EQ(records[2].line, 5U) << "the line inside the quotes counts";
}

TEST(ParseCsv, RefusesAQuoteThatIsNeverClosed) {
  EXPECT_EQ(tests::thrown<InputError>([] { return parse_csv("a,b\n1,\"2\n3,4\n", "points.csv"); }),
            "points.csv: line 2: a quote is never closed");
}

RC_GTEST_PROP(ParseCsv, GivesBackWhatCsvFieldWrote, ()) {
  const auto cell = rc::gen::container<std::string>(
      rc::gen::element(',', '"', '\n', '\r', ' ', '\t', 'a', '0', '\0', '\xc3', '\xa9'));
  // A line of blanks is no record, so each record starts with a mark.
  auto records = *rc::gen::container<std::vector<Cells>>(rc::gen::container<Cells>(cell));
  std::string text;
  for (Cells& cells : records) {
    cells.insert(cells.begin(), "mark");
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i ? "," : "") + csv_field(cells[i]);
    text += *rc::gen::element<std::string>("\n", "\r\n");
  }
  const auto read = parse_csv(text, "file");
  RC_ASSERT(read.size() == records.size());
  std::size_t line = 1;
  for (std::size_t i = 0; i < records.size(); ++i) {
    RC_ASSERT(read[i].cells == records[i]);
    RC_ASSERT(read[i].line == line);
    ++line;
    for (const std::string& c : records[i])
      line += static_cast<std::size_t>(std::count(c.begin(), c.end(), '\n'));
  }
}

const std::vector<std::string> xyz = {"x", "y", "z"};

std::string complaint(const std::string& text) {
  return tests::thrown<InputError>([&] { return parse_numbers(text, "points.csv", xyz); });
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
  for (const std::string& text :
       std::vector<std::string>{"",      " ",     "+",      "-",    "+-1",      "-+1",
                                "++1",   "+ 1",   "1 2",    "1,5",  "1.5.2",    "1e",
                                "e5",    "1e999", "-1e999", "nan",  "NaN",      "-nan",
                                "+nan",  "inf",   "+inf",   "-inf", "infinity", "0x10",
                                "0x1p3", "1f",    "1d3",    "one",  "1_000",    "\u22121",
                                "1\n",   "--1",   "1..2",   ".",    "1e5.0",    std::string("1\0", 2)}) {
    double value = 42;
    EXPECT_FALSE(parse_number(text, value)) << "'" << text << "'";
    EXPECT_EQ(value, 42) << "'" << text << "'";
  }
}

TEST(ParseNumbers, SkipsHeaderCommentsAndBlankLines) {
  const NumberColumns read =
      parse_numbers("# made up\n\nx, y ,z\r\n  # more\r\n1,2,3\r\n \t\r\n4,5,6", "points.csv", xyz);
  EXPECT_EQ(read.column, (std::vector<std::vector<double>>{{1, 4}, {2, 5}, {3, 6}}));
  EXPECT_EQ(read.line, (std::vector<std::size_t>{5, 7}));
}

TEST(ParseNumbers, ReadsNoRowsBehindAHeader) {
  const NumberColumns read = parse_numbers("x,y,z\n\n", "points.csv", xyz);
  EXPECT_EQ(read.rows(), 0U);
  EXPECT_EQ(read.column.size(), 3U);
  for (const std::string text : {"", "\n\n", "# only a remark"})
    EXPECT_EQ(complaint(text), "points.csv: is empty; the first line must name the columns x,y,z") << text;
}

TEST(ParseNumbers, SaysWhatTheHeaderMustBe) {
  const std::string must = "; the header must name x,y,z, separated by commas, and is '";
  EXPECT_EQ(complaint("x,y\n"), "points.csv: line 1: there is no column z" + must + "x,y'");
  EXPECT_EQ(complaint("a,b,c\n1,2,3\n"), "points.csv: line 1: there is no column x" + must + "a,b,c'");
  EXPECT_EQ(complaint("x;y;z\n"),
            "points.csv: line 1: there is no column x" + must +
                "x;y;z'; separate cells by commas and write numbers with a decimal point");
  EXPECT_EQ(complaint("x,y,z,X,x\n"), "points.csv: line 1: two columns are called x: 'x,y,z,X,x'");
  EXPECT_EQ(complaint("1,2,3\nx,y,z\n"), "points.csv: line 2, column 1 (x): 'x' is not a finite number");
  EXPECT_EQ(complaint("0,1,2,3\n"),
            "points.csv: line 1: '0,1,2,3' does not name the columns; the first line must name x,y,z");
}

TEST(ParseNumbers, NamesFileLineColumnAndTextOfWhatIsNoNumber) {
  for (const char* cell : {"nan", "inf", "-inf", "0x1F", "1e999", "", "five", "1.2.3"}) {
    EXPECT_EQ(complaint(fmt::format("x,y,z\n1,2,3\n\n4, {} ,6\n", cell)),
              fmt::format("points.csv: line 4, column 2 (y): '{}' is not a finite number", cell));
  }
}

TEST(ParseNumbers, ReportsTheFirstFaultOfTheFileAndItsPlace) {
  EXPECT_EQ(complaint("1,b,c\na,2,3\n"), "points.csv: line 1, column 2 (y): 'b' is not a finite number");
  EXPECT_EQ(complaint("1,2,3\n4,5\n"), "points.csv: line 2: 2 of 3 cells");
  EXPECT_EQ(complaint("1,2,3\n4,5,6,7\n"), "points.csv: line 2, column 4: '7' is beyond the 3 columns x,y,z");
  EXPECT_EQ(complaint("z,y,X\n4,5,6, 7 ,8\n"),
            "points.csv: line 2, column 4: '7 ,8' is beyond the 3 columns z,y,X");
  EXPECT_EQ(complaint("1,2,3\n4,1e-400,6\n"),
            "points.csv: line 2, column 2 (y): '1e-400' is smaller in magnitude than the smallest double, "
            "4.9e-324; write 0");
}

// The same two rows as various programs and spreadsheets write them.
TEST(ParseNumbers, OneTableInManyDialects) {
  const std::vector<std::vector<double>> expected = {{1, -4}, {2, 5.5}, {3, 0.06}};
  for (const std::string text :
       {"x,y,z\n1,2,3\n-4,5.5,0.06\n",                  // as written by nlmech
        "1,2,3\n-4,5.5,0.06\n",                         // no header
        "x,y,z\r\n1,2,3\r\n-4,5.5,0.06\r\n",            // CR LF
        "x,y,z\n1,2,3\n-4,5.5,0.06",                    // no end of the last line
        "\xEF\xBB\xBFx,y,z\n1,2,3\n-4,5.5,0.06\n",      // BOM
        "\xEF\xBB\xBF\"x\",y,z\n1,2,3\n-4,5.5,0.06\n",  // BOM before a quote
        "\xEF\xBB\xBF"
        "1,2,3\n-4,5.5,0.06\n",                                             // BOM before a number
        "X,Y,Z\n1,2,3\n-4,5.5,0.06\n",                                      // capitals
        "z,x,y\n3,1,2\n0.06,-4,5.5\n",                                      // another order
        "\"x\",\"y\",\"z\"\n\"1\",\"2\",\"3\"\n\"-4\",\"5.5\",\"0.06\"\n",  // quotes
        "\"X\" , \" y \",z\n 1 ,\t2, \" 3 \"\n-4,5.5,0.06\n",               // quotes and blanks
        "x,y,z,\n1,2,3,\n-4,5.5,0.06,\n",                                   // a trailing comma in all lines
        "x,y,z\n1,2,3,\n-4,5.5,0.06,,\n",                                   // in rows only
        "x,y,z,,\n1,2,3\n-4,5.5,0.06\n",                                    // in the header only
        "1,2,3,\n-4,5.5,0.06,\n",                                           // without a header
        "\n\nx,y,z\n\n1,2,3\n \t\n-4,5.5,0.06\n\n",                         // blank lines
        "# made up\nx,y,z\n# first\n1,2,3\n-4,5.5,0.06\n",                  // comments
        "x,y,z\n+1,+2.0,3e0\n-4.,55E-1,.06\n",                              // other notations of numbers
        "x,y,z,t\n1,2,3,\n-4,5.5,0.06,noon\n",  // an additional column, once empty
        "t,x,y,z\n0,1,2,3\n1,-4,5.5,0.06\n",    // time first
        "JDTDB,\"Calendar Date, TDB\",X,Y,Z,\n1,\"A.D. 2000, Jan\",1,2,3,\n2,b,-4,5.5,0.06,\n",
        "name,x,y,z\n#1,1,2,3\n#2,-4,5.5,0.06\n",  // a text that starts with #
        "x,X,y,z\n1,7,2,3\n-4,7,5.5,0.06\n"}) {    // an exact name has priority
    ASSERT_EQ(complaint(text), "") << text;
    EXPECT_EQ(parse_numbers(text, "points.csv", xyz).column, expected) << text;
  }
}

// Forms that are refused, with the line number.
TEST(ParseNumbers, RefusesOtherDialects) {
  for (const std::string text : {"x;y;z\n1;2;3\n", "x\ty\tz\n1\t2\t3\n", "x y z\n1 2 3\n", "1;2;3\n",
                                 "1\t2\t3\n", "1 2 3\n", "x;y;z\n1,5;2,5;3,5\n", "1,5;2,5;3,5\n",
                                 "1,5,2,5,3,5\n", "x,y,z\r1,2,3\r", "a,b,c\n1,2,3\n", "7\n"}) {
    EXPECT_TRUE(tests::holds(complaint(text), "points.csv: line 1: ")) << text;
  }
  using namespace std::string_literals;
  for (const std::string& text : {"\xFF\xFEx\0,\0y\0,\0z\0\n\0"s, "\xFE\xFF\0x\0,\0y\0,\0z\0\n"s})  // UTF-16
    EXPECT_TRUE(tests::holds(complaint(text), "points.csv: line 1: "));
  for (const std::string& cell :
       {"1d6"s, "1D6"s, "0x10"s, "nan"s, "NaN"s, "inf"s, "1_000"s, "1'000"s, "1 000"s, "\"1,5\""s,
        "\xE2\x88\x92"
        "1"s,
        "12\0"s, "--"s, "N/A"s, ""s, "1e400"s}) {
    const std::string said = complaint("x,y,z\n1," + cell + ",3\n");
    EXPECT_TRUE(tests::holds(said, "points.csv: line 2, column 2 (y): ")) << cell;
  }
  EXPECT_EQ(complaint("x,y,z\n1,\"2,3\n"), "points.csv: line 2: a quote is never closed");
}

TEST(ParseNumbers, HandsOnWhatItDoesNotKnow) {
  const NumberColumns read =
      parse_numbers("t,X,row,\"a, b\",y,z,input_t\n 0 ,1,,\"c, d\",2,3,4\n", "points.csv", xyz, {"row", "t"});
  EXPECT_EQ(read.rest_names, ",input_input_t,input_row,\"a, b\",input_t");
  EXPECT_EQ(read.rest, (std::vector<std::string>{",0,,\"c, d\",4"}));
}

TEST(CsvColumns, OtherNames) {
  const std::vector<std::string> names = {"latitude_deg|lat", "h"};
  EXPECT_EQ(parse_numbers("H,Lat\n1,2\n", "f", names).column, (std::vector<std::vector<double>>{{2}, {1}}));
  EXPECT_THROW((void)parse_numbers("h,Lat,lat,LATITUDE_DEG,latitude_deg\n1,2,3,4,5\n", "f", names),
               InputError);
}

// Names of equations are case-sensitive: t is not T.
TEST(CsvColumns, ExactNames) {
  CsvColumns columns("f", {"T", "x"}, 0, NameCase::exact);
  EXPECT_TRUE(columns.read_header("t,X,x", 1));
  EXPECT_FALSE(columns.has("T"));
  EXPECT_TRUE(columns.has("x"));
  EXPECT_EQ(columns.rest_names(), ",t,X");
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

// ---- Catalogues: rows and columns that are passed through; output of several threads in order.

using tests::TemporaryFolder;

TEST(Catalogue, RowsByName) {
  const TemporaryFolder folder;
  write_whole(folder.path() / "a.csv",
              "\xEF\xBB\xBF#x, y\r\n # z\r\n\r\n name , b,a\r\n\r\n\"p, q\", 2 , 1\r\n,4,3\n\"\",-6,+5");
  Catalogue catalogue((folder.path() / "a.csv").string(), {"a"}, {"b", "c"}, {});
  EXPECT_TRUE(catalogue.has("b"));
  EXPECT_FALSE(catalogue.has("c"));
  EXPECT_EQ(catalogue.columns().rest_names(), ",name");
  EXPECT_EQ(catalogue.rows(), 3);
  const CatalogueRows two = catalogue.next({2});
  ASSERT_EQ(two.line.size(), 2U);
  EXPECT_EQ(two.line[0], 6U);
  EXPECT_EQ(two.rest[0], ",\"p, q\"");
  EXPECT_EQ(two.rest[1], ",");
  EXPECT_EQ(two.numbers[1][0], 3);
  EXPECT_EQ(two.numbers[1][1], 4);
  EXPECT_TRUE(std::isnan(two.numbers[1][2]));
  const CatalogueRows one = catalogue.next({2});
  EXPECT_EQ(one.first, 3);
  ASSERT_EQ(one.line.size(), 1U);
  EXPECT_EQ(one.numbers[0][0], 5);
  EXPECT_TRUE(catalogue.next({2}).line.empty());
}

// After the header # starts no comment: such a line is a row or is refused.
TEST(Catalogue, NoRowVanishesBehindASharp) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "a.csv").string();
  write_whole(file, "# comment\nname,a\n#1,5\n#2,6\n\n3,7\n");
  Catalogue catalogue(file, {"a"}, {}, {});
  const CatalogueRows rows = catalogue.next({9});
  EXPECT_EQ(rows.rest, (std::vector<std::string>{",#1", ",#2", ",3"}));
  EXPECT_EQ(rows.numbers[2][0], 7);
  for (const char* line : {"# comment\n", "#, much, too, long\n", "#4, 8 # nine\n"}) {
    write_whole(file, std::string("name,a\n3,7\n") + line);
    EXPECT_TRUE(
        tests::holds(tests::thrown<InputError>([&] { Catalogue(file, {"a"}, {}, {}); }), "a.csv: line 3"))
        << line;
  }
}

// Without column names the first line is a row, also when the file is read again.
TEST(Catalogue, NoHeader) {
  const TemporaryFolder folder;
  write_whole(folder / "a.csv", "\xEF\xBB\xBF# comment\n\n1,2\n3,4\n");
  Catalogue catalogue((folder / "a.csv").string(), {"a", "b"}, {"c"}, {});
  EXPECT_EQ(catalogue.rows(), 2);
  const CatalogueRows rows = catalogue.next({9});
  EXPECT_EQ(rows.line, (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(rows.numbers[1][1], 4);
}

// A portion ends with the row that reaches the weight, which bounds the memory.
TEST(Catalogue, PortionsAreWeighed) {
  const tests::TemporaryFolder folder;
  write_whole(folder.path() / "a.csv", "a\n3\n4\n9\n1\n1\n");
  Catalogue catalogue((folder.path() / "a.csv").string(), {"a"}, {}, {});
  catalogue.set_row_weight([](const std::vector<double>& row) { return row[0]; });
  for (const std::size_t rows : {2U, 1U, 2U, 0U}) EXPECT_EQ(catalogue.next({5}).line.size(), rows);
  // Portions of heavy rows also contain several rows, up to a maximum weight.
  Catalogue heavy((folder.path() / "a.csv").string(), {"a"}, {}, {});
  heavy.set_row_weight([](const std::vector<double>& row) { return 10 * row[0]; });
  for (const std::size_t rows : {3U, 2U, 0U})
    EXPECT_EQ(heavy.next({.weight = 5, .rows = 4, .most = 150}).line.size(), rows);
  EXPECT_EQ(portion_for(100, 3).rows, 48U);
}

// Lines that cross the blocks in which a file is read.
TEST(Catalogue, LongFiles) {
  const TemporaryFolder folder;
  std::string text = "a,note\n";
  for (int i = 0; i < 5000; ++i)
    text += std::to_string(i) + "," + std::string(static_cast<std::size_t>(i % 997), 'n') + "\n";
  write_whole(folder.path() / "a.csv", text);
  Catalogue a((folder.path() / "a.csv").string(), {"a"}, {}, {});
  (void)a.next({4000});
  const CatalogueRows rows = a.next({900});
  EXPECT_EQ(rows.first, 4001);
  ASSERT_EQ(rows.line.size(), 900U);
  EXPECT_EQ(rows.numbers[899][0], 4899);
}

TEST(LinesInThreads, AreInOrder) {
  for (const std::size_t count : {0U, 1U, 63U, 1000U}) {
    std::string expected;
    for (std::size_t i = 0; i < count; ++i) expected += std::to_string(i) + '\n';
    for (const int threads : {0, 1, 3}) {
      EXPECT_EQ(
          lines_in_threads(count, threads,
                           [](std::size_t i, std::string& lines) { lines += std::to_string(i) + '\n'; }),
          expected);
    }
  }
  const auto fails = [](std::size_t i, std::string&) {
    if (i == 500) throw InputError("no");
  };
  EXPECT_THROW((void)lines_in_threads(1000, 3, fails), InputError);
}

}  // namespace
}  // namespace nlmech::scene::table_test
