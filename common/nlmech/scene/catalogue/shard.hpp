/// @file
/// Parts of a catalogue's output: what each says of itself, and how all are put together again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/scene/catalogue/catalogue.hpp"

namespace nlmech::scene {

/// The i-th of n disjoint parts of consecutive rows.
struct Shard {
  int part = 1;   ///< i, from 1
  int parts = 1;  ///< n
  /// First and last row of @p rows, counted from 1; the last is before the first if there is none.
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> rows(std::int64_t rows) const;
};

/// "i/n" as it was typed. @throws InputError naming @p option
[[nodiscard]] Shard typed_shard(const std::string& option, const std::string& text);

/// Works on the rows of a catalogue in portions and prints what becomes of them: in the order of the rows,
/// and each portion as soon as it is done.
struct CatalogueRun {
  std::string shard;    ///< "i/n", or empty for all of it
  std::string options;  ///< what else the output depends on, for merge to compare
  std::string header;   ///< of the output, without the end of the line
  Portion portion;      ///< rows at a time
  /// The lines of some rows.
  std::function<std::string(const CatalogueRows&)> work;
  /// How many rows have failed so far; a shard says so at its end.
  std::function<std::int64_t()> failed;
};

/// @throws InputError for a shard of standard input, whose end is not known, and as the catalogue does
void print_catalogue(Catalogue& catalogue, const CatalogueRun& run);

/// Rows that make @p lines lines or more, and that are enough for the lanes of all threads, unless those
/// would make more than a quarter of a million lines a thread: lines of a portion are held in memory.
/// @param threads 0: one a processor
[[nodiscard]] Portion portion_for(double lines, int threads);

/// The lines of @p count tasks, made by several threads and joined in order. @p add appends those of one
/// task.
/// @param threads 0: one a processor
[[nodiscard]] std::string lines_in_threads(
    std::size_t count, int threads, const std::function<void(std::size_t task, std::string& lines)>& add);

/// Prints what one run without --shard prints, from the files of all shards in any order. Nothing is printed
/// before all are known to be whole: the last line of a part says how many lines stand above it, a digest of
/// them, and how many rows failed.
/// @throws InputError naming the file and what is wrong with it; a part is a file, which can be read twice
/// @throws Failure if rows failed, once all is printed: the exit code is that of one run
void print_merged(const std::vector<std::string>& paths);

}  // namespace nlmech::scene
