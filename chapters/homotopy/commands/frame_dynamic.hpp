/// @file
/// `homotopy frame --dynamic`: the motion of a frame under loads that come in time.
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

/// What was typed of a motion in time.
struct DynamicWords {
  bool is_wanted = false;           ///< --dynamic
  std::string history;              ///< --history; empty: `step`
  std::optional<double> factor;     ///< --factor; without it 1
  std::optional<double> duration;   ///< --duration
  std::optional<double> time;       ///< --time
  std::string method;               ///< --method; empty: `newmark`
  std::optional<double> step;       ///< --step
  std::optional<double> tolerance;  ///< --tolerance
  std::optional<double> every;      ///< --every
};

/// Its options.
void declare_dynamic(scene::Options& options, DynamicWords& words);

/// @throws InputError naming an option of a motion that was typed without --dynamic
void require_none(const DynamicWords& words);

/// A moment of a motion.
struct Moment {
  double time;        ///< of it
  double load;        ///< factor
  Eigen::VectorXd x;  ///< displacements
  double kinetic;     ///< energy
  double strain;      ///< energy
  double work;        ///< of the loads, up to now
  double dissipated;  ///< energy, up to now
};

/// A motion.
struct FrameRun {
  std::vector<Moment>
      moments;           ///< rows of the result, rest first: at the ends of steps, or at the times asked for
  double imbalance = 0;  ///< the most energy that was too much or missing, over the greatest energy
  /// Of the integrator; a failure, too, for an imbalance of more than a hundredth, or if displacements with a
  /// fixed step and with half of it differ by more than a hundredth of the largest.
  Status status;
};

/// Moves the frame from rest. @param seconds of wall time, after which the rows so far are its moments
/// @throws InputError naming an option that is missing or does not fit, or the entry of the file without mass
[[nodiscard]] FrameRun run_frame(const FrameFile& file, const frames::NamedFrame& frame,
                                 const DynamicWords& words, double seconds);

/// The rows as CSV.
[[nodiscard]] std::string csv_of(const frames::NamedFrame& frame, const FrameRun& run);

/// The largest displacement and the energies against time.
[[nodiscard]] scene::Figure motion_picture(const frames::NamedFrame& frame, const FrameRun& run);

}  // namespace nlmech::chapters::homotopy
