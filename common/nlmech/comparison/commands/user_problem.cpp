#include "nlmech/comparison/commands/user_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>

#include "nlmech/ivp/sensitivities.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/program/problem.hpp"
#include "nlmech/program/syntax.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::comparison {
namespace {

ivp::State state_of(const std::vector<double>& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// Is the text a single number, finite or not?
bool is_numeric(const std::string& text) {
  char* end = nullptr;
  static_cast<void>(std::strtod(text.c_str(), &end));
  return end != text.c_str() && scene::trimmed(end).empty();
}

program::Table read_table(const std::filesystem::path& path) {
  const std::string name = echoed_path(path.string());
  if (!std::filesystem::is_regular_file(path)) throw input_error("table {}: there is no such file", name);
  constexpr std::size_t most_rows = 100'000;
  program::Table table;
  bool has_header = false;
  for (const scene::CsvRecord& record : scene::parse_csv(scene::read_whole(path), name)) {
    const auto refuse = [&](const std::string& why) {
      return input_error("table {}: line {}: {}", name, record.line, why);
    };
    if (record.cells.front().starts_with('#')) continue;
    if (record.cells.size() != 2)
      throw refuse(
          fmt::format("a row must have two cells, time and value; this one has {}", record.cells.size()));
    double t = 0, value = 0;
    const bool is_time = scene::parse_number(record.cells[0], t),
               is_value = scene::parse_number(record.cells[1], value);
    if (!is_time && !is_value && !has_header && table.times.empty()) {
      has_header = true;
      continue;
    }
    for (const auto& [good, cell] : {std::pair(is_time, record.cells[0]), {is_value, record.cells[1]}}) {
      if (!good) throw refuse(fmt::format("'{}' is {}", quoted_input(cell), scene::number_fault(cell)));
    }
    if (!table.times.empty() && !(t > table.times.back()))
      throw refuse(fmt::format("the time {} does not come after {}", t, table.times.back()));
    if (table.times.size() == most_rows) throw refuse(fmt::format("more than {} rows", most_rows));
    table.times.push_back(t);
    table.values.push_back(value);
  }
  if (table.times.size() < 2) throw input_error("table {}: fewer than two rows", name);
  return table;
}

UserProblem problem_of_text(const problems::ProblemText& known, const program::Settings& settings) {
  return typed_problem({fmt::format("{}.ode", known.name), std::string(known.text)}, settings, known.name);
}

}  // namespace

ivp::State UserProblem::initial_state(const std::string& typed) const {
  if (typed.empty() || typed.find('=') != std::string::npos)
    return state_of(program::Equations(text).initial_state("--initial", typed));
  const std::vector<double> x = scene::typed_numbers("--initial", typed);
  const std::vector<std::string> components = text.component_names();
  if (x.size() != components.size())
    throw input_error("--initial {}: {} numbers for the {} components {} of {}: {}", quoted_input(typed),
                      x.size(), components.size(), fmt::join(components, ","), name, equation);
  return state_of(text.with_initial_sensitivities(x));
}

Columns UserProblem::columns(const std::vector<std::string>& typed) const {
  program::Equations names = text;
  std::vector<program::Equations::Column> all;
  for (const std::string& list : typed) names.read_columns("--columns", list, all);
  Columns made;
  std::vector<program::NodeId> nodes;
  for (const program::Equations::Column& column : all) {
    made.names.push_back(column.name);
    nodes.push_back(column.node);
  }
  made.values = program::Program(names.graph(), nodes);
  if (system.switches() > 0)
    made.switches = std::make_shared<const program::Switches>(names.graph(), names.slopes(), nodes);
  return made;
}

double UserProblem::number(const std::string& option, const std::string& typed) const {
  if (is_numeric(typed)) return scene::typed_number(option, typed);
  return program::Equations(text).number(option, typed);
}

StateFunction UserProblem::expression(const std::string& option, const std::string& typed) const {
  program::Equations names = text;
  const program::NodeId node = names.expression(option, typed);
  const auto program =
      std::make_shared<const program::Program>(names.graph(), std::vector<program::NodeId>{node});
  return [program](double t, const ivp::State& x) {
    double value = 0;
    program->run(t, x, 0, 1, [&value](int, double v) { value = v; });
    return value;
  };
}

ivp::Event UserProblem::event(const std::string& option, const std::string& typed) const {
  program::Equations names = text;
  const program::NodeId node = names.expression(option, typed);
  return ivp::event_of(names.graph(), node, names.slopes());
}

namespace {

UserProblem problem_of(const program::Equations& equations, std::string_view name) {
  const program::Problem problem(equations);
  const auto extended = [problem](const WorkLimit& effort) {
    // A Taylor series in extended precision does not detect switches, and may round their known times to
    // other values than double precision.
    return problem.switches() > 0 || problem.has_rounded_times()
               ? std::vector<Candidate>()
               : taylor_candidates(problem, problem.size(), effort);
  };
  return {.name = std::string(name),
          .equation = equations.summary(),
          .parameters = equations.parameters(),
          .state_names = equations.state_names(),
          .t0 = equations.initial_time().value_or(0),
          .t1 = equations.final_time(),
          .system = ivp::System(problem),
          .extended = extended,
          .domain = std::make_shared<const ivp::Domain>(equations),
          .text = equations};
}

}  // namespace

UserProblem typed_problem(const program::SourceText& source, const program::Settings& settings,
                          std::string_view name, const program::TableReader& read_table) {
  return problem_of(program::Equations(source, settings, read_table), name);
}

UserProblem with_sensitivities(const UserProblem& problem, const std::string& typed, bool controlled) {
  std::vector<std::string> names;
  for (const std::string& piece : scene::split(typed, ',')) {
    const std::string name = scene::trimmed(piece);
    if (name == "all")
      names.insert(names.end(), problem.state_names.begin(), problem.state_names.end());
    else
      names.push_back(name);
  }
  const auto extended = [&](double scale) {
    return problem.text.with_sensitivities("--sensitivities", names, scale);
  };
  UserProblem made = problem_of(extended(1), problem.name);
  made.event_lines = problem.event_lines;
  if (!controlled) made.scaled = ivp::System(program::Problem(extended(ivp::unseen_scale)));
  return made;
}

program::TableReader table_reader(const std::filesystem::path& folder) {
  struct Known {
    std::mutex mutex;  // runs of many rows are made in threads
    std::map<std::string, program::Table> tables;
  };
  return [folder, known = std::make_shared<Known>()](const std::string& file) {
    const std::scoped_lock lock(known->mutex);
    const auto entry = known->tables.find(file);
    if (entry != known->tables.end()) return entry->second;
    return known->tables[file] = read_table(folder / file);
  };
}

std::string read_equations(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::file_status what = fs::status(name, none);
  if (fs::is_character_file(what) || fs::is_block_file(what))
    throw input_error("--file {}: is a device; give a file, or - for standard input", echoed_path(name));
  if (fs::is_regular_file(what) && fs::file_size(name, none) > program::most_bytes)
    throw input_error("--file {}: more than {} bytes", echoed_path(name), program::most_bytes);
  return scene::read_whole(name);
}

program::Settings settings_of(const std::vector<std::string>& assignments) {
  program::Settings values;
  std::map<std::string, std::string> seen;
  for (const std::string& assignment : assignments) {
    const auto refuse = [&](std::string_view why) {
      return input_error("--set {}: {}", quoted_input(assignment), why);
    };
    const auto sign = assignment.find('=');
    if (sign == std::string::npos) throw refuse("must be name=value");
    const std::string name = assignment.substr(0, sign);
    const auto [before, is_new] = seen.emplace(name, assignment);
    if (!is_new)
      throw refuse(
          fmt::format("{} is set twice, also by {}", quoted_input(name), quoted_input(before->second)));
    if (!scene::parse_number(assignment.substr(sign + 1), values[name]))
      throw refuse("the value is not a number");
  }
  return values;
}

MakeProblem library_problem(const std::string& name) {
  std::vector<std::string_view> known;
  for (const problems::ProblemText& text : problems::problem_texts()) {
    if (text.name == name)
      return [&text](const program::Settings& set) { return problem_of_text(text, set); };
    known.push_back(text.name);
  }
  throw input_error("--problem {}: there is no such problem; choose one of {}", name, fmt::join(known, ", "));
}

std::string describe_problems() {
  std::string text = "Problems, and their parameters for --set:\n";
  for (const problems::ProblemText& known : problems::problem_texts()) {
    const UserProblem problem = problem_of_text(known, {});
    std::vector<std::string> settings;
    for (const auto& [name, value] : problem.parameters)
      settings.push_back(fmt::format("{}={:.6g}", name, value));
    constexpr std::size_t most = 300;
    text += fmt::format("  {}: {}\n    {}; state {}\n", problem.name, quoted_input(problem.equation, most),
                        fmt::join(settings, " "), fmt::join(problem.state_names, ","));
  }
  return text;
}

}  // namespace nlmech::comparison
