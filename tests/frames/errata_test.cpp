/// Misprints in Elgohary 2015, Eqs 2.26-2.37: printed and corrected forms against derivatives of the energy
/// Pi(d, N) by dual numbers, and against the textbook's stability functions.
#include <gtest/gtest.h>

#include "tests/errata/erratum.hpp"
#include "tests/frames/oracle.hpp"

namespace nlmech::frames::errata_test {
namespace {

using namespace oracle;
using tests::expect_erratum;
using D = Dual<double, 7>;
using DD = Dual<D, 7>;

/// A member along z = x with N as an independent variable: Pi with its first and second derivatives.
struct Exact {
  double pi;
  Vector<double, 7> first;   ///< by (w_1, u_1, theta_1, w_2, u_2, theta_2, N): B_d and B_n
  Matrix<double, 7> second;  ///< A_dd, A_nd, A_nn
};

constexpr double length = 3, ei = 2, ea = 50;
const BeamColumn member{length, 0, ea, ei};

/// Pi = EI/(2l) (theta_a^2/h_a + theta_s^2/h_s) + N delta - N^2 l/(2 EA).
DD energy(const Vector<DD, 7>& v) {
  const DD w = length + v[3] - v[0], u = v[4] - v[1], force = v[6];
  const DD chord = sqrt(w * w + u * u), turn = detail::angle_of<DD>(u, w);
  const DD a = (v[2] + v[5]) / 2 - turn, s = (v[2] - v[5]) / 2;
  const Textbook<DD> t = textbook<DD>(force * (length * length / ei));
  return ei / (2 * length) * (2 * (t.s + t.sc) * a * a + 2 * (t.s - t.sc) * s * s) +
         force * (chord - length) - force * force * length / (2 * ea);
}

Exact exact_at(const Vector<double, 6>& d, double force) {
  Vector<double, 7> at;
  at << d, force;
  const DD pi = energy(variables(variables(at)));
  Exact e{pi.value.value, {}, {}};
  for (int i = 0; i < 7; ++i) {
    const auto& row = pi.partial[static_cast<std::size_t>(i)];
    e.first[i] = row.value;
    for (int j = 0; j < 7; ++j) e.second(i, j) = row.partial[static_cast<std::size_t>(j)];
  }
  return e;
}

Vector<double, 6> bent() {
  Vector<double, 6> d;
  d << 0.1, -0.2, 0.7, 0.15, 0.9, -0.3;
  return d;
}

const MemberState<double>& state() {
  static const MemberState<double> s = member_state<double>(member, bent());
  return s;
}

TEST(Errata, MomentsAreMadeDimensionlessByTheLength) {  // 2.26
  // theta_a = h_a m_a with h_a(0) = 1/12 and both end rotations 1: moments 6 EI/l, so that m_a = 12.
  Vector<double, 6> d = Vector<double, 6>::Zero();
  d[2] = d[5] = 1e-6;
  const Vector<double, 6> f = member_force(member_state<double>(member, d));
  const double moments = f[2] + f[5];
  const double inertia = 1;  // I; E is then 2
  const Textbook<double> t = {4, 2};
  // The second order of the angle is 1e-12, and eps of the stretch over 1e-6: 1e-10.
  expect_erratum("homotopy-2.26", {.printed = moments * inertia / ei / 1e-6,
                                   .corrected = moments * length / ei / 1e-6,
                                   .oracle = 2 * (t.s + t.sc),
                                   .tolerance = 1e-10});
}

TEST(Errata, FlexibilityInTension) {  // 2.29
  const double n = 5, root = std::sqrt(n), coth = 1 / std::tanh(root / 2);
  const double reference = static_cast<double>(Real(1 / exact(Real(n)).antisymmetric.value));
  EXPECT_NEAR(-1 / n - coth / (2 * root), -0.47712, 5e-6);
  EXPECT_NEAR(reference, 0.0771238508, 5e-11);
  // Rounding errors of 1/n and of the quotient, each at most three times the difference.
  expect_erratum("homotopy-2.29", {.printed = -1 / n - coth / (2 * root),
                                   .corrected = -1 / n + coth / (2 * root),
                                   .oracle = reference,
                                   .tolerance = 32 * eps});
}

TEST(Errata, ForceOffTheBalance) {  // 2.33
  const double force = state().axial_force;
  const Vector<double, 6> balanced = member_force(state());
  double before = 0;
  for (const double off : {1e-2, 1e-3}) {
    const Exact e = exact_at(bent(), force + off);
    const Vector<double, 6> a = e.second.col(6).head<6>(), b = e.first.head<6>();
    const double correct = (b - e.first[6] / e.second(6, 6) * a - balanced).cwiseAbs().maxCoeff();
    const double printed = (b - a / e.second(6, 6) - balanced).cwiseAbs().maxCoeff();
    EXPECT_GT(printed, 1);
    EXPECT_LT(correct, off / 10);
    if (before > 0) {
      EXPECT_NEAR(before / correct, 100, 10);  // second order
    }
    before = correct;
    // The gradient at equilibrium; the remainder is of second order in the distance from it.
    expect_erratum("homotopy-2.33", {.printed = b[4] - a[4] / e.second(6, 6),
                                     .corrected = b[4] - e.first[6] / e.second(6, 6) * a[4],
                                     .oracle = exact_at(bent(), force).first[4],
                                     .tolerance = off * off,
                                     .scale = 1});
  }
}

TEST(Errata, BlocksOfDisplacements) {  // 2.34
  const MemberState<double>& s = state();
  const Exact e = exact_at(bent(), s.axial_force);
  const double c = s.e[0], q = s.e[1], chord = s.length, g = s.axial.g.antisymmetric.value;
  const double aw = q / chord, au = -c / chord;  // of theta_a by w and u
  const double curved = s.axial_force * (-c * q / chord) + s.moment_a * (c * c - q * q) / (chord * chord);
  EXPECT_NEAR(curved + ei / length * g * aw * au, e.second(3, 4), 1e-12);
  EXPECT_GT(std::abs(curved - e.second(3, 4)), 0.1);  // without the last term
  const auto block = [&](double stretch, double turn, double by) {
    return s.axial_force * stretch + s.moment_a * turn + ei / length * g * by * by;
  };
  const double ww = block(q * q / chord, -2 * c * q / (chord * chord), aw);
  const double uu = block(c * c / chord, 2 * c * q / (chord * chord), au);
  EXPECT_NEAR(ww, e.second(3, 3), 1e-12);
  EXPECT_NEAR(uu, e.second(4, 4), 1e-12);
  EXPECT_GT(std::abs(ww - e.second(4, 4)), 0.1);  // the block (u, u) differentiated by w
  // Rounding errors of a dozen products of numbers up to 50.
  expect_erratum("homotopy-2.34-wu", {.printed = curved,
                                      .corrected = curved + ei / length * g * aw * au,
                                      .oracle = e.second(3, 4),
                                      .tolerance = 1e-12});
  expect_erratum("homotopy-2.34-uu", {.printed = block(q * q / chord, -2 * c * q / (chord * chord), au),
                                      .corrected = uu,
                                      .oracle = e.second(4, 4),
                                      .tolerance = 1e-12});
}

TEST(Errata, CouplingOfForceAndDisplacements) {  // 2.35
  const MemberState<double>& s = state();
  const Exact e = exact_at(bent(), s.axial_force);
  const double a = s.axial.g.antisymmetric.slope * s.antisymmetric,
               b = s.axial.g.symmetric.slope * s.symmetric;
  const double w = s.e[0], aw = s.e[1] / s.length;
  EXPECT_GT(std::abs(w + a * aw - e.second(6, 3)), 1e-3);
  EXPECT_GT(std::abs((a + b) / 2 - e.second(6, 2)), 1e-2);
  const auto row = [&](double printed, double corrected, int i) {
    expect_erratum("homotopy-2.35", {.printed = printed,
                                     .corrected = corrected,
                                     .oracle = e.second(6, i),
                                     .tolerance = 1e-13,
                                     .scale = 1});
  };
  row(w + a * aw, w + length * a * aw, 3);
  row((a + b) / 2, length / 2 * (a + b), 2);
  row((a - b) / 2, length / 2 * (a - b), 5);
  // Hence the printed tangent is no derivative; the consistent tangent is.
  const Vector<double, 6> column = e.second.col(6).head<6>();
  const Matrix<double, 6> k = e.second.topLeftCorner<6, 6>() - column * column.transpose() / e.second(6, 6);
  EXPECT_LT((member_tangent(member, s) - k).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_GT((member_tangent(member, s, Coupling::as_printed) - k).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Errata, MomentOfTheSecondEnd) {  // 2.37, row 6
  const MemberState<double>& s = state();
  const Exact e = exact_at(bent(), s.axial_force);
  EXPECT_NEAR(e.first[6], 0, 1e-14);  // 2.38: equilibrium
  EXPECT_GT(std::abs((s.moment_s - s.moment_a) / 2 - e.first[5]), 0.1);
  expect_erratum("homotopy-2.37", {.printed = (s.moment_s - s.moment_a) / 2,
                                   .corrected = (s.moment_a - s.moment_s) / 2,
                                   .oracle = e.first[5],
                                   .tolerance = 1e-13,
                                   .scale = 1});
  EXPECT_LT((member_force(s) - e.first.head<6>()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(member_energy(member, s), e.pi, 1e-13);
}

}  // namespace
}  // namespace nlmech::frames::errata_test
