#include "nlmech/algebraic/typed/typed_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Typed equations with a parameter, each divided by its change at the start when the unknowns change by
/// their size; all by the same number with an energy.
class LoadedSystem final : public Loaded {
 public:
  LoadedSystem(const TypedSystem& system, const VectorXd& x, double parameter)
      : system_(system), rows_(VectorXd::Ones(x.size())) {
    linearise(x, parameter);
    VectorXd unit = x.cwiseAbs();
    for (double& size : unit) size = size > 0 ? size : 1;
    rows_ = (j_.leftCols(size()) * unit.asDiagonal()).cwiseAbs().rowwise().sum();
    if (system.has_energy()) rows_.setConstant(rows_.maxCoeff());
    for (double& row : rows_) row = row > 0 && std::isfinite(row) ? row : 1;
  }

  [[nodiscard]] Index size() const override { return system_.size(); }
  void residual(const VectorXd& x, double load, VectorXd& f) override {
    if (system_.contains(x))
      system_.residual(with(x, load), f);
    else
      f.setConstant(size(), std::numeric_limits<double>::quiet_NaN());
    f.array() /= rows_.array();
  }
  void linearise(const VectorXd& x, double load) override {
    system_.derivative(with(x, load), j_);
    j_ = (rows_.cwiseInverse().asDiagonal() * j_).eval();
  }
  /// Is F rounding at a point, beside the sum of the terms of its differential, or the size of its rows at
  /// the start?
  [[nodiscard]] bool is_root(const VectorXd& x, double load) {
    VectorXd f;
    residual(x, load, f);
    linearise(x, load);
    const VectorXd terms = (j_ * with(x, load).asDiagonal()).cwiseAbs().rowwise().sum();
    return (f.array().abs() <= 1e-6 * terms.array() + 1e-9).all();
  }
  void load_vector(VectorXd& q) const override { q = j_.col(size()); }
  void matrix(MatrixXd& k) const override { k = j_.leftCols(size()); }
  [[nodiscard]] bool is_symmetric() const override { return system_.has_energy(); }

 private:
  [[nodiscard]] static VectorXd with(const VectorXd& x, double load) {
    VectorXd all(x.size() + 1);
    all << x, load;
    return all;
  }

  const TypedSystem& system_;
  VectorXd rows_;
  MatrixXd j_;
};

/// Path options for a range of the parameter and unknowns of the sizes at @p x.
PathMethod path_method(const TypedPathOptions& options, const VectorXd& x) {
  VectorXd scale(x.size());
  const double largest = x.cwiseAbs().maxCoeff();
  for (Index i = 0; i < x.size(); ++i)
    scale[i] = 1 / (std::abs(x[i]) > 1e-3 * largest && x[i] != 0 ? std::abs(x[i])
                    : largest > 0                                ? largest
                                                                 : 1);
  return {.first = std::abs(options.until - options.from) / 100,
          .turn = options.turn,
          .longest = 10,
          .iterations = 12,
          .scale = scale};
}

/// Follows all branches of typed equations.
class BranchTracer {
 public:
  BranchTracer(const TypedSystem& system, const VectorXd& root, const TypedPathOptions& options)
      : options_(options),
        low_(std::min(options.from, options.until)),
        high_(std::max(options.from, options.until)),
        equations_(system, root, options.from),
        scale_(path_method(options, root).scale),
        path_(path_from(root, options.from)) {}

