#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/samples.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::divergence {
namespace {

/// Forward Euler with one step size.
struct Euler {
  double step;
  std::optional<double> visible;   ///< time at which the error of x exceeds 0.05, a tenth of the amplitude
  std::optional<double> large;     ///< time at which |x| exceeds 1, twice the amplitude
  std::optional<double> overflow;  ///< time of overflow
};

Euler with(double step, double until) {
  const auto& c = oscillator_example();
  Euler result{step, {}, {}, {}};
  const auto observe = [&](const ivp::Step& s) {
    const auto error = [&] { return std::abs(s.x1[0] - static_cast<double>(c.reference(s.t1)[0])); };
    if (!result.visible && !(error() <= 0.05)) result.visible = s.t1;
    if (!result.large && !(std::abs(s.x1[0]) <= 1)) result.large = s.t1;
    return true;
  };
  const auto end = ivp::integrate(c.system, c.x0, c.t0, until, ivp::Euler{.step = step}, observe);
  if (end.status.outcome() == Outcome::non_finite) result.overflow = end.t;
  return result;
}

/// @param quick omits the two smallest step sizes
std::vector<Euler> compute(bool quick) {
  std::vector<Euler> all;
  for (const double h : {0.2, 0.125, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001}) {
    if (quick && h < 0.005) break;
    all.push_back(with(h, std::numbers::pi + 80));
  }
  return all;
}

const Euler& with_step(const std::vector<Euler>& all, double step) {
  for (const Euler& f : all) {
    if (f.step == step) return f;
  }
  throw std::out_of_range("no run of forward Euler with that step");
}

void put(const std::vector<Euler>& all, scene::Show& show) {
  show.plot("Forward Euler: 10 % error before 30 s for steps of 0.01 s and longer", "step {/:Italic h} (s)",
            "time (s)")
      .set("logscale x")
      .x_range(8e-4, 0.25)
      .y_range(0, 80)
      .level(30, "30 s, stated in the paper")
      .key("bottom left")
      .columns("overflow", "step:overflow", {"linespoints", 3})
      .columns("|x| above 1, twice the amplitude", "step:large", {"linespoints", 5})
      .columns("error of 10 % of the amplitude", "step:visible", {"linespoints", 1});
  show.figure().data(scene::table_of(all, {{"step", &Euler::step},
                                           {"visible", &Euler::visible},
                                           {"large", &Euler::large},
                                           {"overflow", &Euler::overflow}}));
  show.table(all, {{"h (s)", &Euler::step},
                   {"10 % departure at (s)", &Euler::visible},
                   {"|x| above 1 at (s)", &Euler::large},
                   {"overflow at (s)", &Euler::overflow}});
  // oracle: algebraic_series_motions Euler *
  const char* known = "tools/oracles/algebraic_series_motions.py, three digits; steps are the resolution";
  for (const auto& [h, t] :
       {std::pair{0.125, 9.5}, {0.1, 11.1}, {0.05, 15.6}, {0.02, 22.4}, {0.01, 28.6}, {0.005, 34.9}})
    show.near("departure with h = " + scene::format_number(h, 4),
              {with_step(all, h).visible.value_or(NAN), "s"}, t, 0.1 / t + h / t, known);
  show.near("|x| above 1 with h = 0.125", {with_step(all, 0.125).large.value_or(NAN), "s"}, 44.5, 0.006,
            known);
  show.near("|x| above 1 with h = 0.1", {with_step(all, 0.1).large.value_or(NAN), "s"}, 47.2, 0.006, known);
  show.measured("filipich-rosales/fig-5/forward Euler/starts to diverge before", {},
                with_step(all, 0.01).visible);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "euler-ends", "departure: 10 % of the amplitude, 0.05; forward Euler from t = pi to 80 s later",
      compute);
  return {{.name = "divergence",
           .title = "Forward Euler: time of departure from the solution against step",
           .place = "our own, for Figure 5",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::algebraic_series::divergence
