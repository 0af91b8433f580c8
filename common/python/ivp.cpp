#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "common/python/module.hpp"
#include "nlmech/comparison/commands/compare.hpp"
#include "nlmech/comparison/commands/remarks.hpp"
#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::python {
namespace {

using comparison::RunOptions;
using comparison::TypedOptions;
using comparison::UserProblem;

/// Rows of a run, `t,x,x',...` and perhaps `event`, as numbers: the names of the columns, their values, one
/// row for each column, and the names of the events, one for each time.
py::tuple columns_of(std::string_view rows, bool has_events) {
  const auto take = [](std::string_view& text, char end) {
    const std::string_view cell = text.substr(0, text.find(end));
    text.remove_prefix(std::min(cell.size() + 1, text.size()));
    return cell;
  };
  std::string_view header = take(rows, '\n');
  std::vector<std::string> names;
  while (!header.empty()) names.emplace_back(take(header, ','));
  if (has_events) names.pop_back();
  const auto count = static_cast<py::ssize_t>(std::ranges::count(rows, '\n'));
  py::array_t<double> table({static_cast<py::ssize_t>(names.size()), count});
  auto value = table.mutable_unchecked<2>();
  std::vector<std::string> events;
  for (py::ssize_t k = 0; k < count; ++k) {
    std::string_view line = take(rows, '\n');
    for (py::ssize_t i = 0; i < table.shape(0); ++i) {
      const std::string_view cell = take(line, ',');
      value(i, k) = std::numeric_limits<double>::quiet_NaN();
      std::from_chars(cell.data(), cell.data() + cell.size(), value(i, k));
    }
    if (line.starts_with('"')) {  // a quoted name, with "" for a quote
      std::string name;
      for (std::size_t c = 1; c + 1 < line.size(); ++c) {
        name += line[c];
        if (line[c] == '"') ++c;
      }
      events.push_back(name);
    } else if (has_events) {
      events.emplace_back(line);
    }
  }
  return py::make_tuple(names, table, events);
}

py::tuple result_of(const comparison::Trajectory& run, const Status& status, const RunOptions& options,
                    const std::vector<std::string>& remarks) {
  std::vector<std::string> said = remarks;
  said.insert(said.end(), {run.remark, run.small});
  std::erase(said, "");
  py::object verified = py::none();
  if (options.verify && status.ok()) verified = py::bool_(!run.is_open);
  py::object columns = py::none();  // of a failed one of many runs
  if (!run.rows.empty()) columns = columns_of(run.rows, !options.events.empty());
  return py::make_tuple(columns, std::string(to_string(status.outcome())), status.sentence(),
                        std::string(run.method), verified, said);
}

/// Checked options with rows at the times @p at.
RunOptions options_of(const TypedOptions& typed, const UserProblem& problem, ivp::State x0,
                      const std::vector<double>& at) {
  RunOptions options = run_options(typed, problem, std::move(x0));
  if (at.empty()) return options;
  options.at = at;
  std::ranges::sort(options.at);
  options.at.erase(std::unique(options.at.begin(), options.at.end()), options.at.end());
  options.check_rows();
  return options;
}

/// Lets @p job end the run and see how far it is.
void watch(RunOptions& options, Job& job) {
  options.reached = [&job, t0 = options.t0, span = options.t1 - options.t0](double t) {
    return job.reached((t - t0) / span);
  };
}

py::tuple integrate(const TypedOptions& typed, const std::vector<double>& at, const py::object& progress) {
  const UserProblem problem = problem_of(typed)({});
  RunOptions options = options_of(typed, problem, problem.initial_state(typed.initial), at);
  const ivp::MethodInfo& method = method_of(typed, problem, options);
  try {
    const comparison::Trajectory run = unlocked(progress, [&](Job& job) {
      watch(options, job);
      return typed.method.empty() ? default_trajectory(problem, options, method)
                                  : trajectory(problem, options, method);
    });
    return result_of(run, {}, options, remarks_on(problem, options));
  } catch (const comparison::RunFailure& failure) {
    comparison::Trajectory part;
    part.rows = failure.rows();
    part.method = method.name;
    raise(failure.status(), result_of(part, failure.status(), options, {}));
  }
}

/// One run for each row of @p states.
py::list integrate_all(const TypedOptions& typed, const Doubles& states, const std::vector<double>& at,
                       const py::object& progress) {
  const auto problem = std::make_shared<const UserProblem>(problem_of(typed)({}));
  const auto size = static_cast<py::ssize_t>(problem->state_names.size());
  if (states.shape(1) != size)
    throw invalid_argument("initial: {} columns for {} components", states.shape(1), size);
  std::vector<comparison::EnsembleMember> members;
  for (py::ssize_t i = 0; i < states.shape(0); ++i) {
    const ivp::State x0 = Eigen::Map<const Eigen::VectorXd>(states.data(i, 0), size);
    if (members.empty() || !members.front().options.events.empty()) {
      members.push_back({problem, options_of(typed, *problem, x0, at)});
      continue;
    }
    members.push_back(members.front());
    members.back().options.x0 = x0;
  }
  if (members.empty()) return py::list();
  const ivp::MethodInfo& method = method_of(typed, *problem, members.front().options);
  constexpr std::size_t portion = 256;  // occupies all lanes and threads
  const auto ends = unlocked(progress, [&](Job& job) {
    if (typed.limit) {
      using namespace std::chrono;
      const auto deadline = steady_clock::now() + duration_cast<steady_clock::duration>(
                                                      duration<double>(std::min(*typed.limit, 1e9)));
      for (auto& member : members) member.options.deadline = deadline;
    }
    std::vector<comparison::EnsembleResult> all;
    const std::span<comparison::EnsembleMember> left(members);
    for (std::size_t i = 0; i < left.size(); i += portion) {
      const auto some = left.subspan(i, std::min(portion, left.size() - i));
      auto part = trajectories(some, method, typed.method.empty(), typed.threads.value_or(0));
      std::ranges::move(part, std::back_inserter(all));
      if (!job.reached(static_cast<double>(i + some.size()) / static_cast<double>(left.size()))) break;
    }
    return all;
  });
  py::list results;
  for (std::size_t i = 0; i < ends.size(); ++i)
    results.append(result_of(ends[i].trajectory, ends[i].status, members[i].options, {}));
  return results;
}

/// The problem and its options, for commands that do not support events.
std::pair<UserProblem, RunOptions> without_events(const TypedOptions& typed) {
  UserProblem problem = problem_of(typed)({});
  if (!problem.event_lines.empty())
    throw input_error("when {}: events are for integrate; remove them", problem.event_lines.front().event);
  RunOptions options = run_options(typed, problem, problem.initial_state(typed.initial));
  return {std::move(problem), std::move(options)};
}

/// CSV and messages.
py::tuple compare(const TypedOptions& typed, const py::object& progress) {
  auto [problem, options] = without_events(typed);
  const std::vector<comparison::Choice> methods = choices(typed, problem, options);
  std::vector<std::string> messages;
  const auto say = [&messages](const std::string& message) { messages.push_back(message); };
  const auto work = [&problem = problem, &options = options, &methods, &say](Job& job) {
    watch(options, job);
    return comparison::comparison(problem, options, methods, say).rows;
  };
  const std::string rows = unlocked(progress, work);
  return py::make_tuple(rows, messages);
}

/// CSV and a remark.
py::tuple choose(const TypedOptions& typed) {
  const auto [problem, options] = without_events(typed);
  if (options.t0 == options.t1)
    throw input_error("--until {}: is the start time; give another end", options.t1);
  comparison::ChoiceRequest request = choice_request(problem, options);
  if (const auto absolute = options.settings.absolute_tolerance)
    request.absolute = *absolute * std::pow(10, typed.digits);
  const auto chosen = unlocked([&] { return comparison::choose(request, typed.digits, examine(request)); });
  return py::make_tuple(choice_rows(chosen), choice_remark(chosen));
}

}  // namespace

