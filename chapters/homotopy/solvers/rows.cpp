#include "chapters/homotopy/solvers/rows.hpp"

#include <fmt/format.h>

namespace nlmech::chapters::homotopy {
namespace {

std::string short_name(Scheme scheme) {
  switch (scheme) {
    case Scheme::newton: return "newton";
    case Scheme::fixed_point: return "fixed-point";
    default: return "newton-homotopy";
  }
}

Ran run(const PrintedRow& row, Model model) {
  LoadedToggle toggle(model, row.height, row.load);
  Ran ran;
  ran.scale = toggle.scale();
  ran.count = iterate(toggle, row.iteration, &ran.trace);
  return ran;
}

}  // namespace

std::vector<Row> rows_of(const std::string& table) {
  std::vector<Row> all;
  for (const PrintedRow& row : printed_rows()) {
    if (row.table != table) continue;
    const bool williams = row.model == Model::williams;
    const std::string name = fmt::format("{}-{}", row.table, short_name(row.iteration.scheme));
    const std::string setting = fmt::format(
        "from rest, |F| <= {:.3g} lb{}", row.iteration.tolerance,
        row.iteration.scheme == Scheme::newton ? "" : fmt::format(", Euler's rule, step {}", example_step));
    const Model other = williams ? Model::williams_frozen : Model::element_printed;
    all.push_back(
        {row,
         {name, setting + ", Jacobian is the derivative of F", [row] { return run(row, row.model); }},
         {name + "-other-jacobian",
          setting + (williams ? ", Jacobian with d_5 held constant" : ", A_nd of Eq. 2.35 as printed"),
          [row, other] { return run(row, other); }}});
  }
  return all;
}

}  // namespace nlmech::chapters::homotopy
