#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/algebraic_series/departure.hpp"
#include "chapters/algebraic_series/examples.hpp"
#include "chapters/algebraic_series/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// The radius of convergence along a solution.
struct Radii {
  std::vector<double> t, radius;
  double least_root = HUGE_VAL;  ///< by the root test
  [[nodiscard]] double least() const { return *std::min_element(radius.begin(), radius.end()); }
};

double greatest_of(const double* const* coefficients, int components, int k) {
  double greatest = std::numeric_limits<double>::min();
  for (int i = 0; i < components; ++i) greatest = std::max(greatest, std::abs(coefficients[i][k]));
  return greatest;
}

/// From the decay of the coefficients between orders 40 and 100: the slope of log max_i |c_k,i| by least
/// squares, which averages over the beat of a pair of complex singularities. A pole of order m makes it too
/// small by (m - 1)/70.
double radius_at(const double* const* coefficients, int components) {
  constexpr int first = 40, last = 100;
  constexpr double middle = (first + last) / 2.0;
  double above = 0, below = 0;
  for (int k = first; k <= last; ++k) {
    above += (k - middle) * std::log(greatest_of(coefficients, components, k));
    below += (k - middle) * (k - middle);
  }
  return std::exp(-above / below);
}

/// The root test at order 50: too small by the amplitude of the singularity, to the power 1/50.
double root_test(const double* const* coefficients, int components) {
  return std::pow(greatest_of(coefficients, components, 50), -1.0 / 50);
}

template <int n>
Radii radii(const comparison::Example<n>& c, int samples) {
  auto taylor = c.system.taylor(100);
  taylor.begin_segment(c.t0, c.x0);
  Radii found;
  for (int k = 0; k <= samples; ++k) {
    const double t = c.t0 + (c.t1 - c.t0) * k / samples;
    const ivp::State<n> x = c.reference(t).template cast<double>();
    taylor.expand(t, x);
    const double* rows[n];
    for (int i = 0; i < n; ++i) rows[i] = taylor.coefficients(i);
    found.t.push_back(t - c.t0);
    found.radius.push_back(radius_at(rows, n));
    found.least_root = std::min(found.least_root, root_test(rows, n));
  }
  return found;
}

/// One choice of T and N.
struct Choice {
  std::string problem;
  double step = 0;  ///< 0: by the radius of convergence
  int order = 0;
  std::string remark;
  Departure departure;
};

struct Measured {
  Radii lorenz, duffing, oscillator;
  std::vector<Choice> choices;
};

template <int n>
void add_choices(std::vector<Choice>& all, const comparison::Example<n>& c, double end,
                 const std::vector<Choice>& wanted) {
  for (Choice choice : wanted) {
    choice.problem = c.name;
    const ivp::Series method =
        choice.step > 0 ? published_series(choice.step, choice.order) : accurate_series();
    choice.departure = departure(c, method, end);
    all.push_back(std::move(choice));
  }
}

Measured measure(bool quick) {
  const int samples = quick ? 50 : 1000;
  Measured m{radii(lorenz_example(), samples),
             radii(forced_duffing_example(), samples),
             radii(oscillator_example(), samples),
             {}};
  add_choices(m.choices, lorenz_example(), 40,
              {{"", 0.1, 20, "as printed", {}},
               {"", 0.1, 80, "", {}},
               {"", 0.05, 20, "", {}},
               {"", 0.01, 20, "", {}},
               {"", 0, 0, "by the radius", {}}});
  add_choices(m.choices, forced_duffing_example(), 100,
              {{"", 0.35, 20, "as printed", {}},
               {"", 0.35, 40, "", {}},
               {"", 0.35, 80, "", {}},
               {"", 0.1, 20, "", {}},
               {"", 0.5, 20, "", {}},
               {"", 0, 0, "by the radius", {}}});
  add_choices(m.choices, oscillator_example(), oscillator_example().t0 + 750,
              {{"", 0.125, 50, "as printed", {}}, {"", 1.0, 50, "", {}}, {"", 0, 0, "by the radius", {}}});
  return m;
}

double radius_of(const Measured& m, const std::string& problem) {
  return problem == lorenz_example().name           ? m.lorenz.least()
         : problem == forced_duffing_example().name ? m.duffing.least()
                                                    : m.oscillator.least();
}

