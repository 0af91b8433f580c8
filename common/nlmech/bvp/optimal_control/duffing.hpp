/// @file
/// Optimal control problems of the Duffing oscillator (section 5.3).
#pragma once

#include <string_view>

#include "nlmech/bvp/optimal_control/direct_start.hpp"
#include "nlmech/bvp/optimal_control/extremal.hpp"
#include "nlmech/program/vector.hpp"

namespace nlmech::bvp {

/// x1' = x2, x2' = -omega^2 x1 - beta x1^3 + f with J = (x(T) - x_F)^T S (x(T) - x_F)/2 + integral f^2/2 (Eqs
/// 5.18 to 5.20; L is the integrand alone, unlike the printed Eq. 5.19). mu is beta.
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

/// Prescribed end values. The dissertation solves all cases except x2x2 and final_only, which Table 5.1
/// lists.
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

/// All cases in the order of the enumeration.
[[nodiscard]] std::vector<DuffingCase> duffing_cases();

/// beta of the dissertation for a case: 0.94 for x1x1 and x1x2, 0.97 for x2x1, else 0.9; also 0.9 for the
/// cases that it does not solve.
[[nodiscard]] double printed_beta(DuffingCase which);

/// Settings of one problem, with the values of Table 5.2 as defaults; T = 2 and S = I are assumptions, not
/// printed.
struct DuffingSettings {
  DuffingCase which = DuffingCase::free;  ///< prescribed end values
  double final_time = 2;                  ///< T
  double beta = 0.9;                      ///< nonlinearity
  double frequency = 1;                   ///< omega_n
  Eigen::Vector2d begin{0, 0};            ///< x(0) where prescribed
  Eigen::Vector2d target{5, 2};           ///< x_F; ignored by harmonic
  Eigen::Vector2d weights{1, 1};          ///< s_11, s_22
  Eigen::Vector3d amplitudes{1.5, 2, 3};  ///< a_1, a_2, a_3 of the harmonic state
  double harmonic_frequency = 3;          ///< omega of the harmonic state
  Constraints constraints = {};           ///< bounds, see solve_bounded
  std::vector<Waypoint> waypoints = {};   ///< prescribed states at interior times
  bool free_final_time = false;           ///< whether T is unknown, with final_time as initial guess
};

/// Target x_F; for the harmonic case by Eq. 5.34.
[[nodiscard]] Eigen::Vector2d duffing_target(const DuffingSettings& settings);

/// Boundary value problem of the extremals.
[[nodiscard]] ExtremalProblem duffing_problem(const DuffingSettings& settings);

/// Initial guess for many oscillations: trajectory under the cheapest force that raises the energy E, f = g
/// x2/sqrt(m(E)), with the mean m of x2^2 over one oscillation. The integral of dE/sqrt(m) then grows
/// linearly in time. (For f = p x2 the mean of E' is p m, at a cost of p^2 m/2, which is least for constant
/// E'/sqrt(m).) Integrated backward from the target, with lambda2 = -f and lambda1 = -dlambda2/dt. The cost
/// is (integral of dE/sqrt(m))^2/(2 T), about 3 E/(2 T).
/// @param strength g relative to the value that reaches the energy of the initial state in the mean; 1.02 is
/// best, 0.9 to 1.2 lead to adjacent extremals
[[nodiscard]] Start pump_start(const DuffingSettings& settings, double strength);

/// Initial guess from the unforced trajectory with lambda = 0, forward from x(0) or backward from x(T).
[[nodiscard]] Start unforced_start(const DuffingSettings& settings, const Eigen::Vector2d& x,
                                   bool from_the_end);

/// Number of starts of each kind for duffing_starts().
struct DuffingStarts {
  bool constants = true;  ///< whether to include the constants 0 and 1
  int unforced = 12;      ///< unforced trajectories over the free initial values
  int pumps = 6;          ///< pump_start with strengths 0.9 to 1.2
  int direct = 12;        ///< direct_start: zero, constant, harmonic forces; or over free initial values
  int random = 12;        ///< random_start
  unsigned seed = 1;      ///< seed of the random starts
  /// direct_start from pump_start with strengths 1 to 1.08, if T is at least four oscillations; 20 ms per
  /// oscillation.
  int driven = 6;
};

/// Automatic starts, computed from the settings alone.
[[nodiscard]] std::vector<Start> duffing_starts(const DuffingSettings& settings,
                                                const DuffingStarts& which = {});

/// All extremals from the automatic starts, in order of cost, with their kind.
[[nodiscard]] Multistart duffing_extremals(const DuffingSettings& settings, const DuffingStarts& which = {},
                                           const Options& options = {},
                                           const MultistartOptions& many = {.second_order_pieces = 80});

}  // namespace nlmech::bvp
