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
/// A file is read twice. The first time it is only checked, so that a mistake in any row is reported before
/// the work begins. Standard input is read once, and a mistake is reported when its row is reached.
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

  /// Rows are counted by their weight from now on, not by their number.
  void weigh_by(RowWeight weight) { weight_ = std::move(weight); }
  /// The next rows, a portion or fewer; none at the end.
  /// @throws InputError as above
  [[nodiscard]] CatalogueRows next(const Portion& portion);

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
};

/// The lines that are made of a catalogue.
struct CatalogueOutput {
  std::string header;  ///< without the end of the line
  Portion portion;     ///< rows at a time
  /// The lines of some rows.
  std::function<std::string(const CatalogueRows&)> work;
};

/// Works on the rows of a catalogue in portions and prints the lines in the order of the rows, each portion
/// as soon as it is done.
/// @throws InputError as the catalogue does
void print_catalogue(Catalogue& catalogue, const CatalogueOutput& output);

/// Rows that make @p lines lines or more and fill the lanes of all threads, but at most a quarter of a
/// million lines a thread, because the lines of a portion are held in memory.
/// @param threads 0: one a processor
[[nodiscard]] Portion portion_for(double lines, int threads);

/// The lines of @p count tasks, made by several threads and joined in order. @p add appends those of one
/// task.
/// @param threads 0: one a processor
[[nodiscard]] std::string lines_in_threads(
    std::size_t count, int threads, const std::function<void(std::size_t task, std::string& lines)>& add);

}  // namespace nlmech::scene
