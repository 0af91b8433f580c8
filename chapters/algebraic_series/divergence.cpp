#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/samples.hpp"
#include "chapters/algebraic_series/scenes.hpp"
#include "nlmech/ivp/explicit_runge_kutta.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// What becomes of forward Euler with one step.
struct Fate {
  double step;
  std::optional<double> visible;   ///< time at which x errs by 0.05, a tenth of the amplitude
  std::optional<double> large;     ///< time at which |x| exceeds 1, twice the amplitude
  std::optional<double> overflow;  ///< time at which no number is left
};

Fate fate_of(double step, double until) {
  const auto& c = oscillator_example();
  Fate fate{step, {}, {}, {}};
  const auto observe = [&](const ivp::Step<2>& s) {
    const auto error = [&] { return std::abs(s.x1[0] - static_cast<double>(c.reference(s.t1)[0])); };
    if (!fate.visible && !(error() <= 0.05)) fate.visible = s.t1;
    if (!fate.large && !(std::abs(s.x1[0]) <= 1)) fate.large = s.t1;
    return true;
  };
  const auto end = ivp::integrate(c.system, c.x0, c.t0, until, ivp::Euler{.step = step}, observe);
  if (end.status.outcome() == Outcome::non_finite) fate.overflow = end.t;
  return fate;
}

/// @param quick without the two shortest steps
std::vector<Fate> fates(bool quick) {
  std::vector<Fate> all;
  for (const double h : {0.2, 0.125, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001}) {
    if (quick && h < 0.005) break;
    all.push_back(fate_of(h, std::numbers::pi + 80));
  }
  return all;
}

const Fate& with_step(const std::vector<Fate>& all, double step) {
  for (const Fate& f : all) {
    if (f.step == step) return f;
  }
  throw std::out_of_range("no run of forward Euler with that step");
}

scene::Showing show(const std::vector<Fate>& all) {
  scene::Table table({{"h (s)"}, {"10 % departure at (s)"}, {"|x| above 1 at (s)"}, {"overflow at (s)"}});
  scene::Table data({{"step"}, {"visible"}, {"large"}, {"overflow"}});
  for (const Fate& f : all) {
    table.add({f.step, scene::to_cell(f.visible), scene::to_cell(f.large), scene::to_cell(f.overflow)});
    data.add({f.step, scene::to_cell(f.visible), scene::to_cell(f.large), scene::to_cell(f.overflow)});
  }
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "algebraic_series-divergence",
                    {{"heading", "Forward Euler departs before 30 s if its step is 0.01 s or longer"}}};
  showing.table = std::move(table);
  // oracle: algebraic_series_motions Euler *
  const char* known = "tools/oracles/algebraic_series_motions.py, three digits; steps are the resolution";
  const auto near = [&](double h, double reference) {
    return scene::near("departure with h = " + scene::format_number(h, 4), "s",
                       with_step(all, h).visible.value_or(NAN), reference, 0.1 / reference + h / reference,
                       known);
  };
  showing.quantities = {near(0.125, 9.5), near(0.1, 11.1),  near(0.05, 15.6),
                        near(0.02, 22.4), near(0.01, 28.6), near(0.005, 34.9)};
  showing.quantities.push_back(scene::near("|x| above 1 with h = 0.125", "s",
                                           with_step(all, 0.125).large.value_or(NAN), 44.5, 0.006, known));
  showing.quantities.push_back(scene::near("|x| above 1 with h = 0.1", "s",
                                           with_step(all, 0.1).large.value_or(NAN), 47.2, 0.006, known));
  return showing;
}

}  // namespace

void add_divergence(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Fate>>(
      "euler-fates", "departure: 10 % of the amplitude, 0.05; forward Euler from t = pi to 80 s later", {},
      [](Workshop& w) { return fates(w.quick()); });
  chapter.add({.name = "divergence",
               .title = "When forward Euler departs, against its step",
               .place = "our own, for Figure 5",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
  chapter.add({.name = "filipich-rosales/fig-5/forward Euler/starts to diverge before",
               .needs = {&run},
               .measure = [&run](Workshop& w) {
                 return scene::Measured{{}, with_step(w.result(run), 0.01).visible};
               }});
}

}  // namespace nlmech::chapters
