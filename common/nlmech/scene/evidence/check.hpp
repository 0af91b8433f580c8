/// @file
/// Published beside reproduced: a chapter's own check, and the report over all sources.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/publish.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// A published value with what we measured for it and the verdict.
struct Checked {
  PublishedValue value;  ///< as printed
  std::string chapter;   ///< that owns it
  Measured measured;     ///< ours
  Judgement judgement;   ///< by the evidence
  std::string failure;   ///< why nothing could be measured; empty otherwise
};

/// A quantity of a scene.
struct CheckedQuantity {
  std::string scene;  ///< its name
  Quantity quantity;  ///< with its range
};

/// All that is checked of a chapter.
struct ChapterCheck {
  std::vector<Checked> values;              ///< in the order of the files
  std::vector<CheckedQuantity> quantities;  ///< in the order of the scenes
  /// Do all of them pass?
  [[nodiscard]] bool passes() const;
};

/// Measures every published value that belongs to the chapter and every quantity of its scenes. A run that
/// ends in a Failure costs its own values and scenes and no others: they fail, with the sentence
/// of the failure.
/// @param how where every scene is put on disk as well, computed once for both; nothing: nowhere
/// @throws std::logic_error if a judged value has no measurement, or a measurement no value
[[nodiscard]] ChapterCheck check(const Chapter& chapter, const std::filesystem::path& data_folder, bool quick,
                                 const std::optional<Publishing>& how = {});

/// `results/<chapter>/check.csv`: one row a value. The report reads it again.
void write_check(const ChapterCheck& check, const std::string& chapter, const std::filesystem::path& out);

/// All published values of all sources in the order of the files. Those of chapters that are not in @p built
/// get the verdict `not built`; the others what `results/<chapter>/check.csv` under @p out says.
/// @throws InputError if a built chapter's file is missing or does not list a value
[[nodiscard]] std::vector<Checked> collect_checks(const std::vector<std::string>& built,
                                                  const std::filesystem::path& data_folder,
                                                  const std::filesystem::path& out);

/// The verdict in words, with the expected one where it is another.
[[nodiscard]] std::string verdict_text(const Checked& checked);

/// The nominal number to four digits; the range that the file states in its place, where rounding decides
/// which number of it is found and this one lies in it. Empty if there is none.
[[nodiscard]] std::string nominal_text(const Checked& checked);

/// How the text was understood, with the evidence for it: "the other norm (2 tried; explains 2 of 2 rows)".
[[nodiscard]] std::string reading_text(const PublishedValue& value);

/// Values as lines of plain text, for a terminal; misses are marked.
[[nodiscard]] std::string reproduction_text(const std::vector<Checked>& values);

}  // namespace nlmech::scene
