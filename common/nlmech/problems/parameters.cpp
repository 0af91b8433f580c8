#include "nlmech/problems/parameters.hpp"

#include <cmath>
#include <stdexcept>

#include "nlmech/support/sentences.hpp"

namespace nlmech::problems {

void throw_unknown_parameter(std::string_view problem, std::string_view name,
                             std::span<const std::string_view> known) {
  std::string text(problem);
  text.append(": there is no parameter '").append(name).append("'; there is");
  const char* separator = " ";
  for (const std::string_view each : known) {
    text.append(separator).append(each);
    separator = ", ";
  }
  throw std::invalid_argument(text);
}

void check_range(std::string_view problem, std::string_view name, Range range, double value) {
  if (!std::isfinite(value)) throw invalid_argument("{}: {} must be finite, not {}", problem, name, value);
  if (range == Range::positive && !(value > 0))
    throw invalid_argument("{}: {} must be positive, not {}", problem, name, value);
  if (range == Range::not_negative && !(value >= 0))
    throw invalid_argument("{}: {} must not be negative, is {}", problem, name, value);
  if (range == Range::share && !(value >= 0 && value < 1))
    throw invalid_argument("{}: {} must be at least 0 and below 1, not {}", problem, name, value);
  if (range == Range::count && !(value >= 1 && value <= 1000 && value == std::floor(value)))
    throw invalid_argument("{}: {} must be a whole number from 1 to 1000, not {}", problem, name, value);
}

}  // namespace nlmech::problems
