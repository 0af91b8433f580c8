/// @file
/// Figures of curves: panels, the data of their curves, and the gnuplot script that draws them.
#pragma once

#include <concepts>
#include <deque>
#include <functional>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

/// Protects blanks next to gnuplot's markup: some SVG viewers drop blanks where markup begins or ends.
[[nodiscard]] std::string with_kept_blanks(std::string text);

/// A text in single quotes for gnuplot.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

/// Appearance of a curve. Styles are numbered from 1 in `figures/style.gp`; 0 is the next style of the panel.
struct CurveStyle {
  std::string with;  ///< gnuplot's text after `with`: "lines", "points pointsize 1.2"
  int style = 0;     ///< style of line and point
};
[[nodiscard]] CurveStyle lines(int style = 0);        ///< a line
[[nodiscard]] CurveStyle thin_lines(int style = 0);   ///< a line of the background
[[nodiscard]] CurveStyle points(int style = 0);       ///< a symbol at each point
[[nodiscard]] CurveStyle large_points(int style);     ///< a symbol that marks a point
[[nodiscard]] CurveStyle linespoints(int style = 0);  ///< line and symbols

/// A pair of axes with its curves. Each setting returns the panel, so that settings can be chained.
class Panel {
 public:
  /// Ranges are finite and not empty, those of logarithmic axes positive and rising; else
  /// std::invalid_argument is thrown.
  Panel& log_x();                           ///< logarithmic axis with tics at powers of ten
  Panel& log_x(double low, double high);    ///< logarithmic axis with a range
  Panel& log_y();                           ///< logarithmic axis with tics at powers of ten
  Panel& log_y(double low, double high);    ///< logarithmic axis with a range
  Panel& x_range(double low, double high);  ///< range of a linear axis
  Panel& y_range(double low, double high);  ///< range of a linear axis
  Panel& caption(const std::string& text);  ///< text above the panel on the left
  /// Place of the key, gnuplot's text after `set key`: "bottom left"; "off" for no key; "below" for two rows
  /// below the axis of a single panel.
  Panel& key(const std::string& place);
  /// Adds a text at (x, y). @param side alignment of the text: "left", "right" or "center"
  Panel& note(const std::string& text, double x, double y, const std::string& side = "left");
  Panel& level(double y,
               const std::string& text = "");  ///< a dashed horizontal line with a text above its left end
  Panel& mark(double x, const std::string& text = "");  ///< a thin vertical line with a text at its foot
  /// Position of the axes as fractions of the picture, for panels that are neither in a row nor stacked.
  Panel& place(double left, double right, double bottom, double top);
  /// Any other setting, gnuplot's text after `set`.
  Panel& set(const std::string& setting);

  /// A curve through points; NaN breaks the line. @param name title in the key, empty for none
  Panel& curve(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
               const CurveStyle& curve_style = lines());
  /// A curve with a point for each row of a range or view. @param x, y members or functions of a row
  template <std::ranges::range Rows, std::invocable<std::ranges::range_reference_t<Rows>> X, class Y>
  Panel& curve(const std::string& name, Rows&& rows, X x, Y y, const CurveStyle& curve_style = lines()) {
    std::vector<double> xs, ys;
    for (const auto& row : rows) {
      xs.push_back(static_cast<double>(std::invoke(x, row)));
      ys.push_back(static_cast<double>(std::invoke(y, row)));
    }
    return curve(name, xs, ys, curve_style);
  }
  /// A curve of the data of Plot::data(): columns by name, "t:laier", or an expression in parentheses,
  /// "t:(1000*column('x'))".
  /// @param block index of a block of lines in the data, from 0; -1: all
  Panel& columns(const std::string& name, const std::string& columns, const CurveStyle& curve_style = lines(),
                 int block = -1);
  /// Any other element of gnuplot's `plot`, before the next curve: "sin(x) with lines".
  Panel& also(const std::string& element);

 private:
  friend class Plot;
  Panel(class Plot& plot, std::size_t number, std::string x_label, std::string y_label);
  Panel& add(const std::string& name, const std::string& what, const CurveStyle& curve_style);

  Plot& plot_;
  std::size_t number_;  // from 1
  std::string x_label_, y_label_, caption_, settings_;
  std::vector<std::string> elements_;
  int styles_ = 0, notes_ = 0;
  bool log_y_ = false, key_below_ = false;
};

/// Panels side by side or stacked, with a common heading. The data are in the order of the curves, separated
/// by blank lines, in columns named by columns().
class Plot {
 public:
  /// @param heading quantity and finding, at most 60 characters
  explicit Plot(const std::string& heading);
  Plot(const Plot&) = delete;
  Plot& operator=(const Plot&) = delete;

  /// Adds a panel to the right of the last one or, in a stacked plot, below it.
  Panel& panel(const std::string& x_label, const std::string& y_label);
  /// Stacks the panels on a common abscissa, with label and numbers only below the last one.
  /// @param shares fractions of the height, one per panel; empty: equal
  Plot& stacked(std::vector<double> shares = {});
  /// Size of the picture in pixels. @throws std::invalid_argument unless both are positive
  Plot& size(int width, int height);
  /// Names of the columns of the data: number of the curve, optional number of the panel, abscissa and
  /// ordinate, as {"curve", "x", "y"}, {"panel", "curve", "x", "y"} or {"curve", "panel", "x", "y"}. Call it
  /// before the first curve.
  Plot& columns(const std::vector<std::string>& names);
  /// Data of any other form for Panel::columns().
  Plot& data(Table table);

  /// The data of all curves.
  [[nodiscard]] const Table& data() const { return data_; }
  /// gnuplot commands after style and data.
  [[nodiscard]] std::string script() const;
  /// gnuplot commands before the style: the size of the picture.
  [[nodiscard]] std::string prelude() const;
  /// Number of elements of all panels.
  [[nodiscard]] std::size_t curves() const;

 private:
  friend class Panel;
  void add_curve(std::size_t panel, const std::vector<double>& x, const std::vector<double>& y);
  [[nodiscard]] std::string margins(const Panel& panel) const;

  std::string heading_;
  std::deque<Panel> panels_;
  std::vector<std::string> names_ = {"curve", "x", "y"};
  Table data_;
  std::vector<double> shares_;
  bool own_data_ = false, stacked_ = false;
  std::int64_t blocks_ = 0;
  int width_ = 760, height_ = 520;
};

}  // namespace nlmech::scene
