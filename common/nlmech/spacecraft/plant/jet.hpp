/// @file
/// Complex number with its derivative with respect to the Laplace variable s, for Newton's method and
/// residues.
#pragma once

#include <cmath>
#include <complex>

namespace nlmech::spacecraft {

/// A complex number: s, or a function value.
using Complex = std::complex<double>;

/// Whether both parts are finite.
[[nodiscard]] inline bool is_finite(const Complex& z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

/// Value and derivative of an analytic function at one s. The operators apply the rules of differentiation.
struct Jet {
  Complex value;  ///< F(s)
  Complex slope;  ///< dF/ds

  /// The constant 0.
  Jet() = default;
  /// A constant.
  Jet(double constant) : value(constant) {}
  /// A constant.
  Jet(const Complex& constant) : value(constant) {}
  /// A value with its derivative.
  Jet(const Complex& f, const Complex& df) : value(f), slope(df) {}

  /// The variable s, with derivative 1.
  [[nodiscard]] static Jet variable(const Complex& s) { return {s, 1.}; }

  /// The sum.
  friend Jet operator+(const Jet& a, const Jet& b) { return {a.value + b.value, a.slope + b.slope}; }
  /// The difference.
  friend Jet operator-(const Jet& a, const Jet& b) { return {a.value - b.value, a.slope - b.slope}; }
  /// The negative.
  friend Jet operator-(const Jet& a) { return {-a.value, -a.slope}; }
  /// The product.
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  /// A multiple.
  friend Jet operator*(double a, const Jet& b) { return {a * b.value, a * b.slope}; }
  /// A multiple.
  friend Jet operator*(const Jet& a, double b) { return {a.value * b, a.slope * b}; }
  /// The quotient.
  friend Jet operator/(const Jet& a, const Jet& b) {
    const Complex q = a.value / b.value;
    return {q, (a.slope - q * b.slope) / b.value};
  }
  /// A quotient by a real number.
  friend Jet operator/(const Jet& a, double b) { return {a.value / b, a.slope / b}; }
  /// The principal square root; not differentiable at 0.
  friend Jet sqrt(const Jet& a) {
    const Complex root = std::sqrt(a.value);
    return {root, a.slope / (2. * root)};
  }
  /// The exponential.
  friend Jet exp(const Jet& a) {
    const Complex e = std::exp(a.value);
    return {e, a.slope * e};
  }
};

}  // namespace nlmech::spacecraft
