/// @file
/// Heat map of methods by problems, for figures/templates/integrators-heat-map.gp.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/scene/show.hpp"

namespace nlmech::chapters::integrators {

/// A cell of the heat map.
struct HeatCell {
  std::optional<double> colour = {};  ///< value in the unit of HeatMap::kind; nothing: no colour
  std::string mark = {};              ///< text in the cell, one or two characters
};

/// A heat map of one to four panels.
struct HeatMap {
  std::string heading;                ///< title: quantity and finding
  std::string kind;                   ///< of quantity: behind, miss or digits
  std::string legend;                 ///< of the marks in the cells
  std::vector<std::string> captions;  ///< one per panel
  std::vector<std::string> problems;  ///< rows
  std::vector<std::string> methods;   ///< columns
  std::function<HeatCell(std::size_t panel, std::size_t problem, std::size_t method)> cell;  ///< from 0
};

/// Adds the heat map to @p show.
void show_heat_map(const HeatMap& map, scene::Show& show);

}  // namespace nlmech::chapters::integrators
