#include "nlmech/ivp/integrate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace nlmech::ivp::detail {

void check_arguments(double t0, double t1, Eigen::Index given_size, int size) {
  if (!std::isfinite(t0) || !std::isfinite(t1))
    throw std::invalid_argument(fmt::format("integrate: the times must be finite, not {} and {}", t0, t1));
  if (!std::isfinite(t1 - t0))
    throw std::invalid_argument(
        fmt::format("integrate: the times {} and {} are too far apart for double precision", t0, t1));
  if (given_size != size)
    throw std::invalid_argument(
        fmt::format("integrate: the initial state has {} components, the system {}", given_size, size));
}

Status check_initial_state(const double* x0, int size, double t0) {
  for (int i = 0; i < size; ++i) {
    if (!std::isfinite(x0[i]))
      return Status::failure(Outcome::non_finite,
                             fmt::format("integrate: component {} of the initial state at t = "
                                         "{:.17g} is {}; give a finite one",
                                         i + 1, t0, x0[i]));
  }
  return {};
}

template Solution integrate_by<System>(const AnyMethod<System>&, const System&, const State&, double, double,
                                       const Observer&, const Limits&);

}  // namespace nlmech::ivp::detail
