/// @file
/// The parameters of a problem by name, as a command line needs them.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace nlmech::problems {

/// For which values of a parameter the equation has a meaning.
enum class Range {
  any,           ///< all finite ones
  not_negative,  ///< a duration, a rate of a reaction
  positive,      ///< a mass, a length that divides
  share,         ///< at least 0 and below 1: an eccentricity, a part of a whole
  count          ///< a whole number from 1 to 1000: how many of a kind
};

/// A parameter of a problem: its name in lower case with hyphens, and where it stands in the problem.
template <class Problem, class Real = double>
struct Parameter {
  std::string_view name;     ///< as it is given on a command line
  Real Problem::*member;     ///< place of the value
  Range range = Range::any;  ///< of the value
};

/// @throws std::invalid_argument: @p problem has no parameter @p name; the text lists @p known ones
[[noreturn]] void throw_unknown_parameter(std::string_view problem, std::string_view name,
                                          std::span<const std::string_view> known);

/// @throws std::invalid_argument naming problem, parameter, value and range, if @p value lies outside @p
/// range
void check_range(std::string_view problem, std::string_view name, Range range, double value);

/// The names of the parameters of a problem, in the order of its list.
template <class Problem>
[[nodiscard]] std::vector<std::string_view> parameter_names() {
  std::vector<std::string_view> names;
  for (const auto& parameter : Problem::parameters) names.push_back(parameter.name);
  return names;
}

/// The entry of the parameter @p name.
/// @throws std::invalid_argument listing the known names, if there is none of that name
template <class Problem>
[[nodiscard]] const auto& parameter_entry(std::string_view name) {
  const auto& all = Problem::parameters;
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const auto& known) { return known.name == name; });
  if (found == all.end()) throw_unknown_parameter(Problem::name, name, parameter_names<Problem>());
  return *found;
}

/// The value of the parameter @p name.
/// @throws std::invalid_argument listing the known names, if there is none of that name
template <class Problem>
[[nodiscard]] auto& parameter(Problem& problem, std::string_view name) {
  return problem.*(parameter_entry<std::remove_const_t<Problem>>(name).member);
}

/// Sets the parameter @p name to @p value.
/// @throws std::invalid_argument listing the known names, if there is none of that name; naming the value, if
/// the equation has no meaning with it (a mass that is not positive)
template <class Problem>
void set_parameter(Problem& problem, std::string_view name, double value) {
  const auto& entry = parameter_entry<Problem>(name);
  check_range(Problem::name, name, entry.range, value);
  problem.*(entry.member) = value;
}

}  // namespace nlmech::problems
