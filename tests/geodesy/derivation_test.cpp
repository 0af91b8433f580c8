#include "nlmech/geodesy/derivation.hpp"

#include <gtest/gtest.h>

namespace nlmech::geodesy::derivation_test {
namespace {

TEST(Derivation, GivesTheTabulatedSeries) {
  const SeriesTable derived = derive_series();
  for (std::size_t i = 0; i < derived.latitude.size(); ++i) {
    EXPECT_EQ(derived.latitude[i], corrected_series().latitude[i]) << "latitude, order " << i + 1;
    EXPECT_EQ(derived.height[i], corrected_series().height[i]) << "height, order " << i + 1;
  }
}

// Printed in Eqs 2.49 and 2.50: phi_1 = (b - h0)/(2R) S, h_2 = b (3b - h0)/(8R) S^2.
TEST(Derivation, FirstTermsAsPrinted) {
  const SeriesTable derived = derive_series();
  EXPECT_EQ(derived.latitude[0], (SeriesTerm{1, 2, {{{1, -1}}}}));
  EXPECT_EQ(derived.height[1], (SeriesTerm{1, 8, {{{3, -1}}}}));
}

}  // namespace
}  // namespace nlmech::geodesy::derivation_test
