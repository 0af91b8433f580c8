/// @file
/// A complex number with its derivative by the Laplace variable s: what Newton's method and residues need.
#pragma once

#include <cmath>
#include <complex>

namespace nlmech::spacecraft {

/// A point of the plane of s, or a value there.
using Complex = std::complex<double>;

/// Are both parts finite?
[[nodiscard]] inline bool is_finite(const Complex& z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

/// An analytic function at one s: value and derivative. Arithmetic follows the rules of differentiation.
struct Jet {
  Complex value;  ///< F(s)
  Complex slope;  ///< dF/ds

  /// Zero, constant.
  Jet() = default;
  /// A constant.
  Jet(double constant) : value(constant) {}
  /// A constant.
  Jet(const Complex& constant) : value(constant) {}
  /// A value with its derivative.
  Jet(const Complex& f, const Complex& df) : value(f), slope(df) {}

  /// The variable itself.
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
  /// A part.
  friend Jet operator/(const Jet& a, double b) { return {a.value / b, a.slope / b}; }
  /// The principal root; not differentiable at 0.
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
