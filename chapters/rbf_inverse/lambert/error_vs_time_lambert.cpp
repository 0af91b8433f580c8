#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/lambert/printed_transfer.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"

namespace nlmech::chapters::rbf_inverse::error_vs_time_lambert {
namespace {

using orbit::TransferEquations;

constexpr const char *izzo = "Izzo", *positions = "positions", *both = "6N equations";

/// Attempt whose error is the miss relative to the distance of the target.
scene::Attempt attempt(const std::string& setting, const orbit::TransferProblem& p, double miss,
                       Timing time) {
  return {setting, "success", std::max(miss / p.to.norm(), 1e-17), time, {miss}};
}

scene::Attempt closed_form(const orbit::TransferProblem& p, bool quick) {
  const orbit::LambertProblem lambert{p.from, p.to, p.time, p.gravity.mu};
  constexpr int solves = 10'000;  // one solve is as short as the resolution of the clock
  double sum = 0;                 // prevents the optimiser from removing calls
  const Timing t = time_repeats(
      [&] {
        for (int i = 0; i < solves; ++i) sum += orbit::solve_lambert(lambert).v1[0];
      },
      quick ? 3 : 9);
  const double n = sum == 0 ? 2 * solves : solves;
  return attempt("", p, orbit::miss_of(p, orbit::solve_lambert(lambert).v1),
                 {t.median / n, t.smallest / n, t.largest / n, t.repeats});
}

scene::MethodLine collocation(const std::string& name, TransferEquations equations,
                              const orbit::TransferProblem& p, bool quick) {
  scene::MethodLine line{name, 1, {}, scene::Side::subject};
  for (const int n : {21, 31, 41, 47, 61}) {
    const orbit::TransferCollocation method{.nodes = n, .equations = equations, .largest_miss = 0.01};
    const auto t = orbit::collocate(p, method);
    if (!t.status.ok()) continue;
    const auto work = [&] { static_cast<void>(orbit::collocate(p, method)); };
    line.attempts.push_back(
        attempt(fmt::format("{} nodes", n), p, t.miss, time_repeats(work, quick ? 3 : 9)));
  }
  return line;
}

scene::ProblemLines measure(bool quick) {
  const orbit::TransferProblem p = printed_transfer();
  return {"",
          {{izzo, 0, {closed_form(p, quick)}},
           collocation(positions, TransferEquations::positions, p, quick),
           collocation(both, TransferEquations::positions_and_velocities, p, quick)}};
}

void put(const scene::ProblemLines& all, scene::Show& show) {
  scene::show_work_precision(
      {.heading = "Digits against time: Izzo's method is the fastest and the most accurate",
       .digits = "digits of the final position: −log_{10}(miss/|{/:Bold r}_F|)",
       .most_digits = 17,
       .error = "miss over distance",
       .time = "time per solution (s)",
       .work = {"miss (m)"},
       .groups = {{"closed form", 0}, {"collocation", 2}}},
      {all}, show);
  const double scale = printed_transfer().to.norm();
  show.at_most("miss of Izzo's arc", {all.of(izzo).least_error() * scale, "m"}, 1e-6,
               "2e-9 to 7e-8 m; regression value; kappa eps |r_F| is 1e-7 m");
  show.at_most("least miss of collocation",
               {std::min(all.of(positions).least_error(), all.of(both).least_error()) * scale, "m"}, 1e-4,
               "6e-7 m; regression value with 61 nodes; rounding");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result lines(
      "lambert-times", "the printed transfer; polynomials, starts from an arc; medians of single threads",
      measure);
  return {{.name = "error-vs-time-lambert",
           .title = "Digits of the final position against time per solution",
           .content = scene::Content(put, lines)}};
}

}  // namespace nlmech::chapters::rbf_inverse::error_vs_time_lambert
