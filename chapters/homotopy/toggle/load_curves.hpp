/// @file
/// Load-deflection curves in pictures, and the checks of their limit points.
#pragma once

#include <string>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::homotopy {

inline constexpr const char* drop_label = "deflection of the apex {/:Italic δ} (in)";
inline constexpr const char* load_label = "load {/:Italic W} (lb)";

/// Deflections from 0 to @p end at which curves are drawn.
[[nodiscard]] std::vector<double> deflections_to(double end);

/// Checks loads and deflections of both limit points.
void check_limit_points(const std::string& model, const LoadCurve& curve, const LimitPoints& reference,
                        scene::Show& show);

}  // namespace nlmech::chapters::homotopy
