/// @file
/// The problems that a user can name on the command line, with parameters and initial state of his own.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "nlmech/problems/blow_up.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/impact_duffing.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/van_der_pol.hpp"

namespace nlmech::chapters {

/// One of the problems, to be visited.
using AnyProblem = std::variant<problems::Duffing, problems::ImpactDuffing, problems::ThreeMassChain,
                                problems::VanDerPol, problems::BlowUp>;

/// The problem of that name with the publication's parameters.
/// @throws InputError naming `--problem`, the name, and the known ones
[[nodiscard]] AnyProblem problem_by_name(const std::string& name);

/// Applies "name=value". @throws InputError naming `--set`, the text, and the known parameters
void set_parameter(AnyProblem& problem, const std::string& assignment);

/// The initial state: the publication's for an empty text, else numbers with commas between.
/// @throws InputError naming `--initial`, and how many numbers of which name there must be
[[nodiscard]] std::vector<double> initial_state(const AnyProblem& problem, const std::string& text);

/// Where the publication begins.
[[nodiscard]] double initial_time(const AnyProblem& problem);

/// "x1", ..., "v1", ...
[[nodiscard]] std::vector<std::string> state_names(const AnyProblem& problem);

/// For the help: each problem with its parameters and their values.
[[nodiscard]] std::string describe_problems();

}  // namespace nlmech::chapters
