/// @file
/// Scenes of Tables 2.2 to 2.5: the table, and a figure of the iterates of one row.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy {

/// Result of an iteration with all its iterates.
struct IterationRun {
  Count count;                         ///< result at the last iterate
  double scale = 0;                    ///< W/2, unit of relative residuals
  std::vector<IterationRecord> trace;  ///< all iterates, the start included
  std::vector<int> scattered = {};     ///< iteration counts for 16 loads (1 + k eps) W, k = 1, ..., 16

  /// Median of `scattered`. A single count depends on rounding.
  [[nodiscard]] double median_count() const;
  /// The count as text: "30", or median and range, "74 (29 to 194)", if rounding changes it.
  [[nodiscard]] std::string count_text() const;
};

/// Results in the order of the rows of the table.
struct Results {
  std::vector<PrintedRow> printed;
  std::vector<const IterationRun*> exact, misprinted;

  /// Iterations with the derivative of F as Jacobian.
  [[nodiscard]] int count(std::size_t row) const { return exact[row]->count.iterations; }
  /// Iterations with the other Jacobian: d_5 held constant, or A_nd as printed.
  [[nodiscard]] int other_count(std::size_t row) const { return misprinted[row]->count.iterations; }
};

/// Scene of a table of the source with the measured numbers.
[[nodiscard]] scene::Scene result_table(const std::string& table, const std::string& title,
                                        const std::function<void(const Results&, scene::Show&)>& check);

/// A figure of one row of a table.
struct History {
  std::string name, title, heading;
  std::string table;
  Scheme scheme;
  bool other;        ///< also draws the iteration with the other Jacobian
  int shown;         ///< number of iterations drawn at most
  double root;       ///< reference deflection, inch
  double stiffness;  ///< lower bound of dF/ddelta at the root
};
[[nodiscard]] scene::Scene history(const History& h);

}  // namespace nlmech::chapters::homotopy
