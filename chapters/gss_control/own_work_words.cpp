#include "chapters/gss_control/own_work_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chapters/gss_control/plots.hpp"
#include "nlmech/scene/csv.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> all;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    all.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return all;
}

}  // namespace

double typed_number(const char* option, const std::string& text) {
  double value = 0;
  if (!scene::parse_number(text, value))
    throw InputError(fmt::format("{} {}: not a finite number", option, text));
  return value;
}

double typed_positive(const char* option, const std::string& text) {
  const double value = typed_number(option, text);
  if (!(value > 0)) throw InputError(fmt::format("{} {}: must be positive", option, text));
  return value;
}

int typed_count(const char* option, const std::string& text, int most) {
  const double value = typed_number(option, text);
  if (!(value >= 1 && value <= most) || value != std::floor(value))
    throw InputError(fmt::format("{} {}: must be a whole number from 1 to {}", option, text, most));
  return static_cast<int>(value);
}

std::vector<std::string> typed_words(const char* option, const std::string& text) {
  std::vector<std::string> all = split(text, ',');
  for (const std::string& word : all) {
    double value = 0;
    if (!scene::parse_number(word, value))
      throw InputError(fmt::format("{} {}: '{}' is not a finite number", option, text, word));
  }
  return all;
}

std::vector<double> typed_frequencies(const char* option, const std::string& text) {
  if (text.find(':') == std::string::npos) {
    std::vector<double> all;
    for (const std::string& word : typed_words(option, text)) {
      const double omega = typed_number(option, word);
      if (omega == 0)
        throw InputError(fmt::format("{} {}: 0 is the double pole of a free body", option, text));
      all.push_back(omega);
    }
    return all;
  }
  const std::vector<std::string> parts = split(text, ':');
  if (parts.size() != 3)
    throw InputError(fmt::format("{} {}: LO:HI:N has three parts, not {}", option, text, parts.size()));
  const double low = typed_positive(option, parts[0]), high = typed_positive(option, parts[1]);
  const int n = typed_count(option, parts[2], 10'000'000);
  if (n < 2 || !(high > low))
    throw InputError(fmt::format("{} {}: LO:HI:N needs LO below HI, and N of 2 at least", option, text));
  return logarithmic(low, high, n);
}

std::vector<Place> typed_places(const char* option, const std::string& text,
                                const spacecraft::Parameters& craft) {
  std::vector<Place> all;
  if (text.empty()) return all;
  for (const std::string& word : typed_words(option, text)) {
    const double x = typed_number(option, word);
    if (x < 0 || x > craft.length)
      throw InputError(fmt::format("{} {}: {} lies off the appendage, which reaches from 0 to {:.17g} ft",
                                   option, text, word, craft.length));
    all.push_back({word, x});
  }
  return all;
}

spacecraft::ClosedLoop typed_loop(const spacecraft::Parameters& craft, const std::string& gains) {
  const std::vector<std::string> words = typed_words("--gains", gains);
  if (words.size() != 3)
    throw InputError(fmt::format("--gains {}: {} numbers where k1,k2,k3 are needed", gains, words.size()));
  try {
    return {craft,
            {typed_number("--gains", words[0]), typed_number("--gains", words[1]),
             typed_number("--gains", words[2])}};
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--gains {}: {}", gains, error.what()));
  }
}

std::vector<double> typed_times(const std::string& until, const std::string& every) {
  const double end = typed_positive("--until", until);
  std::vector<double> times = {0};
  if (!every.empty()) {
    const double step = typed_positive("--every", every);
    if (end / step > 1e7) throw InputError(fmt::format("--every {}: more than 10 million rows", every));
    // A last step shorter than a millionth of DT is rounding of T/DT, and no row of its own.
    for (int i = 1; i * step < end - 1e-6 * step; ++i) times.push_back(i * step);
  }
  times.push_back(end);
  return times;
}

}  // namespace nlmech::chapters
