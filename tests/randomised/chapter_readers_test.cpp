/// Readers of the chapters' input files, a spacecraft and two orbits in TOML.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "chapters/gss_control/commands/spacecraft_file.hpp"
#include "chapters/rbf_inverse/commands/porkchop_file.hpp"
#include "tests/randomised/mutation.hpp"

namespace nlmech::randomised::chapter_readers_test {
namespace {

constexpr std::int64_t all_of_them = 1'000'000;

TEST(RandomisedReaders, SpacecraftAsToml) {
  static const std::vector<std::string> examples = {
      "hub_inertia = 8\nmass_per_length = 0.0271875\nyoungs_modulus = 1584000000.0\nlength = 4\n",
      "tip_mass = 0.1  # slug\ntip_inertia = 0.02\nhub_radius = 1.0\nsecond_moment = 4.7095e-8\n",
      "length = 3.5\n", ""};
  randomised_test({.quick = 2000, .full = all_of_them, .least_right = 0.02}, [](Draw& draw) {
    return read_or_refused(damaged(draw, examples), [](const std::string& text) {
      const spacecraft::Parameters p = chapters::gss_control::parse_spacecraft(text, "craft.toml");
      for (const double x : {p.mass_per_length, p.youngs_modulus, p.length, p.second_moment}) {
        if (!(x > 0 && std::isfinite(x))) return false;
      }
      for (const double x : {p.hub_inertia, p.hub_radius, p.tip_mass, p.tip_inertia}) {
        if (!(x >= 0 && std::isfinite(x))) return false;
      }
      return true;
    });
  });
}

TEST(RandomisedReaders, TwoOrbitsAsToml) {
  static const std::vector<std::string> examples = {
      "mu = 1.32712440018e20\n[from]\na = 1.49598e11\ne = 0.0167\nnu = 10\n[to]\na = 2.279e11\ne = 0.0934\ni "
      "= 1.85\n"
      "raan = 49.6\nargp = 286.5\nnu = 20\nepoch = 0\n[departures]\nfirst = 0\nlast = 3e7\n[arrivals]\nfirst "
      "= 1e7\n"
      "last = 6e7\n",
      "mu = 3.986e14\nrevolutions = 2\nfrom = {position = [7e6, 0, 0], velocity = [0, 7.5e3, 0]}\n"
      "to = {p = 4.2e7, e = 0, nu = 90}\n[departures]\nfirst = 0\nlast = 6000\n[arrivals]\nfirst = "
      "4000\nlast = 3e4\n"};
  randomised_test({.quick = 1500, .full = all_of_them, .least_right = 0.02}, [](Draw& draw) {
    return read_or_refused(damaged(draw, examples), [](const std::string& text) {
      const orbit::PorkchopProblem p = chapters::rbf_inverse::read_porkchop(text, "two.toml");
      return p.mu > 0 && std::isfinite(p.mu) && p.from.state.position.allFinite() &&
             p.from.state.velocity.allFinite() && p.to.state.position.allFinite() &&
             p.to.state.velocity.allFinite() && p.departures.first <= p.departures.last &&
             p.arrivals.first <= p.arrivals.last && p.most_revolutions >= 0;
    });
  });
}

// Each dot of a key creates a nested table.
TEST(RandomisedReaders, KeysOfManyTables) {
  for (const std::size_t tables : {100U, 1900U, 30'000U, 1'000'000U}) {
    std::string key;
    for (std::size_t i = 0; i < tables; ++i) key += "a.";
    for (const std::string& text : {key + "b = 1\n", '[' + key + "b]\nc = 1\n"}) {
      const auto refused = [&](const auto& read) {
        return read_or_refused(text, [&](const std::string& t) {
                 static_cast<void>(read(t, "deep.toml"));
                 return false;
               }).verdict == Case::Verdict::refused;
      };
      EXPECT_TRUE(refused(chapters::gss_control::parse_spacecraft)) << tables;
      EXPECT_TRUE(refused(chapters::rbf_inverse::read_porkchop)) << tables;
    }
  }
}

}  // namespace
}  // namespace nlmech::randomised::chapter_readers_test
