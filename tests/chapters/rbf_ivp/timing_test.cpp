/// A run is repeated only if its time is reported; figures compute each run once.
#include <gtest/gtest.h>

#include <string>

#include "chapters/rbf_ivp/examples/histories.hpp"
#include "chapters/rbf_ivp/examples/rows.hpp"

namespace nlmech::chapters::rbf_ivp {

scene::Chapter chapter();  // made from its list of scenes

}  // namespace nlmech::chapters::rbf_ivp

namespace nlmech::chapters::rbf_ivp::timing_test {
namespace {

/// The free oscillator with one row; counts its integrations.
Example counted(int& integrations) {
  Example example{.made = free_duffing_case,
                  .name = "counted",
                  .title = "Counted",
                  .table = "table-4.2",
                  .quantity = "position RMS error",
                  .window = 5};
  const auto procedure = throughout(ivp::Rk4{.step = 0.5});
  example.add(
      {.row = "", .method = "RK4", .setting = "0.5", .nominal = Expected{0, 10, "any"}, .inferred = {}},
      "rk4", "counted", [procedure, &integrations](const Case& c, double end, const ivp::Observer& observer) {
        ++integrations;
        return procedure(c, end, observer);
      });
  return example;
}

TEST(Timing, FiguresIntegrateOnce) {
  int integrations = 0;
  const Example example = counted(integrations);
  const scene::Chapter figures(
      "a", "figures",
      {{history(example, {1, "RK4", Shown::state}), history(example, {2, "RK4", Shown::positions}),
        comparison(example, {3, 0, "x(t)", {"RK4"}})}});
  scene::Results results(false);
  for (const char* figure : {"fig-4.1", "fig-4.2", "fig-4.3"})
    static_cast<void>(perform(figures.scene(figure), results));
  EXPECT_EQ(integrations, 1);
}

// One for the errors, and one warm-up before nine that are timed.
TEST(Timing, TheTableTimes) {
  int integrations = 0;
  const scene::Chapter table("b", "a table", {{result_table(counted(integrations))}});
  scene::Results results(false);
  static_cast<void>(perform(table.scene("table-4.2"), results));
  EXPECT_EQ(integrations, 11);
}

TEST(Timing, OnlyTablesNeedTimes) {
  const scene::Chapter whole = chapter();
  int tables = 0;
  for (const scene::Scene& s : whole.scenes()) {
    const bool shown = s.name == "table-4.2" || s.name == "table-4.4" || s.name == "table-4.6";
    bool needed = false;
    for (const auto& run : s.content.needs) needed = needed || run->name().ends_with("-time");
    EXPECT_EQ(needed, shown) << s.name;
    tables += shown ? 1 : 0;
  }
  EXPECT_EQ(tables, 3);
}

}  // namespace
}  // namespace nlmech::chapters::rbf_ivp::timing_test
