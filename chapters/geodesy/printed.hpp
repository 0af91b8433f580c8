/// @file
/// Table 2.6 as the dissertation prints it.
#pragma once

#include <string>
#include <vector>

#include "nlmech/geodesy/perturbation.hpp"

namespace nlmech::chapters::geodesy {

/// One printed coefficient: the row for cos(phi_0)^(2 power) of a term of the series, over a common factor.
struct PrintedCoefficient {
  std::string name;            ///< "C3"
  std::string printed;         ///< the expression, term by term in the printed order
  bool in_height;              ///< belongs to h_k, else to phi_k
  int order;                   ///< k
  int power;                   ///< of cos(phi_0)^2
  std::vector<int> by_height;  ///< what it says: coefficients of b^(n-i) h_0^i, i = 0..n
  std::string remark;          ///< how an impossible term was read; empty if it can be taken as it stands
};

/// C1 to C10.
[[nodiscard]] const std::vector<PrintedCoefficient>& printed_coefficients();

/// The place of a coefficient in a table of the series.
[[nodiscard]] const nlmech::geodesy::SeriesTerm& term_of(const PrintedCoefficient& c,
                                                         const nlmech::geodesy::SeriesTable& table);

/// The coefficients of b^(n-i) h_0^i that a table has in the coefficient's place.
[[nodiscard]] std::vector<int> row_of(const PrintedCoefficient& c, const nlmech::geodesy::SeriesTable& table);

/// The corrected table with the coefficient put in as printed.
[[nodiscard]] nlmech::geodesy::SeriesTable with_printed(nlmech::geodesy::SeriesTable table,
                                                        const PrintedCoefficient& c);

/// The corrected table with all of C1 to C10 as printed.
[[nodiscard]] nlmech::geodesy::SeriesTable printed_series();

/// The same with the last term of C9 as it is printed, 135 b^3 h_0^2 among terms of degree 4: the unit of
/// length then matters; b is in metres.
[[nodiscard]] nlmech::geodesy::SeriesTable literal_series();

/// "37b^3 - 66b^2h0 + 33bh0^2 - 4h0^3"
[[nodiscard]] std::string polynomial_text(const std::vector<int>& by_height);

}  // namespace nlmech::chapters::geodesy
