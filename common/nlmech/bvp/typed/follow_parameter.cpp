#include "nlmech/bvp/typed/follow_parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <memory>
#include <utility>

#include "nlmech/bvp/typed/typed_solve.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_rejected = 4;  // damped Newton steps: more may lead to another branch

Options step_options(double tolerance) {
  Options options;
  options.tolerance = tolerance;
  options.most_intervals = 20'000;
  options.verification = Verification::none;
  return options;
}

Status too_short() { return Status::failure(Outcome::newton_diverged, "the steps are too short"); }

bool is_close(const Solution& next) { return next.status.ok() && next.statistics.rejected <= most_rejected; }

/// The problems with a parameter.
struct ParameterProblems {
  ProblemText text;
  std::string guess, name;
  double end;  // of an infinite interval

  /// With a value of the parameter.
  [[nodiscard]] TypedProblem at(double value) const {
    ProblemText known = text;
    known.settings[name] = value;
    return read(known);
  }
  /// With the parameter as an unknown constant, and a condition more. @throws InputError if it has to be
  /// known
  [[nodiscard]] TypedProblem with_unknown_parameter(const std::string& condition) const {
    ProblemText unknown = text;
    unknown.settings.erase(name);
    unknown.parameter = name;
    unknown.conditions += "\n" + condition;
    TypedProblem problem = read(unknown);
    if (problem.end_parameter() && problem.unknown_name(problem.states() + *problem.end_parameter()) == name)
      throw InputError("the parameter is the end");
    return problem;
  }

 private:
  [[nodiscard]] TypedProblem read(const ProblemText& given) const {
    TypedProblem problem = read_problem(given, guess);
    if (problem.is_infinite()) problem.truncate(end);
    return problem;
  }
};

/// A solution with its value of the parameter.
struct BranchPoint {
  std::shared_ptr<const TypedProblem> problem;
  std::shared_ptr<const Solution> solution;
  double value;

  [[nodiscard]] double time(double s) const { return problem->time(s, solution->parameters()); }
};

/// Start with components at the nodes of a point.
template <class Components>
Start start_for(const TypedProblem& problem, const BranchPoint& point, const Components& components) {
  std::vector<double> times = point.solution->node_times();
  for (double& t : times) t = point.time(t);
  MatrixXd values(static_cast<Index>(problem.names().size()), static_cast<Index>(times.size()));
  for (std::size_t k = 0; k < times.size(); ++k) values.col(static_cast<Index>(k)) = components(times[k]);
  Start start = problem.guess_from(times, values);
  start.mesh = point.solution->mesh();
  return start;
}

/// Start from a point for another value of the parameter, at some of which states may be constants.
Start start_from(const BranchPoint& point, const TypedProblem& problem) {
  if (problem.states() == point.problem->states()) return start_from(*point.solution);
  return start_for(problem, point,
                   [&](double t) { return point.problem->components_at(*point.solution, t); });
}

/// A branch by its length: the root mean square of changes of all components, in their sizes, at some times.
/// The unit of `share` is the *change*, the difference of the last two points.
class Branch {
 public:
  /// @param range size of the parameter
  Branch(const ParameterProblems& problems, BranchPoint before, BranchPoint now, double range)
      : problems_(problems),
        unknown_(problems.with_unknown_parameter(problems.name + " = 1")),
        row_(std::ranges::find(unknown_.names(), problems.name) - unknown_.names().begin()),
        range_(range),
        before_(std::move(before)),
        now_(std::move(now)) {
    constexpr int parts = 16;
    // A value at an unknown end, or at infinity, has another form.
    const int last = unknown_.end_parameter() ? 0 : unknown_.is_infinite() ? parts - 1 : parts;
    const double from = now_.time(now_.solution->begin()), until = now_.time(now_.solution->end());
    for (int k = 0; k <= last; ++k) times_.push_back(k == parts ? until : from + (until - from) * k / parts);
    set_change();
    length_ = std::min(norm_, 0.1);
  }

  [[nodiscard]] const BranchPoint& before() const { return before_; }
  [[nodiscard]] const BranchPoint& now() const { return now_; }

  /// The point of the branch at @p share from now() on. @throws Failure if it is not found
  [[nodiscard]] BranchPoint point(double share, double tolerance) const {
    const double wanted = weights_.cwiseProduct(samples(now_) + share * changes_).sum();
    auto problem = std::make_shared<const TypedProblem>(
        problems_.with_unknown_parameter(fmt::format("{} = {:.17g}", functional_, wanted)));
    const Start start = start_for(*problem, now_, [&](double t) -> VectorXd {
      const VectorXd x = components(now_, t);
      return x + share * (x - components(before_, t));
    });
    auto solution = std::make_shared<const Solution>(solve(*problem, start, step_options(tolerance)));
    if (!is_close(*solution)) throw Failure(solution->status.ok() ? too_short() : solution->status);
    const double value = problem->components(solution->first(), solution->parameters())[row_];
    return {std::move(problem), std::move(solution), value};
  }

