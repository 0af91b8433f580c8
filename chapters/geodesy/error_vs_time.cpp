#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "chapters/geodesy/reference.hpp"
#include "chapters/geodesy/timed_methods.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"

namespace nlmech::chapters::geodesy::error_vs_time {
namespace {

using nlmech::geodesy::Ellipsoid;
using Truth = std::vector<nlmech::geodesy::BasicGeodetic<Extended>>;

constexpr std::size_t timed_points = 4096;  // six columns fit into the second-level cache

/// Groups of methods: series of the dissertation, ReverseTransform (`fast`), other published methods,
/// library.
enum Group : std::size_t { series, fast_batch, fast_point, other_batch, other_point, library };
const char *const fast = "fast", *const geographiclib = "GeographicLib";

/// Line of a method without times.
scene::MethodLine line_of(const TimedMethod& c) {
  const bool computed = c.method.starts_with(fast);
  const Group group = c.method.starts_with("series") ? series
                      : c.method == geographiclib    ? library
                      : computed                     ? (c.batch ? fast_batch : fast_point)
                      : c.batch                      ? other_batch
                                                     : other_point;
  return {c.name(), group, {}, group <= fast_point ? scene::Side::subject : scene::Side::peer};
}

/// Largest errors of latitude (rad) and height (m).
struct Errors {
  double latitude = 0, height = 0;
};

Errors errors_of(const TimedMethod& method, Points points, const Truth& exact) {
  method.pass(points);
  const double unit = method.in_degrees ? std::numbers::pi / 180 : 1;
  Errors e;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const auto off = std::abs(points.latitude[i] * Extended(unit) - exact[i].latitude);
    e.latitude = std::max(e.latitude, static_cast<double>(off));
    e.height = std::max(e.height, static_cast<double>(std::abs(points.height[i] - exact[i].height)));
  }
  return e;
}

/// Time per point, s.
Timing time_of(const TimedMethod& method, Points& points, bool quick) {
  const int passes = quick ? 2 : 8;  // long against the resolution of the clock
  const Timing t = time_repeats(
      [&] {
        for (int i = 0; i < passes; ++i) method.pass(points);
      },
      quick ? 5 : 31);
  const double n = static_cast<double>(timed_points) * passes;
  return {t.median / n, t.smallest / n, t.largest / n, t.repeats};
}

scene::ProblemLines measure(bool quick) {
  const Ellipsoid e = Ellipsoid::wgs84();
  const Points accuracy_points = sample_points(quick ? 4000 : 40000, e);
  Truth exact;
  for (std::size_t i = 0; i < accuracy_points.x.size(); ++i)
    exact.push_back(reference_reverse(accuracy_points.at(i), e));

  Points timing_points = sample_points(timed_points, e);
  scene::ProblemLines all;
  for (const TimedMethod& c : timed_methods(e)) {
    scene::Attempt attempt{c.batch ? fmt::format("batch, {}", to_string(*c.batch)) : "one point",
                           "no position",  // method that computes no position
                           {},
                           time_of(c, timing_points, quick),
                           {scene::Cell()}};
    if (c.answers) {
      const Errors errors = errors_of(c, accuracy_points, exact);
      attempt.status = "success";
      attempt.error = errors.latitude;
      attempt.work = {errors.height};
    }
    all.lines.push_back(line_of(c));
    all.lines.back().attempts.push_back(attempt);
  }
  if (std::ranges::find(all.lines, library, &scene::MethodLine::group) == all.lines.end())
    all.lines.push_back({geographiclib, library, {}, scene::Side::peer});
  return all;
}

void put(const scene::ProblemLines& all, scene::Show& show) {
  // Ratio of the fastest batch to two arctangents in the same instruction set, measured on this machine. The
  // last set is the largest.
  double batch = 0, floor = 1, latitude = 0, height = 0;
  for (const scene::MethodLine& line : all.lines) {
    if (line.attempts.empty()) continue;
    const scene::Attempt& a = line.attempts.front();
    if (!a.error) floor = a.time.median;
    if (line.group == fast_batch) batch = a.time.median;
    if (!a.error || !line.method.starts_with(fast)) continue;
    latitude = std::max(latitude, *a.error);
    height = std::max(height, std::get<double>(a.work.front()));
  }
  scene::show_work_precision(
      {.heading = fmt::format("Latitude to full precision in {:.1f} times the time of two arctangents",
                              batch / floor),
       .digits = "digits: −log_{10} of max |latitude error| (rad)",
       .least_digits = 7,
       .most_digits = 17,
       .error = "max latitude error (rad)",
       .time = "time per point (s)",
       .unit = "ns",
       .work = {"max height error (m)"},
       .groups = {{"series of the dissertation", 2},
                  {"nlmech, in batches", 0},
                  {"nlmech, one point", 1},
                  {"published, in batches", 3},
                  {"published, one point", 4},
                  {"library", 5}},
       .least_time = std::pair{floor, "two arctangents"}},
      {all}, show);
  const char* statement = "error statement of ReverseTransform, in every form and instruction set";
  show.at_most("max latitude error of fast", {latitude, "rad"}, 4.5e-16, statement);
  show.at_most("max height error of fast", {height, "m"}, 2.2e-8, statement);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result costs("times",
                            "4096 random points, half of them below 100 km, one thread, median of 31 passes; "
                            "errors over 40 000 points",
                            measure);
  return {{.name = "error-vs-time",
           .title = "Latitude error against time per point: nlmech and peers, single points and batches",
           .content = scene::Content(put, costs)}};
}

}  // namespace nlmech::chapters::geodesy::error_vs_time
