/// The commands of `gss_control` on Table 3.1, against numbers of tools/oracles.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "nlmech/scene/program/files.hpp"
#include "tests/chapters/gss_control/program.hpp"

namespace nlmech::own_work_test {
namespace {

using tests::Rows;
using tests::rows_of;

void expect_points(const Rows& rows, const std::vector<std::array<double, 2>>& known, double relative) {
  EXPECT_EQ(rows.header, "index,real,imag");
  ASSERT_GE(rows.row.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double size = std::hypot(known[i][0], known[i][1]);
    EXPECT_EQ(rows.row[i][0], static_cast<double>(i + 1));
    EXPECT_NEAR(rows.row[i][1], known[i][0], relative * size) << i;
    EXPECT_NEAR(rows.row[i][2], known[i][1], relative * size) << i;
  }
}

// All 13 digits. oracle: gss_control_plant tip pole 1, tip pole 2, tip pole 3, tip pole 4
TEST(PolesCommand, OpenLoop) {
  const Rows rows = rows_of("poles");
  EXPECT_EQ(rows.row.size(), 10U);
  expect_points(rows, {{0, 6.452959965749}, {0, 52.08177896598}, {0, 156.1145680847}, {0, 297.5963940072}},
                1e-12);
  EXPECT_EQ(rows_of("poles --count 3").row.size(), 3U);
}

// oracle: gss_control_loop designed pole 1 *, designed pole 2 *, designed pole 3 *, designed pole 4 *
TEST(PolesCommand, ClosedLoop) {
  const Rows rows = rows_of("poles --gains 12,0,16 --count 8");
  EXPECT_EQ(rows.row.size(), 8U);
  expect_points(rows,
                {{-0.435108439861, 0.689954756969},
                 {-0.527468041156, 6.42057934175},
                 {-0.0259638869961, 52.0811790701},
                 {-0.00505426852263, 156.114528064}},
                3e-12);
}

// oracle: gss_control_plant tip locked 1, tip locked 2, tip locked 3, tip first zero of *
TEST(ZerosCommand, HubAndDeflection) {
  expect_points(rows_of("zeros"), {{0, 4.372658473946}, {0, 51.39836909583}, {0, 155.7182855807}}, 1e-12);
  expect_points(rows_of("zeros --at 2 --count 2"), {{0, 37.81075762923}}, 1e-12);
  expect_points(rows_of("zeros --at 4 --count 3"), {{0, 52.45443464444}}, 1e-12);
  // Feedback moves no zero.
  EXPECT_EQ(rows_of("zeros --gains 1,1,1").row, rows_of("zeros").row);
}

// oracle: gss_control_plant tip * at 0.1, tip * at 1, tip * at 10
TEST(ResponseCommand, OpenLoop) {
  const Rows rows = rows_of("response --omega 0.1,1,10 --at 2,4.0");
  EXPECT_EQ(rows.header, "omega,theta_re,theta_im,y@2_re,y@2_im,y@4.0_re,y@4.0_im");
  ASSERT_EQ(rows.row.size(), 3U);
  const std::vector<std::array<double, 4>> known = {
      {0.1, -5.52448854758618, -0.00475612847846067, -0.0149467556104467},
      {1, -0.0536584284810462, -0.00487037747371546, -0.0153109262016674},
      {10, -0.00166615919715115, 0.00327536292807089, 0.0106674410862429}};
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(rows.row[i][0], known[i][0]);
    for (std::size_t k = 1; k < 4; ++k) {
      EXPECT_NEAR(rows.row[i][2 * k - 1] / known[i][k], 1, 1e-13) << i << ' ' << k;
      EXPECT_LT(std::abs(rows.row[i][2 * k]), 1e-13 * std::abs(known[i][k])) << i << ' ' << k;
    }
  }
}

TEST(ResponseCommand, ClosedLoopAndGrid) {
  const Rows rows = rows_of("response --omega 1e-8:1e8:33 --gains 12,0,16 --at 2");
  EXPECT_EQ(rows.header, "omega,theta_re,theta_im,y@2_re,y@2_im");
  ASSERT_EQ(rows.row.size(), 33U);
  EXPECT_EQ(rows.row.front()[0], 1e-8);
  EXPECT_EQ(rows.row.back()[0], 1e8);
  EXPECT_NEAR(rows.row.front()[1], 1, 1e-14);  // theta = theta_f at rest
  for (const auto& row : rows.row) {
    for (const double value : row) EXPECT_TRUE(std::isfinite(value));
  }
  // Near the maximum. oracle: gss_control_loop designed resonance, designed resonance at
  const Rows peak = rows_of("response --omega 0.5256 --gains 12,0,16");
  EXPECT_NEAR(std::hypot(peak.row[0][1], peak.row[0][2]), 1.099208, 1e-6);
}

// Extremes, and rest at the start. oracle: gss_control_loop designed largest angle, designed least deflection
TEST(StepCommand, Manoeuvre) {
  const Rows rows = rows_of("step --gains 12,0,16 --final-angle 1 --until 5 --every 0.5 --at 2");
  EXPECT_EQ(rows.header, "t,theta,theta_dot,y@2,ydot@2");
  ASSERT_EQ(rows.row.size(), 11U);
  EXPECT_EQ(rows.row.back()[0], 5);
  EXPECT_NEAR(rows.row[0][1], 0, 1e-8);
  EXPECT_NEAR(rows.row[0][3], 0, 1e-7);
  const Rows peak = rows_of("step --gains 12,0,16 --until 4.508 --at 2");
  ASSERT_EQ(peak.row.size(), 2U);
  EXPECT_EQ(peak.row[1][0], 4.508);
  EXPECT_NEAR(peak.row[1][1], 1.136136789, 3e-9);  // ten digits, and the time rounded
  const Rows bend = rows_of("step --gains 12,0,16 --until 0.4315 --at 2");
  EXPECT_NEAR(bend.row[1][3], -0.08167668, 3e-8);
  // Linear in the angle.
  const Rows half = rows_of("step --gains 12,0,16 --final-angle 0.5 --until 4.508 --at 2");
  for (std::size_t k = 1; k < 5; ++k) EXPECT_NEAR(half.row[1][k], peak.row[1][k] / 2, 1e-15);
}

// A slow real pole beside s = 0: the hub starts at 0 and is at 0.423 after 10 s, by an integration of finite
// elements in time.
TEST(StepCommand, SlowRealPole) {
  const Rows rows = rows_of("step --gains 5,0,90 --until 10");
  EXPECT_NEAR(rows.row[0][1], 0, 1e-9);  // the tolerance of the sum
  EXPECT_NEAR(rows.row[1][1], 0.42329, 1e-5);
}

// A rigid body's t^2/(2J) carries the turn; the ripple is bounded by the appendages' inertia.
TEST(StepCommand, UnitTorque) {
  const Rows rows = rows_of("step --until 100 --every 50");
  EXPECT_EQ(rows.header, "t,theta,theta_dot");
  ASSERT_EQ(rows.row.size(), 3U);
  EXPECT_NEAR(rows.row[2][1] / (1e4 / 2 / 18.0961), 1, 1e-4);
  EXPECT_NEAR(rows.row[2][2] / (1e2 / 18.0961), 1, 1e-2);
}

// Twelve digits. oracle: gss_control_loop optimum k* at *, optimum cost *, PD optimum * at W = 100
TEST(OptimalGainsCommand, KnownOptima) {
  struct Case {
    std::string words;
    std::array<double, 4> known;
  };
  const std::string r = " --torque-weight 0.006944444444444444";
  for (const Case& c :
       {Case{"--deflection-weight 100" + r, {12, 4.82952499282, 31.9283386251, 2.66069488543}},
        Case{"--deflection-weight 100 --pd" + r, {4.55260668488, 0, 12.8362319884, 2.81953458248}},
        Case{"--deflection-weight 0" + r, {12, 0, 20.8400191938, 1.73666826615}},
        Case{"--deflection-weight 1000" + r, {12, 18.7466651844, 52.0146602067, 4.33455501723}}}) {
    const Rows rows = rows_of("optimal-gains " + c.words);
    EXPECT_EQ(rows.header, "k1,k2,k3,cost");
    ASSERT_EQ(rows.row.size(), 1U);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(rows.row[0][k], c.known.at(k), 1e-11 * std::max(1., c.known.at(k))) << c.words;
  }
}

// A file changes the spacecraft: without tips. oracle: gss_control_plant bare pole 1, bare pole 2, bare
// locked 1, bare locked 2, bare theta at 1, bare y2 at 1
TEST(SpacecraftOption, ReadsAFile) {
  namespace fs = std::filesystem;
  const fs::path file = fs::temp_directory_path() / ("nlmech-craft-" + std::to_string(::getpid()) + ".toml");
  scene::write_whole(file, "tip_mass = 0\ntip_inertia = 0.0\n");
  expect_points(rows_of("poles --count 2 --spacecraft " + file.string()),
                {{0, 12.85700141881}, {0, 72.75595661757}}, 1e-12);
  expect_points(rows_of("zeros --count 2 --spacecraft " + file.string()),
                {{0, 11.51094878903}, {0, 72.13788468598}}, 1e-12);
  const Rows r = rows_of("response --omega 1 --at 2 --spacecraft " + file.string());
  EXPECT_NEAR(r.row[0][1] / -0.0974374222149588, 1, 1e-13);
  EXPECT_NEAR(r.row[0][3] / -0.00155990461324693, 1, 1e-13);
  fs::remove(file);
}

// k3 = k1 J for the best PD gains, and the turn of 0.5 rad is nearly done after 10 s.
TEST(Example, Runs) {
  const scene::Finished f = tests::run_words("gss_control_example", "");
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  const auto after = [&](const std::string& word) {
    const std::size_t place = f.output.find(word);
    return place == std::string::npos ? NAN : std::strtod(f.output.c_str() + place + word.size(), nullptr);
  };
  const double k1 = after("k1 "), k3 = after("k3 "), cost = after("cost "), theta = after("theta "),
               tip = after("tip ");
  EXPECT_NEAR(k3, k1 * cost, 1e-5);  // six decimals are printed
  EXPECT_NEAR(theta, 0.5, 0.03);
  EXPECT_LT(std::abs(tip), 0.01);
}

}  // namespace
}  // namespace nlmech::own_work_test
