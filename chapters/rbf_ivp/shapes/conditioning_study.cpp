#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "chapters/rbf_ivp/shapes/conditioning.hpp"
#include "chapters/rbf_ivp/shapes/conditioning_arc.hpp"
#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/collocation/differentiation.hpp"

namespace nlmech::chapters::rbf_ivp::conditioning {
namespace {

using collocation::Inversion;
using collocation::Kernel;
using collocation::NodeFamily;

constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto;

/// max |found - slope| / max |slope|.
double relative_error(const Column50& found, const Arc& a) {
  return static_cast<double>(
      Digits50((found - a.slope).cwiseAbs().maxCoeff() / a.slope.cwiseAbs().maxCoeff()));
}

/// Error of D f in double, nothing if there is no D.
std::optional<double> error_in_double(const Setting& setting, const Arc& a, double shape,
                                      Inversion inversion) {
  const Eigen::VectorXd nodes = (collocation::nodes(lobatto, setting.nodes).array() + 1) / 2;
  const auto d = collocation::radial_differentiation(nodes, Kernel::gaussian, shape, inversion);
  if (d.matrix.size() == 0) return std::nullopt;
  const Eigen::VectorXd slope = d.matrix * a.value.cast<double>();
  return relative_error(slope.cast<Digits50>(), a);
}

/// Condition number of a symmetric positive matrix: the power method for its ends. Eigenvalues of Gaussians
/// lie far apart at the small end; at the large end a percent will do.
double condition(const collocation::Matrix<Digits50>& matrix,
                 const Eigen::PartialPivLU<collocation::Matrix<Digits50>>& lu) {
  const auto grown = [](Column50 x, auto&& apply) {
    Digits50 growth = 0;
    for (int k = 0; k < 30; ++k) {
      x = apply(x);
      growth = x.norm();
      x /= growth;
    }
    return growth;
  };
  Column50 start(matrix.rows());
  for (Eigen::Index j = 0; j < start.size(); ++j) start[j] = j % 2 == 0 ? 1 + Digits50(j) / 100 : -1;
  const Digits50 largest = grown(start.cwiseAbs(), [&](const Column50& x) { return Column50(matrix * x); });
  const Digits50 inverse_of_least = grown(start, [&](const Column50& x) { return Column50(lu.solve(x)); });
  return static_cast<double>(Digits50(largest * inverse_of_least));
}

Exact exact(const Setting& setting, const Arc& a, double shape) {
  const Column50 nodes = unit_nodes(lobatto, setting.nodes);
  const collocation::RadialBasis<Digits50> basis(nodes, Kernel::gaussian, Digits50(shape));
  const Eigen::PartialPivLU<collocation::Matrix<Digits50>> lu(basis.values());
  const double kappa = condition(basis.values(), lu);
  if (!(kappa < 1e34)) return {};  // 50 digits less these leave 16 for the error
  const Column50 weights = lu.solve(a.value);
  return {relative_error(basis.derivatives() * weights, a), kappa};
}

double flat_limit(const Setting& setting, const Arc& a) {
  return relative_error(polynomial_derivative(lobatto, setting.nodes) * a.value, a);
}

/// @param by_algebra with 50 digits as well
Sample sample(const Setting& setting, const Arc& a, double shape, bool by_algebra = true) {
  return {shape, error_in_double(setting, a, shape, Inversion::inverse),
          error_in_double(setting, a, shape, Inversion::solve),
          by_algebra ? exact(setting, a, shape) : Exact{}};
}

}  // namespace

Exact exact(const Setting& setting, double shape) { return exact(setting, arc(setting), shape); }

std::vector<Study> studies(bool quick) {
  std::vector<Study> all;
  for (const Setting& setting : settings) {
    const Arc a = arc(setting);
    Study study{setting, flat_limit(setting, a), sample(setting, a, setting.shape), {}};
    const int count = quick ? 12 : 96;
    bool reached = true;  // by 50 digits: the flatter the functions, the worse their condition
    for (int i = count; i >= 0; --i) {
      study.scan.push_back(sample(setting, a, 0.05 * std::pow(30 / 0.05, double(i) / count), reached));
      reached = study.scan.back().exact.error.has_value();
    }
    std::reverse(study.scan.begin(), study.scan.end());
    all.push_back(std::move(study));
  }
  return all;
}

}  // namespace nlmech::chapters::rbf_ivp::conditioning