  /// Proposes the next point, and its share. @throws Failure with that of the shortest step
  [[nodiscard]] std::pair<double, BranchPoint> next(double tolerance) {
    constexpr double shortest = 1e-6, longest = 0.5, turn = 0.1;
    for (;; length_ /= 3) {
      const double share = length_ / norm_;
      try {
        BranchPoint next = point(share, tolerance);
        const double bend = size_of(samples(next) - samples(now_) - share * changes_) / length_;
        // The last change may be far from the tangent: a step much shorter than it may turn more.
        if (!(bend <= 3 * turn || (bend <= 0.9 && length_ <= 0.1 * norm_))) throw Failure(too_short());
        length_ = std::min(longest, length_ * std::clamp(turn / bend, 0.5, 2.0));
        return {share, std::move(next)};
      } catch (const Failure&) {
        if (length_ <= shortest) throw;
      }
    }
  }
  void accept(BranchPoint next) {
    before_ = std::exchange(now_, std::move(next));
    set_change();
  }
  /// Start from a point for a problem with a value of the parameter.
  [[nodiscard]] Start start_at(const BranchPoint& point, const TypedProblem& problem) const {
    return start_for(problem, point, [&](double t) -> VectorXd {
      const VectorXd all = components(point, t);
      VectorXd known(all.size() - 1);
      known << all.head(row_), all.tail(known.size() - row_);
      return known;
    });
  }

 private:
  /// All components of the equations and, in its place among them, the parameter.
  [[nodiscard]] VectorXd components(const BranchPoint& point, double t) const {
    VectorXd x = point.problem->components_at(*point.solution, t);
    if (x.size() == static_cast<Index>(unknown_.names().size())) return x;
    VectorXd all(x.size() + 1);
    all << x.head(row_), point.value, x.tail(x.size() - row_);
    return all;
  }
  [[nodiscard]] MatrixXd samples(const BranchPoint& point) const {
    MatrixXd all(static_cast<Index>(unknown_.names().size()), static_cast<Index>(times_.size()));
    for (std::size_t k = 0; k < times_.size(); ++k)
      all.col(static_cast<Index>(k)) = components(point, times_[k]);
    return all;
  }
  [[nodiscard]] double size_of(const MatrixXd& change) const {
    return (sizes_.cwiseInverse().asDiagonal() * change).norm() /
           std::sqrt(static_cast<double>(times_.size()));
  }

  /// Also the functional: the product with the last change, as text.
  void set_change() {
    const MatrixXd old = samples(before_), now = samples(now_);
    changes_ = now - old;
    sizes_ = now.cwiseAbs().cwiseMax(old.cwiseAbs()).rowwise().maxCoeff();
    for (double& size : sizes_) size = size > 0 ? size : 1;
    sizes_[row_] = range_;
    norm_ = size_of(changes_);
    weights_ = sizes_.cwiseAbs2().cwiseInverse().asDiagonal() * changes_;
    functional_ = "0";
    for (Index i = 0; i < weights_.rows(); ++i) {
      const std::string& name = unknown_.names()[static_cast<std::size_t>(i)];
      if (unknown_.parameter_of(static_cast<int>(i))) {
        functional_ += fmt::format(" + ({:.17g})*{}({:.17g})", weights_.row(i).sum(), name, times_[0]);
        continue;
      }
      for (std::size_t k = 0; k < times_.size(); ++k)
        functional_ +=
            fmt::format(" + ({:.17g})*{}({:.17g})", weights_(i, static_cast<Index>(k)), name, times_[k]);
    }
  }

  const ParameterProblems& problems_;
  TypedProblem unknown_;  // for the names of all components
  Index row_;             // of the parameter among them
  double range_;
  BranchPoint before_, now_;
  std::vector<double> times_;
  MatrixXd changes_, weights_;
  VectorXd sizes_;
  double norm_ = 0, length_ = 0;
  std::string functional_;
};

/// Follows the branch of a solution.
class Follower {
 public:
  Follower(const ProblemText& text, const std::string& guess, const ParameterRange& range, double end,
           double tolerance)
      : problems_{text, guess, range.name, end}, range_(range), tolerance_(tolerance) {}

  Continuation run(Solution solution) {
    put(range_.from, std::move(solution));
    const bool is_done = by_values() && !range_.all;
    if (!is_done && path_.size() == 2 && out_.status.outcome() != Outcome::step_limit) by_length();
    if (!range_.all && !out_.solutions.empty()) out_.status = {};
    return std::move(out_);
  }

 private:
  void put(double value, Solution solution) {
    if (path_.size() == 2) path_.erase(path_.begin());
    path_.push_back({std::make_shared<const TypedProblem>(problems_.at(value)),
                     std::make_shared<const Solution>(std::move(solution)), value});
    out_.reached = value;
  }

