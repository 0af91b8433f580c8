/// @file
/// The residues of the closed loop's step response: poles that stand alone by their residue, poles that
/// nearly coincide together, by a circle round them.
#pragma once

#include <span>
#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"

namespace nlmech::spacecraft {

/// Weights of all signals for one exponential: theta, torque, then y at each place.
using Weights = std::vector<Complex>;

/// Exponentials common to all signals, of poles with Im >= 0.
struct ResidueTerms {
  /// What one pole, or poles that nearly coincide, add to the signals at t = 0.
  struct Group {
    double frequency = 0;  ///< the imaginary part, 1/s
    Weights value;         ///< of each signal
    Weights rate;          ///< of its derivative
  };
  std::vector<Complex> poles;    ///< p of e^(pt)
  std::vector<Weights> weights;  ///< one a pole; half the residue for a real one
  std::vector<Group> groups;     ///< rising in frequency
  double modes = 0;  ///< below the fastest decay: so many lie before residues begin to fall for good

  /// A pole that stands alone.
  void add(Complex pole, Weights weight);
};

/// All terms of the first @p pairs poles and of those that decay faster, for a step of the target to @p
/// scale.
///
/// Poles nearer to each other than a tenth of their own size and of the distance between modes have
/// residues that cancel, and none at all where they coincide: sums over a circle take their place,
/// exponentials at the poles or next to them that give the same motion. What s = 0 leaves, the constant
/// theta_f, is no term.
/// @param[out] status success; that of the poles; or not_converged where more than eight poles nearly
/// coincide
[[nodiscard]] ResidueTerms loop_residues(const ClosedLoop& loop, int pairs, double scale,
                                         std::span<const double> places, Status& status);

}  // namespace nlmech::spacecraft
