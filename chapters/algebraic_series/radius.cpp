#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::algebraic_series::radius {
namespace {

/// Radius of convergence along a solution.
struct Radii {
  std::vector<double> t, radius;
  [[nodiscard]] double least() const { return *std::min_element(radius.begin(), radius.end()); }
};

/// Taylor coefficients of each component.
using Rows = std::vector<const double*>;

double greatest_of(const Rows& coefficients, int k) {
  double greatest = std::numeric_limits<double>::min();
  for (const double* const c : coefficients) greatest = std::max(greatest, std::abs(c[k]));
  return greatest;
}

/// Radius from the decay of the coefficients of orders 40 to 100: least-squares slope of log max_i |c_k,i|,
/// which averages the oscillation due to a pair of complex singularities. A pole of order m makes the result
/// too small by (m - 1)/70.
double radius_at(const Rows& coefficients) {
  constexpr int first = 40, last = 100;
  constexpr double middle = (first + last) / 2.0;
  double above = 0, below = 0;
  for (int k = first; k <= last; ++k) {
    above += (k - middle) * std::log(greatest_of(coefficients, k));
    below += (k - middle) * (k - middle);
  }
  return std::exp(-above / below);
}

Radii radii(const comparison::Example& c, int samples) {
  auto taylor = c.system.taylor(100);
  taylor.begin_segment(c.t0, c.x0);
  Radii found;
  for (int k = 0; k <= samples; ++k) {
    const double t = c.t0 + (c.t1 - c.t0) * k / samples;
    const ivp::State x = c.reference(t).template cast<double>();
    taylor.expand(t, x);
    Rows rows;
    for (int i = 0; i < c.system.size(); ++i) rows.push_back(taylor.coefficients(i));
    found.t.push_back(t - c.t0);
    found.radius.push_back(radius_at(rows));
  }
  return found;
}

/// A choice of T and N with its result.
struct Choice {
  double step = 0;  ///< T; 0: from the radius of convergence
  int order = 0;
  std::string remark = {}, problem = {};
  std::optional<double> share = {};  ///< step over the smallest radius
  Departure departure = {};

  /// T and N as table cells.
  [[nodiscard]] scene::Cell step_or_word() const { return step > 0 ? scene::Cell(step) : "chosen"; }
  [[nodiscard]] scene::Cell order_or_word() const { return step > 0 ? scene::Cell(order) : "chosen"; }
};

/// A problem with the radii along its solution and the results of choices.
struct Problem {
  std::string name;  ///< name in the data of the figure
  Radii radii;
  std::vector<Choice> choices;  ///< the first is the printed one

