/// @file
/// The data of a rigid hub with two equal flexible appendages, each with a tip body (Elgohary 2015, section
/// 3.1, figure 3.1).
#pragma once

namespace nlmech::spacecraft {

/// A hub and two appendages that move as mirror images. Any consistent units; Table 3.1 is in slug, ft and
/// lb.
struct Parameters {
  double hub_inertia;      ///< I_hub about the axis of rotation, slug ft^2; at least 0
  double mass_per_length;  ///< rho of one appendage, slug/ft; positive
  double youngs_modulus;   ///< E, lb/ft^2; positive
  double length;           ///< L of one appendage, ft; positive
  double hub_radius;       ///< r: an appendage begins there, ft; at least 0
  double second_moment;    ///< I of the cross section, ft^4; positive
  double tip_mass;         ///< m at the end of each appendage, slug; at least 0
  double tip_inertia;      ///< I_tip of that body about its own centre, slug ft^2; at least 0

  /// EI, lb ft^2.
  [[nodiscard]] double bending_stiffness() const { return youngs_modulus * second_moment; }
  /// Is there a tip body? Without one no term of it is evaluated.
  [[nodiscard]] bool has_tip() const { return tip_mass != 0 || tip_inertia != 0; }
  /// Inertia of one appendage and its tip body about the axis, undeformed: B(0), slug ft^2.
  [[nodiscard]] double appendage_inertia() const;
  /// J = I_hub + 2 B(0) (J_1, J_2 of Eqs. 3.38 and 3.42), slug ft^2.
  [[nodiscard]] double total_inertia() const { return hub_inertia + 2 * appendage_inertia(); }
};

/// The values of Table 3.1, with its tip body.
[[nodiscard]] Parameters table_3_1();

/// The same spacecraft with tip_mass = tip_inertia = 0.
[[nodiscard]] Parameters without_tip(Parameters parameters);

/// @throws std::invalid_argument naming field and value, if one is not finite or outside its range, or fields
/// together if they leave double's: the appendage's unit of time sqrt(rho L^4/EI) has to lie within 1e-75 to
/// 1e75, its inertia rho L^3 and EI within 1e-150 to 1e150, and hub and tip may be up to 1e75 times as large
void require_physical(const Parameters& parameters);

}  // namespace nlmech::spacecraft
