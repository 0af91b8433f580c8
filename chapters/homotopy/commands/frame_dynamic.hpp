/// @file
/// `homotopy frame --dynamic`: motion of a frame under time-dependent loads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chapters/homotopy/commands/frame_file.hpp"
#include "nlmech/frames/named/frame_motion.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/show.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::chapters::homotopy {

/// Options of a motion.
struct DynamicOptions {
  bool is_wanted = false;           ///< --dynamic
  std::string history;              ///< --history; empty: `step`
  std::optional<double> factor;     ///< --factor; default 1
  std::optional<double> duration;   ///< --duration
  std::optional<double> time;       ///< --time
  std::string method;               ///< --method; empty: `newmark`
  std::optional<double> step;       ///< --step
  std::optional<double> tolerance;  ///< --tolerance
  std::optional<double> every;      ///< --every
  std::optional<double> alpha;      ///< --alpha
  std::optional<double> rho;        ///< --rho
};

/// Declares the options of a motion.
void declare_dynamic(scene::Options& options, DynamicOptions& typed);

/// @throws InputError naming an option of a motion that was typed without --dynamic
void require_none(const DynamicOptions& typed);

/// State of a motion at one time.
struct Moment {
  double time;        ///< time
  double load;        ///< load factor
  Eigen::VectorXd x;  ///< displacements
  double kinetic;     ///< kinetic energy
  double strain;      ///< strain energy
  double work;        ///< work of the loads since the start
  double dissipated;  ///< dissipated energy since the start
};

/// Result of a motion.
struct FrameRun {
  std::vector<Moment>
      moments;  ///< output rows from the state at rest on: at the ends of steps, or at the requested times
  double imbalance = 0;  ///< largest error of the energy balance, relative to the largest energy
  /// Status of the integrator. Also a failure if the imbalance exceeds 0.01, or if displacements with a fixed
  /// step size and with half of it differ by more than 0.01 of the largest displacement.
  Status status;
};

/// Integrates the motion of the frame from rest. @param seconds limit of wall time; the rows until then are
/// kept
/// @throws InputError naming a missing or unsuitable option, or the entry of the file without mass
[[nodiscard]] FrameRun run_frame(const FrameFile& file, const frames::NamedFrame& frame,
                                 const DynamicOptions& typed, double seconds);

/// Output rows as CSV.
[[nodiscard]] std::string csv_of(const frames::NamedFrame& frame, const FrameRun& run);

/// Figure of the largest displacement and of the energies against time.
[[nodiscard]] scene::Figure motion_picture(const frames::NamedFrame& frame, const FrameRun& run);

}  // namespace nlmech::chapters::homotopy
