#include "nlmech/scene/scene.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/support/errors.hpp"

namespace nlmech::scene::scene_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table one_row() {
  Table table({{"x"}});
  table.add({1.0});
  return table;
}
Table no_row() { return Table({{"x"}}); }
Scene named(const char* name) { return {.name = name, .title = ""}; }
Quantity check_of_one() { return {"x", "1", 1, 1, 1, "by definition"}; }

/// A scene without results that comes out as @p showing.
Scene that_shows(const Showing& showing) {
  Scene scene = named("fig-1");
  scene.content.show = [showing](Results&) { return showing; };
  return scene;
}
std::string complaint(const Scene& scene) {
  try {
    Results results(false);
    static_cast<void>(perform(scene, results));
    return "";
  } catch (const std::logic_error& error) {
    return error.what();
  }
}

const Result base("base", "", [] { return 1; });
const Result derived(
    "derived", "", [](int b) { return b + 1; }, base);
const Result also("also", "", [] { return 7; });

TEST(Perform, GivesWhatIsShownAndAllRunsBehindIt) {
  const Scene scene{.name = "fig-1",
                    .title = "",
                    .content = Content(
                        [](int d, int a, Show& show) {
                          show.table(std::vector{d, a}, {{"x", [](int x) { return x; }}});
                          show.equals("sum", d + a, 9, "by definition");
                        },
                        derived, also)};
  Results results(false);
  const Performance performance = perform(scene, results);
  ASSERT_TRUE(performance.showing.table);
  EXPECT_EQ(performance.showing.table->csv(), "x\n2\n7\n");
  std::vector<std::string> names;
  for (const AnyRun* run : performance.runs) names.push_back(run->name());
  EXPECT_EQ(names, (std::vector<std::string>{"also", "base", "derived"})) << "sorted by name";
}

TEST(Perform, RefusesASceneThatShowsNothing) {
  const std::string nothing = "scene fig-1 shows nothing";
  const auto shows = [](const Showing& showing) { return complaint(that_shows(showing)); };
  EXPECT_EQ(shows({std::nullopt, std::nullopt, {check_of_one()}}), nothing);
  EXPECT_EQ(shows({std::nullopt, no_row(), {check_of_one()}}), nothing);
  EXPECT_EQ(shows({Figure{no_row(), "line", {}}, std::nullopt, {check_of_one()}}), nothing);
  EXPECT_EQ(shows({Figure{no_row(), "line", {}}, one_row(), {check_of_one()}}),
            "scene fig-1 has an empty figure");
  EXPECT_EQ(shows({Figure{one_row(), "line", {}}, no_row(), {check_of_one()}}),
            "scene fig-1 has an empty table");
  EXPECT_EQ(shows({Figure{one_row(), "line", {}}, std::nullopt, {check_of_one()}}), "");
  EXPECT_EQ(shows({std::nullopt, one_row(), {check_of_one()}}), "");
}

TEST(Perform, RefusesASceneThatChecksNothing) {
  EXPECT_EQ(complaint(that_shows({std::nullopt, one_row(), {}})), "scene fig-1 checks no quantity");
}

TEST(Perform, PassesOnAFailure) {
  Scene fails = named("fig-1");
  fails.content.show = [](Results&) -> Showing { throw Failure("no convergence"); };
  Results results(false);
  EXPECT_THROW(static_cast<void>(perform(fails, results)), Failure);
}

TEST(Result, KnowsItsNameReadingAndNeeds) {
  EXPECT_EQ(derived.run()->name(), "derived");
  EXPECT_EQ(Result("x", "as printed", [] { return 1; }).run()->reading(), "as printed");
  EXPECT_EQ(derived.run()->needs(), AnyRun::List{base.run()});
}

TEST(Results, AreComputedOnceUnderTheirName) {
  int calls = 0;
  const auto count = [&calls] { return ++calls; };
  const Result first("count", "as printed", count), same("count", "as printed", count);
  Results results(true);
  EXPECT_EQ(results.get(*first.run()), 1);
  EXPECT_EQ(results.get(*same.run()), 1) << "equal name and reading: the same result";
  EXPECT_EQ(calls, 1);
}

