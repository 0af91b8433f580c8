/// @file
/// A figure of curves and points on one or several pairs of axes for the template `rbf_inverse-curves`.
#pragma once

#include <map>
#include <string>

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// Collects panels from left to right, and in each its curves in the order in which they are drawn.
class ControlCurves {
 public:
  /// @param heading at most 60 characters
  /// @param xcolumn what the abscissae are called in the data; `time_s` says that they were measured
  explicit ControlCurves(const std::string& heading, const std::string& xcolumn = "x");

  /// Another panel from here on. @param caption above it; empty for none
  void panel(const std::string& xlabel, const std::string& ylabel, const std::string& caption = "");
  /// Another curve of the panel from here on.
  /// @param legend its name, empty for none
  /// @param look a letter, `l` line, `b` line and points, `p` points, `o` large points, and the number of a
  /// line style: "l1"
  void begin(const std::string& legend, const std::string& look);
  /// A point of it.
  void add(double x, double y) { data_.add({panel_, count_, x, y}); }
  /// A variable of the panel: "xrange" as "[0:1]", "yrange", "logx" and "logy" as "1", "key" as "top left",
  /// "xtics" as what follows `set xtics`.
  ControlCurves& with(const std::string& name, const std::string& value);
  /// A variable of the whole: "width", "height".
  ControlCurves& overall(const std::string& name, const std::string& value);
  /// The figure.
  [[nodiscard]] scene::Figure take();

 private:
  void close_panel();

  std::int64_t panel_ = 0, count_ = 0;
  scene::Table data_;
  std::string legend_, looks_;
  std::map<std::string, std::string> variables_;
};

}  // namespace nlmech::chapters
