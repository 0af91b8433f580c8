/// @file
/// A figure of curves, points and labels for the template `homotopy-curves`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// Collects curves in the order in which they are drawn.
class Curves {
 public:
  /// @param heading at most 60 characters
  Curves(std::string heading, const std::string& xlabel, const std::string& ylabel);

  /// Another curve from here on.
  /// @param legend its name, empty for none
  /// @param look a letter, `l` line, `b` line and points, `p` points, `d` dots, `t` thin line,
  /// `u` or `v` small triangles up or down, and the number of a line style: "l1"
  void begin(const std::string& legend, const std::string& look);
  /// A point of it.
  void add(double x, double y) { data_.add({count_, x, y}); }
  /// A text in the picture. @param side "left", "right" or "center", how it is aligned to the place
  void label(const std::string& text, double x, double y, const std::string& side = "left");
  /// A variable of the template: "xrange" as "[0:1]", "yrange", "logy" as "1", "key" as "top left", "height".
  Curves& with(const std::string& name, const std::string& value);
  /// The figure.
  [[nodiscard]] scene::Figure take();

 private:
  std::int64_t count_ = 0;
  scene::Table data_;
  std::string legend_, looks_, labels_;
  std::map<std::string, std::string> variables_;
};

}  // namespace nlmech::chapters
