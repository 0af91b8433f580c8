/// @file
/// `rbf_inverse_lambert_bench`: solution of Lambert's problem by Izzo's method against the claim of half a
/// microsecond and against collocation, and grids of transfers with one and two threads, by Google Benchmark.
/// Writes results/bench/rbf_inverse_lambert.json under the current folder; exit code 1 if a claim fails.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/lambert/printed_transfer.hpp"
#include "chapters/speed.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/transfer/porkchop.hpp"
#include "nlmech/orbit/transfer/transfer.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace {

using namespace nlmech;

constexpr int solves = 1000;

/// Random problems: ellipses, hyperbolas, short and long ways, times from 0.1 to 10.
std::vector<orbit::LambertProblem> problems() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<orbit::LambertProblem> made(solves);
  for (orbit::LambertProblem& p : made) {
    p.from = {normal(engine), normal(engine), normal(engine)};
    p.to = {normal(engine), normal(engine), normal(engine)};
    p.time = std::pow(10, 2 * uniform(engine) - 1);
  }
  return made;
}

/// Grid of transfers between orbits like those of Earth and Mars.
orbit::PorkchopProblem grid(int count) {
  constexpr double mu = 1.32712440018e20, au = 1.495978707e11, day = 86400;
  orbit::PorkchopProblem p;
  p.mu = mu;
  p.from.state = orbit::state_of(orbit::from_axis(au, 0.0167, 0, 0, 1.8, 0), mu);
  p.to.state = orbit::state_of(orbit::from_axis(1.523679 * au, 0.0934, 0.0323, 0.865, 5.0, 0.3), mu);
  p.departures = {0, 780 * day, count};
  p.arrivals = {100 * day, 1500 * day, count};
  return p;
}

/// Wall times of a whole grid, in microseconds, repeated: CPU time would add up both threads.
scene::BenchSeries wall(const std::string& name, int threads, int times) {
  const orbit::PorkchopProblem p = grid(2000);
  scene::BenchSeries series{name, "us a run", {}};
  for (int k = 0; k < times; ++k) {
    const Stopwatch watch;
    benchmark::DoNotOptimize(orbit::porkchop(p, threads).cells.data());
    series.repetition.push_back(1e6 * watch.seconds());
  }
  return series;
}

void rows(chapters::Speed& all) {
  using enum orbit::TransferEquations;
  const std::string many = fmt::format("{} solves by Izzo's method", solves),
                    one = "the printed transfer by Izzo's method",
                    collocated = "the printed transfer by collocation of positions",
                    printed = "the printed transfer by collocation, 6N equations";
  all.add(many, [lambert = problems()] {
    bool long_way = false;
    for (const orbit::LambertProblem& p : lambert) {
      long_way = !long_way;
      benchmark::DoNotOptimize(orbit::solve_lambert(p, {long_way, 0, orbit::LambertBranch::low}).v1);
    }
  });
  const orbit::TransferProblem p = chapters::rbf_inverse::printed_transfer();
  all.add(one, [l = orbit::LambertProblem{p.from, p.to, p.time, p.gravity.mu}] {
    return orbit::solve_lambert(l).v1;
  });
  all.add(collocated, [p] { return orbit::collocate(p, {.equations = positions}).v1; });
  all.add(printed, [p] { return orbit::collocate(p, {.equations = positions_and_velocities}).v1; });
  const std::string budget = fmt::format("half a microsecond for each of {} solves", solves),
                    five = "five seconds",
                    one_thread = "grid of 2000 x 2000 cells, one thread, time on the wall",
                    two_threads = "grid of 2000 x 2000 cells, two threads, time on the wall";
  all.add_budget(budget, 0.5 * solves);
  all.add_budget(five, 5e6);
  all.add(wall(one_thread, 1, 5));
  all.add(wall(two_threads, 2, 5));
  all.claim(many, budget, 1, "Lambert's problem in half a microsecond");
  all.claim(one, collocated, 500, "Izzo's method against collocation of positions, one transfer");
  all.claim(one, printed, 2000, "Izzo's method against the printed 6N equations, one transfer");
  all.claim(two_threads, five, 1, "a grid of 2000 x 2000 cells in five seconds on two processors");
  all.claim(two_threads, one_thread, 1.5, "two threads against one on a grid");
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("rbf_inverse_lambert", &rows, argc, argv);
}
