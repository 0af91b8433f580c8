/// The chapter's own work as a user types it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::command_test {
namespace {

namespace fs = std::filesystem;
using scene::Finished;

class GeodesyCommand : public testing::Test {
 protected:
  GeodesyCommand() : folder_(fs::temp_directory_path() / ("nlmech-geodesy-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~GeodesyCommand() override { fs::remove_all(folder_); }

  /// Runs the program on a file with the given text.
  Finished geodesy(std::vector<std::string> arguments, const std::string& points) {
    scene::write_whole(folder_ / "points.csv", points);
    arguments.insert(arguments.begin(), NLMECH_BINARY_DIR "/bin/geodesy");
    arguments.emplace_back("points.csv");
    return scene::run_program(arguments, folder_);
  }
  static scene::NumberColumns numbers(const Finished& f, const std::vector<std::string>& names) {
    return scene::parse_numbers(f.output, "output", names);
  }
  fs::path folder_;
};

const std::vector<std::string> geodetic = {"latitude_deg", "longitude_deg", "height_m"};
const std::vector<std::string> cartesian = {"x", "y", "z"};

// There and back through the two commands, with a position near Stuttgart.
TEST_F(GeodesyCommand, ReverseOfKnownPoint) {
  const Finished f = geodesy({"reverse", "--method", "series", "--order", "6"},
                             "x,y,z\n3912960.8375,1424201.2720,4816553.5940\n");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_TRUE(f.errors.empty()) << f.errors;
  EXPECT_TRUE(f.output.starts_with("latitude_deg,longitude_deg,height_m\n"));
  const auto back = geodesy({"forward"}, f.output);
  const auto xyz = numbers(back, cartesian);
  EXPECT_NEAR(xyz.column[0][0], 3912960.8375, 2e-9);
  EXPECT_NEAR(xyz.column[1][0], 1424201.2720, 2e-9);
  EXPECT_NEAR(xyz.column[2][0], 4816553.5940, 2e-9);
}

TEST_F(GeodesyCommand, ForwardThenReverseByDefaultOrder) {
  const std::string points =
      "latitude_deg,longitude_deg,height_m\n45.5,-120.25,400000\n-89.5,179.75,35000000\n0,0,200000\n";
  const Finished there = geodesy({"forward"}, points);
  ASSERT_EQ(there.exit_code, 0) << there.errors;
  const Finished back = geodesy({"reverse", "--method", "series"}, there.output);
  ASSERT_EQ(back.exit_code, 0) << back.errors;
  const auto given = scene::parse_numbers(points, "given", geodetic), found = numbers(back, geodetic);
  ASSERT_EQ(found.rows(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.column[0][i], given.column[0][i], 2.5e-11);  // order 4: the header's statement
    EXPECT_NEAR(found.column[1][i], given.column[1][i], 1e-12);
    EXPECT_NEAR(found.column[2][i], given.column[2][i], 8.1e-7);
  }
}

TEST_F(GeodesyCommand, PolesAndAntimeridian) {
  const Finished f = geodesy({"reverse"}, "0,0,6400000\n0,0,-6400000\n-7000000,0,0\n-7000000,-0.0,-0.0\n");
  ASSERT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(f.output.find("\n90,0,"), std::string::npos) << f.output;
  EXPECT_NE(f.output.find("\n-90,0,"), std::string::npos) << f.output;
  EXPECT_NE(f.output.find("\n0,180,"), std::string::npos) << f.output;
  EXPECT_NE(f.output.find("\n-0,-180,"), std::string::npos) << f.output;
}

TEST_F(GeodesyCommand, OtherEllipsoids) {
  for (const std::string ellipsoid : {"6378137,0.0033528106647474805", "6378137,1/298.257223563", "wgs84"}) {
    const Finished f = geodesy({"reverse", "--ellipsoid", ellipsoid}, "4e6,3e6,5e6\n");
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    EXPECT_NEAR(numbers(f, geodetic).column[1][0], std::atan2(3, 4) * 180 / std::numbers::pi, 1e-13);
  }
  const Finished sphere = geodesy({"reverse", "--ellipsoid", "1000,0"}, "3000,0,4000\n");
  EXPECT_EQ(numbers(sphere, geodetic).column[2][0], 4000);
  const Finished prolate = geodesy({"reverse", "--ellipsoid", "1000,-0.01"}, "3000,0,4000\n");
  EXPECT_EQ(prolate.exit_code, 0) << prolate.errors;
}

struct Bad {
  std::vector<std::string> arguments;
  std::string points;
  std::vector<std::string> says;
};

// Exit code 2, nothing on standard output, and a message that names file, line, column and text.
TEST_F(GeodesyCommand, BadInputIsNamed) {
  const std::vector<Bad> cases = {
      {{"reverse"}, "x,y,z\n1,2,3\n4,5six,6\n", {"points.csv", "line 3", "column 2", "y", "5six"}},
      {{"reverse"}, "7e6,0,nan\n", {"points.csv", "line 1", "column 3", "nan"}},
      {{"reverse"}, "7e6,inf,0\n", {"line 1", "column 2", "inf"}},
      {{"reverse"}, "7e6,0,1e999\n", {"line 1", "column 3", "1e999"}},
      {{"reverse"}, "7e6,0,0x10\n", {"line 1", "column 3", "0x10"}},
      {{"reverse"}, "7e6,,0\n", {"line 1", "column 2"}},
      {{"reverse"}, "7e6,0\n", {"line 1", "2 of 3 cells"}},
      {{"reverse"}, "\n\n7e6,0,0,1\n", {"line 3", "column 4"}},
      {{"forward"}, "91,0,0\n", {"line 1", "column 1", "latitude_deg", "91"}},
      {{"reverse", "--ellipsoid", "6378137"}, "1,2,3\n", {"--ellipsoid", "6378137", "comma"}},
      {{"reverse", "--ellipsoid", "-1,0"}, "1,2,3\n", {"--ellipsoid", "-1"}},
      {{"reverse", "--ellipsoid", "1,1"}, "1,2,3\n", {"--ellipsoid", "flattening"}},
      {{"reverse", "--ellipsoid", "1,1/0"}, "1,2,3\n", {"--ellipsoid"}},
      {{"reverse", "--order", "7"}, "1,2,3\n", {"--order", "7"}},
      {{"reverse", "--method", "magic"}, "1,2,3\n", {"--method", "magic"}},
      {{"reverse", "--order", "5"},
       "1,2,3\n",
       {"--order", "--method series"}},  // they mean nothing to the fast method
      {{"reverse", "--method", "fast", "--height", "series"}, "1,2,3\n", {"--height", "--method series"}},
      {{"reverse", "--ellipsoid", "1,-1e150"}, "1,2,3\n", {"--ellipsoid 1,-1e150", "1e100"}},
  };
  for (const Bad& bad : cases) {
    const Finished f = geodesy(bad.arguments, bad.points);
    EXPECT_EQ(f.exit_code, 2) << bad.points << f.errors;
    EXPECT_TRUE(f.output.empty()) << f.output;
    for (const std::string& word : bad.says) {
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
    }
  }
}

TEST_F(GeodesyCommand, MissingFileIsNamed) {
  const Finished f =
      scene::run_program({NLMECH_BINARY_DIR "/bin/geodesy", "reverse", "nowhere.csv"}, folder_);
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_NE(f.errors.find("nowhere.csv"), std::string::npos) << f.errors;
}

// A point where the series has no digit: exit code 1, a sentence with method, line and place, and no output
// at all.
TEST_F(GeodesyCommand, CentreFailsWithASentence) {
  const Finished f = geodesy({"reverse", "--method", "series"}, "7000000,0,0\n1000,0,1000\n");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_TRUE(f.output.empty()) << f.output;
  for (const std::string word : {"outside_validity", "line 2", "series of order 4", "1000"}) {
    EXPECT_NE(f.errors.find(word), std::string::npos) << f.errors;
  }
}

TEST_F(GeodesyCommand, EmptyInputGivesTheHeaderAlone) {
  const Finished f = geodesy({"reverse"}, "");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_EQ(f.output, "latitude_deg,longitude_deg,height_m\n");
}

TEST_F(GeodesyCommand, StrongFlatteningWarnsOfItsMiss) {
  const Finished f =
      geodesy({"reverse", "--method", "series", "--ellipsoid", "6378137,0.1"}, "5e6,0,4.2e6\n");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_NE(f.errors.find("misses the point of line 1"), std::string::npos) << f.errors;
}

}  // namespace
}  // namespace nlmech::command_test
