/// @file
/// The Pleiades: seven stars in a plane, with several close encounters.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x_i'' = G sum_j m_j (x_j - x_i)/r_ij^3, y_i'' the same, m_i = i, for seven stars (E. Hairer, S. P.
/// Norsett, G. Wanner, Solving Ordinary Differential Equations I, section II.10; Test Set for IVP Solvers,
/// University of Bari, problem plei). State: x1 to x7, y1 to y7, then the velocities in the same order.
struct Pleiades {
  static constexpr int stars = 7;                       ///< in the plane
  static constexpr int dimension = 4 * stars;           ///< positions, then velocities
  using compiled_once = Pleiades;                       ///< its System is compiled in the library
  static constexpr std::string_view name = "pleiades";  ///< on command lines and in tables
  static constexpr double initial_time = 0;             ///< t_0
  static constexpr double final_time = 3;               ///< of the test set
  using Coordinates = Vector<double, 2 * stars>;        ///< positions, or velocities
  double gravity = 1;                                   ///< G

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "q_i'' = G sum_j m_j (q_j - q_i)/|q_j - q_i|^3, i = 1..7, m_i = i; G gravity";

  /// By name.
  static constexpr std::array parameters = {Parameter<Pleiades>{"gravity", &Pleiades::gravity}};

  /// Of the test set.
  [[nodiscard]] static Vector<double, dimension> initial_state() {
    Vector<double, dimension> x = Vector<double, dimension>::Zero();
    x.head<stars>() << 3, 3, -1, -3, 2, -2, 2;
    x.segment<stars>(stars) << 3, -3, 2, 0, 0, -4, 4;
    x[2 * stars + 5] = 1.75;
    x[2 * stars + 6] = -1.5;
    x[3 * stars + 3] = -1.25;
    x[3 * stars + 4] = 1;
    return x;
  }

  /// Heads of columns: x1, ..., x7, y1, ..., y7, vx1, ...
  [[nodiscard]] static std::vector<std::string> state_names() {
    std::vector<std::string> names;
    for (const char* what : {"x", "y", "vx", "vy"}) {
      for (int i = 1; i <= stars; ++i) names.push_back(what + std::to_string(i));
    }
    return names;
  }

  /// Accelerations of all stars; each pair is looked at once.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 2 * stars>& q, const Vector<T, 2 * stars>& /*v*/,
                    Vector<T, 2 * stars>& a) const {
    using std::sqrt;
    for (int i = 0; i < 2 * stars; ++i) a[i] = T(0);
    for (int i = 0; i < stars; ++i) {
      for (int k = i + 1; k < stars; ++k) {
        const T x = q[k] - q[i], y = q[stars + k] - q[stars + i];
        const T square = x * x + y * y;
        const T pull = gravity / (square * sqrt(square));
        const T along_x = pull * x, along_y = pull * y;
        a[i] += (k + 1) * along_x;
        a[k] -= (i + 1) * along_x;
        a[stars + i] += (k + 1) * along_y;
        a[stars + k] -= (i + 1) * along_y;
      }
    }
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& t, const Vector<T, dimension>& x, Vector<T, dimension>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// Linear momentum (two components), angular momentum and energy.
  template <class T>
  [[nodiscard]] Vector<T, 4> invariants(const T& /*t*/, const Vector<T, dimension>& x) const {
    using std::sqrt;
    Vector<T, 4> kept = Vector<T, 4>::Constant(T(0));
    for (int i = 0; i < stars; ++i) {
      const double m = i + 1;
      const T &u = x[2 * stars + i], &v = x[3 * stars + i];
      kept[0] += m * u;
      kept[1] += m * v;
      kept[2] += m * (x[i] * v - x[stars + i] * u);
      kept[3] += m / 2 * (u * u + v * v);
      for (int k = i + 1; k < stars; ++k) {
        const T a = x[k] - x[i], b = x[stars + k] - x[stars + i];
        kept[3] -= gravity * (m * (k + 1)) / sqrt(T(a * a + b * b));
      }
    }
    return kept;
  }
};

}  // namespace nlmech::problems
