#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "chapters/geodesy/contenders.hpp"
#include "chapters/geodesy/reference.hpp"
#include "chapters/geodesy/scenes.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using geodesy::Ellipsoid;
using scene::Workshop;

constexpr std::size_t timed_points = 4096;  // six columns of them stay in the second-level cache

struct Accuracy {
  double latitude_rad = 0, height_m = 0;
};

struct Cost {
  std::string method, form, set;
  Timing time_ns;  // a point
  std::optional<Accuracy> accuracy;
};

Accuracy accuracy_of(const Contender& contender, Points points,
                     const std::vector<geodesy::BasicGeodetic<Extended>>& truth) {
  contender.pass(points);
  const double unit = contender.in_degrees ? std::numbers::pi / 180 : 1;
  Accuracy worst;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto latitude =
        static_cast<double>(std::abs(points.latitude[i] * Extended(unit) - truth[i].latitude));
    const auto height = static_cast<double>(std::abs(points.height[i] - truth[i].height));
    worst.latitude_rad = std::max(worst.latitude_rad, latitude);
    worst.height_m = std::max(worst.height_m, height);
  }
  return worst;
}

Timing nanoseconds(const Contender& contender, Points& points, bool quick) {
  const int passes = quick ? 2 : 8;  // long enough for the clock
  const Timing t = time_repeats(
      [&] {
        for (int i = 0; i < passes; ++i) contender.pass(points);
      },
      quick ? 5 : 31);
  const double scale = 1e9 / (static_cast<double>(timed_points) * passes);
  return {t.median * scale, t.smallest * scale, t.largest * scale, t.repeats};
}

std::vector<Cost> measure(bool quick) {
  const Ellipsoid e = Ellipsoid::wgs84();
  const Points accuracy_points = sample_points(quick ? 4000 : 40000, e);
  std::vector<geodesy::BasicGeodetic<Extended>> truth;
  truth.reserve(accuracy_points.x.size());
  for (std::size_t i = 0; i < accuracy_points.x.size(); ++i)
    truth.push_back(reference_reverse(accuracy_points.at(i), e));

  Points timing_points = sample_points(timed_points, e);
  std::vector<Cost> costs;
  for (const Contender& contender : contenders(e)) {
    Cost cost{contender.method,
              contender.batch ? "batch" : "one point",
              contender.batch ? std::string(to_string(*contender.batch)) : "",
              nanoseconds(contender, timing_points, quick),
              {}};
    if (contender.answers) cost.accuracy = accuracy_of(contender, accuracy_points, truth);
    costs.push_back(std::move(cost));
  }
  return costs;
}

/// 0 for one point after the other, then the instruction sets.
std::int64_t series_of(const Cost& c) {
  return c.set.empty() ? 0 : c.set == "baseline" ? 1 : c.set == "avx2" ? 2 : 3;
}

/// Methods by number, from 1 in the order of the contenders; floors have none.
std::map<std::string, std::int64_t> numbers_of(const std::vector<Cost>& costs) {
  std::map<std::string, std::int64_t> numbers;
  for (const Cost& c : costs) {
    if (c.accuracy) numbers.emplace(c.method, static_cast<std::int64_t>(numbers.size()) + 1);
  }
  return numbers;
}

/// Our fastest batch in units of the floor of its instruction set: what this machine showed, not what another
/// did.
std::string heading_of(const std::vector<Cost>& costs) {
  double fast = 0, floor = 1;
  for (const Cost& c : costs) {
    if (c.method == "fast" && c.form == "batch") fast = c.time_ns.median;  // the last set is the largest
    if (!c.accuracy) floor = c.time_ns.median;
  }
  return fmt::format("Full precision in {:.1f} times the time of two arctangents", fast / floor);
}

