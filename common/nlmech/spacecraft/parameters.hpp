/// @file
/// Parameters of a rigid hub with two equal flexible appendages, each with a tip body (Elgohary 2015, section
/// 3.1, figure 3.1).
#pragma once

#include <cstdint>
#include <limits>

namespace nlmech::spacecraft {

/// What holds the tips of the appendages, in the frame that turns with the hub, to which the support belongs.
enum class TipSupport : std::uint8_t {
  free,    ///< nothing: the tip body alone
  pinned,  ///< y(L) = 0
  guided,  ///< y'(L) = 0
  clamped  ///< y(L) = y'(L) = 0
};

/// Hub and two appendages that deform antisymmetrically. Any consistent units; Table 3.1 uses slug, ft and
/// lb.
struct Parameters {
  double hub_inertia;      ///< I_hub about the axis of rotation, slug ft^2; at least 0
  double mass_per_length;  ///< rho of one appendage, slug/ft; positive
  double youngs_modulus;   ///< E, lb/ft^2; positive
  double length;           ///< L of one appendage, ft; positive
  double hub_radius;       ///< r: distance of the appendage's root from the axis, ft; at least 0
  double second_moment;    ///< I of the cross section, ft^4; positive
  double tip_mass;         ///< m at the end of each appendage, slug; at least 0
  double tip_inertia;      ///< I_tip of the tip body about its own centre, slug ft^2; at least 0
  /// k of the root: moment of the hub on the appendage for a unit of y'(0), lb ft/rad; 0: a pin, infinite:
  /// clamped (y'(0) = 0), as in the source
  double root_stiffness = std::numeric_limits<double>::infinity();
  TipSupport tip_support = TipSupport::free;  ///< support of the tips

  /// EI, lb ft^2.
  [[nodiscard]] double bending_stiffness() const { return youngs_modulus * second_moment; }
  /// Whether there is a tip body; without one its terms are not evaluated.
  [[nodiscard]] bool has_tip() const { return tip_mass != 0 || tip_inertia != 0; }
  /// k L/EI; infinite for a clamped root.
  [[nodiscard]] double root_ratio() const { return root_stiffness * (length / bending_stiffness()); }
  /// Whether y(L) = 0.
  [[nodiscard]] bool tip_stays() const {
    return tip_support == TipSupport::pinned || tip_support == TipSupport::clamped;
  }
  /// Whether y'(L) = 0.
  [[nodiscard]] bool tip_keeps_slope() const {
    return tip_support == TipSupport::guided || tip_support == TipSupport::clamped;
  }
  /// Clamped root and free tip, as in the source.
  [[nodiscard]] bool is_cantilever() const {
    return root_stiffness == std::numeric_limits<double>::infinity() && tip_support == TipSupport::free;
  }
  /// Pinned root and free tip: the appendage swings about its root without a restoring moment.
  [[nodiscard]] bool swings() const { return root_stiffness == 0 && tip_support == TipSupport::free; }
  /// B(0): moment of inertia of one undeformed appendage with its tip body about the axis, slug ft^2. (With
  /// swings(), B(0) is smaller.)
  [[nodiscard]] double appendage_inertia() const;
  /// Total moment of inertia J = I_hub + 2 B(0) (J_1, J_2 of Eqs. 3.38 and 3.42), slug ft^2.
  [[nodiscard]] double total_inertia() const { return hub_inertia + 2 * appendage_inertia(); }
};

/// The values of Table 3.1, with its tip body.
[[nodiscard]] Parameters table_3_1();

/// The same spacecraft with tip_mass = tip_inertia = 0.
[[nodiscard]] Parameters without_tip(Parameters parameters);

/// @throws std::invalid_argument saying that @p what needs a clamped root and a free tip, unless
/// is_cantilever()
void require_cantilever(const Parameters& parameters, const char* what);

/// @throws std::invalid_argument saying that the appendages of @p what swing freely, if swings()
void require_restored(const Parameters& parameters, const char* what);

/// @throws std::invalid_argument naming field and value, if a field is not finite or out of range, or if a
/// combination of fields would overflow or underflow: the appendage's unit of time sqrt(rho L^4/EI) must lie
/// within 1e-75 to 1e75, its inertia rho L^3 and EI within 1e-150 to 1e150; hub and tip may exceed the
/// appendage by factors up to 1e75; k L/EI may be 0, infinite, or 1e-75 to 1e75
void require_physical(const Parameters& parameters);

}  // namespace nlmech::spacecraft
