#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_inverse/commands/commands.hpp"
#include "nlmech/bvp/typed/typed_control.hpp"
#include "nlmech/comparison/commands/run_figure.hpp"
#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

using bvp::ControlSolution;
using bvp::TypedControl;

struct ControlOptions {
  std::string equation, file, control, minimise, conditions, bounds, state_bounds, from, until, guess, plot;
  std::vector<std::string> set;
  double tolerance = 1e-9;
  std::optional<double> every;
};

void declare_control(scene::Options& options, ControlOptions& typed) {
  options.add("--equation", typed.equation,
              "equations of motion, definitions and conditions separated by ;: \"x'' = u - x; x(0) = 0\"");
  options.add("--file", typed.file, "a file of equations, definitions and conditions");
  options.add("--set", typed.set, "name=value of a parameter; separate several by blanks");
  options.add("--control", typed.control, "names of the controls, separated by commas").required();
  options
      .add("--minimise", typed.minimise,
           "the cost: integrals over the whole interval, values at points, and the free end: "
           "\"integral(u^2/2) + "
           "x(2)^2\", \"T\"")
      .required();
  options.add("--conditions", typed.conditions,
              "further conditions, separated by ; or commas: \"x(0) = 0; x'(0.3) = 7; x(T) = 1\"");
  options.add("--bounds", typed.bounds, "bounds of controls: \"-1 <= u <= 1; 0 <= v\"");
  options.add("--state-bounds", typed.state_bounds,
              "bounds of states at all times: \"x <= 1.2; x^2 + y^2 <= 4\"");
  options.add("--from", typed.from, "start of the interval (default: the first time of a condition)");
  options.add("--until", typed.until,
              "end of the interval: a number, or a name for a free end: \"T\" (default: the last time of a "
              "condition)");
  options.add(
      "--guess", typed.guess,
      "functions of t for the controls, initial values of states, the free end: \"u = sin(t), x = 1, T "
      "= 3\". Default: several controls and ends, zeros");
  options.add("--tolerance", typed.tolerance, "tolerance on x' - f, relative to the size of f")
      .range(1e-13, 0.1);
  options.add("--every", typed.every, "time between rows (default: rows at the nodes of the collocation)")
      .positive();
  options.add("--plot", typed.plot,
              "NAME.svg: plot of states and controls against time; replaces only an older such picture");
}

TypedControl problem_of_control(const ControlOptions& typed) {
  if (typed.equation.empty() == typed.file.empty())
    throw InputError("give one of --equation TEXT and --file NAME.ode");
  bvp::ControlText text;
  text.name = typed.file.empty() ? "--equation" : typed.file;
  text.equations = typed.file.empty() ? typed.equation : comparison::read_equations(typed.file);
  text.settings = comparison::settings_of(typed.set);
  text.controls = bvp::names_in("--control", typed.control);
  text.minimise = typed.minimise;
  text.conditions = typed.conditions;
  text.bounds = typed.bounds;
  text.state_bounds = typed.state_bounds;
  text.from = typed.from;
  text.until = typed.until;
  return TypedControl(text);
}

/// A row of the result: time, states, co-states, controls, multipliers of bounds on states.
struct ControlRow {
  double t;
  std::vector<double> values;
};

/// Values at time @p s of the problem.
ControlRow row_at(const TypedControl& problem, const ControlSolution& found, double s, bvp::Side side) {
  const Eigen::VectorXd wide = found.at(s, side);
  const auto& necessary = found.problem->necessary();
  const auto n = static_cast<Eigen::Index>(problem.state_names().size());
  const double scaled = found.problem->place(s, found.solution.parameters()).first;
  const auto [t, rate] = problem.true_time(scaled, wide.head(necessary.n));
  ControlRow row{t, {}};
  for (Eigen::Index i = 0; i < n; ++i) row.values.push_back(wide[i]);
  for (Eigen::Index i = 0; i < n; ++i) row.values.push_back(wide[necessary.n + i]);
  for (Eigen::Index i = 0; i < necessary.q; ++i) row.values.push_back(wide[2L * necessary.n + i]);
  // The r-th derivative of a bound has the r-th power of the rate, H the first.
  for (int k = 0; k < necessary.bounds; ++k) {
    const auto order = static_cast<double>(necessary.tangency[static_cast<std::size_t>(k)].size());
    row.values.push_back(wide[2L * necessary.n + necessary.q + k] * std::pow(rate, order - 1));
  }
  return row;
}

