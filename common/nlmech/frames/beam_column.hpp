/// @file
/// Kondoh and Atluri's beam-column: energy, end forces and tangent stiffness of one plane member for
/// displacements and rotations of any size; only the rotations of the ends relative to the chord are small.
///
/// Elgohary 2015, Eqs 2.22-2.39, with these corrections, each shown by a test: 2.26 m = M l/EI; 2.29 for
/// n > 0 + coth; 2.33 R = B_d - (B_n/A_nn) A_nd; 2.34 the block (w, u) has the term (EI/(l h_a)) theta_a,w
/// theta_a,u; 2.35 the derivatives of 1/h are multiplied by l; 2.37 row 6 is (M_a - M_s)/2.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "nlmech/frames/axial_force.hpp"
#include "nlmech/program/value_of.hpp"
#include "nlmech/program/vector.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// Elimination of the axial force from the tangent stiffness.
enum class Coupling : std::uint8_t {
  consistent,  ///< the tangent is the derivative of the end forces
  as_printed  ///< Eq. 2.35 as printed: derivatives of 1/h without the factor l; not the derivative of the end
              ///< forces
};

/// A straight elastic member between two points.
///
/// Tests compare forces with the gradient and the tangent with the Hessian of the energy, both by dual
/// numbers (1e-10 of the largest entry), a straight member with the textbook stiffness matrix, the element
/// with 50 digits (1e-13 EA), and rotated members with the unrotated one (1e-13).
struct BeamColumn {
  double dx;  ///< second end minus first, at rest
  double dy;  ///< second end minus first, at rest
  double ea;  ///< axial stiffness EA, a force
  double ei;  ///< bending stiffness EI, force times length squared
};

/// State of a member, from which energy, forces and tangent follow.
template <class T>
struct MemberState {
  T length;             ///< length of the deformed chord
  Vector<T, 2> e;       ///< unit vector along the deformed chord
  T stretch;            ///< delta = length - l (2.25)
  T antisymmetric;      ///< theta_a = (theta_1 + theta_2)/2 less the chord's rotation (2.27)
  T symmetric;          ///< theta_s = (theta_1 - theta_2)/2 (2.27)
  T rest_length;        ///< l
  AxialForce<T> axial;  ///< n and the stability functions there
  T axial_force;        ///< N = n EI/l^2, tension positive
  T moment_a;           ///< M_a = (EI/l) g_a theta_a
  T moment_s;           ///< M_s = (EI/l) g_s theta_s
  /// outcome of axial_force(); or `outside_validity` if both ends coincide
  Outcome outcome = Outcome::success;
};

namespace detail {

/// Angle of the vector (x, y), in (-pi, pi], for any number type. For dual numbers the vector is rotated by
/// the angle of its plain values; the remaining angle has only dual parts, for which a short series is exact.
template <class T>
[[nodiscard]] T angle_of(const T& y, const T& x) {
  using std::atan2;
  using std::cos;
  using std::sin;
  using Number = decltype(value_of(x));
  Number turn = atan2(value_of(y), value_of(x));
  if constexpr (std::same_as<T, Number>) {
    return turn;
  } else {
    const Number c = cos(turn), s = sin(turn);
    const T t = (c * y - s * x) / (c * x + s * y), square = t * t;
    return turn + t * (1 - square * (1. / 3 - square / 5));
  }
}

/// Rotation of the chord from the cross and dot products of the chords at rest and deformed. Of its values
/// modulo 2 pi, which 2.23 leaves open, the one nearest to the mean rotation of the ends.
template <class T>
[[nodiscard]] T chord_rotation(const T& cross, const T& dot, const T& mean) {
  using std::acos;
  using std::floor;
  using Number = decltype(value_of(cross));
  const T principal = angle_of<T>(cross, dot);
  const Number turn = 2 * acos(Number(-1));
  const Number turns = floor(Number((value_of(mean) - value_of(principal)) / turn + Number(0.5)));
  return turns == 0 ? principal : T(principal + turns * turn);
}

}  // namespace detail

/// State of a member for the end displacements @p d = (u_x1, u_y1, theta_1, u_x2, u_y2, theta_2), rotations
/// positive anticlockwise.
template <class T>
[[nodiscard]] MemberState<T> member_state(const BeamColumn& m, const Vector<T, 6>& d) {
  using std::sqrt;
  using Number = decltype(value_of(d[0]));
  MemberState<T> s{};
  const T u = d[3] - d[0], v = d[4] - d[1], x = m.dx + u, y = m.dy + v;
  const Number dx(m.dx), dy(m.dy), square = dx * dx + dy * dy, l = sqrt(square);
  const T squared = x * x + y * y;
  s.rest_length = T(l);
  if (!(value_of(squared) > 0)) {
    s.outcome = value_of(squared) == 0 ? Outcome::outside_validity : Outcome::non_finite;
    return s;
  }
  s.length = sqrt(squared);
  s.e = Vector<T, 2>(T(x / s.length), T(y / s.length));
  s.stretch = (2 * (dx * u + dy * v) + u * u + v * v) / (s.length + l);
  const T mean = (d[2] + d[5]) / 2;
  s.antisymmetric = mean - detail::chord_rotation<T>(T(dx * v - dy * u), T(dx * x + dy * y), mean);
  s.symmetric = (d[2] - d[5]) / 2;
  s.axial = axial_force<T>({T(s.stretch / l), T(s.antisymmetric * s.antisymmetric / 2),
                            T(s.symmetric * s.symmetric / 2), Number(m.ei / (m.ea * square))});
  s.outcome = s.axial.outcome;
  const Number bending = m.ei / l;
  s.axial_force = s.axial.n * (bending / l);
  s.moment_a = bending * (s.axial.g.antisymmetric.value * s.antisymmetric);
  s.moment_s = bending * (s.axial.g.symmetric.value * s.symmetric);
  return s;
}

