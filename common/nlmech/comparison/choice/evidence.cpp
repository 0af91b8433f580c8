#include "nlmech/comparison/choice/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

[[noreturn]] void misfit(const std::string& file, std::size_t line) {
  throw Failure(failed_with(Outcome::outside_validity,
                            "tables/reference/{}: line {} is not what method_costs writes; run it again",
                            file, line));
}

/// The rows of a table without its headings; calls @p read with the texts before its last columns, which are
/// numbers, and with these.
template <class Read>
void read_rows(const std::string& file, std::size_t texts, std::size_t numbers, Read read) {
  const auto path = scene::data_folder() / "tables" / "reference" / file;
  bool headings = true;
  for (const scene::CsvRecord& record : scene::parse_csv(scene::read_whole(path), file)) {
    if (std::exchange(headings, false)) continue;
    if (record.cells.size() != texts + numbers) misfit(file, record.line);
    std::vector<double> values(numbers);
    for (std::size_t i = 0; i < numbers; ++i) {
      if (!scene::parse_number(record.cells[texts + i], values[i])) misfit(file, record.line);
    }
    if (!read(record.cells, values)) misfit(file, record.line);
  }
}

std::optional<Form> form_of(const std::string& text) {
  for (const Form form : {Form::first_order, Form::accelerations, Form::conservative}) {
    if (text == to_string(form)) return form;
  }
  return {};
}

/// Straight in the logarithms of all but the digits.
Measured between(const Measured& a, const Measured& b, double digits) {
  const double share = (digits - a.digits) / (b.digits - a.digits);
  const auto mean = [share](double x, double y) {
    return std::max(x, 1e-300) * std::pow(std::max(y, 1e-300) / std::max(x, 1e-300), share);
  };
  return {mean(a.tolerance, b.tolerance), digits, mean(a.steps, b.steps),
          mean(a.right_hand_sides, b.right_hand_sides), mean(a.cost, b.cost)};
}

}  // namespace

std::optional<Measured> SolvedProblem::measured(const std::string& method, double digits) const {
  const auto found = runs.find(method);
  if (found == runs.end()) return {};
  std::optional<Measured> best;
  const auto take = [&best](const Measured& m) {
    if (!best || m.cost < best->cost) best = m;
  };
  const std::vector<Measured>& all = found->second;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].digits < digits) continue;
    take(all[i]);
    if (i > 0 && all[i - 1].digits < digits) take(between(all[i - 1], all[i], digits));
  }
  return best;
}

Evidence Evidence::without(const std::string& name) const {
  // "kepler-0.7" and "kepler-0.99" are two; "duffing" and "duffing-10000" are one on another way.
  const auto same = [&name](const SolvedProblem& p) {
    return p.name == name || p.name == name + "-10000" || p.name + "-10000" == name;
  };
  Evidence rest;
  std::ranges::copy_if(problems, std::back_inserter(rest.problems),
                       [&](const SolvedProblem& p) { return !same(p); });
  return rest;
}

std::vector<std::string> Evidence::methods() const {
  std::set<std::string> names;
  for (const SolvedProblem& p : problems) {
    for (const auto& [name, runs] : p.runs) names.insert(name);
  }
  return {names.begin(), names.end()};
}

Evidence read_evidence() {
  Evidence all;
  read_rows("method_problems.csv", 2, 7, [&](const auto& texts, const auto& numbers) {
    const std::optional<Form> form = form_of(texts[1]);
    if (!form) return false;
    all.problems.push_back({texts[0],
                            {.components = static_cast<int>(numbers[0]),
                             .form = *form,
                             .switches = numbers[1] != 0,
                             .operations = static_cast<int>(numbers[2]),
                             .stiffness = numbers[3],
                             .decay = numbers[4],
                             .variation = numbers[5]},
                            numbers[6]});
    return true;
  });
  read_rows("method_costs.csv", 2, 5, [&](const auto& texts, const auto& numbers) {
    const auto problem = std::ranges::find(all.problems, texts[0], &SolvedProblem::name);
    if (problem == all.problems.end()) return false;
    problem->runs[texts[1]].push_back({numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]});
    return true;
  });
  return all;
}

}  // namespace nlmech::comparison
