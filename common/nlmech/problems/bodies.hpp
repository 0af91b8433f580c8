/// @file
/// Bodies that attract each other (Filipich and Rosales, section 4.2).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// x_i'' = G sum_k m_k (x_k - x_i)/|x_k - x_i|^3 in three dimensions (Filipich and Rosales, Eq. 61). State:
/// the positions (x, y, z) of the bodies one after the other, then their velocities. G = 1e-6 is no double,
/// so a reference in extended precision takes Real from the type it computes with.
/// @tparam Real type of the parameters; at most as precise as the T that the equation is evaluated with
/// @tparam n number of bodies, 2 or more
template <class Real, int n>
struct BasicBodies {
  static constexpr int dimension = 6 * n;             ///< three positions and velocities a body
  using compiled_once = BasicBodies<double, 4>;       ///< its System is compiled in the library
  static constexpr std::string_view name = "bodies";  ///< on command lines and in tables
  static constexpr double initial_time = 0;           ///< t_0
  static constexpr double final_time = 3000;          ///< before the closest encounters of the four bodies
  using Coordinates = Vector<double, 3 * n>;          ///< positions, or velocities

  /// G. The paper prints none: with velocities in tau = t/T only G T^2 matters, and 1e-6 makes motion and
  /// attraction of the four bodies comparable.
  Real gravity = Real(1) / 1000000;
  std::array<Real, static_cast<std::size_t>(n)> mass = default_masses();  ///< m_i

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "x_i'' = G sum_k m_k (x_k - x_i)/|x_k - x_i|^3; G gravity, m = 1, 1, 5, 1";

  /// By name.
  static constexpr std::array parameters = {Parameter<BasicBodies, Real>{"gravity", &BasicBodies::gravity}};

  /// Table 1 of the paper: four bodies, three of them at rest.
  [[nodiscard]] static Vector<double, dimension> initial_state() requires(n == 4) {
    Vector<double, dimension> x = Vector<double, dimension>::Zero();
    x.template segment<3>(3) << 3, 0, 0;
    x.template segment<3>(6) << 3, 4, 0;
    x.template segment<3>(9) << 1.5, 1.5, 0;
    x.template segment<3>(21) << -0.00125, 0.0005, 0.0005;
    return x;
  }

  /// Heads of columns: x1, y1, z1, x2, ..., then vx1, vy1, ...
  [[nodiscard]] static std::vector<std::string> state_names() {
    std::vector<std::string> names;
    for (const char* what : {"", "v"}) {
      for (int i = 1; i <= n; ++i) {
        for (const char* axis : {"x", "y", "z"}) names.push_back(what + (axis + std::to_string(i)));
      }
    }
    return names;
  }

  /// Accelerations of all bodies; each pair is looked at once.
  template <class T>
  void acceleration(const T& /*t*/, const Vector<T, 3 * n>& q, const Vector<T, 3 * n>& /*v*/,
                    Vector<T, 3 * n>& a) const {
    using std::pow;
    for (int i = 0; i < 3 * n; ++i) a[i] = T(0);
    for (int i = 0; i < n; ++i) {
      for (int k = i + 1; k < n; ++k) {
        std::array<T, 3> d;
        T square(0);
        for (int c = 0; c < 3; ++c) {
          T& difference = d[static_cast<std::size_t>(c)];
          difference = q[3 * k + c] - q[3 * i + c];
          square += difference * difference;
        }
        const T pull = gravity * pow(square, -1.5);
        for (int c = 0; c < 3; ++c) {
          const T force = pull * d[static_cast<std::size_t>(c)];
          a[3 * i + c] += mass[static_cast<std::size_t>(k)] * force;
          a[3 * k + c] -= mass[static_cast<std::size_t>(i)] * force;
        }
      }
    }
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& t, const Vector<T, dimension>& x, Vector<T, dimension>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// Linear momentum (three components) and energy.
  template <class T>
  [[nodiscard]] Vector<T, 4> invariants(const T& /*t*/, const Vector<T, dimension>& x) const {
    using std::sqrt;
    Vector<T, 4> kept = Vector<T, 4>::Constant(T(0));
    for (int i = 0; i < n; ++i) {
      const Real& m = mass[static_cast<std::size_t>(i)];
      const Vector<T, 3> v = x.template segment<3>(3 * (n + i));
      for (int c = 0; c < 3; ++c) {
        kept[c] += m * v[c];
        kept[3] += m / 2 * (v[c] * v[c]);
      }
      for (int k = i + 1; k < n; ++k) {
        const Vector<T, 3> d = x.template segment<3>(3 * k) - x.template segment<3>(3 * i);
        kept[3] -= gravity * m * mass[static_cast<std::size_t>(k)] /
                   sqrt(T(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
      }
    }
    return kept;
  }

 private:
  // Table 1: 1, 1, 5, 1; other numbers of bodies are all of mass 1.
  static constexpr std::array<Real, static_cast<std::size_t>(n)> default_masses() {
    std::array<Real, static_cast<std::size_t>(n)> m;
    m.fill(Real(1));
    if constexpr (n == 4) m[2] = Real(5);
    return m;
  }
};

/// With parameters in double precision.
template <int n>
using Bodies = BasicBodies<double, n>;

/// The four bodies of the paper.
using FourBodies = Bodies<4>;

}  // namespace nlmech::problems
