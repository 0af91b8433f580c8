/// @file
/// A rectangular table, the data of a figure or a table of a page, as CSV and as Markdown.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace nlmech::scene {

/// A text, a real number, an integer, or nothing. A bool is stored as 1 or 0.
struct Cell : std::variant<std::monostate, std::string, double, std::int64_t> {
  Cell() = default;  ///< an empty cell
  /// A real number.
  template <std::floating_point Number>
  Cell(Number x) : variant(static_cast<double>(x)) {}
  /// A whole number.
  template <std::integral Number>
  Cell(Number n) : variant(static_cast<std::int64_t>(n)) {}
  Cell(const std::optional<double>& value);                    ///< a number or an empty cell
  Cell(std::string text) : variant(std::move(text)) {}         ///< a text
  Cell(const char* text) : variant(std::string(text)) {}       ///< a text
  Cell(std::string_view text) : variant(std::string(text)) {}  ///< a text
};

/// Name and format of a column.
struct Column {
  std::string name;  ///< heading; in CSV files with its unit, "height_km"
  int digits = 3;    ///< significant digits of real numbers in Markdown; CSV files carry 17
  bool scan_lines =
      false;  ///< write a blank line to the CSV where this column changes, gnuplot's separator of scan lines
};

/// Named columns and rows of cells.
class Table {
 public:
  /// @throws std::invalid_argument if there is no column
  explicit Table(std::vector<Column> columns);

  /// Appends a row. @throws std::invalid_argument unless it has one cell per column
  void add(std::vector<Cell> row);

  /// All columns.
  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// All rows in the order in which they were added.
  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const { return rows_; }

  /// Text of a cell; real numbers have the digits of their column.
  [[nodiscard]] std::string text(std::size_t row, std::size_t column) const;
  /// Does the column contain only numbers and empty cells?
  [[nodiscard]] bool numeric(std::size_t column) const;

  /// Header and rows; real numbers have 17 significant digits, so that reading restores them exactly.
  [[nodiscard]] std::string csv() const;
  /// A table of GitHub's Markdown; real numbers with the digits of their column.
  [[nodiscard]] std::string markdown() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// A real number with @p digits significant digits and without superfluous zeros: 1.508e-03 becomes
/// "1.508e-3".
[[nodiscard]] std::string format_number(double value, int digits);

/// A text as one CSV field, quoted if necessary.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace nlmech::scene
