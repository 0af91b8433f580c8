#include "nlmech/algebraic/typed/typed_path.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "nlmech/algebraic/paths/path_step.hpp"
#include "nlmech/algebraic/typed/bifurcation.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::algebraic {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Typed equations with a parameter, for unknowns y = x/size. Each is divided by its change at the start when
/// the unknowns change by their sizes; the gradient of an energy by the greatest of these.
class LoadedSystem final : public Loaded {
 public:
  LoadedSystem(const TypedSystem& system, const VectorXd& sizes, const VectorXd& x, double parameter)
      : system_(system),
        sizes_(sizes),
        left_(system.has_energy() ? sizes : VectorXd::Ones(sizes.size())),
        rows_(VectorXd::Ones(sizes.size())) {
    linearise(x.cwiseQuotient(sizes), parameter);
    rows_ = j_.leftCols(size()).cwiseAbs().rowwise().sum();
    if (system.has_energy()) rows_.setConstant(rows_.maxCoeff());
    for (double& row : rows_) row = row > 0 && std::isfinite(row) ? row : 1;
  }

  [[nodiscard]] Index size() const override { return system_.size(); }
  [[nodiscard]] const VectorXd& sizes() const { return sizes_; }
  void residual(const VectorXd& y, double load, VectorXd& f) override {
    const VectorXd x = y.cwiseProduct(sizes_);
    status_ = {};
    if (system_.contains(x)) {
      system_.residual(with(x, load), f);
    } else {
      f.setConstant(size(), std::numeric_limits<double>::quiet_NaN());
      Index i = 0;
      while (x[i] >= system_.lower()[i] && x[i] <= system_.upper()[i]) ++i;
      if (std::isfinite(x[i]))
        status_ = failed_with(Outcome::wrong_branch, "{} reaches its bound {:.10g}",
                              quoted_input(system_.names()[static_cast<std::size_t>(i)]),
                              x[i] < system_.lower()[i] ? system_.lower()[i] : system_.upper()[i]);
    }
    f = f.cwiseProduct(left_).cwiseQuotient(rows_);
  }
  [[nodiscard]] Status status() const override { return status_; }
  void linearise(const VectorXd& y, double load) override {
    system_.derivative(with(y.cwiseProduct(sizes_), load), j_);
    j_.leftCols(size()) *= sizes_.asDiagonal();
    j_ = (left_.cwiseQuotient(rows_).asDiagonal() * j_).eval();
  }
  /// Is y a root to 1e-6 of itself or 1e-9 of its sizes, and the parameter to 1e-6 of itself?
  /// @param scale reciprocal sizes of the unknowns
  [[nodiscard]] bool is_root(const VectorXd& y, double load, const VectorXd& scale) {
    VectorXd f, slack(y.size() + 1);
    residual(y, load, f);
    linearise(y, load);
    slack << 1e-6 * y.cwiseAbs() + 1e-9 * scale.cwiseInverse(), 1e-6 * std::abs(load);
    return (f.array().abs() <= (j_.cwiseAbs() * slack).array()).all();
  }
  /// dF/dx of linearise(), with dF/dload as the last column.
  [[nodiscard]] const MatrixXd& derivative() const { return j_; }
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
  VectorXd sizes_, left_, rows_;
  MatrixXd j_;
  Status status_;
};

/// Reciprocal sizes of the unknowns at @p x: a small one has the size of the largest.
VectorXd scale_at(const VectorXd& x) {
  const double largest = x.cwiseAbs().maxCoeff(), least = 1e-3 * largest;
  return x.unaryExpr([=](double v) {
    return 1 / (std::abs(v) > least && v != 0 ? std::abs(v) : largest > 0 ? largest : 1);
  });
}

/// Sizes of the unknowns, rounded to powers of 2.
VectorXd sizes_at(const VectorXd& x) {
  return scale_at(x).unaryExpr([](double s) { return std::ldexp(1, -std::ilogb(s)); });
}

/// Follows all branches of typed equations.
class BranchTracer {
 public:
  BranchTracer(const TypedSystem& system, const VectorXd& root, const TypedPathOptions& options)
      : options_(options),
        low_(std::min(options.from, options.until)),
        high_(std::max(options.from, options.until)),
        equations_(system, sizes_at(root), root, options.from),
        scale_(scale_at(root.cwiseQuotient(equations_.sizes()))),
        path_(path_from(root.cwiseQuotient(equations_.sizes()), options.from)) {}

