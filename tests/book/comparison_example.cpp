/// Worked example of the API reference: methods and peers side by side on one problem.
#include <gtest/gtest.h>

// [example]
#include <cmath>

#include "nlmech/comparison/cost/accuracy.hpp"
#include "nlmech/comparison/cost/method_sweep.hpp"

// x' = -2 t x from 1: the bell curve.
struct Bell {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& t, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    dxdt[0] = -2.0 * t * x[0];
    dxdt[1] = x[0];  // and its integral
  }
};

// The error of a method near the end, for each tolerance of its sweep.
std::vector<nlmech::comparison::Accuracy> sweep(const std::string& method) {
  using namespace nlmech::comparison;
  const Example bell{.name = "bell",
                     .system = nlmech::ivp::System(Bell{}),
                     .x0 = {1, 0},
                     .t0 = 0,
                     .t1 = 2,
                     .amplitude = {1, 1},
                     .reference = [](double t) -> nlmech::Vector<long double, 2> {
                       const long double s = t, half_root_pi = std::sqrt(std::acos(-1.0L)) / 2;
                       return {std::exp(-s * s), half_root_pi * std::erf(s)};
                     }};
  const MethodSweep tolerances = by_tolerances(method, Kind::explicit_, true);
  std::vector<Accuracy> found;
  for (const Setting& setting : tolerances.settings) {
    found.push_back(accuracy_of(bell, integrator(tolerances, setting), {}));
  }
  return found;
}
// [example]

namespace {

TEST(Example, Comparison) {
  for (const char* method : {"ode45", "series", "adaptive-collocation"}) {
    const auto found = sweep(method);
    ASSERT_EQ(found.size(), 2u);  // 1e-4 and 1e-8
    for (const auto& accuracy : found) {
      EXPECT_TRUE(accuracy.status.ok()) << method << ": " << accuracy.status.text();
      ASSERT_TRUE(accuracy.error.has_value());
    }
    EXPECT_LT(*found[1].error, *found[0].error) << method;
    // A problem without growth: a hundred times the tolerance covers the sum of the errors of its steps.
    EXPECT_LT(*found[1].error, 1e-6) << method;
  }
}

}  // namespace
