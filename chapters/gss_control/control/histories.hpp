/// @file
/// The four time histories that the source plots, and their check by numerical inversion of the transform.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nlmech/spacecraft/response.hpp"

namespace nlmech::chapters::gss_control {

/// Places of the deflection, ft from the rim of the hub.
inline constexpr std::array places = {2.0};

/// Time history of the hub angle or the deflection, or of its rate.
struct History {
  const char *name, *label, *unit;  ///< label of the axis, with gnuplot's markup
  bool hub, rate;

  /// This history of a time response.
  [[nodiscard]] const spacecraft::ExponentialSum& of(const spacecraft::TimeResponse& r) const {
    if (hub) return rate ? r.theta_dot : r.theta;
    return rate ? r.deflection_dot.front() : r.deflection.front();
  }
};
inline constexpr History hub_angle{"hub angle", "{/:Italic θ} (rad)", "rad", true, false};
inline constexpr History hub_rate{"hub rate", "d{/:Italic θ}/d{/:Italic t} (rad/s)", "rad/s", true, true};
inline constexpr History deflection{"deflection at 2 ft", "{/:Italic y}(2 ft) (ft)", "ft", false, false};
inline constexpr History deflection_rate{"deflection rate at 2 ft",
                                         "d{/:Italic y}/d{/:Italic t} at 2 ft (ft/s)", "ft/s", false, true};

/// Largest difference between a residue sum and the Bromwich integral at some times and at the extremes of
/// the sum. The integral is Durbin's trapezoidal sum up to 1.2e4 rad/s with aliasing e^(-30).
/// @param system plant or closed loop with this unit step response
template <class System>
[[nodiscard]] double distance_from_inversion(const spacecraft::ExponentialSum& sum, const History& h,
                                             const System& system) {
  constexpr double half_period = 60, shift = 0.25, step = std::numbers::pi / half_period;
  const spacecraft::Extremes e = extremes(sum, 0.3, 10);
  const std::array times = {1.0, 5.0, 10.0, e.least.time, e.largest.time};
  std::array<double, times.size()> inverted{};
  for (int k = 0; k * step <= 1.2e4; ++k) {
    const spacecraft::Complex s(shift, k * step);
    const auto r = system.response(s, places.front());
    const spacecraft::Complex value =
        (h.hub ? r.theta : r.deflection) / (h.rate ? 1. : s) * (k == 0 ? 0.5 : 1.);
    for (std::size_t i = 0; i < times.size(); ++i)
      inverted.at(i) += (value * std::polar(1., s.imag() * times.at(i))).real();
  }
  double worst = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double f = std::exp(shift * times.at(i)) / half_period * inverted.at(i);
    worst = std::max(worst, std::abs(f - sum.value(times.at(i))));
  }
  return worst;
}

}  // namespace nlmech::chapters::gss_control
