#include "nlmech/problems/parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/duffing_chain.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::problems::parameters_test {
namespace {

using nlmech::tests::Real;

template <class Problem>
class Parameters : public ::testing::Test {};
using Problems =
    ::testing::Types<Duffing, ImpactDuffing, ThreeMassChain, BasicThreeMassChain<Real>, VanDerPol, BlowUp>;
TYPED_TEST_SUITE(Parameters, Problems);

// Setting one parameter changes that one and no other; the problem is nothing but its parameters.
TYPED_TEST(Parameters, AreAllReachedByName) {
  const auto names = parameter_names<TypeParam>();
  using Value = std::remove_cvref_t<decltype(parameter(std::declval<TypeParam&>(), ""))>;
  EXPECT_EQ(sizeof(TypeParam), names.size() * sizeof(Value)) << "a parameter is missing in the list";
  EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
  for (const auto name : names) {
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string_view::npos)
        << name;
    TypeParam problem;
    const TypeParam original;
    set_parameter(problem, name, 17.5);
    for (const auto other : names)
      EXPECT_EQ(parameter(problem, other), other == name ? Value(17.5) : parameter(original, other)) << other;
  }
}

TYPED_TEST(Parameters, AreListedWhenOneIsUnknown) {
  TypeParam problem;
  for (const char* name : {"", "no-such", "Hardening"}) {
    try {
      set_parameter(problem, name, 1);
      FAIL() << "took '" << name << "'";
    } catch (const std::invalid_argument& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("'" + std::string(name) + "'"), std::string::npos) << text;
      EXPECT_NE(text.find(std::string(TypeParam::name) + ":"), std::string::npos) << text;
      for (const auto known : parameter_names<TypeParam>())
        EXPECT_NE(text.find(known), std::string::npos) << text << " lacks " << known;
    }
  }
}

template <class Problem>
void expect_refused(std::string_view name, double value, const std::string& words) {
  Problem problem;
  const auto before = parameter(problem, name);
  try {
    set_parameter(problem, name, value);
    FAIL() << "took " << value << " for " << name;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_EQ(parameter(problem, name), before);
  }
}

TEST(SetParameter, RefusesWhatTheEquationHasNoMeaningFor) {
  expect_refused<ThreeMassChain>("m1", -1, "three-dof: m1 must be positive, not -1");
  expect_refused<ThreeMassChain>("m3", 0, "three-dof: m3 must be positive, not 0");
  expect_refused<ImpactDuffing>("duration", -1, "impact: duration must not be negative, is -1");
  expect_refused<Duffing>("hardening", NAN, "duffing: hardening must be finite, not nan");
  expect_refused<DuffingChain>("masses", 2.5,
                               "duffing-chain: masses must be a whole number from 1 to 1000, not 2.5");
  expect_refused<DuffingChain>("masses", 1001,
                               "duffing-chain: masses must be a whole number from 1 to 1000, not 1001");
  ImpactDuffing none;
  set_parameter(none, "duration", 0);
  EXPECT_EQ(none.duration, 0);
}

TEST(StateNames, ArePositionsThenVelocities) {
  EXPECT_EQ(state_names<ThreeMassChain>(), (std::vector<std::string>{"x1", "x2", "x3", "v1", "v2", "v3"}));
  EXPECT_EQ(state_names<Duffing>(), (std::vector<std::string>{"x1", "v1"}));
  EXPECT_EQ(state_names<BlowUp>(), (std::vector<std::string>{"x1"}));
  EXPECT_EQ(state_names(DuffingChain{.masses = 2}), (std::vector<std::string>{"x1", "x2", "v1", "v2"}));
}

TEST(Defaults, AreThoseOfTheTables) {
  const Duffing free;
  EXPECT_EQ(free.natural_frequency, 1);
  EXPECT_EQ(free.hardening, 1);
  const ImpactDuffing impact;
  EXPECT_EQ(impact.slope, 2);
  EXPECT_EQ(impact.duration, 1);
  EXPECT_EQ(Duffing::final_time, 500);
  EXPECT_EQ(ImpactDuffing::final_time, 500);
  EXPECT_EQ(ThreeMassChain::final_time, 200);
  // Table 4.5: a row a letter.
  const ThreeMassChain chain;
  const double printed[] = {
      2, 1, 0.5, 0, 0.05, 0, 0, 2, 1, 0.5, 0, 0.2, 0, 0, 0, 0.2, 0.70710678118654752440};
  std::size_t i = 0;
  for (const auto name : parameter_names<ThreeMassChain>())
    EXPECT_EQ(parameter(chain, name), printed[i++]) << name;
}

// In extended precision the values are those of the table, not the doubles next to them.
TEST(Defaults, HaveAllDigitsInEveryPrecision) {
  const BasicThreeMassChain<Real> chain;
  const Real eps = std::numeric_limits<Real>::epsilon();
  EXPECT_LE(abs(chain.c2 - Real("0.05")), eps);
  EXPECT_LE(abs(chain.l1 - Real("0.2")), eps);
  EXPECT_LE(abs(chain.force - Real("0.2")), eps);
  EXPECT_LE(abs(chain.frequency * chain.frequency - Real("0.5")), 2 * eps);
}

}  // namespace
}  // namespace nlmech::problems::parameters_test
