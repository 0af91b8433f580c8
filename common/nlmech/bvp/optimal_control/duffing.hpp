/// @file
/// The Duffing oscillator under an unknown force: the optimal control problems of section 5.3.
#pragma once

#include <string_view>

#include "nlmech/bvp/optimal_control/direct_start.hpp"
#include "nlmech/bvp/optimal_control/extremal.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::bvp {

/// x1' = x2, x2' = -omega^2 x1 - beta x1^3 + f with J = (x(T) - x_F)^T S (x(T) - x_F)/2 + integral f^2/2
/// (Eqs 5.18 to 5.20; L is the integrand alone, against the print of 5.19). mu is beta.
struct ControlledDuffing {
  static constexpr int states = 2;    ///< position, velocity
  static constexpr int controls = 1;  ///< f
  double frequency = 1;               ///< omega_n
  double target_position = 5;         ///< x_1F
  double target_velocity = 2;         ///< x_2F
  double position_weight = 1;         ///< s_11 >= 0
  double velocity_weight = 1;         ///< s_22 >= 0

  /// Eq. 5.18.
  template <class T>
  void dynamics(const T& /*t*/, const Vector<T, 2>& x, const Vector<T, 1>& f, const T& beta,
                Vector<T, 2>& g) const {
    g[0] = x[1];
    g[1] = f[0] - frequency * (frequency * x[0]) - beta * (x[0] * x[0] * x[0]);
  }
  /// f^2/2.
  template <class T>
  T running_cost(const T& /*t*/, const Vector<T, 2>& /*x*/, const Vector<T, 1>& f, const T& /*beta*/) const {
    return f[0] * f[0] / 2.0;
  }
  /// Eq. 5.19.
  template <class T>
  T end_cost(const Vector<T, 2>& /*x0*/, const Vector<T, 2>& xF, const T& /*tF*/) const {
    const T position = xF[0] - target_position, velocity = xF[1] - target_velocity;
    return position_weight / 2 * (position * position) + velocity_weight / 2 * (velocity * velocity);
  }
};

/// What is prescribed. The dissertation solves all but x2x2 and final_only, which stand in its Table 5.1.
enum class DuffingCase : std::uint8_t {
  free,        ///< x(0); free final state (Eqs 5.23 to 5.25)
  fixed,       ///< x(0), x(T) (Eqs 5.26 to 5.28)
  x1x1,        ///< x1(0), x1(T) (Eq. 5.29)
  x1x2,        ///< x1(0), x2(T) (Eq. 5.30)
  x2x1,        ///< x2(0), x1(T) (Eq. 5.31)
  x2x2,        ///< x2(0), x2(T) (Table 5.1, last row)
  final_only,  ///< x(T); free start (Table 5.1, first row)
  harmonic     ///< x(0), x(T) of a harmonic state (Eqs 5.32 to 5.34)
};

/// "x1x2", "final-only".
[[nodiscard]] std::string_view to_string(DuffingCase which);

/// All of them in the order of the enumeration.
[[nodiscard]] std::vector<DuffingCase> duffing_cases();

/// beta that the dissertation states for a case: 0.9, x1x1 and x1x2 0.94, x2x1 0.97; 0.9 for those that it
/// does not solve.
[[nodiscard]] double printed_beta(DuffingCase which);

/// One problem with the values of Table 5.2; T = 2 and S = I are readings.
struct DuffingSettings {
  DuffingCase which = DuffingCase::free;  ///< what is prescribed
  double final_time = 2;                  ///< T
  double beta = 0.9;                      ///< nonlinearity
  double frequency = 1;                   ///< omega_n
  Eigen::Vector2d begin{0, 0};            ///< x(0) where prescribed
  Eigen::Vector2d target{5, 2};           ///< x_F; ignored by harmonic
  Eigen::Vector2d weights{1, 1};          ///< s_11, s_22
  Eigen::Vector3d amplitudes{1.5, 2, 3};  ///< a_1, a_2, a_3 of the harmonic state
  double harmonic_frequency = 3;          ///< omega of the harmonic state
  Constraints constraints = {};           ///< bounds, see solve_bounded
  std::vector<Waypoint> waypoints = {};   ///< prescribed states between
  bool free_final_time = false;           ///< T is a first guess only
};

/// x_F; for the harmonic case by Eq. 5.34.
[[nodiscard]] Eigen::Vector2d duffing_target(const DuffingSettings& settings);

/// The problem of extremals.
[[nodiscard]] ExtremalProblem duffing_problem(const DuffingSettings& settings);

/// Trajectory under the cheapest force that raises the energy E over many swings: f = g x2/sqrt(m(E)), m the
/// mean of x2^2 over a swing, so that the integral of dE/sqrt(m) grows linearly in time. (The mean of E' is
/// p m for f = p x2, at a cost of p^2 m/2; least for E'/sqrt(m) constant.) Integrated backward from the
/// target, with lambda2 = -f and lambda1 = -dlambda2/dt. It costs (integral of dE/sqrt(m))^2/(2 T), about 3
/// E/(2 T).
/// @param strength g over the one that reaches the start's energy by that mean; 1.02 is best, 0.9 to 1.2 lead
/// to neighbouring extremals
[[nodiscard]] Start pump_start(const DuffingSettings& settings, double strength);

/// The unforced trajectory, lambda = 0, from x(0); or backward from x(T).
[[nodiscard]] Start unforced_start(const DuffingSettings& settings, const Eigen::Vector2d& x,
                                   bool from_the_end);

/// How many starts of each kind, see duffing_starts().
struct DuffingStarts {
  bool constants = true;  ///< zeros and ones
  int unforced = 12;      ///< trajectories without force, over the free values of the start
  int pumps = 6;          ///< pump_start of strengths 0.9 to 1.2
  int direct = 12;        ///< direct_start from zero, constant, pumping and unforced guesses
  int random = 12;        ///< random_start
  unsigned seed = 1;      ///< of the random ones
  /// direct_start from pump_start of strengths 1 to 1.08, where T holds four swings or more; 20 ms a swing.
  int driven = 6;
};

/// The program's own starts: nothing but the settings goes in.
[[nodiscard]] std::vector<Start> duffing_starts(const DuffingSettings& settings,
                                                const DuffingStarts& which = {});

/// All extremals that the own starts lead to, cheapest first, with their kind.
[[nodiscard]] Multistart duffing_extremals(const DuffingSettings& settings, const DuffingStarts& which = {},
                                           const Options& options = {},
                                           const MultistartOptions& many = {.second_order_pieces = 80});

}  // namespace nlmech::bvp
