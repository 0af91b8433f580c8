/// Frames: assembly, several full rotations, refusals; the toggle as a frame and by Williams' equation.
#include "nlmech/frames/frame.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nlmech/frames/toggle.hpp"
#include "nlmech/frames/williams.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/frames/control.hpp"
#include "tests/frames/oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::frames::frame_test {
namespace {

using namespace oracle;
using Eigen::VectorXd;

/// A cantilever along x of @p members members of length 1.
Frame cantilever(int members, double ea, double ei) {
  std::vector<Node> nodes{{0, 0}};
  std::vector<Member> parts;
  for (int i = 1; i <= members; ++i) {
    nodes.push_back({static_cast<double>(i), 0});
    parts.push_back({i - 1, i, ea, ei});
  }
  return {nodes, parts, {{0, Motion::x}, {0, Motion::y}, {0, Motion::rotation}}};
}

// Under an end moment M the axial force is zero, every member rotates by phi = M l/EI, and its chord shortens
// by phi^2/24 (n = 0 in Eq. 2.28): a regular polygon, rolled up several times. The forces of this state are
// 0, ..., 0, M; a rotation reduced modulo 2 pi would give a moment of order EI.
TEST(Frame, RollsUpUnderAnEndMoment) {
  const int members = 60;
  const double ea = 1e4, ei = 7;
  for (const double turns : {1., 3., -3., 5.}) {
    const double phi = turns * 2 * pi / members, chord = 1 - phi * phi / 24;
    const Frame frame = cantilever(members, ea, ei);
    VectorXd x(frame.size()), f(frame.size());
    double px = 0, py = 0;
    for (int i = 1; i <= members; ++i) {
      px += chord * std::cos((i - 0.5) * phi);
      py += chord * std::sin((i - 0.5) * phi);
      x.segment<3>(Eigen::Index{3} * (i - 1)) << px - i, py, i * phi;
    }
    EXPECT_NEAR(px, 0, 1e-13);  // the polygon is closed
    ASSERT_TRUE(frame.force<double>(x, f).ok());
    // Positions of size up to 60 are rounded: the errors of forces are EA times some eps of that, the errors
    // of moments EI g_s' theta_s/2 times the error of n, 60 eps EA/EI.
    EXPECT_NEAR(f[frame.size() - 1], ei * phi, 1e-11 * ei);
    f[frame.size() - 1] = 0;
    EXPECT_LT(f.cwiseAbs().maxCoeff(), 60 * 8 * eps * ea);
  }
}

// With a joint, a spring between nodes and one against rotation.
TEST(Frame, TangentIsTheHessianOfTheEnergy) {
  const Frame frame(
      {{0, 0}, {1, 0.2}, {1.5, 1}}, {{0, 1, 30, 2, false, true, 0, 4}, {1, 2, 40, 1}, {2, 0, 50, 3}},
      {{0, Motion::x}, {0, Motion::y}, {2, Motion::y}}, {{0, 2, 5, 0.6, 0.8, 0}, {-1, 1, 2, 0, 0, 1}});
  ASSERT_EQ(frame.size(), 7);
  using DD = Dual<Dual<double, 7>, 7>;
  Vector<double, 7> at;
  at << 0.2, -0.1, 0.15, 0.4, 0.12, -0.3, 0.25;
  const VectorXd x = at;
  VectorXd f;
  Eigen::SparseMatrix<double> k;
  ASSERT_TRUE(frame.force<double>(x, f).ok());
  ASSERT_TRUE(frame.tangent<double>(x, k).ok());
  const Frame::Displacements<DD> v = variables(variables(at));
  const auto energy = frame.energy<DD>(v);
  ASSERT_TRUE(energy.status.ok());
  const Eigen::MatrixXd dense = k;
  for (int i = 0; i < 7; ++i) {
    const auto& row = energy.value.partial[static_cast<std::size_t>(i)];
    EXPECT_NEAR(row.value, f[i], 1e-10 * f.cwiseAbs().maxCoeff());
    for (int j = 0; j < 7; ++j)
      EXPECT_NEAR(row.partial[static_cast<std::size_t>(j)], dense(i, j), 1e-10 * dense.cwiseAbs().maxCoeff());
  }
  const double* const values = k.valuePtr();
  ASSERT_TRUE(frame.tangent<double>(x, k).ok());
  EXPECT_EQ(k.valuePtr(), values);  // the storage is reused
}

TEST(Frame, TellsWhichMemberFails) {
  const Frame frame = cantilever(2, 100, 1);
  VectorXd x = VectorXd::Zero(6), f;
  x[3] = -1;
  const Status met = frame.force<double>(x, f);
  EXPECT_EQ(met.outcome(), Outcome::outside_validity);
  EXPECT_TRUE(tests::holds(met.sentence(), "member 1 from node 1 to node 2"));
  x[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(frame.energy<double>(x).status.outcome(), Outcome::non_finite);
}

TEST(Frame, RefusesWhatItCannotUse) {
  const std::vector<Node> nodes{{0, 0}, {1, 0}, {1, 0}};
  const auto frame = [&](const Member& m, const Support& s) { return Frame(nodes, {m}, {s}); };
  EXPECT_THROW(frame({0, 3, 1, 1}, {0, Motion::x}), std::invalid_argument);
  EXPECT_THROW(frame({1, 2, 1, 1}, {0, Motion::x}), std::invalid_argument);
  EXPECT_THROW(frame({0, 1, 0, 1}, {0, Motion::x}), std::invalid_argument);
  EXPECT_THROW(frame({0, 1, 1, -1}, {0, Motion::x}), std::invalid_argument);
  EXPECT_THROW(frame({0, 1, 1, 1}, {-1, Motion::x}), std::invalid_argument);
  const Frame good = frame({0, 1, 1, 1}, {0, Motion::x});
  VectorXd f;
  EXPECT_THROW((void)good.force<double>(VectorXd::Zero(2), f), std::invalid_argument);
  EXPECT_THROW((void)good.unknown(7, Motion::x), std::invalid_argument);
  EXPECT_EQ(good.unknown(0, Motion::x), -1);
  EXPECT_EQ(good.unknown(0, Motion::y), 0);
}

// ---- The toggle: limit points, half and full model, any number of elements.

PathPoint at_rest(const ToggleFrame& t) { return {VectorXd::Zero(t.frame.size()), 0, 1}; }

/// The load path under displacement control of the apex, in steps short enough for Newton's iteration.
PathPoint dropped(const ToggleFrame& t, double drop) {
  PathPoint at = at_rest(t);
  for (int i = 1; i <= 20; ++i) at = control(t.frame, t.load, t.apex, -drop * i / 20, at);
  return at;
}

TEST(Toggle, TheFullModelIsTheHalfOne) {
  for (const int elements : {1, 3}) {
    const ToggleFrame half = make_frame({.height = 0.44, .elements = elements});
    const ToggleFrame full = make_frame({.height = 0.44, .elements = elements, .full = true});
    const PathPoint a = dropped(half, 0.5), b = dropped(full, 0.5);
    EXPECT_NEAR(a.load, b.load, 1e-9);
    EXPECT_NEAR(b.x[full.frame.unknown(elements, Motion::rotation)], 0, 1e-12);
    EXPECT_EQ(full.load.sum(), 2 * half.load.sum());
  }
}

TEST(Toggle, PublishedLoadsLieBeyondTheLimit) {
  // 1e-9: half a unit of the reference's last digit times the stiffness, and the rounding error of the
  // residual.
  const ToggleFrame t = make_frame({.height = 0.44}), low = make_frame({});
  EXPECT_NEAR(dropped(t, 0.621922545486).load, 43.79, 1e-9);
  EXPECT_NEAR(dropped(t, 0.623070489).load, 44, 1e-7);
  EXPECT_NEAR(dropped(low, 0.265167973289).load, 27.11, 1e-9);
}

// For small loads the toggle of one element and Williams' equation agree to first order, except for cos(beta)
// = 1.
TEST(Toggle, AtRestItIsWilliams) {
  const double height = 0.44, square = std::pow(height / 12.94, 2);
  const ToggleFrame t = make_frame({.height = height});
  EXPECT_NEAR(
      control(t.frame, t.load, t.apex, -1e-7, at_rest(t)).slope / -Williams{.height = height}.stiffness(1e-7),
      1, 2 * square);
}

// A member of one element, with EA a thousand times that of Table 2.1, exceeds its clamped buckling load: the
// status reports it, and the load is that of the straight branch (79.286, and 81.1062 where a solver stops at
// the pole). oracle: homotopy_williams element 0.44 with 1000 EA*
TEST(Toggle, TheStraightBranchIsReported) {
  const ToggleFrame t = make_frame({.height = 0.44, .ea = 1.885e9});
  VectorXd x(1), f(1);
  x << -0.2;
  const Status status = t.frame.force<double>(x, f);
  EXPECT_EQ(status.outcome(), Outcome::wrong_branch);
  EXPECT_TRUE(tests::holds(status.sentence(), "clamped buckling load"));
  EXPECT_NEAR(-2 * f[0], 79.286, 5e-4);
}

TEST(Toggle, RefusesWhatItCannotBuild) {
  EXPECT_THROW((void)make_frame({.height = 0}), std::invalid_argument);
  EXPECT_THROW((void)make_frame({.height = 13}), std::invalid_argument);
  EXPECT_THROW((void)make_frame({.elements = 0}), std::invalid_argument);
  EXPECT_THROW((void)make_frame({.ea = -1}), std::invalid_argument);
}

// ---- Williams' equation: the chain of Eq. 2.20, misprints, and limit points.

using tests::expect_erratum;

/// d_5 by the chain of Eq. 2.20; negative rho is tension.
Real chain(const Real& rho) {
  const Real half_pi = acos(Real(-1)) / 2, x = half_pi * sqrt(abs(rho));
  const Real w = rho > 0 ? Real(x * cos(x) / sin(x)) : Real(x * cosh(x) / sinh(x));
  const Real d1 = (4 * half_pi * half_pi * rho / (4 * (1 - w)) + w) / 2, d2 = d1 - w, d3 = d1 + d2,
             d4 = d3 / 3;
  return 2 * d4 * w;
}

TEST(Williams, TheChainIsTheStabilityFunctions) {
  const Real pi_squared = FourPiSquared<Real>{}.high / 4;
  for (const double rho : {-20., -1., -0.01, 0.01, 0.5, 1., 2., 3.9}) {
    const Real n = -pi_squared * rho;
    // The chain divides by 1 - w, which is of size rho: two digits are lost.
    EXPECT_LT(abs(Real(stability_functions(n).antisymmetric.value + n - 6 * chain(rho))), Real(1e-45)) << rho;
  }
  // The printed rho = pi^2 EI/l^2 would be a constant, independent of the load.
  const Williams w;
  const Real printed = pi_squared * w.ei / (w.length * w.length);
  EXPECT_NEAR(static_cast<double>(printed), 546.4, 0.05);
  EXPECT_NEAR(static_cast<double>(chain(printed)), -864, 0.5);
  const Real n = -Real(w.compression(0.2)) * w.length * w.length / w.ei;  // Euler's load is at -pi^2
  const Textbook<Real> t = textbook(n);
  expect_erratum("homotopy-2.20", {.printed = static_cast<double>(chain(printed)),
                                   .corrected = static_cast<double>(chain(-n / pi_squared)),
                                   .oracle = static_cast<double>(Real((2 * (t.s + t.sc) + n) / 6)),
                                   .tolerance = eps});
}

TEST(Williams, SubstitutionGivesMinus) {  // 2.21
  const Williams w{.height = 0.44};
  for (const double delta : {0.1, 0.3, 0.6}) {
    const double sine = w.height / w.length, l = w.length, p = w.compression(delta);
    const double n = -p * l * l / w.ei;
    const double d5 = (stability_functions(n).antisymmetric.value + n) / 6;
    const double square = 3 * w.ea * sine / (5 * l * l) * delta * delta;
    const double linear = (6 * w.ei * d5 / (l * l * l) + w.ea * sine * sine / l) * delta;
    EXPECT_NEAR(linear - square, w.load(delta) / 2, 1e-12);
    EXPECT_GT(std::abs(linear + square - w.load(delta) / 2), 3);
    // Eqs 2.17 to 2.19 in 50 digits, d_5 by the chain: W/2 = F + P sin(beta).
    const Real wide = Real(w.ea) / l * (Real(delta) * w.height / l - 3 * Real(delta) * delta / (5 * Real(l)));
    const Real rho = wide * l * l / (w.ei * FourPiSquared<Real>{}.high / 4);
    const auto half =
        static_cast<double>(Real(6 * w.ei * chain(rho) * delta / (Real(l) * l * l) + wide * w.height / l));
    const double beta = std::asin(sine), literal = w.ea * (std::sin(beta * beta) - sine * sine) / l * delta;
    // Terms up to ten times their sum, each with a few rounding errors.
    const double tolerance = 128 * eps;
    expect_erratum(
        "homotopy-2.21-sign",
        {.printed = linear + square, .corrected = linear - square, .oracle = half, .tolerance = tolerance});
    expect_erratum("homotopy-2.21-square", {.printed = linear + literal - square,
                                            .corrected = linear - square,
                                            .oracle = half,
                                            .tolerance = tolerance});
  }
}

TEST(Williams, StiffnessIsTheSlope) {
  const Williams w{.height = 0.38};
  for (const double delta : {0., 0.05, 0.2, 0.39, 0.8, 1.5, -0.3}) {
    using D = Dual<double, 1>;
    const double slope = w.load(D::variable(delta, 0)).partial[0];
    EXPECT_NEAR(w.stiffness(delta), slope, 1e-12 * (300 + std::abs(slope))) << delta;
  }
}

// oracle: homotopy_williams Williams 0.32 least slope*, Williams 0.32 load at the least slope
TEST(Williams, TheFirstCaseHasNoLimitPoint) {
  const Williams w;
  double least = HUGE_VAL, at = 0;
  for (double delta = 0; delta < 1; delta += 1e-4) {
    if (w.stiffness(delta) < least) {
      least = w.stiffness(delta);
      at = delta;
    }
  }
  EXPECT_NEAR(least, 12.55869263, 1e-4);  // a grid of 1e-4 about a minimum of curvature 2e3
  EXPECT_NEAR(at, 0.26457338, 1e-4);
  EXPECT_NEAR(w.load(0.26457338), 27.0833960, 1e-6);
}

// oracle: homotopy_williams Williams 0.?? drop under *
TEST(Williams, PublishedLoadsHaveOneEquilibrium) {
  const Williams high{.height = 0.44}, low;
  // Half a unit of the reference's last digit times the stiffness, about 210 lb/in, is 1e-10.
  EXPECT_NEAR(high.load(0.635331561089), 43.79, 2e-10);
  EXPECT_NEAR(high.load(0.636310193301), 44, 2e-10);
  EXPECT_NEAR(low.load(0.266690787315), 27.11, 1e-10);
  EXPECT_LT(high.load(0.22818821400337), 43.79);  // no equilibrium at 43.79 before the limit point
}

TEST(Williams, PastThePole) {
  EXPECT_EQ(Williams{}.outcome(0.3), Outcome::success);
  EXPECT_EQ((Williams{.height = 0.44, .ea = 1.885e8}.outcome(0.2)), Outcome::wrong_branch);
  EXPECT_EQ(Williams{}.outcome(std::numeric_limits<double>::quiet_NaN()), Outcome::non_finite);
}

}  // namespace
}  // namespace nlmech::frames::frame_test
