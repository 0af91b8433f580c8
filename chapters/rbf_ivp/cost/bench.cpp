/// @file
/// `rbf_ivp_bench`: collocation against the best of the other libraries, as its manual runs it, at equal
/// accuracy, and what the type-erased System costs, by Google Benchmark. Writes results/bench/rbf_ivp.json
/// under the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "chapters/plain_equations.hpp"
#include "chapters/rbf_ivp/cost/native_peers.hpp"
#include "chapters/rbf_ivp/cost/sweeps.hpp"
#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/speed.hpp"
#include "nlmech/comparison/any_method.hpp"
#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/ivp/runge_kutta/explicit_runge_kutta.hpp"

namespace {

using namespace nlmech;
using chapters::rbf_ivp::Case;
using comparison::Contender;
using comparison::Setting;

constexpr double wanted = 1e-6;  // six digits, which most methods reach

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

Work work_of(const Case& c, const Contender& contender, const Setting& setting) {
  return {fmt::format("{}, {}", c.name, contender.label()),
          [&c, run = comparison::integrator(contender, setting)] {
            auto end = run(c.system, c.x0, c.t0, c.t1, {}, {});
            benchmark::DoNotOptimize(end);
          }};
}

/// The fastest setting of the sweep that has the wanted digits; nothing if none has.
std::optional<Work> fastest(const Case& c, const Contender& contender) {
  std::optional<Work> best;
  double least = HUGE_VAL;
  for (const Setting& setting : contender.settings) {
    const ivp::Limits limits{.steps = 2'000'000};
    const auto accuracy = comparison::accuracy_of(c, comparison::integrator(contender, setting), limits);
    if (!accuracy.error || *accuracy.error > wanted) continue;
    Work work = work_of(c, contender, setting);
    const double seconds = time_repeats(work.run, 3).smallest;
    if (seconds < least) {
      least = seconds;
      best = std::move(work);
    }
  }
  return best;
}

/// The fastest of the explicit libraries by its own loop (ARKODE: in our walk).
std::optional<Work> best_library(const Case& c, const std::vector<Contender>& libraries,
                                 const std::vector<chapters::rbf_ivp::NativePeer>& native) {
  std::optional<Work> best;
  double least = HUGE_VAL;
  const auto take = [&](const std::string& name, const std::function<void()>& run) {
    const double seconds = time_repeats(run, 3).smallest;
    if (seconds >= least) return;
    least = seconds;
    best = Work{name, run};
  };
  for (const Contender& contender : libraries) {
    const auto peer = std::find_if(native.begin(), native.end(), [&](const chapters::rbf_ivp::NativePeer& p) {
      return p.name == contender.name;
    });
    if (peer == native.end()) {
      if (const auto walked = fastest(c, contender)) take(contender.name, walked->run);
    } else if (const auto alone = chapters::rbf_ivp::fastest_alone(c, peer->run, contender, wanted)) {
      take(contender.name, alone->run);
    }
  }
  return best;
}

/// Ours of one problem, and the fastest library on it as "best library".
std::vector<Work> rivals(const Case& c, const chapters::rbf_ivp::StepScales& scales,
                         const std::vector<std::string>& ours,
                         const std::vector<chapters::rbf_ivp::NativePeer>& native) {
  std::vector<Work> all;
  std::vector<Contender> libraries;
  for (const Contender& contender : chapters::rbf_ivp::contenders(scales, false)) {
    const bool mine = std::find(ours.begin(), ours.end(), contender.label()) != ours.end();
    const ivp::MethodInfo& method = comparison::any_method(contender.name);
    if (method.is_peer() && method.family != ivp::Family::implicit) libraries.push_back(contender);
    if (!mine) continue;
    if (const auto work = fastest(c, contender)) all.push_back(*work);
  }
  if (const auto best = best_library(c, libraries, native)) {
    fmt::print("{}, best library: {}\n", c.name, best->name);
    all.push_back({c.name + ", best library", best->run});
  }
  return all;
}

/// The same method on the same problem, behind the virtual interface and inlined.
std::vector<Work> erasure() {
  const auto run = [](const auto& system) {
    auto end = ivp::integrate(system, ivp::State{1, 0}, 0, 500, ivp::Rk4{.step = 0.02});
    benchmark::DoNotOptimize(end);
  };
  return {{"rk4 through System", [run, system = ivp::System(chapters::PlainDuffing{})] { run(system); }},
          {"rk4 inlined", [run, system = ivp::Direct(chapters::PlainDuffing{})] { run(system); }}};
}

/// What the chapter says of speed: that collocation as the dissertation writes it does not win, and what
/// nodes alone would change.
std::vector<scene::SpeedClaim> claims(const std::vector<Work>& all) {
  const auto has = [&all](const std::string& name) {
    return std::any_of(all.begin(), all.end(), [&](const Work& w) { return w.name == name; });
  };
  std::vector<scene::SpeedClaim> out;
  const auto add = [&](const std::string& fast, const std::string& slow, double least) {
    if (has(fast) && has(slow)) out.push_back({fmt::format("{} against {}", fast, slow), fast, slow, least});
  };
  add("duffing, best library", "duffing, lgl-coll, N = 35", 5);
  add("three-masses, best library", "three-masses, lgl-coll, N = 35", 20);
  add("three-masses, best library", "three-masses, rbf-coll, N = 35", 20);
  add("duffing, radau-coll, N = 17", "duffing, lgl-coll, N = 35", 1.5);
  add("three-masses, radau-coll, N = 17", "three-masses, lgl-coll, N = 35", 1.5);
  add("rk4 through System", "rk4 inlined", 0.5);  // at most twice the time
  return out;
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);

  const std::vector<std::string> ours = {"rbf-coll, N = 35", "lgl-coll, N = 35", "radau-coll, N = 17",
                                         "mcpi, N = 17", "rk6"};
  const chapters::PlainDuffing duffing;
  static const Case free = chapters::rbf_ivp::compiled(chapters::rbf_ivp::free_duffing_case(), duffing);
  const chapters::PlainChain chain;
  std::vector<Work> all = rivals(free, chapters::rbf_ivp::free_duffing_steps(), ours,
                                 chapters::rbf_ivp::native_peers(duffing, duffing));
  static const Case masses = chapters::rbf_ivp::compiled(chapters::rbf_ivp::three_mass_case(), chain);
  for (const Work& w : rivals(masses, chapters::rbf_ivp::three_mass_steps(), ours,
                              chapters::rbf_ivp::native_peers(chain, chain)))
    all.push_back(w);
  for (const Work& w : erasure()) all.push_back(w);
  return chapters::judge_speed("rbf_ivp", claims(all), chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("rbf_ivp_bench", &bench, argc, argv); }
