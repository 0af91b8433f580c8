/// @file
/// Reference for the tests of the spacecraft: the boundary value problem of Eqs. 3.15-3.16 in 110 digits, in
/// two ways, in physical units, independent of the library.
#pragma once

#include <cmath>
#include <complex>

#include "nlmech/spacecraft/control/closed_loop.hpp"
#include "tests/errata/erratum.hpp"

namespace nlmech::spacecraft::oracle {

using Complex = std::complex<double>;

/// Both transfer functions rounded to double, and their condition numbers |s G'/G|.
struct Exact {
  Complex theta, deflection;
  double theta_condition, deflection_condition;
};

/// w = y + (r + x) theta as a sum of exponentials that decay from root and tip: for any s.
[[nodiscard]] Exact by_exponentials(const Parameters& parameters, Complex s, double x);

/// w as a sum of cos, sin, cosh and sinh: up to |beta|^(1/4) L of about 60.
[[nodiscard]] Exact by_hyperbolics(const Parameters& parameters, Complex s, double x);

/// Zero of a function that increases through it, to the last digit.
template <class F>
double rise(const F& f, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > 0 ? high : low) = middle;
  }
  return low;
}

/// s^2 (I_hub + 2B) = 1/(theta/u).
inline Complex hub_load(const Parameters& p, Complex s) { return 1. / by_exponentials(p, s, 0).theta; }

/// P(s) = s^2 (I_hub + (2 + k2) B) + k3 s + k1, where s^2 (I_hub + kappa B) is a mean of s^2 I_hub and the
/// load of the hub.
inline Complex characteristic(const Parameters& p, const Gains& g, Complex s) {
  const Complex hub = s * s * p.hub_inertia;
  return hub + (1 + g.k2 / 2) * (hub_load(p, s) - hub) + g.k3 * s + g.k1;
}

/// The pole of the open loop between a hub-locked frequency and the next, rad/s.
inline double pole(const Parameters& p, double low, double high) {
  return rise([&](double omega) { return -hub_load(p, {0, omega}).real(); }, low, high);
}

/// The root of a function by the secant method, from near it.
template <class F>
Complex root_near(const F& f, Complex s) {
  Complex before = s * 1.00001, value = f(before);
  for (int i = 0; i < 40 && std::abs(s - before) > 1e-15 * std::abs(s); ++i) {
    const Complex here = f(s), step = here * (s - before) / (here - value);
    before = s;
    value = here;
    if (here == 0. || !std::isfinite(std::abs(step))) break;
    s -= step;
  }
  return s;
}

/// Composite rule of Gauss and Legendre with 3 points: of 400 panels, exact to 1e-13 for the functions here.
template <class F>
auto integral(double length, const F& f) {
  const double h = length / 400, far = std::sqrt(0.6) / 2;
  auto sum = f(0.) * 0.;
  for (int i = 0; i < 400; ++i) {
    const double middle = (i + 0.5) * h;
    sum += (5. * f(middle - far * h) + 8. * f(middle) + 5. * f(middle + far * h)) * (h / 18);
  }
  return sum;
}

/// Errors of complex numbers as evidence: distance of each form from the exact value, relative to it.
inline tests::Evidence distances(Complex printed, Complex corrected, Complex exact, double tolerance) {
  return {std::abs(printed - exact), std::abs(corrected - exact), 0, tolerance, std::abs(exact)};
}

}  // namespace nlmech::spacecraft::oracle
