/// @file
/// Settings that the dissertation does not state: the options tried, and the number of printed errors that
/// each explains.
#pragma once

#include <string>
#include <vector>

namespace nlmech::chapters::rbf_ivp {

/// Number of printed values that an option explains.
struct Score {
  int rows = 0;   ///< rows compared
  int exact = 0;  ///< reproduced to all printed digits (rounding noise: within a factor of five)
  int close = 0;  ///< reproduced rounded to the printed digits, or truncated

  /// Counts a printed value and the computed value @p computed.
  void count(const std::string& printed, double computed);
  /// Counts a value that is rounding noise; explained if within a factor of five.
  void count_noise(double printed, double computed);
};

/// One option and its score.
struct Option {
  std::string text;  ///< description, such as "P = 4.77, end 500 s"
  Score score;       ///< printed values that it explains
};

/// A setting that the text does not state, or whose stated value does not explain the printed values.
struct ReadingChoice {
  std::string text;             ///< description, such as "end time and period"
  std::string tables;           ///< tables compared, such as "4.2"
  std::string literal;          ///< option stated in the text; empty if none
  std::string chosen;           ///< option of the inferred readings
  std::vector<Option> options;  ///< all options tried

  /// The option of a description. @throws std::logic_error if there is none
  [[nodiscard]] const Option& option(const std::string& text) const;
};

/// Tries all options of all settings. @param quick tries only a few of long lists
[[nodiscard]] std::vector<ReadingChoice> try_readings(bool quick);

/// Unit of the last digit of a printed number: 1e-6 for "1.18e-4", 1e-4 for "0.0025".
[[nodiscard]] double last_digit(const std::string& printed);

}  // namespace nlmech::chapters::rbf_ivp
