/// @file
/// `integrators_bench`: what a typed equation costs beside the same problem in C++, both behind the
/// interface that all methods see: right-hand sides, and steps of the Taylor series. By Google Benchmark;
/// writes results/bench/integrators.json under the current folder; exit code 1 if a claim is not held.
#include <string>

#include "chapters/integrators/typed_problems.hpp"
#include "chapters/speed.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/series/series.hpp"
#include "nlmech/program/problem.hpp"

namespace {

using namespace nlmech;

constexpr double most_rhs = 3, most_step = 1.3;  // times the time of the same problem in C++

/// A chain of right-hand sides, each a little away from the last.
ivp::State right_hand_sides(const ivp::System& system, const ivp::State& x0) {
  ivp::State x = x0, f;
  for (int i = 0; i < 1000; ++i) {
    system.rhs(1e-3 * i, x, f);
    x = x0 + 1e-9 * f;
  }
  return x;
}

ivp::State steps(const ivp::System& system, const ivp::State& x0) {
  return ivp::integrate(system, x0, 0, 5, ivp::Series{}).x;
}

template <class Problem>
void add(chapters::Speed& all, const std::string& name) {
  const ivp::System written(Problem{}),
      typed(program::Problem(program::Equations({name, std::string(Problem::text)})));
  const auto pair = [&](const std::string& what, auto work, double most) {
    const std::string ours = fmt::format("{}, {} typed", name, what),
                      theirs = fmt::format("{}, {} in C++", name, what);
    all.add(ours, [=, x0 = ivp::State(Problem::state())] { return work(typed, x0); });
    all.add(theirs, [=, x0 = ivp::State(Problem::state())] { return work(written, x0); });
    all.claim(ours, theirs, 1 / most);
  };
  pair("1000 right-hand sides", &right_hand_sides, most_rhs);
  pair("series to t = 5", &steps, most_step);
}

void rows(chapters::Speed& all) {
  using namespace chapters::integrators;
  add<Ueda>(all, "duffing");
  add<Convection>(all, "lorenz");
  add<Relaxation>(all, "van-der-pol");
  add<DoublePendulum>(all, "double-pendulum");
  add<Satellite>(all, "satellite");
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("integrators", &rows, argc, argv); }