scene::Table table_of(const Measured& m) {
  scene::Table table({{"problem"},
                      {"T"},
                      {"N"},
                      {"remark"},
                      {"T over least radius", 2},
                      {"status"},
                      {"error above 1e-6 from"},
                      {"above 1e-3 from"},
                      {"above 0.1 from"},
                      {"above 1 from"},
                      {"greatest error", 2}});
  for (const Choice& c : m.choices) {
    const auto from = [&](double bound) { return scene::to_cell(c.departure.first_above(bound)); };
    const scene::Cell step = c.step > 0 ? scene::Cell(c.step) : scene::Cell("chosen");
    const scene::Cell order = c.step > 0 ? scene::Cell(std::int64_t{c.order}) : scene::Cell("chosen");
    const scene::Cell ratio =
        c.step > 0 ? scene::Cell(c.step / radius_of(m, c.problem)) : scene::Cell(scene::Cell());
    table.add({c.problem, step, order, c.remark, ratio, c.departure.status, from(1e-6), from(1e-3), from(0.1),
               from(1), c.departure.greatest(1e9)});
  }
  return table;
}

scene::Table data_of(const Measured& m) {
  scene::Table data({{"problem", 3, true}, {"share"}, {"radius"}, {"printed_step"}});
  const auto add = [&](const char* name, const Radii& r, double printed) {
    for (std::size_t i = 0; i < r.t.size(); ++i) data.add({name, r.t[i] / r.t.back(), r.radius[i], printed});
  };
  add("lorenz", m.lorenz, 0.1);
  add("duffing", m.duffing, 0.35);
  add("oscillator", m.oscillator, 0.125);
  return data;
}

const Choice& choice_of(const Measured& m, const std::string& problem, double step, int order) {
  return *std::find_if(m.choices.begin(), m.choices.end(), [&](const Choice& c) {
    return c.problem == problem && c.step == step && c.order == order;
  });
}

scene::Showing show(const Measured& m) {
  scene::Showing showing;
  showing.table = table_of(m);
  showing.figure = {
      data_of(m),
      "algebraic_series-radius",
      {{"heading", "Printed steps (dashed) against the radius of convergence"}, {"height", "640"}}};
  const std::string lorenz = lorenz_example().name, duffing = forced_duffing_example().name,
                    oscillator = oscillator_example().name;
  const auto first = [&](const std::string& problem, double step, int order, double bound) {
    return choice_of(m, problem, step, order).departure.first_above(bound).value_or(NAN);
  };
  const char* radius = "recorded, by some fifty coefficients; the bound is what their number changes";
  const char* pole = "recorded by fewer coefficients: the amplitude of a pole, up to 600, to the power 1/50";
  // oracle: algebraic_series_motions * above 0.1 from, Lorenz T = 0.1: above 1 from
  const char* times =
      "tools/oracles/algebraic_series_motions.py; steps are the resolution, and rounding moves chaos a "
      "little";
  showing.quantities = {
      scene::near("least root test, Lorenz", "1", m.lorenz.least_root, 0.119, 0.06, radius),
      scene::near("least root test, Duffing", "1", m.duffing.least_root, 0.524, 0.06, radius),
      scene::near("least root test, oscillator", "1", m.oscillator.least_root, 1.19, 0.06, radius),
      scene::near("least radius of convergence, Lorenz", "1", m.lorenz.least(), 0.119, 0.15, pole),
      scene::near("least radius of convergence, Duffing", "1", m.duffing.least(), 0.524, 0.15, pole),
      scene::near("least radius of convergence, oscillator", "1", m.oscillator.least(), 1.19, 0.15, pole),
      scene::near("Lorenz as printed: error above 0.1 from", "1", first(lorenz, 0.1, 20, 0.1), 0.5, 0.01,
                  times),
      scene::near("Lorenz as printed: error above 1 from", "1", first(lorenz, 0.1, 20, 1), 3.3, 0.04, times),
      scene::near("Lorenz, T = 0.05: error above 0.1 from", "1", first(lorenz, 0.05, 20, 0.1), 26.3, 0.1,
                  times),
      scene::near("Duffing as printed: error above 0.1 from", "1", first(duffing, 0.35, 20, 0.1), 37.5, 0.02,
                  times),
      scene::at_most("Duffing, T = 0.1, N = 20: greatest error", "1",
                     choice_of(m, duffing, 0.1, 20).departure.greatest(100), 2e-11,
                     "recorded: 2e-12; rounding scatters tenfold"),
      scene::at_most("Duffing by the radius: greatest error", "1",
                     choice_of(m, duffing, 0, 0).departure.greatest(100), 1e-10,
                     "rounding, amplified as with T = 0.1"),
      scene::at_most("Lorenz by the radius: error at t = 20", "1",
                     choice_of(m, lorenz, 0, 0).departure.greatest(20), 1e-6,
                     "rounding, amplified by e^(0.9 t)")};
  return showing;
}

}  // namespace

void add_radius(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Measured>(
      "radius",
      "radius from the decay of coefficients 40 to 100 along the solution; errors at the ends of steps, the "
      "largest of the components, against solutions in 35 digits (the strong oscillator: 19)",
      {}, [](Workshop& w) { return measure(w.quick()); });
  chapter.add({.name = "radius",
               .title = "Printed steps against the radius of convergence, and what it costs to ignore it",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
