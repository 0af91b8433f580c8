#include "nlmech/bvp/solve.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check_options(const Options& o) {
  const auto require = [](bool good, const char* name, double value) {
    if (!good) throw invalid_argument("bvp: the option {} = {} is out of range", name, value);
  };
  require(o.intervals >= 1, "intervals", o.intervals);
  require(o.tolerance > 0, "tolerance", o.tolerance);
  require(o.most_intervals >= 1, "most_intervals", o.most_intervals);
  require(o.newton_tolerance > 0, "newton_tolerance", o.newton_tolerance);
  require(o.verification_tolerance > 0, "verification_tolerance", o.verification_tolerance);
}

constexpr int most_meshes = 20, most_iterations = 100;  // most_iterations: Newton iterations per mesh
constexpr double least_damping = 1e-6;                  // a smaller damping factor ends with newton_diverged

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;
/// Errors of rounding are below this, relative to the sum of all terms.
constexpr double rounding = 200 * unit_roundoff;
/// Unknowns below this share of their largest size in an iteration tend to 0.
constexpr double vanishing = 1e-12;
/// States below this share of the largest one are measured by it.
constexpr double small = 1e-8;
/// States below this share of their largest size in an iteration are 0.
constexpr double negligible = 1e-100;

/// max |x_i| over the mesh.
VectorXd largest_values(const Unknowns& y) {
  VectorXd largest = VectorXd::Zero(y.intervals.front().values.rows());
  for (const Interval& i : y.intervals) largest = largest.cwiseMax(i.values.cwiseAbs().rowwise().maxCoeff());
  return largest;
}

/// Largest sizes in an iteration from its start on.
struct History {
  VectorXd states, parameters, terms, condition_terms;
  VectorXd state_noise, parameter_noise;    // effect of rounding errors on the last iterate
  VectorXd least_states, least_parameters;  // Problem::least_sizes()

  explicit History(const Problem& problem)
      : least_states(VectorXd::Zero(problem.states())),
        least_parameters(VectorXd::Zero(problem.parameters())) {
    const VectorXd least = problem.least_sizes();
    if (least.size() == 0) return;
    least_states = least.head(problem.states());
    least_parameters = least.tail(problem.parameters());
  }

  void add(const Unknowns& y, const NewtonSystem& system) {
    const auto update = [](VectorXd& largest, const VectorXd& now) {
      if (largest.size() == 0)
        largest = now;
      else
        largest = largest.cwiseMax(now);
    };
    update(states, largest_values(y));
    update(parameters, y.parameters.cwiseAbs());
    update(terms, system.terms());
    update(condition_terms, system.condition_terms());
  }
};

/// Sizes by which updates are measured: max |x_i| over the mesh and |p_j|, of the iterate or of the next one,
/// but such that rounding errors are a tenth of the tolerance or less.
struct Scales {
  Scales(const Unknowns& y, const Unknowns& next, const History& history, double tolerance)
      : states(largest_values(y)
                   .cwiseMax(largest_values(next))
                   .cwiseMax(vanishing * history.states)
                   .cwiseMax(10 / tolerance * history.state_noise)
                   .cwiseMax(history.least_states)),
        parameters(y.parameters.cwiseAbs()
                       .cwiseMax(next.parameters.cwiseAbs())
                       .cwiseMax(vanishing * history.parameters)
                       .cwiseMax(10 / tolerance * history.parameter_noise)
                       .cwiseMax(history.least_parameters)) {
    // Rounding errors of the linear solver are relative to all states together.
    states = states.cwiseMax(small * states.maxCoeff());
  }
  /// Without rounding errors, which are not known before the matrix of the iterate is.
  Scales(const Unknowns& y, const History& history)
      : states(largest_values(y).cwiseMax(vanishing * history.states).cwiseMax(history.least_states)),
        parameters(y.parameters.cwiseAbs()
                       .cwiseMax(vanishing * history.parameters)
                       .cwiseMax(history.least_parameters)) {}

  VectorXd states, parameters;
};

/// 1 / s_i, and 0 for a size of 0, which only an unknown that is 0 throughout has.
VectorXd weights(const VectorXd& sizes) {
  return sizes.unaryExpr([](double s) { return s > 0 ? 1 / s : 0; });
}

