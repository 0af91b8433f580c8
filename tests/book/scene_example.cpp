/// Worked example of the API reference: a scene of one result.
#include <gtest/gtest.h>

// [example]
#include <cmath>
#include <vector>

#include "nlmech/scene/scene.hpp"

// How fast the partial sums of 1/1^2 + 1/2^2 + ... approach pi^2/6.
struct Sum {
  int terms;
  double value;
  double remainder() const { return std::acos(-1.0) * std::acos(-1.0) / 6 - value; }
};

std::vector<Sum> partial_sums(bool quick) {
  std::vector<Sum> sums;
  double sum = 0;
  for (int k = 1; k <= (quick ? 100 : 1000); ++k) sums.push_back({k, sum += 1.0 / k / k});
  return sums;
}

void show_remainder(const std::vector<Sum>& sums, nlmech::scene::Show& show) {
  show.plot("The remainder falls as the reciprocal of the terms", "terms", "remainder")
      .log_x(1, 1000)
      .log_y(1e-3, 1)
      .curve("", sums, &Sum::terms, &Sum::remainder);
  show.table(std::vector{sums.front(), sums.back()}, {{"terms", &Sum::terms}, {"sum", &Sum::value, 8}});
  show.at_most("remainder times terms", sums.back().remainder() * sums.back().terms, 1,
               "the integral of 1/x^2 bounds the rest");
}

std::vector<nlmech::scene::Scene> basel() {
  const nlmech::scene::Result sums("partial-sums", "as Euler states it", partial_sums);
  return {{.name = "remainder",
           .title = "What the partial sums miss",
           .content = nlmech::scene::Content(show_remainder, sums)}};
}
// [example]

namespace {

TEST(Example, Scene) {
  using namespace nlmech::scene;
  const Chapter chapter("basel", "The sum of the reciprocal squares", {basel()});
  Results results(true);
  const Performance performance = perform(chapter.scene("remainder"), results);
  ASSERT_EQ(performance.showing.quantities.size(), 1u);
  const Quantity& quantity = performance.showing.quantities[0];
  EXPECT_TRUE(quantity.passes());
  // The rest after n terms is 1/n - 1/(2 n^2) + ... (Euler-Maclaurin), here for n = 100, next term 1/(6 n^3).
  EXPECT_NEAR(quantity.value, 1 - 1 / 200.0, 1 / 6e4);
  ASSERT_TRUE(performance.showing.table.has_value());
  EXPECT_EQ(performance.showing.table->rows().size(), 2u);
  EXPECT_EQ(performance.showing.figure->data.rows().size(), 100u);
}

}  // namespace
