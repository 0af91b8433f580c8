/// Results of the printed method from its guesses: how they are counted and selected; a figure computes only
/// the results that it draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_inverse {

scene::Chapter chapter();
namespace histories_control {
std::vector<scene::Scene> scenes();
}

}  // namespace nlmech::chapters::rbf_inverse

namespace nlmech::chapters::rbf_inverse::from_guesses_test {
namespace {

using bvp::DuffingCase;

/// The cheapest extremal of the free case at T = 2 costs 8.9.
FromGuesses guesses(std::vector<bvp::GlobalResult> results) {
  return {&duffing_subjects().front(), 2, std::move(results)};
}

/// A result of the printed method: an extremal with a cost, a spurious root, or neither.
bvp::GlobalResult ended(Outcome outcome, double cost = 0) {
  bvp::GlobalResult r;
  if (outcome != Outcome::success) r.extremal.solution.status = Status::failure(outcome, "for a test");
  r.extremal.cost = cost;
  return r;
}

TEST(FromGuesses, CountsAndPicks) {
  const FromGuesses all = guesses({ended(Outcome::spurious_root, 1), ended(Outcome::success, 17),
                                   ended(Outcome::success, 8.95), ended(Outcome::newton_diverged),
                                   ended(Outcome::success, 17.01), ended(Outcome::success, 170)});
  EXPECT_EQ(all.chosen(), 1U);
  EXPECT_EQ(all.drawn().extremal.cost, 17);
  const GuessCounts counts = all.counts();
  EXPECT_EQ(counts.good, 4);
  EXPECT_EQ(counts.cheapest, 1);
  EXPECT_EQ(counts.spurious, 1);
  EXPECT_EQ(counts.failed, 1);
  const auto some = all.distinct();  // 17 and 17.01 are one extremal
  ASSERT_EQ(some.size(), 3U);
  EXPECT_EQ(some[0]->cost, 8.95);
  EXPECT_EQ(some[1]->cost, 17);
  EXPECT_EQ(some[2]->cost, 170);
}

TEST(FromGuesses, NoExtremalIsAFailure) {
  EXPECT_THROW(static_cast<void>(guesses({ended(Outcome::spurious_root)}).chosen()), Failure);
}

TEST(FromGuesses, NothingFoundIsNothing) {
  const FromGuesses none = guesses({ended(Outcome::spurious_root), ended(Outcome::newton_diverged)});
  EXPECT_TRUE(none.distinct().empty());
  EXPECT_EQ(none.counts().good, 0);
  EXPECT_EQ(none.counts().spurious, 1);
}

/// Names of the results that a scene uses, sorted.
std::set<std::string> needs_of(const scene::Chapter& all, const std::string& name) {
  std::set<std::string> names;
  for (const auto& run : all.scene(name).content.needs) names.insert(run->name());
  return names;
}

// A scene receives the results of these runs only.
TEST(FromGuesses, FiguresNeedOneCaseAtOneTime) {
  const scene::Chapter all = chapter();
  for (const DuffingSubject& s : duffing_subjects()) {
    const std::string which(to_string(s.which));
    EXPECT_EQ(needs_of(all, "fig-5." + std::to_string(s.figure)),
              (std::set<std::string>{"extremals-" + which + "-T2", "printed-" + which + "-T2"}));
    for (const int k : {s.figure + 1, s.figure + 2})
      EXPECT_EQ(needs_of(all, "fig-5." + std::to_string(k)), std::set<std::string>{"variants-" + which});
  }
}

/// Processor time of this process, s.
template <class Work>
double processor_time(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Time of the two results that Figure 5.1 draws.
double time_of_results() {
  const auto found = extremals(DuffingCase::free).run();
  const auto printed = printed_results(duffing_subjects().front()).run();
  scene::Results results(true);
  return processor_time([&] {
    static_cast<void>(results.get(*found));
    static_cast<void>(results.get(*printed));
  });
}

/// Time of the figure without earlier results.
double time_of_figure(std::vector<std::string>& used) {
  const scene::Chapter figures("b", "figures", {histories_control::scenes()});
  scene::Results results(true);
  return processor_time([&] {
    used.clear();
    for (const scene::AnyRun* run : perform(figures.scene("fig-5.1"), results).runs)
      used.push_back(run->name());
  });
}

// All cases at all final times would take twenty times as long.
TEST(FromGuesses, FigureTakesTheTimeOfItsResults) {
  double alone = time_of_results(), figure = HUGE_VAL;
  std::vector<std::string> used;
  for (int k = 0; k < 3; ++k) {  // the minimum of three: caches, and other processes on the same core
    figure = std::min(figure, time_of_figure(used));
    alone = std::max(alone, time_of_results());
  }
  EXPECT_EQ(used, (std::vector<std::string>{"extremals-free-T2", "printed-free-T2"}));
  EXPECT_LE(figure, 1.5 * alone + 0.05) << "processor seconds";
  RecordProperty("figure", std::to_string(figure));
  RecordProperty("alone", std::to_string(alone));
}

}  // namespace
}  // namespace nlmech::chapters::rbf_inverse::from_guesses_test