/// Sizes without those of states that are rounding so far and that @p step makes larger by ten digits: they
/// have no size yet by which to compare two steps.
Scales without_new_states(Scales scales, const Unknowns& step) {
  const VectorXd change = largest_values(step);
  for (Index i = 0; i < change.size(); ++i) {
    if (change[i] > 1e10 * scales.states[i]) scales.states[i] = 0;
  }
  return scales;
}

/// Root mean square of the scaled components of a - fraction b.
double length(const Unknowns& a, const Unknowns& b, double fraction, const Scales& scales) {
  double sum = 0, count = 0;
  const VectorXd weight = weights(scales.states);
  for (std::size_t k = 0; k < a.intervals.size(); ++k) {
    const auto difference = a.intervals[k].values - fraction * b.intervals[k].values;
    sum += (weight.asDiagonal() * difference).squaredNorm();
    count += static_cast<double>(a.intervals[k].values.size());
  }
  if (a.parameters.size() > 0) {
    // The parameters have the weight of all states together: they may be as important as a trajectory.
    const VectorXd part = (a.parameters - fraction * b.parameters).cwiseProduct(weights(scales.parameters));
    sum += part.squaredNorm() / static_cast<double>(part.size()) * count;
    count += count;
  }
  return std::sqrt(sum / count);
}

void advance(const Unknowns& from, double fraction, const Unknowns& step, Unknowns& to) {
  for (std::size_t k = 0; k < from.intervals.size(); ++k) {
    to.intervals[k].values = from.intervals[k].values + fraction * step.intervals[k].values;
  }
  to.parameters = from.parameters + fraction * step.parameters;
}

Status singular(const NewtonSystem& system, Index conditions, int iteration) {
  if (system.independent_conditions() < conditions && system.contradiction() > 1e-6) {
    return failed_with(Outcome::infeasible,
                       "bvp: the {} conditions contradict each other: only {} are independent, and the "
                       "others cannot be met with them (Newton's iteration {}); remove one of them",
                       conditions, system.independent_conditions(), iteration);
  }
  if (system.independent_conditions() < conditions) {
    return failed_with(Outcome::singular_matrix,
                       "bvp: only {} of the {} conditions are independent of each other (Newton's iteration "
                       "{}): the solution is not determined; replace those that repeat others",
                       system.independent_conditions(), conditions, iteration);
  }
  return failed_with(
      Outcome::singular_matrix,
      "bvp: Newton's matrix is singular (pivots 1 to {:.2g}, iteration {}): with these equations the "
      "conditions do not determine the solution or admit none, or a layer of it is too thin for the mesh; "
      "change the conditions, start elsewhere, or follow the solution from a parameter with a wider layer",
      system.pivot_ratio(), iteration);
}

Status not_finite(int iteration) {
  return failed_with(
      Outcome::non_finite,
      "bvp: the equations or their derivatives are not finite at Newton's iteration {}; start elsewhere",
      iteration);
}

/// Names the unknown that nothing determines at the result, if there is one.
Status check_determined(const Problem& problem, NewtonSystem& system, Unknowns& y, const History& history) {
  // Without unknown constants the last matrix of the iteration decides, unless it is nearly singular.
  if (y.parameters.size() == 0 && system.pivot_ratio() > 1e-10) return {};
  if (!system.residual(y) || !system.factorise(y)) return not_finite(0);
  const int n = problem.states();
  const Eigen::MatrixXd& influence = system.influence();
  VectorXd terms(influence.rows());
  terms << history.terms, history.condition_terms;
  // Also the result, which a linear problem reaches in one step.
  const VectorXd parameters =
      history.parameters.cwiseMax(y.parameters.cwiseAbs()).cwiseMax(history.least_parameters);
  terms.tail(system.condition_terms().size()) =
      terms.tail(system.condition_terms().size()).cwiseMax(system.condition_terms());
  for (Index j = 0; j < influence.cols(); ++j) {
    // The largest effect of the parameter, relative to what its equations were in the iteration.
    const VectorXd effect = (influence.col(j) * parameters[j]).cwiseProduct(weights(terms));
    if (effect.maxCoeff() > 1e-3 * unit_roundoff) continue;
    const bool rests = (largest_values(y).array() <= vanishing * history.states.array()).all();
    return failed_with(Outcome::singular_matrix,
                       "bvp: nothing determines {}: at the result{} neither the equations nor the conditions "
                       "depend on it; change the conditions, or start elsewhere",
                       problem.unknown_name(n + static_cast<int>(j)),
                       rests ? ", where all states are 0," : "");
  }
  if (system.pivot_ratio() > 1e-13) return {};
  VectorXd sizes(n + y.parameters.size());
  sizes << largest_values(y), y.parameters.cwiseAbs();
  return failed_with(Outcome::singular_matrix,
                     "bvp: nothing determines {}: Newton's matrix is singular at the result (pivots 1 to "
                     "{:.2g}), so that there are other solutions near it; change the conditions, or start "
                     "elsewhere",
                     problem.unknown_name(static_cast<int>(system.loosest_unknown(sizes))),
                     system.pivot_ratio());
}

