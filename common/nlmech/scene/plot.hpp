/// @file
/// Figures of curves: panels of axes, what is drawn in them, the data behind it and the gnuplot script that
/// draws it.
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

/// A text whose blanks beside gnuplot's markup stay: some viewers of SVG drop them where markup begins or
/// ends.
[[nodiscard]] std::string with_kept_blanks(std::string text);

/// A text in single quotes, as gnuplot reads it.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

/// How a curve is drawn: what follows gnuplot's `with`. Style 0 is the next of the panel, from 1; styles are
/// those of `figures/style.gp`.
struct Look {
  std::string with;  ///< "lines", "points pointsize 1.2"
  int style = 0;     ///< of line and point
};
[[nodiscard]] Look lines(int style = 0);        ///< a line
[[nodiscard]] Look thin_lines(int style = 0);   ///< a line for what stands back
[[nodiscard]] Look points(int style = 0);       ///< a symbol at each point
[[nodiscard]] Look large_points(int style);     ///< a symbol for a point that is pointed out
[[nodiscard]] Look linespoints(int style = 0);  ///< line and symbols

/// A pair of axes and what is drawn in it. Each setting returns the panel, so that settings can be chained.
class Panel {
 public:
  /// Ranges are finite and not empty, those of logarithmic axes positive and rising; else
  /// std::invalid_argument is thrown.
  Panel& log_x();                           ///< logarithmic, tics at powers of ten
  Panel& log_x(double low, double high);    ///< the same with its range
  Panel& log_y();                           ///< logarithmic, tics at powers of ten
  Panel& log_y(double low, double high);    ///< the same with its range
  Panel& x_range(double low, double high);  ///< of a linear axis
  Panel& y_range(double low, double high);  ///< of a linear axis
  Panel& caption(const std::string& text);  ///< above the panel, at its left
  /// What follows `set key`: "bottom left"; "off" for none, "below" for two rows under the axis of a single
  /// panel, where curves leave no room.
  Panel& key(const std::string& place);
  /// A text. @param side of the text that stands at the place: "left", "right" or "center"
  Panel& note(const std::string& text, double x, double y, const std::string& side = "left");
  Panel& level(double y,
               const std::string& text = "");  ///< a dashed horizontal line, and words above its left end
  Panel& mark(double x, const std::string& text = "");  ///< a thin vertical line, and words beside its foot
  /// Where the axes stand, in shares of the picture: for panels that are neither in a row nor stacked.
  Panel& place(double left, double right, double bottom, double top);
  /// Any other setting of gnuplot: what follows `set`.
  Panel& set(const std::string& setting);

  /// A curve through points; NaN breaks the line. @param name in the key, empty for none
  Panel& curve(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
               const Look& look = lines());
  /// A curve of the rows of a range, which may be a view of some of them. @param x, y accessors of a row:
  /// members, functions
  template <std::ranges::range Rows, std::invocable<std::ranges::range_reference_t<Rows>> X, class Y>
  Panel& curve(const std::string& name, Rows&& rows, X x, Y y, const Look& look = lines()) {
    std::vector<double> xs, ys;
    for (const auto& row : rows) {
      xs.push_back(static_cast<double>(std::invoke(x, row)));
      ys.push_back(static_cast<double>(std::invoke(y, row)));
    }
    return curve(name, xs, ys, look);
  }
  /// A curve of columns of data that the plot was given: "t:laier", columns by name, or an expression in
  /// parentheses: "t:(1000*column('x'))".
  /// @param block of lines in the data, from 0; -1: all
  Panel& columns(const std::string& name, const std::string& columns, const Look& look = lines(),
                 int block = -1);
  /// Anything else that gnuplot plots, before the next curve: "sin(x) with lines".
  Panel& also(const std::string& element);

 private:
  friend class Plot;
  Panel(class Plot& plot, std::size_t number, std::string x_label, std::string y_label);
  Panel& add(const std::string& name, const std::string& what, const Look& look);

  Plot& plot_;
  std::size_t number_;  // from 1
  std::string x_label_, y_label_, caption_, settings_;
  std::vector<std::string> elements_;
  int styles_ = 0, notes_ = 0;
  bool log_y_ = false, key_below_ = false;
};

/// Panels side by side or one above the other, with a common heading. Data are kept in the order in which
/// curves are drawn, in columns that the plot names; a blank line stands between curves.
class Plot {
 public:
  /// @param heading what to see, at most 60 characters
  explicit Plot(const std::string& heading);
  Plot(const Plot&) = delete;
  Plot& operator=(const Plot&) = delete;

  /// Another panel, right of the last one or, of stacked plots, below it.
  Panel& panel(const std::string& x_label, const std::string& y_label);
  /// Panels one above the other on a common abscissa, whose label and numbers the last one shows.
  /// @param shares of the height, one a panel; equal ones if there are none
  Plot& stacked(std::vector<double> shares = {});
  /// Of the picture, in pixels. @throws std::invalid_argument unless both are positive
  Plot& size(int width, int height);
  /// Names of the data's columns: that of a curve's number, of the panel's number if there is one, of
  /// abscissa and ordinate, as in {"curve", "x", "y"}, {"panel", "curve", "x", "y"} or {"curve", "panel",
  /// "x", "y"}. To be called before the first curve.
  Plot& columns(const std::vector<std::string>& names);
  /// Data of another form, of which Panel::columns() draws.
  Plot& data(Table table);

  /// The data of all curves.
  [[nodiscard]] const Table& data() const { return data_; }
  /// Everything that gnuplot is told after style and data; complete but for these.
  [[nodiscard]] std::string script() const;
  /// The same from before the style: the picture's size.
  [[nodiscard]] std::string prelude() const;
  /// Elements of all panels.
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
