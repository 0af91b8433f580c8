/// @file
/// A problem given as text, and the time derivatives of expressions along its solutions.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/texts.hpp"
#include "nlmech/program/equations.hpp"
#include "nlmech/program/program.hpp"

namespace nlmech::problems::tests {

/// Equations whose conserved quantities are tested.
struct Text {
  /// A problem of the library.
  explicit Text(std::string_view name, const program::Settings& settings = {})
      : Text({std::string(name), std::string(text_of(name))}, settings) {}
  /// A problem of the test.
  explicit Text(const program::SourceText& source, const program::Settings& settings = {})
      : equations(source, settings) {}

  static std::string_view text_of(std::string_view name) {
    const auto all = problem_texts();
    return std::ranges::find(all, name, &ProblemText::name)->text;
  }
  /// Time derivatives of the expressions @p of of the graph at the state @p x and the time @p t.
  [[nodiscard]] std::vector<double> rates(const std::vector<program::NodeId>& of,
                                          const std::vector<double>& x, double t = 0) const {
    program::Graph graph = equations.graph();
    const program::Program program(graph, program::rates(graph, of, equations.slopes()));
    std::vector<double> values(of.size());
    program.run(t, x.data(), 0, of.size(),
                [&](int i, double value) { values[static_cast<std::size_t>(i)] = value; });
    return values;
  }
  /// Time derivative of an expression at the state @p x and the time @p t.
  [[nodiscard]] double rate(const std::string& expression, const std::vector<double>& x, double t = 0) {
    const program::NodeId node = equations.expression("expression", expression);
    return rates({node}, x, t)[0];
  }
  /// Largest absolute rate of the declared conserved quantities.
  [[nodiscard]] double drift(const std::vector<double>& x) const {
    double most = 0;
    for (const double rate : rates(equations.conserved(), x)) most = std::max(most, std::abs(rate));
    return most;
  }

  program::Equations equations;
};

/// Eq. 4.25 of Elgohary 2015 as printed: three-dof with c1 x1 instead of c1 x1', and c2 (x2' - x2') = 0
/// instead of c2 (x1' - x2') in the second equation.
[[nodiscard]] inline program::SourceText three_dof_text_as_printed() {
  std::string text(Text::text_of("three-dof"));
  const auto replace = [&text](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  replace("e1 = k1 x1 + c1 x1'", "e1 = k1 x1 + c1 x1");
  replace("+ e2 - e3", "+ e2 - c2 (x1' - x2') - e3");
  return {"as printed", text};
}
/// The equation as printed, as a problem.
[[nodiscard]] inline program::Problem three_dof_as_printed() {
  return program::Problem(program::Equations(three_dof_text_as_printed()));
}

}  // namespace nlmech::problems::tests
