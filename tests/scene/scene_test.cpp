#include "nlmech/scene/scene.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "nlmech/support/errors.hpp"

namespace nlmech::scene {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table one_row() {
  Table table({{"x"}});
  table.add({1.0});
  return table;
}
Table no_row() { return Table({{"x"}}); }
Scene named(const char* name) { return {.name = name, .title = "", .place = "", .needs = {}, .show = {}}; }
Quantity promise() { return near("x", "1", 1, 1, 0, "by definition"); }

/// Runs of a little chapter, and scenes made from what they show.
class Perform : public ::testing::Test {
 protected:
  Scene a_scene(std::vector<const AnyRun*> needs, std::function<Showing(Workshop&)> show) {
    return {.name = "fig-1",
            .title = "A figure",
            .place = "Figure 1",
            .needs = std::move(needs),
            .show = std::move(show)};
  }
  std::string complaint(const Scene& scene) {
    try {
      static_cast<void>(perform(scene, workshop_));
      return "";
    } catch (const std::logic_error& error) {
      return error.what();
    }
  }

  scene::Run<int> base_{"base", "", {}, [](Workshop&) { return 1; }};
  scene::Run<int> derived_{"derived", "", {&base_}, [this](Workshop& w) { return w.result(base_) + 1; }};
  scene::Run<int> also_{"also", "", {}, [](Workshop&) { return 1; }};
  Workshop workshop_{false};
};

TEST_F(Perform, GivesWhatIsShownAndAllRunsBehindIt) {
  const Performance performance = perform(a_scene({&derived_, &also_},
                                                  [&](Workshop& w) {
                                                    static_cast<void>(w.result(also_) + w.result(derived_));
                                                    return Showing{std::nullopt, one_row(), {promise()}};
                                                  }),
                                          workshop_);
  EXPECT_TRUE(performance.showing.table);
  EXPECT_EQ(performance.runs, (std::vector<const AnyRun*>{&also_, &base_, &derived_})) << "sorted by name";
}

TEST_F(Perform, RefusesASceneThatShowsNothing) {
  const std::string nothing = "scene fig-1 shows nothing";
  const auto shows = [&](const Showing& showing) {
    return complaint(a_scene({}, [showing](Workshop&) { return showing; }));
  };
  EXPECT_EQ(shows({std::nullopt, std::nullopt, {promise()}}), nothing);
  EXPECT_EQ(shows({std::nullopt, no_row(), {promise()}}), nothing);
  EXPECT_EQ(shows({Figure{no_row(), "line", {}}, std::nullopt, {promise()}}), nothing);
  EXPECT_EQ(shows({Figure{one_row(), "line", {}}, std::nullopt, {promise()}}), "");
  EXPECT_EQ(shows({std::nullopt, one_row(), {promise()}}), "");
}

TEST_F(Perform, RefusesASceneThatChecksNothing) {
  EXPECT_EQ(complaint(a_scene({},
                              [](Workshop&) {
                                return Showing{std::nullopt, one_row(), {}};
                              })),
            "scene fig-1 checks no quantity");
}

TEST_F(Perform, RefusesARunThatIsDeclaredAndNotUsed) {
  EXPECT_EQ(complaint(a_scene({&base_, &also_},
                              [&](Workshop& w) {
                                static_cast<void>(w.result(base_));
                                return Showing{std::nullopt, one_row(), {promise()}};
                              })),
            "scene fig-1 declares run also and does not use it");
}

TEST_F(Perform, RefusesARunThatIsUsedAndNotDeclared) {
  EXPECT_EQ(complaint(a_scene({},
                              [&](Workshop& w) {
                                static_cast<void>(w.result(base_));
                                return Showing{std::nullopt, one_row(), {promise()}};
                              })),
            "fig-1 uses run base without declaring it");
}

TEST_F(Perform, PassesOnAFailure) {
  const Scene fails = a_scene({}, [](Workshop&) -> Showing { throw Failure("no convergence"); });
  EXPECT_THROW(static_cast<void>(perform(fails, workshop_)), Failure);
}

TEST(Quantity, NearTakesItsMarginFromTheReference) {
  const Quantity q = near("height", "m", -102, -100, 0.02, "Table 1");
  EXPECT_EQ(q.low, -102);
  EXPECT_EQ(q.high, -98);
  EXPECT_TRUE(q.kept()) << "the ends belong to the range";
  EXPECT_FALSE(near("height", "m", -102.001, -100, 0.02, "").kept());
  EXPECT_FALSE(near("height", "m", 100, -100, 0.02, "").kept());
  EXPECT_TRUE(near("count", "1", 6, 6, 0, "").kept());
  EXPECT_FALSE(near("count", "1", 7, 6, 0, "").kept());
}

TEST(Quantity, AtMostBeginsAtZero) {
  EXPECT_TRUE(at_most("error", "m", 0, 1, "").kept());
  EXPECT_TRUE(at_most("error", "m", 1, 1, "").kept());
  EXPECT_FALSE(at_most("error", "m", 1.1, 1, "").kept());
  EXPECT_FALSE(at_most("error", "m", -1, 1, "").kept()) << "a magnitude is never negative";
}

TEST(Quantity, IsNeverKeptByNaN) {
  EXPECT_FALSE(near("x", "1", nan, 1, 1, "").kept());
  EXPECT_FALSE(near("x", "1", 1, nan, 1, "").kept());
  EXPECT_FALSE(at_most("x", "1", nan, 1, "").kept());
}

TEST(Chapter, KeepsScenesInTheirOrder) {
  Chapter chapter("optics", "Light");
  for (const char* name : {"fig-2", "fig-1"}) chapter.add(named(name));
  EXPECT_EQ(chapter.scenes().at(0).name, "fig-2");
  EXPECT_EQ(&chapter.scene("fig-1"), &chapter.scenes().at(1));
  EXPECT_EQ(chapter.name(), "optics");
  EXPECT_EQ(chapter.title(), "Light");
}

TEST(Chapter, NamesTheScenesThereAre) {
  Chapter chapter("optics", "Light");
  for (const char* name : {"fig-1", "fig-2"}) chapter.add(named(name));
  try {
    static_cast<void>(chapter.scene("fig-3"));
    FAIL() << "found a scene that is not there";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "optics has no scene 'fig-3'; it has fig-1, fig-2");
  }
}

TEST(Chapter, RefusesTheSameNameTwice) {
  Chapter chapter("optics", "Light");
  const auto compute = [](Workshop&) { return 1; };
  chapter.add(named("fig-1"));
  chapter.add(Measurement{"source/table-1/a/b", {}, {}});
  chapter.add_run<int>("ray", "", {}, compute);
  EXPECT_THROW(chapter.add(named("fig-1")), std::invalid_argument);
  EXPECT_THROW(chapter.add(Measurement{"source/table-1/a/b", {}, {}}), std::invalid_argument);
  EXPECT_THROW(chapter.add_run<int>("ray", "", {}, compute), std::invalid_argument)
      << "the provenance tells runs apart by their names";
}

TEST(Chapter, KeepsItsRunsWhereTheyAreWhenMoved) {
  Chapter first("optics", "Light");
  const scene::Run<int>& run = first.add_run<int>("ray", "straight", {}, [](Workshop&) { return 5; });
  const Chapter second = std::move(first);
  Workshop workshop(false);
  workshop.open("scene", {&run});
  EXPECT_EQ(workshop.result(run), 5);
}

}  // namespace
}  // namespace nlmech::scene