Status diverged(int iteration, double damping, double update) {
  return failed_with(Outcome::newton_diverged,
                     "bvp: at iteration {} Newton's step is not admissible even shortened to {:.2g} of its "
                     "length {:.3g}; start elsewhere",
                     iteration, damping, update);
}

/// Damped Newton iteration on one mesh.
class Run {
 public:
  Run(NewtonSystem& system, Unknowns& y, const Options& options, History& history, Statistics& statistics)
      : system_(system),
        y_(y),
        options_(options),
        history_(history),
        statistics_(statistics),
        step_(y),
        simplified_(y),
        trial_(y),
        noise_(y) {}

  Status run(Index conditions, double& pivot_ratio) {
    if (!system_.residual(y_)) return not_finite(0);
    for (int k = 1; k <= most_iterations; ++k) {
      if (!system_.factorise(y_)) return not_finite(k);
      ++statistics_.jacobians;
      ++statistics_.factorisations;
      ++statistics_.newton_iterations;
      pivot_ratio = system_.pivot_ratio();
      if (!(pivot_ratio > 1e-13)) return singular(system_, conditions, k);
      system_.solve(step_);
      history_.add(y_, system_);
      system_.solve_rounding(y_, noise_);
      history_.state_noise = largest_values(noise_);
      history_.parameter_noise = noise_.parameters.cwiseAbs();
      advance(y_, 1, step_, trial_);
      const Scales scales(y_, trial_, history_, options_.newton_tolerance);
      const double update = length(step_, step_, 0, scales);
      if (!std::isfinite(update)) return singular(system_, conditions, k);
      if (update <= options_.newton_tolerance) {
        const bool goes_on = shrinks(y_, trial_);
        Status status = finish();
        if (!status.ok() || !goes_on || largest_values(y_).isZero(0)) return status;
        done_ = false;
        continue;
      }
      predict(k, update, scales);
      Status status = shorten(k, update, scales);
      if (!status.ok() || done_) return status;
    }
    return failed_with(
        Outcome::not_converged,
        "bvp: Newton's updates are still {:.3g} after {} iterations; allow more, or start closer", before_,
        most_iterations);
  }

 private:
  /// The last, undamped step; evaluates F to make the slopes consistent with the values.
  Status finish() {
    advance(y_, 1, step_, y_);
    if (largest_values(y_).maxCoeff() <= negligible * history_.states.maxCoeff()) {
      for (Interval& interval : y_.intervals) interval.values.setZero();
      history_.state_noise.setZero();
    }
    done_ = true;
    return system_.residual(y_) ? Status() : not_finite(0);
  }

  /// Does a state lose more than three quarters of its size from @p now to @p next (at a double root it loses
  /// half)? A solution that is small or 0 beside its guess is reached when no state does: rounding errors and
  /// terms of @p now are then those of @p next.
  [[nodiscard]] bool shrinks(const Unknowns& now, const Unknowns& next) const {
    const auto sizes = [&](const Unknowns& y) {
      const VectorXd largest = largest_values(y);
      return VectorXd(largest.cwiseMax(small * largest.maxCoeff()).cwiseMax(history_.least_states));
    };
    const VectorXd before = sizes(now);
    return (sizes(next).array() < before.array() / 4 &&
            before.array() > negligible * history_.states.maxCoeff())
        .any();
  }

  /// Predicts the damping factor from the curvature observed in the last step.
  void predict(int k, double update, const Scales& scales) {
    if (k == 1) {
      damping_ = 1;
      return;
    }
    const double turn = length(simplified_, step_, 1, scales);
    const double allowed = turn > 0 ? before_ * simplified_length_ / (turn * update) * damping_ : 1;
    damping_ = std::clamp(allowed, least_damping, 1.0);
  }

