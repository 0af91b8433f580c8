/// @file
/// Check of a chapter: published against reproduced values. `scripts/tables` makes pages over all sources
/// from its files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/publish.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::scene {

/// A published value with the reproduced one and the verdict.
struct Checked {
  PublishedValue value;  ///< published value
  std::string chapter;   ///< chapter that owns it
  Measured measured;     ///< reproduced values
  Judgement judgement;   ///< verdict by the evidence
  std::string failure;   ///< reason of a failed run; empty otherwise
};

/// A quantity of a scene.
struct CheckedQuantity {
  std::string scene;  ///< name of the scene
  Quantity quantity;  ///< quantity with its range
};

/// Result of the check of a chapter.
struct ChapterCheck {
  std::vector<Checked> values;              ///< published values in the order of the files
  std::vector<CheckedQuantity> quantities;  ///< quantities in the order of the scenes
  /// Do all values and quantities pass?
  [[nodiscard]] bool passes() const;
};

/// Computes and checks every published value of the chapter and every quantity of its scenes. After a Failure
/// of a run only the values and scenes that need it fail, with its message.
/// @param how also publishes every scene, computed once for both; nothing: no files
/// @throws std::logic_error if a judged value has no measurement, or a measurement no value
[[nodiscard]] ChapterCheck check(const Chapter& chapter, const std::filesystem::path& data_folder, bool quick,
                                 const std::optional<Publishing>& how = {});

/// Writes `results/<chapter>/check.csv`, one row per value with its verdict.
void write_check(const ChapterCheck& check, const std::string& chapter, const std::filesystem::path& out);

/// The verdict as text, with the expected one if it differs.
[[nodiscard]] std::string verdict_text(const Checked& checked);

/// Setting and reading of a value with the evidence: "at the ends of steps; the other norm (2 tried; explains
/// 2 of 2 rows)".
[[nodiscard]] std::string reading_text(const Checked& checked);

/// Values as lines of plain text for a terminal; failed ones are marked.
[[nodiscard]] std::string reproduction_text(const std::vector<Checked>& values);

}  // namespace nlmech::scene
