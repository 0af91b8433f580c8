/// Printed and measured ratios of run times, and statements about speed: rules and files; no timing.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "nlmech/scene/evidence/ratios.hpp"
#include "nlmech/scene/program/files.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::scene::ratios_test {
namespace {

using tests::TemporaryFolder;

RatioVerdict judged(double printed, double reproduced) {
  return compare_ratio(printed, {reproduced, reproduced, reproduced});
}

TEST(Ratios, HoldIfTheSameIsFasterWithinAFactorOfThree) {
  EXPECT_TRUE(judged(6, 2).holds);
  EXPECT_TRUE(judged(6, 18).holds);
  EXPECT_FALSE(judged(6, 1.9).holds);
  EXPECT_FALSE(judged(6, 18.1).holds);
  EXPECT_TRUE(judged(0.2, 0.5).holds);
  EXPECT_FALSE(judged(1.2, 0.9).holds) << "near, but the other one is faster";
  EXPECT_FALSE(judged(0.9, 1.2).holds);
}

TEST(Ratios, SayHowFarApartTheyAreWhicheverIsLarger) {
  EXPECT_DOUBLE_EQ(judged(774, 0.5).apart, 1548);
  EXPECT_DOUBLE_EQ(judged(0.5, 774).apart, 1548);
}

TEST(Ratios, AreLostIfTheReferenceWinsInPrintAlone) {
  EXPECT_TRUE(judged(7.2, 0.07).lost());
  EXPECT_FALSE(judged(7.2, 1.1).lost()) << "too far apart, but the reference is still faster";
  EXPECT_FALSE(judged(0.5, 2).lost()) << "the other way round";
  EXPECT_FALSE(judged(0.5, 0.01).lost());
}

TEST(Ratios, HaveMediansAndQuartiles) {
  const Spread odd = spread_of({5, 1, 3, 2, 4}), even = spread_of({2, 1}), one = spread_of({7});
  EXPECT_DOUBLE_EQ(odd.middle, 3);
  EXPECT_DOUBLE_EQ(odd.low, 2);
  EXPECT_DOUBLE_EQ(odd.high, 4);
  EXPECT_DOUBLE_EQ(even.low, 1.25);
  EXPECT_DOUBLE_EQ(even.middle, 1.5);
  EXPECT_DOUBLE_EQ(one.high, 7);
  EXPECT_THROW((void)spread_of({}), std::invalid_argument);
}

TEST(Ratios, SpreadFromOppositeQuartiles) {
  const Spread ratio = ratio_of({6, 4, 10}, {2, 1, 4});
  EXPECT_DOUBLE_EQ(ratio.middle, 3);
  EXPECT_DOUBLE_EQ(ratio.low, 1);
  EXPECT_DOUBLE_EQ(ratio.high, 10);
}

TEST(Ratios, RefuseWhatIsNoRatio) {
  EXPECT_THROW((void)judged(0, 1), std::invalid_argument);
  EXPECT_THROW((void)judged(1, HUGE_VAL), std::invalid_argument);
  EXPECT_THROW((void)judged(NAN, 1), std::invalid_argument);
  EXPECT_THROW((void)judged(1, -1), std::invalid_argument);
}

PublishedValue value(const std::string& place, const std::string& row, double number, const std::string& kind,
                     const std::string& unit) {
  PublishedValue v;
  v.source = "someone";
  v.place = place;
  v.row = row;
  v.value = number;
  v.kind = kind;
  v.unit = unit;
  return v;
}

/// Times of two methods in one table; an error and another table that must be ignored.
std::vector<PublishedValue> published() {
  return {value("table-1", "slow (P/10)", 8, "time", "s"),
          value("table-1", "slow (P/10)", 1e-5, "error", "1"), value("table-1", "own", 2, "time", "s"),
          value("table-2", "slow (P/10)", 100, "time", "s")};
}

const std::map<std::string, std::string> references = {{"slow (P/10)", "own"}, {"own", "own"}};

std::vector<BenchSeries> series() {
  return {{"table-1, slow (P/10)", "us a run", {30, 40, 50}}, {"table-1, own", "us a run", {20, 20, 25}}};
}

TEST(Ratios, TakePrintedSecondsFromTheListOfPublishedNumbers) {
  const auto rows = compare_times(published(), "table-1", references, series());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].row, "slow (P/10)");
  EXPECT_EQ(rows[0].reference, "own");
  EXPECT_EQ(rows[0].printed_seconds, 8);
  EXPECT_DOUBLE_EQ(rows[0].seconds, 40e-6);
  EXPECT_DOUBLE_EQ(rows[0].verdict.printed, 4);
  EXPECT_DOUBLE_EQ(rows[0].verdict.reproduced.middle, 2) << "of medians: 40 over 20";
  EXPECT_DOUBLE_EQ(rows[0].verdict.reproduced.low, 35 / 22.5);
  EXPECT_DOUBLE_EQ(rows[0].verdict.reproduced.high, 45 / 20.0);
  EXPECT_TRUE(rows[0].verdict.holds);
  EXPECT_TRUE(rows[1].is_reference());
  EXPECT_EQ(rows[1].verdict.reproduced.middle, 1);
}

