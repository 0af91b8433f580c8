/// Random pork-chop grids by whole programs: each cell is the least of all arcs, found here anew from places
/// by another road.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert.hpp"
#include "tests/adversary/commands/command_run.hpp"
#include "tests/adversary/kepler_oracle.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::adversary::commands_grid_test {
namespace {

using orbit::State;
using orbit::Vector3;
namespace oracle = orbit::adversary;
constexpr double eps = std::numeric_limits<double>::epsilon();

std::string triple(const Vector3<double>& v) {
  return fmt::format("{:.17g},{:.17g},{:.17g}", v[0], v[1], v[2]);
}

/// Two bodies on ellipses, and one pair of times or a few.
struct Pair {
  std::array<State, 2> body;
  std::array<double, 2> epoch{};
  double mu = 1, time = 1;  // the scale of a circular motion
  int revolutions = 0, rows = 1, columns = 1;
  std::array<double, 2> departures{}, arrivals{};
};

Pair any_pair(Draw& draw) {
  Pair p;
  p.mu = draw.log_uniform(1e-3, 1e18);
  const double r = draw.log_uniform(1e-3, 1e12), ratio = draw.log_uniform(0.1, 10);
  p.time = r * std::sqrt(r / p.mu);
  p.body[0] = oracle::state_of(draw, r, p.mu, draw.uniform(0.6, 1.3), draw.uniform(1, 2));
  p.body[1] = oracle::state_of(draw, r * ratio, p.mu, draw.uniform(0.6, 1.3), draw.uniform(1, 2));
  for (double& t : p.epoch) t = draw.chance(0.5) ? 0 : p.time * draw.uniform(-20, 20);
  p.revolutions = draw.chance(0.5) ? 0 : draw.whole(1, 4);
  p.rows = draw.whole(1, 3), p.columns = draw.whole(1, 3);
  p.departures[0] = p.time * draw.uniform(-20, 20);
  p.departures[1] = p.departures[0] + p.time * draw.uniform(0.01, 10);
  p.arrivals[0] = p.departures[0] + p.time * draw.uniform(-2, 10);
  p.arrivals[1] = p.arrivals[0] + p.time * draw.uniform(0.01, 40);
  return p;
}

std::string toml(const Pair& p) {
  std::string text = fmt::format("mu = {:.17e}\nrevolutions = {}\n", p.mu, p.revolutions);
  for (std::size_t b = 0; b < 2; ++b)
    text += fmt::format("[{}]\nposition = [{}]\nvelocity = [{}]\nepoch = {:.17e}\n", b == 0 ? "from" : "to",
                        triple(p.body[b].position), triple(p.body[b].velocity), p.epoch[b]);
  return text +
         fmt::format(
             "[departures]\nfirst = {:.17e}\nlast = {:.17e}\n[arrivals]\nfirst = {:.17e}\nlast = {:.17e}\n",
             p.departures[0], p.departures[1], p.arrivals[0], p.arrivals[1]);
}

/// A body at a time, and how far its place may be off.
struct Place {
  State state;
  double doubt;
};
Place place(const Pair& p, std::size_t b, double t) {
  const auto exact = oracle::conic<oracle::Wide>(p.body[b], t - p.epoch[b], p.mu);
  Place at{{exact.position.cast<double>(), exact.velocity.cast<double>()}, 0};
  // Rounding of the times too.
  const double turns =
      (std::abs(t) + std::abs(p.epoch[b])) * at.state.velocity.norm() / at.state.position.norm();
  at.doubt = 16 * eps * (orbit::kepler_condition(p.body[b], t - p.epoch[b], p.mu).position + turns);
  return at;
}

/// Both excess speeds of one arc.
struct Speeds {
  double departure, arrival;
  int revolutions;
};
std::vector<Speeds> arcs(const Pair& p, const State& a, const State& b, double time) {
  std::vector<Speeds> all;
  const orbit::LambertProblem problem{a.position, b.position, time, p.mu};
  for (const bool long_way : {false, true}) {
    for (int n = 0; n <= p.revolutions; ++n) {
      for (const auto branch : {orbit::LambertBranch::low, orbit::LambertBranch::high}) {
        if (n == 0 && branch == orbit::LambertBranch::high) continue;
        const auto s = orbit::solve_lambert(problem, {long_way, n, branch});
        if (s.status.ok()) all.push_back({(s.v1 - a.velocity).norm(), (s.v2 - b.velocity).norm(), n});
      }
    }
  }
  return all;
}

/// The least sum of both speeds, and how far rounded places move that of any arc.
struct Best {
  double sum = HUGE_VAL, doubt = 0;
};
Best best(const Pair& p, double departure, double arrival) {
  const Place a = place(p, 0, departure), b = place(p, 1, arrival);
  const double time = arrival - departure, part = 1e-7;
  const auto sum_of = [](const Speeds& s) { return s.departure + s.arrival; };
  const auto all = arcs(p, a.state, b.state, time);
  Best found;
  for (const Speeds& s : all) found.sum = std::min(found.sum, sum_of(s));
  const double rounded =
      a.doubt + b.doubt + 16 * eps * (1 + (std::abs(departure) + std::abs(arrival)) / time);
  for (int k = 0; k < 6; ++k) {
    State moved_a = a.state, moved_b = b.state;
    State& moved = k < 3 ? moved_a : moved_b;
    moved.position[k % 3] += part * moved.position.norm();
    double least = HUGE_VAL;
    for (const Speeds& s : arcs(p, moved_a, moved_b, time)) least = std::min(least, sum_of(s));
    found.doubt += std::abs(least - found.sum) / part * rounded;
  }
  found.doubt += 64 * eps * (a.state.velocity.norm() + b.state.velocity.norm() + found.sum);
  return found;
}

/// The row of a pair of times; none if there is none.
const std::vector<std::string>* row_of(const Ran& r, double departure, double arrival) {
  for (const auto& row : r.rows) {
    if (row.size() == 5 && number(row[0]) == departure && number(row[1]) == arrival) return &row;
  }
  return nullptr;
}

double time_of(const std::array<double, 2>& window, int k, int count) {
  return k == 0           ? window[0]
         : k == count - 1 ? window[1]
                          : window[0] + (window[1] - window[0]) * (k / (count - 1.0));
}

Case grid(Draw& draw, const std::filesystem::path& folder) {
  const Pair p = any_pair(draw);
  const std::filesystem::path file = folder / "orbits.toml";
  std::ofstream(file) << toml(p);
  const Ran r =
      ran(fmt::format("rbf_inverse porkchop {} --grid {}x{} --threads 1", file.string(), p.rows, p.columns));
  const std::string what = r.words + "\n" + toml(p);
  if (const auto failure = failed(r)) return *failure;
  Case worst = Case::undecided(what);
  std::size_t rows = 0;
  for (int i = 0; i < p.rows; ++i) {
    for (int j = 0; j < p.columns; ++j) {
      const double departure = time_of(p.departures, i, p.rows), arrival = time_of(p.arrivals, j, p.columns);
      const auto* const row = row_of(r, departure, arrival);
      rows += row != nullptr ? 1 : 0;
      if ((row != nullptr) != (arrival > departure))
        return Case::wrong(fmt::format("{}\nrow {:.17g}, {:.17g}", what, departure, arrival));
      if (row == nullptr) continue;
      const Best b = best(p, departure, arrival);
      if (!(b.doubt < 1e-3 * b.sum)) continue;
      const double sum = number((*row)[2]) + number((*row)[3]);
      Case found = Case::judged(std::abs(sum - b.sum), 4 * b.doubt,
                                fmt::format("{}\n{}, right {:.17g}", what, fmt::join(*row, ","), b.sum));
      if (found.verdict == Case::Verdict::wrong) return found;
      if (worst.verdict != Case::Verdict::right || found.ratio > worst.ratio) worst = found;
    }
  }
  return rows == r.rows.size() ? worst : Case::wrong("rows that nobody asked for: " + what);
}

TEST(AdversaryCommands, PorkchopsHaveTheLeastSpeeds) {
  if (const std::string what = missing_program("rbf_inverse"); !what.empty()) GTEST_SKIP() << what;
  const tests::TemporaryFolder folder;
  hunt({.quick = 20, .full = 3'000}, [&](Draw& draw) { return grid(draw, folder.path()); });
}

}  // namespace
}  // namespace nlmech::adversary::commands_grid_test
