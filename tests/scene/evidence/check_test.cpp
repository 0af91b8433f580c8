#include "nlmech/scene/evidence/check.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <stdexcept>

#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"
#include "tests/thrown.hpp"

namespace nlmech::scene::check_test {
namespace {

using tests::bytes_of;
using tests::put;
using tests::TemporaryFolder;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A source with two chapters, `ours` and `theirs`; tests write and measure the values.
class Check : public ::testing::Test {
 protected:
  Check() {
    put(folder_ / "tables/places.csv",
        "source,place,chapter,kind,subject,scenes\nbook,table-1,ours,table,x,\nbook,table-2,theirs,table,y,"
        "\n");
  }
  /// A row with the printed value 1 and the verdict reproduced.
  static std::string row(const std::string& place_and_row) {
    return place_and_row + ",x,1,1,error,,,reproduced,0.15,made up,,,,\n";
  }
  void publish(const std::string& rows) {
    put(folder_ / "tables/published/book.csv",
        "place,row,quantity,value,unit,kind,nominal,inferred,expected,tolerance,because,tried,explains,"
        "erratum,reading\n" +
            rows);
  }
  /// Adds a scene with one value near 1 that measures a number.
  void measure(const std::string& name, Measured measured) { add(1, {{name, measured}}); }
  void add(double value, const std::map<std::string, Measured>& measured = {}) {
    scenes_.push_back({.name = "scene-" + std::to_string(scenes_.size() + 1), .title = ""});
    scenes_.back().content = Content([=](Show& show) {
      show.table(std::vector{value}, {{"x", [](double x) { return x; }}});
      show.near("x", value, 1, 0.1, "by definition");
      for (const auto& [name, m] : measured) show.measured(name, m.nominal, m.inferred, m.setting);
    });
  }
  void add_failing(const std::string& sentence) {
    scenes_.push_back({.name = "broken", .title = ""});
    scenes_.back().content = Content([=](Show&) { throw Failure(sentence); });
  }
  ChapterCheck check_ours() {
    return check(Chapter("ours", "Our chapter", {scenes_}), folder_.path(), false);
  }
  std::string complaint() {
    return tests::thrown<std::logic_error>([&] { return check_ours(); });
  }

