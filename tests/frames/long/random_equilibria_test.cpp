/// Ten thousand random toggles, for the nightly tests.
#include "tests/frames/random_equilibria.hpp"

namespace nlmech::frames::random_equilibria_test {
namespace {

TEST(Equilibria, OfTenThousandRandomToggles) { expect_equilibria_of_random_toggles(10'000, 2); }

}  // namespace
}  // namespace nlmech::frames::random_equilibria_test
