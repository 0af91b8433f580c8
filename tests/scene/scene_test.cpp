/// Scenes: results, content and checks, and provenance.
#include "nlmech/scene/scene.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/scene/build_info.hpp"
#include "nlmech/scene/publish.hpp"
#include "nlmech/scene/show.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/places.hpp"
#include "tests/thrown.hpp"

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

/// A scene without results that shows @p showing.
Scene that_shows(const Showing& showing) {
  Scene scene = named("fig-1");
  scene.content.show = [showing](Results&) { return showing; };
  return scene;
}
std::string complaint(const Scene& scene) {
  Results results(false);
  return tests::thrown<std::logic_error>([&] { return perform(scene, results); });
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
  EXPECT_THROW((void)results.get(*inferred.run()), std::logic_error);
  EXPECT_THROW((void)results.get(*real.run()), std::logic_error);
}

TEST(Results, GoOnAfterARunThatFailed) {
  const Result fails("fails", "", []() -> int { throw Failure("no convergence"); });
  Results results(true);
  EXPECT_THROW((void)results.get(*fails.run()), Failure);
  EXPECT_EQ(results.get(*derived.run()), 2);
  EXPECT_THROW((void)results.get(*fails.run()), Failure) << "it has no result now either";
}

/// Does the value pass a check of a scene that only @p make adds?
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

TEST(Chapter, RefusesTheSameNameTwice) {
  EXPECT_THROW(Chapter("optics", "Light", {{named("fig-1")}, {named("fig-1")}}), std::invalid_argument);
}

struct Row {
  std::string name;
  int count;
  std::optional<double> error;
  [[nodiscard]] double doubled() const { return 2.0 * count; }
};
const std::vector<Row> rows = {{"a", 1, 0.123456}, {"b", 2, std::nullopt}};

TEST(Show, MakesTablesOfRowsByMembersAndFunctions) {
  const Table table = table_of(rows, {{"name", &Row::name},
                                      {"count", &Row::count},
                                      {"error", &Row::error, 2},
                                      {"doubled", &Row::doubled},
                                      {"small", [](const Row& r) { return r.count < 2; }}});
  EXPECT_EQ(table.csv(), "name,count,error,doubled,small\na,1,0.123456,2,1\nb,2,,4,0\n");
  EXPECT_EQ(table.text(0, 2), "0.12");
}

TEST(Show, ChecksWithAndWithoutUnits) {
  Show show(false);
  show.near("angle", {2.0, "deg"}, 2, 0.01, "by hand");
  show.at_most("error", 1e-3, 1e-2, "bound");
  show.between("rate", -1, -2, 0, "signs");
  show.equals("found", true, 1, "it is there");
  show.equals("cases", 3U, 4, "four were given");
  const Showing showing = show.take();
  ASSERT_EQ(showing.quantities.size(), 5U);
  EXPECT_EQ(showing.quantities[0].unit, "deg");
  EXPECT_EQ(showing.quantities[0].low, 1.98);
  EXPECT_EQ(showing.quantities[1].unit, "1");
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_TRUE(showing.quantities[i].passes()) << showing.quantities[i].name;
  EXPECT_FALSE(showing.quantities[4].passes());
}

TEST(Show, HasOneFigureAndOneTable) {
  Show show(true);
  EXPECT_TRUE(show.quick());
  EXPECT_THROW((void)show.figure(), std::logic_error);
  show.plot("heading", "x", "y").curve("", {1}, {2});
  show.table(rows, {{"name", &Row::name}});
  EXPECT_THROW(show.plot("another", "x", "y"), std::logic_error);
  EXPECT_THROW(show.draw(Table({{"x"}}), "line", {}), std::logic_error);
  EXPECT_THROW(show.table(rows, {{"name", &Row::name}}), std::logic_error);
  const Showing showing = show.take();
  EXPECT_EQ(showing.figure->data.csv(), "curve,x,y\n1,1,2\n");
  EXPECT_EQ(showing.figure->template_name, "");
  EXPECT_EQ(showing.table->rows().size(), 2U);
}

TEST(Show, RefusesAFigureWithoutCurves) {
  Show show(false);
  show.plot("heading", "x", "y");
  EXPECT_THROW((void)show.take(), std::logic_error);
}

TEST(Show, MeasuresAPrintedNumberOnce) {
  Show show(false);
  show.measured("roy/fig-2/a/b", 1.0, 2.0);
  EXPECT_THROW(show.measured("roy/fig-2/a/b", 1.0), std::logic_error);
  EXPECT_EQ(show.take().measured.at("roy/fig-2/a/b").inferred, 2.0);
}

const Run<int> run("series-4", "as \"printed\"", {}, [](Results&) { return 1; });

nlohmann::json written(bool quick, double value) {
  const Chapter chapter("optics", "Light", {});
  const Scene scene{.name = "fig-1", .title = "Rays", .place = "Figure 1"};
  Performance performance;
  performance.runs = {&run};
  performance.showing.quantities = {{"angle", "deg", value, 1, 3, "law of refraction"}};
  return nlohmann::json::parse(provenance(chapter, scene, performance, quick));
}

TEST(Provenance, SaysHowToMakeTheSceneAgain) {
  const auto json = written(false, 2);
  EXPECT_EQ(json.at("chapter"), "optics");
  EXPECT_EQ(json.at("scene"), "fig-1");
  EXPECT_EQ(json.at("title"), "Rays");
  EXPECT_EQ(json.at("place"), "Figure 1");
  EXPECT_EQ(json.at("command"), "optics run fig-1");
  EXPECT_EQ(json.at("effort"), "full");
  EXPECT_EQ(written(true, 2).at("command"), "optics run fig-1 --quick");
  EXPECT_EQ(written(true, 2).at("effort"), "quick");
}

TEST(Provenance, SaysWhatTheProgramWasMadeFrom) {
  const auto json = written(false, 2);
  EXPECT_EQ(json.at("version"), build_info().version);
  EXPECT_EQ(json.at("commit"), build_info().commit);
  EXPECT_TRUE(json.at("dirty").is_boolean());
  EXPECT_FALSE(json.at("compiler").get<std::string>().empty());
  EXPECT_TRUE(json.at("flags").is_string());
  EXPECT_FALSE(json.at("processor").get<std::string>().empty());
  for (const char* library : {"fmt", "CLI11", "nlohmann_json"})
    EXPECT_TRUE(json.at("libraries").contains(library)) << library;
}

TEST(Provenance, ListsRunsWithTheirReadingsAndQuantitiesWithTheirRanges) {
  const auto json = written(false, 0.1);
  EXPECT_EQ(json.at("runs"), nlohmann::json::parse(R"([{"name": "series-4", "reading": "as \"printed\""}])"));
  EXPECT_EQ(json.at("quantities"),
            nlohmann::json::parse(R"([{"name": "angle", "unit": "deg", "value": 0.1, "low": 1,
    "high": 3, "passes": false, "reason": "law of refraction"}])"));
}

TEST(Provenance, WritesWhatIsNoNumberAsNull) {
  const auto json = written(false, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(json.at("quantities")[0].at("value").is_null());
  EXPECT_EQ(json.at("quantities")[0].at("passes"), false);
}

}  // namespace
}  // namespace nlmech::scene::scene_test