  TemporaryFolder folder_;
  std::vector<Scene> scenes_;
};

TEST_F(Check, JudgesTheValuesOfTheChapterAndNoOthers) {
  publish(row("table-1,a") + row("table-2,b"));
  measure("book/table-1/a/x", {1.1, {}});
  const ChapterCheck result = check_ours();
  ASSERT_EQ(result.values.size(), 1U);
  EXPECT_EQ(result.values[0].judgement.verdict, Verdict::reproduced);
  EXPECT_TRUE(result.passes());
}

// A failing scene loses its own values only; the other values keep their verdicts.
TEST_F(Check, GoesOnAfterAFailure) {
  publish(row("table-1,a") + row("table-1,b"));
  add_failing("no memory for the picture");
  measure("book/table-1/b/x", {1, {}});
  const ChapterCheck result = check_ours();
  EXPECT_FALSE(result.values[0].judgement.passes);
  EXPECT_TRUE(result.values[1].judgement.passes);
  EXPECT_TRUE(tests::holds(reproduction_text(result.values), "scene broken: no memory for the picture"));
  ASSERT_EQ(result.quantities.size(), 2U);
  EXPECT_FALSE(result.quantities[0].quantity.passes());
  EXPECT_EQ(result.quantities[0].quantity.reason, "no memory for the picture");
  EXPECT_FALSE(result.passes());
}

TEST_F(Check, FailsByOneQuantity) {
  publish("");
  add(1);
  EXPECT_TRUE(check_ours().passes());
  add(2);
  const ChapterCheck result = check_ours();
  EXPECT_FALSE(result.passes());
  ASSERT_EQ(result.quantities.size(), 2U);
  EXPECT_EQ(result.quantities[1].scene, "scene-2");
}

TEST_F(Check, RefusesAValueWithoutAMeasurement) {
  for (const char* judged :
       {"reproduced,digits,,,,", "\"reproduced, inferred reading\",digits,,7,1 of 2,",
        "same rounding level,factor 5,noise,,,", "better,digits,,,,", "differs,digits,,,,",
        "holds,digits,,,,", "does not hold,digits,,,,", "input,,,,,"}) {
    publish(std::string("table-1,a,x,1,1,error,,,") + judged + ",\n");
    EXPECT_EQ(complaint(), "chapter ours has no measurement for book/table-1/a/x") << judged;
  }
  for (const char* nothing : {"context", "not stated"}) {
    publish(std::string("table-1,a,x,1,1,error,,,") + nothing + ",,,,,,\n");
    EXPECT_EQ(complaint(), "") << nothing;
  }
}

TEST_F(Check, RefusesAMeasurementOfWhatNobodyPrints) {
  publish(row("table-2,b"));
  measure("book/table-2/b/x", {1, {}});
  EXPECT_EQ(complaint(), "chapter ours measures book/table-2/b/x, which no source prints");
}

TEST_F(Check, RefusesTwoMeasurementsOfOneNumber) {
  publish(row("table-1,a"));
  measure("book/table-1/a/x", {1, {}});
  measure("book/table-1/a/x", {1, {}});
  EXPECT_EQ(complaint(), "two scenes measure book/table-1/a/x");
}

TEST_F(Check, LeavesWhatThePagesNeed) {
  publish(
      "table-1,\"a; \"\"b\"\", c\",x,1,1,error,,,reproduced,0.15,made up,,,,\n"
      "table-1,i,x,1,1,error,,1.0..1.2,\"reproduced, inferred reading\",0.15,made up,3,1 of 1,,\n"
      "table-1,t,s,9,s,time,,,context,,,,,,\n"
      "table-2,b,x,1,1,error,,,reproduced,0.15,made up,,,,\n");
  measure("book/table-1/a; \"b\", c/x", {1 + 0x1p-52, {}});
  measure("book/table-1/i/x", {7, 1.1, "all nodes, to t = 3"});
  write_check(check_ours(), "ours", folder_.path());
  const std::string file = bytes_of(folder_ / "results/ours/check.csv");
  EXPECT_EQ(
      file,
      "name,nominal,inferred,verdict,passes,setting\n"
      "\"book/table-1/a; \"\"b\"\", c/x\",1.0000000000000002,,reproduced,1,\n"
      "book/table-1/i/x,7,1.1000000000000001,\"reproduced, inferred reading\",1,\"all nodes, to t = 3\"\n"
      "book/table-1/t/s,,,context,1,\n");
}

// A method that diverges where the source prints a number: the page shows what the check reported.
TEST_F(Check, LeavesInfiniteAndUndefinedNumbersAsTheyAre) {
  publish(
      "table-1,inf,x,1,1,error,,,differs,digits,,,,,\n"
      "table-1,gain,x,100,1,claim,,,holds,at least 100,two orders,,,,\n"
      "table-1,nan,x,1,1,error,,,differs,digits,,,,,\n");
  measure("book/table-1/inf/x", {-inf, {}});
  measure("book/table-1/gain/x", {inf, {}});
  measure("book/table-1/nan/x", {nan, {}});
  write_check(check_ours(), "ours", folder_.path());
  EXPECT_EQ(bytes_of(folder_ / "results/ours/check.csv"),
            "name,nominal,inferred,verdict,passes,setting\n"
            "book/table-1/inf/x,-inf,,differs,1,\n"
            "book/table-1/gain/x,inf,,holds,1,\n"
            "book/table-1/nan/x,nan,,differs,0,\n");
}

}  // namespace
}  // namespace nlmech::scene::check_test
