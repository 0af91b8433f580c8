#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/extended.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/response_forms.hpp"
#include "chapters/gss_control/scenes.hpp"
#include "nlmech/spacecraft/assumed_modes.hpp"
#include "nlmech/spacecraft/finite_elements.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr double place = 2;

/// What a method costs and how good it is.
struct Cost {
  std::string method;
  int size = 0;        ///< modes or elements; 0 for the exact forms
  double middle = 0;   ///< median of the relative error of theta/u
  double largest = 0;  ///< greatest of it
  Timing time;         ///< of one frequency, theta/u and y/u together
};

/// theta/u and y/u at one frequency.
using Evaluate = std::function<FormValue(double)>;

/// Frequencies with the exact theta/u of each.
struct Reference {
  std::vector<double> omega, theta;
};

Cost measure(const std::string& method, int size, const Reference& reference, const Evaluate& evaluate,
             int repeats) {
  Cost cost{method, size, 0, 0, {}};
  std::vector<double> errors;
  for (std::size_t i = 0; i < reference.omega.size(); ++i) {
    const double error = std::abs(evaluate(reference.omega[i]).theta / reference.theta[i] - 1);
    errors.push_back(std::isfinite(error) ? std::min(error, 1.) : 1);
  }
  cost.largest = *std::max_element(errors.begin(), errors.end());
  cost.middle = std::max(median(errors), 1e-17);
  double sum = 0;  // used, so that no call is left out
  cost.time = time_repeats(
      [&] {
        for (const double omega : reference.omega) {
          const FormValue v = evaluate(omega);
          sum += v.theta + v.deflection;
        }
      },
      repeats);
  const double n = static_cast<double>(reference.omega.size()) * (sum == 0.1234567 ? 2 : 1);
  cost.time.median /= n;
  cost.time.smallest /= n;
  cost.time.largest /= n;
  return cost;
}

std::vector<Cost> measure_all(bool quick) {
  const spacecraft::Parameters p = craft(true);
  Reference reference;
  reference.omega = logarithmic(1e-2, 1e3, quick ? 100 : 1000);
  for (const double omega : reference.omega) reference.theta.push_back(extended_response(p, omega).value[0]);
  const int repeats = quick ? 3 : 11;
  std::vector<Cost> all;
  const ResponseForms forms(p);
  for (std::size_t k = 0; k < form_count; ++k) {
    const auto form = static_cast<Form>(k);
    all.push_back(measure(
        form_name(form), 0, reference, [&](double omega) { return forms.evaluate(form, omega, place); },
        repeats));
  }
  const auto discrete = [&](const std::string& name, int size, const spacecraft::DiscreteModel& model) {
    spacecraft::DenseResponse dense(model, place);
    all.push_back(measure(
        name + ", dense", size, reference,
        [&](double omega) {
          const auto r = dense.at_frequency(omega);
          return FormValue{r.theta, r.deflection};
        },
        size > 20 ? std::min(repeats, 3) : repeats));
    const spacecraft::ModalResponse modal(diagonalise(model), place);
    all.push_back(measure(
        name + ", diagonalised", size, reference,
        [&](double omega) {
          const auto r = modal.at_frequency(omega);
          return FormValue{r.theta, r.deflection};
        },
        repeats));
  };
  for (const int size : {2, 5, 10, 20, 40, 80}) {
    if (quick && size > 20) continue;
    discrete("assumed modes", size, spacecraft::assumed_modes(p, size));
  }
  for (const int size : {2, 5, 10, 20, 40}) {
    if (quick && size > 20) continue;
    discrete("finite elements", size, spacecraft::finite_elements(p, size));
  }
  return all;
}

scene::Figure draw(const std::vector<Cost>& all) {
  Plot plot("The exact forms have all digits, truncated models few", "time a frequency (s)", "time_s");
  plot.log_x(1e-8, 1e-2);
  plot.panel("digits of {/:Italic θ}/{/:Italic u}, median over frequencies");
  plot.y_range(0, 17);
  plot.y_tics(0, 2);
  const std::vector<std::pair<std::string, std::string>> looks = {
      {form_name(Form::closed), "p2"},        {form_name(Form::krylov), "p4"},
      {form_name(Form::scaled), "p1"},        {"assumed modes, dense", "b3"},
      {"assumed modes, diagonalised", "b8"},  {"finite elements, dense", "b5"},
      {"finite elements, diagonalised", "b6"}};
  for (const auto& [method, look] : looks) {
    plot.begin(method, look);
    for (const Cost& c : all) {
      if (c.method == method) plot.add(c.time.median, -std::log10(c.middle));
    }
  }
  for (const Cost& c : all) {
    if (c.size > 0 && (c.method == "assumed modes, dense" || c.method == "finite elements, dense"))
      plot.label(fmt::format(" {}", c.size), c.time.median, -std::log10(c.middle) + 0.45);
  }
  return plot.with("below", "2").with("height", "560").take();
}

scene::Showing show(const std::vector<Cost>& all) {
  scene::Table table({{"method"},
                      {"size"},
                      {"median error of theta/u", 2},
                      {"largest error", 2},
                      {"time a frequency (ns)", 3},
                      {"from", 3},
                      {"to", 3}});
  for (const Cost& c : all)
    table.add({c.method, c.size == 0 ? scene::Cell{} : scene::Cell{std::int64_t{c.size}}, c.middle, c.largest,
               1e9 * c.time.median, 1e9 * c.time.smallest, 1e9 * c.time.largest});
  const auto named = [&](const std::string& method, int size) -> const Cost& {
    return *std::find_if(all.begin(), all.end(),
                         [&](const Cost& c) { return c.method == method && c.size == size; });
  };
  return {
      draw(all),
      table,
      {scene::at_most("median error of the scaled form", "1", named(form_name(Form::scaled), 0).middle, 1e-14,
                      "a few dozen roundings"),
       scene::at_most("largest error of the scaled form", "1", named(form_name(Form::scaled), 0).largest,
                      1e-11, "1e-12 |omega G'/G|, which is ten at most away from the very poles"),
       // oracle: gss_control_plant tip error of assumed mode 1, tip error of assumed mode 10
       {"median error of ten assumed modes", "1", named("assumed modes, diagonalised", 10).middle, 1e-6, 1e-2,
        "their first pole is off by 4.5e-5, the tenth by 0.17: tools/oracles/gss_control_plant.py"},
       scene::near("dense over diagonalised: median errors of ten assumed modes", "1",
                   named("assumed modes, dense", 10).middle / named("assumed modes, diagonalised", 10).middle,
                   1, 1e-3, "the same model: they differ by rounding alone")}};
}

}  // namespace

void add_error_vs_time_response(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<std::vector<Cost>>(
      "response-times",
      "theta/u and y(2 ft)/u at frequencies from 0.01 to 1000 rad/s, logarithmically spaced, with tips; "
      "error "
      "of theta/u against 100 digits; one thread, median of repeats; models are made beforehand",
      {}, [](Workshop& w) { return measure_all(w.quick()); });
  chapter.add({.name = "error-vs-time-response",
               .title = "Digits of theta/u against time: exact forms, assumed modes, finite elements",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
