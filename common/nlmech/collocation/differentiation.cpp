#include "nlmech/collocation/differentiation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <sstream>

namespace nlmech::collocation {
namespace {

/// "radial_differentiation: 7 gaussian functions of shape 1e-06 on an interval of 1 ", to which the finding
/// is appended.
std::string subject(const Eigen::VectorXd& times, Kernel kernel, double shape) {
  std::ostringstream text;
  text << "radial_differentiation: " << times.size() << ' ' << to_string(kernel) << " functions of shape "
       << shape << " on an interval of " << times[times.size() - 1] - times[0] << ' ';
  return text.str();
}

void measure_condition(const Eigen::MatrixXd& Phi, Differentiation& result) {
  // The singular values of a symmetric matrix are the magnitudes of its eigenvalues.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Phi, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd sizes = solver.eigenvalues().cwiseAbs();
  const double largest = sizes.maxCoeff();  // at least 1, because the trace is n
  result.condition = largest / sizes.minCoeff();
  result.rank = static_cast<int>((sizes.array() > std::numeric_limits<double>::epsilon() * largest).count());
}

double slope_error(const Eigen::MatrixXd& D, const Eigen::VectorXd& line) {
  return ((D * line).array() - 1).abs().maxCoeff();
}

Status check_conditioning(const Eigen::VectorXd& times, Kernel kernel, double shape,
                          const Differentiation& result) {
  constexpr double ill_conditioned = 1e12;  // functions too narrow to overlap have conditions below 1e10
  const Eigen::Index n = times.size(), rank = result.rank;
  const bool alike = 2 * rank <= n + 1 && rank < n;
  const bool wrong = !(result.slope_error < 0.5);
  if (!alike && !wrong) return {};
  std::ostringstream text;
  text << subject(times, kernel, shape);
  if (alike || result.condition > ill_conditioned) {
    text << "lose their derivatives to rounding: numerically they are " << result.rank
         << " functions only (condition " << result.condition << "), slopes are wrong by "
         << 100 * result.slope_error << " %; choose a larger shape, or the polynomial limit";
    return Status::failure(Outcome::singular_matrix, text.str());
  }
  text << "do not overlap: slopes are wrong by " << 100 * result.slope_error << " %; choose a smaller shape";
  return Status::failure(Outcome::outside_validity, text.str());
}

}  // namespace

Differentiation radial_differentiation(const Eigen::VectorXd& times, Kernel kernel, double shape,
                                       Inversion inversion) {
  require_node_count("radial_differentiation", times.size(), 2);
  const RadialBasis<double> basis(times, kernel, shape);
  Differentiation result;
  if (basis.values().allFinite()) measure_condition(basis.values(), result);
  if (!basis.status().ok()) {
    result.status =
        Status::failure(basis.status().outcome(),
                        subject(times, kernel, shape) + "have no inverse: " + basis.status().sentence());
    return result;
  }
  result.matrix = basis.differentiation_matrix(inversion);
  if (!result.matrix.allFinite()) {
    result.matrix.resize(0, 0);
    result.status =
        Status::failure(Outcome::non_finite,
                        subject(times, kernel, shape) + "overflow; choose another shape or unit of time");
    return result;
  }
  result.slope_error = std::max(slope_error(result.matrix, times.array() - times[0]),
                                slope_error(result.matrix, times.array() - times[times.size() - 1]));
  result.status = check_conditioning(times, kernel, shape, result);
  return result;
}

}  // namespace nlmech::collocation
