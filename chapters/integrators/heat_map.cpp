#include "chapters/integrators/heat_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace nlmech::chapters::integrators {

void show_heat_map(const HeatMap& map, scene::Show& show) {
  // Colours from times are not reproducible; the name of the column marks them.
  const std::string colour = map.kind == "behind" ? "time_behind" : map.kind;
  scene::Table data({{"panel"}, {"row"}, {"column"}, {colour}, {"mark"}, {"problem"}, {"method"}});
  for (std::size_t panel = 0; panel < map.captions.size(); ++panel) {
    for (std::size_t row = 0; row < map.problems.size(); ++row) {
      for (std::size_t column = 0; column < map.methods.size(); ++column) {
        const HeatCell cell = map.cell(panel, row, column);
        data.add(
            {panel + 1, row + 1, column + 1, cell.colour, cell.mark, map.problems[row], map.methods[column]});
      }
    }
  }
  const bool is_double = map.captions.size() > 2;
  const std::size_t rows = map.problems.size(), columns = map.methods.size();
  show.draw(std::move(data), "integrators-heat-map",
            {{"heading", map.heading},
             {"kind", map.kind},
             {"legend", map.legend},
             {"captions", fmt::format("{}", fmt::join(map.captions, "|"))},
             {"rows", std::to_string(rows)},
             {"columns", std::to_string(columns)},
             {"width", std::to_string(170 + (is_double ? 2 : 1) * columns * 30)},
             {"height", std::to_string(220 + (is_double ? 2 : 1) * rows * 18)}});
}

}  // namespace nlmech::chapters::integrators
