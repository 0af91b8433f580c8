/// Who is fastest and what is in colour: by the data, with ties, failures and methods alone.
#include "nlmech/scene/cost/leads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace nlmech::scene::leads_test {
namespace {

/// Runs of 2 to @p most digits, that cost @p first seconds and @p growth times more for each further digit.
MethodLine line(const std::string& method, double first, double growth, int most, std::size_t group = 0,
                Side side = Side::ours) {
  MethodLine made{method, group, {}, side};
  double seconds = first;
  for (int digits = 2; digits <= most; ++digits, seconds *= growth)
    made.attempts.push_back({"", "success", std::pow(10, -digits), {seconds, seconds, seconds, 1}});
  return made;
}

/// Cheap and of low order, dear and of high order: they meet between six and nine digits.
ProblemLines crossing() {
  return {"", {line("low", 1e-3, 2, 9), line("high", 2e-2, 1.1, 12), line("high, N = 5", 3e-2, 1.1, 12)}};
}

TEST(Leads, AreThoseOfOtherMethods) {
  const ProblemLines problem = crossing();
  const auto leads = leads_of(problem);
  ASSERT_EQ(leads.size(), asked_digits.size());
  EXPECT_EQ(problem.lines[*leads[0].first].method, "low");
  EXPECT_EQ(problem.lines[*leads[0].next].method, "high");
  EXPECT_NEAR(leads[0].time, 2e-3, 1e-12);
  EXPECT_NEAR(leads[0].factor, 2e-2 * 1.1 / 2e-3, 1e-9);
  EXPECT_EQ(problem.lines[*leads[2].first].method, "high");
  EXPECT_EQ(problem.lines[*leads[2].next].method, "low") << "another form of the first is no other method";
  EXPECT_EQ(problem.lines[*leads[3].first].method, "high");
  EXPECT_FALSE(leads[3].next) << "only forms of one method have twelve digits";
  EXPECT_EQ(leads[3].factor, 0);
}

TEST(Leads, AreSaidInWords) {
  const ProblemLines problem = crossing();
  const auto leads = leads_of(problem);
  EXPECT_EQ(leads[0].margin(problem), "11 times before high");
  EXPECT_EQ(leads[3].margin(problem), "alone");
  EXPECT_EQ(who_leads(problem), "low is fastest at 3 and 6, high at 9 and 12 digits");
  const ProblemLines two = {"", {line("a", 1, 2, 7), line("b", 3, 2, 7)}};
  EXPECT_EQ(leads_of(two)[1].margin(two), "3.0 times before b");
  EXPECT_EQ(leads_of(two)[2].margin(two), "nobody");
  EXPECT_EQ(who_leads(two), "a is fastest at 3 and 6 digits");
}

TEST(Leads, OfEqualsGoToTheFirst) {
  const ProblemLines problem = {"", {line("a", 1, 2, 12), line("b", 1, 2, 12)}};
  for (const Lead& lead : leads_of(problem)) {
    EXPECT_EQ(lead.first, 0U);
    EXPECT_EQ(lead.next, 1U);
    EXPECT_DOUBLE_EQ(lead.factor, 1);
    EXPECT_EQ(lead.margin(problem), "level with b");
  }
}

TEST(Leads, AreNoneOfAFloor) {
  ProblemLines problem = crossing();
  problem.lines.push_back(line("closed form", 1e-9, 1, 15, 0, Side::floor));
  EXPECT_EQ(who_leads(problem), "low is fastest at 3 and 6, high at 9 and 12 digits");
  EXPECT_FALSE(leads_of(problem)[3].next);
}

TEST(Leads, NeedSomebodyWhoArrives) {
  const ProblemLines alone = {"", {line("a", 1, 2, 12)}};
  EXPECT_EQ(who_leads(alone), "a is fastest at 3, 6, 9 and 12 digits");
  EXPECT_EQ(leads_of(alone)[0].margin(alone), "alone");
  for (const ProblemLines& none :
       {ProblemLines{"", {}}, ProblemLines{"", {{"absent", 0, {}}, line("a", 1, 2, 2)}}}) {
    for (const Lead& lead : leads_of(none)) EXPECT_FALSE(lead.first);
    EXPECT_EQ(who_leads(none), "no method has three digits");
  }
}

const std::vector<MethodGroup> groups = {{"subject", 0}, {"ours", 1}, {"explicit", 3}, {"implicit", 4}};

/// Methods in colour, in the order of importance.
std::vector<std::string> names(const std::vector<ProblemLines>& problems) {
  std::vector<std::string> all;
  for (const InColour& c : foreground(groups, problems)) all.push_back(problems[0].lines[c.line].method);
  return all;
}

/// A dozen methods: too many for all to be in colour.
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
  EXPECT_TRUE(colours.contains(1)) << "one of the two of ours";
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
  for (int digits = 2; digits <= 15; ++digits)  // each the fastest for its digits
    many[0].lines.push_back(line("m" + std::to_string(digits), 0.1 * digits, 1.01, digits, 1));
  EXPECT_EQ(names(many).size(), method_looks.size());
}

// On either problem the other method is the best of its kind, on the second by more digits.
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
      line("explicit", 0.01, 3, 9, 2, Side::peer);  // ahead, and at its end before the other
  const auto best = [&](double least) {
    return problems[0].lines[foreground(groups, problems, least)[1].line].method;
  };
  EXPECT_EQ(best(0), "explicit");
  EXPECT_EQ(best(8), "slow explicit") << "nine digits against ten, eleven and twelve";
}

}  // namespace
}  // namespace nlmech::scene::leads_test
