/// @file
/// What the rows of Tables 2.2 to 2.5 show: a table, and a figure of the iterates of one row.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "chapters/homotopy/solvers/iterations.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::homotopy {

/// An iteration with all its iterates.
struct Ran {
  Count count;                         ///< how it ended
  double scale = 0;                    ///< W/2, to which residuals are relative
  std::vector<IterationRecord> trace;  ///< from the start
  std::vector<int> scattered = {};     ///< iterations under 16 loads that differ from the row's by roundings

  /// Median of those; rounding decides which count a single run has.
  [[nodiscard]] double median_count() const;
  /// "30", or the median with the range, "74 (29 to 194)", where roundings change it.
  [[nodiscard]] std::string count_text() const;
};

/// What came out, in the order of the table's rows.
struct Results {
  std::vector<PrintedRow> printed;
  std::vector<const Ran*> exact, misprinted;

  /// Iterations with the derivative of F.
  [[nodiscard]] int count(std::size_t row) const { return exact[row]->count.iterations; }
  /// Iterations with the other Jacobian.
  [[nodiscard]] int other_count(std::size_t row) const { return misprinted[row]->count.iterations; }
};

/// A table of the source, with its measured numbers.
[[nodiscard]] scene::Scene result_table(const std::string& table, const std::string& title,
                                        const std::function<void(const Results&, scene::Show&)>& check);

/// A figure of one row of a table.
struct History {
  std::string name, title, heading;
  std::string table;
  Scheme scheme;
  bool other;        ///< shows the iteration with the other Jacobian too
  int shown;         ///< iterations at most
  double root;       ///< known from elsewhere
  double stiffness;  ///< dF/ddelta there, at least
};
[[nodiscard]] scene::Scene history(const History& h);

}  // namespace nlmech::chapters::homotopy
