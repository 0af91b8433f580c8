#include "nlmech/scene/program/typed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::scene {

double typed_number(std::string_view option, const std::string& text) {
  double value = 0;
  if (!parse_number(text, value))
    throw input_error("{} {}: {}", option, quoted_input(text), number_fault(text));
  return value;
}

double typed_positive(std::string_view option, const std::string& text) {
  const double value = typed_number(option, text);
  if (!(value > 0)) throw input_error("{} {}: must be positive", option, quoted_input(text));
  return value;
}

int typed_whole(std::string_view option, const std::string& text, int least, int most) {
  const double value = typed_number(option, text);
  if (!(value >= least && value <= most && value == std::floor(value)))
    throw input_error("{} {}: must be a whole number from {} to {}", option, quoted_input(text), least, most);
  return static_cast<int>(value);
}

std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of(" \t"));
  text.erase(text.find_last_not_of(" \t") + 1);
  return text;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> all;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    all.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return all;
}

std::vector<std::string> typed_words(std::string_view option, const std::string& text) {
  std::vector<std::string> all = split(text, ',');
  for (const std::string& word : all) {
    double value = 0;
    if (!parse_number(word, value))
      throw input_error("{} {}: '{}' is {}", option, quoted_input(text), quoted_input(word),
                        number_fault(word));
  }
  return all;
}

std::vector<double> typed_numbers(std::string_view option, const std::string& text) {
  std::vector<double> all;
  for (const std::string& word : typed_words(option, text)) all.push_back(typed_number(option, word));
  return all;
}

}  // namespace nlmech::scene
