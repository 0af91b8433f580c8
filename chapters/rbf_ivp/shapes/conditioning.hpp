/// @file
/// What rounding and truncation make of the derivative of an arc by Gaussians, against their shape.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace nlmech::chapters::rbf_ivp::conditioning {

/// So many nodes on so many periods of the free Duffing oscillator, and the shape c h of the dissertation.
struct Setting {
  int nodes;       ///< of a Lobatto rule
  double periods;  ///< length of the arc
  double shape;    ///< c h
};
/// From few nodes to many.
inline constexpr std::array settings = {Setting{7, 0.1, 0.367}, Setting{15, 0.5, 3.5}, Setting{35, 1, 8.5},
                                        Setting{60, 1, 14.75}};

/// D f with 50 digits, and the condition of Phi; nothing where 50 digits do not reach.
struct Exact {
  std::optional<double> error;      ///< largest at a node, relative to the largest derivative
  std::optional<double> condition;  ///< 2-norm
};

/// The derivative at the nodes of the arc. @param shape c h
[[nodiscard]] Exact exact(const Setting& setting, double shape);

/// Errors at one shape.
struct Sample {
  double shape;                   ///< c h
  std::optional<double> inverse;  ///< in double, D by the inverse; nothing if there is no D
  std::optional<double> solve;    ///< in double, D by solving
  Exact exact;                    ///< with 50 digits
};

/// All shapes of one setting.
struct Study {
  Setting setting;           ///< which
  double flat;               ///< error of polynomials
  Sample dissertation;       ///< at the dissertation's shape
  std::vector<Sample> scan;  ///< shapes ascending
};

/// For each of the settings.
[[nodiscard]] std::vector<Study> studies(bool quick);

}  // namespace nlmech::chapters::rbf_ivp::conditioning
