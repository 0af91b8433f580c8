/// Spacecraft from TOML, and the words of the command line.
#include "chapters/gss_control/commands/spacecraft_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "chapters/gss_control/commands/words.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control::spacecraft_file_test {
namespace {

/// The complaint about a text, empty if there is none.
std::string complaint(const std::string& text) {
  try {
    static_cast<void>(parse_spacecraft(text, "craft.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  const std::string said = complaint(text);
  for (const std::string& word : words)
    EXPECT_NE(said.find(word), std::string::npos) << text << " -> " << said << " lacks " << word;
}

TEST(SpacecraftFile, EmptyIsTable31) {
  const auto p = parse_spacecraft("", "empty");
  EXPECT_EQ(p.hub_inertia, 8);
  EXPECT_EQ(p.mass_per_length, 0.0271875);
  EXPECT_EQ(p.youngs_modulus, 0.1584e10);
  EXPECT_EQ(p.length, 4);
  EXPECT_EQ(p.hub_radius, 1);
  EXPECT_EQ(p.second_moment, 0.47095e-7);
  EXPECT_EQ(p.tip_mass, 0.1569);
  EXPECT_EQ(p.tip_inertia, 0.0018);
}

TEST(SpacecraftFile, AllKeys) {
  const auto p = parse_spacecraft(
      "# a comment\nhub_inertia = 1\nmass_per_length = 2.5\nyoungs_modulus = 3e9\nlength = 4_0\n"
      "hub_radius = 0\nsecond_moment = 6e-8\ntip_mass = 0\ntip_inertia = 0.5\n",
      "all");
  EXPECT_EQ(p.hub_inertia, 1);
  EXPECT_EQ(p.mass_per_length, 2.5);
  EXPECT_EQ(p.youngs_modulus, 3e9);
  EXPECT_EQ(p.length, 40);
  EXPECT_EQ(p.hub_radius, 0);
  EXPECT_EQ(p.second_moment, 6e-8);
  EXPECT_EQ(p.tip_mass, 0);
  EXPECT_EQ(p.tip_inertia, 0.5);
}

TEST(SpacecraftFile, ComplaintsNameFileLineKeyAndValue) {
  expect_words("\n\nlenght = 5\n", {"craft.toml", "line 3", "lenght", "5", "hub_inertia"});
  expect_words("length = \"long\"\n", {"craft.toml", "line 1", "length", "long", "not a number"});
  expect_words("length = true\n", {"line 1", "length", "true", "not a number"});
  expect_words("length = [4]\n", {"line 1", "length", "4", "not a number"});
  expect_words("tip_mass = 0.1\nlength = nan\n", {"line 2", "length", "nan", "finite"});
  expect_words("length = inf\n", {"line 1", "length", "inf", "finite"});
  expect_words("length = -4\n", {"line 1", "length", "-4", "positive"});
  expect_words("length = 0\n", {"line 1", "length", "0", "positive"});
  expect_words("tip_mass = -0.1\n", {"line 1", "tip_mass", "-0.1", "negative"});
  expect_words("length = 4\nlength = 5\n", {"craft.toml", "line 2", "length"});
  expect_words("length = \n", {"craft.toml", "line 1"});
  expect_words("[craft]\nlength = 4\n", {"line 1", "craft"});
}

TEST(Words, Frequencies) {
  EXPECT_EQ(typed_frequencies("--omega", "0.1,1,-10"), (std::vector<double>{0.1, 1, -10}));
  const auto grid = typed_frequencies("--omega", "0.01:100:5");
  ASSERT_EQ(grid.size(), 5U);
  const std::vector<double> expected = {0.01, 0.1, 1, 10, 100};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(grid[i], expected[i], 1e-14 * expected[i]);
  EXPECT_EQ(grid.front(), 0.01);
  EXPECT_EQ(grid.back(), 100);
  for (const char* bad :
       {"", "1,", "a", "1,nan", "1:2", "1:2:3:4", "0:1:5", "2:1:5", "1:2:1", "1:2:1.5", "0", "inf"})
    EXPECT_THROW((void)typed_frequencies("--omega", bad), InputError) << bad;
}

TEST(Words, TimesEndWhereAsked) {
  EXPECT_EQ(typed_times(2, {}), (std::vector<double>{0, 2}));
  const auto times = typed_times(1, 0.3);
  ASSERT_EQ(times.size(), 5U);
  EXPECT_EQ(times[3], 3 * 0.3);
  EXPECT_EQ(times.back(), 1);
  EXPECT_EQ(typed_times(0.3, 0.1).size(), 4U);  // 3 x 0.1 is above 0.3 by a rounding
  EXPECT_THROW((void)typed_times(1, 1e-9), InputError);
}

TEST(Words, PlacesLieOnTheAppendage) {
  const auto craft = spacecraft::table_3_1();
  const auto places = typed_places("--at", "2,4.0", craft);
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[1].text, "4.0");
  EXPECT_EQ(places[1].x, 4);
  EXPECT_TRUE(typed_places("--at", "", craft).empty());
  EXPECT_THROW((void)typed_places("--at", "4.1", craft), InputError);
  EXPECT_THROW((void)typed_places("--at", "-1", craft), InputError);
}

TEST(Words, Loops) {
  const auto craft = spacecraft::table_3_1();
  EXPECT_EQ(typed_loop(craft, {12, 0, 16}).gains().k3, 16);
  const double nan = std::nan("");
  for (const std::vector<double>& bad :
       std::vector<std::vector<double>>{{12, 0}, {12, 0, 16, 1}, {12, -2, 16}, {-1, 0, 16}, {12, 0, nan}})
    EXPECT_THROW((void)typed_loop(craft, bad), InputError) << bad.size();
}

}  // namespace
}  // namespace nlmech::chapters::gss_control::spacecraft_file_test
