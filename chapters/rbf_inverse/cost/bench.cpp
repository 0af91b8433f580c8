/// @file
/// `rbf_inverse_bench`: nine digits of the initial co-states of the Duffing cases by refined intervals, by
/// one polynomial and by multiple shooting with CVODE, and a direct start by nlmech's descent and by Ipopt,
/// by Google Benchmark. Exit code 1 if a claim fails.
#include <algorithm>
#include <cmath>
#include <string>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "chapters/rbf_inverse/control/shooting_methods.hpp"
#include "chapters/speed.hpp"
#include "nlmech/peers/bvp/ipopt.hpp"

namespace {

using namespace nlmech;
namespace inverse = chapters::rbf_inverse;
using bvp::DuffingCase;
using Eigen::VectorXd;

/// Case with the common start of all methods, which is not timed.
struct Subject : inverse::ControlStart {
  /// Whether both initial co-states have nine correct digits.
  [[nodiscard]] bool right(const Status& status, const VectorXd& first) const {
    if (!status.ok()) return false;
    const double size = std::max(std::abs(known.first[2]), std::abs(known.first[3]));
    return std::abs(first[2] - known.first[2]) <= 1e-9 * size &&
           std::abs(first[3] - known.first[3]) <= 1e-9 * size;
  }
};

/// Adds the measurements, with the least accurate settings that give nine digits in both cases.
/// @param s must outlive the measurement
void add_rows(chapters::Speed& all, const Subject& s) {
  const auto named = [&s](const char* method) {
    return fmt::format("{}, {}", method, to_string(s.known.which));
  };
  const char *refined = "refined intervals", *one = "one polynomial", *shooting = "multiple shooting";
  all.add(named(refined), [&s] {
    const bvp::Solution r = solve(s.problem, s.start, {.nodes = 6, .intervals = 3, .tolerance = 1e-6});
    return s.right(r.status, r.first());
  });
  all.add(named(one), [&s] {
    const bvp::GlobalResult r = solve_global(s.problem,
                                             {.nodes = s.known.which == DuffingCase::free ? 25 : 60,
                                              .derivative = bvp::DerivativeMatrix::polynomial,
                                              .rows = printed_rows(s.problem)},
                                             s.start, 0.1, true);
    return s.right(r.extremal.solution.status, r.extremal.solution.first());
  });
  all.add(named("own direct start"),
          [&s] { return direct_start(s.problem, s.guess, {.pieces = 200}).status.ok(); });
  if (inverse::multiple_shooting_available())
    all.add(named(shooting), [&s] {
      const inverse::ShootingResult r = inverse::shoot(s.problem, s.start, {.tolerance = 1e-10});
      return s.right(r.status, r.first);
    });
  if (peers::ipopt_available())
    all.add(named("ipopt"),
            [&s] { return peers::ipopt_start(s.problem, s.guess, {.pieces = 200}).status.ok(); });
  all.claim(named(refined), named(shooting), 2,
            named("nine digits by refined intervals against multiple shooting with CVODE"));
  all.claim(named(refined), named(one), 1.2,
            named("nine digits by refined intervals against one polynomial"));
}

void rows(chapters::Speed& all) {
  static const Subject subjects[] = {{inverse::known_extremal(DuffingCase::free)},
                                     {inverse::known_extremal(DuffingCase::fixed)}};
  for (const Subject& s : subjects) add_rows(all, s);
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("rbf_inverse", &rows, argc, argv); }
