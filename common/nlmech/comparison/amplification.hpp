/// @file
/// How a problem multiplies errors on the way: what makes the end of an integration uncertain although each
/// step is right.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "nlmech/comparison/reference/reference.hpp"
#include "nlmech/ivp/system.hpp"

namespace nlmech::comparison {

/// The relative and absolute tolerance of a run.
struct Tolerance {
  double relative;  ///< positive
  double absolute;  ///< positive
};

/// The weights of the components at several times: what one tolerance comes to, absolute + relative |x|, and
/// what rounding leaves of x and of the time.
/// @param system for the slopes
/// @param size greatest |x_i| on the way
[[nodiscard]] Eigen::MatrixXd weights(const ivp::System& system, const std::vector<double>& times,
                                      const StatesAt& states, const Eigen::VectorXd& size,
                                      const Tolerance& tolerance);

/// How far an error of one weight in every component, made at any of the earlier times, moves a component at
/// a time: at worst, by signs. From each time to the next all components are moved in turn by a small share
/// of their size and integrated by what made the reference; the products of these matrices tell what becomes
/// of errors later.
/// @param way of the reference
/// @param first_weight weight of the components at way.t0
/// @param weight at way.times
/// @param moved gets the result, of the size of @p weight
/// @param seconds wall time
/// @returns success, or why it is not known
[[nodiscard]] Status amplification(const Way& way, const Reference& reference,
                                   const Eigen::VectorXd& first_weight, const Eigen::MatrixXd& weight,
                                   double seconds, Eigen::MatrixXd& moved);

}  // namespace nlmech::comparison
