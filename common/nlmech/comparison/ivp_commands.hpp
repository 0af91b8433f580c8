/// @file
/// The commands by which every chapter on initial value problems takes a user's numbers: `integrate` and
/// `compare`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "nlmech/comparison/own_problem.hpp"

namespace nlmech::comparison {

/// `integrate`: a problem from begin to end as rows of CSV.
/// @param app the program's; the command lives as long
/// @param problems that it offers
/// @param only_method if not empty, the method that all runs take; else there is an option `--method`
void add_integrate_command(CLI::App& app, const OwnProblems& problems, const std::string& only_method = {});

/// How a chapter lets a user choose among its own methods.
struct MethodOption {
  std::string option;              ///< "--operator"
  std::vector<std::string> names;  ///< of methods; the first is taken where the option is not given
  std::string help;                ///< what the option means
};

/// `integrate` with an option of that name in place of `--method`. It refuses other methods than the listed
/// ones.
void add_integrate_command(CLI::App& app, const OwnProblems& problems, const MethodOption& choice);

/// `compare`: methods side by side. @param program its name, for what is said on standard error
void add_compare_command(CLI::App& app, const OwnProblems& problems, const std::string& program);

}  // namespace nlmech::comparison
