/// @file
/// The rows of Tables 2.2 to 2.5 as runs, which tables and figures share.
#pragma once

#include <vector>

#include "chapters/homotopy/iterations.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// An iteration with all its iterates.
struct Ran {
  Count count;               ///< how it ended
  double scale = 0;          ///< W/2, to which residuals are relative
  std::vector<Trace> trace;  ///< from the start
};

/// A printed row and our two readings of it.
struct Row {
  PrintedRow printed;
  const scene::Run<Ran>* exact;       ///< with the derivative of F
  const scene::Run<Ran>* misprinted;  ///< d_5 held constant (Williams), or A_nd as printed (element)
};

/// Declares all runs.
[[nodiscard]] std::vector<Row> add_rows(scene::Chapter& chapter);

/// The rows of one table.
[[nodiscard]] std::vector<Row> rows_of(const std::vector<Row>& rows, const std::string& table);

}  // namespace nlmech::chapters
