/// @file
/// Equations as a user of another library writes them: on an array of that library, without ours. For
/// benchmarks; a test holds them to the problems.
#pragma once

#include <cmath>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/lorenz.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/two_body.hpp"

namespace nlmech::chapters {

/// The free oscillator.
struct PlainDuffing {
  problems::Duffing p;  ///< its parameters
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double /*t*/) const {
    dxdt[0] = x[1];
    dxdt[1] = -p.natural_frequency * p.natural_frequency * x[0] - p.hardening * x[0] * x[0] * x[0];
  }
};

/// The oscillator under an impact.
struct PlainImpact {
  problems::ImpactDuffing p;  ///< its parameters
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double t) const {
    double force = 0;
    if (t >= 0 && t < p.duration) force = p.slope * (t < p.duration / 2 ? t : p.duration - t);
    dxdt[0] = x[1];
    dxdt[1] = force - p.natural_frequency * p.natural_frequency * x[0] - p.hardening * x[0] * x[0] * x[0];
  }
};

/// Lorenz's equations.
struct PlainLorenz {
  problems::Lorenz p;  ///< its parameters
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double /*t*/) const {
    dxdt[0] = p.sigma * (x[1] - x[0]);
    dxdt[1] = x[0] * (p.r - x[2]) - x[1];
    dxdt[2] = x[0] * x[1] - p.b * x[2];
  }
};

/// The chain of three masses.
struct PlainChain {
  problems::ThreeMassChain p;  ///< its parameters
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double t) const {
    const double e1 = spring(p.k1, p.c1, p.l1, x[0], x[3]);
    const double e2 = spring(p.k2, p.c2, p.l2, x[0] - x[1], x[3] - x[4]);
    const double e3 = spring(p.k3, p.c3, p.l3, x[1] - x[2], x[4] - x[5]);
    const double e4 = spring(p.k4, p.c4, p.l4, x[2], x[5]);
    dxdt[0] = x[3], dxdt[1] = x[4], dxdt[2] = x[5];
    dxdt[3] = (-e1 - e2) / p.m1;
    dxdt[4] = (p.force * std::cos(p.frequency * t) + e2 - e3) / p.m2;
    dxdt[5] = (e3 - e4) / p.m3;
  }

 private:
  static double spring(double k, double c, double l, double d, double rate) {
    return k * d + c * rate + l * d * d * d;
  }
};

/// Kepler's problem.
struct PlainTwoBody {
  problems::TwoBody p;  ///< its parameter
  /// dx/dt.
  template <class In, class Out>
  void operator()(const In& x, Out&& dxdt, double /*t*/) const {
    const double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const double factor = -p.mu / (square * std::sqrt(square));
    for (int i = 0; i < 3; ++i) {
      dxdt[i] = x[i + 3];
      dxdt[i + 3] = factor * x[i];
    }
  }
};

}  // namespace nlmech::chapters
