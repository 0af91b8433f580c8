/// @file
/// The printed transfer of section 5.4 and its solution by the methods that the scenes compare.
#pragma once

#include <array>
#include <vector>

#include "nlmech/orbit/transfer.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// Eq. 5.38, in metres and seconds.
[[nodiscard]] orbit::TransferProblem printed_transfer();

/// |v - exact| of the initial velocity by tools/oracles/rbf_inverse_lambert.py, m/s.
[[nodiscard]] double velocity_error(const orbit::Vector3<double>& v1);

/// r(t) - r_F of a flight with @p v1, m; infinite if it does not arrive.
[[nodiscard]] orbit::Vector3<double> miss_vector(const orbit::Vector3<double>& v1);

/// What the section does, in twelve units of time, SI first: the first of them as printed.
inline constexpr std::array<double, 12> time_units = {1, 2, 3, 7, 10, 60, 100, 600, 806.8, 1000, 3600, 86400};

/// Runs of the printed problem.
struct TransferRuns {
  const scene::Run<orbit::CollocatedTransfer>* as_printed;            ///< in metres and seconds
  const scene::Run<std::vector<orbit::CollocatedTransfer>>* printed;  ///< by unit of time, the same first
  const scene::Run<orbit::CollocatedTransfer>* printed_shape;  ///< the same basis without loss of digits
  const scene::Run<orbit::CollocatedTransfer>* stable;         ///< wider Gaussian functions, c T = 3
  const scene::Run<orbit::CollocatedTransfer>* polynomial;     ///< their limit
  const scene::Run<orbit::Transfer>* izzo;                     ///< Izzo's method
};

/// Declares them.
[[nodiscard]] TransferRuns add_transfer_runs(scene::Chapter& chapter);

}  // namespace nlmech::chapters
