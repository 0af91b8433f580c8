#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_inverse/commands/commands.hpp"
#include "chapters/rbf_inverse/commands/typed_boundary.hpp"
#include "nlmech/bvp/solve.hpp"
#include "nlmech/comparison/commands/run_figure.hpp"
#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

struct BvpOptions {
  std::string equation, file, begin, end, guess, plot;
  std::vector<std::string> set;
  double from = 0, until = 0, tolerance = 1e-9;
  std::optional<double> every;
};

void declare(scene::Options& options, BvpOptions& typed) {
  options.add("--equation", typed.equation,
              "an equation, or several separated by ;: \"x'' + a exp(x) = 0; a = 1\". An unknown constant is "
              "a component: k' = 0");
  options.add("--file", typed.file, "a file of equations and definitions");
  options.add("--set", typed.set, "name=value of a parameter; separate several by blanks");
  options.add("--begin", typed.begin, "conditions at --from, separated by commas: \"x = 0, x' + 2 x = 1\"");
  options.add("--end", typed.end, "conditions at --until");
  options.add("--from", typed.from, "start of the interval");
  options.add("--until", typed.until, "end of the interval, later than --from").required();
  options.add(
      "--guess", typed.guess,
      "initial guess as functions of t: \"x = sin(pi t), k = 10\". A component without a function is the "
      "derivative of a given one, or 0. Default: zeros, then random cubics, the same in each run");
  options.add("--tolerance", typed.tolerance, "tolerance on x' - f, relative to 1 and the largest f")
      .range(1e-13, 0.1);
  options.add("--every", typed.every, "time between rows (default: rows at the nodes of the collocation)")
      .positive();
  options.add("--plot", typed.plot,
              "NAME.svg: plot of the unknowns against time; replaces only an older such picture");
}

TypedBoundary problem_of(const BvpOptions& typed) {
  if (typed.equation.empty() == typed.file.empty())
    throw InputError("give one of --equation TEXT and --file NAME.ode");
  if (!(typed.until > typed.from))
    throw input_error("--until {}: must be later than --from {}", typed.until, typed.from);
  program::SourceText source = typed.file.empty()
                                   ? program::SourceText("--equation", typed.equation)
                                   : program::SourceText(typed.file, comparison::read_equations(typed.file));
  return {program::Equations(std::move(source), comparison::settings_of(typed.set)), typed.from, typed.until,
          typed.begin, typed.end};
}

bvp::Options options_of(const BvpOptions& typed) {
  bvp::Options options;
  options.tolerance = typed.tolerance;
  options.verification = bvp::Verification::pieces;
  options.verification_tolerance = std::max(1e-10, 100 * typed.tolerance);
  return options;
}

/// Each interval divided into four.
std::vector<double> quartered(const std::vector<double>& times) {
  std::vector<double> finer;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    for (int k = 0; k < 4; ++k) finer.push_back(times[i] + (times[i + 1] - times[i]) * k / 4);
  }
  finer.push_back(times.back());
  return finer;
}

/// Solves, and divides the intervals by four as long as the integration deviates from the solution within one
/// of them: in and after a boundary layer adjacent trajectories diverge within a fraction of the interval.
bvp::Solution solve_on_finer_meshes(const TypedBoundary& problem, bvp::Start start, const BvpOptions& typed) {
  start.mesh = problem.mesh();
  bvp::Options options = options_of(typed);
  options.most_intervals = 20'000;
  bvp::Solution solution = solve(problem, start, options);
  options.refine = false;
  for (int i = 0; i < 5 && solution.status.outcome() == Outcome::spurious_root; ++i) {
    bvp::Start finer = start_from(solution);
    finer.mesh = quartered(solution.mesh());
    if (finer.mesh.size() > static_cast<std::size_t>(options.most_intervals)) break;
    solution = solve(problem, finer, options);
  }
  return solution;
}

