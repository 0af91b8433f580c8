#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/extended.hpp"
#include "chapters/gss_control/plots.hpp"
#include "chapters/gss_control/response_forms.hpp"
#include "chapters/gss_control/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// Errors of all forms at one frequency, relative: theta/u, y(L/2)/u, y(L)/u.
struct Sample {
  double omega = 0;
  std::array<double, 3> condition{};
  std::array<std::array<double, 3>, form_count> error{};
};

Sample measure(const ResponseForms& forms, double omega) {
  const Extended exact = extended_response(forms.parameters(), omega);
  Sample s{omega, exact.condition, {}};
  for (std::size_t k = 0; k < form_count; ++k) {
    const auto form = static_cast<Form>(k);
    const double length = forms.parameters().length;
    const std::array<FormValue, 2> value = {forms.evaluate(form, omega, length / 2),
                                            forms.evaluate(form, omega, length)};
    const std::array<double, 3> ours = {value[0].theta, value[0].deflection, value[1].deflection};
    for (std::size_t i = 0; i < ours.size(); ++i)
      s.error.at(k).at(i) = std::abs(ours.at(i) / exact.value.at(i) - 1);
  }
  return s;
}

/// Samples with tips and without.
using Samples = std::array<std::vector<Sample>, 2>;

Samples measure_all(bool quick) {
  Samples all;
  for (const bool tip : {false, true}) {
    const ResponseForms forms(craft(tip));
    for (const double omega : logarithmic(1e-8, 1e8, quick ? 81 : 321))
      all.at(tip ? 1 : 0).push_back(measure(forms, omega));
  }
  return all;
}

/// Largest over the range; NaN and infinity count as 1 and are no digits at all.
double worst(const std::vector<Sample>& samples, Form form, std::size_t what, double from, double to,
             bool conditioned = false) {
  double error = 0;
  for (const Sample& s : samples) {
    if (s.omega < from || s.omega > to) continue;
    double e = s.error.at(static_cast<std::size_t>(form)).at(what);
    if (!std::isfinite(e)) e = 1;
    error = std::max(error, conditioned ? e / std::max(1., s.condition.at(what)) : e);
  }
  return error;
}

scene::Figure draw(const std::vector<Sample>& samples) {
  Plot plot("Only scaled exponentials hold from 1e-8 to 1e8 rad/s", "{/:Italic ω} (rad/s)");
  plot.log_x(1e-8, 1e8);
  const std::array looks = {"l2", "l4", "l1"};
  for (const std::size_t what : {std::size_t{0}, std::size_t{1}}) {
    plot.panel(what == 0 ? "relative error of {/:Italic θ}/{/:Italic u}"
                         : "relative error of {/:Italic y}(2 ft)/{/:Italic u}");
    plot.log_y(1e-18, 1);
    for (std::size_t k = 0; k < form_count; ++k) {
      plot.begin(what == 0 ? form_name(static_cast<Form>(k)) : "", looks.at(k));
      for (const Sample& s : samples) {
        const double e = s.error.at(k).at(what);
        plot.add(s.omega, std::isfinite(e) ? std::clamp(e, 1e-18, 1.) : NAN);
      }
    }
  }
  return plot.with("key1", "top left").with("height", "600").take();
}

scene::Showing show(const Samples& all) {
  scene::Table table({{"model"},
                      {"omega (rad/s)"},
                      {"quantity"},
                      {"closed form", 1},
                      {"Krylov series", 1},
                      {"scaled", 1},
                      {"|omega G'/G|", 2}});
  std::vector<scene::Quantity> quantities;
  for (const bool tip : {false, true}) {
    const char* model = tip ? "with tips" : "no tips";
    const std::vector<Sample>& samples = all.at(tip ? 1 : 0);
    const std::array names = {"theta/u", "y(2 ft)/u", "y(4 ft)/u"};
    for (std::size_t n = 0; n < samples.size(); n += samples.size() / 8) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Sample& s = samples[n];
        const auto cell = [&](Form f) {
          const double e = s.error.at(static_cast<std::size_t>(f)).at(i);
          return std::isfinite(e) ? scene::Cell(e) : scene::Cell("no number");
        };
        table.add({model, s.omega, names.at(i), cell(Form::closed), cell(Form::krylov), cell(Form::scaled),
                   s.condition.at(i)});
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      quantities.push_back(scene::at_most(
          fmt::format("largest error of {}, scaled, {}", names.at(i), model), "1",
          worst(samples, Form::scaled, i, 0, HUGE_VAL, true), 1e-12,
          "promised: 1e-12 max(1, |omega G'/G|), against 100 digits, here divided by that condition"));
    }
    quantities.push_back({fmt::format("error of y(2 ft)/u, closed form, at 1e-8 rad/s, {}", model), "1",
                          worst(samples, Form::closed, 1, 0, 1.1e-8), 1e-2, HUGE_VAL,
                          "differences of 1 and beta x^4: eps/|beta x^4|, 1 % at 1e-6 rad/s, all at 1e-8"});
    quantities.push_back({fmt::format("error of theta/u, closed form, above 1e4 rad/s, {}", model), "1",
                          worst(samples, Form::closed, 0, 1e4, HUGE_VAL), 0.1, HUGE_VAL,
                          "eps e^(2 q L), of order one above 1000 rad/s"});
  }
  return {draw(all[1]), table, quantities};
}

}  // namespace

void add_accuracy(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Samples>(
      "errors-of-evaluations",
      "theta/u and y/u at s = j omega in double precision against decaying waves and an elimination in 100 "
      "digits",
      {}, [](Workshop& w) { return measure_all(w.quick()); });
  chapter.add({.name = "accuracy",
               .title = "Digits of three evaluations of the exact transfer functions",
               .place = "our own",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
}

}  // namespace nlmech::chapters
