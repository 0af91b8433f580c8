/// Worked example of the API reference: a chapter with one run and one scene.
#include <gtest/gtest.h>

// [example]
#include <cmath>

#include "nlmech/scene/scene.hpp"

// How fast the partial sums of 1/1^2 + 1/2^2 + ... approach pi^2/6.
nlmech::scene::Chapter basel() {
  using namespace nlmech::scene;
  Chapter chapter("basel", "The sum of the reciprocal squares");
  const auto& sums =
      chapter.add_run<std::vector<double>>("partial-sums", "as Euler states it", {}, [](Workshop& workshop) {
        std::vector<double> sum = {0};
        for (int k = 1; k <= (workshop.quick() ? 100 : 1000); ++k) sum.push_back(sum.back() + 1.0 / k / k);
        return sum;
      });
  chapter.add({.name = "remainder",
               .title = "What the partial sums miss",
               .place = "our own",
               .needs = {&sums},
               .show = [&sums](Workshop& workshop) {
                 const std::vector<double>& sum = workshop.result(sums);
                 Table table({{"terms"}, {"sum", 8}});
                 for (std::size_t k = 1; k < sum.size(); k *= 10) {
                   table.add({static_cast<std::int64_t>(k), sum[k]});
                 }
                 const double limit = std::acos(-1.0) * std::acos(-1.0) / 6;
                 const auto terms = static_cast<double>(sum.size() - 1);
                 return Showing{
                     .figure = {},
                     .table = table,
                     .quantities = {at_most("remainder times terms", "1", (limit - sum.back()) * terms, 1,
                                            "the integral of 1/x^2 bounds the rest")}};
               }});
  return chapter;
}
// The program of a chapter is `return chapter_main(basel(), ...)`: see chapters/geodesy/main.cpp.
// [example]

namespace {

TEST(Example, Scene) {
  using namespace nlmech::scene;
  const Chapter chapter = basel();
  Workshop workshop(true);
  const Performance performance = perform(chapter.scene("remainder"), workshop);
  ASSERT_EQ(performance.showing.quantities.size(), 1u);
  const Quantity& quantity = performance.showing.quantities[0];
  EXPECT_TRUE(quantity.kept());
  // The rest after n terms is 1/n - 1/(2 n^2) + ... (Euler-Maclaurin), here for n = 100, next term 1/(6 n^3).
  EXPECT_NEAR(quantity.value, 1 - 1 / 200.0, 1 / 6e4);
  ASSERT_TRUE(performance.showing.table.has_value());
  EXPECT_EQ(performance.showing.table->rows().size(), 3u);
}

}  // namespace
