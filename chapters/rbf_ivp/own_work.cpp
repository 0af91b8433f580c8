#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

#include "chapters/rbf_ivp/any_method.hpp"
#include "chapters/rbf_ivp/chapter.hpp"
#include "chapters/rbf_ivp/own_problem.hpp"
#include "chapters/rbf_ivp/own_reference.hpp"
#include "nlmech/scene/csv.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters {
namespace {

/// What was typed.
struct Words {
  std::string problem, initial, until, from, method, step, tolerance, nodes, shape, every, limit = "60";
  std::vector<std::string> set;
};

double number(const char* option, const std::string& text) {
  double value = 0;
  if (!scene::parse_number(text, value))
    throw InputError(fmt::format("{} {}: not a finite number", option, text));
  return value;
}

std::optional<double> positive(const char* option, const std::string& text) {
  if (text.empty()) return {};
  const double value = number(option, text);
  if (!(value > 0)) throw InputError(fmt::format("{} {}: must be positive", option, text));
  return value;
}

std::optional<int> node_count(const std::string& text) {
  if (text.empty()) return {};
  const double value = number("--nodes", text);
  if (value != std::floor(value) || value < 2 || value > 200)
    throw InputError(fmt::format("--nodes {}: must be a whole number from 2 to 200", text));
  return static_cast<int>(value);
}

/// What is meant.
struct Request {
  AnyProblem problem;
  std::vector<double> x0;
  double t0 = 0, t1 = 0;
  ivp::Settings settings;
  std::optional<double> every;
  ivp::Limits limits;
};

Request understand(const Words& words) {
  Request r;
  r.problem = problem_by_name(words.problem);
  for (const std::string& assignment : words.set) set_parameter(r.problem, assignment);
  r.x0 = initial_state(r.problem, words.initial);
  r.t0 = words.from.empty() ? initial_time(r.problem) : number("--from", words.from);
  r.t1 = number("--until", words.until);
  if (!words.step.empty() && !words.tolerance.empty())
    throw InputError(fmt::format("--step {} --tolerance {}: give a step or a tolerance, not both", words.step,
                                 words.tolerance));
  r.settings = {.step = positive("--step", words.step),
                .tolerance = positive("--tolerance", words.tolerance),
                .nodes = node_count(words.nodes),
                .shape = positive("--shape", words.shape)};
  r.every = positive("--every", words.every);
  if (r.every && std::abs(r.t1 - r.t0) / *r.every > 1e7)
    throw InputError(fmt::format("--every {}: more than 10 million rows", words.every));
  r.limits.seconds = *positive("--limit", words.limit);
  return r;
}

/// Complaints about a method, under the name of the option that named it.
template <class Work>
auto about(const char* option, Work work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

/// Rows of a trajectory as CSV.
class Rows {
 public:
  Rows(const Request& request, const std::vector<std::string>& names) : request_(request) {
    text_ = fmt::format("t,{}\n", fmt::join(names, ","));
  }

  template <class State>
  void add(double t, const State& x) {
    auto out = std::back_inserter(text_);
    fmt::format_to(out, "{:.17g}", t);
    for (const double value : x) fmt::format_to(out, ",{:.17g}", value);
    text_ += '\n';
  }

  /// The asked times within a step, by its dense output.
  template <int n>
  void add_within(const ivp::Step<n>& step) {
    ivp::State<n> x;
    for (double t = next(); is_inner(t) && !is_after(t, step.t1); t = next()) {
      if (t == step.t1) {
        x = step.x1;
      } else {
        step.dense.at(t, x);
      }
      add(t, x);
      ++count_;
    }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] double next() const {
    return request_.t0 +
           std::copysign(static_cast<double>(count_) * *request_.every, request_.t1 - request_.t0);
  }
  [[nodiscard]] bool is_after(double a, double b) const { return request_.t1 > request_.t0 ? a > b : a < b; }
  // The end has its own row; rounding of k DT makes no second one.
  [[nodiscard]] bool is_inner(double t) const {
    return is_after(request_.t1, t) && std::abs(request_.t1 - t) > 1e-9 * *request_.every;
  }

  const Request& request_;
  std::string text_;
  std::int64_t count_ = 1;
};

template <class Problem>
std::string trajectory(const Problem& problem, const Request& r, const AnyMethod& method) {
  constexpr int n = Problem::dimension;
  const auto run = about("--method", [&] { return any_integrator<n>(method, r.settings); });
  const ivp::State<n> x0 = Eigen::Map<const ivp::State<n>>(r.x0.data());
  Rows rows(r, problems::state_names<Problem>());
  rows.add(r.t0, x0);
  ivp::Observer<n> observer;
  if (r.every) {
    observer = [&rows](const ivp::Step<n>& step) {
      rows.add_within(step);
      return true;
    };
  }
  const ivp::Solution<n> end =
      about("--method", [&] { return run(ivp::System<n>(problem), x0, r.t0, r.t1, observer, r.limits); });
  if (!end.status.ok()) throw Failure(end.status);
  rows.add(end.t, end.x);
  return rows.text();
}

void integrate(const Words& words) {
  const Request r = understand(words);
  const AnyMethod method = about("--method", [&] { return any_method(words.method); });
  scene::print_result(std::visit([&](const auto& p) { return trajectory(p, r, method); }, r.problem));
}

/// The methods of a list, each with those of the settings that it has.
struct Choice {
  AnyMethod method;
  ivp::Settings settings;

  [[nodiscard]] std::string setting() const {
    std::string text =
        settings.step ? fmt::format("step {:.6g}", *settings.step)
                      : fmt::format("tolerance {:.6g}", settings.tolerance.value_or(ivp::default_tolerance));
    if (settings.nodes) text += fmt::format(" nodes {}", *settings.nodes);
    if (settings.shape) text += fmt::format(" shape {:.6g}", *settings.shape);
    return text;
  }
};

std::vector<Choice> choices(const std::string& list, const ivp::Settings& settings) {
  std::vector<Choice> all;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    const AnyMethod method =
        about("--methods", [&] { return any_method(list.substr(begin, comma - begin)); });
    all.push_back({method, settings});
    if (!method.has_nodes) all.back().settings.nodes.reset();
    if (!method.has_shape) all.back().settings.shape.reset();
    begin = comma + 1;
  }
  const auto some = [&all](auto has) { return std::any_of(all.begin(), all.end(), has); };
  if (settings.nodes && !some([](const Choice& c) { return c.method.has_nodes; }))
    throw InputError(fmt::format("--nodes {}: none of the methods {} has nodes", *settings.nodes, list));
  if (settings.shape && !some([](const Choice& c) { return c.method.has_shape; }))
    throw InputError(fmt::format("--shape {}: none of the methods {} has a shape", *settings.shape, list));
  return all;
}

/// One run, repeated if it is short: median time without the first, which warms up.
template <int n>
std::pair<ivp::Solution<n>, double> timed(const std::function<ivp::Solution<n>()>& work) {
  constexpr int repeats = 5;
  constexpr double enough = 0.5;  // seconds
  const Stopwatch watch;
  const ivp::Solution<n> first = work();
  std::vector<double> seconds = {first.statistics.seconds};
  while (static_cast<int>(seconds.size()) <= repeats && watch.seconds() < enough)
    seconds.push_back(work().statistics.seconds);
  if (seconds.size() > 1) seconds.erase(seconds.begin());
  return {first, median(seconds)};
}

template <class Problem>
std::string comparison(const Problem& problem, const Request& r, const std::vector<Choice>& all) {
  constexpr int n = Problem::dimension;
  std::vector<ivp::NamedIntegrator<n>> integrators;
  for (const Choice& c : all) {
    integrators.push_back(about("--methods", [&] { return any_integrator<n>(c.method, c.settings); }));
  }
  const ivp::System<n> system(problem);
  const ivp::State<n> x0 = Eigen::Map<const ivp::State<n>>(r.x0.data());
  const ReferenceEnd<n> truth = reference_end(problem, x0, r.t0, r.t1);
  if (!truth.status.ok())
    fmt::print(stderr, "rbf_ivp: no digits, because there is no reference: {}\n", truth.status.text());
  std::string text = "method,setting,status,digits,seconds,rhs_evaluations\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::function<ivp::Solution<n>()> work = [&] {
      return integrators[i](system, x0, r.t0, r.t1, {}, r.limits);
    };
    const auto result = about("--methods", [&] { return timed<n>(work); });
    const ivp::Solution<n>& end = result.first;
    std::string digits;
    if (!end.status.ok()) {
      fmt::print(stderr, "rbf_ivp: {}: {}\n", all[i].method.name, end.status.text());
    } else if (truth.status.ok()) {
      digits = fmt::format("{:.3f}", digits_of(relative_error<n>(end.x, truth.x, truth.size)));
    }
    text +=
        fmt::format("{},{},{},{},{:.4g},{}\n", all[i].method.name, all[i].setting(),
                    to_string(end.status.outcome()), digits, result.second, end.statistics.right_hand_sides);
  }
  return text;
}

