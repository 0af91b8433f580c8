#include "nlmech/spacecraft/plant/plant.hpp"

#include <cmath>
#include <limits>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
bool vanishes(double sum, double size, double waves) {
  return sum <= 4 * std::numeric_limits<double>::epsilon() * (1 + waves) * size;
}

Plant::Plant(const Parameters& parameters) : appendage_(parameters) {}

AxisResponse Plant::at_frequency(double omega, double x) const {
  appendage_.require_place(x);
  const Motion<double> m = appendage_.motion_at_frequency(omega);
  const double hub = parameters().hub_inertia * m.determinant, beams = 2 * appendage_.inertia(m),
               sum = hub + beams;
  AxisResponse r{m.determinant / (-(omega * omega) * sum), appendage_.deflection(m, x) / sum,
                 Outcome::success};
  if (vanishes(std::abs(sum), std::abs(hub) + std::abs(beams), m.wave_number) || !std::isfinite(r.theta))
    r.outcome = Outcome::at_pole;
  if (!std::isfinite(m.determinant) || !std::isfinite(sum)) r.outcome = Outcome::non_finite;
  return r;
}

Outcome Plant::response(Complex s, std::span<const double> x, Complex& theta, std::span<Complex> y) const {
  if (x.size() != y.size()) throw invalid_argument("Plant: {} places and {} deflections", x.size(), y.size());
  for (const double at : x) appendage_.require_place(at);
  const auto fill = [&](const auto& m, const auto& squared) {
    const auto hub = parameters().hub_inertia * m.determinant, beams = 2. * appendage_.inertia(m);
    const auto sum = hub + beams;
    theta = m.determinant / (squared * sum);
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = appendage_.deflection(m, x[i]) / sum;
    if (!std::isfinite(std::abs(m.determinant)) || !std::isfinite(std::abs(sum))) return Outcome::non_finite;
    const bool pole = vanishes(std::abs(sum), std::abs(hub) + std::abs(beams), m.wave_number);
    return pole || !is_finite(theta) ? Outcome::at_pole : Outcome::success;
  };
  if (s.real() == 0) return fill(appendage_.motion_at_frequency(s.imag()), -(s.imag() * s.imag()));
  return fill(appendage_.motion(s), s * s);
}

Outcome Plant::tip_torque_response(Complex s, std::span<const double> x, Complex& theta,
                                   std::span<Complex> y) const {
  if (x.size() != y.size()) throw invalid_argument("Plant: {} places and {} deflections", x.size(), y.size());
  for (const double at : x) appendage_.require_place(at);
  const Motion<Complex> hub = appendage_.motion(s), tip = appendage_.motion_by_tip_torque(s);
  const Complex sum = effective_inertia(hub), turn = 2. * appendage_.tip_rotation(hub) / sum;
  const auto real_on_axis = [s](Complex z) { return s.real() == 0 ? Complex(z.real()) : z; };
  theta = real_on_axis(turn / (s * s));
  bool finite = is_finite(theta);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Complex bend = appendage_.deflection(tip, x[i]) / appendage_.inertia_unit();
    y[i] = real_on_axis((turn * appendage_.deflection(hub, x[i]) + bend) / hub.determinant);
    finite = finite && is_finite(y[i]);
  }
  if (!is_finite(hub.determinant) || !is_finite(sum)) return Outcome::non_finite;
  return finite ? Outcome::success : Outcome::at_pole;
}

Response Plant::response(Complex s, double x) const {
  Response r{};
  r.outcome = response(s, std::span(&x, 1), r.theta, std::span(&r.deflection, 1));
  return r;
}

double Plant::static_deflection(double x) const {
  appendage_.require_place(x);
  const Motion<double> m = appendage_.motion_at_frequency(0);
  return appendage_.deflection(m, x) / effective_inertia(m);
}

Status Plant::status(Outcome outcome, Complex s) const {
  if (outcome == Outcome::success) return {};
  if (outcome == Outcome::at_pole) {
    return failed_with(
        outcome, "transfer function: s = {} + {} i is a pole to the rounding of s; choose another frequency",
        s.real(), s.imag());
  }
  return failed_with(
      outcome,
      "transfer function: s = {} + {} i is not finite, or too large: |s|^2 rho L^4/EI must stay below 1e200",
      s.real(), s.imag());
}

}  // namespace nlmech::spacecraft
