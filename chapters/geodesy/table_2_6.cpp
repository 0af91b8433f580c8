#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "chapters/geodesy/printed.hpp"
#include "nlmech/geodesy/derivation.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::geodesy::table_2_6 {
namespace {

/// Replaces powers and indices of a polynomial such as "37b^3 - 66b^2h0" by Unicode superscripts and
/// subscripts.
std::string typeset(std::string text) {
  for (const auto& [plain, set] : {std::pair("^2", "²"), std::pair("^3", "³"), std::pair("^4", "⁴"),
                                   std::pair("h0", "h₀"), std::pair("phi_", "φ_")}) {
    for (std::size_t at = text.find(plain); at != std::string::npos; at = text.find(plain, at))
      text.replace(at, std::strlen(plain), set);
  }
  return text;
}

/// Compares printed and derived coefficients. The derived table equals the corrected one (test in
/// tests/geodesy).
void put(const nlmech::geodesy::SeriesTable& derived, scene::Show& show) {
  using C = PrintedCoefficient;
  const auto agrees = [&](const C& c) { return row_of(c, derived) == c.by_height && c.remark.empty(); };
  show.table(printed_coefficients(),
             {{"coefficient", &C::name},
              {"belongs to",
               [](const C& c) { return typeset((c.in_height ? "h_" : "phi_") + std::to_string(c.order)); }},
              {"printed", [](const C& c) { return typeset(std::string(c.printed)); }},
              {"derived", [&](const C& c) { return typeset(polynomial_text(row_of(c, derived))); }},
              {"same", [&](const C& c) { return agrees(c) ? "yes" : "no"; }},
              {"remark", &C::remark}});
  show.equals("printed coefficients that agree with the derivation",
              std::ranges::count_if(printed_coefficients(), agrees), 6,
              "C1, C2, C4, C5, C7, C10: the exact derivation of the library gives the same six");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result derived("derived-series", "Eq. 2.46 solved in powers of p by exact rational arithmetic",
                              nlmech::geodesy::derive_series);
  return {{.name = "table-2.6",
           .title = "Coefficients of the third and fourth order: printed and derived",
           .place = "Table 2.6",
           .content = scene::Content(put, derived)}};
}

}  // namespace nlmech::chapters::geodesy::table_2_6