  TypedPaths run() {
    Status status = path_->start(options_.until > options_.from);
    if (status.ok()) {
      add(TypedPathPoint::Kind::step, path_->now());
      status = along();
    }
    out_.status = status;
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      for (std::size_t half = 0; half < crossings_[i].halves.size(); ++half) follow_half(i, half);
    }
    return std::move(out_);
  }

 private:
  /// A half branch at a bifurcation point.
  struct Half {
    PathVector offset;    ///< from the bifurcation point to a point of the half branch, scaled
    bool is_open = true;  ///< is it not yet followed?
  };
  struct Crossing {
    PathPoint point;
    int branch, step;  ///< where it was found
    std::vector<Half> halves;
  };
  /// A critical point in the last step; at a bifurcation with points of this path behind and ahead.
  struct Critical {
    CriticalPoint critical;
    double part = 0;
    std::vector<Half> halves = {};
    PathVector behind = {}, ahead = {};
  };

  void follow_half(std::size_t i, std::size_t half) {
    if (!crossings_[i].halves[half].is_open) return;
    if (branch_ >= options_.branches) {
      ++out_.unfollowed;
      return;
    }
    crossings_[i].halves[half].is_open = false;
    const Crossing from = crossings_[i];
    Status status;
    const PathVector& offset = from.halves[half].offset;
    for (double reach = offset.norm(); reach > 1e-5 * offset.norm(); reach /= 4) {
      status = path_->switch_branch(from.point, unit(offset), reach);
      if (status.ok()) break;
    }
    const double load = path_->now().load, end = load < low_ ? low_ : high_;
    const bool is_outside = load < low_ || load > high_;
    if (status.ok() && is_outside && std::abs(from.point.load - end) <= 1e-9 * (high_ - low_)) return;
    if (status.ok()) {
      ++branch_;
      add(TypedPathPoint::Kind::bifurcation, from.point);
      if (has_left(from.point, path_->now())) {
        status = std::exchange(lost_, {});
      } else {
        add(TypedPathPoint::Kind::step, path_->now());
        status = along();
      }
    }
    if (out_.status.ok()) out_.status = status;
  }

  Status along() {
    first_ = path_->now();
    taken_ = next_resize_ = 0;
    Status status;
    while (!is_late()) {
      if (has_outgrown()) resize();
      std::vector<CriticalPoint> met;
      bool has_step = false;
      status = follow(
          *path_, [&](const Path&) { return std::exchange(has_step, true); }, 2, met);
      if (!status.ok() || add_points(met)) break;
    }
    if (status.ok()) return std::exchange(lost_, {});
    if (Crossing* const met = near(path_->now(), 2 * length_of_step());
        met != nullptr && met->branch != branch_ &&
        path_->now().tangent.dot(difference(met->point.at, path_->now().at)) > 0) {
      add(TypedPathPoint::Kind::bifurcation, met->point);
      close(*met, path_->now().at);
      return {};
    }
    return failed_with(status.outcome(), "path: branch {} ends at a parameter of {:.10g}: {}", branch_,
                       path_->now().load, status.sentence());
  }

  [[nodiscard]] std::unique_ptr<Path> path_from(const VectorXd& x, double load) {
    PathMethod method{.first = (high_ - low_) / 100,
                      .turn = options_.turn,
                      .longest = 10,
                      .iterations = 12,
                      .scale = scale_at(x)};
    auto path = std::make_unique<Path>(method, equations_, x, load);
    // Shorter steps would be rounding of the unknowns.
    const double least = 1e-8 * path->system().scaled(x, 0).norm() / path->system().load_scale();
    if (method.first >= least) return path;
    method.first = std::min(least, high_ - low_);
    return std::make_unique<Path>(method, equations_, x, load);
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
    const VectorXd change = scale_at(now.x).cwiseQuotient(scale_);
    if (!next->start(now.slope > 0).ok() ||
        !(next->now().tangent.y.dot(now.tangent.y.cwiseProduct(change)) > 0))
      return;
    const double load_change = next->system().load_scale() / path_->system().load_scale();
    scale_ = scale_.cwiseProduct(change);
    path_ = std::move(next);
    first_.at = path_->system().scaled(first_.x, first_.load);
    for (Crossing& k : crossings_) {
      k.point.at = path_->system().scaled(k.point.x, k.point.load);
      for (Half& half : k.halves)
        half.offset = {half.offset.y.cwiseProduct(change), half.offset.m * load_change};
    }
  }

  /// Adds the points of the last step, with those that Path has found in it. @return true at the end of the
  /// branch
  bool add_points(const std::vector<CriticalPoint>& of_path) {
    ++taken_;
    PathPoint before = path_->before();
    for (const Critical& found : critical_points(of_path)) {
      const CriticalPoint& c = found.critical;
      if (has_left(before, c.point)) return true;
      before = c.point;
      const bool is_refined = found.behind.y.size() > 0;
      Crossing* const met = near(c.point, 1e-3 * length_of_step());
      if (met != nullptr && (is_refined || met->branch != branch_)) {
        if (met->branch == branch_ && taken_ - met->step < 2) continue;
        add(TypedPathPoint::Kind::bifurcation, met->point);
        close(*met, is_refined ? found.behind : path_->before().at);
        if (met->branch != branch_) return true;
        close(*met, found.ahead);
        met->step = taken_;
        continue;
      }
      add(c.kind, c.point);
      // The sign of the vanishing eigenvalue is rounding.
      out_.points.back().negative = std::min(path_->before().negative, path_->now().negative);
      if (c.kind != CriticalPoint::Kind::bifurcation) continue;
      crossings_.push_back({c.point, branch_, taken_, found.halves});
      if (is_refined) {
        close(crossings_.back(), found.behind);
        close(crossings_.back(), found.ahead);
      }
      if (std::ranges::none_of(crossings_.back().halves, &Half::is_open)) ++out_.unresolved;
    }
    if (has_left(before, path_->now())) return true;
    if (!equations_.is_root(path_->now().x, path_->now().load, scale_)) {
      lost_ = failed_with(Outcome::not_converged,
                          "path: branch {} ends at a parameter of {:.10g}: points beyond it do not solve the "
                          "equations to six digits: an unknown grows without bound, F ends, or shorter steps "
                          "are needed (turn)",
                          branch_, before.load);
      return true;
    }
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
    if (outcome == Outcome::success && equations_.is_root(last.x, last.load, scale_))
      add(TypedPathPoint::Kind::step, last);
    else
      lost_ = failed_with(
          outcome == Outcome::success ? Outcome::not_converged : outcome,
          "path: between {:.10g} and {:.10g} no root is found at {:.10g}: an unknown grows without "
          "bound there, or shorter steps are needed (turn)",
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
    out_.points.push_back({branch_, kind, p.load, p.x.cwiseProduct(equations_.sizes()), p.negative});
  }
  static PathVector difference(const PathVector& a, const PathVector& b) { return {a.y - b.y, a.m - b.m}; }
  [[nodiscard]] double length_of_step() const {
    return path_->before().at.y.size() == 0 ? 0 : difference(path_->now().at, path_->before().at).norm();
  }
  /// The nearest crossing within @p farthest; null if there is none.
  Crossing* near(const PathPoint& point, double farthest) {
    const auto distance = [&](const Crossing& k) { return difference(k.point.at, point.at).norm(); };
    const auto nearest = std::ranges::min_element(crossings_, {}, distance);
    return nearest == crossings_.end() || distance(*nearest) > farthest ? nullptr : &*nearest;
  }
  /// The half branch towards @p at is followed.
  static void close(Crossing& k, const PathVector& at) {
    const PathVector towards = unit(difference(at, k.point.at));
    const auto nearest = std::ranges::max_element(
        k.halves, {}, [&](const Half& half) { return unit(half.offset).dot(towards); });
    if (nearest != k.halves.end() && unit(nearest->offset).dot(towards) > 0.9) nearest->is_open = false;
  }
  static PathVector unit(const PathVector& v) {
    const double length = v.norm();
    return {v.y / length, v.m / length};
  }

  /// F and its derivatives in the scaled unknowns of the path.
  void evaluate(const VectorXd& z, VectorXd& f, MatrixXd& j) {
    const PathSystem& system = path_->system();
    const Index n = system.size();
    const VectorXd& s = system.scale();
    const VectorXd x = system.unscaled(z.head(n));
    const double load = z[n] / system.load_scale();
    equations_.residual(x, load, f);
    equations_.linearise(x, load);
    f = f.cwiseQuotient(s);
    j = s.cwiseInverse().asDiagonal() * equations_.derivative();
    j.leftCols(n) *= s.cwiseInverse().asDiagonal();
    j.col(n) /= system.load_scale();
  }
  [[nodiscard]] static VectorXd joined(const PathVector& at) {
    VectorXd z(at.y.size() + 1);
    z << at.y, at.m;
    return z;
  }

  /// Critical points of the last step in order: those of Path, and bifurcations where the least singular
  /// value of dF/d(x, load) has a minimum of 0: two that cancel each other, or without change of sign.
  [[nodiscard]] std::vector<Critical> critical_points(const std::vector<CriticalPoint>& met) {
    std::vector<Critical> all;
    for (const CriticalPoint& found : met) {
      Critical& c = all.emplace_back(Critical{found, part_of(found.point.at)});
      if (c.critical.kind != CriticalPoint::Kind::bifurcation) continue;
      const PathVector& d = c.critical.across;
      if ((!refine(c) || c.halves.empty()) && d.y.size() > 0)
        c.halves = {{{0.02 * d.y, 0.02 * d.m}}, {{-0.02 * d.y, -0.02 * d.m}}};
    }
    const auto is_near = [&](const Critical& a) {
      return [&](const Critical& b) {
        return &a != &b && b.critical.kind == CriticalPoint::Kind::bifurcation &&
               difference(a.critical.point.at, b.critical.point.at).norm() < 1e-5 * length_of_step();
      };
    };
    constexpr std::size_t places = 11;  // one before the step, one after it
    std::array<double, places> least{};
    std::array<PathVector, places> at;
    VectorXd f;
    MatrixXd j;
    for (std::size_t i = 0; i < places; ++i) {
      at[i] = between_by_cubic(path_->before(), path_->now(), (static_cast<double>(i) - 1) / (places - 3));
      evaluate(joined(at[i]), f, j);
      least[i] = !j.allFinite() ? HUGE_VAL
                                : std::sqrt(std::abs(Eigen::SelfAdjointEigenSolver<MatrixXd>(
                                                         j * j.transpose(), Eigen::EigenvaluesOnly)
                                                         .eigenvalues()[0]));
    }
    for (std::size_t i = 1; i + 1 < places; ++i) {
      if (!(least[i] < least[i - 1] && least[i] <= least[i + 1] &&
            least[i] < 0.5 * std::max(least[i - 1], least[i + 1])))
        continue;
      Critical c;
      c.critical.point.at = at[i];
      if (refine(c) && std::ranges::none_of(all, is_near(c))) all.push_back(std::move(c));
    }
    // A bifurcation point at which the parameter has an extremum is listed once.
    std::vector<Critical> kept;
    for (const Critical& c : all) {
      if (c.critical.kind == CriticalPoint::Kind::bifurcation || std::ranges::none_of(all, is_near(c)))
        kept.push_back(c);
    }
    std::ranges::sort(kept, {}, &Critical::part);
    return kept;
  }
  [[nodiscard]] double part_of(const PathVector& at) const {
    const PathPoint& before = path_->before();
    return difference(at, before.at).dot(before.tangent) /
           difference(path_->now().at, before.at).dot(before.tangent);
  }
  /// Replaces the point of @p c by the bifurcation point near it through which the path passes. @return
  /// false, without effect, if there is none in the step
  bool refine(Critical& c) {
    const CurveEquations curve = [this](const VectorXd& z, VectorXd& f, MatrixXd& j) { evaluate(z, f, j); };
    const double length = length_of_step();
    const auto z = bifurcation_near(curve, joined(c.critical.point.at), 0.5 * length);
    if (!z) return false;
    const Index n = z->size() - 1;
    const PathVector at{z->head(n), (*z)[n]};
    const double part = part_of(at);
    if (!(part > -1e-6 && part < 1 + 1e-6)) return false;
    double radius = std::min(0.02, 0.1 * length);
    std::vector<VectorXd> points = half_branches(curve, *z, radius);
    // Another bifurcation within the circle changes the number of half branches.
    for (int k = 0; k < 3; ++k) {
      std::vector<VectorXd> nearer = half_branches(curve, *z, radius / 4);
      if (nearer.size() == points.size()) break;
      points = std::move(nearer);
      radius /= 4;
    }
    PathPoint behind, ahead;
    for (const double reach : {1e-3, radius / length}) {
      if (path_->between(part - reach, behind) != Outcome::success ||
          path_->between(part + reach, ahead) != Outcome::success)
        return false;
      const PathVector gone = difference(ahead.at, behind.at), one = difference(at, behind.at),
                       other = difference(ahead.at, at);
      if (!(difference(one, other).norm() <= 0.1 * gone.norm())) return false;
    }
    for (const VectorXd& p : points) c.halves.push_back({{p.head(n) - at.y, p[n] - at.m}});
    c.part = part;
    c.behind = behind.at;
    c.ahead = ahead.at;
    PathPoint& point = c.critical.point;
    point.at = at;
    point.x = path_->system().unscaled(at.y);
    point.load = at.m / path_->system().load_scale();
    if (point.tangent.y.size() == 0) point.tangent = path_->now().tangent;
    return true;
  }

  Stopwatch watch_;
  TypedPathOptions options_;
  double low_, high_;
  LoadedSystem equations_;
  VectorXd scale_;  ///< reciprocal sizes of the unknowns
  std::unique_ptr<Path> path_;
  TypedPaths out_;
  std::vector<Crossing> crossings_;
  PathPoint first_;
  Status lost_;
  int branch_ = 0, taken_ = 0, next_resize_ = 0;
};

}  // namespace

TypedPaths follow_paths(const TypedSystem& system, const VectorXd& root, const TypedPathOptions& options) {
  return BranchTracer(system, root, options).run();
}

}  // namespace nlmech::algebraic
