#include "nlmech/bvp/optimal_control/solve_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "nlmech/bvp/optimal_control/arc_structure.hpp"
#include "nlmech/bvp/optimal_control/graph_model.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd ControlSolution::at(double s, Side side) const {
  const auto [t, k] = problem->place(s, solution.parameters());
  VectorXd wide;
  const bool before = side == Side::before && s == k && k > 0;
  problem->arc(before ? k - 1 : k).complete(t, solution.at(s, side), wide);
  return wide;
}

double ControlSolution::hamiltonian(double s, Side side) const {
  const NecessaryConditions& c = problem->necessary();
  const double t = problem->place(s, solution.parameters()).first;
  return Expressions(c.graph, {c.hamiltonian}).values(t, at(s, side))[0];
}

namespace {

/// Checks a solution between its nodes against the conditions that its equations do not contain.
class ArcCheck {
 public:
  explicit ArcCheck(const ControlSolution& found)
      : found_(found),
        problem_(*found.problem),
        c_(problem_.necessary()),
        by_control_(c_.graph, c_.by_control) {
    std::vector<program::NodeId> bounds;
    for (const auto& nodes : c_.tangency) bounds.push_back(nodes.front());
    bounds_ = Expressions(c_.graph, bounds);
    if (!c_.switching.empty()) singular_ = Expressions(c_.graph, {c_.switching[2]});
  }

  /// Empty, or what is violated.
  std::string violation() {
    const std::vector<double> times = problem_.times(found_.solution.parameters());
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
      if (!(times[k] < times[k + 1])) return "an arc has no length";
    }
    const int arcs = static_cast<int>(times.size()) - 1;
    constexpr int samples = 100;
    for (const bool measures : {true, false}) {
      for (int k = 0; k < arcs; ++k) {
        for (int i = 0; i <= samples; ++i) {
          const double s = std::min(k + static_cast<double>(i) / samples, std::nextafter(k + 1.0, 0.0));
          const double t = problem_.place(s, found_.solution.parameters()).first;
          std::string said = at(problem_.arc(k).arc(), t, found_.at(s), measures);
          if (!said.empty()) return said;
        }
      }
    }
    for (std::size_t j = 0; j < problem_.junctions().size(); ++j) {
      const VectorXd pi = problem_.jump_multipliers(j, found_.solution.parameters());
      if (pi.size() > 0 && pi[0] < -tolerance * pi.cwiseAbs().maxCoeff() - 1e-9)
        return "the multiplier of a bound on the states is negative";
    }
    return {};
  }

 private:
  static constexpr double tolerance = 1e-6;  // relative to the largest value along the trajectory

  std::string at(const Arc& arc, double t, const VectorXd& wide, bool measures) {
    const VectorXd slope = by_control_.values(t, wide), bounds = bounds_.values(t, wide);
    const VectorXd mu = wide.tail(c_.bounds);
    if (measures) {
      slope_ = std::max(slope_, slope.lpNorm<Eigen::Infinity>());
      if (c_.bounds > 0) {
        bound_ = std::max(bound_, wide.head(c_.n).lpNorm<Eigen::Infinity>());
        mu_ = std::max(mu_, mu.lpNorm<Eigen::Infinity>());
      }
      return {};
    }
    for (Index i = 0; i < c_.q; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double u = wide[2L * c_.n + i], small = tolerance * (1 + std::abs(u));
      if (!(u >= c_.low[k] - small && u <= c_.high[k] + small)) return "a control leaves its bounds";
      if (arc.controls[k] == ControlMode::low && slope[i] < -tolerance * slope_)
        return "H decreases from the lower bound of a control";
      if (arc.controls[k] == ControlMode::singular && std::abs(slope[i]) > tolerance * slope_)
        return "dH/du is not zero on a singular arc";
      if (arc.controls[k] == ControlMode::high && slope[i] > tolerance * slope_)
        return "H decreases from the upper bound of a control";
    }
    for (Index k = 0; k < c_.bounds; ++k) {
      if (!(bounds[k] <= tolerance * (1 + bound_))) return "a state leaves its bound";
      if (mu[k] < -tolerance * mu_) return "the multiplier of a bound on the states is negative";
    }
    return legendre(arc, t, wide);
  }

  /// Condition of Legendre and Clebsch, on singular arcs in Kelley's form.
  std::string legendre(const Arc& arc, double t, const VectorXd& wide) const {
    VectorXd values;
    MatrixXd by;
    const Index first = 1 + 2L * c_.n;
    by_control_.differentiate(t, wide, values, by);
    for (Index i = 0; i < c_.q; ++i) {
      const ControlMode mode = arc.controls[static_cast<std::size_t>(i)];
      const double curvature = by(i, first + i);
      if (mode == ControlMode::interior && curvature < -tolerance * by.rightCols(by.cols() - first).norm())
        return "Legendre's condition: H is largest at the control";
      if (mode != ControlMode::singular) continue;
      singular_.differentiate(t, wide, values, by);
      if (by(0, first) > 0) return "Kelley's condition: the singular arc maximises the cost";
    }
    return {};
  }

