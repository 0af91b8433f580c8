/// Zeros by their power sums, and exponentials that stand for coincident poles, against closed forms.
#include "nlmech/spacecraft/plant/zero_cluster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "nlmech/spacecraft/plant/roots.hpp"

namespace nlmech::spacecraft::zero_cluster_test {
namespace {

/// Times an entire function without zeros.
Jet with_zeros(Complex s, const std::vector<Complex>& zeros) {
  Jet product(1.);
  for (const Complex& z : zeros) product = product * (Jet::variable(s) - Jet(z));
  return product * exp(Jet::variable(s));
}

TEST(ZerosInCircle, AreRightWhereTheyCoincide) {
  for (const double apart : {0., 1e-12, 1e-6, 0.1}) {
    const std::vector<Complex> zeros = {Complex(1, 2), Complex(1 + apart, 2), Complex(1, 2 + apart),
                                        Complex(4, 9)};
    const ZeroCluster c =
        zeros_in_circle([&](Complex s) { return with_zeros(s, zeros); }, Complex(1, 2), 0.5);
    ASSERT_TRUE(c.status.ok()) << c.status.text();
    ASSERT_EQ(c.zeros.size(), 3U);
    Complex sum = 0, product = 1;
    for (const Complex& z : c.zeros) {
      sum += z;
      product *= Complex(0.2, 0) - z;
    }
    // The polynomial is right to rounding; its zeros are to the third root of that.
    EXPECT_LT(std::abs(sum - apart * Complex(1, 1)), 1e-14);
    EXPECT_LT(std::abs(product - 0.2 * (0.2 - apart) * Complex(0.2, -apart)), 1e-14);
  }
}

TEST(ZerosInCircle, RefusesZerosNearTheCircle) {
  const auto f = [](Complex s) { return with_zeros(s, {Complex(0.1), Complex(1.05)}); };
  EXPECT_EQ(zeros_in_circle(f, 0., 1).status.outcome(), Outcome::not_converged);
  EXPECT_TRUE(zeros_in_circle(f, 0., 0.4).status.ok());
  EXPECT_THROW((void)zeros_in_circle(f, 0., 0), std::invalid_argument);
}

// 1/((s + 1)(s + 1 + d)): t e^(-t) and its neighbours.
TEST(ClusterNodes, StandForCoincidentPoles) {
  for (const double d : {0., 1e-9, 1e-3, 0.2}) {
    const std::vector<Complex> zeros = {Complex(-1), Complex(-1 - d)};
    const double radius = 0.5;
    const Complex centre(-1 - d / 2);
    const ZeroCluster c = zeros_in_circle([&](Complex s) { return with_zeros(s, zeros); }, centre, radius);
    ASSERT_TRUE(c.status.ok()) << c.status.text();
    // Residues of 1, s, ... at both: 0 and 1.
    const ClusterNodes n = cluster_nodes(c, {{0., 1.}}, 1, true);
    for (const double t : {0., 0.3, 1., 5., 40.}) {
      double value = 0;
      for (std::size_t k = 0; k < n.nodes.size(); ++k)
        value += 2 * (n.weights[0][k] * std::exp((centre + n.nodes[k]) * t)).real();
      const double exact = d == 0 ? t * std::exp(-t) : -std::exp(-t) * std::expm1(-d * t) / d;
      EXPECT_NEAR(value, exact, 1e-13) << d << " at " << t;
    }
  }
}

// Five zeros of which two coincide, and one a hundred billion times nearer to 0.
TEST(FindRoots, SeparatesWhatLiesNextToZero) {
  const std::vector<Complex> zeros = {Complex(-1e-11), Complex(-3e-11), Complex(-0.5, 1), Complex(-0.5, 1),
                                      Complex(-2, 0.1)};
  const Roots r = find_roots([&](Complex s) { return with_zeros(s, zeros); }, {-3, 1, -2, 2});
  ASSERT_TRUE(r.status.ok()) << r.status.text();
  ASSERT_EQ(r.roots.size(), 5U);
  EXPECT_NEAR(r.roots[0].real() / -3e-11, 1, 1e-9);
  EXPECT_NEAR(r.roots[1].real() / -1e-11, 1, 1e-9);
  EXPECT_LT(std::abs(r.roots[2] - zeros[4]), 1e-14);
  EXPECT_LT(std::abs((r.roots[3] + r.roots[4]) / 2. - zeros[2]), 1e-13);
}

}  // namespace
}  // namespace nlmech::spacecraft::zero_cluster_test