/// Rows at the nodes of each arc; at a junction one before and one after it.
std::vector<ControlRow> rows_of_control(const TypedControl& problem, const ControlSolution& found,
                                        std::optional<double> every) {
  std::vector<ControlRow> rows;
  if (!every) {
    const auto arcs = static_cast<double>(found.problem->phases());
    for (const double s : found.solution.node_times()) {
      const bool is_junction = s == std::floor(s) && s > 0 && s < arcs;
      if (is_junction) rows.push_back(row_at(problem, found, s, bvp::Side::before));
      rows.push_back(row_at(problem, found, s, bvp::Side::after));
    }
    return rows;
  }
  const Eigen::VectorXd& p = found.solution.parameters();
  const std::vector<double> times = found.problem->times(p);
  const auto [from, rate] = problem.true_time(times.front(), found.solution.first());
  const double until = problem.true_time(times.back(), found.solution.first()).first;
  const double count = std::ceil((until - from) / *every - 1e-9);
  if (count > 1e6) throw input_error("--every {}: more than a million rows", *every);
  for (int i = 0; i <= static_cast<int>(count); ++i) {
    const double t = i == static_cast<int>(count) ? times.back() : times.front() + i * *every / rate;
    const auto arc = std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(times, t) - times.begin() - 1, 0,
                                                found.problem->phases() - 1);
    const auto k = static_cast<std::size_t>(arc);
    const double s = static_cast<double>(arc) + std::min(1.0, (t - times[k]) / (times[k + 1] - times[k]));
    rows.push_back(row_at(problem, found, s, bvp::Side::after));
  }
  return rows;
}

