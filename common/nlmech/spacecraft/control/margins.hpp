/// @file
/// Robustness of the torque loop: crossover frequencies, phase, gain and delay margins, peaks of the
/// sensitivity, poles under a delay.
#pragma once

#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"

namespace nlmech::spacecraft {

/// Loop gain, with the loop opened at the torque, L(s) = (k1 + k3 s + k2 s^2 B)/(s^2 (I_hub + 2B)), with 1 +
/// L = P/(s^2 (I_hub + 2B)), at s = j omega.
/// @return L; infinite on an open-loop pole
[[nodiscard]] Complex loop_gain(const ClosedLoop& loop, double omega);

/// |S(j omega)| = |1/(1 + L)|: sensitivity, the amplification of a disturbance torque by the loop.
[[nodiscard]] double sensitivity(const ClosedLoop& loop, double omega);

/// A frequency at which |L| = 1.
struct Crossover {
  double omega;         ///< rad/s
  double phase_margin;  ///< arg(-L) in (-pi, pi], rad; positive: a lag destabilises
  double delay;         ///< the smallest delay that makes L e^(-j omega tau) = -1, s
};

/// Stability margins.
struct Margins {
  std::vector<Crossover> crossovers;  ///< in increasing order of omega
  double phase_margin = 0;            ///< smallest modulus over all crossovers, rad
  double delay_margin = 0;  ///< smallest delay that puts a pole of these modes on the imaginary axis, s
  double gain_margin = 0;   ///< the loop is stable with all gains multiplied by factors below this: infinite
                            ///< for k2 >= 0, else -2/k2
  Status status;            ///< success, or the status of the poles
};

/// Margins over the rigid mode and the first @p modes - 1 flexible modes. Over all modes there is no positive
/// delay margin: that of a high mode is pi/(2 omega) for k2 = 0, and of the order 1/omega^2 for k2 != 0.
///
/// Tests check that the loop gain is 1 at every crossover and that the delayed loop has a pole there (1e-7).
/// @param loop stable (k1, k3 > 0)
/// @param modes at least 1, at most 1000
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] Margins margins(const ClosedLoop& loop, int modes);

/// A local maximum of the sensitivity.
struct SensitivityPeak {
  double omega;  ///< rad/s
  double value;  ///< |S|
};

/// The maximum of |S| near each of the first @p modes poles: within 8 times the pole's decay rate to both
/// sides, but at most half the distance to the adjacent pole.
/// @throws std::invalid_argument as margins()
[[nodiscard]] std::vector<SensitivityPeak> sensitivity_peaks(const ClosedLoop& loop, int modes);

/// Poles of P(s) + (e^(-s tau) - 1) (k1 + k3 s + k2 s^2 B) = 0, each continued from a pole at tau = 0.
struct DelayedPoles {
  std::vector<Complex> s;  ///< one per pole at tau = 0, in the same order
  int unstable = 0;        ///< number of poles with a positive real part
  Status status;           ///< success, or the pole whose continuation failed
};

/// The first @p modes poles under a loop delay. A delay also adds infinitely many poles from Re s =
/// -infinity, which are not computed.
/// @param delay tau >= 0, s
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] DelayedPoles delayed_poles(const ClosedLoop& loop, double delay, int modes);

}  // namespace nlmech::spacecraft