  const ControlSolution& found_;
  const ArcProblem& problem_;
  const NecessaryConditions& c_;
  Expressions by_control_, bounds_, singular_;
  double slope_ = 0, bound_ = 0, mu_ = 0;
};

/// A stage of the direct method.
struct Stage {
  Regularisation regularisation;
  bool holds_constants = false;  // are states with the slope 0, such as a free end, held at their guess?
};

/// First with a free end held, since the cost may be least without any motion as long as the weights of the
/// conditions are small; then with decreasing regularisation.
std::vector<Stage> stages_of(const ControlProblem& problem, const NecessaryConditions& necessary) {
  const bool is_regular =
      necessary.bounds == 0 && std::ranges::find(necessary.linear, true) == necessary.linear.end();
  const bool has_constants = std::ranges::any_of(
      problem.slopes, [&](program::NodeId slope) { return problem.graph.is_number(slope, 0); });
  std::vector<Stage> stages;
  if (has_constants) stages.push_back({is_regular ? Regularisation{} : Regularisation{0.1, 10}, true});
  if (is_regular)
    stages.push_back({});
  else
    for (const Regularisation& next : {Regularisation{0.1, 10}, {1e-2, 1e3}, {1e-3, 1e4}})
      stages.push_back({next});
  return stages;
}

/// Result of a direct method, with co-states by the adjoint equation.
DirectResult direct_result(const ControlProblem& problem,
                           const std::shared_ptr<const NecessaryConditions>& necessary, ControlGuess guess) {
  const auto to_vector = [](const std::vector<double>& v) {
    return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(v.size())));
  };
  DirectOptions options{.pieces = 200, .low = to_vector(problem.low), .high = to_vector(problem.high)};
  const double t0 = problem.points.front(), t1 = problem.points.back();
  const auto piece = [t0, t1, pieces = options.pieces](double t) { return (t - t0) / (t1 - t0) * pieces; };
  DirectResult result;
  for (const Stage& stage : stages_of(problem, *necessary)) {
    ControlTask task = task_of(problem);
    for (std::size_t i = 0; i < task.begin.size(); ++i) {
      if (stage.holds_constants && problem.graph.is_number(problem.slopes[i], 0))
        task.begin[i] = task.begin[i].value_or(guess.begin[static_cast<Index>(i)]);
    }
    result = direct_start(
        ExtremalProblem(std::make_shared<const GraphModel>(problem, necessary, stage.regularisation), task),
        guess, options);
    if (!result.status.ok()) return result;
    VectorXd z(2 * problem.states);
    result.start.states(t0, z);
    guess.begin = z.head(problem.states);
    guess.control = [controls = result.controls, piece](double t, VectorXd& u) {
      u = controls.col(
          static_cast<Index>(std::clamp(piece(t), 0.0, static_cast<double>(controls.cols() - 1))));
    };
    options.first_weight = 1000;
    options.rounds = 4;
  }
  result.start.states = [states = result.start.states, adjoint = result.adjoint, t0, t1](double t,
                                                                                         VectorXd& z) {
    states(t, z);
    const auto last = static_cast<double>(adjoint.cols() - 1);
    const double at = std::clamp((t - t0) / (t1 - t0), 0.0, 1.0) * last;
    const Index k = std::min<Index>(static_cast<Index>(at), adjoint.cols() - 2);
    const double share = at - static_cast<double>(k);
    z.tail(adjoint.rows()) = (1 - share) * adjoint.col(k) + share * adjoint.col(k + 1);
  };
  return result;
}

double cost_of(const ControlSolution& found) {
  const NecessaryConditions& c = found.problem->necessary();
  const VectorXd& p = found.solution.parameters();
  const Expressions running(c.graph, {c.running_cost});
  const std::vector<double> times = found.problem->times(p);
  double sum = 0;
  // Quadrature on each interval, so that at the ends of arcs it has the control of its own arc.
  const Scheme& scheme = *found.solution.scheme;
  for (const Interval& interval : found.solution.unknowns.intervals) {
    const auto k = static_cast<std::size_t>(interval.phase);
    const double stretch = times[k + 1] - times[k];
    for (Index j = 0; j < scheme.nodes.size(); ++j) {
      const double share = interval.t0 + scheme.nodes[j] * interval.h - interval.phase;
      const double t = times[k] + share * stretch;
      sum += interval.h * stretch * scheme.weights[j] *
             found.problem->arc(interval.phase).values(running, t, interval.values.col(j))[0];
    }
  }
  VectorXd ends = VectorXd::Zero(c.ends.size());
  const std::vector<double>& points = c.points;
  for (std::size_t j = 0, arc = 0; j < points.size(); ++j) {
    while (arc + 1 < times.size() && times[arc] < points[j]) ++arc;
    ends.segment(static_cast<Index>(j) * c.n, c.n) =
        (j + 1 == points.size() ? found.solution.last() : found.solution.at(static_cast<double>(arc)))
            .head(c.n);
  }
  return sum + Expressions(c.ends, {c.end_cost}).values(0, ends)[0];
}

