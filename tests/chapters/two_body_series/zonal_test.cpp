/// The drawn orbits of `run zonal` are curves, also in a quick look.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::zonal_test {
namespace {

// Neighbouring points lie 15 degrees apart at most as seen from the Earth: a polygon with such sides leaves
// its circle by a hundredth of the radius, a line's width in the figure.
TEST(Zonal, DrawsNoCorners) {
  const tests::TemporaryFolder folder;
  const scene::Finished run = scene::run_program(
      {NLMECH_BINARY_DIR "/bin/two_body_series", "run", "zonal", "--quick", "--no-plots"}, folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  const auto rows =
      scene::parse_csv(tests::bytes_of(folder / "results/two_body_series/zonal.csv"), "zonal.csv");
  ASSERT_GT(rows.size(), 10U);
  const auto place = [&](std::size_t i, std::size_t j) { return std::stod(rows[i].cells.at(2 + j)); };
  double widest = 0;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    if (rows[i].cells[0] != rows[i + 1].cells[0]) continue;
    double dot = 0, a = 0, b = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      dot += place(i, j) * place(i + 1, j);
      a += place(i, j) * place(i, j);
      b += place(i + 1, j) * place(i + 1, j);
    }
    widest = std::max(widest, std::acos(std::min(1.0, dot / std::sqrt(a * b))));
  }
  EXPECT_LT(widest * 180 / std::acos(-1.0), 15);
}

}  // namespace
}  // namespace nlmech::zonal_test
