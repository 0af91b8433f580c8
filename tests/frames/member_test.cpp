/// A member: stability functions, axial force, energy and both derivatives.
#include "nlmech/frames/stability_functions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "nlmech/frames/axial_force.hpp"
#include "nlmech/frames/beam_column.hpp"
#include "tests/frames/oracle.hpp"

namespace nlmech::frames::member_test {
namespace {

using namespace oracle;

void expect_close(const StabilityFunction<double>& mine, const StabilityFunction<Real>& reference, double n) {
  const double size = std::max(1., std::abs(static_cast<double>(reference.value)));
  EXPECT_LE(std::abs(static_cast<double>(Real(mine.value - reference.value))) / (size * eps), 16) << n;
  EXPECT_LE(error(mine.slope, reference.slope), 16) << n;
  EXPECT_LE(error(mine.curvature, reference.curvature), 128) << n;
}

// Error bounds stated in the header. g_s is 0 at n = -pi^2 and g_a at -4 pi^2: for values below 1 the bound
// is absolute.
TEST(StabilityFunctions, KeepTheirDigits) {
  for (const double n :
       {-39.4, -35., -30., -20., -9.9,   -9.8, -6.,    -4.0001, -4., -3.9999, -1.,   -1e-2, -1e-4,
        1e-4,  1e-3, 0.1,  1.,   3.9999, 4.,   4.0001, 10.,     39., 200.,    2000., 2e4,   1e6}) {
    const auto mine = stability_functions(n);
    const auto reference = exact(Real(n));
    expect_close(mine.symmetric, reference.symmetric, n);
    expect_close(mine.antisymmetric, reference.antisymmetric, n);
  }
}

TEST(StabilityFunctions, AtNothingTheyAreTheBeams) {
  const auto g = stability_functions(0.0);
  EXPECT_EQ(g.antisymmetric.value, 12);  // 6 EI/l at either end
  EXPECT_EQ(g.symmetric.value, 4);       // 2 EI/l
  EXPECT_NEAR(g.antisymmetric.slope, 1. / 5, eps);
  EXPECT_NEAR(g.symmetric.slope, 1. / 3, eps);
  EXPECT_NEAR(g.antisymmetric.curvature, -1. / 350, eps);  // G = 3 + y/5 - y^2/175
  EXPECT_NEAR(g.symmetric.curvature, -1. / 90, eps);       // c = 1 + y/3 - y^2/45
}

// Continuity between series and closed forms at |n| = 4, for g_a at 16: neighbours differ by at most the sum
// of both errors.
TEST(StabilityFunctions, AreContinuousAtTheSeams) {
  for (const double seam : {-16., -4., 4., 16.}) {
    const auto in = stability_functions(std::nextafter(seam, 0.)), out = stability_functions(seam);
    for (const auto part :
         {&StabilityFunctions<double>::antisymmetric, &StabilityFunctions<double>::symmetric}) {
      EXPECT_NEAR((in.*part).value / (out.*part).value, 1, 32 * eps);
      EXPECT_NEAR((in.*part).slope / (out.*part).slope, 1, 32 * eps);
      EXPECT_NEAR((in.*part).curvature / (out.*part).curvature, 1, 256 * eps);
    }
  }
}

TEST(StabilityFunctions, InFiftyDigits) {
  for (const double n : {-30., -4.5, -3.5, -1., 0.5, 3.9, 5., 100.}) {
    const auto mine = stability_functions(Real(n)), reference = exact(Real(n));
    for (const auto part : {&StabilityFunctions<Real>::antisymmetric, &StabilityFunctions<Real>::symmetric}) {
      // The second derivative of the oracle loses digits as n^-3.
      EXPECT_LT(abs(Real((mine.*part).value / (reference.*part).value - 1)), Real(1e-45)) << n;
      EXPECT_LT(abs(Real((mine.*part).slope / (reference.*part).slope - 1)), Real(1e-43)) << n;
      EXPECT_LT(abs(Real((mine.*part).curvature / (reference.*part).curvature - 1)), Real(1e-41)) << n;
    }
  }
}

// Near Euler's load of clamped ends, as a function of the distance from it.
TEST(StabilityFunctions, AboveThePole) {
  const Real pole = FourPiSquared<Real>{}.high;
  for (const double p : {1e-100, 1e-16, 1e-10, 1e-3, 1., 20., 35.}) {
    const auto mine = stability_functions_above_pole(p);
    StabilityFunctions<Real> reference = stability_functions_above_pole(Real(p));
    if (p >= 1e-3)
      reference =
          exact(Real(Real(p) - pole));  // closer to the pole 50 digits of the textbook's form do not suffice
    for (const auto& [a, b] : {std::pair{mine.symmetric.value, reference.symmetric.value},
                               {mine.symmetric.slope, reference.symmetric.slope},
                               {mine.symmetric.curvature, reference.symmetric.curvature},
                               {mine.antisymmetric.slope, reference.antisymmetric.slope},
                               {mine.antisymmetric.value, reference.antisymmetric.value},
                               {mine.antisymmetric.curvature, reference.antisymmetric.curvature}}) {
      EXPECT_LE(error(a, b) * eps, 1e-13) << p;
    }
    // The leading term is -8 pole/p.
    if (p < 1e-9) {
      EXPECT_NEAR(mine.symmetric.value * p / (-8 * static_cast<double>(pole)), 1, 1e-9);
    }
  }
}

// n = -4 pi^2 rounded to double differs from the pole; the function uses the remainder.
TEST(StabilityFunctions, NeighboursOfThePoleAreTheirOwn) {
  const double pole = -FourPiSquared<double>{}.high;
  for (const double n : {pole, std::nextafter(pole, 0.), std::nextafter(pole, -100.)})
    EXPECT_LE(error(stability_functions(n).symmetric.value, stability_functions(Real(n)).symmetric.value),
              64);
}

TEST(StabilityFunctions, PoleOfTheAntisymmetricOne) {
  const double x = std::sqrt(-antisymmetric_pole / 4);
  EXPECT_NEAR(std::tan(x) / x, 1, 64 * eps);  // d tan x/dx = 1 + x^2 = 21
  EXPECT_GT(std::abs(stability_functions(antisymmetric_pole).antisymmetric.value), 1e12);
  EXPECT_LT(stability_functions(antisymmetric_pole + 1e-6).antisymmetric.value, -1e6);
  EXPECT_GT(stability_functions(antisymmetric_pole - 1e-6).antisymmetric.value, 1e6);
}

TEST(StabilityFunctions, LargeTension) {
  const auto g = stability_functions(1e300);  // sinh of half its root would overflow
  EXPECT_NEAR(g.symmetric.value / 2e150, 1, 4 * eps);
  EXPECT_NEAR(g.symmetric.slope / 1e-150, 1, 4 * eps);
  EXPECT_NEAR(g.antisymmetric.value / 2e150, 1, 4 * eps);
}

// ---- The axial force of a deformed member: roots, branches, poles.

/// b(n) with the textbook's functions in 50 digits.
Real balance(const AxialBalance<double>& b, const Real& n) {
  const auto g = exact(n);
  return b.strain + b.antisymmetric * g.antisymmetric.slope + b.symmetric * g.symmetric.slope -
         b.softness * n;
}

// Condition of the root: an error of eps in each datum changes n by the corresponding term over |db/dn|.
RC_GTEST_PROP(AxialForce, BalancesTheStretch, ()) {
  const double a = *between(-0.7, 0.7), s = *between(-0.7, 0.7);
  const AxialBalance<double> b{*between(-0.1, 0.1), a * a / 2, s * s / 2, std::pow(10, *between(-8, -1))};
  const auto force = axial_force(b);
  RC_ASSERT(force.outcome == Outcome::success);
  RC_PRE(std::abs(force.n) > 1e-4 && s != 0);
  const auto g = exact(Real(force.n));
  const double size = std::abs(b.strain) +
                      static_cast<double>(Real(b.antisymmetric * abs(g.antisymmetric.slope) +
                                               b.symmetric * abs(g.symmetric.slope))) +
                      std::abs(b.softness * force.n);
  // The rounding of n leaves a residual of eps |n db/dn|.
  const double rounding = std::abs(force.n * b.slope(force.g));
  RC_ASSERT(std::abs(static_cast<double>(balance(b, force.n))) <= 64 * eps * (size + rounding));
  RC_ASSERT(force.evaluations <= 40);
}

TEST(AxialForce, OfNothingIsNothing) { EXPECT_EQ(axial_force(AxialBalance<double>{0, 0, 0, 1e-4}).n, 0); }

TEST(AxialForce, OfAStraightMemberIsHookes) {
  EXPECT_NEAR(axial_force(AxialBalance<double>{1e-3, 0, 0, 1e-5}).n, 100, 1e-12);
  EXPECT_NEAR(axial_force(AxialBalance<double>{-1e-4, 0, 0, 1e-5}).n, -10, 1e-13);
}

// With a symmetric rotation of any size the force stays above the pole, and the moment EI g_s theta_s/l keeps
// its digits: for small theta_s the shortening determines it by 8 pole^2/p^2 theta_s^2/2 = rest.
TEST(AxialForce, KeepsItsDistanceFromThePole) {
  const double pole = FourPiSquared<double>{}.high;
  for (const double theta : {1e-1, 1e-5, 1e-10, 1e-50}) {
    const AxialBalance<double> b{-0.02, 0, theta * theta / 2, 1e-5};
    const auto force = axial_force(b);
    EXPECT_EQ(force.outcome, Outcome::success);
    EXPECT_GE(force.n, -pole);
    const auto wide = axial_force(AxialBalance<Real>{b.strain, Real(0), b.symmetric, Real(b.softness)});
    EXPECT_LE(error(force.g.symmetric.value * theta, Real(wide.g.symmetric.value * theta)), 1000) << theta;
    if (theta <= 1e-10) {
      const double rest = 0.02 - pole * 1e-5;
      EXPECT_NEAR(std::abs(force.g.symmetric.value) * theta / std::sqrt(16 * pole * rest), 1, 1e-7) << theta;
    }
  }
}

// Without symmetric rotation the member exceeds its clamped buckling load, and the status reports it. At that
// root b is 0 in 50 digits; at -4 pi^2, where a solver might stop, it is not.
TEST(AxialForce, ThePastOfTheClampedBucklingLoadIsAnotherBranch) {
  const AxialBalance<double> b{-0.02, 0.1 * 0.1 / 2, 0, 1e-5};
  const auto force = axial_force(b);
  EXPECT_EQ(force.outcome, Outcome::wrong_branch);
  EXPECT_LT(force.n, -39.5);
  EXPECT_GT(force.n, antisymmetric_pole);
  const auto at = [&](const Real& n) {
    return static_cast<double>(
        Real(b.strain + b.antisymmetric * exact(n).antisymmetric.slope - b.softness * n));
  };
  // 64 eps of the largest term, 0.02.
  EXPECT_LE(std::abs(at(Real(force.n))), 64 * eps * 0.02);
  EXPECT_LT(at(Real(-39.5)), -0.01);
  // With any symmetric rotation the force stays below the buckling load.
  EXPECT_EQ(axial_force(AxialBalance<double>{-0.02, 0.005, 1e-40, 1e-5}).outcome, Outcome::success);
  for (const double tiny : {1e-189, 1e-191, 1e-300, 5e-324}) {
    const auto next = axial_force(AxialBalance<double>{-0.02, 0.005, tiny, 1e-5});
    EXPECT_TRUE(std::isfinite(next.n) && std::isfinite(next.g.symmetric.curvature)) << tiny;
  }
  // In a straight strut the axial strain is the only term.
  const auto strut = axial_force(AxialBalance<double>{-0.02, 0, 0, 1e-5});
  EXPECT_EQ(strut.outcome, Outcome::wrong_branch);
  EXPECT_NEAR(strut.n, -2000, 1e-11);
}

TEST(AxialForce, AtThePoleAndWithoutNumbers) {
  const double pole = FourPiSquared<double>{}.high;
  EXPECT_EQ(axial_force(AxialBalance<double>{-pole / 1024, 0, 0, 1. / 1024}).outcome, Outcome::at_pole);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(axial_force(AxialBalance<double>{nan, 0, 0, 1e-5}).outcome, Outcome::non_finite);
  EXPECT_EQ(axial_force(AxialBalance<double>{HUGE_VAL, 0, 0, 1e-5}).outcome, Outcome::non_finite);
}

// ---- The beam-column: derivatives, rigid-body motions, the matrix of the straight beam.

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
  // 1e-10 of the largest entry is the required accuracy; rounding errors are smaller.
  RC_ASSERT((gradient - f).cwiseAbs().maxCoeff() <= 1e-10 * f.cwiseAbs().maxCoeff());
  RC_ASSERT((by_force - k).cwiseAbs().maxCoeff() <= 1e-10 * k.cwiseAbs().maxCoeff());
  RC_ASSERT((hessian - k).cwiseAbs().maxCoeff() <= 1e-10 * k.cwiseAbs().maxCoeff());
  RC_ASSERT((k - k.transpose()).cwiseAbs().maxCoeff() == 0);
}

// A rigid-body rotation by up to 15 rad and a translation. The stretch has rounding errors of some eps of
// positions up to 10, hence forces of at most 1e-13 EA.
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
    // A few eps of the positions over the length times EA; rounding of the angle times EI/l.
    EXPECT_LE(member_force(state).cwiseAbs().maxCoeff(), 16 * eps * (m.ea + std::abs(angle) * m.ei)) << angle;
  }
}

// Straight member under an axial force: the textbook's beam-column matrix with N/l on the chord. At n = 0 it
// is the matrix of Euler and Bernoulli.
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
    // The chord is stretched: lever arms have the stretched length.
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

// The element in 50 digits against the element in double: eps of the data over the condition of the axial
// force.
RC_GTEST_PROP(BeamColumn, AgreesWithFiftyDigits, ()) {
  const BeamColumn m = random_member();
  const Vector<double, 6> d = random_displacements(m, 3);
  const auto state = member_state<double>(m, d);
  const auto wide = member_state<Real>(m, d.cast<Real>());
  const Vector<double, 6> f = member_force(wide).cast<double>();
  RC_ASSERT((member_force(state) - f).cwiseAbs().maxCoeff() <= 1e-13 * m.ea);
  // The axial equilibrium in 50 digits holds to that precision.
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
}  // namespace nlmech::frames::member_test
