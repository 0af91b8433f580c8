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
    : loaded_(frame, std::move(direction), coupling), load_(load) {
  require_load(load);
}

void Equilibrium::residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) {
  loaded_.residual(x, load_, f);
  status_ = loaded_.status();
}

void Equilibrium::linearise(const Eigen::VectorXd& x) {
  loaded_.linearise(x, load_);
  status_ = loaded_.status();
}

double Equilibrium::energy(const Eigen::VectorXd& x) {
  const Energy<double> energy = frame().energy(x);
  status_ = energy.status;
  return has_values(status_) ? energy.value - load_ * direction().dot(x) : nan;
}

WilliamsEquilibrium::WilliamsEquilibrium(const Williams& toggle, double load) : loaded_(toggle), load_(load) {
  require_load(load);
}

void WilliamsEquilibrium::residual(const Eigen::VectorXd& x, Eigen::VectorXd& f) {
  loaded_.residual(x, load_, f);
  const Outcome outcome = toggle().outcome(x[0]);
  status_ = {};
  if (outcome == Outcome::success) return;
  status_ = failed_with(outcome,
                        "Williams' equation: at a drop of {:.6g} the compression of a member is at or past "
                        "the pole of d_5; take a smaller drop, or the element model",
                        x[0]);
}

double WilliamsEquilibrium::energy(const Eigen::VectorXd& x) {
  const double delta = x[0];
  // Compression is greatest at height/1.2 (2.18); past a pole in the interval the integral does not exist.
  const double worst = std::clamp(toggle().height / 1.2, std::min(0., delta), std::max(0., delta));
  if (toggle().outcome(worst) != Outcome::success || toggle().outcome(delta) != Outcome::success) return nan;
  // Analytic integrand: 31 nodes per panel, with bisection where the error estimate requires it.
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  return Rule::integrate([&](double d) { return (toggle().load(d) - load_) / 2; }, 0., delta, 8, 1e-15);
}

}  // namespace nlmech::frames
