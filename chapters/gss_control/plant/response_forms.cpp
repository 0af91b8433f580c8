#include "chapters/gss_control/plant/response_forms.hpp"

#include "nlmech/spacecraft/plant/closed_form.hpp"

namespace nlmech::chapters::gss_control {
namespace {

using spacecraft::Complex;

//! [closed form and series]
FormValue by_closed_form(const spacecraft::Plant& plant, double omega, double x) {
  const spacecraft::GssSolution<Complex> solution(plant.parameters(), Complex(0, omega));
  return {solution.theta(x).real(), solution.deflection(x).real()};
}

FormValue by_series(const spacecraft::Plant& plant, double omega, double x) {
  const Complex s(0, omega);
  const auto motion = plant.appendage().motion(s, spacecraft::Evaluation::krylov);
  const Complex inertia = plant.effective_inertia(motion);
  return {(motion.determinant / (s * s * inertia)).real(),
          (plant.appendage().deflection(motion, x) / inertia).real()};
}

//! [closed form and series]

}  // namespace

const char* form_name(Form form) {
  switch (form) {
    case Form::closed: return "closed form in f";
    case Form::krylov: return "Krylov series";
    default: return "series, then scaled waves";
  }
}

FormValue evaluate(const spacecraft::Plant& plant, Form form, double omega, double x) {
  if (form == Form::closed) return by_closed_form(plant, omega, x);
  if (form == Form::krylov) return by_series(plant, omega, x);
  const spacecraft::AxisResponse r = plant.at_frequency(omega, x);
  return {r.theta, r.deflection};
}

}  // namespace nlmech::chapters::gss_control
