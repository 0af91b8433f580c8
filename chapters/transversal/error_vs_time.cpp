#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "chapters/transversal/oscillators.hpp"
#include "chapters/transversal/scenes.hpp"
#include "nlmech/comparison/cost_curves.hpp"

namespace nlmech::chapters {
namespace {

using comparison::Contender;
using comparison::Kind;
using scene::Workshop;

constexpr double end = 50;

comparison::Example<2> example() {
  const problems::DrivenDuffing problem;
  const ivp::State<2> x0 = problems::DrivenDuffing::initial_state();
  const auto truth = std::make_shared<const Truth>(problem, x0.cast<long double>(), 0, end);
  if (!truth->status().ok()) throw Failure(truth->status());
  ivp::State<2> amplitude = x0.cwiseAbs();
  for (int i = 0; i <= 4000; ++i)
    amplitude = amplitude.cwiseMax((*truth)(end * i / 4000.0L).cast<double>().cwiseAbs());
  return {.name = "duffing",
          .system = ivp::System<2>(problem),
          .x0 = x0,
          .t0 = 0,
          .t1 = end,
          .amplitude = amplitude,
          .reference = [truth](double t) { return (*truth)(std::min(t, end)); }};
}

Contender by_points(int p, bool quick) {
  constexpr std::array factors = {0.4, 0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625};
  Contender c = comparison::by_steps("mtl", {}, Kind::classical, 1, factors, quick);
  c.points = p;
  for (comparison::Setting& s : c.settings) s.settings.points = p;
  return c;
}

std::vector<Contender> contenders(bool quick) {
  constexpr std::array factors = {0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625};
  std::vector<Contender> all;
  for (const int p : {1, 2, 3, 4, 5, 8}) all.push_back(by_points(p, quick));
  for (const char* name : {"laier", "newmark", "rk4", "rk6"})
    all.push_back(comparison::by_steps(name, {}, Kind::classical, 1, factors, quick));
  all.push_back(comparison::by_tolerances("adaptive-collocation", Kind::own, quick));
  all.push_back(comparison::by_tolerances("series", Kind::series, quick));
  all.push_back(comparison::by_tolerances("ode45", Kind::explicit_, quick));
  for (const Contender& peer : comparison::all_peers(quick)) all.push_back(peer);
  return all;
}

/// What came out.
struct Measured {
  std::vector<comparison::Curve> curves;
  double reference = 0;  ///< its position at t = 50
};

Measured measure(bool quick) {
  const auto c = example();
  return {comparison::cost_curves(c, contenders(quick), quick), static_cast<double>(c.reference(end)[0])};
}

scene::Showing show(const Measured& m) {
  scene::Showing showing;
  showing.figure =
      comparison::cost_figure(m.curves, "Driven Duffing oscillator to t = 50: digits against cost", 0);
  showing.table = comparison::cost_table(m.curves);
  const comparison::Curve& three = comparison::curve_of(m.curves, "mtl, p = 3");
  const auto error = [&](std::size_t i) { return three.costs.at(i).error.value_or(NAN); };
  // The third and the last but one of quick's steps or of all.
  const double fourth = three.costs.size() > 5 ? error(2) / error(4) : error(1) / error(2);
  showing.quantities = {
      scene::near("reference position at t = 50", "1", m.reference, 1.203734404401093362708, 1e-15,
                  "an independent program in float128"),
      {"error of p = 3, step over a quarter of it", "1", fourth, 150, 400, "order 4: 256"},
      scene::at_most("least error of p = 5", "1", comparison::least_error(m.curves, "mtl, p = 5"), 1e-9,
                     "order 6 of steps of 0.00625, above roundings")};
  return showing;
}

}  // namespace

void add_transversal_error_vs_time(scene::Chapter& chapter) {
  const auto& run = chapter.add_timed_run<Measured>(
      "times",
      "x'' + x + x^3 = cos t from (1, 0); fixed steps by hand, default settings over one sweep of "
      "tolerances; "
      "error: median over 16 ends of steps in the last tenth; one thread, median of repeats",
      {}, [](Workshop& w) { return measure(w.quick()); });
  chapter.add({.name = "error-vs-time",
               .title = "Driven Duffing oscillator: digits against cost",
               .place = "our own",
               .needs = {&run},
               .seconds = 5,
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
