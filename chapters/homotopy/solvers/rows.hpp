/// @file
/// The rows of Tables 2.2 to 2.5 as results, which tables and figures share.
#pragma once

#include <string>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy {

/// An iteration with all its iterates.
struct Ran {
  Count count;               ///< how it ended
  double scale = 0;          ///< W/2, to which residuals are relative
  std::vector<Trace> trace;  ///< from the start
};

/// A printed row and our two readings of it.
struct Row {
  PrintedRow printed;
  scene::Result<Ran> exact;       ///< with the derivative of F
  scene::Result<Ran> misprinted;  ///< d_5 held constant (Williams), or A_nd as printed (element)
};

/// The rows of one table.
[[nodiscard]] std::vector<Row> rows_of(const std::string& table);

}  // namespace nlmech::chapters::homotopy
