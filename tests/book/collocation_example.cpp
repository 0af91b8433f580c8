/// Worked example of the API reference: an integral curve by collocation at Lobatto's nodes.
#include <gtest/gtest.h>

// [example]
#include <Eigen/LU>

#include "nlmech/collocation/integration.hpp"
#include "nlmech/collocation/nodes.hpp"

// dx/dt = -x from x(0) = 1 over a single step of length h: at the nodes x = 1 - h/2 S x.
// Returns x at the n nodes.
Eigen::VectorXd decay(double h, int n) {
  namespace collocation = nlmech::collocation;
  const Eigen::VectorXd nodes = collocation::legendre_gauss_lobatto(n);  // on [-1, 1]
  const Eigen::MatrixXd integral = collocation::integration_matrix<double>(nodes);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n) + h / 2 * integral;
  return a.partialPivLu().solve(Eigen::VectorXd::Ones(n));
}
// [example]

namespace {

TEST(Example, Collocation) {
  const double h = 2;
  const int n = 16;
  const Eigen::VectorXd x = decay(h, n), nodes = nlmech::collocation::legendre_gauss_lobatto(n);
  for (int j = 0; j < n; ++j) {
    // The polynomial of degree 15 misses e^-t over a length of 2 by less than 2/16! = 1e-13.
    EXPECT_NEAR(x[j], std::exp(-h * (nodes[j] + 1) / 2), 1e-13);
  }
}

}  // namespace
