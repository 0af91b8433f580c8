#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "chapters/gss_control/plant/extended.hpp"
#include "chapters/gss_control/plant/response_forms.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::gss_control::accuracy {
namespace {

/// Relative errors of theta/u, y(L/2)/u and y(L)/u by all forms at one frequency.
struct Sample {
  double omega = 0;
  std::array<double, 3> condition{};
  std::array<std::array<double, 3>, form_count> error{};
};

Sample measure(const spacecraft::Plant& plant, double omega) {
  const Extended exact = extended_response(plant.parameters(), omega);
  Sample s{omega, exact.condition, {}};
  for (std::size_t k = 0; k < form_count; ++k) {
    const auto form = static_cast<Form>(k);
    const double length = plant.parameters().length;
    const std::array<FormValue, 2> value = {evaluate(plant, form, omega, length / 2),
                                            evaluate(plant, form, omega, length)};
    const std::array<double, 3> computed = {value[0].theta, value[0].deflection, value[1].deflection};
    for (std::size_t i = 0; i < computed.size(); ++i)
      s.error.at(k).at(i) = std::abs(computed.at(i) / exact.value.at(i) - 1);
  }
  return s;
}

/// Samples without tip bodies, then with them.
using Samples = std::array<std::vector<Sample>, 2>;

Samples measure_all(bool quick) {
  Samples all;
  for (const bool tip : {false, true}) {
    const spacecraft::Plant plant(craft(tip));
    for (const double omega : logarithmic(1e-8, 1e8, quick ? 81 : 321))
      all.at(tip ? 1 : 0).push_back(measure(plant, omega));
  }
  return all;
}

/// Largest error over a range of frequencies; NaN and infinity count as 1, no correct digit.
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

void draw(const std::vector<Sample>& samples, scene::Show& show) {
  scene::Plot& plot =
      show.plots("Errors of three evaluations: only scaled waves are accurate at all frequencies");
  plot.stacked().size(760, 600).columns({"curve", "panel", "x", "y"});
  for (const std::size_t what : {0U, 1U}) {
    scene::Panel& panel =
        plot.panel("{/:Italic ω} (rad/s)", what == 0 ? "relative error of {/:Italic θ}/{/:Italic u}"
                                                     : "relative error of {/:Italic y}(2 ft)/{/:Italic u}");
    panel.log_x(1e-8, 1e8).log_y(1e-18, 1).key("top left");
    for (const auto& [form, style] : {std::pair{Form::closed, 2}, {Form::krylov, 4}, {Form::scaled, 1}}) {
      const auto error = [what, k = static_cast<std::size_t>(form)](const Sample& s) {
        const double e = s.error.at(k).at(what);
        return std::isfinite(e) ? std::clamp(e, 1e-18, 1.) : NAN;
      };
      panel.curve(what == 0 ? form_name(form) : "", samples, &Sample::omega, error, scene::lines(style));
    }
  }
}

constexpr std::array models = {"no tips", "with tips"};
constexpr std::array quantities = {"theta/u", "y(2 ft)/u", "y(4 ft)/u"};

void put(const Samples& all, scene::Show& show) {
  draw(all[1], show);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const std::vector<Sample>& samples = all.at(m);
    for (std::size_t i = 0; i < quantities.size(); ++i)
      show.at_most(
          fmt::format("largest error of {}, scaled, {}", quantities.at(i), models.at(m)),
          worst(samples, Form::scaled, i, 0, HUGE_VAL, true), 1e-12,
          "promised: 1e-12 max(1, |omega G'/G|), against 100 digits, here divided by that condition");
    show.between(fmt::format("error of y(2 ft)/u, closed form, at 1e-8 rad/s, {}", models.at(m)),
                 worst(samples, Form::closed, 1, 0, 1.1e-8), 1e-2, HUGE_VAL,
                 "differences of 1 and beta x^4: eps/|beta x^4|, 1 % at 1e-6 rad/s, all at 1e-8");
    show.between(fmt::format("error of theta/u, closed form, above 1e4 rad/s, {}", models.at(m)),
                 worst(samples, Form::closed, 0, 1e4, HUGE_VAL), 0.1, HUGE_VAL,
                 "eps e^(2 q L), of order one above 1000 rad/s");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result errors(
      "errors-of-evaluations",
      "theta/u and y/u at s = j omega in double precision against decaying waves and an elimination in 100 "
      "digits",
      measure_all);
  return {{.name = "accuracy",
           .title = "Digits of three evaluations of the exact transfer functions",
           .content = scene::Content(put, errors)}};
}

}  // namespace nlmech::chapters::gss_control::accuracy
