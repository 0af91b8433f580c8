/// @file
/// Drawings: lines, arrows, filled outlines and texts for the template `drawing`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// A place on the page.
struct Spot {
  double x, y;
};
[[nodiscard]] Spot operator+(Spot a, Spot b);
[[nodiscard]] Spot operator-(Spot a, Spot b);
[[nodiscard]] Spot operator*(double s, Spot a);
[[nodiscard]] double length(Spot a);         ///< from the origin
[[nodiscard]] Spot direction(double angle);  ///< of length one; radians, from the x axis

/// Collects what is drawn. Kinds of paths: `member` thick, `outline`, `ground` a thick support, `thin`,
/// `hatch`, `rest` dashed; `body` a filled outline. Kinds of arrows: `axis`, `force`, and `arrow`, a thin one
/// for measures.
class Drawing {
 public:
  void path(const std::string& kind, const std::vector<Spot>& points);
  void arrow(Spot from, Spot to, const std::string& kind = "arrow");
  /// Words about a place; they may hold gnuplot's markup, but none of | @ '.
  /// @param shade `ink`, or `soft` for what stands back
  void text(const std::string& words, Spot at, const std::string& shade = "ink");
  void joint(Spot at);  ///< a dot
  /// A part of a circle, angles in radians.
  void arc(const std::string& kind, Spot centre, double radius, double from, double to);
  /// The same, thin, with an arrow's head at its end.
  void turn(Spot centre, double radius, double from, double to, const std::string& kind = "arrow");
  /// The figure. @param variables of the template: heading, xrange, yrange, and others that it names
  [[nodiscard]] scene::Figure take(std::map<std::string, std::string> variables);

 private:
  std::int64_t paths_ = 0;
  scene::Table table_{{{"kind"}, {"path", 3, true}, {"x"}, {"y"}, {"dx"}, {"dy"}}};
  std::string labels_;
};

/// Boxes, decisions and the ways between them, on a page of 100 by 100.
class FlowChart {
 public:
  /// A rectangle with lines of words. @param half its half sides
  void box(Spot centre, Spot half, const std::vector<std::string>& lines);
  /// The same in a diamond.
  void decision(Spot centre, Spot half, const std::vector<std::string>& lines);
  /// A way with an arrow's head at its end.
  void way(const std::vector<Spot>& points);
  /// Words beside a way.
  void note(const std::string& words, Spot at) { drawing_.text(words, at, "soft"); }
  /// The figure.
  [[nodiscard]] scene::Figure take(const std::string& heading);

 private:
  void write(Spot centre, const std::vector<std::string>& lines);
  Drawing drawing_;
};

}  // namespace nlmech::chapters