  /// Reduces the damping factor until the simplified Newton step is shorter than the Newton step.
  Status shorten(int k, double update, const Scales& scales) {
    for (;;) {
      advance(y_, damping_, step_, trial_);
      double theta = 2, next = damping_ / 2;
      if (system_.residual(trial_)) {
        system_.solve(simplified_);
        const Scales known = without_new_states(scales, simplified_);
        const double step = length(step_, step_, 0, known);
        simplified_length_ = length(simplified_, simplified_, 0, known);
        if (step > 0) theta = simplified_length_ / step;
        const double bend = length(simplified_, step_, 1 - damping_, known);
        if (bend > 0) next = std::min(next, step * damping_ * damping_ / (2 * bend));
      }
      if (theta <= 1 - damping_ / 4) break;
      // At the level of rounding the steps no longer decrease: the last iterate is the root.
      if (update <= 10 * options_.newton_tolerance && damping_ == 1) {
        done_ = true;
        return system_.residual(y_) ? Status() : not_finite(k);
      }
      if (update <= 100 * options_.newton_tolerance && damping_ == 1 && theta < 2) break;
      ++statistics_.rejected;
      if (damping_ <= least_damping) return diverged(k, damping_, update);
      damping_ = std::max(next, std::max(damping_ / 10, least_damping));
    }
    std::swap(y_.intervals, trial_.intervals);
    std::swap(y_.parameters, trial_.parameters);
    before_ = update;
    if (damping_ == 1 && is_last_step()) {
      advance(y_, 1, simplified_, y_);
      done_ = true;
      if (!system_.residual(y_)) return not_finite(k);
    }
    return {};
  }

  /// Is the simplified step within the tolerance, also relative to the new iterate if that is smaller?
  bool is_last_step() {
    // After the step trial_ is the iterate before it.
    if (!(simplified_length_ <= options_.newton_tolerance) || shrinks(trial_, y_)) return false;
    const Scales scales(y_, history_);
    return length(simplified_, simplified_, 0, scales) <= options_.newton_tolerance;
  }

  NewtonSystem& system_;
  Unknowns& y_;
  const Options& options_;
  History& history_;
  Statistics& statistics_;
  Unknowns step_, simplified_, trial_, noise_;
  double damping_ = 1, before_ = 0, simplified_length_ = 0;
  bool done_ = false;
};

/// Newton's iteration from @p y, which is replaced by the root or the last iterate.
Status iterate(NewtonSystem& system, Unknowns& y, const Options& options, History& history,
               Statistics& statistics, double& pivot_ratio) {
  const auto before = system.evaluations();
  Run run(system, y, options, history, statistics);
  const Index phases = y.intervals.back().phase + 1;
  const Index conditions = y.intervals.front().values.rows() * phases + y.parameters.size();
  Status status = run.run(conditions, pivot_ratio);
  statistics.right_hand_sides += system.evaluations() - before;
  return status;
}

/// First mesh: the mesh of the start, mapped to the problem's interval, or equal intervals; includes all
/// points of the problem.
std::vector<double> first_mesh(const std::vector<double>& points, const Start& start, int intervals) {
  std::vector<double> times = points;
  if (start.mesh.size() > 1) {
    const double from = start.mesh.front(),
                 scale = (points.back() - points.front()) / (start.mesh.back() - from);
    for (const double t : start.mesh) times.push_back(points.front() + (t - from) * scale);
  } else {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      for (int i = 1; i < intervals; ++i) {
        times.push_back(points[k] + (points[k + 1] - points[k]) * i / intervals);
      }
    }
  }
  std::sort(times.begin(), times.end());
  // Times that differ by rounding are merged; a point of the problem has priority.
  const double least = 1e-10 * (points.back() - points.front());
  std::vector<double> result;
  for (const double t : times) {
    const bool is_point = std::find(points.begin(), points.end(), t) != points.end();
    if (result.empty() || t - result.back() > least) {
      result.push_back(t);
    } else if (is_point) {
      result.back() = t;
    }
  }
  return result;
}

Unknowns on_mesh(const std::vector<double>& mesh, const std::vector<double>& points, const Scheme& scheme,
                 int states) {
  Unknowns y;
  int phase = 0;
  for (std::size_t k = 0; k + 1 < mesh.size(); ++k) {
    if (mesh[k] >= points[static_cast<std::size_t>(phase) + 1]) ++phase;
    const MatrixXd zero = MatrixXd::Zero(states, scheme.nodes.size());
    y.intervals.push_back({mesh[k], mesh[k + 1] - mesh[k], phase, zero, zero});
  }
  return y;
}

