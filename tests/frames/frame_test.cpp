/// Frames: assembly, several turns, refusals.
#include "nlmech/frames/frame.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/frames/oracle.hpp"

namespace nlmech::frames::frame_test {
namespace {

using namespace oracle;
using Eigen::VectorXd;

/// A cantilever along x of members of length 1.
Frame cantilever(int members, double ea, double ei) {
  std::vector<Node> nodes{{0, 0}};
  std::vector<Member> parts;
  for (int i = 1; i <= members; ++i) {
    nodes.push_back({static_cast<double>(i), 0});
    parts.push_back({i - 1, i, ea, ei});
  }
  return {nodes, parts, {{0, Motion::x}, {0, Motion::y}, {0, Motion::rotation}}};
}

// Under an end moment M there is no axial force, every member turns by phi = M l/EI, and its chord is shorter
// by phi^2/24 (n = 0 in Eq. 2.28): a regular polygon, rolled up several times. Only this state has the forces
// 0,
// ..., 0, M; a rotation taken modulo a turn anywhere would show as a moment of order EI.
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
    EXPECT_NEAR(px, 0, 1e-13);  // closed
    ASSERT_TRUE(frame.force<double>(x, f).ok());
    // Places of size up to 60 are rounded: forces are wrong by EA times some eps of that, moments by EI g_s'
    // theta_s/2 times the error of n, 60 eps EA/EI.
    EXPECT_NEAR(f[frame.size() - 1], ei * phi, 1e-11 * ei);
    f[frame.size() - 1] = 0;
    EXPECT_LT(f.cwiseAbs().maxCoeff(), 60 * 8 * eps * ea);
  }
}

TEST(Frame, TangentIsTheHessianOfTheEnergy) {
  const Frame frame({{0, 0}, {1, 0.2}, {1.5, 1}}, {{0, 1, 30, 2}, {1, 2, 40, 1}, {2, 0, 50, 3}},
                    {{0, Motion::x}, {0, Motion::y}, {2, Motion::y}});
  ASSERT_EQ(frame.size(), 6);
  using DD = Dual<Dual<double, 6>, 6>;
  Vector<double, 6> at;
  at << 0.2, -0.1, 0.15, 0.4, 0.12, -0.3;
  const VectorXd x = at;
  VectorXd f;
  Eigen::SparseMatrix<double> k;
  ASSERT_TRUE(frame.force<double>(x, f).ok());
  ASSERT_TRUE(frame.tangent<double>(x, k).ok());
  const Frame::Displacements<DD> v = variables(variables(at));
  const auto energy = frame.energy<DD>(v);
  ASSERT_TRUE(energy.status.ok());
  const Eigen::MatrixXd dense = k;
  for (int i = 0; i < 6; ++i) {
    const auto& row = energy.value.partial[static_cast<std::size_t>(i)];
    EXPECT_NEAR(row.value, f[i], 1e-10 * f.cwiseAbs().maxCoeff());
    for (int j = 0; j < 6; ++j)
      EXPECT_NEAR(row.partial[static_cast<std::size_t>(j)], dense(i, j), 1e-10 * dense.cwiseAbs().maxCoeff());
  }
  const double* const values = k.valuePtr();
  ASSERT_TRUE(frame.tangent<double>(x, k).ok());
  EXPECT_EQ(k.valuePtr(), values);  // filled again in place
}

TEST(Frame, TellsWhichMemberFails) {
  const Frame frame = cantilever(2, 100, 1);
  VectorXd x = VectorXd::Zero(6), f;
  x[3] = -1;
  const Status met = frame.force<double>(x, f);
  EXPECT_EQ(met.outcome(), Outcome::outside_validity);
  EXPECT_NE(met.sentence().find("member 1 from node 1 to node 2"), std::string::npos) << met.text();
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
  EXPECT_THROW(static_cast<void>(good.force<double>(VectorXd::Zero(2), f)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(good.unknown(7, Motion::x)), std::invalid_argument);
  EXPECT_EQ(good.unknown(0, Motion::x), -1);
  EXPECT_EQ(good.unknown(0, Motion::y), 0);
}

}  // namespace
}  // namespace nlmech::frames::frame_test
