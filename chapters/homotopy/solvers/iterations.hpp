/// @file
/// The iterations of Tables 2.2 to 2.5, by the methods of the library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"

namespace nlmech::chapters::homotopy {

/// Iteration scheme.
enum class Scheme : std::uint8_t {
  newton,          ///< Eq. 2.2
  fixed_point,     ///< Eq. 2.15 (corrected) by Euler's rule
  newton_homotopy  ///< Eq. 2.16 by Euler's rule
};

/// Settings of an iteration.
struct Iteration {
  Scheme scheme = Scheme::newton;
  double step = 1;          ///< step size of fictitious time; not used by Newton
  double tolerance = 1e-6;  ///< on |F|, pound
  double start = 0;         ///< delta, inch
  int limit = 1000;         ///< maximum number of iterations
};

/// One iterate.
struct IterationRecord {
  double deflection;  ///< delta, inch
  double residual;    ///< |F|, pound
};

/// Result of an iteration.
struct Count {
  bool converged;   ///< was the tolerance reached?
  int iterations;   ///< number of iterations
  double residual;  ///< |F| of the last iterate, pound
};

/// Runs an iteration. @param trace if given, receives all iterates, the start included
[[nodiscard]] Count iterate(LoadedToggle& toggle, const Iteration& iteration,
                            std::vector<IterationRecord>* trace = nullptr);

/// Tolerance on |F| for a tolerance relative to |F(0)| = load/2, as in Tables 2.4 and 2.5. Those of
/// Tables 2.2 and 2.3 are on |F| itself.
[[nodiscard]] double relative_tolerance(double load, double tolerance);

/// A printed row of Tables 2.2 to 2.5 with its interpretation.
struct PrintedRow {
  std::string table, method;
  double height, load;
  Model model;          ///< equations of the source
  Iteration iteration;  ///< settings of the source; it does not state the step size
  int printed;          ///< printed number of iterations
  double accuracy;      ///< printed accuracy
  bool relative;        ///< is the printed accuracy relative to |F(0)|?
};
/// All printed rows in the order of the tables.
[[nodiscard]] std::vector<PrintedRow> printed_rows();

/// Step size of fictitious time in the figures: middle of the interval of step sizes that take the 30
/// iterations printed in Table 2.2.
inline constexpr double example_step = 0.895;

}  // namespace nlmech::chapters::homotopy
