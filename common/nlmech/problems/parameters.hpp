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

/// A parameter of a problem: its name in lower case with hyphens, and where it stands in the problem.
template <class Problem, class Real = double>
struct Parameter {
  std::string_view name;  ///< as it is given on a command line
  Real Problem::*member;  ///< place of the value
};

/// @throws std::invalid_argument: @p problem has no parameter @p name; the text lists @p known ones
[[noreturn]] void throw_unknown_parameter(std::string_view problem, std::string_view name,
                                          std::span<const std::string_view> known);

/// The names of the parameters of a problem, in the order of its list.
template <class Problem>
[[nodiscard]] std::vector<std::string_view> parameter_names() {
  std::vector<std::string_view> names;
  for (const auto& parameter : Problem::parameters) names.push_back(parameter.name);
  return names;
}

/// The value of the parameter @p name.
/// @throws std::invalid_argument listing the known names, if there is none of that name
template <class Problem>
[[nodiscard]] auto& parameter(Problem& problem, std::string_view name) {
  const auto& all = std::remove_const_t<Problem>::parameters;
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const auto& known) { return known.name == name; });
  if (found == all.end()) {
    throw_unknown_parameter(Problem::name, name, parameter_names<std::remove_const_t<Problem>>());
  }
  return problem.*(found->member);
}

/// Sets the parameter @p name to @p value. Any number is accepted: whether the equation makes sense with it
/// is for its user to judge.
/// @throws std::invalid_argument listing the known names, if there is none of that name
template <class Problem>
void set_parameter(Problem& problem, std::string_view name, double value) {
  parameter(problem, name) = value;
}

}  // namespace nlmech::problems