std::map<std::string, std::string> plot_variables(const std::vector<Cost>& costs) {
  std::map<std::int64_t, std::string> names;
  for (const auto& [method, number] : numbers_of(costs)) names[number] = method;
  std::map<std::string, std::string> variables = {{"heading", heading_of(costs)}};
  std::vector<std::string> legend;
  legend.reserve(names.size());
  for (const auto& [number, method] : names) legend.push_back(fmt::format("{} {}", number, method));
  variables["legend"] = fmt::format("{}", fmt::join(legend, "|"));
  std::set<std::int64_t> sets;
  for (const Cost& c : costs) {
    sets.insert(series_of(c));
    if (!c.accuracy)
      variables["floor_ns"] = fmt::format("{:.3g}", c.time_ns.median);  // of the last, the fastest set
  }
  variables["sets"] = fmt::format("{}", fmt::join(sets, " "));
  return variables;
}

scene::Figure draw(const std::vector<Cost>& costs) {
  scene::Table data({{"series"},
                     {"number"},
                     {"time_ns_per_point"},
                     {"time_low_ns"},
                     {"time_high_ns"},
                     {"latitude_error_rad"},
                     {"height_error_m"},
                     {"method"}});
  std::map<std::string, std::int64_t> numbers = numbers_of(costs);
  for (const Cost& c : costs) {
    const auto [latitude, height] =
        c.accuracy ? std::pair(std::optional(c.accuracy->latitude_rad), std::optional(c.accuracy->height_m))
                   : std::pair(std::optional<double>(), std::optional<double>());
    data.add({series_of(c), numbers[c.method], c.time_ns.median, c.time_ns.smallest, c.time_ns.largest,
              scene::to_cell(latitude), scene::to_cell(height), c.method});
  }
  return {std::move(data), "geodesy-error-vs-time", plot_variables(costs)};
}

scene::Table tabulate(const std::vector<Cost>& costs) {
  scene::Table table({{"method"},
                      {"form"},
                      {"time a point (ns)"},
                      {"from"},
                      {"to"},
                      {"max latitude error (rad)", 2},
                      {"max height error (m)", 2}});
  for (const Cost& c : costs) {
    std::optional<double> latitude, height;
    if (c.accuracy) {
      latitude = c.accuracy->latitude_rad;
      height = c.accuracy->height_m;
    }
    table.add({c.method, c.set.empty() ? c.form : c.form + ", " + c.set, c.time_ns.median, c.time_ns.smallest,
               c.time_ns.largest, scene::to_cell(latitude), scene::to_cell(height)});
  }
  const bool with_peer =
      std::any_of(costs.begin(), costs.end(), [](const Cost& c) { return c.method == "GeographicLib"; });
  if (!with_peer) table.add({"GeographicLib", "not in this build", {}, {}, {}, {}, {}});
  return table;
}

scene::Showing show(const std::vector<Cost>& costs) {
  Accuracy fast;
  for (const Cost& c : costs) {
    if (!c.method.starts_with("fast") || !c.accuracy) continue;
    fast.latitude_rad = std::max(fast.latitude_rad, c.accuracy->latitude_rad);
    fast.height_m = std::max(fast.height_m, c.accuracy->height_m);
  }
  const char* statement = "error statement of ReverseTransform, in every form and instruction set";
  scene::Showing showing;
  showing.figure = draw(costs);
  showing.table = tabulate(costs);
  showing.quantities = {
      scene::at_most("max latitude error of fast", "rad", fast.latitude_rad, 4.5e-16, statement),
      scene::at_most("max height error of fast", "m", fast.height_m, 2.2e-8, statement)};
  return showing;
}

}  // namespace

void add_error_vs_time(scene::Chapter& chapter) {
  const auto& costs =
      chapter.add_run<std::vector<Cost>>("times",
                                         "4096 random points, half of them below 100 km, one thread, median "
                                         "of 31 passes; errors over 40 000 points",
                                         {}, [](Workshop& w) { return measure(w.quick()); });
  chapter.add({.name = "error-vs-time",
               .title = "Latitude error against time a point: ours and the peers, one by one and in batches",
               .place = "our own",
               .needs = {&costs},
               .show = [&costs](Workshop& w) { return show(w.result(costs)); }});
}

}  // namespace nlmech::chapters
