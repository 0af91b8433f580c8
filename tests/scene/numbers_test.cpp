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
                "x;y;z'; cells are separated by commas alone, and numbers have a decimal point");
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

TEST(ParseNumbers, ReportsTheFirstFaultOfTheFile) {
  EXPECT_EQ(complaint("1,b,c\na,2,3\n"), "points.csv: line 1, column 2 (y): 'b' is not a finite number");
}

TEST(ParseNumbers, CountsTheCellsOfARowThatIsTooShort) {
  EXPECT_EQ(complaint("1,2,3\n4,5\n"), "points.csv: line 2: 2 of 3 cells");
}

TEST(ParseNumbers, ShowsWhatIsTooMuch) {
  EXPECT_EQ(complaint("1,2,3\n4,5,6,7\n"), "points.csv: line 2, column 4: '7' is beyond the 3 columns x,y,z");
  EXPECT_EQ(complaint("z,y,X\n4,5,6, 7 ,8\n"),
            "points.csv: line 2, column 4: '7 ,8' is beyond the 3 columns z,y,X");
}

TEST(ParseNumbers, SaysWhatIsTooSmallToBeANumber) {
  EXPECT_EQ(complaint("1,2,3\n4,1e-400,6\n"),
            "points.csv: line 2, column 2 (y): '1e-400' is nearer to 0 than any double but 0, which is above "
            "4.9e-324; write 0");
}

// Forms in which programs and spreadsheets write the same two rows.
TEST(ParseNumbers, OneTableInManyDialects) {
  const std::vector<std::vector<double>> expected = {{1, -4}, {2, 5.5}, {3, 0.06}};
  for (const std::string text :
       {"x,y,z\n1,2,3\n-4,5.5,0.06\n",                  // as it is written here
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
        "x,y,z,\n1,2,3,\n-4,5.5,0.06,\n",                                   // a comma at the end of all lines
        "x,y,z\n1,2,3,\n-4,5.5,0.06,,\n",                                   // of rows alone
        "x,y,z,,\n1,2,3\n-4,5.5,0.06\n",                                    // of the header alone
        "1,2,3,\n-4,5.5,0.06,\n",                                           // without a header
        "\n\nx,y,z\n\n1,2,3\n \t\n-4,5.5,0.06\n\n",                         // blank lines
        "# made up\nx,y,z\n# first\n1,2,3\n-4,5.5,0.06\n",                  // comments
        "x,y,z\n+1,+2.0,3e0\n-4.,55E-1,.06\n",                              // other ways to write a number
        "x,y,z,t\n1,2,3,\n-4,5.5,0.06,noon\n",                              // a further column, once empty
        "t,x,y,z\n0,1,2,3\n1,-4,5.5,0.06\n",                                // time first
        "JDTDB,\"Calendar Date, TDB\",X,Y,Z,\n1,\"A.D. 2000, Jan\",1,2,3,\n2,b,-4,5.5,0.06,\n",
        "name,x,y,z\n#1,1,2,3\n#2,-4,5.5,0.06\n",  // a text that begins with a sharp
        "x,X,y,z\n1,7,2,3\n-4,7,5.5,0.06\n"}) {    // the exact name before others
    ASSERT_EQ(complaint(text), "") << text;
    EXPECT_EQ(parse_numbers(text, "points.csv", xyz).column, expected) << text;
  }
}

// And forms that are refused, each with the line.
TEST(ParseNumbers, RefusesOtherDialects) {
  for (const std::string text : {"x;y;z\n1;2;3\n", "x\ty\tz\n1\t2\t3\n", "x y z\n1 2 3\n", "1;2;3\n",
                                 "1\t2\t3\n", "1 2 3\n", "x;y;z\n1,5;2,5;3,5\n", "1,5;2,5;3,5\n",
                                 "1,5,2,5,3,5\n", "x,y,z\r1,2,3\r", "a,b,c\n1,2,3\n", "7\n"}) {
    EXPECT_NE(complaint(text).find("points.csv: line 1: "), std::string::npos) << text << complaint(text);
  }
  using namespace std::string_literals;
  for (const std::string& text : {"\xFF\xFEx\0,\0y\0,\0z\0\n\0"s, "\xFE\xFF\0x\0,\0y\0,\0z\0\n"s})  // UTF-16
    EXPECT_NE(complaint(text).find("points.csv: line 1: "), std::string::npos) << complaint(text);
  for (const std::string& cell :
       {"1d6"s, "1D6"s, "0x10"s, "nan"s, "NaN"s, "inf"s, "1_000"s, "1'000"s, "1 000"s, "\"1,5\""s,
        "\xE2\x88\x92"
        "1"s,
        "12\0"s, "--"s, "N/A"s, ""s, "1e400"s}) {
    const std::string said = complaint("x,y,z\n1," + cell + ",3\n");
    EXPECT_NE(said.find("points.csv: line 2, column 2 (y): "), std::string::npos) << cell << said;
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

// Names of equations have their own case: t is no T.
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

}  // namespace
}  // namespace nlmech::scene::numbers_test
