/// @file
/// Reading CSV: records of texts, and columns of numbers. Every complaint names file, line, column and value.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// One line of a CSV file with the number of the line (from 1).
struct CsvRecord {
  std::size_t line = 0;            ///< on which the record begins, from 1
  std::vector<std::string> cells;  ///< unquoted
};

/// Splits @p text into records: commas, optional double quotes ("" inside is a quote), LF or CRLF. Blank
/// lines are skipped.
/// @param name what complaints call the text: the file's name, or "standard input"
/// @throws InputError at a quote that is never closed
[[nodiscard]] std::vector<CsvRecord> parse_csv(std::string_view text, const std::string& name);

/// Numbers by column: `column[i][row]`, and the line on which each row stands.
struct NumberColumns {
  std::vector<std::vector<double>> column;  ///< by column, then by row
  std::vector<std::size_t> line;            ///< of the file, from 1
  /// How many rows were read.
  [[nodiscard]] std::size_t rows() const { return line.size(); }
};

/// Reads rows of finite numbers, one for each name in @p names. A first row whose cells are the names is a
/// header and is skipped; blank lines and lines that begin with '#' are too.
/// @throws InputError naming file, line, column and the cell's text at the first cell that is not a finite
/// number, and at
///         a row with too few or too many cells
[[nodiscard]] NumberColumns parse_numbers(std::string_view text, const std::string& name,
                                          const std::vector<std::string>& names);

/// A finite number that takes up the whole of @p text, blanks around it aside ("+1.5", "1e-3"; no
/// hexadecimals).
/// @returns false, with @p value untouched, if it is anything else
[[nodiscard]] bool parse_number(std::string_view text, double& value);

}  // namespace nlmech::scene
