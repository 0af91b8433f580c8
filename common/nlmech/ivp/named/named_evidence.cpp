#include "nlmech/ivp/named/named_evidence.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/ivp/series/series.hpp"

namespace nlmech::ivp::named {
namespace {

constexpr int most_eigenvalues = 200;  // of a system of more components they would cost more than its runs

/// By how many tolerances a state breaks invariants and bounds of its system.
class Laws {
 public:
  Laws(const System& system, const State& x0, double t0, double t1, double tolerance)
      : system_(&system), tolerance_(std::max(tolerance, 1e-14)) {
    has_invariants_ = system.invariants(t0, x0, first_);
    // Bounds hold at later times, of a solution that begins within them.
    has_bounds_ = t1 > t0 && system.bounds(lower_, upper_) && (x0.array() >= lower_.array()).all() &&
                  (x0.array() <= upper_.array()).all();
  }
  [[nodiscard]] bool any() const { return has_invariants_ || has_bounds_; }

  [[nodiscard]] double operator()(double t, const State& x) const {
    double most = 0;
    if (has_bounds_) {
      for (Eigen::Index i = 0; i < x.size(); ++i)
        most = std::max(most, std::max(lower_[i] - x[i], x[i] - upper_[i]) / unit(x, i));
    }
    if (!has_invariants_) return most;
    Eigen::VectorXd now, moved, room = Eigen::VectorXd::Zero(first_.size());
    static_cast<void>(system_->invariants(t, x, now));
    State y = x;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      y[i] = x[i] + unit(x, i);
      static_cast<void>(system_->invariants(t, y, moved));
      room += (moved - now).cwiseAbs();
      y[i] = x[i];
    }
    for (Eigen::Index k = 0; k < now.size(); ++k) {
      const double off = std::abs(now[k] - first_[k]);
      if (off > 0) most = std::max(most, off / room[k]);
    }
    return most;
  }

 private:
  [[nodiscard]] double unit(const State& x, Eigen::Index i) const {
    return tolerance_ * (1 + std::abs(x[i]));
  }

  const System* system_;
  double tolerance_;
  Eigen::VectorXd first_;
  State lower_, upper_;
  bool has_invariants_ = false, has_bounds_ = false;
};

}  // namespace

double highest_frequency(const System& system, double t, const State& x) {
  double highest = 0;
  for (const Harmonic& h : system.load()) {
    if (h.cosine != 0 || h.sine != 0) highest = std::max(highest, std::abs(h.frequency));
  }
  if (system.size() > most_eigenvalues) return highest;
  Jacobian j(system.size(), system.size());
  system.jacobian(t, x, j);
  if (!j.allFinite()) return highest;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(j), false);
  if (solver.info() != Eigen::Success) return highest;
  const double imaginary = solver.eigenvalues().imag().cwiseAbs().maxCoeff();
  return std::isfinite(imaginary) ? std::max(highest, imaginary) : highest;
}

Evidence evidence_of(const System& system, const State& x0, double t0, double t1, double tolerance) {
  Evidence evidence;
  const double within = std::clamp(tolerance / 1000, 1e-13, 1e-6);
  evidence.references.push_back([&system, &x0, t0, t1](const Observer& observer, const Limits& limits) {
    try {
      const Series series{.relative_tolerance = 1e-16, .absolute_tolerance = 1e-16};
      return integrate(system, x0, t0, t1, series, observer, limits);
    } catch (const std::invalid_argument& why) {  // it cannot be expanded
      return Solution{t0, x0, Status::failure(Outcome::outside_validity, why.what()), {}};
    }
  });
  evidence.references.push_back(
      [&system, &x0, t0, t1, within](const Observer& observer, const Limits& limits) {
        // A step costs as much as some ten of the series.
        Limits fewer = limits;
        fewer.steps = std::max<std::int64_t>(limits.steps / 8, 1);
        const AdaptiveCollocation method{.relative_tolerance = within, .absolute_tolerance = within};
        return integrate(system, x0, t0, t1, method, observer, fewer);
      });
  const Laws laws(system, x0, t0, t1, tolerance);
  if (laws.any()) evidence.violation = laws;
  return evidence;
}

}  // namespace nlmech::ivp::named
