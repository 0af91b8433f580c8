#include "nlmech/bvp/scheme.hpp"

#include <utility>

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/collocation/radial/stable_gaussian.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

bool by_slopes(Family family) { return family == Family::lobatto || family == Family::radau; }

/// The nodes at which the slope is interpolated: all, but for Radau's not the left end.
VectorXd slope_nodes(const Scheme& scheme) {
  return scheme.family == Family::radau ? VectorXd(scheme.nodes.tail(scheme.nodes.size() - 1)) : scheme.nodes;
}

/// What does not depend on the place of an interpolation.
void set_interpolation(Scheme& scheme) {
  scheme.interpolated = by_slopes(scheme.family) ? slope_nodes(scheme) : scheme.nodes;
  scheme.barycentric = collocation::barycentric_weights(scheme.interpolated);
  const int points = static_cast<int>(scheme.interpolated.size() + 1) / 2;
  const VectorXd gauss = collocation::legendre_gauss(points);
  scheme.gauss = (gauss.array() + 1) / 2;
  scheme.gauss_weights.resize(points);
  for (Index i = 0; i < points; ++i) {
    const double x = gauss[i], slope = collocation::jacobi(points, 0, 0, x).derivative;
    scheme.gauss_weights[i] = 1 / ((1 - x * x) * slope * slope);
  }
}

RowVectorXd cardinal_row(const Scheme& scheme, double tau) {
  RowVectorXd row;
  collocation::polynomial_row(scheme.interpolated, scheme.barycentric, tau, row);
  return row;
}

/// Puts a row for the slope nodes into one for all nodes.
RowVectorXd spread(const RowVectorXd& row, Index size) {
  RowVectorXd all = RowVectorXd::Zero(size);
  all.tail(row.size()) = row;
  return all;
}

/// Integrals of the cardinal polynomials from 0 to tau, by the Gauss rule that is exact for them.
RowVectorXd integral_row(const Scheme& scheme, double tau) {
  RowVectorXd sum = RowVectorXd::Zero(scheme.interpolated.size());
  for (Index i = 0; i < scheme.gauss.size(); ++i)
    sum += tau * scheme.gauss_weights[i] * cardinal_row(scheme, tau * scheme.gauss[i]);
  return sum;
}

void set_integral_equations(Scheme& scheme) {
  const Index n = scheme.nodes.size();
  const VectorXd at = 2 * slope_nodes(scheme).array() - 1;
  const MatrixXd integral = collocation::integration_matrix(at) / 2;
  scheme.value = MatrixXd::Zero(n - 1, n);
  scheme.value.col(0).setConstant(-1);
  scheme.value.rightCols(n - 1).setIdentity();
  scheme.slope = MatrixXd::Zero(n - 1, n);
  scheme.slope.rightCols(integral.cols()) = integral.bottomRows(n - 1);
  scheme.weights = scheme.slope.row(n - 2);
}

Status set_derivative_equations(Scheme& scheme, double relative_shape, bool keep) {
  const Index n = scheme.nodes.size();
  MatrixXd d;
  if (scheme.family == Family::lobatto_values) {
    d = 2 * collocation::polynomial_differentiation_matrix(
                collocation::legendre_gauss_lobatto(static_cast<int>(n)));
  } else if (scheme.family == Family::stable_gaussian) {
    d = collocation::StableGaussian(scheme.nodes, relative_shape).differentiation_matrix();
  } else {
    auto result =
        collocation::radial_differentiation(scheme.nodes, collocation::Kernel::gaussian, relative_shape);
    if (!result.status.ok() && !(keep && result.matrix.size() > 0)) return result.status;
    d = std::move(result.matrix);
  }
  scheme.value = d.bottomRows(n - 1);
  scheme.slope = MatrixXd::Zero(n - 1, n);
  scheme.slope.rightCols(n - 1).setIdentity();
  const MatrixXd integral =
      collocation::integration_matrix(collocation::legendre_gauss_lobatto(static_cast<int>(n))) / 2;
  scheme.weights = integral.row(n - 1);
  return {};
}

