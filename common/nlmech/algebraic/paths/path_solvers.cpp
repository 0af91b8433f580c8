#include "nlmech/algebraic/paths/path_solvers.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::algebraic {
namespace {

const char* name_of(const PathMethod& method) {
  switch (method.kind) {
    case PathMethod::Kind::crisfield: return "crisfield";
    case PathMethod::Kind::gdc: return "gdc";
    default: return "riks";
  }
}

/// Newton homotopy F(x) - (1 - load) F(x0): solved by x0 at load 0 and by the roots of F at load 1. For a
/// structure under dead load with x0 at rest, `load` is the fraction of the dead load.
class NewtonEmbedding final : public Loaded {
 public:
  NewtonEmbedding(Equations& equations, const Eigen::VectorXd& x0)
      : equations_(equations),
        f0_(x0.size()),
        is_symmetric_(dynamic_cast<const Potential*>(&equations) != nullptr) {
    equations_.residual(x0, f0_);
  }

  /// F(x0), which is not finite if F does not exist there.
  [[nodiscard]] const Eigen::VectorXd& start() const { return f0_; }
  [[nodiscard]] Eigen::Index size() const override { return f0_.size(); }
  void residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) override {
    equations_.residual(x, f);
    f -= (1 - load) * f0_;
  }
  void linearise(const Eigen::VectorXd& x, double /*load*/) override { equations_.linearise(x); }
  void load_vector(Eigen::VectorXd& q) const override { q = f0_; }
  void matrix(Eigen::MatrixXd& k) const override { equations_.matrix(k); }
  [[nodiscard]] const Eigen::SparseMatrix<double>* sparse() const override { return equations_.sparse(); }
  [[nodiscard]] bool is_symmetric() const override { return is_symmetric_; }
  [[nodiscard]] Status status() const override { return equations_.status(); }

 private:
  Equations& equations_;
  Eigen::VectorXd f0_;
  bool is_symmetric_;
};

class Search {
 public:
  Search(const ArcLength& method, Equations& equations, const Eigen::VectorXd& x, const Observer& observer)
      : method_(method),
        equations_(equations),
        observer_(observer),
        embedding_(equations, x),
        path_(method.path, embedding_, x, 0) {}

  Report run(Eigen::VectorXd& x) {
    Status status = start();
    while (status.ok() && !is_found_) {
      if (path_.statistics().steps + path_.statistics().rejected >= method_.steps) {
        status = failed_with(Outcome::step_limit,
                             "{}: after {} steps ({} rejected) the path is at load {:.6g} of 1; allow more "
                             "steps or a longer first one",
                             name_of(method_.path), path_.statistics().steps, path_.statistics().rejected,
                             path_.now().load);
        break;
      }
      status = path_.advance();
      if (status.ok()) status = observe(path_.now());
      if (status.ok()) status = search_step();
    }
    return finish(std::move(status), x);
  }

 private:
  Status start() {
    report_.first = report_.least = report_.last = embedding_.start().norm();
    if (!std::isfinite(report_.first))
      return failed_with(Outcome::non_finite, "{}: F is not finite at the start; start elsewhere",
                         name_of(method_.path));
    is_found_ = report_.first == 0;  // x0 is a root
    found_ = path_.now();
    if (is_found_) {
      found_.x = path_.system().unscaled(found_.at.y);
      found_.load = 1;
      return {};
    }
    const Status status = path_.start();
    return status.ok() ? observe(path_.now()) : status;
  }

  /// F(x) on the path is (1 - load) F(x0).
  Status observe(const PathPoint& point) {
    rest_ = (1 - point.load) * embedding_.start();
    report_.last = rest_.norm();
    report_.least = std::min(report_.least, report_.last);
    report_.time = point.load;
    if (!observer_ || observer_({seen_++, point.load, point.x, rest_, report_.last})) return {};
    return failed_with(Outcome::interrupted, "{}: stopped by the observer at load {:.6g} of 1",
                       name_of(method_.path), point.load);
  }

  //! [limit points decide]
  /// Did the last step reach a load of 1?
  Status search_step() {
    std::vector<PathPoint> ends;
    Outcome outcome = path_.folds(ends);
    for (const PathPoint& fold : ends) {
      // The required load is the limit load to rounding.
      if (outcome != Outcome::success || std::abs(fold.load - 1) > 4 * eps) continue;
      found_ = fold;
      is_found_ = true;
      return {};
    }
    ends.push_back(path_.now());
    PathPoint begin = path_.before();
    for (const PathPoint& end : ends) {
      if (outcome != Outcome::success || is_found_) break;
      if ((begin.load < 1) != (end.load < 1)) {
        outcome = path_.crossing(1, begin, end, found_);
        is_found_ = outcome == Outcome::success;
      }
      begin = end;
    }
    if (outcome == Outcome::success) return {};
    return failed_with(
        outcome,
        "{}: no limit point and no end is found between loads {:.9g} and {:.9g} of 1; take shorter steps",
        name_of(method_.path), path_.before().load, path_.now().load);
  }
  //! [limit points decide]

  Report finish(Status status, Eigen::VectorXd& x) {
    const PathPoint& end = is_found_ ? found_ : path_.now();
    if (end.x.size() > 0) x = end.x;
    report_.statistics = path_.statistics();
    report_.status = std::move(status);
    if (!is_found_) return std::move(report_);
    Eigen::VectorXd f(x.size());
    equations_.residual(x, f);
    ++report_.statistics.right_hand_sides;
    report_.last = f.norm();
    report_.least = std::min(report_.least, report_.last);
    report_.time = 1;
    if (equations_.status().outcome() == Outcome::wrong_branch) report_.status = equations_.status();
    return std::move(report_);
  }

  const ArcLength& method_;
  Equations& equations_;
  const Observer& observer_;
  NewtonEmbedding embedding_;
  Path path_;
  PathPoint found_;
  Eigen::VectorXd rest_;
  Report report_;
  bool is_found_ = false;
  std::int64_t seen_ = 0;
};

}  // namespace

Report find_root(const ArcLength& method, Equations& equations, Eigen::VectorXd& x,
                 const Observer& observer) {
  require_size(name_of(method.path), equations, x);
  return Search(method, equations, x, observer).run(x);
}

}  // namespace nlmech::algebraic
