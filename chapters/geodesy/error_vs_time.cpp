#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/geodesy/contenders.hpp"
#include "chapters/geodesy/reference.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::geodesy {
namespace {

using nlmech::geodesy::Ellipsoid;
using Truth = std::vector<nlmech::geodesy::BasicGeodetic<Extended>>;

constexpr std::size_t timed_points = 4096;  // six columns of them stay in the second-level cache

/// What a contender came to; a floor has no errors.
struct Cost {
  std::string method, set;
  Timing time_ns;  // a point
  std::optional<double> latitude_rad, height_m;

  /// 0 for one point after the other, then the instruction sets.
  [[nodiscard]] int series() const { return set.empty() ? 0 : set == "baseline" ? 1 : set == "avx2" ? 2 : 3; }
  [[nodiscard]] std::string form() const { return set.empty() ? "one point" : "batch, " + set; }
  [[nodiscard]] double median() const { return time_ns.median; }
  [[nodiscard]] double smallest() const { return time_ns.smallest; }
  [[nodiscard]] double largest() const { return time_ns.largest; }
};

void find_errors(Cost& cost, const Contender& contender, Points points, const Truth& truth) {
  contender.pass(points);
  const double unit = contender.in_degrees ? std::numbers::pi / 180 : 1;
  double latitude = 0, height = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto off = std::abs(points.latitude[i] * Extended(unit) - truth[i].latitude);
    latitude = std::max(latitude, static_cast<double>(off));
    height = std::max(height, static_cast<double>(std::abs(points.height[i] - truth[i].height)));
  }
  cost.latitude_rad = latitude;
  cost.height_m = height;
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
  Truth truth;
  for (std::size_t i = 0; i < accuracy_points.x.size(); ++i)
    truth.push_back(reference_reverse(accuracy_points.at(i), e));

  Points timing_points = sample_points(timed_points, e);
  std::vector<Cost> costs;
  for (const Contender& c : contenders(e)) {
    Cost& cost = costs.emplace_back();
    cost.method = c.method;
    if (c.batch) cost.set = to_string(*c.batch);
    cost.time_ns = nanoseconds(c, timing_points, quick);
    if (c.answers) find_errors(cost, c, accuracy_points, truth);
  }
  return costs;
}

/// Methods by number, from 1 in the order of the contenders; floors have none.
std::map<std::string, std::size_t> numbers_of(const std::vector<Cost>& costs) {
  std::map<std::string, std::size_t> numbers;
  for (const Cost& c : costs) {
    if (c.latitude_rad) numbers.emplace(c.method, numbers.size() + 1);
  }
  return numbers;
}

/// How a series is drawn.
struct Form {
  std::string name;
  int style, symbol;
};
const std::vector<Form> forms = {
    {"one point", 3, 13}, {"batch, baseline", 2, 5}, {"batch, AVX2", 5, 9}, {"batch, AVX-512", 1, 7}};

/// Points with the spread of their times, ours in a ring; numbers stand at four heights about them, so that
/// neighbours keep apart.
void add_points(scene::Panel& panel, int last_series) {
  const auto each = [&](const std::string& element) {
    for (int s = 0; s <= last_series; ++s) {
      const auto& [name, style, symbol] = forms[static_cast<std::size_t>(s)];
      panel.also(fmt::format(fmt::runtime(element),
                             fmt::arg("of", fmt::format("column(\"series\") == {}", s)),
                             fmt::arg("name", name), fmt::arg("style", style), fmt::arg("symbol", symbol)));
    }
  };
  const std::string time = "column(\"time_ns_per_point\") : NaN):\"latitude_error_rad\"";
  each("data using ({of} ? " + time +
       ":\"time_low_ns\":\"time_high_ns\" with xerrorbars linestyle {style} dashtype solid pointtype "
       "{symbol} pointsize 1 title '{name}'");
  each("data using ({of} && column(\"number\") == 1 ? " + time +
       " with points pointtype 6 pointsize 2 linecolor rgb ink notitle");
  const char* heights[] = {"0.9", "-0.9", "1.8", "-1.8"};
  for (int k = 0; k < 4; ++k)
    each(
        fmt::format("data using ({{of}} && int(column(\"number\")) % 4 == {} ? {}:"
                    "(sprintf(\"%d\", int(column(\"number\")))) with labels offset 0,{} font "
                    "sprintf(\"%s,%d\", font_family, font_size - 3) notitle",
                    k, time, heights[k]));
}

