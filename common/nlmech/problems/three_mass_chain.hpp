/// @file
/// Three masses in a chain of nonlinear springs and dampers (Elgohary 2015, Eq. 4.25 and Fig. 4.30).
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "nlmech/problems/parameters.hpp"
#include "nlmech/problems/problem.hpp"

namespace nlmech::problems {

/// A chain wall - m1 - m2 - m3 - wall. Element j connects mass j - 1 with mass j (the walls stand at both
/// ends) and carries the force k_j d + l_j d^3 + c_j d' for its shortening d = x_{j-1} - x_j; a load
/// F cos(Omega t) acts on the second mass (Elgohary 2015, Eq. 4.25 corrected). State (x1, x2, x3, v1, v2,
/// v3).
///
/// Values are those of Table 4.5; F and Omega are missing there and come from Table 5 of Elgohary, Dong,
/// Junkins and Atluri, CMES 100 (2014) 249-275. Several of them (0.05, 0.2, sqrt(1/2)) are no doubles, so a
/// reference in extended precision takes Real from the type it computes with.
/// @tparam Real type of the parameters; at most as precise as the T that the equation is evaluated with
template <class Real>
struct BasicThreeMassChain {
  static constexpr int dimension = 6;                    ///< three positions, then three velocities
  using compiled_once = BasicThreeMassChain<double>;     ///< its System is compiled in the library
  static constexpr std::string_view name = "three-dof";  ///< on command lines and in tables
  static constexpr double initial_time = 0;              ///< t_0
  static constexpr double final_time = 200;              ///< t_F, Table 4.5

  Real m1 = 2;                   ///< first mass
  Real m2 = 1;                   ///< second mass, which carries the load
  Real m3 = Real(1) / 2;         ///< third mass
  Real c1 = 0;                   ///< damping between wall and first mass
  Real c2 = Real(1) / 20;        ///< damping between first and second mass
  Real c3 = 0;                   ///< damping between second and third mass
  Real c4 = 0;                   ///< damping between third mass and wall
  Real k1 = 2;                   ///< linear stiffness between wall and first mass
  Real k2 = 1;                   ///< linear stiffness between first and second mass
  Real k3 = Real(1) / 2;         ///< linear stiffness between second and third mass
  Real k4 = 0;                   ///< linear stiffness between third mass and wall
  Real l1 = Real(1) / 5;         ///< cubic stiffness between wall and first mass
  Real l2 = 0;                   ///< cubic stiffness between first and second mass
  Real l3 = 0;                   ///< cubic stiffness between second and third mass
  Real l4 = 0;                   ///< cubic stiffness between third mass and wall
  Real force = Real(1) / 5;      ///< F, amplitude of the load
  Real frequency = root_half();  ///< Omega, angular frequency of the load, rad/time

  /// The equation as one types it.
  static constexpr std::string_view equation =
      "m1 x1'' = -e1 - e2, m2 x2'' = e2 - e3 + F cos(W t), m3 x3'' = e3 - e4; spring j "
      "has e_j = kj d + lj d^3 + cj d' with d = x1, x1 - x2, x2 - x3, x3; F force, W "
      "frequency";

  /// By name.
  static constexpr std::array parameters = {
      Parameter<BasicThreeMassChain, Real>{"m1", &BasicThreeMassChain::m1, Range::positive},
      Parameter<BasicThreeMassChain, Real>{"m2", &BasicThreeMassChain::m2, Range::positive},
      Parameter<BasicThreeMassChain, Real>{"m3", &BasicThreeMassChain::m3, Range::positive},
      Parameter<BasicThreeMassChain, Real>{"c1", &BasicThreeMassChain::c1},
      Parameter<BasicThreeMassChain, Real>{"c2", &BasicThreeMassChain::c2},
      Parameter<BasicThreeMassChain, Real>{"c3", &BasicThreeMassChain::c3},
      Parameter<BasicThreeMassChain, Real>{"c4", &BasicThreeMassChain::c4},
      Parameter<BasicThreeMassChain, Real>{"k1", &BasicThreeMassChain::k1},
      Parameter<BasicThreeMassChain, Real>{"k2", &BasicThreeMassChain::k2},
      Parameter<BasicThreeMassChain, Real>{"k3", &BasicThreeMassChain::k3},
      Parameter<BasicThreeMassChain, Real>{"k4", &BasicThreeMassChain::k4},
      Parameter<BasicThreeMassChain, Real>{"l1", &BasicThreeMassChain::l1},
      Parameter<BasicThreeMassChain, Real>{"l2", &BasicThreeMassChain::l2},
      Parameter<BasicThreeMassChain, Real>{"l3", &BasicThreeMassChain::l3},
      Parameter<BasicThreeMassChain, Real>{"l4", &BasicThreeMassChain::l4},
      Parameter<BasicThreeMassChain, Real>{"force", &BasicThreeMassChain::force},
      Parameter<BasicThreeMassChain, Real>{"frequency", &BasicThreeMassChain::frequency}};

