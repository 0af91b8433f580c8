#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/control/duffing_runs.hpp"
#include "chapters/rbf_inverse/control/shooting_methods.hpp"
#include "nlmech/peers/bvp/ipopt.hpp"
#include "nlmech/scene/work_precision.hpp"

namespace nlmech::chapters::rbf_inverse::error_vs_time_control {
namespace {

using bvp::DerivativeMatrix;
using bvp::DuffingCase;

constexpr const char *gaussian = "Gaussian, printed shape", *stable = "stable Gaussian, c T = 5",
                     *polynomial = "polynomial, one interval", *refined = "polynomial, refined",
                     *shooting = "multiple shooting, CVODE", *direct = "direct, own start",
                     *ipopt = "direct, Ipopt";
enum Group : std::size_t { many, one, by_shooting, directly };

/// Result of a solve: status, and x and lambda at 0.
struct Answer {
  Status status;
  Eigen::VectorXd first;
};
Answer answer_of(const bvp::Solution& s) { return {s.status, s.status.ok() ? s.first() : Eigen::VectorXd()}; }

/// One case; all methods start from the same trajectory.
struct Subject : ControlStart {
  bool quick;
  std::vector<scene::MethodLine>& lines;

  /// Starts a new line for the next settings.
  void begin(const char* method, Group group) const {
    const bool peer = method == shooting || method == ipopt;
    lines.push_back({method, group, {}, peer ? scene::Side::peer : scene::Side::subject});
  }
  void add(const std::string& setting, const std::function<Answer()>& solve) const {
    const auto ending_of = [&](const Answer& answer) -> scene::Ending {
      if (!answer.status.ok()) return {answer.status, {}};
      const Eigen::Vector2d right(known.first[2], known.first[3]), found = answer.first.tail<2>();
      return {answer.status,
              std::max((found - right).cwiseAbs().maxCoeff() / right.cwiseAbs().maxCoeff(), 1e-16)};
    };
    lines.back().attempts.push_back(scene::attempt(setting, solve, ending_of, quick));
  }
};

/// @param shape c T; 0: as in the text, proportional to the number of nodes
void one_interval(const Subject& s, const char* method, DerivativeMatrix derivative, double shape) {
  s.begin(method, one);
  for (const int nodes : {10, 15, 20, 25, 30, 40, 50, 60, 80}) {
    if (s.quick && nodes % 20 != 0) continue;
    const bvp::GlobalMethod global{.nodes = nodes,
                                   .relative_shape = shape > 0 ? shape : (nodes - 1) / 4.,
                                   .derivative = derivative,
                                   .rows = printed_rows(s.problem)};
    s.add(fmt::format("{} nodes", nodes),
          [&] { return answer_of(solve_global(s.problem, global, s.start, 0.1, true).extremal.solution); });
  }
}

void refined_intervals(const Subject& s) {
  s.begin(refined, many);
  for (int power = 3; power <= 12; power += s.quick ? 3 : 1) {
    const bvp::Options options{.nodes = 6, .intervals = 3, .tolerance = std::pow(10, -power)};
    s.add(fmt::format("tolerance 1e-{}", power),
          [&] { return answer_of(solve_extremal(s.problem, s.start, options).solution); });
  }
}

void multiple_shooting(const Subject& s) {
  s.begin(shooting, by_shooting);
  if (!multiple_shooting_available()) return;
  for (int power = 4; power <= 12; power += s.quick ? 4 : 1)
    s.add(fmt::format("tolerance 1e-{}", power), [&] {
      const ShootingResult shot = shoot(s.problem, s.start, {.tolerance = std::pow(10, -power)});
      return Answer{shot.status, shot.first};
    });
}

void direct_method(const Subject& s, const char* method) {
  s.begin(method, directly);
  if (method == ipopt && !peers::ipopt_available()) return;
  for (const int pieces : {50, 100, 200, 400, 800}) {
    if (s.quick && pieces > 100) continue;
    s.add(fmt::format("{} pieces", pieces), [&] {
      const bvp::DirectResult r = method == ipopt ? peers::ipopt_start(s.problem, s.guess, {.pieces = pieces})
                                                  : direct_start(s.problem, s.guess, {.pieces = pieces});
      Eigen::VectorXd z(4);
      if (r.status.ok()) r.start.states(0, z);
      return Answer{r.status, z};
    });
  }
}

std::vector<scene::ProblemLines> measure(bool quick) {
  std::vector<scene::ProblemLines> problems;
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const bool is_free = which == DuffingCase::free;
    auto& [name, lines] = problems.emplace_back();
    name = is_free ? "final state free" : "final state given";
    const Subject s{{known_extremal(which)}, quick, lines};
    one_interval(s, gaussian, DerivativeMatrix::gaussian, 0);
    one_interval(s, stable, DerivativeMatrix::stable_gaussian, 5);
    one_interval(s, polynomial, DerivativeMatrix::polynomial, 5);
    refined_intervals(s);
    multiple_shooting(s);
    direct_method(s, direct);
    direct_method(s, ipopt);
  }
  return problems;
}

void put(const std::vector<scene::ProblemLines>& problems, scene::Show& show) {
  scene::show_work_precision(
      {.heading = "Digits of {/:Italic λ}(0): lost with more nodes by printed Gaussians, not by refinement",
       .digits = "digits of {/:Italic λ}(0)",
       .most_digits = 16,
       .error = "error of the initial co-states",
       .groups = {{"collocation, refined", 0},
                  {"collocation, one interval", 2},
                  {"multiple shooting", 3},
                  {"direct methods", 5}}},
      problems, show);
  for (const DuffingCase which : {DuffingCase::free, DuffingCase::fixed}) {
    const std::string name = fmt::format(", {}", to_string(which));
    const scene::ProblemLines& problem = problems[which == DuffingCase::free ? 0 : 1];
    show.at_most("least error, polynomial, refined" + name, problem.of(refined).least_error(), 1e-10,
                 "a tolerance of 1e-12 against tools/oracles/rbf_inverse_extremals.py");
    double worst = 0;
    const std::vector<scene::Attempt>& attempts = problem.of(gaussian).attempts;
    for (std::size_t i = show.quick() ? 0 : 2; i < attempts.size(); ++i)
      worst = std::max(worst, attempts[i].error.value_or(HUGE_VAL));
    show.between("largest error of 20 and more nodes, Gaussian, printed shape" + name, worst, 1e-7, 1e-1,
                 "regression value: no convergence with the nodes");
    if (multiple_shooting_available())
      show.at_most("least error, multiple shooting" + name, problem.of(shooting).least_error(), 1e-8,
                   "a tolerance of 1e-12 in each step");
    show.at_most("least error, direct, own start" + name, problem.of(direct).least_error(),
                 show.quick() ? 0.1 : 1e-2,
                 "piecewise constant controls: of the second order in their length");
  }
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result rows(
      "times-control",
      "T = 2, S = I; all begin at the trajectory of a direct method of 40 pieces, which is not timed; direct "
      "methods begin without force; error of lambda(0) against 36 digits; one thread, median of repeats",
      measure);
  return {{.name = "error-vs-time-ocp",
           .title = "Digits of the initial co-states against time",
           .content = scene::Content(put, rows)}};
}

}  // namespace nlmech::chapters::rbf_inverse::error_vs_time_control
