#include "chapters/homotopy/toggle/load_curves.hpp"

#include <fmt/format.h>

#include <cmath>

namespace nlmech::chapters::homotopy {

std::vector<double> deflections_to(double end) {
  constexpr int points = 300;
  std::vector<double> all;
  for (int i = 0; i <= points; ++i) all.push_back(end * i / points);
  return all;
}

void check_limit_points(const std::string& model, const LoadCurve& curve, const LimitPoints& reference,
                        scene::Show& show) {
  // Bisection finds the deflection to rounding of the stiffness; the load is stationary there.
  constexpr double eleven_digits = 1e-11, nine_digits = 1e-9;
  const LimitPoints at = limit_points(curve).value_or(LimitPoints{{NAN, NAN}, {NAN, NAN}});
  const auto check = [&](const char* which, const CurvePoint& ours, const CurvePoint& theirs) {
    show.near(fmt::format("load at the {}, {}", which, model), {ours.load, "lb"}, theirs.load, eleven_digits,
              "tools/oracles/homotopy_williams.py and homotopy_frames.py, all digits");
    show.near(fmt::format("deflection at the {}, {}", which, model), {ours.deflection, "in"},
              theirs.deflection, nine_digits,
              "as the load; the stiffness has a simple zero, rounding by 1e-12");
  };
  check("maximum", at.maximum, reference.maximum);
  check("minimum", at.minimum, reference.minimum);
}

}  // namespace nlmech::chapters::homotopy
