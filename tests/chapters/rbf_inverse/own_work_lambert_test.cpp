/// `rbf_inverse lambert` as a user types it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_lambert_test {
namespace {

using scene::Finished;

/// Runs `rbf_inverse lambert` with words separated by blanks.
Finished run(const std::string& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/rbf_inverse", "lambert"};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    if (end > begin) arguments.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return scene::run_program(arguments, {});
}

/// vx0, vy0, vz0, vx1, vy1, vz1, miss; empty if it failed.
std::vector<double> lambert(const std::string& words) {
  const Finished f = run(words);
  EXPECT_EQ(f.exit_code, 0) << words << ": " << f.errors;
  EXPECT_TRUE(f.output.starts_with("vx0,vy0,vz0,vx1,vy1,vz1,miss\n")) << f.output;
  const auto rows = scene::parse_csv(f.output, "output");
  if (rows.size() != 2 || rows[1].cells.size() != 7) return {};
  std::vector<double> values(7);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_TRUE(scene::parse_number(rows[1].cells[i], values[i]));
  return values;
}

const std::string printed =
    "--from 2.87e6,5.19e6,2.85e6 --to 2.09e6,7.82e6,0 --time 4320 --mu 3.986e14";  // Eq. 5.38

void expect_first_velocity(const std::vector<double>& v, double x, double y, double z, double relative) {
  ASSERT_EQ(v.size(), 7U);
  const double size = std::hypot(x, y, z);
  EXPECT_LE(std::hypot(v[0] - x, v[1] - y, v[2] - z), relative * size);
}

// Twelve digits are asked for. oracle: rbf_inverse_lambert * v? *
TEST(LambertCommand, FourArcs) {
  const std::vector<double> v = lambert(printed);
  expect_first_velocity(v, 2774.8469906025419, 7217.0230343355381, 1625.9338905977957, 1e-12);
  EXPECT_LE(std::hypot(v[3] + 2318.4424849316679, v[4] + 5654.9378013635604, v[5] + 1551.1405058380721),
            1e-8);
  EXPECT_LE(v[6], 1e-6);  // metres; kappa eps |r_F|
  expect_first_velocity(lambert(printed + " --long-way"), 379.08733111425277, -6412.7242128557479,
                        4022.4995147088824, 1e-12);
  expect_first_velocity(lambert(printed + " --revolutions 1 --branch low"), 859.19746644544969,
                        5762.5154049445841, -1308.6492307790138, 1e-12);
  expect_first_velocity(lambert(printed + " --revolutions 1 --branch high"), 251.20764442960278,
                        5875.649037480232, -2535.2602744279162, 1e-12);
}

// One mu for all commands of the suite, that of WGS 84.
TEST(LambertCommand, TheEarthIsTheDefault) {
  const std::string words = "--from 2.87e6,5.19e6,2.85e6 --to 2.09e6,7.82e6,0 --time 4320";
  EXPECT_EQ(lambert(words), lambert(words + " --mu 3.986004418e14"));
  EXPECT_NE(lambert(words), lambert(words + " --mu 3.986e14"));
}

// Through the centre in three seconds: collocation misses by 36 km, which its own equations do not see.
TEST(LambertCommand, AMissIsAFailure) {
  const std::string through = "--from 7e6,0,0 --to -6.9999e6,1e3,0 --time 3 --mu 3.986e14";
  const Finished f = run(through + " --method collocation");
  EXPECT_EQ(f.exit_code, 1) << f.output;
  EXPECT_EQ(f.output, "");
  EXPECT_NE(f.errors.find("--method izzo"), std::string::npos) << f.errors;
  const std::vector<double> v = lambert(through);
  ASSERT_EQ(v.size(), 7U);
  EXPECT_LE(v[6], 1e-6);
}

TEST(LambertCommand, CollocationIsBetterThanAMillimetre) {
  const std::vector<double> v = lambert(printed + " --method collocation");
  expect_first_velocity(v, 2774.8469906025419, 7217.0230343355381, 1625.9338905977957, 1e-11);
  EXPECT_LE(v[6], 1e-3);
}

// J2 moves the end of the conic by kilometres; the corrected arc meets it. Both methods know the field.
TEST(LambertCommand, OblatenessIsCorrectedFor) {
  const std::string field = " --zonal 1.08262668e-3 --radius 6378137";
  const std::vector<double> a = lambert(printed + field),
                            b = lambert(printed + field + " --method collocation");
  ASSERT_EQ(a.size(), 7U);
  ASSERT_EQ(b.size(), 7U);
  EXPECT_LE(a[6], 1e-4);
  EXPECT_LE(b[6], 1e-3);
  EXPECT_LE(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 1e-6);
  EXPECT_GE(std::abs(a[0] - 2774.8469906025419), 0.1);
}

// Half of a circle, in the plane that is asked for: unit speed.
TEST(LambertCommand, OppositePositionsWithAPlane) {
  const std::string half = "--from 1,0,0 --to -1,0,0 --time 3.141592653589793 --mu 1";
  const std::vector<double> v = lambert(half + " --plane 0,-2,0");
  ASSERT_EQ(v.size(), 7U);
  EXPECT_LE(std::hypot(v[0], v[1], v[2] - 1), 1e-14);  // cross(normal, r): along z; some roundings
  const Finished f = run(half);
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_NE(f.errors.find("180 degrees"), std::string::npos) << f.errors;
}

TEST(LambertCommand, WrongWordsAreNamed) {
  const auto expect = [](const std::string& words, const std::string& named, int code = 2) {
    const Finished f = run(words);
    EXPECT_EQ(f.exit_code, code) << words;
    EXPECT_TRUE(f.output.empty()) << words;
    EXPECT_NE(f.errors.find(named), std::string::npos) << words << ": " << f.errors;
  };
  expect("--to 1,2,3 --time 1", "--from");
  expect("--from 1,2 --to 1,2,3 --time 1", "--from 1,2");
  expect("--from 1,2,x --to 1,2,3 --time 1", "'x'");
  expect("--from 1,2,nan --to 1,2,3 --time 1", "'nan'");
  expect("--from 0,0,0 --to 1,2,3 --time 1", "--from 0,0,0");
  expect("--from 1,2,3 --to 0,0,0 --time 1", "--to 0,0,0");
  expect("--from 1,0,0 --to 0,1,0 --time -1", "--time -1");
  expect("--from 1,0,0 --to 0,1,0 --time 0", "--time 0");
  expect("--from 1,0,0 --to 0,1,0 --time nan", "--time nan");
  expect("--from 1,0,0 --to 0,1,0 --time 1 --mu 0", "--mu 0");
  expect("--from 1,0,0 --to 2,0,0 --time 1 --mu 1", "0 or 360 degrees");
  expect("--from 1,0,0 --to 0,1,0 --time 1e-200 --mu 1", "--time 1e-200");
  expect(printed + " --revolutions 1", "--revolutions 1");
  expect(printed + " --revolutions -1 --branch low", "--revolutions -1");
  expect(printed + " --revolutions 1.5 --branch low", "--revolutions 1.5");
  expect(printed + " --branch low", "--branch low");
  expect(printed + " --revolutions 1 --branch middle", "--branch middle");
  expect(printed + " --plane 0,0,0", "--plane 0,0,0");
  expect(printed + " --plane 0,0,1", "--plane 0,0,1");  // the positions determine the plane
  expect(printed + " --zonal 1e-3", "--zonal 0.001");
  expect(printed + " --radius 6e6", "--radius 6000000");
  expect(printed + " --zonal 1e-3 --radius -1", "--radius -1");
  expect(printed + " --method shooting", "--method shooting");
  expect(printed + " --method collocation --long-way", "--long-way");
  expect(printed + " --method collocation --revolutions 1 --branch low", "--revolutions 1");
  // Not a mistake of the user, but no arc either: two revolutions take longer.
  expect(printed + " --revolutions 2 --branch low", "infeasible", 1);
}

}  // namespace
}  // namespace nlmech::own_work_lambert_test
