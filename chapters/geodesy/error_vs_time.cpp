#include <cmath>
#include <numbers>

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

scene::Showing show(const std::vector<Cost>& costs) {
  scene::Table data({{"method"},
                     {"form"},
                     {"instruction_set"},
                     {"time_ns_per_point"},
                     {"time_low_ns"},
                     {"time_high_ns"},
                     {"latitude_error_rad"},
                     {"height_error_m"}});
  scene::Table table({{"method"},
                      {"form"},
                      {"time a point (ns)"},
                      {"from"},
                      {"to"},
                      {"max latitude error (rad)", 2},
                      {"max height error (m)", 2}});
  Accuracy fast;
  for (const Cost& c : costs) {
    scene::Cell latitude, height;
    if (c.accuracy) {
      latitude = c.accuracy->latitude_rad;
      height = c.accuracy->height_m;
      if (c.method == "fast") {
        fast.latitude_rad = std::max(fast.latitude_rad, c.accuracy->latitude_rad);
        fast.height_m = std::max(fast.height_m, c.accuracy->height_m);
      }
    }
    const auto [median, low, high, repeats] = c.time_ns;
    data.add({c.method, c.form, c.set, median, low, high, latitude, height});
    table.add(
        {c.method, c.set.empty() ? c.form : c.form + ", " + c.set, median, low, high, latitude, height});
  }
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "geodesy-error-vs-time",
                    {{"heading", "Full precision at the cost of two arctangents: error against time"}}};
  showing.table = std::move(table);
  const char* statement = "error statement of ReverseTransform, in every form and instruction set";
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
               .seconds = 5,
               .show = [&costs](Workshop& w) { return show(w.result(costs)); }});
}

}  // namespace nlmech::chapters
