/// @file
/// Linear terms with constant coefficients and harmonic loads of the slopes, extracted from the graph.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "nlmech/program/graph.hpp"

namespace nlmech {

/// One harmonic of a load: it adds cosine cos(frequency t) + sine sin(frequency t) to one component of dx/dt.
/// Frequency 0 is a constant load, `cosine`.
struct Harmonic {
  int component = 0;     ///< component of the state, from 0
  double frequency = 0;  ///< rad/time, finite
  double cosine = 0;     ///< amplitude of the cosine
  double sine = 0;       ///< amplitude of the sine
};

namespace program {

/// The terms A x + load(t) of dx/dt = A x + load(t) + g(t, x), which a transversal linearisation solves
/// exactly (Viswanath and Roy, Multi-step transversal linearization methods, 2007).
struct LinearTerms {
  Eigen::MatrixXd a;           ///< constant matrix A
  std::vector<Harmonic> load;  ///< harmonics by component, then by frequency
};

/// The linear terms of @p slopes, one per component of the state. Sums, multiples and products are expanded,
/// so mu (1 - x^2) y has the linear term mu y. All other operations belong to g, except sine and cosine of a
/// frequency times the time plus a phase. A term that is not finite belongs to g.
[[nodiscard]] LinearTerms linear_terms(const Graph& graph, const std::vector<NodeId>& slopes);

}  // namespace program
}  // namespace nlmech
