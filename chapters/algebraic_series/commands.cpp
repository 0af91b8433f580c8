#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <string>

#include "chapters/algebraic_series/sections.hpp"
#include "nlmech/comparison/commands/user_problem.hpp"
#include "nlmech/scene/program/options.hpp"

namespace nlmech::chapters::algebraic_series {
namespace {

struct PoincareOptions {
  int sections = 0;
  std::string initial;
  std::vector<std::string> set;
  ivp::Limits limits{.seconds = 60};
};

void declare(scene::Options& options, PoincareOptions& typed) {
  options
      .add("--sections", typed.sections, "number of sections, from 1 to 1e7; the first is the initial state")
      .range(1, 1e7)
      .required();
  options.add("--initial", typed.initial, "initial state x,v (default -0.5,0)");
  options.add("--set", typed.set, "name=value of stiffness or epsilon; separate several by blanks");
  options.limit(typed.limits.seconds);
}

std::string section_rows(const PoincareOptions& typed) {
  const comparison::UserProblem oscillator =
      comparison::library_problem("oscillator")(comparison::settings_of(typed.set));
  const ivp::State x0 = oscillator.initial_state(typed.initial);
  const auto all = sections(oscillator.system, {x0[0], x0[1]}, oscillator.t0, typed.sections, typed.limits);
  std::string text = "section,x,v\n";
  for (std::size_t k = 0; k < all.size(); ++k)
    fmt::format_to(std::back_inserter(text), "{},{:.17g},{:.17g}\n", k, all[k][0], all[k][1]);
  return text;
}

}  // namespace

void commands(scene::Commands& all) {
  all.add("poincare", "Print the states of the oscillator at t = pi, 2 pi, ... as CSV: section,x,v", declare,
          section_rows);
}

}  // namespace nlmech::chapters::algebraic_series
