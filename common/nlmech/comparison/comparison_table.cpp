#include "nlmech/comparison/comparison_table.hpp"

#include <fmt/format.h>

namespace nlmech::comparison {

ComparisonTable::ComparisonTable(std::string_view program, const Status& truth)
    : program_(program), has_reference_(truth.ok()) {
  if (!has_reference_)
    fmt::print(stderr, "{}: no digits, because there is no reference: {}\n", program_, truth.text());
}

void ComparisonTable::add(const Choice& choice, const Status& status, const Statistics& statistics,
                          double error, double seconds) {
  std::string digits;
  if (!status.ok()) {
    fmt::print(stderr, "{}: {}: {}\n", program_, choice.method.name, status.text());
  } else if (has_reference_) {
    digits = fmt::format("{:.3f}", digits_of(error));
  }
  text_ += fmt::format("{},{},{},{},{:.4g},{}\n", choice.method.name, choice.setting(),
                       to_string(status.outcome()), digits, seconds, statistics.right_hand_sides);
}

}  // namespace nlmech::comparison
