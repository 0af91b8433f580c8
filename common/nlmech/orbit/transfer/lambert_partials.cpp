#include "nlmech/orbit/transfer/lambert_partials.hpp"

#include <Eigen/LU>
#include <limits>
#include <utility>

#include "nlmech/orbit/transition.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

struct Inverse {
  Matrix<double, 3> matrix;
  double condition;  ///< in the Frobenius norm
};

/// Inverse with one correction, which makes its error that of a backward-stable method.
Inverse inverse_of(const Matrix<double, 3>& m) {
  // In units of the largest entry, so that neither the determinant nor a norm overflows or underflows.
  const double unit = m.cwiseAbs().maxCoeff();
  const Matrix<double, 3> scaled = m / unit, first = scaled.inverse(),
                          second = first + first * (Matrix<double, 3>::Identity() - scaled * first);
  return {second / unit, scaled.norm() * second.norm()};
}

}  // namespace

LambertPartials lambert_partials(const TransitionMatrix& transition, const Vector3<double>& v1,
                                 const Vector3<double>& v2) {
  LambertPartials p;
  const auto [inverse, condition] = inverse_of(transition.topRightCorner<3, 3>());
  p.condition = condition;
  if (!(64 * std::numeric_limits<double>::epsilon() * p.condition < 1)) {
    p.condition = std::numeric_limits<double>::infinity();
    p.status = Status::failure(
        Outcome::singular_matrix,
        "lambert: the velocities have no derivatives: d(r_2)/d(v_1) is singular to rounding (a transfer by "
        "180 degrees, or to a conjugate point, where two arcs merge); move a position, or change the time");
    return p;
  }
  p.v1_by_r2 = inverse;
  p.v2_by_r1 = -inverse.transpose();
  p.v1_by_r1 = -inverse * transition.topLeftCorner<3, 3>();
  p.v2_by_r2 = transition.bottomRightCorner<3, 3>() * inverse;
  p.v1_by_time = -inverse * v2;
  p.v2_by_time = -inverse.transpose() * v1;
  return p;
}

LambertPartials lambert_partials(const TransferProblem& problem, const Vector3<double>& v1) {
  const State start{problem.from, v1};
  LambertPartials failed;
  if (problem.gravity.degree() == 0) {
    KeplerTransition k = kepler_transition(start, problem.time, problem.gravity.mu);
    if (k.status.ok()) return lambert_partials(k.transition, v1, k.state.velocity);
    failed.status = std::move(k.status);
  } else {
    TransitionSolution c = propagate_transition(start, 0, problem.time, problem.gravity);
    if (c.end.status.ok()) return lambert_partials(c.transition, v1, c.end.x.velocity);
    failed.status = std::move(c.end.status);
  }
  return failed;
}

}  // namespace nlmech::orbit