  /// Table 4.5: at rest.
  [[nodiscard]] static Vector<double, 6> initial_state() { return Vector<double, 6>::Zero(); }

  /// Accelerations of the three masses (Eq. 4.25 with c1 x1' for the printed c1 x1, and c2 (x1' - x2') for
  /// the printed c2 (x2' - x2')). Cubic terms with the coefficient 0 are not formed.
  template <class T>
  void acceleration(const T& t, const Vector<T, 3>& q, const Vector<T, 3>& v, Vector<T, 3>& a) const {
    using std::cos;
    const T e1 = element(k1, c1, l1, q[0], v[0]), e2 = element(k2, c2, l2, T(q[0] - q[1]), T(v[0] - v[1]));
    const T e3 = element(k3, c3, l3, T(q[1] - q[2]), T(v[1] - v[2])), e4 = element(k4, c4, l4, q[2], v[2]);
    a[0] = (-e1 - e2) / m1;
    a[1] = (force * cos(frequency * t) + e2 - e3) / m2;
    a[2] = (e3 - e4) / m3;
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }

  /// Kinetic energy and the energy stored in the springs. Constant if nothing damps and no load acts.
  template <class T>
  [[nodiscard]] T energy(const Vector<T, 6>& x) const {
    const T kinetic = (m1 * (x[3] * x[3]) + m2 * (x[4] * x[4]) + m3 * (x[5] * x[5])) / 2;
    return kinetic + stored(k1, l1, x[0]) + stored(k2, l2, T(x[0] - x[1])) + stored(k3, l3, T(x[1] - x[2])) +
           stored(k4, l4, x[2]);
  }

 private:
  /// The force k d + l d^3 + c d' of an element.
  template <class T>
  static T element(const Real& k, const Real& c, const Real& l, const T& d, const T& rate) {
    T f = k * d + c * rate;
    if (l != 0) f += l * (d * d * d);
    return f;
  }
  template <class T>
  static T stored(const Real& k, const Real& l, const T& d) {
    const T square = d * d;
    return square * (k / 2 + l / 4 * square);
  }
  static Real root_half() {
    using std::sqrt;
    return sqrt(Real(1) / 2);
  }
};

/// With parameters in double precision.
using ThreeMassChain = BasicThreeMassChain<double>;

/// For the errata only: Eq. 4.25 as it is printed, with c1 x1 in the first equation and
/// c2 (x2' - x2') = 0 in the second. State and parameters as in BasicThreeMassChain.
template <class Real>
struct BasicThreeMassChainAsPrinted {
  static constexpr int dimension = 6;                               ///< as in the corrected equation
  static constexpr std::string_view name = "three-dof-as-printed";  ///< in tables
  BasicThreeMassChain<Real> corrected;                              ///< holds the parameters

  /// Table 4.5: at rest.
  [[nodiscard]] static Vector<double, 6> initial_state() { return Vector<double, 6>::Zero(); }

  /// Accelerations by the printed equation.
  template <class T>
  void acceleration(const T& t, const Vector<T, 3>& q, const Vector<T, 3>& v, Vector<T, 3>& a) const {
    corrected.acceleration(t, q, v, a);
    a[0] += corrected.c1 * (v[0] - q[0]) / corrected.m1;
    a[1] -= corrected.c2 * (v[0] - v[1]) / corrected.m2;
  }

  /// dx/dt for the state x = (positions, velocities).
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    first_order_form(*this, t, x, dxdt);
  }
};

/// With parameters in double precision.
using ThreeMassChainAsPrinted = BasicThreeMassChainAsPrinted<double>;

}  // namespace nlmech::problems
