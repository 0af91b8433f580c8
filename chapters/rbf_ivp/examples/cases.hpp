/// @file
/// The three examples of section 4.4 (Elgohary 2015): equations, initial states, times, and reference
/// solutions to some 18 digits.
#pragma once

#include <span>

#include "nlmech/comparison/commands/example.hpp"

namespace nlmech::chapters::rbf_ivp {

using Extended = long double;  ///< x86: 64-bit significand, 11 bits more than double

/// An example of the dissertation. It ends at the printed time; its reference extends 5 s further and is
/// within 2e-16 of the solution.
struct Case : comparison::Example {
  double inferred_end;  ///< end time of the printed errors: 100 P, 499 s; otherwise the printed end
  double half_period;   ///< half period of the slowest oscillation; figures show the largest error in each
};

/// Eq. 4.22 with Table 4.1; the reference is Eq. 4.23, X cn(omega t | m), evaluated in extended precision.
/// Amplitudes: X and X sqrt(w^2 + eta X^2 / 2). Computed at the first call.
[[nodiscard]] const Case& free_duffing_case();

/// Holdout problem: the oscillator with eta = 10 from x = 2, to t = 100; no setting was tuned on it. Its
/// motion is five times as fast and nearly that of a purely cubic spring. Computed at the first call.
[[nodiscard]] const Case& holdout_case();

/// Eq. 4.24 with Table 4.3; the reference is a Taylor series of high order in extended precision. Amplitudes:
/// those of the free vibration after the impact. Computed at the first call.
[[nodiscard]] const Case& impact_case();

/// The equation of impact_case() for two integrations as in section 4.4.2: from 0 to t_1, and from t_1 to the
/// end. It does not declare the kink of the force at t_1/2, at which all printed steps end, so no method
/// restarts there. This matters only for `hht`, whose stored acceleration a restart discards.
[[nodiscard]] const ivp::System& impact_in_two_intervals();

/// Eq. 4.25 (corrected) with Table 4.5 and the load of the paper; reference as for the impact. Amplitudes:
/// largest magnitudes among 20 000 samples of the interval. Computed at the first call.
[[nodiscard]] const Case& three_mass_case();

/// Period of the free Duffing oscillator of Table 4.1, 4.768022...; the table prints 4.77.
[[nodiscard]] double duffing_period();

/// Time t_1 at which the impact ends and the step size changes (Table 4.3), s.
[[nodiscard]] double impact_end();

/// Natural frequencies of the chain of three masses without its cubic springs, dampers and load, ascending.
[[nodiscard]] Eigen::Vector3d chain_frequencies();

/// Error found - reference(t) of each component, rounded once.
[[nodiscard]] inline ivp::State error_at(const Case& c, double t, const ivp::State& found) {
  return (found.cast<Extended>() - c.reference(t)).cast<double>();
}

/// Eq. 4.21 for a state, our reading of "Normalized State Error" in the figures: Euclidean norm of the
/// components divided by their amplitudes, since positions and velocities have different units.
[[nodiscard]] inline double normalised_state_error(const Case& c, const ivp::State& error) {
  return error.cwiseQuotient(c.amplitude).norm();
}

/// sqrt(mean(e^2)). @throws std::invalid_argument if there is no value
[[nodiscard]] double root_mean_square(std::span<const double> errors);

}  // namespace nlmech::chapters::rbf_ivp
