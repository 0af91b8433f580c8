/// @file
/// What a scene shows: on a Show it puts one figure, one table, and the checks of its result. It writes no
/// file.
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
  Table data;  ///< written to the folder results
  std::string
      template_name;  ///< "geodesy-error-map": figures/templates/geodesy-error-map.gp; empty for a plot
  std::map<std::string, std::string> variables = {};  ///< texts for the template: heading, axis label
  std::string prelude = {};                           ///< of a plot: what comes before the style
  std::string script = {};                            ///< of a plot: what comes after it
};

/// A number that must lie in a range, with the reason for the range.
struct Quantity {
  std::string name;    ///< "max latitude error"
  std::string unit;    ///< "deg"; "1" if it has none
  double value = 0;    ///< what came out
  double low = 0;      ///< least value that passes
  double high = 0;     ///< greatest value that passes
  std::string reason;  ///< where the range comes from: an independent value and its accuracy

  /// Does the value lie in its range? Never, if it is NaN.
  [[nodiscard]] bool passes() const { return value >= low && value <= high; }
};

/// What a scene gives back: a figure, a table, or both, and its checks.
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
  double value;      ///< in the unit
  std::string unit;  ///< "1" for a number
};

/// A column of a table of rows: its heading, what it shows of a row (a member, a function), and how many
/// digits.
template <class Row>
struct ColumnOf {
  /// @param heading of the column
  /// @param get member or function of a row
  /// @param significant digits of real numbers in Markdown
  template <class Get>
  ColumnOf(std::string heading, Get get, int significant = 3)
      : name(std::move(heading)),
        cell([get](const Row& row) -> Cell { return std::invoke(get, row); }),
        digits(significant) {}
  std::string name;                      ///< heading
  std::function<Cell(const Row&)> cell;  ///< of a row
  int digits;                            ///< significant, of real numbers in Markdown
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

/// Collects what a scene shows.
class Show {
 public:
  /// @param quick was less computed?
  explicit Show(bool quick) : quick_(quick) {}
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;

  /// Was less computed: fewer samples, shorter timings?
  [[nodiscard]] bool quick() const { return quick_; }

  /// A figure of curves, of one panel. @param heading what to see, at most 60 characters
  Panel& plot(const std::string& heading, const std::string& x_label, const std::string& y_label);
  /// A figure of several panels, which are added to it.
  Plot& plots(const std::string& heading);
  /// The figure that plot() or plots() began, for its size and the names of its columns.
  /// @throws std::logic_error if there is none
  [[nodiscard]] Plot& figure();
  /// A figure that is more than curves: data for a template of `figures/templates`, and its variables.
  void draw(Table data, std::string template_name, std::map<std::string, std::string> variables);
  /// The same of a figure that is made.
  void draw(Figure figure);

  /// The table, with a row for each of @p rows.
  template <class Rows>
  void table(const Rows& rows, const ColumnsOf<Rows>& columns) {
    table(table_of(rows, columns));
  }
  /// The table.
  void table(Table table);

  /// Checks that a value lies within a relative distance of one known from elsewhere.
  void near(const std::string& name, const Amount& value, double known, double relative,
            const std::string& reason);
  /// Checks that a value that is not negative does not exceed a bound.
  void at_most(const std::string& name, const Amount& value, double bound, const std::string& reason);
  /// Checks that a value lies between two bounds, these included.
  void between(const std::string& name, const Amount& value, double low, double high,
               const std::string& reason);
  /// Checks that a count is what it must be.
  void equals(const std::string& name, const Amount& value, double known, const std::string& reason);

  /// A number that a source prints. @param name as PublishedValue::name()
  /// @throws std::logic_error if no source prints it
  [[nodiscard]] double printed(const std::string& name);
  /// What we get for a printed number. @param name as PublishedValue::name()
  /// @param setting of the runs behind both, in words, for the pages
  /// @throws std::logic_error at a second number for the same name
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
