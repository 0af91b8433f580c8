/// @file
/// Reading CSV: records of texts, and columns of numbers by name. Every complaint names file, line, column
/// and value.
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

/// Does a name of a column fit in any case, or in its own alone, as names of equations do?
enum class NameCase { any, exact };

/// The columns of a user's CSV file, line by line: the one reader of all commands.
///
/// The first line names the columns, in any order, and in any case if no other column has the exact name.
/// Columns with other names are handed on. Without a header the file has the required columns alone, in their
/// order. Cells may stand in double quotes; blanks around them, empty cells at the end of a line, blank
/// lines, CR before LF and the mark that spreadsheets put first (BOM) do not count. A line that begins with
/// '#' is a comment before the header; behind it only if the first column holds numbers: as a text, such a
/// cell belongs to a row.
class CsvColumns {
 public:
  /// @param name what complaints call the file
  /// @param known names of the columns of numbers; "height_m|h" is a name and another one that a file may
  /// have
  /// @param required how many of them, from the first, must be there
  CsvColumns(std::string name, const std::vector<std::string>& known, std::size_t required,
             NameCase fits = NameCase::any);

  /// A line without what does not count; empty if it is blank or a comment. @param number from 1
  [[nodiscard]] std::string_view content(std::string_view line, std::size_t number) const;
  /// Reads the first line that has content. False: there is no header, and the line is the first row.
  /// @throws InputError if a required column is missing or two columns have the same name
  [[nodiscard]] bool read_header(std::string_view line, std::size_t number);
  /// Reads a row. @param numbers as the columns are known; NaN without the column
  /// @param rest the other cells as they stand, a comma before each
  /// @throws InputError at a cell that is not a finite number, and at too few or too many cells
  void read_row(std::string_view line, std::size_t number, std::vector<double>& numbers,
                std::string& rest) const;

  /// Forgets the header, for a file that is read again.
  void forget_header();
  /// To throw: the file has no line. @throws InputError
  [[noreturn]] void refuse_empty() const;
  /// Has the file this column?
  [[nodiscard]] bool has(std::string_view column) const;
  /// The names of the columns that are handed on, a comma before each. One that is among @p own, the columns
  /// of the output, gets "input_" before it.
  [[nodiscard]] std::string rest_names(const std::vector<std::string>& own = {}) const;

 private:
  [[nodiscard]] std::string expected() const;
  void assign(std::string_view line, std::size_t number);

  std::string name_;
  std::vector<std::vector<std::string>> known_;  ///< with the other names of each
  std::size_t required_;
  NameCase fits_;
  std::vector<std::string> cells_, names_;  ///< of the header, as they stand and unquoted
  std::vector<int> column_;                 ///< of the file, to which of known_ it belongs, or -1
};

/// Numbers by column: `column[i][row]`, and the line on which each row stands.
struct NumberColumns {
  std::vector<std::vector<double>> column;  ///< by column, then by row
  std::vector<std::size_t> line;            ///< of the file, from 1
  std::vector<std::string> rest;            ///< by row: the cells of other columns, a comma before each
  std::string rest_names;                   ///< names of these, see CsvColumns::rest_names()
  /// How many rows were read.
  [[nodiscard]] std::size_t rows() const { return line.size(); }
};

/// All rows of a text with the columns @p names, as CsvColumns reads them.
/// @param own columns of the output, see CsvColumns::rest_names()
/// @throws InputError as there, and if nothing stands in the text
[[nodiscard]] NumberColumns parse_numbers(std::string_view text, const std::string& name,
                                          const std::vector<std::string>& names,
                                          const std::vector<std::string>& own = {});

/// Says on standard error that a file has a header and no row.
void tell_of_no_rows(const std::string& name);

/// A finite number that takes up the whole of @p text, blanks around it aside ("+1.5", "1e-3"; no
/// hexadecimals).
/// @returns false, with @p value untouched, if it is anything else, or so small that only 0 is near it
[[nodiscard]] bool parse_number(std::string_view text, double& value);

/// What a text is that parse_number() refuses: "not a finite number", or why not.
[[nodiscard]] std::string number_fault(std::string_view text);

}  // namespace nlmech::scene
