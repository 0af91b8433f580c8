/// Ends of the appendages: springs at the roots, supports of the tips, torques on the tips.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/poles.hpp"
#include "nlmech/spacecraft/plant/timoshenko.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "tests/spacecraft/oracle.hpp"
#include "tests/thrown.hpp"

namespace nlmech::spacecraft::ends_test {
namespace {

constexpr double clamped = std::numeric_limits<double>::infinity();

/// Table 3.1 with other ends. @param root k L/EI
Parameters craft(double root, TipSupport tip, bool body = true) {
  Parameters p = body ? table_3_1() : without_tip(table_3_1());
  p.root_stiffness = root * (p.bending_stiffness() / p.length);
  p.tip_support = tip;
  return p;
}

std::vector<Parameters> all_ends() {
  std::vector<Parameters> all;
  for (const TipSupport tip :
       {TipSupport::free, TipSupport::pinned, TipSupport::guided, TipSupport::clamped}) {
    for (const double root : {0., 0.3, clamped}) all.push_back(craft(root, tip));
    for (const double root : {0., 1e-6, 40., clamped}) all.push_back(craft(root, tip, false));
  }
  return all;
}

std::string name_of(const Parameters& p) {
  return "root " + std::to_string(p.root_ratio()) + ", tip " +
         std::to_string(static_cast<int>(p.tip_support)) + (p.has_tip() ? ", body" : ", bare");
}

// The oracle sums the momentum over the beam, where the library has loads and reactions. A few dozen
// roundings; of the deflection relative to the larger one, since it vanishes at a held tip.
TEST(Ends, TransferFunctionsAgreeWith110Digits) {
  constexpr std::array x = {2., 3.9};
  constexpr std::array places = {Complex(0, 0.01), Complex(0, 30),  Complex(0, 5000),
                                 Complex(-40, 0),  Complex(-3, 40), Complex(60, 700)};
  for (const Parameters& p : all_ends()) {
    const Plant plant(p);
    for (const Complex s : places) {
      std::array<oracle::Exact, 2> exact{};
      double size = 0, condition = 1;
      for (std::size_t i = 0; i < x.size(); ++i) {
        exact[i] = oracle::by_exponentials(p, s, x[i]);
        size = std::max(size, std::abs(exact[i].deflection));
        condition = std::max({condition, exact[i].theta_condition, exact[i].deflection_condition});
      }
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Response r = plant.response(s, x[i]);
        EXPECT_LE(std::abs(r.theta / exact[i].theta - 1.), 1e-13 * condition) << name_of(p) << " at " << s;
        EXPECT_LE(std::abs(r.deflection - exact[i].deflection), 1e-13 * condition * size)
            << name_of(p) << " at " << s << ", " << x[i];
      }
    }
  }
}

// Both evaluations have the same normalisation of D_0, which the argument principle and the sign changes
// need.
TEST(Ends, SeriesAndWavesAreOneFunction) {
  for (const Parameters& p : all_ends()) {
    const Appendage a(p);
    for (const Complex b : {Complex(-39, 0), Complex(39, 0), Complex(-20, 30), Complex(5, -35)}) {
      for (const Drive drive : {Drive::hub, Drive::tip_torque}) {
        const Motion<Complex> k = motion_by_series(a.ratios(), b, drive),
                              w = motion_by_waves(a.ratios(), b, drive);
        const double factor = std::exp(w.exponent);
        const auto same = [&](Complex by_series, Complex by_waves) {
          EXPECT_LE(std::abs(by_series - factor * by_waves), 1e-12 * factor) << name_of(p) << " at " << b;
        };
        same(k.determinant, w.determinant);
        if (drive == Drive::hub) same(k.inertia, w.inertia);
        for (const double xi : {0.3, 0.95}) {
          for (const int order : {0, 1, 2, 3})
            same(relative_deflection(k, a.ratios(), xi, order),
                 relative_deflection(w, a.ratios(), xi, order));
        }
      }
    }
  }
}

// Fourth order; Hermite's cubics have errors of (q h)^4/1440 with the wave number q, here within a factor
// of 2.
TEST(Ends, FiniteElementsConvergeToThePoles) {
  for (const Parameters& p : all_ends()) {
    // The stiffness matrix is not positive definite to rounding, or nearly so.
    if (p.tip_support == TipSupport::free && p.root_ratio() < 1e-3) continue;
    const Frequencies exact = poles(Plant(p), 3);
    ASSERT_TRUE(exact.status.ok()) << name_of(p) << ": " << exact.status.text();
    const Eigen::VectorXd coarse = diagonalise(finite_elements(p, 20)).omega,
                          fine = diagonalise(finite_elements(p, 40)).omega;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double before = coarse[k] / exact.omega[i] - 1, after = fine[k] / exact.omega[i] - 1;
      const double qh = std::sqrt(exact.omega[i] * std::sqrt(Appendage(p).beta_unit())) / 40;
      EXPECT_LE(after, std::pow(qh, 4) / 720 + 1e-9) << name_of(p) << ", mode " << i + 1;
      EXPECT_GE(after, -1e-9) << name_of(p) << ", mode " << i + 1;  // Ritz's bound, and rounding
      if (before > 1e-7) {
        EXPECT_NEAR(std::log2(before / after), 4, 0.2) << name_of(p) << ", mode " << i + 1;
      }
    }
  }
}

