/// @file
/// The toggles of section 2.3: load-deflection curves and limit points of Williams' equation and of one
/// beam-column per member.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/algebraic/equations.hpp"
#include "nlmech/algebraic/paths/path.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::homotopy {

/// Heights l sin(beta) of the three cases, inch.
inline constexpr std::array heights = {0.32, 0.38, 0.44};
/// Loads of Tables 2.2 to 2.5, pound: `low_load` for the height 0.32; the others, above the limit load, for
/// 0.44.
inline constexpr double low_load = 27.11, near_load = 43.79, last_load = 44;

/// A point of a load-deflection curve.
struct CurvePoint {
  double deflection;  ///< delta, inch
  double load;        ///< W, pound
};

/// The limit points of a load-deflection curve from rest.
struct LimitPoints {
  CurvePoint maximum;  ///< the first limit point
  CurvePoint minimum;  ///< the second limit point
};

/// Reference limit points of both models at one height.
struct KnownLimits {
  double height;                  ///< inch
  LimitPoints williams, element;  ///< Williams' equation; one beam-column per member
};

/// All reference limit points; the height 0.32 has none.
// oracle: homotopy_williams Williams 0.?? maximum*, Williams 0.?? minimum*
// oracle: homotopy_frames toggle 0.?? of 1 maximum*, toggle 0.?? of 1 minimum*
inline constexpr std::array known_limits = {
    KnownLimits{0.38,
                {{0.23287115497799, 33.278532607761}, {0.3935882935498, 30.588387926087}},
                {{0.23387819214942, 33.122797603353}, {0.38040896031666, 31.107808393235}}},
    KnownLimits{0.44,
                {{0.22818821400337, 42.771896097273}, {0.4947308255747, 30.363548710287}},
                {{0.22710546333003, 42.435492120383}, {0.4800337802312, 32.124218754757}}}};

/// Reference limit points of a height and a model; nothing if there are none.
[[nodiscard]] inline std::optional<LimitPoints> known_limits_of(double height, bool williams) {
  for (const KnownLimits& k : known_limits)
    if (k.height == height) return williams ? k.williams : k.element;
  return std::nullopt;
}

/// A load-deflection curve W(delta). With one element per member the symmetric toggle has one unknown, like
/// Williams' equation.
class LoadCurve {
 public:
  virtual ~LoadCurve() = default;
  /// W(delta), pound.
  [[nodiscard]] virtual double load(double deflection) const = 0;
  /// dW/ddelta, pound/inch.
  [[nodiscard]] virtual double stiffness(double deflection) const = 0;

 protected:
  LoadCurve() = default;
  LoadCurve(const LoadCurve&) = default;
  LoadCurve& operator=(const LoadCurve&) = default;
};

/// Eq. 2.21 (corrected) with the numbers of Table 2.1.
[[nodiscard]] std::unique_ptr<LoadCurve> williams_curve(double height);
/// Eqs 2.22-2.39 (corrected) with the numbers of Table 2.1.
[[nodiscard]] std::unique_ptr<LoadCurve> element_curve(double height);

/// The first two limit points up to the deflection @p end, by bisection of the stiffness to the last bit;
/// nothing if there are fewer.
[[nodiscard]] std::optional<LimitPoints> limit_points(const LoadCurve& curve, double end = 0.9);
/// Point of least stiffness, to half the digits of a double.
[[nodiscard]] CurvePoint least_stiff_point(const LoadCurve& curve, double end = 0.6);
/// Equilibrium deflections in [0, @p end] under @p load, by bisection.
[[nodiscard]] std::vector<double> deflections_under(const LoadCurve& curve, double load, double end = 0.9);
/// Equilibrium deflection in [@p low, @p high] under @p load, by bisection to the last bit; NaN if the loads
/// at both ends are on the same side of @p load.
[[nodiscard]] double deflection_between(const LoadCurve& curve, double load, double low, double high);

/// First limit point on the path of half a toggle from rest. @throws Failure if there is none
[[nodiscard]] algebraic::PathPoint first_limit_point(const frames::Toggle& toggle);

/// Equations and Jacobian of the toggle.
enum class Model : std::uint8_t {
  williams,         ///< Eq. 2.21 and its derivative
  williams_frozen,  ///< Eq. 2.21, its Jacobian with d_5 held constant
  element,          ///< one beam-column per member
  element_printed   ///< one beam-column per member, tangent by A_nd of Eq. 2.35 as printed
};

/// Equations F(x) = 0 of a toggle under a load; F is half the imbalance, as in Eq. 2.21.
class LoadedToggle {
 public:
  /// @param length l of a member, inch
  LoadedToggle(Model model, double height, double load, double length = 12.94);
  /// F(x) = 0.
  [[nodiscard]] algebraic::Equations& equations() { return *equations_; }
  /// delta for the unknowns @p x.
  [[nodiscard]] double deflection(const Eigen::VectorXd& x) const { return sign_ * x[0]; }
  /// The unknowns for a delta.
  [[nodiscard]] Eigen::VectorXd unknowns(double deflection) const {
    return Eigen::VectorXd::Constant(1, sign_ * deflection);
  }
  /// |F| at rest, W/2: unit of relative residuals.
  [[nodiscard]] double scale() const { return scale_; }

 private:
  double sign_, scale_;
  std::unique_ptr<frames::ToggleFrame> frame_;
  std::unique_ptr<algebraic::Equations> equations_;
};

inline constexpr const char* drop_label = "deflection of the apex {/:Italic δ} (in)";
inline constexpr const char* load_label = "load {/:Italic W} (lb)";

/// Deflections from 0 to @p end for drawing curves.
[[nodiscard]] std::vector<double> deflections_to(double end);

/// Checks loads and deflections of both limit points against the reference.
void check_limit_points(const std::string& model, const LoadCurve& curve, const LimitPoints& reference,
                        scene::Show& show);

}  // namespace nlmech::chapters::homotopy