  /// @throws std::out_of_range if there is no such choice
  [[nodiscard]] const Departure& with(double step, int order) const {
    for (const Choice& c : choices) {
      if (c.step == step && c.order == order) return c.departure;
    }
    throw std::out_of_range("no such choice for " + name);
  }
  /// First time at which the error exceeds @p bound; NaN if it never does.
  [[nodiscard]] double first_above(double step, int order, double bound) const {
    return with(step, order).first_above(bound).value_or(NAN);
  }
};

Problem problem_of(const std::string& name, const comparison::Example& c, double end, bool quick,
                   std::vector<Choice> choices) {
  Problem p{name, radii(c, quick ? 50 : 1000), std::move(choices)};
  for (Choice& choice : p.choices) {
    choice.problem = c.name;
    if (choice.step > 0) choice.share = choice.step / p.radii.least();
    choice.departure =
        departure(c, choice.step > 0 ? published_series(choice.step, choice.order) : accurate_series(), end);
  }
  return p;
}

std::vector<Problem> compute(bool quick) {
  const Choice by_radius{.remark = "by the radius"};
  return {problem_of("lorenz", lorenz_example(), 40, quick,
                     {{0.1, 20, "as printed"}, {0.1, 80}, {0.05, 20}, {0.01, 20}, by_radius}),
          problem_of("duffing", forced_duffing_example(), 100, quick,
                     {{0.35, 20, "as printed"}, {0.35, 40}, {0.35, 80}, {0.1, 20}, {0.5, 20}, by_radius}),
          problem_of("oscillator", oscillator_example(), oscillator_example().t0 + 750, quick,
                     {{0.125, 50, "as printed"}, {1.0, 50}, by_radius})};
}

void draw(const std::vector<Problem>& all, scene::Show& show) {
  scene::Table data({{"problem", 3, true}, {"share"}, {"radius"}, {"printed_step"}});
  for (const Problem& p : all) {
    for (std::size_t i = 0; i < p.radii.t.size(); ++i)
      data.add({p.name, p.radii.t[i] / p.radii.t.back(), p.radii.radius[i], p.choices[0].step});
  }
  scene::Plot& plot =
      show.plots("Radius of convergence along each solution, above the printed steps (dashed)");
  plot.stacked().size(760, 640).data(std::move(data));
  auto panel = [&, block = 0](const char* caption, double largest, double tics) mutable {
    plot.panel("fraction of the time interval", "radius")
        .x_range(0, 1)
        .y_range(0, largest)
        .set(fmt::format("ytics {}", tics))
        .note(caption, 0.98, 0.9 * largest, "right")
        .columns("", "share:radius", {"lines linewidth 1.2", 1}, block)
        .columns("", "share:printed_step", {"lines dashtype 2 linewidth 1.8", 5}, block);
    ++block;
  };
  panel("{/:Bold Lorenz, t to 20}", 0.6, 0.2);
  panel("{/:Bold forced Duffing, t to 50}", 2, 0.5);
  panel("{/:Bold oscillator, 375 s}", 6, 2);
}

void put_table(const std::vector<Problem>& all, scene::Show& show) {
  std::vector<Choice> choices;
  for (const Problem& p : all) std::ranges::copy(p.choices, std::back_inserter(choices));
  const auto above = [](double bound) {
    return [bound](const Choice& c) { return c.departure.first_above(bound); };
  };
  show.table(choices, {{"problem", &Choice::problem},
                       {"T", &Choice::step_or_word},
                       {"N", &Choice::order_or_word},
                       {"remark", &Choice::remark},
                       {"T over least radius", &Choice::share, 2},
                       {"status", [](const Choice& c) { return c.departure.status; }},
                       {"error above 1e-6 from", above(1e-6)},
                       {"above 1e-3 from", above(1e-3)},
                       {"above 0.1 from", above(0.1)},
                       {"above 1 from", above(1)},
                       {"greatest error", [](const Choice& c) { return c.departure.greatest(1e9); }, 2}});
}

void put(const std::vector<Problem>& all, scene::Show& show) {
  draw(all, show);
  put_table(all, show);
  const Problem &lorenz = all[0], &duffing = all[1], &oscillator = all[2];
  const char* pole =
      "regression value by the root test at order 50: the amplitude of a pole, up to 600, to the power 1/50";
  show.near("least radius of convergence, Lorenz", lorenz.radii.least(), 0.119, 0.15, pole);
  show.near("least radius of convergence, Duffing", duffing.radii.least(), 0.524, 0.15, pole);
  show.near("least radius of convergence, oscillator", oscillator.radii.least(), 1.19, 0.15, pole);
  // oracle: algebraic_series_motions * above 0.1 from, Lorenz T = 0.1: above 1 from
  const char* times =
      "tools/oracles/algebraic_series_motions.py; steps are the resolution, and rounding moves chaos a "
      "little";
  show.near("Lorenz as printed: error above 0.1 from", lorenz.first_above(0.1, 20, 0.1), 0.5, 0.01, times);
  show.near("Lorenz as printed: error above 1 from", lorenz.first_above(0.1, 20, 1), 3.3, 0.04, times);
  show.near("Lorenz, T = 0.05: error above 0.1 from", lorenz.first_above(0.05, 20, 0.1), 26.3, 0.1, times);
  show.near(
      "Duffing as printed: error above 0.1 from", duffing.first_above(0.35, 20, 0.1), 37.1, 0.02,
      "tools/oracles/algebraic_series_motions.py, with one term less in the velocity, which moves it by a "
      "step");
  show.at_most("Duffing, T = 0.1, N = 20: greatest error", duffing.with(0.1, 20).greatest(100), 2e-11,
               "regression value: 2e-12; rounding scatters tenfold");
  show.at_most("Duffing by the radius: greatest error", duffing.with(0, 0).greatest(100), 1e-10,
               "rounding, amplified as with T = 0.1");
  show.at_most("Lorenz by the radius: error at t = 20", lorenz.with(0, 0).greatest(20), 1e-6,
               "rounding, amplified by e^(0.9 t)");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "radius",
      "radius from the decay of coefficients 40 to 100 along the solution; errors at the ends of steps, the "
      "largest of the components, against solutions in 35 digits (the strong oscillator: 19)",
      compute);
  return {{.name = "radius",
           .title = "Radius of convergence, printed steps and the errors of longer steps",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::algebraic_series::radius
