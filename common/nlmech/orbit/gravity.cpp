#include "nlmech/orbit/gravity.hpp"

#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {

Gravity earth(int degree) {
  if (degree < 0 || degree > Gravity::most_degree) {
    throw invalid_argument("earth: the degree of the zonal terms must be from 0 to 6, not {}", degree);
  }
  constexpr std::array<double, 5> j = {1.08262668e-3, -2.53265649e-6, -1.61962159e-6, -2.27296083e-7,
                                       5.40681239e-7};
  Gravity g{.mu = 3.986004418e14, .radius = 6378137};
  for (int k = Gravity::least_degree; k <= degree; ++k) {
    const auto i = static_cast<std::size_t>(k - Gravity::least_degree);
    g.zonal[i] = j[i];
  }
  return g;
}

void check(const Gravity& gravity) {
  if (!(gravity.mu > 0) || !std::isfinite(gravity.mu))
    throw invalid_argument("gravity: mu must be positive and finite, not {}", gravity.mu);
  for (std::size_t i = 0; i < gravity.zonal.size(); ++i) {
    if (!std::isfinite(gravity.zonal[i]))
      throw invalid_argument("gravity: J{} must be finite, not {}", i + 2, gravity.zonal[i]);
  }
  if (gravity.degree() > 0 && (!(gravity.radius > 0) || !std::isfinite(gravity.radius)))
    throw invalid_argument("gravity: the radius must be positive and finite, not {}", gravity.radius);
}

void check(const State& state, const char* who) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(state.position[i]) || !std::isfinite(state.velocity[i])) {
      throw invalid_argument("{}: position and velocity must be finite; component {} is {} and {}", who,
                             i + 1, state.position[i], state.velocity[i]);
    }
  }
  if (state.position == Vector3<double>::Zero())
    throw invalid_argument("{}: the position is 0, where the attraction has no bound", who);
}

}  // namespace nlmech::orbit
