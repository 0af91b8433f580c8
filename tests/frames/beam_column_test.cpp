/// The beam-column: derivatives, rigid motions, the straight beam's matrix.
#include "nlmech/frames/beam_column.hpp"

#include <gtest/gtest.h>

#include "tests/frames/oracle.hpp"

namespace nlmech::frames::beam_column_test {
namespace {

using namespace oracle;
using D = Dual<double, 6>;
using DD = Dual<D, 6>;

template <class T>
T energy(const BeamColumn& m, const Vector<T, 6>& d) {
  return member_energy<T>(m, member_state<T>(m, d));
}

RC_GTEST_PROP(BeamColumn, ForceIsTheGradientAndTangentTheHessian, ()) {
  const BeamColumn m = random_member();
  const Vector<double, 6> d = random_displacements(m, 3);
  const auto state = member_state<double>(m, d);
  RC_ASSERT(state.outcome == Outcome::success);
  const Vector<double, 6> f = member_force(state);
  const Matrix<double, 6> k = member_tangent(m, state);
  const DD u = energy<DD>(m, variables(variables(d)));
  const Matrix<double, 6> by_force =
      jacobian_of<double, 6, 6>(member_force(member_state<D>(m, variables(d))));
  Vector<double, 6> gradient;
  Matrix<double, 6> hessian;
  for (int i = 0; i < 6; ++i) {
    const auto row = static_cast<std::size_t>(i);
    gradient[i] = u.partial[row].value;
    for (int j = 0; j < 6; ++j) hessian(i, j) = u.partial[row].partial[static_cast<std::size_t>(j)];
  }
  // 1e-10 of the largest entry: what is asked of this element; rounding alone would do with less.
  RC_ASSERT((gradient - f).cwiseAbs().maxCoeff() <= 1e-10 * f.cwiseAbs().maxCoeff());
  RC_ASSERT((by_force - k).cwiseAbs().maxCoeff() <= 1e-10 * k.cwiseAbs().maxCoeff());
  RC_ASSERT((hessian - k).cwiseAbs().maxCoeff() <= 1e-10 * k.cwiseAbs().maxCoeff());
  RC_ASSERT((k - k.transpose()).cwiseAbs().maxCoeff() == 0);
}

// The member turned and moved as a whole, by several turns too. The stretch is rounded by some eps of the
// places, of size up to 10, hence forces by 1e-13 EA at most.
RC_GTEST_PROP(BeamColumn, RigidMotionsCostNothing, ()) {
  const BeamColumn m = random_member();
  const Vector<double, 6> d = random_displacements(m, 1);
  const double angle = *between(-15, 15), c = std::cos(angle), s = std::sin(angle);
  const double x0 = *between(-1, 1), y0 = *between(-1, 1);
  Vector<double, 6> moved;
  moved << c * d[0] - s * d[1] + x0, s * d[0] + c * d[1] + y0, d[2] + angle,
      c * (m.dx + d[3]) - s * (m.dy + d[4]) + x0 - m.dx, s * (m.dx + d[3]) + c * (m.dy + d[4]) + y0 - m.dy,
      d[5] + angle;
  const auto before = member_state<double>(m, d), after = member_state<double>(m, moved);
  RC_ASSERT(std::abs(member_energy(m, before) - member_energy(m, after)) <= 1e-13);
  const Vector<double, 6> f = member_force(before), g = member_force(after);
  for (const int i : {0, 3}) {
    RC_ASSERT(std::abs(g[i] - (c * f[i] - s * f[i + 1])) <= 1e-13);
    RC_ASSERT(std::abs(g[i + 1] - (s * f[i] + c * f[i + 1])) <= 1e-13);
    RC_ASSERT(std::abs(g[i + 2] - f[i + 2]) <= 1e-13);
  }
}

TEST(BeamColumn, ARigidMotionAloneLeavesItUnloaded) {
  const BeamColumn m{3, 4, 2e6, 1e4};
  for (const double angle : {0.3, 3.14, 4., 6.5, -7., 50.}) {
    const double c = std::cos(angle), s = std::sin(angle);
    Vector<double, 6> d;
    d << 1, 2, angle, 1 + (c - 1) * 3 - s * 4, 2 + s * 3 + (c - 1) * 4, angle;
    const auto state = member_state<double>(m, d);
    // A few eps of the places over the length times EA; the angle's own rounding times EI/l.
    EXPECT_LE(member_force(state).cwiseAbs().maxCoeff(), 16 * eps * (m.ea + std::abs(angle) * m.ei)) << angle;
  }
}

// Straight, under an axial force: the textbook's beam-column matrix with N/l on the chord. At n = 0 it is
// that of Euler and Bernoulli.
TEST(BeamColumn, StraightItIsTheTextbooks) {
  const double l = 2, ei = 3, ea = 500;
  for (const double n : {-30., -5., -1e-3, 0., 1e-3, 6., 200.}) {
    const double force = n * ei / (l * l), k3 = ei / (l * l * l);
    Vector<double, 6> d = Vector<double, 6>::Zero();
    d[3] = force * l / ea;
    const BeamColumn m{l, 0, ea, ei};
    const auto state = member_state<double>(m, d);
    const Matrix<double, 6> k = member_tangent(m, state);
    const Textbook<Real> t = n == 0 ? Textbook<Real>{4, 2} : textbook(Real(n));
    const double s = static_cast<double>(t.s), sc = static_cast<double>(t.sc), stretched = l + d[3];
    // The chord has become longer: lever arms are of the stretched length.
    const double shear = ei / l * (s + sc) / stretched, turn = 2 * shear / stretched + force / stretched;
    const double tolerance = 64 * eps * (ea / l + 4 * k3 * l * l + std::abs(turn));
    EXPECT_NEAR(state.axial.n, n, 16 * eps * std::abs(n) + 1e-15);
    EXPECT_NEAR(k(0, 0), ea / l, tolerance);
    EXPECT_NEAR(k(2, 2), ei / l * s, tolerance);
    EXPECT_NEAR(k(2, 5), ei / l * sc, tolerance);
    EXPECT_NEAR(k(1, 2), shear, tolerance);
    EXPECT_NEAR(k(2, 4), -shear, tolerance);
    EXPECT_NEAR(k(1, 1), turn, tolerance);
    EXPECT_NEAR(k(1, 4), -turn, tolerance);
    EXPECT_NEAR(k(0, 1), 0, tolerance);
    EXPECT_NEAR(k(0, 2), 0, tolerance);
  }
}

// The whole element in 50 digits, against itself in double: rounding of the data by eps over the conditions
// of the axial force.
RC_GTEST_PROP(BeamColumn, AgreesWithFiftyDigits, ()) {
  const BeamColumn m = random_member();
  const Vector<double, 6> d = random_displacements(m, 3);
  const auto state = member_state<double>(m, d);
  const auto wide = member_state<Real>(m, d.cast<Real>());
  const Vector<double, 6> f = member_force(wide).cast<double>();
  RC_ASSERT((member_force(state) - f).cwiseAbs().maxCoeff() <= 1e-13 * m.ea);
  // The wide element has balanced its stretch to its own precision.
  const Real rest = AxialBalance<Real>{Real(wide.stretch / wide.rest_length),
                                       Real(wide.antisymmetric * wide.antisymmetric / 2),
                                       Real(wide.symmetric * wide.symmetric / 2),
                                       Real(m.ei / (m.ea * wide.rest_length * wide.rest_length))}
                        .value(wide.axial.n, wide.axial.g);
  RC_ASSERT(abs(rest) < Real(1e-45));
}

TEST(BeamColumn, EndsThatMeetHaveNoChord) {
  Vector<double, 6> d;
  d << 0, 0, 0, -1, 0, 0;
  EXPECT_EQ(member_state<double>({1, 0, 1, 1}, d).outcome, Outcome::outside_validity);
  d[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(member_state<double>({1, 0, 1, 1}, d).outcome, Outcome::non_finite);
}

}  // namespace
}  // namespace nlmech::frames::beam_column_test
