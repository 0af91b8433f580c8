/// `two_body_series propagate`, `elements` and `state` as a user types them.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/process.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/places.hpp"

namespace nlmech::own_work_test {
namespace {

using scene::Finished;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double earth_mu = 3.986004418e14;
const std::string low =
    "--position 1702547.136867679,6353992.417071098,0 --velocity -7886.014053829254,2113.051097224035,0 ";

/// Runs the program with words separated by blanks.
Finished two_body_series(const std::string& words) {
  std::vector<std::string> arguments = {NLMECH_BINARY_DIR "/bin/two_body_series"};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    if (end > begin) arguments.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return scene::run_program(arguments, {});
}

/// The rows of a run that has to succeed: t, x, y, z, vx, vy, vz by column.
scene::NumberColumns rows_of(const std::string& words) {
  const Finished f = two_body_series("propagate " + words);
  EXPECT_EQ(f.exit_code, 0) << words << ": " << f.errors;
  EXPECT_TRUE(f.output.starts_with("t,x,y,z,vx,vy,vz\n")) << f.output;
  return scene::parse_numbers(f.output, "output", {"t", "x", "y", "z", "vx", "vy", "vz"});
}

orbit::State state_at(const scene::NumberColumns& rows, std::size_t i) {
  const auto& c = rows.column;
  return {{c[1][i], c[2][i], c[3][i]}, {c[4][i], c[5][i], c[6][i]}};
}

/// Relative error of the position of a row against Kepler's problem in 50 digits, in units of eps kappa.
double error_of(const scene::NumberColumns& rows, std::size_t i, double mu) {
  using Real = ExtendedReal<50>;
  const orbit::State s = state_at(rows, 0);
  const double t = rows.column[0][i];
  const orbit::BasicState<Real> start{s.position.cast<Real>(), s.velocity.cast<Real>()};
  const auto exact = orbit::kepler_state(start, Real(t), Real(mu));
  const orbit::Vector3<Real> d = state_at(rows, i).position.cast<Real>() - exact.position;
  const Real r = sqrt(d.dot(d) / exact.position.dot(exact.position));
  return static_cast<double>(r) / (eps * orbit::kepler_condition(s, t, mu).position);
}

// Tolerance 1e-15 is 4.5 eps a step, some 30 of them an orbit; kappa counts the same again for later orbits.
TEST(Propagate, EveryMethodOnEveryConic) {
  struct Case {
    std::string start;
    double mu, time;
  };
  const std::vector<Case> cases = {
      {low, earth_mu, 124374.5},
      {low, earth_mu, -3000},
      {"--position 2096434.265330419,7823999.192941453,0 --velocity -8834.757074967362,2367.266023562654,0 ",
       earth_mu, 1e5},
      {"--position -7e6,1e6,2e6 --velocity -3e3,-12e3,1e3 ", earth_mu, 20000},
      {"--position -1,-2,0.5 --velocity 0.6,1.2,0 --mu 1 ", 1, 2.5}};
  for (const Case& c : cases) {
    for (const std::string method : {"", "--method series ", "--method kepler ", "--method rkn1210 "}) {
      const auto rows = rows_of(c.start + method + fmt::format("--until {:.17g}", c.time));
      ASSERT_EQ(rows.rows(), 2U);
      EXPECT_EQ(rows.column[0][0], 0);
      EXPECT_EQ(rows.column[0][1], c.time);
      EXPECT_LE(error_of(rows, 1, c.mu), method == "--method kepler " ? 8 : 100) << c.start << method;
    }
  }
}

TEST(Propagate, RowsAtEqualDistances) {
  for (const std::string method : {"series", "kepler", "rkn1210"}) {
    for (const double sign : {1.0, -1.0}) {
      const auto rows =
          rows_of(low + fmt::format("--until {} --every 1000 --method {}", sign * 6500, method));
      ASSERT_EQ(rows.rows(), 8U) << method;
      for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(rows.column[0][i], sign * 1000 * double(i));
      EXPECT_EQ(rows.column[0][7], sign * 6500);
      for (std::size_t i = 1; i < 8; ++i) EXPECT_LE(error_of(rows, i, earth_mu), 100) << method << i;
      // The end does not know of the rows.
      const auto alone = rows_of(low + fmt::format("--until {} --method {}", sign * 6500, method));
      EXPECT_EQ(state_at(alone, 1).position, state_at(rows, 7).position) << method;
    }
  }
  // A distance that divides the time by 10, in doubles or not, makes no second row at the end.
  EXPECT_EQ(rows_of(low + "--until 0.3 --every 0.1").rows(), 4U);
  EXPECT_EQ(rows_of(low + "--until 1 --every 2").rows(), 2U);
}

TEST(Propagate, NoTimeIsOneRow) {
  for (const std::string method : {"series", "kepler", "rkn1210"}) {
    const auto rows = rows_of(low + "--until 0 --every 10 --method " + method);
    ASSERT_EQ(rows.rows(), 1U) << method;
    EXPECT_EQ(rows.column[1][0], 1702547.136867679);
  }
}

// A day with J2, and with J2 to J6. Double precision errs by 2e-6 m.
// oracle: two_body_series_orbits day of circular ?
TEST(Propagate, ZonalHarmonics) {
  const std::string day = "--position 7e6,0,0 --velocity 0,4700,5900 --until 86400 --radius 6378137 --zonal ";
  const orbit::Vector3<double> by_j2(4532841.9627156031062, -3542172.7947567830238, -3979637.2144251580166);
  for (const std::string method : {"series", "rkn1210"}) {
    const auto rows = rows_of(day + "1.08262668e-3 --method " + method);
    EXPECT_LT((state_at(rows, 1).position - by_j2).norm(), 1e-5) << method;
  }
  const std::string all = "1.08262668e-3,-2.53265649e-6,-1.61962159e-6,-2.27296083e-7,5.40681239e-7";
  const auto series = rows_of(day + all + " --every 10000"),
             rkn = rows_of(day + all + " --every 10000 --method rkn1210");
  ASSERT_EQ(series.rows(), 10U);
  for (std::size_t i = 1; i < 10; ++i)
    EXPECT_LT((state_at(series, i).position - state_at(rkn, i).position).norm(), 1e-5) << i;
  EXPECT_GT((state_at(series, 9).position - by_j2).norm(), 100);  // the higher terms are there
}

// Metres and seconds, or the initial distance and its circular speed: data rounded in either, times what the
// orbit amplifies.
TEST(Propagate, UnitsDoNotMatter) {
  const double length = 6378137, rate = std::sqrt(earth_mu / length) / length;
  const double speed = length * rate;
  const auto canonical =
      rows_of(fmt::format("--position {:.17g},{:.17g},0 --velocity {:.17g},{:.17g},0 --mu 1 --until {:.17g}",
                          1702547.136867679 / length, 6353992.417071098 / length, -7886.014053829254 / speed,
                          2113.051097224035 / speed, 50000 * rate));
  const auto metres = rows_of(low + "--until 50000");
  const orbit::State start = state_at(metres, 0);
  const double kappa = orbit::kepler_condition(start, 50000, earth_mu).position;
  EXPECT_LE((state_at(canonical, 1).position * length - state_at(metres, 1).position).norm() /
                state_at(metres, 1).position.norm(),
            8 * eps * kappa);
}

TEST(Propagate, FlyByAndBack) {
  const auto out = rows_of("--position -7e6,1e6,2e6 --velocity -3e3,-12e3,1e3 --until 1e6");
  const orbit::State far = state_at(out, 1);
  const std::string back =
      fmt::format("--position {:.17g},{:.17g},{:.17g} --velocity {:.17g},{:.17g},{:.17g} ", far.position[0],
                  far.position[1], far.position[2], far.velocity[0], far.velocity[1], far.velocity[2]);
  const auto home = rows_of(back + "--until -1e6");
  const double kappa = orbit::kepler_condition(far, -1e6, earth_mu).position;
  EXPECT_LE(
      (state_at(home, 1).position - state_at(out, 0).position).norm() / state_at(out, 0).position.norm(),
      100 * eps * kappa);
}

// A radial fall from rest at distance 2, mu = 1, reaches the centre after pi: it takes a_0^1.5 pi, a_0 = 1.
TEST(Propagate, CollisionSaysWhenAndWhat) {
  const std::string fall = "--position 2,0,0 --velocity 0,0,0 --mu 1 ";
  for (const std::string method : {"series", "rkn1210"}) {
    const Finished f = two_body_series("propagate " + fall + "--until 4 --every 0.5 --method " + method);
    EXPECT_EQ(f.exit_code, 1) << f.errors;
    EXPECT_EQ(f.output, "");
    EXPECT_NE(f.errors.find("t = 3.14159265"), std::string::npos) << f.errors;
  }
  EXPECT_NE(two_body_series("propagate " + fall + "--until 4").errors.find("collision"), std::string::npos);
  // Kepler's solution returns: at 2 pi it is where it was.
  const auto rows = rows_of(fall + "--method kepler --until 6.283185307179586");
  EXPECT_NEAR(state_at(rows, 1).position[0], 2, 1e-14);
}

scene::NumberColumns elements_of(const std::string& words) {
  const Finished f = two_body_series("elements " + words);
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  return scene::parse_numbers(f.output, "output",
                              {"a", "e", "i", "raan", "argp", "nu", "period", "p", "q", "eccentric_anomaly",
                               "mean_anomaly", "time_since_periapsis"});
}

// Equations 3.72 and 3.74. oracle: two_body_series_orbits LEO eccentricity, LEO period, LEO axis with the
// implied mu
TEST(Elements, OfThePrintedStates) {
  const auto rows = elements_of(low);
  ASSERT_EQ(rows.rows(), 1U);
  EXPECT_NEAR(rows.column[1][0], 0.0999999757, 1e-10);
  EXPECT_NEAR(rows.column[3][0] + rows.column[4][0], 75, 1e-9);
  EXPECT_NEAR(rows.column[6][0], 6218.7281, 1e-4);
  const auto implied = elements_of(low + "--mu 3.98600433e14");
  EXPECT_NEAR(implied.column[0][0], 7309041.111, 1e-3);
  EXPECT_NEAR(implied.column[1][0], 0.1, 1e-14);
}

TEST(Elements, ThereAndBack) {
  const std::vector<std::string> conics = {"--a 7e6 --e 0.3", "--a -7e6 --e 1.5", "--p 9e6 --e 0.3",
                                           "--p 9e6 --e 1", "--p 9e6 --e 2"};
  for (const std::string& conic : conics) {
    const Finished f = two_body_series("state " + conic + " --i 50 --raan 300 --argp 200 --nu -70");
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    const auto s = scene::parse_numbers(f.output, "output", {"x", "y", "z", "vx", "vy", "vz"}).column;
    const Finished back = two_body_series(
        fmt::format("elements --position {:.17g},{:.17g},{:.17g} --velocity {:.17g},{:.17g},{:.17g}", s[0][0],
                    s[1][0], s[2][0], s[3][0], s[4][0], s[5][0]));
    ASSERT_EQ(back.exit_code, 0) << back.errors;
    const auto row = scene::parse_csv(back.output, "output").at(1).cells;
    const double expected[] = {50, 300, 200, -70};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(std::stod(row.at(2 + k)), expected[k], 1e-12) << conic;
    // And from the row, by what fixes the place on any conic: 32 eps of elements_of(), angles in degrees.
    const std::string form = row.at(0) == "inf" ? "--e 1" : "--a " + row.at(0);
    const Finished again =
        two_body_series(fmt::format("state {} --q {} --i {} --raan {} --argp {} --time-since-periapsis {}",
                                    form, row.at(8), row.at(2), row.at(3), row.at(4), row.at(11)));
    ASSERT_EQ(again.exit_code, 0) << again.errors;
    const auto t = scene::parse_csv(again.output, "output").at(1).cells;
    for (std::size_t k = 0; k < 6; ++k) {
      const double size =
          k < 3 ? std::hypot(s[0][0], s[1][0], s[2][0]) : std::hypot(s[3][0], s[4][0], s[5][0]);
      EXPECT_NEAR(std::stod(t.at(k)), s[k][0], 1e-14 * size) << conic;
    }
  }
}

// All places of one: an ellipse with M = 40 degrees and e = 0.1, whose E is the root of E - e sin E = M, by
// Newton's iteration here.
TEST(State, FromEachAnomaly) {
  const double e = 0.1, mean = 40 * std::numbers::pi / 180;
  double anomaly = mean;
  for (int k = 0; k < 20; ++k)
    anomaly -= (anomaly - e * std::sin(anomaly) - mean) / (1 - e * std::cos(anomaly));
  const double degree = std::numbers::pi / 180;
  const double nu = 2 * std::atan(std::sqrt((1 + e) / (1 - e)) * std::tan(anomaly / 2));
  for (const std::string& place :
       {std::string("--mean-anomaly 40"), std::string("--mean-anomaly -320"),
        fmt::format("--eccentric-anomaly {:.17g}", anomaly / degree),
        fmt::format("--nu {:.17g}", nu / degree), fmt::format("--time-since-periapsis {:.17g}", mean)}) {
    const Finished f = two_body_series("state --a 1 --e 0.1 --mu 1 " + place);
    ASSERT_EQ(f.exit_code, 0) << f.errors;
    const auto s = scene::parse_numbers(f.output, "output", {"x", "y", "z", "vx", "vy", "vz"}).column;
    EXPECT_NEAR(s[0][0], std::cos(anomaly) - e, 1e-14) << place;
    EXPECT_NEAR(s[1][0], std::sqrt(1 - e * e) * std::sin(anomaly), 1e-14) << place;
    EXPECT_EQ(f.errors, "") << place;
  }
}

// v^2 = 2 mu/r exactly: mu = 2, r = 1, v = 2.
TEST(Elements, ParabolaHasInfiniteAxisAndPeriod) {
  const Finished f = two_body_series("elements --position 1,0,0 --velocity 0,2,0 --mu 2");
  EXPECT_EQ(f.output,
            "a,e,i,raan,argp,nu,period,p,q,eccentric_anomaly,mean_anomaly,time_since_periapsis\n"
            "inf,1,0,0,0,0,inf,2,1,0,0,0\n")
      << f.errors;
}

// A circle of radius 1 and mu = 1, a quarter on; and nothing asked for but the shape.
TEST(State, OfACircle) {
  const Finished f = two_body_series("state --a 1 --e 0 --mu 1");
  EXPECT_EQ(f.output, "x,y,z,vx,vy,vz\n1,0,0,0,1,0\n") << f.errors;
}

struct Bad {
  std::string words;
  std::vector<std::string> says;
};

TEST(OwnWork, BadInputIsNamed) {
  const std::string start = "--position 1,0,0 --velocity 0,1,0 ";
  const std::string run = "propagate " + start;
  const std::vector<Bad> cases = {
      {"propagate --position 0,0,0 --velocity 0,1,0 --until 1", {"--position 0,0,0", "centre"}},
      {"propagate --position 1,0 --velocity 0,1,0 --until 1", {"--position 1,0", "3 are needed"}},
      {"propagate --position 1,0,0 --velocity 0,one,0 --until 1", {"--velocity 0,one,0", "'one'"}},
      {"propagate --position 1,0,0 --velocity 0,1,inf --until 1", {"--velocity", "inf"}},
      {"propagate --position 1,0,0 --until 1", {"--velocity"}},
      {run, {"--until"}},
      {run + "--until soon", {"--until soon"}},
      {run + "--until 1 --every 0", {"--every 0"}},
      {run + "--until 1 --every 1e-9", {"--every 1e-09", "10 million"}},
      {run + "--until 1 --mu -1", {"--mu -1"}},
      {run + "--until 1 --method euler", {"--method euler", "kepler"}},
      {run + "--until 1 --tolerance 0", {"--tolerance 0", "1e-18"}},
      {run + "--until 1 --tolerance 1", {"--tolerance 1"}},
      {run + "--until 1 --tolerance 1e-9 --method kepler", {"--tolerance 1e-09", "kepler"}},
      {run + "--until 1 --zonal 1e-3 --radius 1 --method kepler", {"--zonal 0.001", "kepler"}},
      {run + "--until 1 --zonal 1e-3", {"--zonal 0.001", "--radius"}},
      {run + "--until 1 --radius 1", {"--radius 1", "--zonal"}},
      {run + "--until 1 --zonal 1,2,3,4,5,6 --radius 1", {"--zonal 1,2,3,4,5,6", "J6"}},
      {run + "--until 1 --zonal 1,,2 --radius 1", {"--zonal 1,,2"}},
      {run + "--until 1 --zonal 1e-3 --radius 0", {"--radius 0"}},
      {run + "--until 1 --limit 0", {"--limit 0"}},
      {"elements --position 1,0,0 --velocity 1,0,0", {"--velocity 1,0,0", "straight line"}},
      {"elements --position 0,0,0 --velocity 1,0,0", {"--position 0,0,0"}},
      {"elements " + start + "--mu 0", {"--mu 0"}},
      {"state --e 0.1", {"--a", "--p"}},
      {"state --a 1 --p 1 --e 0.1", {"--a 1", "--p 1"}},
      {"state --a 1", {"--e"}},
      {"state --a 1 --e -0.1", {"--e -0.1"}},
      {"state --a 1 --e 1", {"--a 1", "--e 1"}},
      {"state --a 1 --e 1.5", {"--a 1", "--e 1.5"}},
      {"state --p 0 --e 1", {"--p 0"}},
      {"state --p 1 --e 2 --nu 150", {"--nu 150", "beyond the asymptote", "at 120"}},
      {"state --p 1 --e 1 --nu 180", {"--nu 180", "on the asymptote"}},
      {"state --a 1 --q 2", {"--a 1", "--q 2"}},
      {"state --a 1 --q 0.5 --e 0.5", {"--a 1", "--q 0.5"}},
      {"state --q 1 --e 1 --mean-anomaly 3", {"--mean-anomaly 3", "parabola"}},
      {"state --q 1 --e 1 --eccentric-anomaly 3", {"--eccentric-anomaly 3"}},
      {"state --q 1 --e 0 --nu 3 --mean-anomaly 4", {"--nu 3", "--mean-anomaly 4", "one of them"}},
      // Units that cannot be meant: kilometres without --mu.
      {"propagate --position 7000,0,0 --velocity 0,7.5,1 --until 6000", {"--position 7000,0,0", "--mu"}},
      {"elements --position 7000,0,0 --velocity 0,7.5,1", {"--position 7000,0,0", "--mu"}},
      {"state --a 7000 --e 0.1", {"--a 7000", "--mu"}},
      {"state --a 1 --e 0.1 --i 190", {"--i 190"}},
      {"state --a 1 --e 0.1 --raan x", {"--raan x"}},
      {"state --a 1 --e 0.1 --nu 1e20", {"--nu 1e20", "360"}},
      // Finite numbers that lead to no finite ones.
      {"state --p 7e6 --e 1e308", {"--e 1e+308", "range of doubles"}},
      {"elements --position 7e6,0,0 --velocity 0,7500,0 --mu 1e-300", {"--mu 1e-300", "eccentricity"}},
      {"elements --position 1e308,0,0 --velocity 1,1e-5,0 --mu 1e308", {"--mu 1e+308", "doubles"}}};
  for (const Bad& bad : cases) {
    const Finished f = two_body_series(bad.words);
    EXPECT_EQ(f.exit_code, 2) << bad.words << ": " << f.errors;
    EXPECT_EQ(f.output, "") << bad.words;
    for (const std::string& word : bad.says)
      EXPECT_NE(f.errors.find(word), std::string::npos) << "no '" << word << "' in: " << f.errors;
  }
}

// A phase that rounding leaves undetermined is no answer; one of few digits is said to be one.
TEST(Propagate, KeplerRefusesAnUndeterminedPhase) {
  const std::string far = "propagate " + low + "--method kepler --until ";
  for (const std::string time : {"1e100", "-1e300", "1e21"}) {
    const Finished f = two_body_series(far + time);
    EXPECT_EQ(f.exit_code, 1) << time;
    EXPECT_EQ(f.output, "");
    EXPECT_NE(f.errors.find("undetermined"), std::string::npos) << f.errors;
  }
  const Finished few = two_body_series(far + "1e15");
  EXPECT_EQ(few.exit_code, 0) << few.errors;
  EXPECT_NE(few.errors.find("determine the position"), std::string::npos) << few.errors;
  EXPECT_EQ(two_body_series(far + "1e8").errors, "");
}

TEST(Propagate, FailureSaysWhereAndWhatToChange) {
  const Finished f =
      two_body_series("propagate --position 1,0,0 --velocity 0,1e-9,0 --mu 1 --until 1e4 --limit 1e-9");
  EXPECT_EQ(f.exit_code, 1) << f.errors;
  EXPECT_EQ(f.output, "");
  EXPECT_NE(f.errors.find("time_limit"), std::string::npos) << f.errors;
}

TEST(Example, OfThePageRuns) {
  const Finished f = scene::run_program({NLMECH_BINARY_DIR "/bin/two_body_series_example"}, {});
  EXPECT_EQ(f.exit_code, 0) << f.errors;
  ASSERT_TRUE(f.output.starts_with("success: x = ")) << f.output;
  // The same day by another method.
  const auto rows = rows_of(
      "--position 7e6,0,0 --velocity 0,4700,5900 --until 86400 --radius 6378137 --method rkn1210 --zonal "
      "1.08262668e-3,-2.53265649e-6,-1.61962159e-6,-2.27296083e-7,5.40681239e-7");
  EXPECT_NEAR(std::stod(f.output.substr(13)), state_at(rows, 1).position[0], 1e-3);
}

}  // namespace
}  // namespace nlmech::own_work_test