TEST(Results, OfOneNameHaveOneReadingAndOneType) {
  const Result printed("count", "as printed", [] { return 1; }),
      inferred("count", "inferred", [] { return 1; });
  const Result real("count", "as printed", [] { return 1.0; });
  Results results(true);
  EXPECT_EQ(results.get(*printed.run()), 1);
  EXPECT_THROW(static_cast<void>(results.get(*inferred.run())), std::logic_error);
  EXPECT_THROW(static_cast<void>(results.get(*real.run())), std::logic_error);
}

TEST(Results, GoOnAfterARunThatFailed) {
  const Result fails("fails", "", []() -> int { throw Failure("no convergence"); });
  Results results(true);
  EXPECT_THROW(static_cast<void>(results.get(*fails.run())), Failure);
  EXPECT_EQ(results.get(*derived.run()), 2);
  EXPECT_THROW(static_cast<void>(results.get(*fails.run())), Failure) << "it has no result now either";
}

TEST(Results, TellWhetherLessIsAskedFor) {
  const Result samples("samples", "", [](bool quick) { return quick ? 10 : 1000; });
  Results quick(true), full(false);
  EXPECT_EQ(quick.get(*samples.run()), 10);
  EXPECT_EQ(full.get(*samples.run()), 1000);
}

/// Does the value pass the check that a scene of nothing else makes by @p make?
template <class Make>
bool passes(const Make& make) {
  Show show(false);
  make(show);
  return show.take().quantities.front().passes();
}

TEST(Quantity, NearTakesItsMarginFromTheKnownValue) {
  const auto near = [](double value, double known, double relative) {
    return passes([=](Show& show) { show.near("height", {value, "m"}, known, relative, "Table 1"); });
  };
  EXPECT_TRUE(near(-102, -100, 0.02)) << "the ends belong to the range";
  EXPECT_FALSE(near(-102.001, -100, 0.02));
  EXPECT_FALSE(near(100, -100, 0.02));
  EXPECT_TRUE(near(6, 6, 0));
  EXPECT_FALSE(near(7, 6, 0));
  EXPECT_FALSE(near(nan, 1, 1));
  EXPECT_FALSE(near(1, nan, 1));
}

TEST(Quantity, AtMostBeginsAtZero) {
  const auto at_most = [](double value, double bound) {
    return passes([=](Show& show) { show.at_most("error", {value, "m"}, bound, ""); });
  };
  EXPECT_TRUE(at_most(0, 1));
  EXPECT_TRUE(at_most(1, 1));
  EXPECT_FALSE(at_most(1.1, 1));
  EXPECT_FALSE(at_most(-1, 1)) << "a magnitude is never negative";
  EXPECT_FALSE(at_most(nan, 1));
}

TEST(Chapter, KeepsScenesInTheirOrder) {
  const Chapter chapter("optics", "Light", {{named("fig-2")}, {named("fig-1")}});
  EXPECT_EQ(chapter.scenes().at(0).name, "fig-2");
  EXPECT_EQ(&chapter.scene("fig-1"), &chapter.scenes().at(1));
  EXPECT_EQ(chapter.name(), "optics");
  EXPECT_EQ(chapter.title(), "Light");
}

TEST(Chapter, NamesTheScenesThereAre) {
  const Chapter chapter("optics", "Light", {{named("fig-1"), named("fig-2")}});
  try {
    static_cast<void>(chapter.scene("fig-3"));
    FAIL() << "found a scene that is not there";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "optics has no scene 'fig-3'; it has fig-1, fig-2");
  }
}

TEST(Chapter, RefusesTheSameNameTwice) {
  EXPECT_THROW(Chapter("optics", "Light", {{named("fig-1")}, {named("fig-1")}}), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::scene::scene_test
