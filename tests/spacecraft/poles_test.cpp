/// Zeros of analytic functions; poles and zeros of the plant. The scene natural-frequencies records those of
/// Table 3.1.
#include "nlmech/spacecraft/plant/poles.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "nlmech/spacecraft/plant/roots.hpp"
#include "tests/spacecraft/random_spacecraft.hpp"
#include "tests/thrown.hpp"

namespace nlmech::spacecraft::poles_test {
namespace {

AnalyticFunction polynomial(std::vector<Complex> zeros) {
  return [zeros = std::move(zeros)](Complex s) {
    Jet product(1.);
    for (const Complex& zero : zeros) product = product * (Jet::variable(s) - Jet(zero));
    return product;
  };
}

TEST(Roots, OfAPolynomialAreAllFound) {
  const std::vector<Complex> zeros = {{-3, -1}, {0.1, 0}, {0.1001, 0}, {-2, 0.5}, {1.2, 0.9}, {5, 0}};
  const Roots found = find_roots(polynomial(zeros), {-4, 2, -2, 2});
  ASSERT_TRUE(found.status.ok()) << found.status.text();
  EXPECT_EQ(found.count, 5);
  ASSERT_EQ(found.roots.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    // 64 eps times the condition, 1e4/|product of the other distances| of the close pair.
    double nearest = 1;
    for (const Complex& r : found.roots) nearest = std::min(nearest, std::abs(r - zeros[i]));
    EXPECT_LE(nearest, 1e-10) << zeros[i];
  }
}

TEST(Roots, MultipleOnesCountAsOftenAsTheyAre) {
  const Roots found = find_roots(polynomial({{0.3, 0.4}, {0.3, 0.4}, {0.3, 0.4}, {-1, 0}}), {-2, 2, -2, 2});
  EXPECT_EQ(found.count, 4);
  ASSERT_EQ(found.roots.size(), 4U);
  // A triple zero is determined to the cube root of eps.
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LE(std::abs(found.roots[i] - Complex(0.3, 0.4)), 1e-5);
}

TEST(Roots, OfTranscendentalFunctions) {
  // exp has none; sin has 2 n + 1 within (n + 1/2) pi.
  const auto exponential = [](Complex s) { return exp(Jet::variable(s)); };
  EXPECT_EQ(count_roots(exponential, {-30, 20, -17, 40}).count, 0);
  const auto sine = [](Complex s) { return Jet(std::sin(s), std::cos(s)); };
  const double pi = std::numbers::pi;
  const Roots found = find_roots(sine, {-7.5 * pi, 7.5 * pi, -1, 2});
  ASSERT_EQ(found.roots.size(), 15U);
  std::vector<double> real;
  for (const Complex& r : found.roots) real.push_back(r.real());
  std::sort(real.begin(), real.end());
  for (int i = -7; i <= 7; ++i) EXPECT_NEAR(real[static_cast<std::size_t>(i + 7)], i * pi, 1e-14) << i;
}

// A positive scale factor that depends on the point does not change the zeros.
TEST(Roots, AreThoseOfTheFunctionWhateverItsScale) {
  const auto plain = polynomial({{1, 1}, {-1, 0.5}});
  const auto scaled = [&](Complex s) {
    const double factor = std::exp(-3 * std::abs(s));
    const Jet f = plain(s);
    return Jet(factor * f.value, factor * f.slope);
  };
  EXPECT_EQ(count_roots(scaled, {-2, 2, -2, 2}).count, 2);
  EXPECT_EQ(find_roots(scaled, {-2, 2, -2, 2}).roots.size(), 2U);
}

TEST(Roots, SayWhereTheyCannotCount) {
  const RootCount count = count_roots(polynomial({{1, 0}}), {-1, 1, -1, 1});
  EXPECT_EQ(count.status.outcome(), Outcome::not_converged);
  EXPECT_TRUE(tests::holds(count.status.sentence(), "boundary"));
  const double nan = std::nan("");
  const auto broken = [=](Complex) { return Jet(Complex(nan, 0), Complex(nan, 0)); };
  EXPECT_EQ(count_roots(broken, {-1, 1, -1, 1}).status.outcome(), Outcome::not_converged);
  EXPECT_EQ(refine_root(broken, 1.).status.outcome(), Outcome::non_finite);
  const auto flat = [](Complex s) { return exp(Jet::variable(s)); };
  EXPECT_EQ(refine_root(flat, 1.).status.outcome(), Outcome::not_converged);
  EXPECT_THROW((void)count_roots(flat, {1, -1, 0, 1}), std::invalid_argument);
  EXPECT_THROW((void)find_roots(flat, {0, nan, 0, 1}), std::invalid_argument);
}

// Wave numbers of textbooks: a cantilever, cos q cosh q = -1, and a beam with a pinned end (infinite tip
// mass), tan q = tanh q.
TEST(Poles, OfTheLockedHubAreTheTextbooks) {
  const Plant plant(without_tip(table_3_1()));
  const double unit = std::sqrt(plant.appendage().beta_unit());
  const std::array<double, 4> free_end = {1.875104068711961, 4.694091132974175, 7.854757438237613,
                                          10.99554073487547};
  const Frequencies zeros = hub_zeros(plant, 4);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(std::sqrt(zeros.omega[i] * unit), free_end[i], 4e-15 * 11) << i;
  Parameters heavy = without_tip(table_3_1());
  heavy.tip_mass = 1e12;
  const Plant pinned(heavy);
  const std::array<double, 3> pinned_end = {3.926602312047919, 7.068582745628732, 10.21017612281303};
  const Frequencies of_heavy = hub_zeros(pinned, 4);
  // Nearer than the mass ratio 1e-13; the first mode is the heavy body on its beam: omega^2 = 3 EI/(m L^3).
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(std::sqrt(of_heavy.omega[i + 1] * unit), pinned_end[i], 1e-12) << i;
  EXPECT_NEAR(of_heavy.omega[0] / std::sqrt(3 * heavy.bending_stiffness() / (1e12 * 64)), 1, 1e-12);
}

// Between two poles there is one zero of theta/u: none is missed, also without hub inertia.
RC_GTEST_PROP(Poles, AndHubZerosAlternate, ()) {
  Parameters p = *random_spacecraft();
  if (*rc::gen::inRange(0, 4) == 0) p.hub_inertia = 0;
  const Plant plant(p);
  const Frequencies a = poles(plant, 12), b = hub_zeros(plant, 12);
  RC_ASSERT(a.status.ok());
  RC_ASSERT(b.status.ok());
  for (std::size_t i = 0; i < 12; ++i) {
    RC_ASSERT(b.omega[i] < a.omega[i]);
    if (i > 0) RC_ASSERT(a.omega[i - 1] < b.omega[i]);
  }
}

TEST(Poles, OfExtremeSpacecraft) {
  for (const double mass : {0., 1e6}) {
    for (const double inertia : {0., 1e4}) {
      for (const double length : {1e-3, 1e4}) {
        Parameters p = table_3_1();
        p.tip_mass = mass;
        p.tip_inertia = inertia;
        p.length = length;
        const Plant plant(p);
        const Frequencies found = poles(plant, 20);
        EXPECT_TRUE(found.status.ok()) << mass << " " << inertia << " " << length << found.status.text();
        EXPECT_EQ(found.omega.size(), 20U);
      }
    }
  }
  EXPECT_EQ(poles(Plant(table_3_1()), 300).counted, 300);
  EXPECT_THROW((void)poles(Plant(table_3_1()), 0), std::invalid_argument);
}

// The same poles by the general search in the plane of s, which does not use the axis.
TEST(Poles, AreFoundInThePlaneToo) {
  const Plant plant(table_3_1());
  const auto f = [&](Complex s) { return plant.effective_inertia(plant.appendage().motion_with_slope(s)); };
  const Roots found = find_roots(f, {-3, 4.1, 0.5, 1900});
  ASSERT_TRUE(found.status.ok()) << found.status.text();
  const std::vector<double> known = poles(plant, 9).omega;
  ASSERT_EQ(found.roots.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i)
    EXPECT_LE(std::abs(found.roots[i] - Complex(0, known[i])), 1e-13 * known[i]) << i;
}

TEST(Zeros, OfTheDeflectionAreCounted) {
  const std::vector<std::tuple<bool, double, double, int>> known = {{false, 2, 58.41374448378, 5},
                                                                    {false, 4, 83.95212094686, 5},
                                                                    {true, 2, 37.81075762923, 6},
                                                                    {true, 4, 52.45443464444, 6}};
  for (const auto& [tip, x, first, count] : known) {
    const Plant plant(tip ? table_3_1() : without_tip(table_3_1()));
    const Zeros zeros = deflection_zeros(plant, x, 1309.5);
    EXPECT_TRUE(zeros.status.ok());
    EXPECT_EQ(zeros.counted, count);
    ASSERT_EQ(zeros.s.size(), static_cast<std::size_t>(count));
    EXPECT_NEAR(zeros.s[0].imag() / first, 1, 1e-12);
    for (const Complex& s : zeros.s) {
      EXPECT_EQ(s.real(), 0);
      // y changes sign there.
      EXPECT_LT(plant.at_frequency(s.imag() * (1 - 1e-9), x).deflection *
                    plant.at_frequency(s.imag() * (1 + 1e-9), x).deflection,
                0);
    }
  }
}

RC_GTEST_PROP(Zeros, OfTheDeflectionAreZeros, ()) {
  const Plant plant(*random_spacecraft());
  const double x = *between(0.05, 1) * plant.parameters().length;
  const double highest = 200 / std::sqrt(plant.appendage().beta_unit());
  const Zeros zeros = deflection_zeros(plant, x, highest);
  RC_ASSERT(zeros.status.ok());
  for (const Complex& s : zeros.s) {
    RC_ASSERT(s.imag() >= 0);
    // |y| over its slope times s: 1e-9 of a relative change of s.
    const Motion<Jet> m = plant.appendage().motion_with_slope(s);
    const Jet y = plant.appendage().deflection(m, x);
    RC_ASSERT(std::abs(y.value) <= 1e-9 * std::abs(s * y.slope));
  }
}

TEST(Zeros, RefuseWhatHasNone) {
  const Plant plant(table_3_1());
  EXPECT_THROW((void)deflection_zeros(plant, 0, 100), std::invalid_argument);
  EXPECT_THROW((void)deflection_zeros(plant, 5, 100), std::invalid_argument);
  EXPECT_THROW((void)deflection_zeros(plant, 2, -1), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::spacecraft::poles_test
