/// @file
/// `rbf_inverse_bench`: nine digits of the initial co-states of the Duffing cases by refined intervals, by
/// one polynomial and by multiple shooting with CVODE, and a direct start by our own descent and by Ipopt,
/// by Google Benchmark. Writes results/bench/rbf_inverse.json under the current folder; exit code 1 if a
/// claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "chapters/rbf_inverse/control/shooting_methods.hpp"
#include "chapters/speed.hpp"
#include "nlmech/peers/bvp/ipopt.hpp"

namespace {

using namespace nlmech;
namespace inverse = chapters::rbf_inverse;
using bvp::DuffingCase;
using Eigen::VectorXd;

/// A piece of work that is measured; false if it misses nine digits.
struct Work {
  std::string name;
  std::function<bool()> run;
};

/// A case at T = 2 and the start of all: a coarse direct method's trajectory, which is not timed.
struct Subject {
  explicit Subject(DuffingCase which)
      : known(inverse::known_extremal(which)),
        problem(duffing_problem(inverse::printed_settings(which, known.final_time))),
        guess{VectorXd::Zero(2), [](double, VectorXd& u) { u[0] = 0; }},
        start(direct_start(problem, guess, {.pieces = 40}).start) {}

  /// Nine digits of both initial co-states?
  [[nodiscard]] bool right(const Status& status, const VectorXd& first) const {
    if (!status.ok()) return false;
    const double size = std::max(std::abs(known.first[2]), std::abs(known.first[3]));
    return std::abs(first[2] - known.first[2]) <= 1e-9 * size &&
           std::abs(first[3] - known.first[3]) <= 1e-9 * size;
  }

  inverse::KnownExtremal known;
  bvp::ExtremalProblem problem;
  bvp::ControlGuess guess;
  bvp::Start start;
};

std::string named(const char* method, const Subject& s) {
  return fmt::format("{}, {}", method, to_string(s.known.which));
}
constexpr const char *refined = "refined intervals", *one = "one polynomial", *shooting = "multiple shooting",
                     *own = "own direct start", *ipopt = "ipopt";

/// The settings are the least exact ones that give nine digits in both cases; a method that fails is said to.
std::vector<Work> work_on(const Subject& s) {
  std::vector<Work> all = {
      {named(refined, s),
       [&s] {
         const bvp::Solution r = solve(s.problem, s.start, {.nodes = 6, .intervals = 3, .tolerance = 1e-6});
         return s.right(r.status, r.first());
       }},
      {named(one, s),
       [&s] {
         const bool is_free = s.known.which == DuffingCase::free;
         const bvp::GlobalResult r = solve_global(s.problem,
                                                  {.nodes = is_free ? 25 : 60,
                                                   .derivative = bvp::DerivativeMatrix::polynomial,
                                                   .rows = printed_rows(s.problem)},
                                                  s.start, 0.1, true);
         return s.right(r.extremal.solution.status, r.extremal.solution.first());
       }},
      {named(own, s), [&s] { return direct_start(s.problem, s.guess, {.pieces = 200}).status.ok(); }}};
  if (inverse::multiple_shooting_available())
    all.push_back({named(shooting, s), [&s] {
                     const inverse::Shot r = inverse::shoot(s.problem, s.start, {.tolerance = 1e-10});
                     return s.right(r.status, r.first);
                   }});
  if (peers::ipopt_available())
    all.push_back({named(ipopt, s),
                   [&s] { return peers::ipopt_start(s.problem, s.guess, {.pieces = 200}).status.ok(); }});
  return all;
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  const std::vector<Subject> subjects = {Subject(DuffingCase::free), Subject(DuffingCase::fixed)};
  std::vector<Work> all;
  std::vector<scene::SpeedClaim> claims;
  for (const Subject& s : subjects) {
    std::vector<std::string> done;
    for (Work& w : work_on(s)) {
      if (!w.run()) {
        fmt::print("{}: misses nine digits\n", w.name);
        continue;
      }
      done.push_back(w.name);
      all.push_back(std::move(w));
    }
    const auto claim = [&](const char* ours, const char* theirs, const char* what, double least) {
      const std::string a = named(ours, s), b = named(theirs, s);
      if (std::find(done.begin(), done.end(), a) == done.end()) return;
      if (std::find(done.begin(), done.end(), b) == done.end()) return;
      claims.push_back({fmt::format("{}, {}", what, to_string(s.known.which)), a, b, least});
    };
    claim(refined, shooting, "nine digits by refined intervals against multiple shooting with CVODE", 2);
    claim(refined, one, "nine digits by refined intervals against one polynomial", 1.2);
  }
  return chapters::judge_speed("rbf_inverse", claims, chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("rbf_inverse_bench", &bench, argc, argv);
}
