/// @file
/// `integrators_bench`: what a typed equation costs beside the same problem in C++, both behind the
/// interface that all methods see: right-hand sides, and steps of the Taylor series. By Google Benchmark;
/// writes results/bench/integrators.json under the current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "chapters/integrators/typed_problems.hpp"
#include "chapters/speed.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/program/problem.hpp"

namespace {

using namespace nlmech;

constexpr double most_rhs = 3, most_step = 1.3;  // times the time of the same problem in C++

/// A piece of work that is measured.
struct Work {
  std::string name;
  std::function<void()> run;
};

// A chain of right-hand sides, each a little away from the last.
Work right_hand_sides(std::string name, const ivp::System& system, const ivp::State& x0) {
  return {std::move(name), [system, x0] {
            ivp::State x = x0, f;
            for (int i = 0; i < 1000; ++i) {
              system.rhs(1e-3 * i, x, f);
              x = x0 + 1e-9 * f;
            }
            benchmark::DoNotOptimize(x);
          }};
}
Work steps(std::string name, const ivp::System& system, const ivp::State& x0) {
  return {std::move(name), [system, x0] {
            const auto end = ivp::integrate(system, x0, 0, 5, ivp::Series{});
            benchmark::DoNotOptimize(end.x[0]);
          }};
}

template <class Problem>
void add(const std::string& name, std::vector<Work>& all, std::vector<scene::SpeedClaim>& claims) {
  const ivp::System written(Problem{}),
      typed(program::Problem(program::Equations({name, std::string(Problem::text)})));
  const auto pair = [&](const std::string& what, auto work, double most) {
    const std::string ours = fmt::format("{}, {} typed", name, what),
                      theirs = fmt::format("{}, {} in C++", name, what);
    all.push_back(work(ours, typed, Problem::state()));
    all.push_back(work(theirs, written, Problem::state()));
    claims.push_back({fmt::format("{} against {}", ours, theirs), ours, theirs, 1 / most});
  };
  pair("1000 right-hand sides", right_hand_sides, most_rhs);
  pair("series to t = 5", steps, most_step);
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  std::vector<Work> all;
  std::vector<scene::SpeedClaim> claims;
  using namespace chapters::integrators;
  add<Ueda>("duffing", all, claims);
  add<Convection>("lorenz", all, claims);
  add<Relaxation>("van-der-pol", all, claims);
  add<DoublePendulum>("double-pendulum", all, claims);
  add<Satellite>("satellite", all, claims);
  return chapters::judge_speed("integrators", claims, chapters::measure_speed(all));
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("integrators_bench", &bench, argc, argv);
}
