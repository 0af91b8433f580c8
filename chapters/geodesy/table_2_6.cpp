#include <algorithm>

#include "chapters/geodesy/printed.hpp"
#include "chapters/geodesy/scenes.hpp"
#include "nlmech/geodesy/derivation.hpp"

namespace nlmech::chapters {
namespace {

/// Derived and corrected tables are one and the same; tests/geodesy holds them to that.
scene::Showing compare(const geodesy::SeriesTable& derived) {
  scene::Table table({{"coefficient"}, {"belongs to"}, {"printed"}, {"derived"}, {"same"}, {"remark"}});
  int same = 0;
  for (const PrintedCoefficient& c : printed_coefficients()) {
    const std::vector<int> row = row_of(c, derived);
    const bool agrees = row == c.by_height && c.remark.empty();
    same += agrees ? 1 : 0;
    const std::string belongs = (c.in_height ? "h_" : "phi_") + std::to_string(c.order);
    table.add(
        {c.name, belongs, c.printed, polynomial_text(row), std::string(agrees ? "yes" : "no"), c.remark});
  }
  scene::Showing showing;
  showing.table = std::move(table);
  showing.quantities = {
      scene::near("printed coefficients that agree with the derivation", "1", same, 6, 0,
                  "C1, C2, C4, C5, C7, C10: the exact derivation of the library gives the same six")};
  return showing;
}

}  // namespace

void add_table_2_6(scene::Chapter& chapter) {
  const auto& derived = chapter.add_run<geodesy::SeriesTable>(
      "derived-series", "Eq. 2.46 solved in powers of p by exact rational arithmetic", {},
      [](scene::Workshop&) { return geodesy::derive_series(); });
  chapter.add({.name = "table-2.6",
               .title = "Coefficients of the third and fourth order: printed beside derived",
               .place = "Table 2.6",
               .needs = {&derived},
               .show = [&derived](scene::Workshop& w) { return compare(w.result(derived)); }});
}

}  // namespace nlmech::chapters
