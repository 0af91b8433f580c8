#include "nlmech/collocation/radial/kernels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/collocation/real.hpp"

namespace nlmech::collocation::kernels_test {
namespace {

using oracle::eps;
using oracle::kernels;
using oracle::Real;
using oracle::refusal;

/// Eq. 4.8.
Real eq_4_8(Kernel kernel, const Real& c, const Real& r) {
  const Real q = 1 + c * r * c * r;
  switch (kernel) {
    case Kernel::gaussian: return exp(1 - q);
    case Kernel::inverse_quadratic: return 1 / q;
    case Kernel::multiquadric: return sqrt(q);
    default: return sqrt(1 / q);
  }
}

// c from 1e-3 to 1e3, |c r| up to 10: the Gaussian is then far from underflow.
RC_GTEST_PROP(Kernels, AreThoseOfEq48, ()) {
  const double c = std::pow(10, *rc::gen::inRange(-3000, 3001) / 1000.);
  const double r = *rc::gen::inRange(-10000, 10001) / 1000. / c, u2 = (c * r) * (c * r);
  for (const Kernel kernel : kernels) {
    const Real exact = eq_4_8(kernel, Real(c), Real(r));
    // The promised units in the last place; the square of c r has an error of its own in the exponent.
    const double growth = kernel == Kernel::gaussian ? 1 + u2 : 1;
    RC_ASSERT(abs(Real(phi(kernel, c, r)) - exact) <= 4 * eps * growth * abs(exact));

    // Central difference: an error of h^2 phi'''/6, some 1e-30 in units of c.
    const Real h = Real(1e-15) / Real(c);
    const Real slope = (eq_4_8(kernel, Real(c), r + h) - eq_4_8(kernel, Real(c), r - h)) / (2 * h);
    RC_ASSERT(abs(Real(phi_dot(kernel, c, r)) - slope) <= 8 * eps * growth * abs(slope) + Real(1e-28) * c);
  }
}

TEST(Kernels, AreEvenAndTheirDerivativesOdd) {
  for (const Kernel kernel : kernels) {
    EXPECT_EQ(phi(kernel, 3., 0.), 1);
    EXPECT_EQ(phi_dot(kernel, 3., 0.), 0);
    EXPECT_EQ(phi(kernel, 3., -0.7), phi(kernel, 3., 0.7));
    EXPECT_EQ(phi_dot(kernel, 3., -0.7), -phi_dot(kernel, 3., 0.7));
  }
}

TEST(Kernels, StayFiniteFarOut) {
  for (const Kernel kernel : kernels) {
    for (const double c : {1e-150, 1e-6, 1., 1e6, 1e150}) {
      EXPECT_TRUE(std::isfinite(phi(kernel, c, 1.))) << to_string(kernel) << ' ' << c;
      EXPECT_TRUE(std::isfinite(phi_dot(kernel, c, 1.))) << to_string(kernel) << ' ' << c;
    }
  }
}

TEST(Kernels, HaveNames) {
  for (const Kernel kernel : kernels) EXPECT_EQ(kernel_from_string(to_string(kernel)), kernel);
  EXPECT_EQ(to_string(Kernel::inverse_multiquadric), "inverse-multiquadric");
  EXPECT_EQ(refusal([] { (void)kernel_from_string("wendland"); }),
            "there is no kernel 'wendland'; there is gaussian, inverse-quadratic, multiquadric, "
            "inverse-multiquadric");
  const auto unknown = static_cast<Kernel>(9);
  EXPECT_NE(refusal([=] { (void)to_string(unknown); }), "");
  EXPECT_NE(refusal([=] { (void)phi(unknown, 1., 1.); }), "");
  EXPECT_NE(refusal([=] { (void)phi_dot(unknown, 1., 1.); }), "");
}

}  // namespace
}  // namespace nlmech::collocation::kernels_test
