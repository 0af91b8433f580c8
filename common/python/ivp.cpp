#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

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

/// Header, values, one row for each column, and event of each row as printed.
using Columns = std::tuple<std::string, Rows<>, std::vector<std::string>>;

/// Rows of a run, `t,x,x',...` and perhaps `event`, by columns.
Columns columns_of(const std::string& rows, bool has_events) {
  if (rows.empty()) return {"t", Rows<>(1, 0), {}};
  std::string header = rows.substr(0, rows.find('\n'));
  const auto columns = std::ranges::count(header, ',') + (has_events ? 0 : 1);
  std::vector<double> values;
  std::vector<std::string> events;
  const char* at = rows.data() + header.size() + 1;
  const char* const end = rows.data() + rows.size();
  while (at < end) {
    for (auto k = columns; k > 0; --k) at = std::from_chars(at, end, values.emplace_back()).ptr + 1;
    if (!has_events) continue;
    const char* const line = std::find(at, end, '\n');
    events.emplace_back(at, line);
    at = line + 1;
  }
  const Eigen::Map<const Eigen::MatrixXd> table(values.data(), columns, std::ssize(values) / columns);
  return {std::move(header), table, std::move(events)};
}

/// Columns of a run, also of a failed one, status, method, whether it is verified, remarks.
using Result = std::tuple<Columns, StatusText, std::string, std::optional<bool>, std::vector<std::string>>;

Result result_of(const comparison::Trajectory& run, const Status& status, const RunOptions& options,
                 std::vector<std::string> remarks) {
  remarks.insert(remarks.end(), {run.remark, run.small});
  std::erase(remarks, "");
  std::optional<bool> verified;
  if (options.verify && status.ok()) verified = !run.is_open;
  return {columns_of(run.rows, !options.events.empty()), text_of(status), std::string(run.method), verified,
          std::move(remarks)};
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

Result integrate(const TypedOptions& typed, const std::vector<double>& at, const py::object& progress) {
  const UserProblem problem = problem_of(typed)({});
  RunOptions options = options_of(typed, problem, problem.initial_state(typed.initial), at);
  const ivp::MethodInfo& method = method_of(typed, problem, options);
  comparison::Trajectory run;
  try {
    unlocked(progress, [&](Job& job) {
      watch(options, job);
      run = typed.method.empty() ? default_trajectory(problem, options, method)
                                 : trajectory(problem, options, method);
    });
  } catch (const comparison::RunFailure& failure) {
    run.rows = failure.rows();
    run.method = method.name;
    return result_of(run, failure.status(), options, {});
  }
  return result_of(run, {}, options, remarks_on(problem, options));
}

/// One run for each row of @p states.
std::vector<Result> integrate_all(const TypedOptions& typed, const Rows<>& states,
                                  const std::vector<double>& at, const py::object& progress) {
  const auto problem = std::make_shared<const UserProblem>(problem_of(typed)({}));
  if (states.cols() != problem->system.size())
    throw invalid_argument("initial: {} columns for {} components", states.cols(), problem->system.size());
  std::vector<comparison::EnsembleMember> members;
  for (Eigen::Index i = 0; i < states.rows(); ++i) {
    if (i == 0 || !members.front().options.events.empty()) {  // which may change the state at the start
      members.push_back({problem, options_of(typed, *problem, states.row(i), at)});
    } else {
      members.push_back(members.front());
      members.back().options.x0 = states.row(i);
    }
  }
  std::vector<Result> results;
  if (members.empty()) return results;
  const ivp::MethodInfo& method = method_of(typed, *problem, members.front().options);
  unlocked(progress, [&](Job& job) {
    if (typed.limit) {
      using namespace std::chrono;
      const auto deadline = steady_clock::now() + duration_cast<steady_clock::duration>(
                                                      duration<double>(std::min(*typed.limit, 1e9)));
      for (auto& member : members) member.options.deadline = deadline;
    }
    constexpr std::size_t portion = 256;  // occupies all lanes and threads
    for (std::size_t i = 0; i < members.size(); i = results.size()) {
      const auto some = std::span(members).subspan(i, std::min(portion, members.size() - i));
      for (auto& end : trajectories(some, method, typed.method.empty(), typed.threads.value_or(0)))
        results.push_back(result_of(end.trajectory, end.status, members[results.size()].options, {}));
      if (!job.reached(static_cast<double>(results.size()) / static_cast<double>(members.size()))) break;
    }
  });
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

/// CSV.
std::string compare(const TypedOptions& typed, const py::object& progress) {
  auto [problem, options] = without_events(typed);
  const std::vector<comparison::Choice> methods = choices(typed, problem, options);
  std::string rows;
  unlocked(progress, [&rows, &problem = problem, &options = options, &methods](Job& job) {
    watch(options, job);
    rows = comparison::comparison(problem, options, methods, [](const std::string& /*message*/) {}).rows;
  });
  return rows;
}

/// CSV.
std::string choose(const TypedOptions& typed) {
  const auto [problem, options] = without_events(typed);
  if (options.t0 == options.t1)
    throw input_error("--until {}: is the start time; give another end", options.t1);
  comparison::ChoiceRequest request = choice_request(problem, options);
  if (const auto absolute = options.settings.absolute_tolerance)
    request.absolute = *absolute * std::pow(10, typed.digits);
  return choice_rows(comparison::choose(request, typed.digits, examine(request)));
}

}  // namespace

void add_ivp(py::module_& module) {
  py::class_<ivp::Settings>(module, "Settings")
      .def_readwrite("tolerance", &ivp::Settings::tolerance)
      .def_readwrite("absolute_tolerance", &ivp::Settings::absolute_tolerance)
      .def_readwrite("nodes", &ivp::Settings::nodes)
      .def_readwrite("shape", &ivp::Settings::shape)
      .def_readwrite("order", &ivp::Settings::order)
      .def_readwrite("points", &ivp::Settings::points);
  py::class_<TypedOptions>(module, "Options", "Options of integrate, compare and choose.")
      .def(py::init<>())
      .def_readwrite("problem", &TypedOptions::problem)
      .def_readwrite("equation", &TypedOptions::equation)
      .def_readwrite("file", &TypedOptions::file)
      .def_readwrite("initial", &TypedOptions::initial)
      .def_readwrite("method", &TypedOptions::method)
      .def_readwrite("tolerances", &TypedOptions::tolerances)
      .def_readwrite("until", &TypedOptions::until)
      .def_readwrite("start", &TypedOptions::from)
      .def_readwrite("every", &TypedOptions::every)
      .def_readwrite("step", &TypedOptions::step)
      .def_readwrite("settings", &TypedOptions::settings)
      .def_readwrite("limit", &TypedOptions::limit)
      .def_readwrite("largest_step", &TypedOptions::largest_step)
      .def_readwrite("set", &TypedOptions::set)
      .def_readwrite("events", &TypedOptions::events)
      .def_readwrite("changes", &TypedOptions::changes)
      .def_readwrite("section", &TypedOptions::section)
      .def_readwrite("columns", &TypedOptions::columns)
      .def_readwrite("threads", &TypedOptions::threads)
      .def_readwrite("no_verify", &TypedOptions::no_verify)
      .def_readwrite("digits", &TypedOptions::digits);
  module.def("integrate", &integrate);
  module.def("integrate_all", &integrate_all);
  module.def("compare", &compare);
  module.def("choose", &choose, Unlocked());
}

}  // namespace nlmech::python