/// Strain energy U(d) = Pi(d, N) at its stationary N: (M_a theta_a + M_s theta_s)/2 + N delta - N^2 l/(2 EA).
template <class T>
[[nodiscard]] T member_energy(const BeamColumn& m, const MemberState<T>& s) {
  return (s.moment_a * s.antisymmetric + s.moment_s * s.symmetric) / 2 +
         s.axial_force * (s.stretch - s.axial_force * s.rest_length / (2 * m.ea));
}

/// End forces dU/dd (2.33 and 2.37; B_n = 0).
template <class T>
[[nodiscard]] Vector<T, 6> member_force(const MemberState<T>& s) {
  const T along_x = s.axial_force * s.e[0] + s.moment_a * s.e[1] / s.length;
  const T along_y = s.axial_force * s.e[1] - s.moment_a * s.e[0] / s.length;
  Vector<T, 6> f;
  f << -along_x, -along_y, (s.moment_a + s.moment_s) / 2, along_x, along_y, (s.moment_a - s.moment_s) / 2;
  return f;
}

/// Tangent stiffness d^2U/dd^2 (2.32, 2.34-2.36), symmetric.
template <class T>
[[nodiscard]] Matrix<T, 6> member_tangent(const BeamColumn& m, const MemberState<T>& s,
                                          Coupling coupling = Coupling::consistent) {
  const T& l = s.rest_length;
  const StabilityFunctions<T>& g = s.axial.g;
  const T bending = m.ei / l, reach = coupling == Coupling::consistent ? l : T(1);
  // Gradients of delta, theta_a and theta_s by d.
  const T turn_x = s.e[1] / s.length, turn_y = -s.e[0] / s.length;  // of theta_a by the second end
  const T zero(0), half(0.5);
  Vector<T, 6> stretch, a, symmetric;
  stretch << -s.e[0], -s.e[1], zero, s.e[0], s.e[1], zero;
  a << -turn_x, -turn_y, half, turn_x, turn_y, half;
  symmetric << zero, zero, half, zero, zero, -half;
  const Vector<T, 6> by_force = stretch + (reach * g.antisymmetric.slope * s.antisymmetric) * a +
                                (reach * g.symmetric.slope * s.symmetric) * symmetric;  // A_nd
  const T half_curvature = g.antisymmetric.curvature * s.antisymmetric * s.antisymmetric +
                           g.symmetric.curvature * s.symmetric * s.symmetric;
  const T by_force_twice = l * l * l / (2 * m.ei) * half_curvature - l / m.ea;  // A_nn
  const T ka = bending * g.antisymmetric.value, ks = bending * g.symmetric.value;
  Matrix<T, 6> k;
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i <= j; ++i) {
      k(i, j) =
          ka * a[i] * a[j] + ks * symmetric[i] * symmetric[j] - by_force[i] * by_force[j] / by_force_twice;
    }
  }
  // Second derivatives: of delta m m^T/L, of theta_a (e m^T + m e^T)/L^2, with m across the chord.
  const T nl = s.axial_force / s.length, ml = s.moment_a / (s.length * s.length);
  const T &c = s.e[0], &q = s.e[1];
  const T xx = nl * q * q - 2 * ml * c * q, xy = -nl * c * q + ml * (c * c - q * q);
  const T yy = nl * c * c + 2 * ml * c * q;
  k(0, 0) += xx, k(0, 1) += xy, k(1, 1) += yy;
  k(0, 3) -= xx, k(0, 4) -= xy, k(1, 3) -= xy, k(1, 4) -= yy;
  k(3, 3) += xx, k(3, 4) += xy, k(4, 4) += yy;
  for (int j = 0; j < 6; ++j) {
    for (int i = j + 1; i < 6; ++i) k(i, j) = k(j, i);
  }
  return k;
}

/// Change of member_tangent() with the axial force N at fixed displacements, where rotations relative to the
/// chord are small: the geometric stiffness of linear buckling. At N = 0 it is that of a cubic beam element.
[[nodiscard]] inline Matrix<double, 6> member_geometric(const MemberState<double>& s) {
  const double c = s.e[0] / s.length, q = s.e[1] / s.length;
  Vector<double, 6> chord, a, symmetric;  // gradients of the chord's rotation, theta_a and theta_s
  chord << q, -c, 0, -q, c, 0;
  a << -q, c, 0.5, q, -c, 0.5;
  symmetric << 0, 0, 0.5, 0, 0, -0.5;
  return s.length * chord * chord.transpose() +
         s.rest_length * (s.axial.g.antisymmetric.slope * a * a.transpose() +
                          s.axial.g.symmetric.slope * symmetric * symmetric.transpose());
}

}  // namespace nlmech::frames
