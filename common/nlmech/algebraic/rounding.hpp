/// @file
/// Rounding level of F and V: their change under perturbations of x in its last digits.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "nlmech/algebraic/equations.hpp"

namespace nlmech::algebraic {

/// out = x with every component changed by one or two units in its last place, up or down by pseudo-random
/// bits.
/// @param sequence number of the bit sequence
inline void perturb_last_bits(const Eigen::VectorXd& x, std::uint64_t sequence, Eigen::VectorXd& out) {
  out.resize(x.size());
  std::uint64_t bits = 0x9E3779B97F4A7C15ULL * (sequence + 1);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    bits = 6364136223846793005ULL * bits + 1442695040888963407ULL;
    out[i] = x[i] * (1 + ((bits >> 62) & 1 ? 1 : -1) * std::numeric_limits<double>::epsilon());
  }
}

/// Largest change of V under two perturbations of x by perturb_last_bits(); at least eps |V|.
/// @param energy V(x)
/// @param work overwritten
[[nodiscard]] inline double rounding_of_energy(Potential& equations, const Eigen::VectorXd& x, double energy,
                                               Eigen::VectorXd& work) {
  double most = std::numeric_limits<double>::epsilon() * std::abs(energy);
  for (std::uint64_t sequence = 0; sequence < 2; ++sequence) {
    perturb_last_bits(x, sequence, work);
    const double change = std::abs(equations.energy(work) - energy);
    if (std::isfinite(change)) most = std::max(most, change);
  }
  return most;
}

/// Euclidean norm, without underflow where the squares of the components underflow.
[[nodiscard]] inline double length_of(const Eigen::VectorXd& f) {
  const double length = f.norm();
  return length < 1e-140 && f.size() > 0 ? f.stableNorm() : length;
}

/// Largest size(F(x') - F(x)) of two perturbations x' of x by perturb_last_bits().
/// @param f F(x)
/// @param size norm of a change of F
template <class Size>
[[nodiscard]] double rounding_of_residual(Equations& equations, const Eigen::VectorXd& x,
                                          const Eigen::VectorXd& f, const Size& size) {
  Eigen::VectorXd at, change(f.size());
  double most = 0;
  for (std::uint64_t sequence = 0; sequence < 2; ++sequence) {
    perturb_last_bits(x, sequence, at);
    equations.residual(at, change);
    change -= f;
    const double here = size(change);
    if (std::isfinite(here)) most = std::max(most, here);
  }
  return most;
}

}  // namespace nlmech::algebraic
