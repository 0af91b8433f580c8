/// @file
/// Reader of CSV: records of texts, and columns of numbers by name. Every error message names file, line,
/// column and value.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nlmech::scene {

/// One record of a CSV file.
struct CsvRecord {
  std::size_t line = 0;            ///< number of its first line, from 1
  std::vector<std::string> cells;  ///< unquoted cells
};

/// Splits @p text into records: commas, optional double quotes ("" inside is a quote), LF or CRLF. Blank
/// lines are skipped.
/// @param name name of the text in messages: the file's name, or "standard input"
/// @throws InputError for an unclosed quote
[[nodiscard]] std::vector<CsvRecord> parse_csv(std::string_view text, const std::string& name);

/// Comparison of column names: ignoring case, or exact as for names of equations.
enum class NameCase { any, exact };

/// Columns of a user's CSV file, read line by line, for all commands.
///
/// The first line names the columns in any order, and in any case unless another column has the exact name.
/// Columns with other names are passed through. A file without a header has exactly the required columns in
/// their order. Cells may be in double quotes. Blanks around cells, empty cells at the end of a line, blank
/// lines, CR before LF and a byte order mark are ignored. A line that begins with '#' is a comment before the
/// header; after it only if the first column holds numbers, because otherwise it may be a row.
class CsvColumns {
 public:
  /// @param name name of the file in messages
  /// @param known names of the columns of numbers; "height_m|h" is a name with an alternative
  /// @param required number of required columns, from the first
  CsvColumns(std::string name, const std::vector<std::string>& known, std::size_t required,
             NameCase fits = NameCase::any);

  /// Content of a line; empty if it is blank or a comment. @param number number of the line, from 1
  [[nodiscard]] std::string_view content(std::string_view line, std::size_t number) const;
  /// Reads the first line with content as the header; false if it is the first row instead.
  /// @throws InputError if a required column is missing or two columns have the same name
  [[nodiscard]] bool read_header(std::string_view line, std::size_t number);
  /// Reads a row. @param numbers receives the numbers in the order of the known columns; NaN for missing
  /// columns
  /// @param rest receives the other cells unchanged, each after a comma
  /// @throws InputError for a cell that is not a finite number, and for too few or too many cells
  void read_row(std::string_view line, std::size_t number, std::vector<double>& numbers,
                std::string& rest) const;

  /// Removes the header, for a file that is read again.
  void reset_header();
  /// Throws that the file has no line. @throws InputError
  [[noreturn]] void refuse_empty() const;
  /// Does the file have this column?
  [[nodiscard]] bool has(std::string_view column) const;
  /// Names of the columns passed through, each after a comma. A name among @p own, the columns of the output,
  /// gets the prefix "input_".
  [[nodiscard]] std::string rest_names(const std::vector<std::string>& own = {}) const;

 private:
  [[nodiscard]] std::string expected() const;
  void assign(std::string_view line, std::size_t number);

  std::string name_;
  std::vector<std::vector<std::string>> known_;  ///< names of each column with its alternatives
  std::size_t required_;
  NameCase fits_;
  std::vector<std::string> cells_, names_;  ///< cells of the header, unchanged and unquoted
  std::vector<int> column_;                 ///< index in known_ of each column of the file, or -1
};

/// Numbers of a file by column.
struct NumberColumns {
  std::vector<std::vector<double>> column;  ///< numbers by column, then by row
  std::vector<std::size_t> line;            ///< line of each row in the file, from 1
  std::vector<std::string> rest;            ///< cells of other columns by row, each after a comma
  std::string rest_names;                   ///< names of the other columns, see CsvColumns::rest_names()
  /// Number of rows.
  [[nodiscard]] std::size_t rows() const { return line.size(); }
};

/// Reads all rows of a text with the columns @p names by CsvColumns.
/// @param own columns of the output, see CsvColumns::rest_names()
/// @throws InputError as CsvColumns, and for an empty text
[[nodiscard]] NumberColumns parse_numbers(std::string_view text, const std::string& name,
                                          const std::vector<std::string>& names,
                                          const std::vector<std::string>& own = {});

/// Reports on standard error that a file has a header and no row.
void print_no_rows(const std::string& name);

/// Parses a finite decimal number that fills @p text, except for blanks around it: "+1.5", "1e-3".
/// @returns false, with @p value unchanged, for any other text and for a number that would underflow to 0
[[nodiscard]] bool parse_number(std::string_view text, double& value);

/// Why parse_number() refuses a text: "not a finite number", or a more specific reason.
[[nodiscard]] std::string number_fault(std::string_view text);

}  // namespace nlmech::scene