void set_probes(Scheme& scheme) {
  const Index n = scheme.nodes.size();
  scheme.probes = (scheme.nodes.head(n - 1) + scheme.nodes.tail(n - 1)) / 2;
  scheme.probe_value.resize(n - 1, n);
  scheme.probe_slope = scheme.probe_value_dot = scheme.probe_slope_dot = scheme.probe_value;
  // Where values are interpolated, rows of row_dot() with the one matrix that all of them need.
  MatrixXd derivative;
  if (!by_slopes(scheme.family)) derivative = collocation::polynomial_differentiation_matrix(scheme.nodes);
  RowVectorXd value, slope;
  for (Index i = 0; i + 1 < n; ++i) {
    scheme.row(scheme.probes[i], value, slope);
    scheme.probe_value.row(i) = value;
    scheme.probe_slope.row(i) = slope;
    if (by_slopes(scheme.family)) {
      scheme.row_dot(scheme.probes[i], value, slope);
      scheme.probe_value_dot.row(i) = value;
      scheme.probe_slope_dot.row(i) = slope;
    } else {
      scheme.probe_value_dot.row(i) = value * derivative;
      scheme.probe_slope_dot.row(i) = slope;
    }
  }
}

}  // namespace

std::string_view to_string(Family family) {
  switch (family) {
    case Family::lobatto: return "lobatto";
    case Family::radau: return "radau";
    case Family::lobatto_values: return "lobatto-values";
    case Family::gaussian: return "gaussian";
    case Family::stable_gaussian: return "stable-gaussian";
  }
  return "unknown";
}

void Scheme::row(double tau, RowVectorXd& of_value, RowVectorXd& of_slope) const {
  const Index n = nodes.size();
  if (by_slopes(family)) {
    of_value = RowVectorXd::Unit(n, 0);
    of_slope = spread(integral_row(*this, tau), n);
  } else {
    of_value = cardinal_row(*this, tau);
    of_slope = RowVectorXd::Zero(n);
  }
}

void Scheme::row_dot(double tau, RowVectorXd& of_value, RowVectorXd& of_slope) const {
  const Index n = nodes.size();
  if (by_slopes(family)) {
    of_value = RowVectorXd::Zero(n);
    of_slope = spread(cardinal_row(*this, tau), n);
  } else {
    // The derivative of a polynomial is the polynomial through its derivatives at the nodes.
    of_value = cardinal_row(*this, tau) * collocation::polynomial_differentiation_matrix(nodes);
    of_slope = RowVectorXd::Zero(n);
  }
}

SchemeOrStatus make_scheme(Family family, int nodes, double relative_shape, bool keep_ill_conditioned) {
  const int least = by_slopes(family) ? 3 : 2;
  if (nodes < least || nodes > collocation::max_nodes) {
    throw invalid_argument("make_scheme: {} nodes; {} takes {} to {}", nodes, to_string(family), least,
                           collocation::max_nodes);
  }
  const bool gaussian = family == Family::gaussian || family == Family::stable_gaussian;
  if (gaussian && !(relative_shape > 0)) {
    throw invalid_argument("make_scheme: the shape c h = {} is not positive", relative_shape);
  }
  SchemeOrStatus result;
  Scheme& scheme = result.scheme;
  scheme.family = family;
  const VectorXd at = family == Family::radau ? collocation::left_end_and_radau(nodes)
                                              : collocation::legendre_gauss_lobatto(nodes);
  scheme.nodes = (at.array() + 1) / 2;
  if (by_slopes(family)) {
    set_integral_equations(scheme);
    scheme.order = family == Family::lobatto ? nodes : nodes - 1;
    scheme.end_order = family == Family::lobatto ? 2 * nodes - 2 : 2 * nodes - 3;
  } else {
    result.status = set_derivative_equations(scheme, relative_shape, keep_ill_conditioned);
    scheme.order = scheme.end_order = nodes - 1;
  }
  if (!result.status.ok()) return result;
  set_interpolation(scheme);
  set_probes(scheme);
  return result;
}

}  // namespace nlmech::bvp
