/// @file
/// Drawings: lines, arrows, filled outlines and texts for the template `drawing`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// A point on the page.
struct Spot {
  double x, y;
};
[[nodiscard]] Spot operator+(Spot a, Spot b);
[[nodiscard]] Spot operator-(Spot a, Spot b);
[[nodiscard]] Spot operator*(double s, Spot a);
[[nodiscard]] double length(Spot a);         ///< distance from the origin
[[nodiscard]] Spot direction(double angle);  ///< unit vector; angle from the x axis, radians

/// Collects the elements of a drawing. Kinds of paths: `member` (thick), `outline`, `ground` (thick support),
/// `thin`, `hatch`, `rest` (dashed), `body` (filled outline). Kinds of arrows: `axis`, `force`, `arrow`
/// (thin, for dimensions).
class Drawing {
 public:
  void path(const std::string& kind, const std::vector<Spot>& points);
  void arrow(Spot from, Spot to, const std::string& kind = "arrow");
  /// Adds a label at a point. Gnuplot markup is allowed; the characters | @ ' are not.
  /// @param shade `ink`, or `soft` for secondary labels
  void text(const std::string& words, Spot at, const std::string& shade = "ink");
  void joint(Spot at);  ///< a dot
  /// Adds a circular arc; angles in radians.
  void arc(const std::string& kind, Spot centre, double radius, double from, double to);
  /// Adds a thin circular arc with an arrow head at its end.
  void turn(Spot centre, double radius, double from, double to, const std::string& kind = "arrow");
  /// Moves the drawing into a figure. @param variables of the template: heading, xrange, yrange and others
  [[nodiscard]] scene::Figure take(std::map<std::string, std::string> variables);

 private:
  std::int64_t paths_ = 0;
  scene::Table table_{{{"kind"}, {"path", 3, true}, {"x"}, {"y"}, {"dx"}, {"dy"}}};
  std::string labels_;
};

/// Flow chart: boxes, decisions and connecting arrows on a page of 100 by 100.
class FlowChart {
 public:
  /// Adds a rectangle with lines of text. @param half half of its sides
  void box(Spot centre, Spot half, const std::vector<std::string>& lines);
  /// Adds a diamond with lines of text. @param half half of its diagonals
  void decision(Spot centre, Spot half, const std::vector<std::string>& lines);
  /// Adds a connection through the points, with an arrow head at its end.
  void arrow(const std::vector<Spot>& points);
  /// Adds a label next to a connection.
  void note(const std::string& words, Spot at) { drawing_.text(words, at, "soft"); }
  /// Moves the chart into a figure.
  [[nodiscard]] scene::Figure take(const std::string& heading);

 private:
  void write(Spot centre, const std::vector<std::string>& lines);
  Drawing drawing_;
};

}  // namespace nlmech::chapters
