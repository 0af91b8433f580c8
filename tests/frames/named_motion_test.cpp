/// The motion of frames in time: frequencies, energies, and loads that cannot make them buckle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>

#include "nlmech/frames/named/frame_motion.hpp"
#include "tests/frames/named_models.hpp"

namespace nlmech::frames::named_motion_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

/// A beam with a mass of 1 per length and EI = 1, clamped at its left end alone if it is a cantilever, else
/// pinned at both.
FrameModel heavy_beam(bool is_cantilever) {
  FrameModel m;
  m.nodes = {{"a", 0, 0}, {"b", 1, 0}};
  m.members = {{.first = "a", .second = "b", .ea = 1e4, .ei = 1, .mass = 1}};
  if (is_cantilever) {
    models::clamp(m, "a");
    m.loads = {{"b", Motion::y, -1}};
  } else {
    models::pin(m, "a");
    m.supports.push_back({"b", Motion::y});
    m.loads = {{"b", Motion::rotation, 1}};
  }
  return m;
}

/// Frequencies of small motions by the Jacobian, rising.
VectorXd frequencies(const FrameMotion& motion) {
  const int n = motion.size() / 2;
  MatrixXd j;
  motion.jacobian(0, motion.rest(), j);
  const VectorXd root = motion.frame().mass.cwiseSqrt();
  const MatrixXd symmetric =
      -(root.asDiagonal() * j.bottomLeftCorner(n, n) * root.cwiseInverse().asDiagonal());
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(symmetric).eigenvalues().cwiseMax(0).cwiseSqrt();
}

/// The one nearest to a known frequency.
double nearest(const VectorXd& all, double known) {
  Eigen::Index at = 0;
  (all.array() - known).abs().minCoeff(&at);
  return all[at];
}

// Euler and Bernoulli: beta^2 with cos(beta) cosh(beta) = -1 for the cantilever, (k pi)^2 between pins; along
// the axis the cantilever has pi/2 sqrt(EA/m). Lumped masses err by m^-2.
TEST(FrameMotions, FrequenciesOfBeams) {
  const auto worst = [](int elements) {
    const NamedFrame cantilever = build(heavy_beam(true), elements),
                     pinned = build(heavy_beam(false), elements);
    const VectorXd one = frequencies({cantilever, {}}), other = frequencies({pinned, {}});
    double off = 0;
    for (const double beta : {1.8751040687119611, 4.694091132974175, 7.854757438237613})
      off = std::max(off, std::abs(nearest(one, beta * beta) / (beta * beta) - 1));
    for (const int k : {1, 2, 3})
      off = std::max(off, std::abs(nearest(other, k * k * pi * pi) / (k * k * pi * pi) - 1));
    return std::max(off, std::abs(nearest(one, 50 * pi) / (50 * pi) - 1));
  };
  const double coarse = worst(20), fine = worst(40);
  EXPECT_LT(coarse, 0.02);
  EXPECT_NEAR(coarse / fine, 4, 0.2);
}

TEST(FrameMotions, MassesAddUp) {
  FrameModel m = models::lee();
  for (NamedMember& member : m.members) member.mass = 0.5;
  m.masses = {{"load", 3, 7}};
  const NamedFrame f = build(m, 2);
  double along = 0;
  for (std::size_t i = 0; i < f.frame.nodes().size(); ++i) {
    const Eigen::Index at = f.frame.unknown(static_cast<int>(i), Motion::y);
    if (at >= 0) along += f.mass[at];
  }
  // 240 of members, less what the supports carry: half an element at each end.
  EXPECT_NEAR(along, 3 + 0.5 * (240 - 12), 1e-12);
  FrameModel without = m;
  without.masses.clear();
  const NamedFrame g = build(without, 2);
  const auto turn = [](const NamedFrame& of) { return of.mass[of.frame.unknown(2, Motion::rotation)]; };
  EXPECT_NEAR(turn(f) - turn(g), 7, 1e-12);
  m.masses[0].mass = -1;
  EXPECT_THROW((void)build(m, 2), ModelError);
}