  /// @return whether the end value is reached
  bool by_values() {
    constexpr double least_step = 1e-4, first_step = 0.1, growth = 1.7;
    const Options options = step_options(std::max(tolerance_, 1e-6));
    const auto value = [&](double share) {
      const double from = range_.from, to = range_.to;
      if (share >= 1) return to;
      return from * to > 0 ? from * std::pow(to / from, share) : from + (to - from) * share;
    };
    double share = 0, step = first_step;
    while (share < 1) {
      if (1 - share < 1.5 * step) step = 1 - share;
      const TypedProblem problem = problems_.at(value(share + step));
      Solution next = solve(problem, start_from(path_.back(), problem), options);
      if (is_close(next)) {
        share += step;
        step *= growth;
        ++out_.steps;
        put(value(share), std::move(next));
      } else if (step > least_step) {
        step = std::max(step / 3, least_step);
      } else {
        out_.status = next.status.ok() ? too_short() : next.status;
        return false;
      }
    }
    add_solution(start_from(path_.back(), problems_.at(range_.to)));
    return true;
  }

  /// Solves at the end value.
  void add_solution(const Start& start) {
    TypedProblem problem = problems_.at(range_.to);
    Solution solution = solve_typed(problem, start, tolerance_);
    if (!solution.status.ok())
      out_.status = solution.status;
    else if (std::ranges::none_of(out_.solutions, [&](const Solution& s) { return are_same(s, solution); }))
      out_.solutions.push_back(std::move(solution));
  }

  void by_length() {
    constexpr int most_steps = 200;
    const Status before = out_.status;
    try {
      Branch branch(problems_, path_[0], path_[1], std::abs(range_.to - range_.from));
      for (int k = 0; k < most_steps; ++k) {
        const auto [share, next] = branch.next(std::max(tolerance_, 1e-6));
        find_events(branch, share, next.value);
        branch.accept(next);
        ++out_.steps;
        out_.reached = next.value;
        if (!range_.all && !out_.solutions.empty()) return;
        if (has_left(branch)) {
          out_.status =
              failed_with(Outcome::outside_validity, "the branch returns beyond {:.9g}", range_.from);
          return;
        }
      }
      out_.status = failed_with(Outcome::step_limit, "{} steps of the branch are used up", most_steps);
    } catch (const Failure& failure) {
      out_.status = failure.status();
    } catch (const InputError&) {
      out_.status = before;  // the parameter has to be known
    }
  }

  /// Is the last point on the other side of the first value, and the branch on its way further?
  [[nodiscard]] bool has_left(const Branch& branch) const {
    const double side = range_.to - range_.from, now = branch.now().value;
    return (now - range_.from) * side < 0 && (now - branch.before().value) * side < 0;
  }

  /// Adds the fold and the solutions at the end value between the last point and the next one.
  void find_events(const Branch& branch, double share, double next) {
    const double before = branch.before().value, now = branch.now().value;
    std::vector<std::pair<double, double>> places{{0, now}, {share, next}};  // in changes, with the value
    if ((now - before) * (next - now) < 0) {
      const double sign = now > before ? -1 : 1;
      constexpr int bits = 20;
      const auto [at, value] = boost::math::tools::brent_find_minima(
          [&](double part) { return sign * branch.point(part, tolerance_).value; }, -1., share, bits);
      out_.folds.push_back(sign * value);
      if (at < 0) places.insert(places.begin(), {-1, before});
      places.insert(std::ranges::upper_bound(places, std::pair(at, 0.)), {at, sign * value});
    }
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      const auto [a, low] = places[i];
      const auto [b, high] = places[i + 1];
      const bool crosses = (low - range_.to) * (high - range_.to) < 0 || high == range_.to;
      if (!crosses || (i == 0 && a < 0 && (before - range_.to) * (now - range_.to) < 0)) continue;
      const auto off = [&](double part) { return branch.point(part, tolerance_).value - range_.to; };
      std::uintmax_t most = 50;
      const auto bracket = boost::math::tools::toms748_solve(
          off, a, b, low - range_.to, high - range_.to, boost::math::tools::eps_tolerance<double>(20), most);
      const TypedProblem problem = problems_.at(range_.to);
      add_solution(branch.start_at(branch.point(bracket.first, tolerance_), problem));
      if (!range_.all) return;
    }
  }

  ParameterProblems problems_;
  ParameterRange range_;
  double tolerance_;
  std::vector<BranchPoint> path_;  // the last one or two points
  Continuation out_;
};

}  // namespace

Continuation follow_parameter(const ProblemText& text, const std::string& guess, const ParameterRange& range,
                              Solution solution, double tolerance) {
  const double end = solution.end();
  return Follower(text, guess, range, end, tolerance).run(std::move(solution));
}

}  // namespace nlmech::bvp
