/// @file
/// A catalogue: CSV with a header and a task a row, read some rows at a time, so that memory does not grow
/// with the file. Every complaint names file, line, column and value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/scene/program/csv.hpp"

namespace nlmech::scene {

/// Some consecutive rows.
struct CatalogueRows {
  std::int64_t first = 1;         ///< number of the first one, from 1
  std::vector<std::size_t> line;  ///< of the file, from 1, by row
  std::vector<std::vector<double>>
      numbers;                    ///< by row, then as the columns are known; NaN without the column
  std::vector<std::string> rest;  ///< by row: the other cells as they stand, a comma before each
};

/// What is wrong with the numbers of a row, as "x,y,z = 0,0,0: is the centre"; empty if nothing is.
using RowCheck = std::function<std::string(const std::vector<double>& numbers)>;

/// What a row counts for in a portion, as the lines that its output has.
using RowWeight = std::function<double(const std::vector<double>& numbers)>;

/// How many rows at a time: until they weigh `weight` and are `rows`, or, being fewer, weigh `most`.
struct Portion {
  double weight = 1;     ///< that is enough, if there are rows enough
  std::size_t rows = 1;  ///< that are enough, if they weigh enough
  double most = 0;       ///< weight that is enough whatever the rows
};

/// Reads one catalogue from its first row to its last, as CsvColumns reads lines.
///
/// A file is read through once beforehand: rows() and digest() are known then, and whatever is wrong with any
/// of its rows is said before the first is worked on. Standard input cannot be read twice, and complaints of
/// a row come when it is its turn.
class Catalogue {
 public:
  /// @param path "-" is standard input
  /// @param required columns that must be there  @param optional columns that may be
  /// @throws InputError naming the file, and line, column and value
  Catalogue(std::string path, const std::vector<std::string>& required,
            const std::vector<std::string>& optional, RowCheck check, NameCase fits = NameCase::any);

  /// Its columns, and the names of those that are handed on.
  [[nodiscard]] const CsvColumns& columns() const { return columns_; }
  /// Is this one of its columns?
  [[nodiscard]] bool has(std::string_view column) const { return columns_.has(column); }
  /// Its path, as messages give it.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// How many rows it has; not known of standard input.
  [[nodiscard]] std::optional<std::int64_t> rows() const { return rows_; }
  /// A number made of all lines.
  [[nodiscard]] std::uint64_t digest() const { return digest_; }

  /// Rows are counted by their weight from now on, not by their number.
  void weigh_by(RowWeight weight) { weight_ = std::move(weight); }
  /// The next rows, a portion or fewer, up to number @p last; none at the end.
  /// @throws InputError as above
  [[nodiscard]] CatalogueRows next(const Portion& portion, std::int64_t last);
  /// Leaves out rows up to number @p row. @throws InputError as above
  void skip_to(std::int64_t row);

 private:
  /// A line and its number.
  struct Line {
    std::string_view text;
    std::size_t number = 0;
  };

  void open();
  [[nodiscard]] bool read_line(Line& line);
  [[nodiscard]] bool read_row(Line& line);
  void read_header();
  void understand(const Line& line, std::vector<double>& numbers, std::string& rest) const;

  std::string path_, name_;
  CsvColumns columns_;
  RowCheck check_;
  RowWeight weight_;
  std::ifstream file_;
  std::string buffer_;
  std::size_t place_ = 0, line_number_ = 0;
  bool ended_ = false;
  std::int64_t next_row_ = 1;
  std::optional<std::int64_t> rows_;
  std::uint64_t digest_ = 0xcbf29ce484222325U;
};

}  // namespace nlmech::scene
