#include "chapters/integrators/problem_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "nlmech/program/problem.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::integrators {
namespace {

using Rows = std::vector<scene::CsvRecord>;

[[noreturn]] void throw_mismatch(const std::string& what) {
  throw Failure(
      Status::failure(Outcome::outside_validity,
                      fmt::format("problem set: {} does not fit tables/reference; run problem_set_references "
                                  "again",
                                  what)));
}

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

/// Rows of a file of tables/reference without the headings; each must have @p cells cells.
Rows rows_of(const std::string& file, std::size_t cells) {
  Rows rows = scene::parse_csv(scene::read_whole(scene::data_folder() / "tables" / "reference" / file), file);
  if (std::ranges::any_of(rows, [cells](const auto& row) { return row.cells.size() != cells; }))
    throw_mismatch(file);
  rows.erase(rows.begin());  // headings
  return rows;
}

/// Adds reference and condition numbers to a problem with a solution.
/// @param states one row per component, ordered by time
void complete(SetProblem& p, const Rows& states, const Rows& conditions) {
  const auto size = static_cast<std::size_t>(p.x0.size());
  std::vector<long double> values;
  for (const scene::CsvRecord& row : states) {
    if (row.cells[0] != p.name) continue;
    const std::size_t k = values.size() / size;
    if (k >= p.times.size() || number(row.cells[1]) != p.times[k]) throw_mismatch(p.name);
    values.push_back(std::strtold(row.cells[3].c_str(), nullptr));
  }
  const auto known = std::ranges::find(conditions, p.name, [](const auto& row) { return row.cells[0]; });
  if (values.size() != p.times.size() * size || known == conditions.end()) throw_mismatch(p.name);
  for (std::size_t k = 0; k < p.times.size(); ++k)
    p.reference.emplace_back(
        Eigen::Map<const Vector<long double, Eigen::Dynamic>>(values.data() + k * size, p.x0.size()));
  p.condition = number(known->cells[2]);
  p.tolerance_condition = number(known->cells[3]);
  p.flagged.resize(p.x0.size());
  std::istringstream scales(known->cells[6]);
  for (double& scale : p.flagged) scales >> scale;
  if (!scales) throw_mismatch(p.name);
}

SetProblem made(std::string_view name, Kind kind, double absolute, std::int64_t length, ivp::System system,
                const ivp::State& x0, double t0, double t1) {
  SetProblem p{std::string(name), kind, absolute, length, std::move(system), x0, t0, t1, {}};
  for (int k = 0; k < judged_times; ++k) p.times.push_back(judged_time(t0, t1, k));
  return p;
}

}  // namespace

std::vector<SetProblem> problem_set() {
  const Rows states = rows_of("problem_set.csv", 4), conditions = rows_of("problem_set_conditions.csv", 7);
  std::vector<SetProblem> all;
  for (const Case& c : all_cases()) {
    auto p = made(c.name, c.kind, c.absolute, c.length, ivp::System(c.problem), c.problem.initial_state(),
                  c.problem.initial_time, c.end);
    if (c.by != By::nothing) complete(p, states, conditions);
    all.emplace_back(std::move(p));
  }
  const program::Equations equations(program::SourceText(std::string(Friction::name), Friction::equation));
  auto p = made(Friction::name, Kind::extreme, 1, 1, ivp::System(program::Problem(equations)),
                {Friction::position, 0}, 0, Friction::end);
  complete(p, states, conditions);
  all.emplace_back(std::move(p));
  return all;
}

std::vector<std::string> problem_names(bool solved) {
  std::vector<std::string> names;
  for (const Case& c : all_cases()) {
    if (c.by != By::nothing || !solved) names.emplace_back(c.name);
  }
  names.emplace_back(Friction::name);
  return names;
}

}  // namespace nlmech::chapters::integrators