void draw(const std::vector<Cost>& costs, scene::Show& show) {
  // Our fastest batch in units of the floor of its instruction set: what this machine showed, not what
  // another did. The last set is the largest.
  double fast = 0, floor = 1;
  for (const Cost& c : costs) {
    if (c.method == "fast" && !c.set.empty()) fast = c.median();
    if (!c.latitude_rad) floor = c.median();
  }
  std::map<std::string, std::size_t> numbers = numbers_of(costs);
  scene::Panel& panel =
      show.plot(fmt::format("Full precision in {:.1f} times the time of two arctangents", fast / floor),
                "time a point (ns)", "max |latitude error| (rad)");
  panel.log_x(0.5, 600).set("xtics 10").log_y(1e-18, 1e-7).set("ytics 100").set("title offset 0,2.7");
  panel.set("margins screen 0.125, screen 0.70, screen 0.13, screen 0.78");
  panel.key("at screen 0.40, screen 0.885 center top maxrows 2 samplen 1.5 spacing 1.1");
  for (const auto& [method, number] : numbers)
    panel.set(
        fmt::format("label '{} {}' at screen 0.72, screen {:.3f} left noenhanced font "
                    "sprintf(\"%s,%d\", font_family, font_size - 2)",
                    number, method, 0.78 - 0.038 * (static_cast<double>(number) - 1)));
  if (std::ranges::any_of(costs, [](const Cost& c) { return !c.latitude_rad; })) {
    panel.set(fmt::format("arrow from {0:.3g}, graph 0 to {0:.3g}, graph 1 nohead linestyle 11", floor));
    panel.set(
        fmt::format("label 'two arctangents' at {:.3g}, graph 0.97 right rotate by 90 offset -0.7,0 "
                    "textcolor rgb soft_ink",
                    floor));
  }
  add_points(panel, std::ranges::max(costs, {}, &Cost::series).series());
  show.figure().data(scene::table_of(costs, {{"series", &Cost::series},
                                             {"number", [&](const Cost& c) { return numbers[c.method]; }},
                                             {"time_ns_per_point", &Cost::median},
                                             {"time_low_ns", &Cost::smallest},
                                             {"time_high_ns", &Cost::largest},
                                             {"latitude_error_rad", &Cost::latitude_rad},
                                             {"height_error_m", &Cost::height_m},
                                             {"method", &Cost::method}}));
}

void put(const std::vector<Cost>& costs, scene::Show& show) {
  draw(costs, show);
  scene::Table table = scene::table_of(costs, {{"method", &Cost::method},
                                               {"form", &Cost::form},
                                               {"time a point (ns)", &Cost::median},
                                               {"from", &Cost::smallest},
                                               {"to", &Cost::largest},
                                               {"max latitude error (rad)", &Cost::latitude_rad, 2},
                                               {"max height error (m)", &Cost::height_m, 2}});
  if (std::ranges::find(costs, "GeographicLib", &Cost::method) == costs.end())
    table.add({"GeographicLib", "not in this build", {}, {}, {}, {}, {}});
  show.table(std::move(table));

  double latitude = 0, height = 0;
  for (const Cost& c : costs) {
    if (!c.method.starts_with("fast") || !c.latitude_rad) continue;
    latitude = std::max(latitude, *c.latitude_rad);
    height = std::max(height, *c.height_m);
  }
  const char* statement = "error statement of ReverseTransform, in every form and instruction set";
  show.at_most("max latitude error of fast", {latitude, "rad"}, 4.5e-16, statement);
  show.at_most("max height error of fast", {height, "m"}, 2.2e-8, statement);
}

}  // namespace

std::vector<scene::Scene> error_vs_time() {
  const scene::Result costs("times",
                            "4096 random points, half of them below 100 km, one thread, median of 31 passes; "
                            "errors over 40 000 points",
                            measure);
  return {{.name = "error-vs-time",
           .title = "Latitude error against time a point: ours and the peers, one by one and in batches",
           .content = scene::Content(put, costs)}};
}

}  // namespace nlmech::chapters::geodesy
