#include <Eigen/QR>
#include <utility>

#include "chapters/rbf_ivp/nodes/node_variants.hpp"

namespace nlmech::chapters::rbf_ivp {

template <int n>
Fit least_squares(const Arc<n>& arc, const TrialSpace& space) {
  Fit start = collocate(arc, space);
  if (!start.converged) return start;
  const Eigen::Index m = space.checks.size(), s = space.nodes.size() - 1, d = arc.example->x0.size();
  const Eigen::VectorXd root_weights = gauss_weights(m).cwiseSqrt();
  Eigen::MatrixXd states = start.states, b(m * d, s * d);
  ivp::Jacobian<n> j = ivp::Jacobian<n>::Zero(d, d);
  for (int k = 0; k < 20; ++k) {
    Eigen::MatrixXd r = detail::residual_columns(arc, space, states);
    for (Eigen::Index i = 0; i < m; ++i) {
      const ivp::State<n> x = (space.values.row(i) * states).transpose();
      arc.example->system.jacobian(arc.t0 + arc.h * space.checks[i], x, j);
      for (Eigen::Index c = 0; c < s; ++c) {
        auto block = b.block(i * d, c * d, d, d);
        block = -arc.h * space.values(i, c + 1) * j;
        block.diagonal().array() += space.slopes(i, c + 1);
        block *= root_weights[i];
      }
      r.col(i) *= root_weights[i];
    }
    const Eigen::VectorXd update =
        b.householderQr().solve(Eigen::Map<const Eigen::VectorXd>(r.data(), r.size()));
    states.bottomRows(s) -= Eigen::Map<const Eigen::MatrixXd>(update.data(), d, s).transpose();
    if (!update.allFinite()) return {};
    if (update.cwiseAbs().maxCoeff() < 1e-12) return detail::judged(arc, space, std::move(states));
  }
  return {};
}

template Fit least_squares(const Arc<2>&, const TrialSpace&);
template Fit least_squares(const Arc<6>&, const TrialSpace&);

}  // namespace nlmech::chapters::rbf_ivp