void fill(const Start& start, double from, double scale, const Scheme& scheme, Unknowns& y) {
  VectorXd x(y.intervals.front().values.rows());
  for (Interval& interval : y.intervals) {
    for (Index j = 0; j < scheme.nodes.size(); ++j) {
      const double t = interval.t0 + scheme.nodes[j] * interval.h;
      start.states(from + (t - y.intervals.front().t0) * scale, x);
      interval.values.col(j) = x;
    }
  }
  y.parameters = start.parameters;
}

/// Interpolates the solution onto another mesh with the same phase ends.
Unknowns transfer(const Solution& old, const std::vector<double>& mesh, const std::vector<double>& points) {
  const Scheme& scheme = *old.scheme;
  Unknowns y = on_mesh(mesh, points, scheme, static_cast<int>(old.unknowns.intervals.front().values.rows()));
  for (Interval& interval : y.intervals) {
    const Index last = scheme.nodes.size() - 1;
    for (Index j = 0; j <= last; ++j) {
      const double t = interval.t0 + scheme.nodes[j] * interval.h;
      interval.values.col(j) = old.at(t, j == last ? Side::before : Side::after);
    }
  }
  y.parameters = old.parameters();
  return y;
}

/// Solution::residual for each interval. Outside a layer, whose slopes are far larger, the effect of a
/// residual on the states counts.
std::vector<double> residuals(const Problem& problem, const Solution& solution, double tolerance) {
  const auto& all = solution.unknowns.intervals;
  const Scheme& s = *solution.scheme;
  const VectorXd size = largest_values(solution.unknowns);
  VectorXd least = rounding / tolerance * solution.terms;
  if (const VectorXd sizes = problem.least_sizes(); sizes.size() > 0)
    least = least.cwiseMax(sizes.head(problem.states()) / (solution.end() - solution.begin()));
  VectorXd f(problem.states()), u(problem.states()), slope = VectorXd::Zero(problem.states());
  for (const Interval& i : all) slope = slope.cwiseMax(i.slopes.cwiseAbs().rowwise().maxCoeff());
  std::vector<double> result;
  for (const Interval& i : all) {
    const MatrixXd at = (i.h * (i.slopes * s.probe_slope.transpose())).colwise() + i.values.col(0);
    const MatrixXd dot = i.slopes * s.probe_slope_dot.transpose();
    double largest = 0;
    for (Index j = 0; j < s.probes.size(); ++j) {
      u = at.col(j);
      problem.rhs(i.t0 + s.probes[j] * i.h, u, solution.parameters(), f);
      const VectorXd scale = slope.cwiseMin(size / i.h).cwiseMax(least);
      const double part = (dot.col(j) - f).cwiseProduct(weights(scale)).lpNorm<Eigen::Infinity>();
      largest = part <= largest ? largest : part;  // keeps a NaN
    }
    result.push_back(largest);
  }
  return result;
}

/// Whether a small relative change of the states explains the residual of an interval: a hundredth of the
/// tolerance or 1024 roundings, in each component of |df/dx| |x|. Where f is a difference of large terms, as
/// in stiff equations, the residual of the exact solution, rounded, is no smaller.
bool is_change_of_states(const Problem& problem, const Solution& solution, const Interval& interval,
                         double tolerance) {
  const double change = std::max(1e-2 * tolerance, 1024 * std::numeric_limits<double>::epsilon());
  const Scheme& s = *solution.scheme;
  const Index n = problem.states();
  MatrixXd by_state(n, n), by_parameter(n, problem.parameters());
  const MatrixXd at =
      (interval.h * (interval.slopes * s.probe_slope.transpose())).colwise() + interval.values.col(0);
  const MatrixXd dot = interval.slopes * s.probe_slope_dot.transpose();
  VectorXd f(n), u(n);
  for (Index j = 0; j < s.probes.size(); ++j) {
    u = at.col(j);
    const double t = interval.t0 + s.probes[j] * interval.h;
    problem.rhs(t, u, solution.parameters(), f);
    problem.jacobian(t, u, solution.parameters(), by_state, by_parameter);
    const VectorXd level = by_state.cwiseAbs() * interval.values.cwiseAbs().rowwise().maxCoeff();
    if (!((dot.col(j) - f).cwiseAbs().array() <= change * level.array()).all()) return false;
  }
  return true;
}

