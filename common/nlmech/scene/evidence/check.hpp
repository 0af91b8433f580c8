/// @file
/// Published beside reproduced: a chapter's check. `scripts/tables` makes the pages over all sources of what
/// it leaves.
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

/// `results/<chapter>/check.csv`: one row a value, with its verdict.
void write_check(const ChapterCheck& check, const std::string& chapter, const std::filesystem::path& out);

/// The verdict in words, with the expected one where it is another.
[[nodiscard]] std::string verdict_text(const Checked& checked);

/// The setting that ran and how the text was understood, with the evidence for it: "at the ends of steps; the
/// other norm (2 tried; explains 2 of 2 rows)".
[[nodiscard]] std::string reading_text(const Checked& checked);

/// Values as lines of plain text, for a terminal; misses are marked.
[[nodiscard]] std::string reproduction_text(const std::vector<Checked>& values);

}  // namespace nlmech::scene
