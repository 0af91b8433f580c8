/// @file
/// What `compare` prints: a row a method, and on standard error why one has no digits.
#pragma once

#include <string>
#include <string_view>

#include "nlmech/comparison/own_problem.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// Rows `method,setting,status,digits,seconds,rhs_evaluations`.
class ComparisonTable {
 public:
  /// @param program begins what is said on standard error
  /// @param truth status of the reference; without one there are no digits, which is said
  ComparisonTable(std::string_view program, const Status& truth);

  /// A row. @param error against the reference; without a meaning if the method or the reference failed
  void add(const Choice& choice, const Status& status, const Statistics& statistics, double error,
           double seconds);

  /// All of it.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string_view program_;
  bool has_reference_;
  std::string text_ = "method,setting,status,digits,seconds,rhs_evaluations\n";
};

}  // namespace nlmech::comparison
