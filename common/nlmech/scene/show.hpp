/// @file
/// Output of a scene: a Show collects its figure, its table and its checks. No file is written here.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/plot.hpp"
#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

/// A figure: its data, and either a plot's script or a template of `figures/templates` with its variables.
struct Figure {
  Table data;  ///< data of the figure, written to the folder `results`
  std::string
      template_name;  ///< "geodesy-error-map": figures/templates/geodesy-error-map.gp; empty for a plot
  std::map<std::string, std::string> variables = {};  ///< variables of the template: heading, axis label
  std::string prelude = {};                           ///< gnuplot commands of a plot before the style
  std::string script = {};                            ///< gnuplot commands of a plot after the style
};

/// A number that must lie in a range, with the reason for the range.
struct Quantity {
  std::string name;    ///< "max latitude error"
  std::string unit;    ///< "deg"; "1" if it has none
  double value = 0;    ///< computed value
  double low = 0;      ///< least value that passes
  double high = 0;     ///< greatest value that passes
  std::string reason;  ///< origin of the range: an independent value and its accuracy

  /// Does the value lie in its range? False for NaN.
  [[nodiscard]] bool passes() const { return value >= low && value <= high; }
};

/// Result of a scene: a figure, a table, or both, and its checks.
struct Showing {
  std::optional<Figure> figure = {};              ///< drawn by gnuplot
  std::optional<Table> table = {};                ///< written as Markdown and CSV
  std::vector<Quantity> quantities = {};          ///< at least one
  std::map<std::string, Measured> measured = {};  ///< by PublishedValue::name()
};

/// A number with its unit: `3.2`, or `{3.2, "deg"}`.
struct Amount {
  /// @param number of any arithmetic type
  /// @param unit_name "1" for a number
  template <class Number>
  requires std::is_arithmetic_v<Number> Amount(Number number, std::string unit_name = "1")
      : value(static_cast<double>(number)), unit(std::move(unit_name)) {}
  double value;      ///< number in the unit
  std::string unit;  ///< "1" for a number
};

/// A column of a table of rows: heading, cell as a function of the row, and number of digits.
template <class Row>
struct ColumnOf {
  /// @param heading heading of the column
  /// @param get member or function of a row that gives the cell
  /// @param significant significant digits of real numbers in Markdown
  template <class Get>
  ColumnOf(std::string heading, Get get, int significant = 3)
      : name(std::move(heading)),
        cell([get](const Row& row) -> Cell { return std::invoke(get, row); }),
        digits(significant) {}
  std::string name;                      ///< heading
  std::function<Cell(const Row&)> cell;  ///< cell of a row
  int digits;                            ///< significant digits of real numbers in Markdown
};
/// Columns for the rows of a range.
template <class Rows>
using ColumnsOf = std::vector<ColumnOf<std::ranges::range_value_t<Rows>>>;

/// A table with a row for each of @p rows.
template <class Rows>
[[nodiscard]] Table table_of(const Rows& rows, const ColumnsOf<Rows>& columns) {
  std::vector<Column> headings;
  for (const auto& c : columns) headings.push_back({c.name, c.digits});
  Table table(std::move(headings));
  for (const auto& row : rows) {
    std::vector<Cell> cells;
    for (const auto& c : columns) cells.push_back(c.cell(row));
    table.add(std::move(cells));
  }
  return table;
}

/// Collects the output of a scene.
class Show {
 public:
  /// @param quick true for a quick run with fewer samples and shorter timings
  explicit Show(bool quick) : quick_(quick) {}
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;

  /// Is this a quick run with fewer samples and shorter timings?
  [[nodiscard]] bool quick() const { return quick_; }

  /// Starts a figure with one panel of curves. @param heading quantity and finding, at most 60 characters
  Panel& plot(const std::string& heading, const std::string& x_label, const std::string& y_label);
  /// Starts a figure of several panels, which the caller adds.
  Plot& plots(const std::string& heading);
  /// The figure of plot() or plots(), to set its size and the names of its columns.
  /// @throws std::logic_error if there is none
  [[nodiscard]] Plot& figure();
  /// Sets a figure drawn by a template of `figures/templates`, with its data and variables.
  void draw(Table data, std::string template_name, std::map<std::string, std::string> variables);
  /// Sets a complete figure.
  void draw(Figure figure);

  /// Sets the table, with a row for each of @p rows.
  template <class Rows>
  void table(const Rows& rows, const ColumnsOf<Rows>& columns) {
    table(table_of(rows, columns));
  }
  /// Sets the table.
  void table(Table table);

  /// Checks that a value lies within a relative distance of an independently known one.
  void near(const std::string& name, const Amount& value, double known, double relative,
            const std::string& reason);
  /// Checks that a value lies between 0 and a bound.
  void at_most(const std::string& name, const Amount& value, double bound, const std::string& reason);
  /// Checks that a value lies between two bounds, these included.
  void between(const std::string& name, const Amount& value, double low, double high,
               const std::string& reason);
  /// Checks that a count equals a known one.
  void equals(const std::string& name, const Amount& value, double known, const std::string& reason);

  /// A number that a source prints. @param name as PublishedValue::name()
  /// @throws std::logic_error if no source prints it
  [[nodiscard]] double printed(const std::string& name);
  /// Sets the reproduced value of a printed number. @param name as PublishedValue::name()
  /// @param nominal value by the text as printed @param inferred value under an inferred reading
  /// @param setting setting of the runs behind both, as text for the pages
  /// @throws std::logic_error at a second value for the same name
  void measured(const std::string& name, std::optional<double> nominal, std::optional<double> inferred = {},
                const std::string& setting = {});

  /// The result. @throws std::logic_error at a figure without curves
  [[nodiscard]] Showing take();

 private:
  void refuse_second(bool there, const char* what) const;

  bool quick_;
  std::optional<Plot> plot_;
  std::optional<Printed> printed_;  // read at the first call of printed()
  Showing showing_;
};

}  // namespace nlmech::scene