/// Next mesh: divides or joins intervals by their residuals.
std::vector<double> next_mesh(const Solution& solution, const std::vector<double>& residual,
                              double tolerance) {
  const auto& all = solution.unknowns.intervals;
  const auto order = static_cast<double>(solution.scheme->order);
  const auto ratio = [&](std::size_t k) { return std::pow(residual[k] / tolerance, 1 / order); };
  // The last of the intervals from k on that become one. Its residual grows as the power `order` of its
  // length.
  const auto last_joined = [&](std::size_t k) {
    constexpr std::size_t most = 4;
    std::size_t last = k;
    double steepest = ratio(k) / all[k].h;
    for (std::size_t next = k + 1; next < std::min(k + most, all.size()); ++next) {
      steepest = std::max(steepest, ratio(next) / all[next].h);
      const double length = all[next].t0 + all[next].h - all[k].t0;
      const bool is_known = std::isfinite(residual[next]) && all[next].phase == all[k].phase;
      if (!(is_known && steepest * length < 0.8)) break;
      last = next;
    }
    return last;
  };
  std::vector<double> mesh;
  for (std::size_t k = 0; k < all.size(); ++k) {
    mesh.push_back(all[k].t0);
    const double r = std::isfinite(residual[k]) ? ratio(k) : 2;
    if (const std::size_t last = last_joined(k); last > k) {
      k = last;
    } else if (r > 1) {
      const int parts = std::clamp(static_cast<int>(std::ceil(1.1 * r)), 2, 4);
      for (int i = 1; i < parts; ++i) mesh.push_back(all[k].t0 + all[k].h * i / parts);
    }
  }
  mesh.push_back(solution.end());
  return mesh;
}

Status mesh_limit(const Options& options, const Solution& solution) {
  return failed_with(Outcome::step_limit,
                     "bvp: on {} intervals the residual is {:.3g}, above the tolerance {:.3g}, and the {} "
                     "meshes or {} intervals allowed are used up; allow more, or ask for less",
                     solution.unknowns.intervals.size(), solution.residual, options.tolerance, most_meshes,
                     options.most_intervals);
}

/// Terms of f; a state that consists of rounding errors, as one that is 0 may, counts with the size that has
/// such errors.
VectorXd terms_with_noise(const NewtonSystem& system, const Unknowns& y, const History& history) {
  VectorXd sizes = largest_values(y);
  const double largest = sizes.maxCoeff();
  for (Index i = 0; i < sizes.size(); ++i)
    sizes[i] = sizes[i] <= 1e3 * history.state_noise[i]
                   ? std::max(vanishing * largest, history.state_noise[i] / unit_roundoff)
               : sizes[i] <= vanishing * largest ? vanishing * largest
                                                 : 0;
  return system.terms() + system.state_influence() * sizes;
}

/// Whether rounding errors change a state by more than the tolerance of the verification. A state that
/// consists of them, as one that is 0 may, is compared with the largest state.
Status check_rounding(const Problem& problem, const Options& options, const Solution& solution,
                      const History& history) {
  const VectorXd sizes = largest_values(solution.unknowns);
  const double allowed = std::max(options.verification_tolerance, 1e-8);
  for (Index i = 0; i < sizes.size(); ++i) {
    const double noise = history.state_noise[i];
    const double size = sizes[i] > 1e3 * noise ? sizes[i] : sizes.maxCoeff();
    if (noise <= allowed * size) continue;
    return failed_with(Outcome::singular_matrix,
                       "bvp: the problem multiplies rounding errors so much that they change {} by {:.2g} of "
                       "its size; the equations and conditions do not determine it in this precision",
                       problem.unknown_name(static_cast<int>(i)), noise / size);
  }
  return {};
}

