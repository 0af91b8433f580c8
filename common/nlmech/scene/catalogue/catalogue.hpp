/// @file
/// Catalogues: CSV with a header and one task per row, read in portions, so that memory does not grow with
/// the file. Every error message names file, line, column and value.
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

/// Some consecutive rows of a catalogue.
struct CatalogueRows {
  std::int64_t first = 1;         ///< number of the first row, from 1
  std::vector<std::size_t> line;  ///< line of each row in the file, from 1
  std::vector<std::vector<double>>
      numbers;                    ///< numbers by row, then by known column; NaN for missing columns
  std::vector<std::string> rest;  ///< other cells of each row, unchanged, each after a comma
};

/// Error message for the numbers of a row, as "x,y,z = 0,0,0: is the centre"; empty for a valid row.
using RowCheck = std::function<std::string(const std::vector<double>& numbers)>;

/// Weight of a row in a portion, for example its number of output lines.
using RowWeight = std::function<double(const std::vector<double>& numbers)>;

/// Size of a portion: it ends when it has both `weight` and `rows`, or with fewer rows the weight `most`.
struct Portion {
  double weight = 1;     ///< least weight
  std::size_t rows = 1;  ///< least number of rows
  double most = 0;       ///< weight that suffices for any number of rows
};

/// Reads one catalogue row by row by CsvColumns.
///
/// A file is read twice. The first pass only checks it, so that a mistake in any row is reported before the
/// work begins. Standard input is read once, and a mistake is reported when its row is reached.
class Catalogue {
 public:
  /// @param path file; "-" is standard input
  /// @param required names of the required columns  @param optional names of the optional ones
  /// @param check check of each row
  /// @throws InputError naming the file, and line, column and value
  Catalogue(std::string path, const std::vector<std::string>& required,
            const std::vector<std::string>& optional, RowCheck check, NameCase fits = NameCase::any);

  /// The columns, and the names of those passed through.
  [[nodiscard]] const CsvColumns& columns() const { return columns_; }
  /// Does the catalogue have this column?
  [[nodiscard]] bool has(std::string_view column) const { return columns_.has(column); }
  /// The path for messages.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Number of rows; unknown for standard input.
  [[nodiscard]] std::optional<std::int64_t> rows() const { return rows_; }

  /// Sets the weight of rows for next(); by default each row has the weight 1.
  void set_row_weight(RowWeight weight) { weight_ = std::move(weight); }
  /// The next portion of rows, the rest if there are fewer, none at the end.
  /// @throws InputError as the constructor
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

/// Output for a catalogue.
struct CatalogueOutput {
  std::string header;  ///< header without the line end
  Portion portion;     ///< size of the portions
  /// Computes the output lines of some rows.
  std::function<std::string(const CatalogueRows&)> work;
};

/// Processes the rows of a catalogue in portions and prints their lines in order, each portion when it is
/// done.
/// @throws InputError as Catalogue::next()
void print_catalogue(Catalogue& catalogue, const CatalogueOutput& output);

/// Portion of at least @p lines output lines that occupies the SIMD lanes of all threads, but of at most a
/// quarter of a million lines per thread, because the lines of a portion are held in memory.
/// @param threads number of threads; 0: one per processor
[[nodiscard]] Portion portion_for(double lines, int threads);

/// Output lines of @p count tasks, computed by several threads and joined in order. @p add appends those of
/// one task.
/// @param threads number of threads; 0: one per processor
[[nodiscard]] std::string lines_in_threads(
    std::size_t count, int threads, const std::function<void(std::size_t task, std::string& lines)>& add);

}  // namespace nlmech::scene
