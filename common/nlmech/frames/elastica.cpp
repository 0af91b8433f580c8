#include "nlmech/frames/elastica.hpp"

#include <Eigen/LU>
#include <array>
#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <cmath>
#include <cstdint>

#include "nlmech/program/dual.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {
namespace {

using Real = long double;
using D = Dual<Real, 3>;  // by H, V, M(0)
using Three = Eigen::Matrix<Real, 3, 1>;
using Section = std::array<D, 4>;  // x, y, theta, M

struct Rod {
  D h, v;
  Real ea, ei;
  void operator()(const Section& s, Section& slope, Real /*arc*/) const {
    const D c = cos(s[2]), sine = sin(s[2]), stretch = 1 + (h * c + v * sine) / ea;
    const D x = stretch * c, y = stretch * sine;
    slope = {x, y, s[3] / ei, h * y - v * x};
  }
};

}  // namespace

Elastica::Elastica(const Toggle& toggle, int steps) : toggle_(toggle), steps_(steps) {
  (void)make_frame({toggle.height, toggle.length, toggle.ea, toggle.ei});
  if (steps < 10) throw invalid_argument("Elastica: {} steps; at least 10 are needed", steps);
}

ElasticaPoint Elastica::at(double drop, const ElasticaPoint& near) const {
  const Real length = toggle_.length, height = toggle_.height;
  const Real half_span = std::sqrt((length - height) * (length + height)), angle = std::asin(height / length);
  const Real h = length / static_cast<Real>(steps_);
  boost::numeric::odeint::runge_kutta4<Section, Real> runge_kutta;
  Three u(near.horizontal, -near.load / 2, near.moment);
  Eigen::Matrix<Real, 3, 3> jacobian;
  ElasticaPoint point{.drop = drop, .outcome = Outcome::not_converged};
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Rod rod{D::variable(u[0], 0), D::variable(u[1], 1), toggle_.ea, toggle_.ei};
    Section s{D(Real(0)), D(Real(0)), D(angle), D::variable(u[2], 2)};
    for (int k = 0; k < steps_; ++k) runge_kutta.do_step(rod, s, k * h, h);
    const Three rest(s[0].value - half_span, s[1].value - (height - static_cast<Real>(drop)),
                     s[2].value - angle);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j)
        jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = s[i].partial[j];
    }
    const Eigen::PartialPivLU<Eigen::Matrix<Real, 3, 3>> lu(jacobian);
    const Three step = lu.solve(rest);
    u -= step;
    if (!u.allFinite()) return point;
    // The clamped end is met to the rounding of places, which the axial stiffness makes forces of.
    if (step.norm() <= 1e-13L * u.norm() + 1e-16L * static_cast<Real>(toggle_.ea)) {
      // y at the apex falls as the drop grows; W = -2 V.
      const Three change = lu.solve(Three(0, -1, 0));
      point.load = static_cast<double>(-2 * u[1]);
      point.slope = static_cast<double>(-2 * change[1]);
      point.horizontal = static_cast<double>(u[0]);
      point.moment = static_cast<double>(u[2]);
      point.outcome = Outcome::success;
      return point;
    }
  }
  return point;
}

std::vector<ElasticaPoint> Elastica::curve(double drop, int points) const {
  if (points < 1) throw invalid_argument("Elastica: a curve of {} points", points);
  std::vector<ElasticaPoint> curve{at(0, {})};
  for (int i = 1; i <= points; ++i) curve.push_back(at(drop * i / points, curve.back()));
  return curve;
}

ElasticaPoint Elastica::limit(const ElasticaPoint& low, const ElasticaPoint& high) const {
  ElasticaPoint point = low;
  if (!((low.slope > 0) != (high.slope > 0))) {
    point.outcome = Outcome::not_converged;
    return point;
  }
  std::uintmax_t most = 40;
  const auto slope = [&](double drop) { return (point = at(drop, point)).slope; };
  const auto is_near = [&](double a, double b) {
    return point.outcome != Outcome::success || std::abs(b - a) <= 1e-9 || std::abs(point.slope) <= 1e-9;
  };
  (void)boost::math::tools::toms748_solve(slope, low.drop, high.drop, low.slope, high.slope, is_near, most);
  return point;
}

}  // namespace nlmech::frames
