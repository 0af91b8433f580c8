#include "chapters/geodesy/printed.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace nlmech::chapters::geodesy {

const std::vector<PrintedCoefficient>& printed_coefficients() {
  static const std::vector<PrintedCoefficient> all = {
      {"C1", "-4h0^3 + 37b^3 - 66b^2h0 + 33bh0^2", false, 3, 2, {37, -66, 33, -4}, ""},
      {"C2", "h0^3 - 31b^3 + 75b^2h0 - 33bh0^2", false, 3, 1, {-31, 75, -33, 1}, ""},
      {"C3", "3b(b^2 + 4h0^2 - 6bh0)", false, 3, 0, {3, -18, 12, 0}, ""},
      {"C4", "139b^3 - 5h0^3 + 49bh0^2 - 143b^2h0", true, 4, 2, {139, -143, 49, -5}, ""},
      {"C5", "h0^3 - 127b^3 + 163b^2h0 - 45bh0^2", true, 4, 1, {-127, 163, -45, 1}, ""},
      {"C6", "4b(-110bh0 + h0^2 + 5b^2)", true, 4, 0, {20, -440, 4, 0}, ""},
      {"C7", "4h0^4 + 118b^4 + 198b^2h0^2 - 266b^3h0 - 54bh0^3", false, 4, 3, {118, -266, 198, -54, 4}, ""},
      {"C8",
       "-155b^4 = 2h0^4 + 67bh0^3 + 431b^3h0 - 315b^2h0^2",
       false,
       4,
       2,
       {-155, 431, -315, 67, -2},
       "the equals sign read as a minus sign"},
      {"C9",
       "49b^4 - 15bh0^3 - 185b^3h0 + 135b^3h0^2",
       false,
       4,
       1,
       {49, -185, 135, -15, 0},
       "135b^3h0^2 has the wrong dimension; read as 135b^2h0^2"},
      {"C10", "2b^2(10bh0 - 5h0^2 - b^2)", false, 4, 0, {-2, 20, -10, 0, 0}, ""},
  };
  return all;
}

namespace {

/// The term of a const or mutable table to which a coefficient belongs.
template <class Table>
auto& find_term(const PrintedCoefficient& c, Table& table) {
  return (c.in_height ? table.height : table.latitude).at(static_cast<std::size_t>(c.order) - 1);
}

}  // namespace

const nlmech::geodesy::SeriesTerm& term_of(const PrintedCoefficient& c,
                                           const nlmech::geodesy::SeriesTable& table) {
  return find_term(c, table);
}

std::vector<int> row_of(const PrintedCoefficient& c, const nlmech::geodesy::SeriesTable& table) {
  const nlmech::geodesy::SeriesTerm& term = term_of(c, table);
  const auto& row = term.coefficient.at(static_cast<std::size_t>(c.power));
  return {row.begin(), row.begin() + term.degree + 1};
}

nlmech::geodesy::SeriesTable with_printed(nlmech::geodesy::SeriesTable table, const PrintedCoefficient& c) {
  auto& row = find_term(c, table).coefficient.at(static_cast<std::size_t>(c.power));
  for (std::size_t i = 0; i < c.by_height.size(); ++i) row.at(i) = c.by_height[i];
  return table;
}

nlmech::geodesy::SeriesTable printed_series() {
  nlmech::geodesy::SeriesTable table = nlmech::geodesy::corrected_series();
  for (const PrintedCoefficient& c : printed_coefficients()) table = with_printed(table, c);
  return table;
}

nlmech::geodesy::SeriesTable literal_series() {
  PrintedCoefficient c9 = printed_coefficients()[8];
  c9.by_height[2] = 135 * 6356752;  // 135 b^3 = (135 b) b^2
  return with_printed(printed_series(), c9);
}

std::string polynomial_text(const std::vector<int>& by_height) {
  const auto power = [](const char* name, std::size_t n) {
    return n == 0 ? std::string() : n == 1 ? std::string(name) : fmt::format("{}^{}", name, n);
  };
  std::string text;
  for (std::size_t i = 0; i < by_height.size(); ++i) {
    const int c = by_height[i];
    if (c == 0) continue;
    const std::string symbols = power("b", by_height.size() - 1 - i) + power("h0", i);
    text += text.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
    text += std::abs(c) == 1 && !symbols.empty() ? symbols : fmt::format("{}{}", std::abs(c), symbols);
  }
  return text.empty() ? "0" : text;
}

}  // namespace nlmech::chapters::geodesy
