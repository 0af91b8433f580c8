/// @file
/// Methods by problems as coloured cells, for figures/templates/integrators-heat-map.gp.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::integrators {

/// A cell: its colour, nothing for none, and what is written in it.
struct HeatCell {
  std::optional<double> colour = {};  ///< in the unit of the kind
  std::string mark = {};              ///< a character or two
};

/// A picture of one to four panels.
struct HeatMap {
  std::string heading;                ///< what to see
  std::string kind;                   ///< of the template: behind, miss, digits
  std::string legend;                 ///< of the marks
  std::vector<std::string> captions;  ///< of the panels
  std::vector<std::string> problems;  ///< rows
  std::vector<std::string> methods;   ///< columns
  std::function<HeatCell(std::size_t panel, std::size_t problem, std::size_t method)> cell;  ///< from 0
};

/// Puts it on @p show.
void show_heat_map(const HeatMap& map, scene::Show& show);

}  // namespace nlmech::chapters::integrators
