/// Worked example of the API reference: a library of other authors by its name.
#include <gtest/gtest.h>

// [example]
#include "nlmech/peers/ivp/registry.hpp"

struct Oscillator {  // x'' = -x, state (x, v)
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const nlmech::Vector<T, 2>& x, nlmech::Vector<T, 2>& dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = -x[0];
  }
};

// From rest at 1 to the time t. `peer` is one of peers::peer_names(): "cvode-adams", "gsl-rk8pd", ...
nlmech::ivp::Solution swing(const std::string& peer, double t) {
  const auto integrate = nlmech::peers::peer_integrator(peer, 1e-10);
  return integrate(nlmech::ivp::System(Oscillator{}), {1, 0}, 0, t, {}, {});
}
// [example]

namespace {

TEST(Example, Peers) {
  for (const std::string& peer : nlmech::peers::peer_names()) {
    const nlmech::ivp::Solution end = swing(peer, 10);
    EXPECT_TRUE(end.status.ok()) << peer << ": " << end.status.text();
    // Errors of steps, 1e-10 each, add up over some hundred steps, more for low orders.
    EXPECT_NEAR(end.x[0], std::cos(10.0), 1e-6) << peer;
    EXPECT_NEAR(end.x[1], -std::sin(10.0), 1e-6) << peer;
  }
}

}  // namespace