TEST(Ratios, LeaveNoPrintedRowOut) {
  EXPECT_THROW((void)compare_times(published(), "table-1", {{"own", "own"}}, series()), std::invalid_argument)
      << "a row without a reference";
  EXPECT_THROW((void)compare_times(published(), "table-1", references, {series()[1]}), std::invalid_argument)
      << "a row that was not measured";
  EXPECT_THROW((void)compare_times(published(), "table-3", references, series()), std::invalid_argument);
  auto minutes = published();
  minutes[0].unit = "min";
  EXPECT_THROW((void)compare_times(minutes, "table-1", references, series()), std::invalid_argument);
}

std::vector<TimeRatio> rows_of(std::vector<double> printed, const std::vector<double>& reproduced) {
  std::vector<TimeRatio> rows;
  for (std::size_t i = 0; i < printed.size(); ++i) {
    rows.push_back({"table-1", "row " + std::to_string(i), "own", printed[i], 1e-6,
                    compare_ratio(printed[i], {reproduced[i], reproduced[i] / 2, reproduced[i] * 2})});
  }
  return rows;
}

TEST(Ratios, CompareAClaimWithTheMeanOfItsRows) {
  const auto rows = rows_of({24, 46}, {2, 4});
  const auto claim =
      mean_claim(value("claim-1", "LEO", 35, "value", "1"), "table-1", {"row 0", "row 1"}, rows);
  EXPECT_EQ(claim.verdict.printed, 35);
  EXPECT_DOUBLE_EQ(claim.verdict.reproduced.middle, 3);
  EXPECT_DOUBLE_EQ(claim.verdict.reproduced.low, 1.5);
  EXPECT_DOUBLE_EQ(claim.verdict.reproduced.high, 6);
  EXPECT_FALSE(claim.verdict.holds);
  EXPECT_THROW((void)mean_claim(value("claim-1", "LEO", 35, "value", "1"), "table-1", {"row 2"}, rows),
               std::invalid_argument);
}

/// The names of an object in order.
std::string names_of(const nlohmann::ordered_json& json) {
  std::string names;
  for (const auto& [name, value] : json.items()) names += (names.empty() ? "" : " ") + name;
  return names;
}

// scripts/tables/speed.py reads these names.
TEST(Ratios, LeaveWhatThePagesNeed) {
  const TemporaryFolder out;
  const auto rows = rows_of({7, 5}, {5, 0.5});
  write_ratios(
      "a",
      {rows, {mean_claim(value("claim-1", "LEO", 35, "value", "1"), "table-1", {"row 0", "row 1"}, rows)}},
      out.path());
  const auto json = nlohmann::ordered_json::parse(read_whole(out / "results" / "ratios" / "a.json"));
  EXPECT_EQ(names_of(json), "processor commit dirty compiler flags allowed_factor rows claims");
  EXPECT_EQ(json["allowed_factor"], 3);
  EXPECT_EQ(names_of(json["rows"][1]), "place row reference printed_seconds seconds verdict");
  EXPECT_EQ(names_of(json["claims"][0]), "place row quantity over verdict");
  const auto& verdict = json["rows"][1]["verdict"];
  EXPECT_EQ(names_of(verdict), "printed reproduced low high apart holds lost same_faster");
  EXPECT_EQ(verdict["apart"], 10);
  EXPECT_EQ(verdict["lost"], true);
}

TEST(SpeedClaims, AreJudgedByMediansAndLeaveWhatThePageNeeds) {
  const std::vector<BenchSeries> all = {{"series", "us a run", {2, 1, 4}}, {"peer", "us a run", {6, 5, 10}}};
  const SpeedResult held = check_claim({"faster", "series", "peer", 3}, all);
  EXPECT_EQ(held.ratio, 3);
  EXPECT_EQ(held.low, 2.5);
  EXPECT_EQ(held.high, 5);
  EXPECT_TRUE(held.held);
  EXPECT_FALSE(check_claim({"faster", "series", "peer", 3.1}, all).held);
  EXPECT_THROW((void)check_claim({"faster", "series", "nobody's", 1}, all), std::invalid_argument);
  const TemporaryFolder out;
  write_bench("a", all, {held}, out.path());
  const auto json = nlohmann::ordered_json::parse(read_whole(out / "results" / "bench" / "a.json"));
  EXPECT_EQ(names_of(json), "processor commit dirty compiler flags claims series");
  EXPECT_EQ(names_of(json["claims"][0]), "claim method peer promised ratio low high held");
  EXPECT_EQ(names_of(json["series"][0]), "name unit median repetitions");
}

}  // namespace
}  // namespace nlmech::scene::ratios_test
