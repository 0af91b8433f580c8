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

const std::vector<std::string> geodetic = {"latitude_deg", "longitude_deg", "height_m|height"};
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
      {{"reverse"}, "7e6,0\n", {"line 1", "'7e6,0'", "must name x,y,z"}},
      {{"reverse"}, "7e6,0,1\n7e6,0\n", {"line 2", "2 of 3 cells"}},
      {{"reverse"}, "", {"points.csv: is empty"}},
      {{"reverse"}, "\n\n7e6,0,0,1\n", {"line 3", "'7e6,0,0,1'", "must name x,y,z"}},
      {{"forward"}, "B,L,h\n1,2,3\n", {"line 1", "B,L,h", "must name latitude_deg,longitude_deg,height_m"}},
      {{"forward"}, "90.0000001,0,0\n", {"line 1", "latitude_deg = 90.0000001"}},
      {{"reverse", "--ellipsoid", "6378137"}, "1,2,3\n", {"--ellipsoid", "6378137", "comma", "grs80"}},
      {{"reverse", "--ellipsoid", "6378137,298.257"}, "1,2,3\n", {"--ellipsoid", "1/298.257"}},
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

TEST_F(GeodesyCommand, NoRowsAreSaid) {
  const Finished f = geodesy({"reverse"}, "x,y,z\n");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  EXPECT_EQ(f.output, "latitude_deg,longitude_deg,height_m\n");
  EXPECT_NE(f.errors.find("points.csv: no row stands behind the header"), std::string::npos) << f.errors;
}

// A column of names or times goes on to the answer, there and back.
TEST_F(GeodesyCommand, OtherColumnsAreHandedOn) {
  const Finished there = geodesy({"forward"}, "t,LAT,x,Lon,h\n0.5,30,\"a, b\",60,100\n");
  ASSERT_EQ(there.exit_code, 0) << there.errors;
  EXPECT_TRUE(there.output.starts_with("x,y,z,t,input_x\n")) << there.output;
  const Finished back = geodesy({"reverse"}, there.output);
  const auto records = scene::parse_csv(back.output, "output");
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].cells,
            (std::vector<std::string>{"latitude_deg", "longitude_deg", "height_m", "t", "input_x"}));
  EXPECT_NEAR(std::stod(records[1].cells[0]), 30, 2e-14);
  EXPECT_EQ(records[1].cells[3], "0.5");
  EXPECT_EQ(records[1].cells[4], "a, b");
}

TEST_F(GeodesyCommand, DegreesAreExactAtRightAngles) {
  const Finished f = geodesy({"forward"}, "90,57.3,0\n-90,0,0\n0,90,0\n0,180,0\n");
  const auto p = numbers(f, cartesian).column;
  const double b = 6356752.3142451793;  // polar radius of WGS84 to the last digit of a double
  EXPECT_EQ(p[0], (std::vector<double>{0, 0, 0, -6378137}));
  EXPECT_EQ(p[1], (std::vector<double>{0, 0, 6378137, 0}));
  EXPECT_NEAR(p[2][0], b, 1e-9);  // a unit in the last place
  EXPECT_NEAR(p[2][1], -b, 1e-9);
}

// What the series is off by is told in degrees and in parts of the ellipsoid, whatever its unit.
TEST_F(GeodesyCommand, SeriesTellsItsErrorInAnyUnit) {
  const auto said = [&](const std::string& ellipsoid, const std::string& order, const std::string& points) {
    const Finished f =
        geodesy({"reverse", "--method", "series", "--order", order, "--ellipsoid", ellipsoid}, points);
    EXPECT_EQ(f.exit_code, 0) << f.errors;
    return f.errors;
  };
  EXPECT_NE(said("6378137,0.1", "4", "5e6,0,4.2e6\n").find("at line 1 the series of order 4 is off by"),
            std::string::npos);
  for (const std::string unit : {"", "e-3", "e-30", "e30"}) {
    const std::string wgs84 = "6378137" + unit + ",1/298.257223563",
                      deep = "100000" + unit + ",0,100000" + unit + "\n";
    EXPECT_NE(said(wgs84, "4", deep).find("off by 0.028 degrees"), std::string::npos) << unit;
    EXPECT_EQ(said(wgs84, "4", "4000000" + unit + ",0,5000000" + unit + "\n"), "") << unit;
  }
  // 34.52125 by bisection in 50 digits; the series gives 34.890.
  EXPECT_NE(said("1,0.5", "6", "1,0,0.2\n").find("off by 0.37 degrees"), std::string::npos);
  // 39.26971; the series gives 40.067, which is no digit.
  for (const std::string point : {"1,0,0.25\n", "0.5,0,0\n"}) {
    const Finished f =
        geodesy({"reverse", "--method", "series", "--order", "6", "--ellipsoid", "1,0.5"}, point);
    EXPECT_EQ(f.exit_code, 1) << f.errors;
    EXPECT_NE(f.errors.find("does not hold"), std::string::npos) << f.errors;
  }
}

// Values of the EPSG registry: polar radii by hand, a (1 - f).
TEST_F(GeodesyCommand, EllipsoidsByName) {
  const std::vector<std::pair<std::string, double>> polar = {{"WGS 84", 6356752.314245},
                                                             {"GRS80", 6356752.314140},
                                                             {"wgs72", 6356750.520016},
                                                             {"Bessel-1841", 6356078.962818},
                                                             {"clarke1866", 6356583.8},
                                                             {"SPHERE", 6371000},
                                                             {"international1924", 6356911.946128},
                                                             {"krassowsky1940", 6356863.018773},
                                                             {"airy1830", 6356256.909237}};
  for (const auto& [name, b] : polar) {
    const Finished f = geodesy({"reverse", "--ellipsoid", name}, "0,0,7e6\n");
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    EXPECT_NEAR(numbers(f, geodetic).column[2][0], 7e6 - b, 1e-6) << name;  // the digits that stand here
  }
}

// The unit of A,F is the user's.
TEST_F(GeodesyCommand, NoMetresWithoutAName) {
  const Finished f = geodesy({"reverse", "--ellipsoid", "6378.137,1/298.257223563"}, "7000,0,0\n");
  EXPECT_TRUE(f.output.starts_with("latitude_deg,longitude_deg,height\n")) << f.output;
  EXPECT_EQ(geodesy({"forward", "--ellipsoid", "6378.137,1/298.257223563"}, f.output).output,
            "x,y,z\n7000,0,0\n");
}

TEST_F(GeodesyCommand, DepthAtWhichAnotherPointIsNearer) {
  const Finished fine = geodesy({"forward"}, "45,10,-6.3e6\n0,0,-6335439\n");  // a (1 - e^2) = 6335439.327
  EXPECT_EQ(fine.errors, "");
  const Finished deep = geodesy({"forward"}, "45,10,-6.3e6\n0,0,-6335440\n");
  EXPECT_EQ(deep.exit_code, 0);
  EXPECT_NE(deep.errors.find("line 2 is so deep"), std::string::npos) << deep.errors;
}

}  // namespace
}  // namespace nlmech::command_test
