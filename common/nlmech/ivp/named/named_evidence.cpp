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
template <int n>
class Laws {
 public:
  Laws(const System<n>& system, const State<n>& x0, double t0, double t1, double tolerance)
      : system_(&system), tolerance_(std::max(tolerance, 1e-14)) {
    has_invariants_ = system.invariants(t0, x0, first_);
    // Bounds hold at later times, of a solution that begins within them.
    has_bounds_ = t1 > t0 && system.bounds(lower_, upper_) && (x0.array() >= lower_.array()).all() &&
                  (x0.array() <= upper_.array()).all();
  }
  [[nodiscard]] bool any() const { return has_invariants_ || has_bounds_; }

  [[nodiscard]] double operator()(double t, const State<n>& x) const {
    double most = 0;
    if (has_bounds_) {
      for (Eigen::Index i = 0; i < x.size(); ++i)
        most = std::max(most, std::max(lower_[i] - x[i], x[i] - upper_[i]) / unit(x, i));
    }
    if (!has_invariants_) return most;
    Eigen::VectorXd now, moved, room = Eigen::VectorXd::Zero(first_.size());
    static_cast<void>(system_->invariants(t, x, now));
    State<n> y = x;
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
  [[nodiscard]] double unit(const State<n>& x, Eigen::Index i) const {
    return tolerance_ * (1 + std::abs(x[i]));
  }

  const System<n>* system_;
  double tolerance_;
  Eigen::VectorXd first_;
  State<n> lower_, upper_;
  bool has_invariants_ = false, has_bounds_ = false;
};

}  // namespace

template <int n>
double highest_frequency(const System<n>& system, double t, const State<n>& x) {
  double highest = 0;
  for (const Harmonic& h : system.load()) {
    if (h.cosine != 0 || h.sine != 0) highest = std::max(highest, std::abs(h.frequency));
  }
  if (system.size() > most_eigenvalues) return highest;
  Jacobian<n> j(system.size(), system.size());
  system.jacobian(t, x, j);
  if (!j.allFinite()) return highest;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(j), false);
  if (solver.info() != Eigen::Success) return highest;
  const double imaginary = solver.eigenvalues().imag().cwiseAbs().maxCoeff();
  return std::isfinite(imaginary) ? std::max(highest, imaginary) : highest;
}

template <int n>
Evidence<n> evidence_of(const System<n>& system, const State<n>& x0, double t0, double t1, double tolerance) {
  Evidence<n> evidence;
  const double within = std::clamp(tolerance / 1000, 1e-13, 1e-6);
  evidence.references.push_back([&system, &x0, t0, t1](const Observer<n>& observer, const Limits& limits) {
    try {
      const Series series{.relative_tolerance = 1e-16, .absolute_tolerance = 1e-16};
      return integrate(system, x0, t0, t1, series, observer, limits);
    } catch (const std::invalid_argument& why) {  // it cannot be expanded
      return Solution<n>{t0, x0, Status::failure(Outcome::outside_validity, why.what()), {}};
    }
  });
  evidence.references.push_back(
      [&system, &x0, t0, t1, within](const Observer<n>& observer, const Limits& limits) {
        // A step costs as much as some ten of the series.
        Limits fewer = limits;
        fewer.steps = std::max<std::int64_t>(limits.steps / 8, 1);
        const AdaptiveCollocation method{.relative_tolerance = within, .absolute_tolerance = within};
        return integrate(system, x0, t0, t1, method, observer, fewer);
      });
  const Laws<n> laws(system, x0, t0, t1, tolerance);
  if (laws.any()) evidence.violation = laws;
  return evidence;
}

template double highest_frequency(const System<1>&, double, const State<1>&);
template double highest_frequency(const System<2>&, double, const State<2>&);
template double highest_frequency(const System<3>&, double, const State<3>&);
template double highest_frequency(const System<4>&, double, const State<4>&);
template double highest_frequency(const System<6>&, double, const State<6>&);
template double highest_frequency(const System<Eigen::Dynamic>&, double, const State<Eigen::Dynamic>&);
template Evidence<1> evidence_of(const System<1>&, const State<1>&, double, double, double);
template Evidence<2> evidence_of(const System<2>&, const State<2>&, double, double, double);
template Evidence<3> evidence_of(const System<3>&, const State<3>&, double, double, double);
template Evidence<4> evidence_of(const System<4>&, const State<4>&, double, double, double);
template Evidence<6> evidence_of(const System<6>&, const State<6>&, double, double, double);
template Evidence<Eigen::Dynamic> evidence_of(const System<Eigen::Dynamic>&, const State<Eigen::Dynamic>&,
                                              double, double, double);

}  // namespace nlmech::ivp::named