void compare(const Words& words) {
  const Request r = understand(words);
  const std::vector<Choice> all = choices(words.method, r.settings);
  scene::print_result(std::visit([&](const auto& p) { return comparison(p, r, all); }, r.problem));
}

void add_common(CLI::App& command, Words& words) {
  command.add_option("--problem", words.problem, "which equation: see below")->required();
  command.add_option("--set", words.set, "name=value of a parameter; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--initial", words.initial, "initial state: positions, then velocities, as in 1,-0.5");
  command.add_option("--from", words.from, "time at which it begins; 0 if not given");
  command.add_option("--until", words.until, "time at which it ends; earlier runs backwards")->required();
  command.add_option("--step", words.step, "length of a step, for methods of fixed step");
  command.add_option("--tolerance", words.tolerance,
                     "relative and absolute; 1e-9 without it. Methods of fixed step halve their step until "
                     "two runs agree");
  command.add_option("--nodes", words.nodes, "nodes a step of a collocation, 2 to 200");
  command.add_option("--shape", words.shape, "c of rbf-coll, 1/time; (N - 1)/(4 step) without it");
  command.add_option("--limit", words.limit, "wall time in seconds, at most, for a method")
      ->capture_default_str();
  command.footer(fmt::format("{}Methods: {}", describe_problems(), fmt::join(any_method_names(), " ")));
}

}  // namespace

void rbf_ivp_work(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callbacks

  CLI::App* one = app.add_subcommand("integrate", "A problem from begin to end: t,x1,...,v1,... as CSV");
  add_common(*one, *words);
  one->add_option("--method", words->method, "one of the methods below")->required();
  one->add_option("--every", words->every,
                  "rows at this distance in time; without it the first and the last");
  one->callback([words] { integrate(*words); });

  CLI::App* several = app.add_subcommand(
      "compare", "Methods side by side: method,setting,status,digits,seconds,rhs_evaluations as CSV");
  add_common(*several, *words);
  several->add_option("--methods", words->method, "methods with commas between: rbf-coll,ode45,cvode-adams")
      ->required();
  several->callback([words] { compare(*words); });
}

}  // namespace nlmech::chapters
