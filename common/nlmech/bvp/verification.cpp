#include "nlmech/bvp/verification.hpp"

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

/// The right-hand side as integrators take it.
struct WithParameters {
  static constexpr int dimension = Eigen::Dynamic;
  const Problem* problem;
  Eigen::VectorXd parameters;

  [[nodiscard]] int size() const { return problem->states(); }
  void operator()(const double& t, const Eigen::VectorXd& x, Eigen::VectorXd& dxdt) const {
    problem->rhs(t, x, parameters, dxdt);
  }
  void jacobian(double t, const Eigen::VectorXd& x, Eigen::MatrixXd& j) const {
    Eigen::MatrixXd by_parameter(size(), problem->parameters());
    problem->jacobian(t, x, parameters, j, by_parameter);
  }
};

}  // namespace

Integration integrate_at(const Problem& problem, const Eigen::VectorXd& x0, const Eigen::VectorXd& p,
                         std::span<const double> times) {
  if (x0.size() != problem.states() || p.size() != problem.parameters()) {
    throw invalid_argument("integrate_at: {} states and {} parameters for a problem of {} and {}", x0.size(),
                           p.size(), problem.states(), problem.parameters());
  }
  const ivp::System system(WithParameters{&problem, p});
  const ivp::AdaptiveCollocation method{.relative_tolerance = 1e-13, .absolute_tolerance = 1e-13};
  // A trajectory that needs more steps between two times is not one that a mesh of collocation resolved.
  const ivp::Limits limits{.steps = 20'000};
  Integration result;
  result.states.resize(x0.size(), static_cast<Eigen::Index>(times.size()));
  Eigen::VectorXd x = x0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (k > 0) {
      const auto arc = ivp::integrate(system, x, times[k - 1], times[k], method, {}, limits);
      result.statistics += arc.statistics;
      if (!arc.status.ok()) {
        result.status = arc.status;
        result.states.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(k));
        return result;
      }
      x = arc.x;
    }
    result.states.col(static_cast<Eigen::Index>(k)) = x;
  }
  return result;
}

}  // namespace nlmech::bvp
