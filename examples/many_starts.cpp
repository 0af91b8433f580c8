/// Lorenz' equations from many initial states at once: Taylor series in SIMD registers.
#include <cstdio>
#include <span>
#include <vector>

#include "nlmech/ivp/ensemble/integrate_all.hpp"

// [example]
struct Lorenz {
  static constexpr int dimension = 3;
  void operator()(const auto& /*t*/, const auto& x, auto& dxdt) const {
    dxdt << 10 * (x[1] - x[0]), x[0] * (28 - x[2]) - x[1], x[0] * x[1] - 8 * x[2] / 3;
  }
};

int main() {
  using namespace nlmech::ivp;
  const System lorenz(Lorenz{});
  const std::vector<State> starts = {{0, 1, 0}, {0, 1.0001, 0}, {1, 1, 1}, {-1, 2, 20}};
  for (const auto& end : integrate_all(lorenz, std::span(starts), 0, 10, Series{.relative_tolerance = 1e-12}))
    std::printf("%s: %.6f, %.6f, %.6f\n", end.status.text().c_str(), end.x[0], end.x[1], end.x[2]);
}
// [example]
