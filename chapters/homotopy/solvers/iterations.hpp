/// @file
/// The iterations of Tables 2.2 to 2.5, run by the library's methods.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "chapters/homotopy/toggle/toggles.hpp"

namespace nlmech::chapters::homotopy {

/// Which iteration.
enum class Scheme : std::uint8_t {
  newton,          ///< Eq. 2.2
  fixed_point,     ///< Eq. 2.15 (corrected) by Euler's rule
  newton_homotopy  ///< Eq. 2.16 by Euler's rule
};

/// Its settings.
struct Iteration {
  Scheme scheme = Scheme::newton;
  double step = 1;          ///< of fictitious time; Newton has none
  double tolerance = 1e-6;  ///< on |F|, pound
  double start = 0;         ///< delta, inch
  int limit = 1000;         ///< iterations at most
};

/// An iterate.
struct IterationRecord {
  double deflection;  ///< delta, inch
  double residual;    ///< |F|, pound
};

/// How it ended.
struct Count {
  bool converged;   ///< to the tolerance
  int iterations;   ///< done
  double residual;  ///< |F| of the last iterate, pound
};

/// Runs it. @param trace gets all iterates, the start included
[[nodiscard]] Count iterate(LoadedToggle& toggle, const Iteration& iteration,
                            std::vector<IterationRecord>* trace = nullptr);

/// The tolerance on |F| that is meant: of Tables 2.2 and 2.3 on |F| itself, of 2.4 and 2.5 on |F| over that
/// at rest.
[[nodiscard]] double relative_tolerance(double load, double tolerance);

/// A printed row of Tables 2.2 to 2.5, and how we read it.
struct PrintedRow {
  std::string table, method;
  double height, load;
  Model model;          ///< as the text stands
  Iteration iteration;  ///< as the text stands; the step of fictitious time is not stated
  int printed;          ///< iterations
  double accuracy;      ///< printed
  bool relative;        ///< is the printed accuracy relative to that at rest?
};
/// All rows, in the order of the tables.
[[nodiscard]] std::vector<PrintedRow> printed_rows();

/// The step of fictitious time that the pictures use: of the interval whose every step takes the printed 30
/// iterations in Table 2.2 the middle.
inline constexpr double example_step = 0.895;

}  // namespace nlmech::chapters::homotopy