/// Solves from the guess, or without one from zeros and then from random cubics of increasing size.
bvp::Solution solve_from_guesses(const TypedBoundary& problem, const BvpOptions& typed, std::string& remark) {
  bvp::Solution first = solve_on_finer_meshes(problem, problem.guess(typed.guess), typed);
  if (first.status.ok()) return first;
  if (typed.guess.empty()) {
    unsigned seed = 0;
    for (const double size : {0.1, 1., 10., 100.}) {
      for (int i = 0; i < 5; ++i) {
        const Eigen::VectorXd amplitudes = Eigen::VectorXd::Constant(problem.states(), size);
        bvp::Solution next = solve_on_finer_meshes(
            problem, bvp::random_start(amplitudes, typed.from, typed.until, ++seed), typed);
        if (!next.status.ok()) continue;
        remark = fmt::format(
            "no solution was found from zeros; this one is from random cubic {} of size {}; for another one "
            "give a --guess",
            seed, size);
        return next;
      }
    }
  }
  throw Failure(Status::failure(
      first.status.outcome(),
      fmt::format("{}; {}", first.status.sentence(),
                  typed.guess.empty() ? "no solution from 20 random cubics either; give a --guess"
                                      : "give another --guess")));
}

/// Result of an integration from the initial values to the end: empty if it agrees with the solution, else a
/// message with the deviation.
std::string check_whole_integration(const TypedBoundary& problem, const BvpOptions& typed,
                                    const bvp::Solution& solution) {
  bvp::Options options = options_of(typed);
  options.verification = bvp::Verification::whole;
  bvp::Solution copy = solution;
  verify_by_integration(problem, options, copy);
  if (copy.status.ok()) return {};
  const double off = copy.integration_error;
  return fmt::format(
      "verified by integration over each of {} intervals; an integration from the start alone leaves it{}, "
      "because rounding errors grow: the solution is determined by both ends",
      solution.mesh().size() - 1, std::isfinite(off) ? fmt::format(" ({:.1g} off)", off) : "");
}

std::vector<double> times_of(const BvpOptions& typed, const bvp::Solution& solution) {
  if (!typed.every) return solution.node_times();
  const double length = typed.until - typed.from, count = std::ceil(length / *typed.every - 1e-9);
  if (count > 1e6) throw input_error("--every {}: more than a million rows", *typed.every);
  std::vector<double> times;
  for (int i = 0; i < static_cast<int>(count); ++i) times.push_back(typed.from + i * *typed.every);
  times.push_back(typed.until);
  return times;
}

comparison::PlotSamples samples_of(const TypedBoundary& problem, const BvpOptions& typed,
                                   const bvp::Solution& solution) {
  comparison::PlotSamples samples;
  for (const std::string& name : problem.names()) samples.components.push_back({name, !name.ends_with('\'')});
  samples.path = comparison::SampledPath(typed.from, typed.until);
  constexpr int count = 1000;
  for (int i = 0; i <= count; ++i) {
    const double t = typed.from + (typed.until - typed.from) * i / count;
    samples.path.add(t, solution.at(t));
  }
  return samples;
}

void boundary_values(const BvpOptions& typed) {
  const TypedBoundary problem = problem_of(typed);
  const scene::Picture picture(typed.plot);
  std::string remark;
  const bvp::Solution solution = solve_from_guesses(problem, typed, remark);
  const std::string length = check_whole_integration(problem, typed, solution);
  std::string text = "t";
  for (const std::string& name : problem.names()) text.append(",").append(scene::csv_field(name));
  text += "\n";
  const Eigen::VectorXd sizes = solution.node_values().cwiseAbs().rowwise().maxCoeff();
  for (const double t : times_of(typed, solution)) {
    text += fmt::format("{:.17g}", t);
    const Eigen::VectorXd x = solution.at(t);
    // A value prescribed as 0 has the rounding error of the solve.
    for (Eigen::Index i = 0; i < x.size(); ++i)
      text += fmt::format(",{:.17g}", std::abs(x[i]) < 1e-18 * sizes[i] ? 0 : x[i]);
    text += "\n";
  }
  for (const std::string& said : {remark, length}) {
    if (!said.empty()) scene::print_message("rbf_inverse: " + said);
  }
  scene::print_result(text);
  if (picture.wanted())
    picture.draw([&] {
      return run_figure(
          samples_of(problem, typed, solution),
          quoted_input(
              typed.file.empty() ? typed.equation : std::filesystem::path(typed.file).filename().string(),
              60));
    });
}

}  // namespace

void add_bvp_command(scene::Commands& all) {
  all.add("bvp",
          "Solve a boundary value problem, equations with conditions at two times, by collocation on a mesh "
          "adapted to the residual; prints t,x,x',... as CSV, verified by integration",
          declare, boundary_values);
}

}  // namespace nlmech::chapters::rbf_inverse