/// The second variation, if no bound is active and all conditions prescribe values.
SecondOrder second_order_of(const ControlProblem& problem, const ControlSolution& found) {
  const auto& junctions = found.problem->junctions();
  const bool is_plain =
      std::ranges::all_of(junctions, [](const Junction& j) { return j.kind == JunctionKind::point; }) &&
      std::ranges::all_of(found.problem->arc(0).arc().controls,
                          [](ControlMode mode) { return mode == ControlMode::interior; }) &&
      prescribed_values(problem).size() == problem.conditions.size();
  if (!is_plain) return {};
  const ExtremalProblem task(
      std::make_shared<const GraphModel>(
          problem, std::make_shared<const NecessaryConditions>(found.problem->necessary()), Regularisation{}),
      task_of(problem));
  Solution in_time = found.solution;
  const std::vector<double> times = found.problem->times(in_time.parameters());
  for (Interval& interval : in_time.unknowns.intervals) {
    const auto k = static_cast<std::size_t>(interval.phase);
    const double stretch = times[k + 1] - times[k];
    interval.t0 = times[k] + (interval.t0 - interval.phase) * stretch;
    interval.h *= stretch;
    interval.slopes /= stretch;
  }
  in_time.unknowns.parameters.resize(0);
  return second_order(task, in_time);
}

/// Solves on one sequence of arcs.
ControlSolution solve_arcs(const std::shared_ptr<const NecessaryConditions>& necessary,
                           const ArcStructure& structure, const DirectResult& direct,
                           const Options& options) {
  ControlSolution found;
  std::shared_ptr<ArcProblem> problem;
  for (const Arc& arc : structure.arcs) {
    for (std::size_t i = 0; i < arc.controls.size(); ++i) {
      const bool is_on_bound = std::ranges::find(arc.on_bound, true) != arc.on_bound.end();
      if (arc.controls[i] != ControlMode::interior || !necessary->linear[i] || is_on_bound) continue;
      found.status = Status::failure(Outcome::not_converged,
                                     "a control in which H is linear stays between its bounds: singular arcs "
                                     "are found for one control only");
      return found;
    }
  }
  try {
    problem = std::make_shared<ArcProblem>(necessary, structure.arcs, structure.junctions);
  } catch (const std::invalid_argument& error) {
    found.status = Status::failure(Outcome::not_converged, error.what());
    return found;
  }
  MatrixXd at_points(2 * necessary->n, static_cast<Index>(necessary->points.size()));
  VectorXd z(2 * necessary->n);
  for (Index j = 0; j < at_points.cols(); ++j) {
    direct.start.states(necessary->points[static_cast<std::size_t>(j)], z);
    at_points.col(j) = z;
  }
  VectorXd sizes = VectorXd::Zero(2L * necessary->n);
  constexpr int samples = 100;
  const double t0 = necessary->points.front(), length = necessary->points.back() - t0;
  for (int i = 0; i <= samples; ++i) {
    direct.start.states(t0 + length * i / samples, z);
    sizes = sizes.cwiseMax(z.cwiseAbs());
  }
  problem->set_sizes(sizes.head(necessary->n), sizes.tail(necessary->n));
  const VectorXd p = problem->parameters_from(at_points);
  const Start start{
      [&](double s, VectorXd& x) { direct.start.states(problem->place(s, p).first, x); }, p, {}};
  found.problem = problem;
  found.solution = solve(*problem, start, options);
  found.status = found.solution.status;
  if (!found.status.ok()) return found;
  const std::string said = ArcCheck(found).violation();
  if (!said.empty())
    found.status = failed_with(Outcome::spurious_root, "the extremal that was found is no minimum: {}", said);
  else
    found.cost = cost_of(found);
  return found;
}

}  // namespace

