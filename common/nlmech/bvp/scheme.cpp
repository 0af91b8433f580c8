#include "nlmech/bvp/scheme.hpp"

#include "nlmech/collocation/barycentric.hpp"
#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Nodes at which f is evaluated.
VectorXd evaluated(const Scheme& scheme) {
  return scheme.nodes.segment(scheme.skipped, scheme.nodes.size() - 2 * scheme.skipped);
}

/// Sets the members that interpolation at every tau uses.
void set_interpolation(Scheme& scheme) {
  scheme.barycentric = collocation::barycentric_weights(evaluated(scheme));
  const int points = static_cast<int>(scheme.nodes.size() + 1) / 2;
  const VectorXd gauss = collocation::legendre_gauss(points);
  scheme.gauss = (gauss.array() + 1) / 2;
  scheme.gauss_weights.resize(points);
  for (Index i = 0; i < points; ++i) {
    const double x = gauss[i], slope = collocation::jacobi(points, 0, 0, x).derivative;
    scheme.gauss_weights[i] = 1 / ((1 - x * x) * slope * slope);
  }
}

RowVectorXd cardinal_row(const Scheme& scheme, double tau) {
  RowVectorXd row, padded = RowVectorXd::Zero(scheme.nodes.size());
  collocation::polynomial_row(evaluated(scheme), scheme.barycentric, tau, row);
  padded.segment(scheme.skipped, row.size()) = row;
  return padded;
}

/// Integrals of the cardinal polynomials from 0 to tau, by a Gauss rule of sufficient degree.
RowVectorXd integral_row(const Scheme& scheme, double tau) {
  RowVectorXd sum = RowVectorXd::Zero(scheme.nodes.size());
  for (Index i = 0; i < scheme.gauss.size(); ++i)
    sum += tau * scheme.gauss_weights[i] * cardinal_row(scheme, tau * scheme.gauss[i]);
  return sum;
}

void set_probes(Scheme& scheme) {
  const Index n = scheme.nodes.size();
  scheme.probes = (scheme.nodes.head(n - 1) + scheme.nodes.tail(n - 1)) / 2;
  scheme.probe_slope.resize(n - 1, n);
  scheme.probe_slope_dot.resize(n - 1, n);
  for (Index i = 0; i + 1 < n; ++i) {
    scheme.probe_slope.row(i) = integral_row(scheme, scheme.probes[i]);
    scheme.probe_slope_dot.row(i) = cardinal_row(scheme, scheme.probes[i]);
  }
}

void check_nodes(int nodes, int least) {
  if (nodes < least || nodes > collocation::max_nodes) {
    throw invalid_argument("collocation of boundary values: {} nodes; {} to {} are possible", nodes, least,
                           collocation::max_nodes);
  }
}

VectorXd lobatto_nodes(int nodes, int least) {
  check_nodes(nodes, least);
  return collocation::legendre_gauss_lobatto(nodes);
}

}  // namespace

void Scheme::row(double tau, RowVectorXd& of_value, RowVectorXd& of_slope) const {
  const Index n = nodes.size();
  if (is_through_values) {
    of_value = cardinal_row(*this, tau);
    of_slope = RowVectorXd::Zero(n);
  } else {
    of_value = RowVectorXd::Unit(n, 0);
    of_slope = integral_row(*this, tau);
  }
}

Scheme lobatto_scheme(int nodes) {
  Scheme scheme;
  scheme.nodes = (lobatto_nodes(nodes, 3).array() + 1) / 2;
  const VectorXd at = 2 * scheme.nodes.array() - 1;
  const MatrixXd integral = collocation::integration_matrix(at) / 2;
  scheme.slope = integral.bottomRows(nodes - 1);
  scheme.weights = scheme.slope.row(nodes - 2);
  scheme.order = nodes;
  set_interpolation(scheme);
  set_probes(scheme);
  return scheme;
}

Scheme gauss_scheme(int nodes) {
  check_nodes(nodes, 4);
  Scheme scheme;
  scheme.skipped = 1;
  scheme.nodes.resize(nodes);
  scheme.nodes << 0, (collocation::legendre_gauss(nodes - 2).array() + 1) / 2, 1;
  scheme.order = nodes - 2;
  set_interpolation(scheme);
  scheme.slope.resize(nodes - 1, nodes);
  for (Index i = 1; i < nodes; ++i) scheme.slope.row(i - 1) = integral_row(scheme, scheme.nodes[i]);
  scheme.weights = scheme.slope.row(nodes - 2);
  set_probes(scheme);
  return scheme;
}

Scheme interpolation_scheme(int nodes) {
  Scheme scheme;
  scheme.is_through_values = true;
  const VectorXd lgl = lobatto_nodes(nodes, 2);
  scheme.nodes = (lgl.array() + 1) / 2;
  const MatrixXd integral = collocation::integration_matrix(lgl) / 2;
  scheme.weights = integral.row(nodes - 1);
  set_interpolation(scheme);
  return scheme;
}

}  // namespace nlmech::bvp