  TypedPaths run() {
    Status status = path_->start(options_.until > options_.from);
    if (status.ok()) {
      add(TypedPathPoint::Kind::step, path_->now());
      status = along();
    }
    out_.status = status;
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      for (const int half : {0, 1}) follow_half(i, half);
    }
    return std::move(out_);
  }

 private:
  struct Crossing {
    PathPoint point;
    PathVector direction;
    int branch;
    bool is_open[2] = {true, true};
  };

  void follow_half(std::size_t i, int half) {
    if (!crossings_[i].is_open[half] || crossings_[i].direction.y.size() == 0) return;
    if (branch_ >= options_.branches) {
      ++out_.unfollowed;
      return;
    }
    crossings_[i].is_open[half] = false;
    const Crossing from = crossings_[i];
    Status status;
    for (double reach = 0.02; reach > 1e-7; reach /= 4) {
      status = path_->switch_branch(from.point, from.direction, half == 0 ? reach : -reach);
      if (status.ok()) break;
    }
    if (status.ok()) {
      ++branch_;
      add(TypedPathPoint::Kind::bifurcation, from.point);
      add(TypedPathPoint::Kind::step, path_->now());
      status = along();
    }
    if (out_.status.ok()) out_.status = status;
  }

  Status along() {
    listed_ = 0;
    is_at_end_ = false;
    met_.clear();
    first_ = path_->now();
    taken_ = next_resize_ = 0;
    Status status;
    do {
      if (has_outgrown()) resize();
      has_no_step_ = true;
      status = follow(
          *path_, [this](const Path&) { return list() || is_late() || has_outgrown(); }, options_.steps + 1,
          met_);
    } while (status.ok() && lost_.ok() && !is_at_end_);
    if (!lost_.ok()) return std::exchange(lost_, {});
    if (status.ok()) return status;
    if (Crossing* const met = near(path_->now(), 2 * length_of_step())) {
      arrive(*met);
      return {};
    }
    return failed_with(status.outcome(), "path: branch {} ends at a parameter of {:.10g}: {}", branch_,
                       path_->now().load, status.sentence());
  }

  [[nodiscard]] std::unique_ptr<Path> path_from(const VectorXd& x, double load) {
    return std::make_unique<Path>(path_method(options_, x), equations_, x, load);
  }
  /// Is an unknown ten times as large as its size? Lengths would measure it alone, and no longer the
  /// parameter.
  [[nodiscard]] bool has_outgrown() const {
    return taken_ >= next_resize_ && path_->now().x.cwiseAbs().cwiseProduct(scale_).maxCoeff() > 10;
  }
  /// Continues with the sizes of the last point; some steps later, if a new start has another direction, as
  /// beside a limit point.
  void resize() {
    next_resize_ = taken_ + 5;
    const PathPoint now = path_->now();
    std::unique_ptr<Path> next = path_from(now.x, now.load);
    const VectorXd change = path_method(options_, now.x).scale.cwiseQuotient(scale_);
    if (!next->start(now.slope > 0).ok() ||
        !(next->now().tangent.y.dot(now.tangent.y.cwiseProduct(change)) > 0))
      return;
    const double load_change = next->system().load_scale() / path_->system().load_scale();
    scale_ = scale_.cwiseProduct(change);
    path_ = std::move(next);
    first_.at = path_->system().scaled(first_.x, first_.load);
    for (Crossing& k : crossings_) {
      k.point.at = path_->system().scaled(k.point.x, k.point.load);
      PathVector& d = k.direction;
      if (d.y.size() > 0) d.y = d.y.cwiseProduct(change).eval(), d.m *= load_change;
      if (const double length = d.norm(); length > 0) d.y /= length, d.m /= length;
    }
  }

  /// Adds the points of the last step. @return true at the end of the branch
  bool list() { return is_at_end_ = add_points(); }
  bool add_points() {
    if (std::exchange(has_no_step_, false)) return false;
    ++taken_;
    PathPoint before = path_->before();
    for (; listed_ < met_.size(); ++listed_) {
      const CriticalPoint& c = met_[listed_];
      if (has_left(before, c.point)) return true;
      if (Crossing* const met = near(c.point, 1e-3 * length_of_step())) {
        arrive(*met);
        return true;
      }
      add(c.kind, c.point);
      // The sign of the vanishing eigenvalue is rounding.
      out_.points.back().negative = std::min(path_->before().negative, path_->now().negative);
      if (c.kind == CriticalPoint::Kind::bifurcation) crossings_.push_back({c.point, c.across, branch_});
      before = c.point;
    }
    if (has_left(before, path_->now())) return true;
    add(TypedPathPoint::Kind::step, path_->now());
    return has_returned();
  }

  bool is_late() {
    if (taken_ > options_.steps) {
      lost_ = failed_with(Outcome::step_limit,
                          "path: {} steps of branch {} end at a parameter of {:.10g}; allow more, or longer "
                          "ones (turn)",
                          options_.steps, branch_, path_->now().load);
      return true;
    }
    if (watch_.seconds() < options_.seconds) return false;
    lost_ = failed_with(Outcome::time_limit, "path: {:.6g} s end at a parameter of {:.10g}", options_.seconds,
                        path_->now().load);
    return true;
  }

  bool has_left(const PathPoint& from, const PathPoint& to) {
    if (to.load >= low_ && to.load <= high_) return false;
    const double end = to.load < low_ ? low_ : high_;
    // A branch that begins at an end of the range and leaves it at once.
    if ((from.load - end) * (to.load - end) > 0) return true;
    PathPoint last;
    const Outcome outcome = path_->crossing(end, from, to, last);
    if (outcome == Outcome::success && equations_.is_root(last.x, last.load))
      add(TypedPathPoint::Kind::step, last);
    else
      lost_ = failed_with(outcome == Outcome::success ? Outcome::not_converged : outcome,
                          "path: between {:.10g} and {:.10g} no point at {:.10g}; take shorter steps (turn)",
                          from.load, to.load, end);
    return true;
  }

  // A closed branch comes back to its first point.
  [[nodiscard]] bool has_returned() const {
    if (taken_ < 4) return false;
    const PathVector first = difference(path_->before().at, first_.at),
                     last = difference(path_->now().at, first_.at);
    const PathVector chord = difference(path_->now().at, path_->before().at);
    return first.dot(chord) < 0 && last.dot(chord) >= 0 &&
           std::min(first.norm(), last.norm()) < chord.norm() && path_->now().tangent.dot(chord) > 0 &&
           first.norm() + last.norm() < 1.05 * chord.norm();
  }

  void add(TypedPathPoint::Kind kind, const PathPoint& p) {
    out_.points.push_back({branch_, kind, p.load, p.x, p.negative});
  }
  static PathVector difference(const PathVector& a, const PathVector& b) { return {a.y - b.y, a.m - b.m}; }
  [[nodiscard]] double length_of_step() const {
    return path_->before().at.y.size() == 0 ? 0 : difference(path_->now().at, path_->before().at).norm();
  }
  Crossing* near(const PathPoint& point, double least) {
    Crossing* found = nullptr;
    for (Crossing& k : crossings_) {
      const double off = difference(k.point.at, point.at).norm();
      if (k.branch == branch_ || off > least) continue;
      least = off;
      found = &k;
    }
    return found;
  }
  void arrive(Crossing& met) {
    add(TypedPathPoint::Kind::bifurcation, met.point);
    met.is_open[path_->before().tangent.dot(met.direction) > 0 ? 1 : 0] = false;
  }

  Stopwatch watch_;
  TypedPathOptions options_;
  double low_, high_;
  LoadedSystem equations_;
  VectorXd scale_;  ///< reciprocal sizes of the unknowns
  std::unique_ptr<Path> path_;
  TypedPaths out_;
  std::vector<Crossing> crossings_;
  std::vector<CriticalPoint> met_;
  std::size_t listed_ = 0;
  PathPoint first_;
  Status lost_;
  bool is_at_end_ = false, has_no_step_ = true;
  int branch_ = 0, taken_ = 0, next_resize_ = 0;
};

}  // namespace

TypedPaths follow_paths(const TypedSystem& system, const VectorXd& root, const TypedPathOptions& options) {
  return BranchTracer(system, root, options).run();
}

}  // namespace nlmech::algebraic
