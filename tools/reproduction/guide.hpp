/// @file
/// Where the pages of evidence lead: sources and chapters as readers know them, links to pages, scenes and
/// tests.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"

namespace nlmech::reproduction {

/// Names and links of the pages in `tables/`.
class Guide {
 public:
  /// Reads `tables/places.csv`, and what is there of `docs/chapters.txt` and `tests/`: an installed folder of
  /// data has neither, its chapters go by their folder's names and its tests have no link.
  /// @throws InputError naming file and line
  explicit Guide(const std::filesystem::path& data_folder);

  /// "Limit points" for homotopy.
  [[nodiscard]] std::string chapter_title(const std::string& chapter) const;
  /// The place of a chapter in the order in which the sources come to them.
  [[nodiscard]] std::ptrdiff_t rank(const std::string& chapter) const;
  /// The chapter's page as forges show it, which a page in `tables/` links to. The book leads to its own.
  [[nodiscard]] static std::string page(const std::string& chapter);
  /// A link to the chapter's page, to what it shows for a place of the source if the place is a figure or a
  /// table.
  /// @param text what is linked
  [[nodiscard]] std::string link(const std::string& chapter, const std::string& source,
                                 const std::string& place, const std::string& text) const;
  /// The same for a place in the words of a list of misprints: "Table 2.6, C3" is of table-2.6. Words that
  /// are no figure or table of the source are no link.
  [[nodiscard]] std::string link_words(const std::string& chapter, const std::string& source,
                                       const std::string& words) const;
  /// "unit_frames:Errata.BeamColumn" as "Beam column", linked to the file that holds the test; as code where
  /// there is none.
  [[nodiscard]] std::string test_link(const std::string& test) const;

 private:
  std::vector<scene::Place> places_;
  std::map<std::string, std::string> titles_;                        ///< of chapters
  std::map<std::string, std::vector<std::filesystem::path>> tests_;  ///< files by "Suite.Name"
};

/// A source as its title page has it; one that is not known by its name in the lists.
[[nodiscard]] std::string source_title(const std::string& source);

/// A link to a section that begins with section_mark() of the same words.
[[nodiscard]] std::string section_link(std::string_view page, const std::string& chapter,
                                       const std::string& text);

/// The line to which section_link() leads.
[[nodiscard]] std::string section_mark(std::string_view page, const std::string& chapter);

}  // namespace nlmech::reproduction