/// "u = 1, on x <= 1.2"
std::string description(const TypedControl& problem, const bvp::Arc& arc) {
  std::vector<std::string> parts;
  const auto& necessary = problem.problem();
  for (std::size_t i = 0; i < arc.controls.size(); ++i) {
    const std::string& u = problem.control_names()[i];
    switch (arc.controls[i]) {
      case bvp::ControlMode::interior: parts.push_back(u + " between its bounds"); break;
      case bvp::ControlMode::low: parts.push_back(fmt::format("{} = {:.6g}", u, necessary.low[i])); break;
      case bvp::ControlMode::high: parts.push_back(fmt::format("{} = {:.6g}", u, necessary.high[i])); break;
      case bvp::ControlMode::singular: parts.push_back(u + " singular");
    }
  }
  for (std::size_t k = 0; k < arc.on_bound.size(); ++k) {
    if (arc.on_bound[k]) parts.push_back("on " + problem.bound_texts()[k]);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// One line for each arc, and for each multiplier.
void print_arcs(const TypedControl& problem, const ControlSolution& found) {
  const Eigen::VectorXd& p = found.solution.parameters();
  const std::vector<double> times = found.problem->times(p);
  const auto true_time = [&](double t) { return problem.true_time(t, found.solution.first()).first; };
  const auto& junctions = found.problem->junctions();
  for (int k = 0; !junctions.empty() && k < found.problem->phases(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    scene::print_message(fmt::format("rbf_inverse: from {:.10g} to {:.10g}: {}", true_time(times[i]),
                                     true_time(times[i + 1]),
                                     description(problem, found.problem->arc(k).arc())));
  }
  for (std::size_t j = 0; j < junctions.size(); ++j) {
    const Eigen::VectorXd pi = found.problem->jump_multipliers(j, p);
    if (pi.size() == 0) continue;
    const bool touches = junctions[j].kind == bvp::JunctionKind::contact;
    scene::print_message(fmt::format("rbf_inverse: at {:.10g} {} {}: multipliers {:.10g}",
                                     true_time(times[j + 1]), touches ? "contact with" : "entry to",
                                     problem.bound_texts()[static_cast<std::size_t>(junctions[j].index)],
                                     fmt::join(pi, ", ")));
  }
  for (std::size_t k = 0; k < problem.condition_texts().size(); ++k)
    scene::print_message(fmt::format("rbf_inverse: multiplier of {}: {:.10g}", problem.condition_texts()[k],
                                     p[static_cast<Eigen::Index>(k)]));
}

void print_summary(const TypedControl& problem, const ControlSolution& found) {
  std::string text = fmt::format("rbf_inverse: cost {:.12g}", found.cost);
  const double last = static_cast<double>(found.problem->phases());
  if (problem.has_free_end())
    text +=
        fmt::format(", {} = {:.12g}", problem.end_name(), problem.true_time(1, found.solution.first()).first);
  double least = found.hamiltonian(0), most = least;
  for (const double s : found.solution.node_times()) {
    for (const bvp::Side side : {bvp::Side::before, bvp::Side::after}) {
      const double h = found.hamiltonian(std::min(s, last), side);
      least = std::min(least, h);
      most = std::max(most, h);
    }
  }
  const double rate = problem.true_time(0, found.solution.first()).second;
  text += fmt::format("; Hamiltonian from {:.10g} to {:.10g}; deviation of an integration {:.1g}",
                      least / rate, most / rate, found.solution.integration_error);
  if (found.second_order.kind != bvp::Kind::untested)
    text += fmt::format("; second variation: {}", to_string(found.second_order.kind));
  if (found.extremals > 1) text += fmt::format("; the least of {} extremals found", found.extremals);
  scene::print_message(text);
  print_arcs(problem, found);
}

comparison::PlotSamples samples_of_control(const TypedControl& problem, const std::vector<ControlRow>& rows) {
  comparison::PlotSamples samples;
  const std::size_t n = problem.state_names().size();
  for (const std::string& name : problem.state_names()) samples.components.push_back({name});
  for (const std::string& name : problem.control_names()) samples.components.push_back({name});
  samples.path = comparison::SampledPath(rows.front().t, rows.back().t);
  for (const ControlRow& row : rows) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(samples.components.size()));
    for (std::size_t i = 0; i < samples.components.size(); ++i)
      values[static_cast<Eigen::Index>(i)] = row.values[i < n ? i : i + n];
    samples.path.add(row.t, values);
  }
  return samples;
}

void control(const ControlOptions& typed) {
  const scene::Picture picture(typed.plot);
  const TypedControl problem = problem_of_control(typed);
  bvp::Options options;
  options.tolerance = typed.tolerance;
  options.newton_tolerance = typed.tolerance;
  options.verification = bvp::Verification::pieces;
  options.verification_tolerance = std::max(1e-10, 100 * typed.tolerance);
  const ControlSolution found = solve_control(problem.problem(), problem.guesses(typed.guess), options);
  if (!found.status.ok()) throw Failure(found.status);
  std::string text = "t";
  for (const std::string& name : problem.state_names()) text.append(",").append(scene::csv_field(name));
  for (const std::string& name : problem.state_names())
    text.append(",lambda_").append(scene::csv_field(name));
  for (const std::string& name : problem.control_names()) text.append(",").append(name);
  for (std::size_t k = 1; k <= problem.bound_texts().size(); ++k) text += fmt::format(",mu_{}", k);
  text += "\n";
  for (const ControlRow& row : rows_of_control(problem, found, typed.every)) {
    text += fmt::format("{:.17g}", row.t);
    for (const double value : row.values)
      text += fmt::format(",{:.17g}", std::abs(value) < 1e-18 ? 0 : value);
    text += "\n";
  }
  print_summary(problem, found);
  scene::print_result(text);
  if (picture.wanted())
    picture.draw([&] {
      return run_figure(
          samples_of_control(problem, rows_of_control(problem, found, {})),
          quoted_input(
              typed.file.empty() ? typed.equation : std::filesystem::path(typed.file).filename().string(),
              60));
    });
}

}  // namespace

void add_control_command(scene::Commands& all) {
  all.add("control",
          "Find the control of least cost between conditions, with bounds on controls and states, from "
          "Pontryagin's conditions; prints t, states, co-states, controls as CSV, verified by integration",
          declare_control, control);
}

}  // namespace nlmech::chapters::rbf_inverse
