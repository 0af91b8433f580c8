/// @file
/// Table 2.6 as printed in the dissertation.
#pragma once

#include <string>
#include <vector>

#include "nlmech/geodesy/perturbation.hpp"

namespace nlmech::chapters::geodesy {

/// A printed coefficient: the row for cos(phi_0)^(2 power) of a series term, divided by a common factor.
struct PrintedCoefficient {
  std::string name;            ///< name, such as "C3"
  std::string printed;         ///< the expression with its terms in the printed order
  bool in_height;              ///< true: belongs to h_k; false: to phi_k
  int order;                   ///< k
  int power;                   ///< power of cos(phi_0)^2
  std::vector<int> by_height;  ///< coefficients of b^(n-i) h_0^i, i = 0..n
  std::string remark;          ///< correction of a term with a misprint; empty if none was needed
};

/// The printed coefficients C1 to C10.
[[nodiscard]] const std::vector<PrintedCoefficient>& printed_coefficients();

/// The term of a series table to which a coefficient belongs.
[[nodiscard]] const nlmech::geodesy::SeriesTerm& term_of(const PrintedCoefficient& c,
                                                         const nlmech::geodesy::SeriesTable& table);

/// The coefficients of b^(n-i) h_0^i of a table in the row of the printed coefficient.
[[nodiscard]] std::vector<int> row_of(const PrintedCoefficient& c, const nlmech::geodesy::SeriesTable& table);

/// @p table with one coefficient replaced by the printed one.
[[nodiscard]] nlmech::geodesy::SeriesTable with_printed(nlmech::geodesy::SeriesTable table,
                                                        const PrintedCoefficient& c);

/// The corrected table with C1 to C10 replaced by the printed ones.
[[nodiscard]] nlmech::geodesy::SeriesTable printed_series();

/// printed_series() with the last term of C9 as printed, 135 b^3 h_0^2 among terms of degree 4. The result
/// depends on the unit of length; b is in metres.
[[nodiscard]] nlmech::geodesy::SeriesTable literal_series();

/// Polynomial as text, such as "37b^3 - 66b^2h0 + 33bh0^2 - 4h0^3".
[[nodiscard]] std::string polynomial_text(const std::vector<int>& by_height);

}  // namespace nlmech::chapters::geodesy
