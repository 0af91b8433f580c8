#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "chapters/transversal/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double end = 8;

/// RK6 and MTL with one step.
struct Pair {
  double step;
  Course rk6, mtl;
};

struct Histories {
  std::vector<Point> truth;
  std::vector<Pair> pairs;
};

Histories histories() {
  const problems::DrivenDuffing problem = stand_in(0.5);
  const Truth truth(problem, {0, 0}, 0, end);
  Histories all;
  for (int i = 0; i <= 400; ++i) {
    const double t = end * i / 400;
    all.truth.push_back({t, truth(t).cast<double>()});
  }
  for (const double h : {0.05, 0.1, 0.21})
    all.pairs.push_back({h, course(problem, {0, 0}, end, classical("rk6", h), &truth),
                         course(problem, {0, 0}, end, transversal(h, 3), &truth)});
  return all;
}

void add_curve(scene::Table& data, std::int64_t number, const std::vector<Point>& points) {
  for (const Point& p : points) {
    if (!(std::abs(p.x[0]) < 1e3)) break;  // far outside the picture
    data.add({number, p.t, p.x[0]});
  }
}

scene::Showing show(const Histories& all) {
  scene::Table data({{"series", 3, true}, {"t"}, {"x"}});
  scene::Table table(
      {{"h"}, {"RK6 ends"}, {"RK6 error", 2}, {"MTL ends"}, {"MTL error", 2}, {"MTL largest |x|"}});
  std::int64_t number = 0;
  for (const Pair& pair : all.pairs) {
    add_curve(data, ++number, all.truth);
    add_curve(data, ++number, pair.rk6.points);
    add_curve(data, ++number, pair.mtl.points);
    const auto cell = [](const Course& c) {
      return scene::to_cell(std::isfinite(c.error) ? std::optional(c.error) : std::nullopt);
    };
    table.add({pair.step, std::string(to_string(pair.rk6.status.outcome())), cell(pair.rk6),
               std::string(to_string(pair.mtl.status.outcome())), cell(pair.mtl), pair.mtl.largest});
  }
  scene::Showing showing;
  showing.table = std::move(table);
  showing.figure = {
      std::move(data),
      "transversal-histories",
      {{"heading", "RK6 overflows at \u200b{/:Italic h}\u200b = 0.21; MTL stays bounded, and wrong"},
       {"panels", "h = 0.05|h = 0.1|h = 0.21"},
       {"height", "620"}}};
  const Pair &fine = all.pairs[0], &coarse = all.pairs[2];
  showing.quantities = {
      {"does RK6 overflow at h = 0.21", "1", coarse.rk6.overflows() ? 1.0 : 0.0, 1, 1, "as the paper says"},
      {"does MTL finish at h = 0.21", "1", coarse.mtl.status.ok() ? 1.0 : 0.0, 1, 1, "as the paper says"},
      {"MTL's error at h = 0.21", "1", coarse.mtl.error, 0.5, 4,
       "recorded: an error of the size of the motion over a longer time"},
      {"MTL's error at h = 0.05 over that of RK6", "1", fine.mtl.error / fine.rk6.error, 2, 200,
       "recorded: a factor of 43 over a longer time"}};
  return showing;
}

}  // namespace

void add_transversal_histories(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Histories>("histories",
                                               "neither equation nor parameters are printed: stand-in e1 = "
                                               "0.25, e2 = 0.5, e3 = 0.5 from rest, of the form "
                                               "that the author uses elsewhere; RK6 is Butcher's of 7 stages",
                                               {}, [](Workshop&) { return histories(); });
  chapter.add({.name = "fig-2",
               .title = "Driven hardening Duffing oscillator by RK6 and MTL, p = 3, at three steps",
               .place = "Figure 2",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
