/// @file
/// A figure of one or two panels of curves above a common axis, for the template `gss_control-plots`.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters {

/// Collects panels and their curves in the order in which they are drawn.
class Plot {
 public:
  /// @param heading at most 60 characters
  /// @param abscissa name of its column: one that begins with `time_` if it holds measured times
  Plot(std::string heading, const std::string& xlabel, const std::string& abscissa = "x");

  /// A panel, below the one before; two at most. Curves go into the newest.
  void panel(const std::string& ylabel);
  /// Another curve from here on. @param legend empty for none
  /// @param look a letter, `l` line, `b` line and points, `p` points, `t` thin line, and a line style: "l1"
  void begin(const std::string& legend, const std::string& look);
  /// A point of it; NaN breaks the line.
  void add(double x, double y);
  /// A whole curve.
  void curve(const std::string& legend, const std::string& look, const std::vector<double>& x,
             const std::vector<double>& y);
  /// A text in the newest panel. @param side "left", "right" or "center"
  void label(const std::string& text, double x, double y, const std::string& side = "left");

  void log_x(double low, double high);    ///< a logarithmic axis with tics at powers of ten
  void log_y(double low, double high);    ///< the same, newest panel
  void x_range(double low, double high);  ///< of a linear axis
  void y_range(double low, double high);  ///< of a linear axis, newest panel
  /// Tics of a linear ordinate, newest panel. @param first of them @param step between them
  void y_tics(double first, double step);
  /// A variable of the template: "key1" as "top left", "height", "below" as "1".
  Plot& with(const std::string& name, const std::string& value);

  /// The figure.
  [[nodiscard]] scene::Figure take();

 private:
  [[nodiscard]] std::string of_panel(const char* name) const;

  int panels_ = 0;
  std::int64_t curves_ = 0;
  scene::Table data_;
  std::string legend_, looks_, labels_;
  std::map<std::string, std::string> variables_;
};

/// Points of a logarithmic grid from @p low to @p high, both included. @throws std::invalid_argument unless
/// 0 < low < high and n >= 2
[[nodiscard]] std::vector<double> logarithmic(double low, double high, int n);

/// Equidistant points, both ends included.
[[nodiscard]] std::vector<double> equidistant(double low, double high, int n);

}  // namespace nlmech::chapters
