/// @file
/// A chain of Duffing oscillators: as many degrees of freedom as one likes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x_i'' + w^2 x_i + eta x_i^3 = k (x_{i-1} - 2 x_i + x_{i+1}), x_0 = x_{N+1} = 0: N Duffing oscillators
/// between two walls, each coupled to its neighbours by a linear spring. State (x_1, ..., x_N, v_1, ...,
/// v_N), whose size is known when the number of masses is.
struct DuffingChain {
  static constexpr int dimension = Eigen::Dynamic;           ///< two components a mass
  using compiled_once = DuffingChain;                        ///< its System is compiled in the library
  static constexpr std::string_view name = "duffing-chain";  ///< on command lines and in tables
  static constexpr double initial_time = 0;                  ///< t_0
  static constexpr double final_time = 20;                   ///< some four periods
  using Components = Vector<double, Eigen::Dynamic>;         ///< state, positions or velocities
  double masses = 10;                                        ///< N, a whole number from 1 to 1000
  double natural_frequency = 1;                              ///< w, of one oscillator alone, rad/time
  double hardening = 1;                                      ///< eta, cubic stiffness
  double coupling = 1;                                       ///< k, stiffness between neighbours

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x_i'' + w^2 x_i + eta x_i^3 = k (x_{i-1} - 2 x_i + x_{i+1}), x_0 = x_{N+1} = 0; N masses, w "
      "natural-frequency, eta hardening, k coupling";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<DuffingChain>{"masses", &DuffingChain::masses, Range::count},
      Parameter<DuffingChain>{"natural-frequency", &DuffingChain::natural_frequency},
      Parameter<DuffingChain>{"hardening", &DuffingChain::hardening},
      Parameter<DuffingChain>{"coupling", &DuffingChain::coupling}};

  /// N.
  [[nodiscard]] int count() const { return static_cast<int>(masses); }
  /// Components of the state: 2 N.
  [[nodiscard]] int size() const { return 2 * count(); }

  /// At rest in half a wave, of amplitude 1 in the middle.
  [[nodiscard]] Components initial_state() const {
    const int n = count();
    Components x = Components::Zero(size());
    for (int i = 0; i < n; ++i) x[i] = std::sin(std::numbers::pi * (i + 1) / (n + 1));
    return x;
  }

  /// Heads of columns: x1, ..., v1, ...
  [[nodiscard]] std::vector<std::string> state_names() const {
    std::vector<std::string> names;
    for (const char* what : {"x", "v"}) {
      for (int i = 1; i <= count(); ++i) names.push_back(what + std::to_string(i));
    }
    return names;
  }

  /// Accelerations of all masses.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, Eigen::Dynamic>& q,
                    const Vector<T, Eigen::Dynamic>& /*v*/, Vector<T, Eigen::Dynamic>& a) const {
    for (int i = 0; i < count(); ++i) a[i] = pull(q, i);
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, Eigen::Dynamic>& x, Vector<T, Eigen::Dynamic>& dxdt) const {
    const int n = count();
    for (int i = 0; i < n; ++i) {
      dxdt[i] = x[n + i];
      dxdt[n + i] = pull(x, i);
    }
  }

  /// The energy.
  template <class T>
  [[nodiscard]] Vector<T, 1> invariants(const T& /*t*/, const Vector<T, Eigen::Dynamic>& x) const {
    const int n = count();
    T energy(0);
    for (int i = 0; i <= n; ++i) {
      const T left = i > 0 ? x[i - 1] : T(0), right = i < n ? x[i] : T(0), stretch = right - left;
      energy += coupling / 2 * (stretch * stretch);
      if (i == n) break;
      const T w = natural_frequency * right, square = right * right;
      energy += (x[n + i] * x[n + i] + w * w) / 2 + hardening / 4 * (square * square);
    }
    return Vector<T, 1>(energy);
  }

 private:
  /// Acceleration of the mass number @p i from 0, which needs the first components of @p x alone.
  template <class T>
  T pull(const Vector<T, Eigen::Dynamic>& x, int i) const {
    const T& own = x[i];
    T sum =
        -(natural_frequency * (natural_frequency * own)) - hardening * (own * own * own) - 2 * coupling * own;
    if (i > 0) sum += coupling * x[i - 1];
    if (i + 1 < count()) sum += coupling * x[i + 1];
    return sum;
  }
};

}  // namespace nlmech::problems
