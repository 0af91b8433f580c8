#include "nlmech/ivp/collocation/picard.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"

namespace nlmech::ivp {

PicardTables picard_tables(const Mcpi& method) {
  const int intervals = method.intervals == 0 ? method.order : method.intervals;
  if (method.order < 1 || intervals < method.order || intervals >= collocation::max_nodes)
    throw std::invalid_argument(
        fmt::format("mcpi: the order must be at least 1 and the intervals from the order to {}, "
                    "not {} and {}",
                    collocation::max_nodes - 1, method.order, intervals));
  if (!(method.tolerance > 0) || method.sweeps < 1)
    throw std::invalid_argument(fmt::format("mcpi: tolerance and sweeps must be positive, not {} and {}",
                                            method.tolerance, method.sweeps));
  const Eigen::VectorXd nodes = collocation::chebyshev_gauss_lobatto(intervals + 1);
  // On [-1, 1]; the unit interval is half as long. The first node's increment is zero.
  const Eigen::MatrixXd integral = collocation::chebyshev_picard_matrix(intervals + 1, method.order - 1) / 2;
  return {(nodes.array() + 1) / 2, integral.bottomRows(intervals), collocation::barycentric_weights(nodes)};
}

Status picard_failure(Outcome outcome, double t, double step, int sweeps) {
  if (outcome == Outcome::non_finite) return non_finite_state(Mcpi::name, t, step);
  return Status::failure(
      outcome, fmt::format("mcpi: Picard's iteration does not converge within {} sweeps in the step "
                           "of {:.6g} from t = {:.17g}; take a shorter step, or a tolerance in its place",
                           sweeps, step, t));
}

}  // namespace nlmech::ivp
