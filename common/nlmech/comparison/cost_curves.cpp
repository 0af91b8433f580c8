#include "nlmech/comparison/cost_curves.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "nlmech/comparison/reference_end.hpp"

namespace nlmech::comparison {
namespace {

std::optional<double> digits(const Cost& c) {
  if (!c.error) return {};
  return digits_of(*c.error);
}

}  // namespace

Timing repeated_timing(const std::function<void()>& work, double first, bool quick) {
  constexpr double enough = 0.01;  // s, of all repeats: some hundred settings, a second or two in all
  if (quick || first > enough) return {first, first, first, 1};
  return time_repeats(work, std::clamp(static_cast<int>(enough / first), 1, 9));
}

const Cost* best_of(const Curve& curve) {
  const Cost* best = nullptr;
  for (const Cost& c : curve.costs) {
    if (c.error && (best == nullptr || *c.error < *best->error)) best = &c;
  }
  return best;
}

const Curve& curve_of(const std::vector<Curve>& curves, const std::string& name) {
  for (const Curve& curve : curves) {
    if (curve.name == name) return curve;
  }
  throw std::out_of_range("there is no curve of " + name);
}

double least_error(const std::vector<Curve>& curves, const std::string& name) {
  const Cost* best = best_of(curve_of(curves, name));
  return best != nullptr ? *best->error : std::numeric_limits<double>::quiet_NaN();
}

scene::Figure cost_figure(const std::vector<Curve>& curves, std::string heading, double condition) {
  scene::Table data({{"kind"},
                     {"number"},
                     {"digits"},
                     {"time_s"},
                     {"time_low_s"},
                     {"time_high_s"},
                     {"rhs_evaluations"},
                     {"best"},
                     {"status"},
                     {"method"},
                     {"setting"}});
  std::vector<std::string> legend, kinds;
  std::int64_t number = 0;
  for (const Curve& curve : curves) {
    if (curve.costs.empty()) continue;
    ++number;
    const auto kind = static_cast<std::int64_t>(curve.kind);
    legend.push_back(curve.name);
    kinds.push_back(std::to_string(kind));
    for (const Cost& c : curve.costs) {
      data.add({kind, number, scene::to_cell(digits(c)), c.time.median, c.time.smallest, c.time.largest,
                c.work.right_hand_sides, std::int64_t{&c == best_of(curve)}, c.status, curve.name,
                c.setting});
    }
  }
  scene::Figure figure{std::move(data),
                       "error-vs-time",
                       {{"width", "1000"},
                        {"height", "640"},
                        {"heading", std::move(heading)},
                        {"legend", fmt::format("{}", fmt::join(legend, "|"))},
                        {"kinds", fmt::format("{}", fmt::join(kinds, " "))}}};
  if (condition >= 10) {
    const double rounding = condition * std::numeric_limits<double>::epsilon() / 2;
    figure.variables["floor_digits"] = fmt::format("{:.2f}", -std::log10(rounding));
  }
  return figure;
}

scene::Table cost_table(const std::vector<Curve>& curves) {
  scene::Table table({{"method"},
                      {"setting"},
                      {"status"},
                      {"digits"},
                      {"time (ms)"},
                      {"from"},
                      {"to"},
                      {"right-hand sides"},
                      {"steps"},
                      {"rejected"}});
  for (const Curve& curve : curves) {
    if (curve.costs.empty()) table.add({curve.name, {}, "not in this build", {}, {}, {}, {}, {}, {}, {}});
    for (const Cost& c : curve.costs) {
      table.add({curve.name, c.setting, c.status, scene::to_cell(digits(c)), 1e3 * c.time.median,
                 1e3 * c.time.smallest, 1e3 * c.time.largest, c.work.right_hand_sides, c.work.steps,
                 c.work.rejected});
    }
  }
  return table;
}

}  // namespace nlmech::comparison
