/// @file
/// What the dissertation leaves open, the answers that were tried, and how many printed errors each explains.
#pragma once

#include <string>
#include <vector>

namespace nlmech::chapters::rbf_ivp {

/// How many printed numbers an answer explains.
struct Score {
  int rows = 0;   ///< looked at
  int exact = 0;  ///< come out to all printed digits (or within the factor of five of rounding noise)
  int close = 0;  ///< come out rounded to the printed digits, or cut off after them

  /// Counts a number printed as @p printed that comes out as @p ours.
  void count(const std::string& printed, double ours);
  /// Counts a number that is rounding noise: explained within a factor of five.
  void count_noise(double printed, double ours);
};

/// One answer.
struct Option {
  std::string text;  ///< "P = 4.77, end 500 s"
  Score score;       ///< what it explains
};

/// A question that the text leaves open, or that its printed answer does not settle.
struct ReadingChoice {
  std::string text;             ///< "end time and period"
  std::string tables;           ///< whose rows are looked at: "4.2"
  std::string literal;          ///< the option that the text names; empty if it names none
  std::string chosen;           ///< the option that the inferred readings take
  std::vector<Option> options;  ///< all that were tried

  /// @throws std::logic_error if there is no such option
  [[nodiscard]] const Option& option(const std::string& text) const;
};

/// Tries every option of every question. @param quick of long lists of numbers only a few
[[nodiscard]] std::vector<ReadingChoice> try_readings(bool quick);

/// The unit of the last digit of a number as printed: 1e-6 for "1.18e-4", 1e-4 for "0.0025".
[[nodiscard]] double last_digit(const std::string& printed);

}  // namespace nlmech::chapters::rbf_ivp
