#include "nlmech/program/functions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>
#include <vector>

namespace nlmech::program {
namespace {

/// Names of functions in other programs, and the nlmech name if there is one.
constexpr std::array<std::pair<std::string_view, std::string_view>, 51> elsewhere = {{
    {"arcsin", "asin"},   {"arccos", "acos"},   {"arctan", "atan"},  {"arctg", "atan"},
    {"arctan2", "atan2"}, {"arcsinh", "asinh"}, {"arsinh", "asinh"}, {"arccosh", "acosh"},
    {"arcosh", "acosh"},  {"arctanh", "atanh"}, {"artanh", "atanh"}, {"tg", "tan"},
    {"ctg", "cot"},       {"cotan", "cot"},     {"cosec", "csc"},    {"sh", "sinh"},
    {"ch", "cosh"},       {"th", "tanh"},       {"lg", "log10"},     {"ld", "log2"},
    {"fabs", "abs"},      {"sgn", "sign"},      {"signum", "sign"},  {"ceiling", "ceil"},
    {"fmod", "mod"},      {"fract", "frac"},    {"piecewise", "if"}, {"where", "if"},
    {"ifelse", "if"},     {"fmin", "min"},      {"fmax", "max"},     {"minimum", "min"},
    {"maximum", "max"},   {"pow", "^"},         {"power", "^"},      {"cbrt", ""},
    {"hypot", ""},        {"log1p", ""},        {"expm1", ""},       {"exp2", ""},
    {"erfc", ""},         {"sinc", ""},         {"gamma", ""},       {"lgamma", ""},
    {"besselj", ""},      {"bessely", ""},      {"airy", ""},        {"trunc", ""},
    {"rand", ""},         {"random", ""},       {"delta", ""},
}};

/// Levenshtein distance: number of letters to change, add or omit.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({changed, row[j] + 1, row[j + 1] + 1}));
    }
  }
  return row.back();
}

}  // namespace

std::string function_hint(std::string_view name) {
  std::string lower(name);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (function_by_name(lower)) return lower + " is";
  const auto* const known =
      std::ranges::find(elsewhere, lower, [](const auto& entry) { return entry.first; });
  if (known != elsewhere.end() && !known->second.empty()) return fmt::format("{} is", known->second);
  if (known == elsewhere.end()) {
    const auto* const near = std::ranges::find_if(functions, [&](const FunctionInfo& info) {
      return std::min(info.name.size(), lower.size()) > 2 && distance(info.name, lower) == 1;
    });
    return near == functions.end() ? "" : fmt::format("{} is", near->name);
  }
  std::vector<std::string_view> all;
  for (const FunctionInfo& info : functions) all.push_back(info.name);
  return fmt::format("functions are {}", fmt::join(all, " "));
}

}  // namespace nlmech::program