namespace {

/// Is H quadratic in x and u with constant coefficients, and are all conditions values? Then there is one
/// extremal, as long as H is convex.
bool is_linear_quadratic(const ControlProblem& problem, const NecessaryConditions& necessary) {
  program::Graph graph = necessary.graph;
  std::vector<int> variables;
  for (int i = 0; i < necessary.n; ++i) variables.push_back(i);
  for (int i = 0; i < necessary.q; ++i) variables.push_back(2 * necessary.n + i);
  for (const int i : variables) {
    const program::NodeId slope = partials(graph, necessary.hamiltonian, i, 1).front();
    for (const int j : variables) {
      if (!graph.is_number(partials(graph, slope, j, 1).front())) return false;
    }
  }
  return prescribed_values(problem).size() == problem.conditions.size();
}

/// Guesses with the control @p middle and different values of each state that is free at the start.
void add_free_begins(const ControlProblem& problem, const VectorXd& begin, const VectorXd& middle,
                     std::vector<ControlGuess>& guesses) {
  double size = 1;
  std::vector<bool> known(static_cast<std::size_t>(problem.states));
  for (const PrescribedValue& value : prescribed_values(problem)) {
    size = std::max(size, std::abs(value.value));
    if (value.point == 0) known[static_cast<std::size_t>(value.component)] = true;
  }
  for (int i = 0; i < problem.states; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (known[k] || problem.graph.is_number(problem.slopes[k], 0)) continue;
    for (const double share : {0.2, 0.4, 0.7, 1., 1.5, 2., 3., 4., 6., 10.}) {
      for (const double sign : {1., -1.}) {
        VectorXd other = begin;
        other[i] += sign * share * size;
        guesses.push_back({other, [middle](double, VectorXd& u) { u = middle; }});
      }
    }
  }
}

}  // namespace

std::vector<ControlGuess> control_guesses(const ControlProblem& problem, const VectorXd& begin, double size) {
  const auto q = static_cast<Index>(problem.controls());
  VectorXd middle(q), half(q);
  bool is_bounded = true;
  for (Index i = 0; i < q; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double low = problem.low[k], high = problem.high[k];
    const bool bounded = std::isfinite(high - low);
    middle[i] = bounded ? (low + high) / 2 : std::clamp(0.0, low, high);
    half[i] = bounded ? (high - low) / 2 : size;
    is_bounded = is_bounded && bounded;
  }
  std::vector<ControlGuess> guesses{{begin, [middle](double, VectorXd& u) { u = middle; }}};
  const double t0 = problem.points.front(), length = problem.points.back() - t0;
  for (const double scale : {1., 5.}) {
    if (scale > 1 && is_bounded) break;
    for (const int waves : {0, 1, 2, 3}) {
      for (const double sign : {scale, -scale}) {
        guesses.push_back({begin, [=](double t, VectorXd& u) {
                             u = middle +
                                 sign * std::cos(std::numbers::pi * waves * (t - t0) / length) * half;
                           }});
      }
    }
  }
  add_free_begins(problem, begin, middle, guesses);
  return guesses;
}

ControlSolution solve_control(const ControlProblem& problem, const std::vector<ControlGuess>& guesses,
                              const Options& options) {
  const auto necessary = std::make_shared<const NecessaryConditions>(problem);
  std::optional<ControlSolution> best;
  ControlSolution failed;
  failed.status = Status::failure(Outcome::not_converged, "no guess");
  std::vector<double> costs;
  const bool is_convex = is_linear_quadratic(problem, *necessary);
  for (const ControlGuess& guess : guesses) {
    if (best && is_convex) break;
    const DirectResult direct = direct_result(problem, necessary, guess);
    if (!direct.status.ok()) {
      failed.status = direct.status;
      continue;
    }
    if (direct.miss > 1e-2) {
      failed.status =
          failed_with(Outcome::infeasible,
                      "no control was found that leads to the prescribed values: the nearest is {:.2g} "
                      "off; loosen bounds or conditions, or give a --guess",
                      direct.miss);
      continue;
    }
    for (const ArcStructure& structure : arc_structures(*necessary, direct)) {
      ControlSolution found = solve_arcs(necessary, structure, direct, options);
      if (!found.status.ok()) {
        failed.status = failed_with(
            found.status.outcome(),
            "no sequence of arcs that a control of the cost {:.6g}, found by descent, suggests has an "
            "extremal (the last: {}); a control that switches without end, or with singular arcs alone, has "
            "none",
            direct.cost, found.status.sentence());
        continue;
      }
      const auto is_same = [&](double cost) {
        return std::abs(cost - found.cost) <= 1e-7 * (1 + std::abs(cost));
      };
      if (std::ranges::none_of(costs, is_same)) costs.push_back(found.cost);
      if (!best || found.cost < best->cost) best = std::move(found);
      break;
    }
  }
  if (!best) return failed;
  best->extremals = static_cast<int>(costs.size());
  best->second_order = second_order_of(problem, *best);
  return *best;
}

}  // namespace nlmech::bvp
