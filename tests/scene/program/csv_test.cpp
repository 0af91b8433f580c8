#include "nlmech/scene/program/csv.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::scene::csv_test {
namespace {

using Cells = std::vector<std::string>;

TEST(ParseCsv, SplitsAtCommas) {
  const auto records = parse_csv("a,b,c\n1,,3\n", "file");
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].cells, (Cells{"a", "b", "c"}));
  EXPECT_EQ(records[1].cells, (Cells{"1", "", "3"}));
  EXPECT_EQ(records[1].line, 2U);
}

TEST(ParseCsv, NeedsNoLastLineEnd) {
  EXPECT_EQ(parse_csv("a,b", "file").at(0).cells, (Cells{"a", "b"}));
  EXPECT_EQ(parse_csv("a,", "file").at(0).cells, (Cells{"a", ""}));
  EXPECT_TRUE(parse_csv("", "file").empty());
}

TEST(ParseCsv, ReadsQuotes) {
  const auto records = parse_csv("\"a,b\",\"say \"\"x\"\"\",\"\"\nlast,,\n", "file");
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].cells, (Cells{"a,b", "say \"x\"", ""}));
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
  try {
    static_cast<void>(parse_csv("a,b\n1,\"2\n3,4\n", "points.csv"));
    FAIL() << "an open quote was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "points.csv: line 2: a quote is never closed");
  }
}

RC_GTEST_PROP(ParseCsv, GivesBackWhatCsvFieldWrote, ()) {
  const auto cell = rc::gen::container<std::string>(
      rc::gen::element(',', '"', '\n', '\r', ' ', '\t', 'a', '0', '\0', '\xc3', '\xa9'));
  // A line that holds nothing but blanks is no record, so each one here begins with a mark.
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

}  // namespace
}  // namespace nlmech::scene::csv_test
