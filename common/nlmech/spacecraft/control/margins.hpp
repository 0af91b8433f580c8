/// @file
/// Robustness of the torque loop: crossover frequencies, phase, gain and delay margins, peaks of the
/// sensitivity, poles under a delay.
#pragma once

#include <vector>

#include "nlmech/spacecraft/control/closed_loop.hpp"

namespace nlmech::spacecraft {

/// The loop cut at the torque, L(s) = (k1 + k3 s + k2 s^2 B)/(s^2 (I_hub + 2B)), with 1 + L = P/(s^2 (I_hub +
/// 2B)), at s = j omega.
/// @return L; infinite on an open-loop pole
[[nodiscard]] Complex loop_gain(const ClosedLoop& loop, double omega);

/// |S(j omega)| = |1/(1 + L)|: how much the loop enlarges a disturbance torque.
[[nodiscard]] double sensitivity(const ClosedLoop& loop, double omega);

/// A frequency at which |L| = 1.
struct Crossover {
  double omega;         ///< rad/s
  double phase_margin;  ///< arg(-L) in (-pi, pi], rad: of a lag if positive
  double delay;         ///< the smallest delay that makes L e^(-j omega tau) = -1, s
};

/// What the loop bears.
struct Margins {
  std::vector<Crossover> crossovers;  ///< rising in omega
  double phase_margin = 0;            ///< the smallest modulus of all, rad
  double delay_margin = 0;  ///< the smallest delay that puts a pole on the axis, of all modes looked at, s
  double gain_margin = 0;   ///< all gains may grow by factors below this: infinite for k2 >= 0, else -2/k2
  Status status;            ///< success, or what the poles' was
};

/// Margins over the rigid mode and the first @p modes - 1 flexible ones. There is no smallest delay over all
/// of them: with k2 = 0 that of a high mode is pi/(2 omega), with k2 != 0 of the order 1/omega^2.
///
/// Tests hold the loop gain at every crossover to 1 and the delayed loop to a pole there, to 1e-7.
/// @param loop stable (k1, k3 > 0)
/// @param modes at least 1, at most 1000
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] Margins margins(const ClosedLoop& loop, int modes);

/// A local maximum of the sensitivity.
struct SensitivityPeak {
  double omega;  ///< rad/s
  double value;  ///< |S|
};

/// The maximum of |S| next to each of the first @p modes poles: within 8 times its damping to both sides, no
/// further than half-way to the next pole.
/// @throws std::invalid_argument as margins()
[[nodiscard]] std::vector<SensitivityPeak> sensitivity_peaks(const ClosedLoop& loop, int modes);

/// Poles of P(s) + (e^(-s tau) - 1) (k1 + k3 s + k2 s^2 B) = 0, each followed from that of tau = 0.
struct DelayedPoles {
  std::vector<Complex> s;  ///< one a pole of tau = 0, in its order
  int unstable = 0;        ///< how many of them have a positive real part
  Status status;           ///< success, or which pole could not be followed
};

/// The first @p modes poles under a loop delay. A delay also brings in infinitely many new ones from far
/// left, which are not looked at.
/// @param delay tau >= 0, s
/// @throws std::invalid_argument naming what is out of range
[[nodiscard]] DelayedPoles delayed_poles(const ClosedLoop& loop, double delay, int modes);

}  // namespace nlmech::spacecraft
