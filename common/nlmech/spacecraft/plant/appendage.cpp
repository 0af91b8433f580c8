#include "nlmech/spacecraft/plant/appendage.hpp"

#include <cmath>

#include "nlmech/support/sentences.hpp"

namespace nlmech::spacecraft {
namespace {

template <class T>
Motion<T> evaluate(const Ratios& ratios, const T& b, double size, Evaluation evaluation) {
  const bool series =
      evaluation == Evaluation::krylov || (evaluation == Evaluation::automatic && size < series_limit);
  return series ? motion_by_series(ratios, b) : motion_by_waves(ratios, b);
}

}  // namespace

Appendage::Appendage(const Parameters& parameters) : parameters_(parameters) {
  require_physical(parameters);
  const double l = parameters.length, mass = parameters.mass_per_length * l;
  ratios_ = {parameters.hub_radius / l, parameters.tip_mass / mass, parameters.tip_inertia / (mass * l * l),
             parameters.has_tip()};
  inertia_unit_ = mass * l * l;
  beta_unit_ = inertia_unit_ * l / parameters.bending_stiffness();
  deflection_unit_ = l * beta_unit_;
}

Motion<Complex> Appendage::motion(Complex s, Evaluation evaluation) const {
  const Complex b = s * s * beta_unit_;
  return evaluate(ratios_, b, std::abs(b), evaluation);
}

Motion<Jet> Appendage::motion_with_slope(Complex s) const {
  const Jet b(s * s * beta_unit_, 2. * s * beta_unit_);
  return evaluate(ratios_, b, std::abs(b.value), Evaluation::automatic);
}

Motion<double> Appendage::motion_at_frequency(double omega) const {
  const double b = -(omega * omega * beta_unit_);
  return evaluate(ratios_, b, -b, Evaluation::automatic);
}

Complex Appendage::inertia(Complex s) const {
  const Motion<Complex> m = motion(s);
  return inertia(m) / m.determinant;
}

Complex Appendage::deflection(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  return s * s * deflection(m, x) / m.determinant;
}

Complex Appendage::slope(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  return m.b * relative_deflection(m, ratios_, x / parameters_.length, 1) / m.determinant;
}

Complex Appendage::moment(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  const double unit = parameters_.bending_stiffness() / parameters_.length;
  return unit * (m.b * relative_deflection(m, ratios_, x / parameters_.length, 2) / m.determinant);
}

Complex Appendage::shear(Complex s, double x) const {
  require_place(x);
  const Motion<Complex> m = motion(s);
  const double unit = parameters_.bending_stiffness() / (parameters_.length * parameters_.length);
  return unit * (m.b * relative_deflection(m, ratios_, x / parameters_.length, 3) / m.determinant);
}

void Appendage::require_place(double x) const {
  if (!(x >= 0 && x <= parameters_.length))
    throw invalid_argument("spacecraft: x = {} is not on the appendage, 0 to {}", x, parameters_.length);
}

}  // namespace nlmech::spacecraft
