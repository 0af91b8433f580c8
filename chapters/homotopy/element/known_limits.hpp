/// @file
/// Limit points of the toggles with numbers of Table 2.1, known from elsewhere.
#pragma once

#include <array>
#include <optional>

#include "chapters/homotopy/toggle/toggles.hpp"

namespace nlmech::chapters::homotopy {

/// Limit points of both models at one height.
struct KnownLimits {
  double height;                  ///< inch
  LimitPoints williams, element;  ///< Williams' equation; one beam-column a member
};

/// All that there are: the height 0.32 has none.
// oracle: homotopy_williams Williams 0.?? maximum*, Williams 0.?? minimum*
// oracle: homotopy_frames toggle 0.?? of 1 maximum*, toggle 0.?? of 1 minimum*
inline constexpr std::array known_limits = {
    KnownLimits{0.38,
                {{0.23287115497799, 33.278532607761}, {0.3935882935498, 30.588387926087}},
                {{0.23387819214942, 33.122797603353}, {0.38040896031666, 31.107808393235}}},
    KnownLimits{0.44,
                {{0.22818821400337, 42.771896097273}, {0.4947308255747, 30.363548710287}},
                {{0.22710546333003, 42.435492120383}, {0.4800337802312, 32.124218754757}}}};

/// Those of a height and a model, if it has any.
[[nodiscard]] inline std::optional<LimitPoints> known_limits_of(double height, bool williams) {
  for (const KnownLimits& k : known_limits)
    if (k.height == height) return williams ? k.williams : k.element;
  return std::nullopt;
}

}  // namespace nlmech::chapters::homotopy
