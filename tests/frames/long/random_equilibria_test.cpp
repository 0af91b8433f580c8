/// Ten thousand random toggles: for the nightly run.
#include "tests/frames/random_equilibria.hpp"

namespace nlmech::frames {
namespace {

TEST(Equilibria, OfTenThousandRandomToggles) { expect_equilibria_of_random_toggles(10'000, 2); }

}  // namespace
}  // namespace nlmech::frames
