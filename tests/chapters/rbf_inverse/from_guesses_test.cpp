/// What the printed method makes of its guesses: how results are counted and chosen, and that a figure
/// computes no more than it draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/chapter.hpp"
#include "chapters/rbf_inverse/scenes.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using bvp::DuffingCase;

/// A result as the printed method ends: an extremal of some cost, a spurious root, or neither.
bvp::GlobalResult ended(Outcome outcome, double cost = 0) {
  bvp::GlobalResult r;
  if (outcome != Outcome::success) r.extremal.solution.status = Status::failure(outcome, "for a test");
  r.extremal.cost = cost;
  return r;
}

TEST(FromGuesses, CountsAndPicks) {
  const FromGuesses all = {ended(Outcome::spurious_root, 1), ended(Outcome::success, 7),
                           ended(Outcome::success, 3),       ended(Outcome::newton_diverged),
                           ended(Outcome::success, 7.01),    ended(Outcome::success, 70)};
  EXPECT_EQ(drawn_of(all), 1U);
  const GuessCounts counts = count_of(all, 3);
  EXPECT_EQ(counts.good, 4);
  EXPECT_EQ(counts.cheapest, 1);
  EXPECT_EQ(counts.spurious, 1);
  const auto some = distinct_of(all);  // 7 and 7.01 are one extremal
  ASSERT_EQ(some.size(), 3U);
  EXPECT_EQ(some[0]->cost, 3);
  EXPECT_EQ(some[1]->cost, 7);
  EXPECT_EQ(some[2]->cost, 70);
}

TEST(FromGuesses, NoExtremalIsAFailure) {
  EXPECT_THROW(static_cast<void>(drawn_of({ended(Outcome::spurious_root)})), Failure);
}

TEST(FromGuesses, NothingFoundIsNothing) {
  const FromGuesses none = {ended(Outcome::spurious_root), ended(Outcome::newton_diverged)};
  EXPECT_TRUE(distinct_of(none).empty());
  EXPECT_EQ(count_of(none, 1).good, 0);
  EXPECT_EQ(count_of(none, 1).spurious, 1);
}

/// Names of what a scene asks for, sorted.
std::set<std::string> needs_of(const scene::Chapter& chapter, const std::string& name) {
  std::set<std::string> names;
  for (const scene::AnyRun* run : chapter.scene(name).needs) names.insert(run->name());
  return names;
}

// The workshop lets through only what a scene declares, so these lists are all that is computed.
TEST(FromGuesses, FiguresNeedOneCaseAtOneTime) {
  const scene::Chapter chapter = rbf_inverse_chapter();
  for (const DuffingSubject& s : duffing_subjects()) {
    const std::string which(to_string(s.which));
    EXPECT_EQ(needs_of(chapter, "fig-5." + std::to_string(s.figure)),
              (std::set<std::string>{"extremals-" + which + "-T2", "printed-" + which + "-T2"}));
    for (const int k : {s.figure + 1, s.figure + 2})
      EXPECT_EQ(needs_of(chapter, "fig-5." + std::to_string(k)), std::set<std::string>{"variants-" + which});
  }
}

/// Processor seconds of this process, however many others run.
template <class Work>
double processor_time(const Work& work) {
  const std::clock_t begin = std::clock();
  work();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// Of the two runs that Figure 5.1 draws, by themselves.
double time_of_runs() {
  scene::Chapter chapter("a", "runs alone");
  const DuffingRuns runs = add_duffing_runs(chapter);
  const auto& found = run_of(runs.extremals, DuffingCase::free);
  const auto& printed = run_of(runs.printed, DuffingCase::free);
  scene::Workshop workshop(true);
  workshop.open("alone", {&found, &printed});
  return processor_time([&] {
    static_cast<void>(workshop.result(found));
    static_cast<void>(workshop.result(printed));
  });
}

/// Of the figure, with nothing computed before.
double time_of_figure(std::vector<std::string>& used) {
  scene::Chapter chapter("b", "a figure");
  const DuffingRuns runs = add_duffing_runs(chapter);
  add_duffing_histories(chapter, runs);
  scene::Workshop workshop(true);
  const double seconds =
      processor_time([&] { static_cast<void>(perform(chapter.scene("fig-5.1"), workshop)); });
  used = workshop.used();
  return seconds;
}

// All cases at all final times would take twenty times as long.
TEST(FromGuesses, FigureTakesTheTimeOfItsRuns) {
  double alone = time_of_runs(), figure = HUGE_VAL;
  std::vector<std::string> used;
  for (int k = 0; k < 3; ++k) {  // the least of three: caches, and neighbours on the same core
    figure = std::min(figure, time_of_figure(used));
    alone = std::max(alone, time_of_runs());
  }
  EXPECT_EQ(used, (std::vector<std::string>{"extremals-free-T2", "printed-free-T2"}));
  EXPECT_LE(figure, 1.5 * alone + 0.05) << "processor seconds";
  RecordProperty("figure", std::to_string(figure));
  RecordProperty("alone", std::to_string(alone));
}

}  // namespace
}  // namespace nlmech::chapters
