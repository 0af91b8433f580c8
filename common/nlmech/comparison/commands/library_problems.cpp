#include "nlmech/comparison/commands/library_problems.hpp"

#include <string>

#include "nlmech/comparison/commands/typed_problem.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::comparison {

OwnProblems library_problems() {
  OwnProblems all;
  for (const problems::ProblemText& known : problems::problem_texts())
    all.emplace_back([&known] {
      return typed_problem({std::string(known.name) + ".ode", std::string(known.text)}, {}, known.name);
    });
  return all;
}

}  // namespace nlmech::comparison
