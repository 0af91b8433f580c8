#include "nlmech/ivp/transversal/mtl.hpp"

#include <cmath>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"

namespace nlmech::ivp {

std::string_view to_string(MtlLinear linear) {
  switch (linear) {
    case MtlLinear::given: return "given";
    case MtlLinear::zero: return "zero";
    case MtlLinear::jacobian: break;
  }
  return "jacobian";
}

void check_options(const Mtl& method) {
  require_step(Mtl::name, method.step);
  require_within(Mtl::name, "points", method.points, 1, 8);
  if (!(method.error_tolerance >= 0) || !std::isfinite(method.error_tolerance))
    throw invalid_argument(
        "mtl: the error tolerance must be positive and finite, or 0 for no estimate, not {}",
        method.error_tolerance);
}

namespace detail {

Status mtl_overflow(double t, double block) {
  return failed_with(Outcome::non_finite,
                     "mtl: the exponential of the linear part overflows over the block of {:.6g} from t = "
                     "{:.17g}; take a smaller step or tolerance (a program can choose another linear part)",
                     block, t);
}

Status mtl_wrong_branch(double t, double block, double estimate, double allowed) {
  return failed_with(Outcome::wrong_branch,
                     "mtl: the equations of the block of {:.6g} from t = {:.17g} were solved, but between "
                     "its points the error is estimated as {:.2g}, above {:.2g}: the states may lie on "
                     "another branch; take a smaller step, or a tolerance in its place",
                     block, t, estimate, allowed);
}

void check_split(const Eigen::Ref<const Eigen::MatrixXd>& a, std::span<const Harmonic> load,
                 bool second_order) {
  if (!a.allFinite()) throw std::invalid_argument("mtl: the problem's linear part is not finite");
  const Eigen::Index half = a.rows() / 2;
  if (second_order && (a.topLeftCorner(half, half).cwiseAbs().sum() != 0 ||
                       a.topRightCorner(half, half) != Eigen::MatrixXd::Identity(half, half)))
    throw std::invalid_argument(
        "mtl: the upper half of the linear part of a problem with accelerations must be [0 1]");
  for (const Harmonic& h : load) {
    const Eigen::Index least = second_order ? half : 0;
    if (h.component < least || h.component >= a.rows())
      throw invalid_argument("mtl: a load on component {} of a problem with {}; it must be from {} to {}",
                             h.component, a.rows(), least, a.rows() - 1);
    if (!std::isfinite(h.frequency) || !std::isfinite(h.cosine) || !std::isfinite(h.sine))
      throw invalid_argument("mtl: a harmonic load of frequency {} and amplitudes {} and {}", h.frequency,
                             h.cosine, h.sine);
  }
}

}  // namespace detail

}  // namespace nlmech::ivp
