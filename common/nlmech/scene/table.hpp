/// @file
/// A rectangular table: the numbers behind a figure, or a table of a page. Written as CSV and as Markdown.
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

/// A text, a real number, a whole number, or nothing. A exact value is 1 or 0.
struct Cell : std::variant<std::monostate, std::string, double, std::int64_t> {
  Cell() = default;  ///< nothing
  /// A real number.
  template <std::floating_point Number>
  Cell(Number x) : variant(static_cast<double>(x)) {}
  /// A whole number.
  template <std::integral Number>
  Cell(Number n) : variant(static_cast<std::int64_t>(n)) {}
  Cell(const std::optional<double>& value);                    ///< nothing where there is no number
  Cell(std::string text) : variant(std::move(text)) {}         ///< a text
  Cell(const char* text) : variant(std::string(text)) {}       ///< a text
  Cell(std::string_view text) : variant(std::string(text)) {}  ///< a text
};

/// How a column is named and shown.
struct Column {
  std::string name;  ///< heading; in CSV files with its unit, "height_km"
  int digits = 3;    ///< significant digits of real numbers in Markdown; CSV files carry 17
  bool scan_lines =
      false;  ///< a blank line in the CSV wherever this column changes: gnuplot's mark between scan lines
};

/// Columns with names, and rows of as many cells.
class Table {
 public:
  /// @throws std::invalid_argument if there is no column
  explicit Table(std::vector<Column> columns);

  /// @throws std::invalid_argument if the row has another number of cells than there are columns
  void add(std::vector<Cell> row);

  /// As given.
  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// In the order in which they were added.
  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const { return rows_; }

  /// A cell in words, real numbers with the digits of their column.
  [[nodiscard]] std::string text(std::size_t row, std::size_t column) const;
  /// Are there only numbers in the column, or nothing?
  [[nodiscard]] bool numeric(std::size_t column) const;

  /// Header and rows; real numbers with 17 significant digits, so that reading gives back the same number.
  [[nodiscard]] std::string csv() const;
  /// A table of GitHub's Markdown; real numbers with the digits of their column.
  [[nodiscard]] std::string markdown() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// A real number with so many significant digits, without needless zeros: 1.508e-03 becomes "1.508e-3".
[[nodiscard]] std::string format_number(double value, int digits);

/// A text as one field of a CSV file: quoted if it must be.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace nlmech::scene
