#include "nlmech/algebraic/paths/loaded.hpp"

namespace nlmech::algebraic {

NewtonEmbedding::NewtonEmbedding(Equations& equations, const Eigen::VectorXd& x0)
    : equations_(equations),
      f0_(x0.size()),
      is_symmetric_(dynamic_cast<const Potential*>(&equations) != nullptr) {
  require_size("newton embedding", equations, x0);
  equations_.residual(x0, f0_);
}

void NewtonEmbedding::residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) {
  equations_.residual(x, f);
  f -= (1 - load) * f0_;
}

void NewtonEmbedding::linearise(const Eigen::VectorXd& x, double load) {
  static_cast<void>(load);
  equations_.linearise(x);
}

}  // namespace nlmech::algebraic
