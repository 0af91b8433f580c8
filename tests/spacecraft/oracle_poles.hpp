/// @file
/// Poles of the spacecraft by its transfer functions in 110 digits, and distances of complex numbers.
#pragma once

#include <cmath>

#include "tests/errata/erratum.hpp"
#include "tests/spacecraft/oracle.hpp"

namespace nlmech::spacecraft::oracle {

/// Where a function rises through zero, to the last digit.
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

/// Complex numbers as evidence: how far each form is from the exact value, by its size.
inline tests::Evidence distances(Complex printed, Complex corrected, Complex exact, double tolerance) {
  return {std::abs(printed - exact), std::abs(corrected - exact), 0, tolerance, std::abs(exact)};
}

}  // namespace nlmech::spacecraft::oracle
