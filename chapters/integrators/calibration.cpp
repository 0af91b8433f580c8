#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/integrators/heat_map.hpp"
#include "chapters/integrators/sweep.hpp"

namespace nlmech::chapters::integrators::calibration {
namespace {

constexpr double promised = 1.5;  // digits that may be missing after success

/// Requested and achieved digits of a method on a problem.
struct Row {
  std::string problem, method;
  bool peer;
  int successes = 0, silent = 0;
  double worst = -16;    ///< most missing digits
  double at = 0;         ///< tolerance of the worst run
  double delivered = 0;  ///< achieved digits of the worst run
  double expected = 0;   ///< expected digits of the worst run
};

std::vector<Row> rows_of(const std::vector<ProblemTrials>& all) {
  std::vector<Row> rows;
  for (const ProblemTrials& p : all) {
    for (const MethodTrials& m : p.methods) {
      if (!m.chooses) continue;  // fixed steps have no tolerance
      Row row{p.problem, m.method, m.peer};
      for (const Trial& t : m.trials) {
        if (!t.success()) continue;
        ++row.successes;
        row.silent += p.silent_failure(t) ? 1 : 0;
        const double expected = p.has_solution ? p.digits_to_expect(t.tolerance) : -std::log10(t.tolerance);
        if (expected - t.digits() <= row.worst) continue;
        row.worst = expected - t.digits();
        row.at = t.tolerance;
        row.delivered = t.digits();
        row.expected = expected;
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

void put(const std::vector<ProblemTrials>& all, scene::Show& show) {
  const std::vector<Row> rows = rows_of(all);
  HeatMap map{"Requested minus achieved digits, conditioning removed",
              "miss",
              "!  success with fewer than half of the digits      blank: no success",
              {"conditioning removed; worst of all tolerances"},
              {},
              {},
              {}};
  for (const ProblemTrials& p : all) map.problems.push_back(p.problem);
  for (const MethodTrials& m : all.front().methods) {
    if (m.chooses) map.methods.push_back(m.method);
  }
  map.cell = [&](std::size_t, std::size_t problem, std::size_t method) -> HeatCell {
    const Row& row = rows[problem * map.methods.size() + method];
    if (row.successes == 0) return {};
    return {std::clamp(row.worst, -3., 6.), row.silent > 0 ? "!" : ""};
  };
  show_heat_map(map, show);

  std::vector<Row> misses;
  for (const Row& row : rows) {
    if (row.successes > 0 && (row.silent > 0 || row.worst > promised)) misses.push_back(row);
  }
  std::ranges::stable_sort(misses, std::greater{}, &Row::worst);
  show.table(misses, {{"problem", &Row::problem},
                      {"method", &Row::method},
                      {"tolerance", &Row::at, 1},
                      {"digits expected", &Row::expected},
                      {"digits achieved", &Row::delivered},
                      {"missing", &Row::worst, 2},
                      {"successes", &Row::successes},
                      {"silent failures", &Row::silent}});
  for (const char* method : {"series", "adaptive-collocation", "rkn1210", "ode45", "dop853"}) {
    double worst = -16;
    int silent = 0;
    for (const Row& row : rows) {
      if (row.method != method || row.successes == 0 || row.problem == "dead-end") continue;
      worst = std::max(worst, row.worst);
      silent += row.silent;
    }
    show.between(fmt::format("largest number of digits missing, {}", method), worst, -16, promised,
                 "local errors accumulate over the steps: one and a half digits allowed");
    show.equals(
        fmt::format("silent failures of {}, except on the equation without a solution at the end", method),
        silent, 0, "success requires at least half of the digits that the tolerance can give");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "calibration",
           .title = "Requested and achieved digits of each method on each problem",
           .content = scene::Content(put, sweep())}};
}

}  // namespace nlmech::chapters::integrators::calibration