TEST(FrameMotions, JacobianIsThatOfTheAcceleration) {
  FrameModel m = heavy_beam(true);
  m.damping = {.mass = 0.3, .stiffness = 0.01};
  const NamedFrame f = build(m, 3);
  const FrameMotion motion(f, {.factor = 2});
  VectorXd x(motion.size()), plus, minus;
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 0.02 * std::sin(1. + static_cast<double>(i));
  MatrixXd j;
  motion.jacobian(0.5, x, j);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double h = 1e-6;
    VectorXd moved = x;
    moved[i] += h;
    motion(0.5, moved, plus);
    moved[i] -= 2 * h;
    motion(0.5, moved, minus);
    EXPECT_LT(((plus - minus) / (2 * h) - j.col(i)).cwiseAbs().maxCoeff(), 1e-7 * j.cwiseAbs().maxCoeff());
  }
}

TEST(FrameMotions, LoadHistories) {
  const LoadHistory step{.factor = 3}, ramp{LoadHistory::Kind::ramp, 3, 2},
      pulse{LoadHistory::Kind::pulse, 3, 2};
  EXPECT_EQ(step.at(0), 3);
  EXPECT_EQ(ramp.at(0), 0);
  EXPECT_EQ(ramp.at(1), 1.5);
  EXPECT_EQ(ramp.at(5), 3);
  EXPECT_EQ(pulse.at(1.999), 3);
  EXPECT_EQ(pulse.at(2), 0);
  const NamedFrame f = build(heavy_beam(true), 1);
  EXPECT_TRUE(FrameMotion(f, step).discontinuities(0, 5).empty());
  EXPECT_EQ(FrameMotion(f, ramp).discontinuities(0, 5), std::vector<double>{2});
  EXPECT_TRUE(FrameMotion(f, pulse).discontinuities(2, 5).empty());
  EXPECT_THROW(FrameMotion(f, {LoadHistory::Kind::ramp, 1, 0}), std::invalid_argument);
  EXPECT_THROW(FrameMotion(f, {.factor = NAN}), std::invalid_argument);
}

TEST(FrameMotions, HighestFrequency) {
  const NamedFrame f = build(heavy_beam(true), 6);
  const FrameMotion motion(f, {});
  const double highest = frequencies(motion).maxCoeff();
  EXPECT_LE(motion.highest_frequency(), highest * (1 + 1e-9));
  EXPECT_GE(motion.highest_frequency(), 0.9 * highest);
}

TEST(FrameMotions, NeedMassesAndNoGivenDisplacements) {
  FrameModel m = models::truss();
  try {
    const FrameMotion motion(build(m, 1), {});
    ADD_FAILURE();
  } catch (const ModelError& error) {
    EXPECT_EQ(error.part(), ModelPart::members);
    EXPECT_NE(std::string(error.what()).find("mass"), std::string::npos);
  }
  for (NamedMember& member : m.members) member.mass = 1;
  m.displacements = {{"apex", Motion::y, 1}};
  m.loads.clear();
  const NamedFrame f = build(m, 1);
  EXPECT_THROW(FrameMotion(f, {}), ModelError);
}

/// A step of which FrameEnergies asks: a line in the state.
struct Line {
  double t0, t1;
  VectorXd x0, x1;
  [[nodiscard]] VectorXd at(double t) const { return x0 + (t - t0) / (t1 - t0) * (x1 - x0); }
};

// On a line all integrals are of polynomials of low degree, which Gauss' rule has exactly.
TEST(FrameEnergies, WorkAndDissipationOfALine) {
  FrameModel m = heavy_beam(true);
  m.damping.mass = 0.5;
  const NamedFrame f = build(m, 1);
  const FrameMotion motion(f, {LoadHistory::Kind::ramp, 3, 2});
  const Eigen::Index n = f.frame.size(), down = f.frame.unknown(1, Motion::y);
  Line line{0, 1, motion.rest(), motion.rest()};
  line.x1[down] = -0.4;      // with a load of -1 times 1.5 t
  line.x1[n + down] = -0.4;  // velocities are what the line says, not its slope
  FrameEnergies energies(motion);
  energies.take(line);
  EXPECT_NEAR(energies.work, 1.5 * 0.4 / 2, 1e-14);  // 1.5 t times 0.4 dt
  EXPECT_NEAR(energies.kinetic, 0.5 * f.mass[down] * 0.16, 1e-14);
  EXPECT_NEAR(energies.dissipated, 0.5 * f.mass[down] * 0.16 / 3, 1e-14);
}

}  // namespace
}  // namespace nlmech::frames::named_motion_test
