#include "chapters/rbf_inverse/random_guess.hpp"

#include <algorithm>
#include <cstdint>
#include <random>

#include "nlmech/collocation/nodes.hpp"

namespace nlmech::chapters::rbf_inverse {

bvp::Start random_guess(int number, double final_time) {
  // The engine's numbers are the same on every machine; the library's distributions need not be.
  std::mt19937_64 engine(static_cast<std::uint64_t>(number) + 1);
  const auto draw = [&](double size) {
    return size * (2 * static_cast<double>(engine() >> 11) / 9007199254740992.0 - 1);
  };
  if (number % 2 == 1) {
    Eigen::VectorXd constant(4);
    for (double& value : constant) value = draw(5);
    return bvp::constant_start(constant);
  }
  constexpr int nodes = 40;
  const Eigen::VectorXd times = final_time * (collocation::legendre_gauss_lobatto(nodes).array() + 1) / 2;
  Eigen::MatrixXd values(4, nodes);
  for (double& value : values.reshaped()) value = draw(1);
  return {.states = [times, values](double t, Eigen::VectorXd& x) {
    // Linear between the nodes, exact at them.
    Eigen::Index k = 0;
    while (k + 2 < times.size() && t > times[k + 1]) ++k;
    const double part = std::clamp((t - times[k]) / (times[k + 1] - times[k]), 0.0, 1.0);
    x = (1 - part) * values.col(k) + part * values.col(k + 1);
  }};
}

}  // namespace nlmech::chapters::rbf_inverse
