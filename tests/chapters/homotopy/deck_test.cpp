/// The deck of reference values for frames: the tracked file against both routes computed anew.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "tests/places.hpp"
#include "tools/frame_deck/deck.hpp"

namespace nlmech::frame_deck::deck_test {
namespace {

using Rows = std::vector<scene::CsvRecord>;

Rows file() {
  const std::string path = NLMECH_SOURCE_DIR "/tables/frames/deck.csv";
  return scene::parse_csv(scene::read_whole(path), path);
}

double number(const std::string& text) {
  double value = NAN;
  EXPECT_TRUE(scene::parse_number(text, value)) << text;
  return value;
}

std::string cell(const Rows& all, std::size_t row, const std::string& column) {
  for (std::size_t i = 0; i < all[0].cells.size(); ++i) {
    if (all[0].cells[i] == column) return all[row].cells[i];
  }
  ADD_FAILURE() << "no column " << column;
  return {};
}

// Half a unit of the last digit printed. The routes themselves are held to each other by `digits`.
TEST(FrameDeck, IsWhatBothRoutesGive) {
  const Rows kept = file();
  const std::vector<Row> all = rows();
  ASSERT_EQ(kept.size(), all.size() + 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string what = all[i].frame + ", " + all[i].quantity;
    EXPECT_EQ(cell(kept, i + 1, "frame"), all[i].frame);
    EXPECT_EQ(cell(kept, i + 1, "quantity"), all[i].quantity);
    const Made made = make(all[i]);
    const double load = number(cell(kept, i + 1, "load_factor")),
                 digits = number(cell(kept, i + 1, "digits"));
    EXPECT_NEAR(load / static_cast<double>(made.load), 1, std::pow(10, 1 - digits)) << what;
    EXPECT_NEAR(load / static_cast<double>(made.elements), 1, std::pow(10, 1 - digits)) << what;
    EXPECT_GE(digits, 10) << what;
    // What rounding leaves of agreement beyond twelve digits differs between machines.
    EXPECT_GE(made.digits, digits - 1) << what;
  }
}

// Half as many steps again change nothing: eighth order, and extended precision.
TEST(FrameDeck, TheElasticaIsExact) {
  for (const Row& row : rows()) {
    const bool is_taken = row.frame == "toggle" || row.frame == "lee" || row.frame == "deep-arch";
    if (row.quantity != "first maximum" || !is_taken) continue;
    const auto coarse = row.independent(60), fine = row.independent(90);
    ASSERT_TRUE(coarse && fine) << row.frame;
    EXPECT_NEAR(static_cast<double>(*coarse / *fine), 1, 1e-13) << row.frame << ", " << row.quantity;
  }
}

// oracle: homotopy_elastica elastica 0.44 maximum, elastica 0.44 minimum
TEST(FrameDeck, AgreesWithTheOracleOfTheToggle) {
  const Rows kept = file();
  EXPECT_EQ(cell(kept, 1, "quantity"), "first maximum");
  EXPECT_NEAR(number(cell(kept, 1, "load_factor")), 42.4397755886, 1e-9);
  EXPECT_NEAR(number(cell(kept, 2, "load_factor")), 32.1221640887, 1e-9);
}

}  // namespace
}  // namespace nlmech::frame_deck::deck_test
