/// @file
/// Linear buckling and natural vibrations of a frame in an equilibrium.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <vector>

#include "nlmech/frames/named/frame_model.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::frames {

/// A buckling or vibration mode.
struct FrameMode {
  /// Type of the mode.
  enum class Kind : std::uint8_t {
    buckling,  ///< linear buckling
    vibration  ///< natural vibration
  };
  Kind kind = Kind::buckling;  ///< type of the mode
  double value = 0;            ///< critical load factor; or frequency in cycles per time
  Eigen::VectorXd shape = {};  ///< of all unknowns; the greatest displacement of a node along x or y is 1,
                               ///< or, if none is displaced (see factor_of()), the greatest rotation
};

/// "buckling", "vibration".
[[nodiscard]] std::string_view to_string(FrameMode::Kind kind) noexcept;

/// Modes of a frame in one equilibrium.
struct FrameModes {
  std::vector<FrameMode> modes;  ///< buckling, then vibration, each from the lowest value
  /// success; `wrong_branch` if the equilibrium is not stable; `not_converged`; or the failure of the frame
  Status status;
};

/// Modes of small motions about an equilibrium, with the tangent stiffness K there:
///
///     (K + (W - load) K_g) v = 0,  W > load      buckling, for loads that grow
///     (K - (2 pi f)^2 M) v = 0                    vibration, with the lumped masses, if there are any
///
/// K_g is the geometric stiffness of the axial forces by which the member forces grow linearly with the load
/// factor (LoadedFrame::geometric()): changes of the geometry before buckling do not count. Prescribed
/// displacements are fixed in the shapes, but their forces count in K_g. Subspace iteration with K; the
/// number of negative eigenvalues of K + (W - load) K_g or K - (2 pi f)^2 M certifies that no lower one is
/// missed.
///
/// Tests compare them with closed forms: Euler's columns, rigid columns on springs, beams and columns under
/// axial load, and with dense eigenvalues.
/// @param frame the frame @param x an equilibrium @param load its load factor
/// @param count number of modes of each kind, positive; there may be fewer
/// @throws std::invalid_argument if @p count is not positive
[[nodiscard]] FrameModes frame_modes(const NamedFrame& frame, const Eigen::VectorXd& x, double load,
                                     int count);

}  // namespace nlmech::frames
