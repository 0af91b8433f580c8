#include "nlmech/scene/show.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "nlmech/scene/scene.hpp"

namespace nlmech::scene::show_test {
namespace {

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
  EXPECT_THROW(static_cast<void>(show.figure()), std::logic_error);
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
  EXPECT_THROW(static_cast<void>(show.take()), std::logic_error);
}

TEST(Show, MeasuresAPrintedNumberOnce) {
  Show show(false);
  show.measured("roy/fig-2/a/b", 1.0, 2.0);
  EXPECT_THROW(show.measured("roy/fig-2/a/b", 1.0), std::logic_error);
  EXPECT_EQ(show.take().measured.at("roy/fig-2/a/b").inferred, 2.0);
}

// Two scenes that name a result of their own alike have the same one; it is computed when the first asks.
TEST(Results, AreComputedOnceByName) {
  int computed = 0;
  const Result first("number", "as printed", [&computed] { return ++computed; });
  const Result twice(
      "twice", "of the first", [](int n, bool quick) { return quick ? 2 * n : 0; }, first);
  const auto put = [](int n, int two, Show& show) {
    show.table(std::vector<int>{n, two}, {{"n", std::identity()}});
    show.equals("twice", two, 2 * n, "by hand");
  };
  const Chapter chapter("numbers", "Numbers",
                        {{{.name = "a", .title = "A", .content = Content(put, first, twice)}},
                         {{.name = "b", .title = "B", .content = Content(put, first, twice)}}});
  Results results(true);
  for (const Scene& scene : chapter.scenes()) {
    EXPECT_EQ(scene.place, "our own");
    const Performance performance = perform(scene, results);
    EXPECT_EQ(performance.runs.size(), 2U);
    EXPECT_EQ(performance.showing.table->csv(), "n\n1\n2\n");
  }
  EXPECT_EQ(computed, 1);
}

TEST(Results, OfOneNameHaveOneReading) {
  const Result first("number", "as printed", [] { return 1; }),
      other("number", "corrected", [] { return 2; });
  const auto put = [](int a, Show& show) {
    show.table(std::vector<int>{a}, {{"n", std::identity()}});
    show.equals("one", 1, 1, "by hand");
  };
  const Scene a{.name = "a", .title = "A", .content = Content(put, first)},
      b{.name = "b", .title = "B", .content = Content(put, other)};
  const Chapter chapter("numbers", "Numbers", {{a, b}});
  Results results(true);
  static_cast<void>(perform(chapter.scene("a"), results));
  EXPECT_THROW(static_cast<void>(perform(chapter.scene("b"), results)), std::logic_error);
}

TEST(Scenes, HaveNoEmptyTableOrFigure) {
  const auto put = [](Show& show) {
    show.plot("heading", "x", "y").curve("", {1}, {2});
    show.table(std::vector<Row>{}, {{"name", &Row::name}});
    show.equals("one", 1, 1, "by hand");
  };
  const Chapter chapter("empty", "Empty", {{{.name = "a", .title = "A", .content = Content(put)}}});
  Results results(true);
  EXPECT_THROW(static_cast<void>(perform(chapter.scene("a"), results)), std::logic_error);
}

}  // namespace
}  // namespace nlmech::scene::show_test