void add_ivp(py::module_& module) {
  py::class_<TypedOptions> options(module, "Options", "Options of integrate, compare and choose.");
  options.def(py::init<>());
  const auto add = [&options](const char* name, auto member) { options.def_readwrite(name, member); };
  const auto setting = [&options](const char* name, auto member) {
    options.def_property(
        name, [member](const TypedOptions& o) { return o.settings.*member; },
        [member](TypedOptions& o,
                 const std::decay_t<decltype(std::declval<ivp::Settings>().*member)>& value) {
          o.settings.*member = value;
        });
  };
  add("problem", &TypedOptions::problem);
  add("equation", &TypedOptions::equation);
  add("file", &TypedOptions::file);
  add("initial", &TypedOptions::initial);
  add("method", &TypedOptions::method);
  add("tolerances", &TypedOptions::tolerances);
  add("until", &TypedOptions::until);
  add("start", &TypedOptions::from);
  add("every", &TypedOptions::every);
  add("step", &TypedOptions::step);
  add("limit", &TypedOptions::limit);
  add("largest_step", &TypedOptions::largest_step);
  add("set", &TypedOptions::set);
  add("events", &TypedOptions::events);
  add("changes", &TypedOptions::changes);
  add("section", &TypedOptions::section);
  add("columns", &TypedOptions::columns);
  add("threads", &TypedOptions::threads);
  add("no_verify", &TypedOptions::no_verify);
  add("digits", &TypedOptions::digits);
  setting("tolerance", &ivp::Settings::tolerance);
  setting("absolute_tolerance", &ivp::Settings::absolute_tolerance);
  setting("nodes", &ivp::Settings::nodes);
  setting("shape", &ivp::Settings::shape);
  setting("order", &ivp::Settings::order);
  setting("points", &ivp::Settings::points);
  module.def("integrate", &integrate);
  module.def("integrate_all", &integrate_all);
  module.def("compare", &compare);
  module.def("choose", &choose);
}

}  // namespace nlmech::python
