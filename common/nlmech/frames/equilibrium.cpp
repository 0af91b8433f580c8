#include "nlmech/frames/equilibrium.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <utility>

#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {
namespace {

void require_load(double load) {
  if (!std::isfinite(load)) throw invalid_argument("Equilibrium: load {}; it must be finite", load);
}

}  // namespace

Equilibrium::Equilibrium(const Frame& frame, Eigen::VectorXd direction, double load, Coupling coupling)
    : frame_(frame), direction_(std::move(direction)), load_(load), coupling_(coupling) {
  require_load(load);
  if (direction_.size() != frame.size() || !direction_.allFinite()) {
    throw invalid_argument("Equilibrium: {} forces for {} unknowns, or some are not finite",
                           direction_.size(), frame.size());
  }
}

void Equilibrium::residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) {
  status_ = frame_.force(x, f);
  if (has_values(status_))
    f -= load_ * direction_;
  else
    f.setConstant(nan);
}

void Equilibrium::linearise(const Eigen::VectorXd& x) {
  status_ = frame_.tangent(x, tangent_, coupling_);
  if (!has_values(status_)) tangent_.coeffs().setConstant(nan);
}

double Equilibrium::energy(const Eigen::VectorXd& x) {
  const Energy<double> energy = frame_.energy(x);
  status_ = energy.status;
  return has_values(status_) ? energy.value - load_ * direction_.dot(x) : nan;
}

WilliamsEquilibrium::WilliamsEquilibrium(const Williams& toggle, double load) : toggle_(toggle), load_(load) {
  require_load(load);
  for (const double number : {toggle.height, toggle.length, toggle.ea, toggle.ei}) {
    if (!(number > 0 && std::isfinite(number)))
      throw invalid_argument("WilliamsEquilibrium: {} among height, length, EA, EI; all are positive",
                             number);
  }
}

void WilliamsEquilibrium::residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) {
  const Outcome outcome = toggle_.outcome(x[0]);
  status_ = {};
  if (outcome == Outcome::success) {
    f.setConstant(1, (toggle_.load(x[0]) - load_) / 2);
    return;
  }
  f.setConstant(1, nan);
  status_ = failed_with(outcome,
                        "Williams' equation: at a drop of {:.6g} the compression of a member is at or past "
                        "the pole of d_5; take a smaller drop, or the element model",
                        x[0]);
}

void WilliamsEquilibrium::linearise(const Eigen::VectorXd& x) {
  slope_ = toggle_.outcome(x[0]) == Outcome::success ? toggle_.stiffness(x[0]) / 2 : nan;
}

double WilliamsEquilibrium::energy(const Eigen::VectorXd& x) {
  const double delta = x[0];
  // Compression is greatest at height/1.2 (2.18); past a pole on the way the integral does not exist.
  const double worst = std::clamp(toggle_.height / 1.2, std::min(0., delta), std::max(0., delta));
  if (toggle_.outcome(worst) != Outcome::success || toggle_.outcome(delta) != Outcome::success) return nan;
  // An analytic integrand: 31 nodes a panel, halved where that is not enough.
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  return Rule::integrate([&](double d) { return (toggle_.load(d) - load_) / 2; }, 0., delta, 8, 1e-15);
}

}  // namespace nlmech::frames
