/// @file
/// Misprints of the sources: one list a chapter, each entry with the test that proves it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tools/reproduction/guide.hpp"

namespace nlmech::reproduction {

/// A misprint. The columns of `tables/errata/<chapter>.csv`, which its README explains.
struct Erratum {
  std::string chapter;             ///< name of the file
  std::string id;                  ///< "geodesy-2.45"; unique over all chapters
  std::string source;              ///< "elgohary"
  std::string place;               ///< "(2.45)"
  std::string kind;                ///< "formula", "number", "claim", or "wording": nothing to compute
  std::string printed;             ///< as printed, in the syntax of the pages
  std::string correct;             ///< as it should be
  std::string effect;              ///< what the printed form does; may be empty
  std::string scan;                ///< may the scanning have done it? "no" or "perhaps"
  std::vector<std::string> tests;  ///< "unit_frames:Errata.BeamColumn"; none for wording
  std::string misses;              ///< how far the printed form is from the oracle, as the test says
  std::string within;              ///< how close to it the test holds the corrected form
};

/// The entries of one chapter's list. @param file what complaints call it
/// @throws InputError naming file, line and cell: an unknown kind, an id twice, an entry without its test
[[nodiscard]] std::vector<Erratum> parse_errata(std::string_view text, const std::string& chapter,
                                                const std::string& file);

/// All entries of `<data>/tables/errata/*.csv`, files in alphabetical order.
/// @throws InputError naming file, line and cell: an unknown kind, an id twice, an entry without its test
[[nodiscard]] std::vector<Erratum> read_errata(const std::filesystem::path& data_folder);

/// The page `ERRATA.md`: counts by chapter and kind, which are its contents, then a section a chapter.
/// Formulas are written as forges show them, $`x`$.
[[nodiscard]] std::string errata_page(const std::vector<Erratum>& errata, const Guide& guide);

/// The entries of one chapter as a table in Markdown, for its page.
[[nodiscard]] std::string errata_table(const std::vector<Erratum>& errata, const std::string& chapter);

}  // namespace nlmech::reproduction
