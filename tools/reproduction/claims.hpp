/// @file
/// What the sources claim in prose, and the evidence for or against it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"

namespace nlmech::reproduction {

/// A statement of a source that can be checked, and one number that decides about it. The columns of
/// `tables/claims.csv`, which `tables/published/README.md` explains.
struct Claim {
  std::string source;   ///< "elgohary"
  std::string place;    ///< chapter, section or equation: "4.4.1"
  std::string chapter;  ///< that has the evidence
  std::string text;     ///< the claim, in our words
  /// Of that chapter; or `REPRODUCTION`, what was measured for a printed number; or `RATIOS`, of run times.
  std::string scene;
  std::string quantity;  ///< of that scene, or "table-4.4/HHT-1/RMS error"; may be empty if not stated
  std::string means;     ///< what the claim says of it: "at least 2", "at most 1e-7", "0.9 to 1.1"
  scene::Verdict expected = scene::Verdict::not_stated;  ///< `holds`, `does not hold`, or `not stated`
  std::string reading;  ///< how the claim was understood, or what it leaves out
};

/// Is @p value what the words say? Never true for NaN.
/// @throws InputError if the words are not of the forms above
[[nodiscard]] bool within(std::string_view words, double value);

/// The rows of the list. @param file what complaints call it
/// @throws InputError naming file, line and cell
[[nodiscard]] std::vector<Claim> parse_claims(std::string_view text, const std::string& file);

/// A claim, and what the evidence on disk says of it.
struct JudgedClaim {
  Claim claim;        ///< as listed
  double value = 0;   ///< of the quantity; NaN if it is not there
  std::string range;  ///< that stands in its place, where rounding decides which number of it is found
  scene::Verdict verdict = scene::Verdict::not_built;  ///< by the evidence
  bool passes = false;                                 ///< the expected verdict, or the chapter is not built
};

/// All claims of `<data>/tables/claims.csv`, with the quantities that checks left under @p out.
/// @throws InputError if a file cannot be read
[[nodiscard]] std::vector<JudgedClaim> judge_claims(const std::vector<std::string>& built,
                                                    const std::filesystem::path& data_folder,
                                                    const std::filesystem::path& out);

/// The page `CLAIMS.md`: counts, then a table a source, in the order of the list.
[[nodiscard]] std::string claims_page(const std::vector<JudgedClaim>& claims);

}  // namespace nlmech::reproduction
