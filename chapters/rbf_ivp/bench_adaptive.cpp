/// @file
/// `rbf_ivp_adaptive_bench`: adaptive-collocation against the other libraries at equal achieved error, by
/// Google Benchmark. Writes results/bench/rbf_ivp_adaptive.json and tables/BENCH.md under the current folder;
/// exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/stiff_problems.hpp"
#include "chapters/rbf_ivp/sweeps.hpp"
#include "chapters/speed.hpp"
#include "nlmech/comparison/accuracy.hpp"
#include "nlmech/ivp/adaptive_collocation.hpp"
#include "nlmech/peers/ivp/cvode.hpp"

namespace {

using namespace nlmech;
using chapters::Case;
using chapters::Stiff;

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
  double seconds;  ///< of the search, to choose by
};

struct Claim {
  std::string fast, slow;
  double least;
};

/// Everything that is measured, and what is said of it.
struct Contest {
  std::vector<Work> work;
  std::vector<Claim> claims;
};

/// The fastest setting that reaches the wanted error.
template <int n>
std::optional<Work> fastest(const Case<n>& c, const comparison::Contender& contender, double wanted,
                            const std::string& name) {
  std::optional<Work> best;
  for (const comparison::Setting& setting : contender.settings) {
    const auto run = comparison::integrator<n>(contender, setting);
    const auto accuracy = comparison::accuracy_of(c, run, {.steps = 2'000'000});
    if (!accuracy.error || *accuracy.error > wanted) continue;
    const auto once = [&c, run] {
      auto end = run(c.system, c.x0, c.t0, c.t1, {}, {});
      benchmark::DoNotOptimize(end);
    };
    const double seconds = time_repeats(once, 5).smallest;
    if (!best || seconds < best->seconds) best = Work{name, once, seconds};
  }
  return best;
}

/// Ours against the fastest of all peers, both behind the same interface.
template <int n>
void against_peers(Contest& contest, const Case<n>& c, double wanted, double least) {
  const std::string at = fmt::format("{} to {:.0e}", c.name, wanted);
  std::optional<Work> ours, best;
  std::string name;
  for (const auto& contender : chapters::with_step_control(false)) {
    if (contender.name == "ode45") continue;
    const bool mine = contender.name == "adaptive-collocation";
    auto work = fastest(c, contender, wanted,
                        fmt::format("{}, {}", at, mine ? "adaptive-collocation" : "best library"));
    if (!work) continue;
    if (mine) {
      ours = std::move(work);
    } else if (!best || work->seconds < best->seconds) {
      best = std::move(work);
      name = contender.name;
    }
  }
  fmt::print("{}: best library {}\n", at, best ? name : "none: no other library gets there");
  if (!ours) fmt::print("{}: adaptive-collocation does not get there\n", at);
  if (ours && best) contest.claims.push_back({ours->name, best->name, least});
  for (auto& one : {ours, best}) {
    if (one) contest.work.push_back(*one);
  }
}

/// The dissertation's algorithm at the error that it reaches, or with polynomials in place of its radial
/// functions, which reach nine digits.
template <int n>
void against_collocation(Contest& contest, const Case<n>& c, const chapters::StepScales& scales,
                         const std::string& method, double wanted, double least) {
  const std::string at = fmt::format("{} to {:.0e}, ", c.name, wanted);
  for (const auto& contender : chapters::contenders(scales, false)) {
    if (contender.label() != method && contender.name != "adaptive-collocation") continue;
    const std::string name = at + contender.label();
    const bool is_there =
        std::any_of(contest.work.begin(), contest.work.end(), [&](const Work& w) { return w.name == name; });
    if (is_there) continue;
    if (auto work = fastest(c, contender, wanted, name)) contest.work.push_back(*work);
  }
  contest.claims.push_back({at + "adaptive-collocation", at + method, least});
}

template <int n, class Make>
std::optional<Work> fastest_stiff(const Stiff<n>& p, Make make, double wanted, const std::string& name) {
  std::optional<Work> best;
  for (int half = 8; half <= 26; ++half) {
    const double tolerance = std::pow(10, -0.5 * half);
    const auto method = make(tolerance, tolerance * p.absolute);
    const auto s = ivp::integrate(p.system, p.x0, 0, p.end, method, {}, {.steps = 2'000'000});
    if (!s.status.ok() || !(p.error(s.x) <= wanted)) continue;
    const auto once = [p, method] {
      auto end = ivp::integrate(p.system, p.x0, 0, p.end, method);
      benchmark::DoNotOptimize(end);
    };
    const double seconds = time_repeats(once, 5).smallest;
    if (!best || seconds < best->seconds) best = Work{name, once, seconds};
  }
  return best;
}

template <int n>
void against_cvode(Contest& contest, const Stiff<n>& p, double wanted, double least) {
  const std::string at = fmt::format("{} to {:.0e}", p.name, wanted);
  const auto ours = fastest_stiff(
      p,
      [](double r, double a) {
        return ivp::AdaptiveCollocation{.relative_tolerance = r, .absolute_tolerance = a};
      },
      wanted, at + ", adaptive-collocation");
  const auto theirs = fastest_stiff(
      p,
      [](double r, double a) {
        peers::Cvode cvode{};
        cvode.relative_tolerance = r;
        cvode.absolute_tolerance = a;
        return cvode;
      },
      wanted, at + ", cvode-bdf");
  for (const auto& one : {ours, theirs}) {
    if (one) contest.work.push_back(*one);
  }
  if (!ours) fmt::print("{}: adaptive-collocation does not get there\n", at);
  if (!theirs) fmt::print("{}: CVODE does not get there\n", at);
  if (ours && theirs) contest.claims.push_back({ours->name, theirs->name, least});
}

Contest contest() {
  Contest all;
  for (const auto& [wanted, least] : {std::pair{1e-9, 1.0}, std::pair{1e-12, 1.5}}) {
    against_peers(all, chapters::free_duffing_case(), wanted, least);
    against_peers(all, chapters::impact_case(), wanted, least);
    against_peers(all, chapters::three_mass_case(), wanted, least);
    against_peers(all, chapters::held_back_case(), wanted, least);
  }
  const auto scales = chapters::free_duffing_steps();
  const auto chain_scales = chapters::three_mass_steps();
  against_collocation(all, chapters::free_duffing_case(), scales, "rbf-coll, N = 35", 1e-5, 40);
  against_collocation(all, chapters::three_mass_case(), chain_scales, "rbf-coll, N = 35", 1e-7, 40);
  against_collocation(all, chapters::free_duffing_case(), scales, "lgl-coll, N = 35", 1e-9, 30);
  against_collocation(all, chapters::three_mass_case(), chain_scales, "lgl-coll, N = 35", 1e-9, 40);

  const auto both = [&](const auto& p) {
    against_cvode(all, p, 1e-6, 1 / 1.5);
    against_cvode(all, p, 1e-9, 1);
  };
  both(chapters::van_der_pol_of_the_test_set());
  both(chapters::robertson());
  both(chapters::hires());
  both(chapters::stiff_duffing());
  both(chapters::stiff_masses());
  return all;
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  const Contest all = contest();
  std::vector<scene::SpeedClaim> claims;
  for (const Claim& claim : all.claims)
    claims.push_back(
        {fmt::format("{} against {}", claim.fast, claim.slow), claim.fast, claim.slow, claim.least});
  return chapters::judge_speed("rbf_ivp_adaptive", claims, chapters::measure_speed(all.work));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("rbf_ivp_adaptive_bench", &bench, argc, argv);
}