/// Unit torques on both tips in finite elements: theta, and q.
Eigen::VectorXd tip_load(const Parameters& p, const DiscreteModel& m, int elements) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(m.size() + 1);
  load[0] = 2;
  // The last coordinate is the slope at the tip times the element length.
  if (!p.tip_keeps_slope()) load[m.size()] = 2 / (p.length / elements);
  return load;
}

// 80 elements: errors of 1/720 (q/80)^4 = 1e-8 times the condition at these frequencies, q up to 5.6.
TEST(Ends, TorquesOnTheTipsAgreeWithFiniteElements) {
  constexpr int elements = 80;
  for (const Parameters& p : all_ends()) {
    const DiscreteModel m = finite_elements(p, elements);
    const Plant plant(p);
    for (const double omega : {0.5, 20., 103.}) {
      const Eigen::MatrixXd dynamic = m.full_stiffness() - omega * omega * m.full_mass();
      const Eigen::VectorXd moved = dynamic.partialPivLu().solve(tip_load(p, m, elements));
      const std::array<double, 2> x = {1., 3.9};
      Complex theta;
      std::array<Complex, 2> y;
      ASSERT_EQ(plant.tip_torque_response({0, omega}, x, theta, y), Outcome::success);
      const double size = std::abs(moved[0]) + moved.tail(m.size()).cwiseAbs().maxCoeff() / p.length;
      EXPECT_NEAR(theta.real(), moved[0], 1e-5 * size) << name_of(p) << " at " << omega;
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(y[i].real(), m.shape(x[i]).dot(moved.tail(m.size())), 1e-5 * size * p.length)
            << name_of(p) << " at " << omega << ", " << x[i];
    }
  }
}

// eta_i'' + omega_i^2 eta_i = f_i from rest. The sums over finite elements end at the modes of 40 elements.
TEST(Ends, StepsOfTorqueAgreeWithFiniteElements) {
  constexpr int elements = 40;
  constexpr std::array<double, 1> place = {2};
  for (const Parameters& p :
       {craft(clamped, TipSupport::free), craft(0.3, TipSupport::free), craft(0, TipSupport::pinned),
        craft(40, TipSupport::guided), craft(2, TipSupport::clamped, false)}) {
    const DiscreteModel m = finite_elements(p, elements);
    const ModalModel modes = diagonalise(m);
    for (const Input input : {Input::hub, Input::tips}) {
      const TimeResponse r = torque_response(Plant(p), 1, place, {}, input);
      ASSERT_TRUE(r.status.ok()) << name_of(p) << ": " << r.status.text();
      Eigen::VectorXd load = Eigen::VectorXd::Unit(m.size() + 1, 0);
      if (input == Input::tips) load = tip_load(p, m, elements);
      const Eigen::VectorXd forces =
          modes.vectors.transpose() * (load.tail(m.size()) - m.coupling * (load[0] / m.total_inertia));
      for (const double t : {0.1, 0.7, 3.}) {
        const Eigen::VectorXd eta =
            forces.array() * (1 - (modes.omega.array() * t).cos()) / modes.omega.array().square();
        const double theta = load[0] * t * t / (2 * m.total_inertia) + modes.participation.dot(eta),
                     y = modes.mode_shapes(2).dot(eta);
        // Errors of the phases, (q h)^4/1440 omega t: 2e-5 and 4e-4 in the first two modes of the stiffest
        // craft.
        EXPECT_NEAR(r.theta.value(t), theta, 1e-5 * std::abs(theta)) << name_of(p) << " at " << t;
        EXPECT_NEAR(r.deflection[0].value(t), y, 5e-4 * r.deflection[0].envelope(0) + 1e-9)
            << name_of(p) << " at " << t;
      }
    }
  }
}

TEST(Ends, WhatIsForCantileversRefusesOthers) {
  const Parameters swinging = craft(0, TipSupport::free), held = craft(clamped, TipSupport::pinned);
  constexpr std::array<double, 1> place = {2};
  for (const std::string& text :
       {tests::thrown<std::invalid_argument>([&] { (void)ClosedLoop(swinging, designed_gains).poles(2); }),
        tests::thrown<std::invalid_argument>(
            [&] { (void)step_response(ClosedLoop(swinging, designed_gains), 1, place); }),
        tests::thrown<std::invalid_argument>([&] { (void)torque_response(Plant(swinging), 1, place); })})
    EXPECT_TRUE(tests::holds(text, "swing freely about pinned roots"));
  for (const std::string& text :
       {tests::thrown<std::invalid_argument>([&] { (void)assumed_modes(held, 3); }),
        tests::thrown<std::invalid_argument>([&] { (void)statics(held, 2); }),
        tests::thrown<std::invalid_argument>([&] { (void)optimal_gains(held, {}); }),
        tests::thrown<std::invalid_argument>([&] {
          (void)timoshenko_frequencies(held, {1, 1}, 2, 10);
        })})
    EXPECT_TRUE(tests::holds(text, "clamped root and a free tip"));
  Parameters bad = table_3_1();
  bad.root_stiffness = -1;
  EXPECT_THROW(require_physical(bad), std::invalid_argument);
  EXPECT_THROW((void)deflection_zeros(Plant(held), held.length, 100), std::invalid_argument);
  // At s = 0 the swinging appendage has a pole.
  EXPECT_EQ(Plant(swinging).response(0., 2).outcome, Outcome::at_pole);
}

}  // namespace
}  // namespace nlmech::spacecraft::ends_test
