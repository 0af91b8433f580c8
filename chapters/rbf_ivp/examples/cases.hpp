/// @file
/// The three examples of section 4.4 (Elgohary 2015): equations, initial states, times, and their solutions
/// to some 18 digits, by which every method of this chapter is judged.
#pragma once

#include <span>

#include "nlmech/comparison/commands/example.hpp"

namespace nlmech::chapters::rbf_ivp {

using Extended = long double;  ///< x86: 64-bit significand, 11 bits more than double

/// An example of the dissertation. It ends at the printed time; its reference reaches 5 s further, within
/// 2e-16 of the solution.
struct Case : comparison::Example {
  double inferred_end;  ///< end to which the printed errors belong: 100 P, 499; else the printed one
  double half_period;   ///< of the slowest oscillation; figures show the greatest error of each such time
};

/// Eq. 4.22 with Table 4.1; the reference is Eq. 4.23, X cn(omega t | m), evaluated in extended precision.
/// Amplitudes: X and X sqrt(w^2 + eta X^2 / 2). Made at the first call.
[[nodiscard]] const Case& free_duffing_case();

/// The same oscillator with eta = 10 from x = 2, to t = 100: parameters on which nothing of this project was
/// chosen. Its motion is five times as fast and nearly that of a purely cubic spring. Made at the first call.
[[nodiscard]] const Case& held_back_case();

/// Eq. 4.24 with Table 4.3; the reference is a Taylor series of high order in extended precision. Amplitudes:
/// those of the free vibration that the impact leaves behind. Made at the first call.
[[nodiscard]] const Case& impact_case();

/// The same equation for methods that do as section 4.4.2 says: two integrations, from 0 to t_1 and from
/// there to the end. It does not announce the kink of the force at t_1/2, which all printed steps meet, so
/// that no method starts anew there; it matters to `hht` alone, whose stored acceleration a new start
/// forgets.
[[nodiscard]] const ivp::System& impact_in_two_intervals();

/// Eq. 4.25 (corrected) with Table 4.5 and the load of the paper; reference as for the impact. Amplitudes:
/// greatest magnitudes among 20 000 samples of the interval. Made at the first call.
[[nodiscard]] const Case& three_mass_case();

/// Period of the free Duffing oscillator of Table 4.1, 4.768022...; the table prints 4.77.
[[nodiscard]] double duffing_period();

/// The time t_1 at which the impact ends and steps change (Table 4.3).
[[nodiscard]] double impact_end();

/// Natural frequencies of the chain of three masses without its cubic springs, dampers and load, ascending.
[[nodiscard]] Eigen::Vector3d chain_frequencies();

/// found - reference(t), component by component, rounded once.
[[nodiscard]] inline ivp::State error_at(const Case& c, double t, const ivp::State& found) {
  return (found.cast<Extended>() - c.reference(t)).cast<double>();
}

/// Eq. 4.21 for a state, as "Normalized State Error" of the figures is read: each component is divided by its
/// own amplitude (a position and a velocity cannot be added otherwise), and the Euclidean norm is taken.
[[nodiscard]] inline double normalised_state_error(const Case& c, const ivp::State& error) {
  return error.cwiseQuotient(c.amplitude).norm();
}

/// sqrt(mean(e^2)). @throws std::invalid_argument if there is no value
[[nodiscard]] double root_mean_square(std::span<const double> errors);

}  // namespace nlmech::chapters::rbf_ivp
