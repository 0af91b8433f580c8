#include "chapters/rbf_ivp/own_problem.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string_view>

#include "nlmech/scene/csv.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

using problems::BlowUp;
using problems::Duffing;
using problems::ImpactDuffing;
using problems::ThreeMassChain;
using problems::VanDerPol;

const std::array<AnyProblem, 5>& all_problems() {
  static const std::array<AnyProblem, 5> all = {Duffing{}, ImpactDuffing{}, ThreeMassChain{}, VanDerPol{},
                                                BlowUp{}};
  return all;
}

std::string_view name_of(const AnyProblem& problem) {
  return std::visit([](const auto& p) { return std::string_view(p.name); }, problem);
}

}  // namespace

AnyProblem problem_by_name(const std::string& name) {
  std::vector<std::string_view> known;
  for (const AnyProblem& problem : all_problems()) {
    if (name_of(problem) == name) return problem;
    known.push_back(name_of(problem));
  }
  throw InputError(
      fmt::format("--problem {}: there is no such problem; there is {}", name, fmt::join(known, ", ")));
}

void set_parameter(AnyProblem& problem, const std::string& assignment) {
  const auto refuse = [&](std::string_view why) {
    return InputError(fmt::format("--set {}: {}", assignment, why));
  };
  const auto sign = assignment.find('=');
  if (sign == std::string::npos) throw refuse("say name=value");
  double value = 0;
  if (!scene::parse_number(assignment.substr(sign + 1), value)) throw refuse("the value is not a number");
  try {
    std::visit([&](auto& p) { problems::set_parameter(p, assignment.substr(0, sign), value); }, problem);
  } catch (const std::invalid_argument& error) {
    throw refuse(error.what());
  }
}

std::vector<double> initial_state(const AnyProblem& problem, const std::string& text) {
  if (text.empty()) {
    return std::visit(
        [](const auto& p) {
          const auto x = p.initial_state();
          return std::vector<double>(x.begin(), x.end());
        },
        problem);
  }
  const std::vector<std::string> names = state_names(problem);
  std::vector<double> x;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    const std::string piece = text.substr(begin, comma - begin);
    double value = 0;
    if (!scene::parse_number(piece, value))
      throw InputError(fmt::format("--initial {}: '{}' is not a finite number", text, piece));
    x.push_back(value);
    begin = comma + 1;
  }
  if (x.size() != names.size())
    throw InputError(fmt::format("--initial {}: {} numbers for the {} components {} of {}", text, x.size(),
                                 names.size(), fmt::join(names, ","), name_of(problem)));
  return x;
}

double initial_time(const AnyProblem& problem) {
  return std::visit([](const auto& p) { return double(p.initial_time); }, problem);
}

std::vector<std::string> state_names(const AnyProblem& problem) {
  return std::visit([](const auto& p) { return problems::state_names<std::decay_t<decltype(p)>>(); },
                    problem);
}

std::string describe_problems() {
  std::string text = "Problems, and their parameters for --set:\n";
  for (const AnyProblem& problem : all_problems()) {
    std::vector<std::string> settings;
    std::visit(
        [&](const auto& p) {
          for (const auto& parameter : p.parameters)
            settings.push_back(fmt::format("{}={:.6g}", parameter.name, p.*(parameter.member)));
        },
        problem);
    text += fmt::format("  {}: {}; state {}\n", name_of(problem), fmt::join(settings, " "),
                        fmt::join(state_names(problem), ","));
  }
  return text;
}

}  // namespace nlmech::chapters
