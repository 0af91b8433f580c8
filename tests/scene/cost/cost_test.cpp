/// Digits against cost: Pareto fronts, fastest methods, coloured methods, and labels that are moved apart.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/scene/cost/drawing.hpp"
#include "nlmech/scene/cost/lines.hpp"

namespace nlmech::scene::cost_test {
namespace {

/// Runs with 2 to @p most digits: the first costs @p first seconds, each further digit a factor @p growth
/// more.
MethodLine line(const std::string& method, double first, double growth, int most, std::size_t group = 0,
                Side side = Side::library) {
  MethodLine made{method, group, {}, side};
  double seconds = first;
  for (int digits = 2; digits <= most; ++digits, seconds *= growth)
    made.attempts.push_back({"", "success", std::pow(10, -digits), {seconds, seconds, seconds, 1}});
  return made;
}

/// A cheap method of low order and an expensive one of high order: their fronts cross between six and nine
/// digits.
ProblemLines crossing() {
  return {"", {line("low", 1e-3, 2, 9), line("high", 2e-2, 1.1, 12), line("high, N = 5", 3e-2, 1.1, 12)}};
}

TEST(Rankings, AreThoseOfOtherMethods) {
  const ProblemLines problem = crossing();
  const auto rankings = rankings_of(problem);
  ASSERT_EQ(rankings.size(), asked_digits.size());
  EXPECT_EQ(problem.lines[*rankings[0].first].method, "low");
  EXPECT_EQ(problem.lines[*rankings[0].next].method, "high");
  EXPECT_NEAR(rankings[0].time, 2e-3, 1e-12);
  EXPECT_NEAR(rankings[0].factor, 2e-2 * 1.1 / 2e-3, 1e-9);
  EXPECT_EQ(problem.lines[*rankings[2].first].method, "high");
  EXPECT_EQ(problem.lines[*rankings[2].next].method, "low") << "another form of the first is no other method";
  EXPECT_EQ(problem.lines[*rankings[3].first].method, "high");
  EXPECT_FALSE(rankings[3].next) << "only forms of one method have twelve digits";
  EXPECT_EQ(rankings[3].factor, 0);
}

TEST(Rankings, AreSaidInWords) {
  const ProblemLines problem = crossing();
  const auto rankings = rankings_of(problem);
  EXPECT_EQ(rankings[0].margin(problem), "11 times as fast as high");
  EXPECT_EQ(rankings[3].margin(problem), "alone");
  EXPECT_EQ(fastest_by_digits(problem), "low is fastest at 3 and 6, high at 9 and 12 digits");
  const ProblemLines two = {"", {line("a", 1, 2, 7), line("b", 3, 2, 7)}};
  EXPECT_EQ(rankings_of(two)[1].margin(two), "3.0 times as fast as b");
  EXPECT_EQ(rankings_of(two)[2].margin(two), "no method");
  EXPECT_EQ(fastest_by_digits(two), "a is fastest at 3 and 6 digits");
}

TEST(Rankings, OfEqualsGoToTheFirst) {
  const ProblemLines problem = {"", {line("a", 1, 2, 12), line("b", 1, 2, 12)}};
  for (const Ranking& ranking : rankings_of(problem)) {
    EXPECT_EQ(ranking.first, 0U);
    EXPECT_EQ(ranking.next, 1U);
    EXPECT_DOUBLE_EQ(ranking.factor, 1);
    EXPECT_EQ(ranking.margin(problem), "as fast as b");
  }
}

TEST(Rankings, AreNoneOfAFloor) {
  ProblemLines problem = crossing();
  problem.lines.push_back(line("closed form", 1e-9, 1, 15, 0, Side::floor));
  EXPECT_EQ(fastest_by_digits(problem), "low is fastest at 3 and 6, high at 9 and 12 digits");
  EXPECT_FALSE(rankings_of(problem)[3].next);
}

TEST(Rankings, NeedSomebodyWhoArrives) {
  const ProblemLines alone = {"", {line("a", 1, 2, 12)}};
  EXPECT_EQ(fastest_by_digits(alone), "a is fastest at 3, 6, 9 and 12 digits");
  EXPECT_EQ(rankings_of(alone)[0].margin(alone), "alone");
  for (const ProblemLines& none :
       {ProblemLines{"", {}}, ProblemLines{"", {{"absent", 0, {}}, line("a", 1, 2, 2)}}}) {
    for (const Ranking& ranking : rankings_of(none)) EXPECT_FALSE(ranking.first);
    EXPECT_EQ(fastest_by_digits(none), "no method has three digits");
  }
}

const std::vector<MethodGroup> groups = {{"subject", 0}, {"nlmech", 1}, {"explicit", 3}, {"implicit", 4}};

/// The coloured methods, most important first.
std::vector<std::string> names(const std::vector<ProblemLines>& problems) {
  std::vector<std::string> all;
  for (const InColour& c : foreground(groups, problems)) all.push_back(problems[0].lines[c.line].method);
  return all;
}

/// A dozen methods: more than there are colours.
std::vector<ProblemLines> field() {
  std::vector<ProblemLines> problems = {
      {"",
       {line("slow subject", 9, 2, 12, 0, Side::subject), line("subject", 5, 2, 12, 0, Side::subject),
        line("fast at few digits", 1e-2, 4, 6, 1), line("fast at many digits", 0.1, 1.5, 11, 1),
        line("explicit", 0.2, 3, 12, 2, Side::peer), line("slow explicit", 0.4, 3, 12, 2, Side::peer),
        line("slower explicit", 0.5, 3, 12, 2, Side::peer), line("implicit", 10, 2, 12, 3, Side::peer),
        line("slow implicit", 20, 2, 12, 3, Side::peer)}}};
  for (const char* name : {"bystander 1", "bystander 2", "bystander 3"})
    problems[0].lines.push_back(line(name, 100, 3, 8, 1));
  problems[0].lines.push_back({"failing", 1, {{"", "failed", {}, {}}}, Side::subject});
  problems[0].lines.push_back({"absent", 3, {}, Side::peer});
  return problems;
}

TEST(Foreground, IsTheBestOfEachKindAndWhoeverLeads) {
  EXPECT_EQ(names(field()), (std::vector<std::string>{"subject", "explicit", "implicit", "fast at few digits",
                                                      "fast at many digits"}));
}

TEST(Foreground, HasTheColourOfTheGroupWhereItIsFree) {
  const auto problems = field();
  std::set<std::size_t> colours;
  for (const InColour& c : foreground(groups, problems)) {
    const MethodLine& l = problems[0].lines[c.line];
    EXPECT_TRUE(colours.insert(c.colour).second) << l.method << " shares its colour";
    const bool of_ours = l.method == "fast at many digits" || l.method == "fast at few digits";
    EXPECT_TRUE(of_ours || c.colour == groups[l.group].colour) << l.method;
  }
  EXPECT_TRUE(colours.contains(1)) << "one of the two of nlmech";
}

TEST(Foreground, IsAllOfAFew) {
  const std::vector<ProblemLines> few = {
      {"", {line("a", 1, 2, 5), line("b", 2, 2, 5), {"absent", 0, {}}, line("c", 3, 2, 5)}}};
  auto all = names(few);
  std::ranges::sort(all);
  EXPECT_EQ(all, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(names({{"", {line("a", 1, 2, 5)}}}), std::vector<std::string>{"a"});
  EXPECT_TRUE(names({{"", {{"absent", 0, {}}}}}).empty());
  EXPECT_TRUE(foreground(groups, {}).empty());
}

TEST(Foreground, IsNeverMoreThanThereAreColours) {
  std::vector<ProblemLines> many = {{"", {}}};
  for (int digits = 2; digits <= 15; ++digits)  // each is the fastest for its number of digits
    many[0].lines.push_back(line("m" + std::to_string(digits), 0.1 * digits, 1.01, digits, 1));
  EXPECT_EQ(names(many).size(), method_styles.size());
}

// In either problem another method is the best of its kind; in the second one by more digits.
TEST(Foreground, CountsAllProblemsTogether) {
  auto problems = field();
  problems.push_back(problems[0]);
  problems[1].lines[4] = line("explicit", 0.9, 3, 4, 2, Side::peer);
  problems[1].lines[5] = line("slow explicit", 0.4, 3, 14, 2, Side::peer);
  const auto all = names(problems);
  EXPECT_EQ(all[1], "slow explicit");
}

TEST(Foreground, CountsDigitsOnTheOrdinateAlone) {
  auto problems = field();
  problems[0].lines[4] =
      line("explicit", 0.01, 3, 9, 2, Side::peer);  // faster, but with fewer digits at most
  const auto best = [&](double least) {
    return problems[0].lines[foreground(groups, problems, least)[1].line].method;
  };
  EXPECT_EQ(best(0), "explicit");
  EXPECT_EQ(best(8), "slow explicit") << "nine digits against ten, eleven and twelve";
}

// ---- Digits against run time: runs, and the Pareto front through them.

Attempt run(std::optional<double> error, double seconds) {
  return {"", "", error, {seconds, seconds, seconds, 1}};
}

TEST(Attempts, HaveDigitsIfTheirErrorIsANumber) {
  EXPECT_DOUBLE_EQ(*run(1e-7, 1).digits(), 7);
  EXPECT_DOUBLE_EQ(*run(100, 1).digits(), -2);
  EXPECT_DOUBLE_EQ(*run(0, 1).digits(), 53 * std::log10(2)) << "half an epsilon is all that a double has";
  EXPECT_FALSE(run({}, 1).digits());
  EXPECT_FALSE(run(NAN, 1).digits());
  EXPECT_FALSE(run(HUGE_VAL, 1).digits());
}

TEST(MethodLines, HaveABestAttempt) {
  const MethodLine line{"a, N = 3", 0, {run({}, 1), run(1e-3, 1), run(1e-5, 2), run(1e-4, 3), run(NAN, 4)}};
  EXPECT_EQ(line.best(), &line.attempts[2]);
  EXPECT_EQ(line.least_error(), 1e-5);
  EXPECT_EQ(line.family(), "a");
  const MethodLine failing{"b", 0, {run({}, 1)}}, absent{"c", 0, {}};
  EXPECT_EQ(failing.best(), nullptr);
  EXPECT_EQ(failing.least_error(), HUGE_VAL);
  EXPECT_EQ(absent.best(), nullptr);
  EXPECT_EQ(absent.family(), "c");
}

TEST(MethodLines, AreFoundByName) {
  const ProblemLines problem{"", {{"one", 0, {}}, {"two", 0, {run(1e-7, 1)}}}};
  EXPECT_EQ(problem.of("two").least_error(), 1e-7);
  EXPECT_THROW((void)problem.of("three"), std::out_of_range);
}

// Between 1e-2 s at 4 digits and 1 s at 8, six digits take the geometric mean.
TEST(AFront, IsStraightInTheLogarithmOfTime) {
  const Front front({"", 0, {run(1e-4, 1e-2), run(1e-8, 1)}});
  EXPECT_NEAR(*front.time(6), 0.1, 1e-15);
  EXPECT_NEAR(*front.time(5), std::pow(10, -1.5), 1e-15);
  EXPECT_DOUBLE_EQ(*front.time(1), 1e-2) << "the cheapest run gives fewer digits as well";
  EXPECT_DOUBLE_EQ(*front.time(8), 1) << "whatever the logarithm of 1e-8 is rounded to";
  EXPECT_FALSE(front.time(8.1)) << "no run has so many";
}

// A run that another one dominates in both is not on the front; the front increases for any order of runs.
TEST(AFront, IsMonotone) {
  const Front front(
      {"", 0, {run(1e-9, 4), run(1e-3, 0.5), run(1e-6, 5), run(1e-5, 1), run({}, 0.1), run(1e-2, 0.7)}});
  EXPECT_DOUBLE_EQ(*front.time(2), 0.5) << "1e-2 in 0.7 s loses to 1e-3 in 0.5 s";
  EXPECT_LT(*front.time(6), 4) << "1e-6 in 5 s loses to 1e-9 in 4 s";
  double before = 0;
  for (double digits = 0; digits <= 9; digits += 0.125) {
    const auto time = front.time(digits);
    ASSERT_TRUE(time) << digits;
    EXPECT_GE(*time, before) << digits;
    before = *time;
  }
}

TEST(AFront, HasNothingOfRunsWithoutDigitsOrTime) {
  EXPECT_FALSE(Front({"", 0, {}}).time(0));
  EXPECT_FALSE(Front({"", 0, {run({}, 1), run(NAN, 1), run(1e-9, 0), run(1e-9, NAN)}}).time(0));
  const Front one({"", 0, {run(1e-3, 2)}});
  EXPECT_DOUBLE_EQ(*one.time(0), 2);
  EXPECT_DOUBLE_EQ(*one.time(3), 2);
  EXPECT_FALSE(one.time(4));
}

// ---- Labels that are moved apart: gaps, order, range, and smallest displacement.

using Places = std::vector<double>;

TEST(Spread, LeavesAloneWhatHasRoom) {
  EXPECT_EQ(spread({3, 1, 7}, 2, 0, 10), (Places{3, 1, 7}));
  EXPECT_EQ(spread({4}, 2, 0, 10), Places{4});
  EXPECT_TRUE(spread({}, 2, 0, 10).empty());
}

TEST(Spread, MovesNeighboursApartByTheSame) {
  EXPECT_EQ(spread({5, 5}, 2, 0, 10), (Places{4, 6}));
  EXPECT_EQ(spread({5, 4, 9}, 2, 0, 10), (Places{5.5, 3.5, 9}));
  EXPECT_EQ(spread({5, 5, 5}, 2, 0, 10), (Places{3, 5, 7})) << "of equals the first is the lowest";
}

TEST(Spread, StaysInItsRange) {
  EXPECT_EQ(spread({10, 10, 10}, 2, 0, 10), (Places{6, 8, 10}));
  EXPECT_EQ(spread({-3, 0}, 2, 0, 10), (Places{0, 2}));
  EXPECT_EQ(spread({5, 5, 5, 5, 5}, 4, 0, 10), (Places{0, 2.5, 5, 7.5, 10})) << "too many for the gap";
}

RC_GTEST_PROP(Spread, KeepsOrderGapAndRange, (const std::vector<int>& drawn)) {
  constexpr double gap = 3, low = -50, high = 250, rounding = 1e-9;
  Places wanted;
  for (const int x : drawn) wanted.push_back(x % 300);
  const Places places = spread(wanted, gap, low, high);
  RC_ASSERT(places.size() == wanted.size());
  const double least =
      std::min(gap, wanted.size() > 1 ? (high - low) / static_cast<double>(wanted.size() - 1) : gap);
  for (std::size_t i = 0; i < places.size(); ++i) {
    RC_ASSERT(places[i] >= low - rounding && places[i] <= high + rounding);
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (wanted[i] < wanted[k]) RC_ASSERT(places[k] - places[i] >= least - rounding);
    }
  }
}

}  // namespace
}  // namespace nlmech::scene::cost_test