/// Solves on successively refined meshes.
Status refine(const Problem& problem, const Options& options, Solution& solution) {
  const std::vector<double> points = problem.points();
  History history(problem);
  for (int k = 1;; ++k) {
    NewtonSystem system(problem, *solution.scheme);
    Status status =
        iterate(system, solution.unknowns, options, history, solution.statistics, solution.pivot_ratio);
    ++solution.statistics.steps;
    if (!status.ok()) return status;
    solution.terms = terms_with_noise(system, solution.unknowns, history);
    std::vector<double> residual = residuals(problem, solution, options.tolerance);
    solution.residual = *std::max_element(residual.begin(), residual.end());
    for (std::size_t i = 0; i < residual.size(); ++i) {
      if (residual[i] > options.tolerance &&
          is_change_of_states(problem, solution, solution.unknowns.intervals[i], options.tolerance))
        residual[i] = options.tolerance;
    }
    if (std::ranges::all_of(residual, [&](double r) { return r <= options.tolerance; }) || !options.refine) {
      status = check_determined(problem, system, solution.unknowns, history);
      return status.ok() ? check_rounding(problem, options, solution, history) : status;
    }
    const std::vector<double> mesh = next_mesh(solution, residual, options.tolerance);
    if (k == most_meshes || static_cast<int>(mesh.size()) - 1 > options.most_intervals) {
      return mesh_limit(options, solution);
    }
    solution.unknowns = transfer(solution, mesh, points);
  }
}

/// At a singular end the solution is not verified by integration. Beside it |f| (t - t_0) tends to 0 if the
/// solution is regular, and not if f has a term x/(t - t_0) with another limit of x than 0.
Status check_regular_ends(const Problem& problem, const Options& options, const Solution& solution) {
  const VectorXd sizes = largest_values(solution.unknowns), allowed = options.verification_tolerance * sizes,
                 p = solution.parameters();
  const double length = solution.end() - solution.begin();
  const auto change = [&](double t, double beside) {
    VectorXd f(problem.states());
    problem.rhs(t, solution.at(t), p, f);
    return VectorXd(beside * f.cwiseAbs());
  };
  // The effect of an error of x, which grows towards the end where f has a term x/(t - t_0)^2.
  const auto error = [&](double t, double beside) {
    MatrixXd by_state(problem.states(), problem.states()), by_parameter(problem.states(), p.size());
    problem.jacobian(t, solution.at(t), p, by_state, by_parameter);
    return VectorXd(options.tolerance * beside * by_state.cwiseAbs() * sizes.head(problem.states()));
  };
  for (const double sign : {1., -1.}) {
    const double end = sign > 0 ? solution.begin() : solution.end();
    double beside = std::max(1e-15 * length, 128 * unit_roundoff * std::abs(end));
    // The map of the time may round to the end.
    while (beside < 1e-3 * length && !(change(end + sign * beside, beside).allFinite() &&
                                       (error(end + sign * beside, beside) - allowed).maxCoeff() <= 0))
      beside *= 100;
    const VectorXd near = change(end + sign * beside, beside),
                   far = change(end + 4 * sign * beside, 4 * beside);
    for (Index i = 0; i < near.size(); ++i) {
      if (near[i] <= allowed[i] || near[i] <= 0.75 * far[i]) continue;
      return failed_with(Outcome::spurious_root,
                         "bvp: at the singular end t = {:.6g} the conditions leave {} without a finite "
                         "derivative; give the condition that makes the solution regular there",
                         end, problem.unknown_name(static_cast<int>(i)));
    }
  }
  return {};
}

}  // namespace

Solution solve(const Problem& problem, const Start& start, const Options& options) {
  check_problem(problem);
  check_options(options);
  if (!start.states) throw std::invalid_argument("bvp: the start has no states");
  if (start.parameters.size() != problem.parameters()) {
    throw invalid_argument("bvp: the start has {} parameters, the problem {}", start.parameters.size(),
                           problem.parameters());
  }
  const Stopwatch watch;
  Solution solution;
  solution.scheme = std::make_shared<const Scheme>(
      problem.is_singular_at_ends() ? gauss_scheme(options.nodes + 2) : lobatto_scheme(options.nodes));
  const std::vector<double> points = problem.points();
  const std::vector<double> mesh = first_mesh(points, start, options.intervals);
  solution.unknowns = on_mesh(mesh, points, *solution.scheme, problem.states());
  const bool mapped = start.mesh.size() > 1;
  const double length = points.back() - points.front();
  fill(start, mapped ? start.mesh.front() : points.front(),
       mapped ? (start.mesh.back() - start.mesh.front()) / length : 1, *solution.scheme, solution.unknowns);
  solution.status = refine(problem, options, solution);
  if (solution.status.ok() && problem.is_singular_at_ends())
    solution.status = check_regular_ends(problem, options, solution);
  if (solution.status.ok() && options.verification != Verification::none)
    verify_by_integration(problem, options, solution);
  solution.statistics.seconds = watch.seconds();
  return solution;
}

}  // namespace nlmech::bvp
