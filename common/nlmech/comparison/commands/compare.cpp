#include "nlmech/comparison/commands/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "nlmech/comparison/commands/runs.hpp"
#include "nlmech/comparison/cost/cost_curves.hpp"
#include "nlmech/comparison/reference/verification.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {
namespace {

using Methods = std::vector<const ivp::MethodInfo*>;

std::string names_of(const Methods& methods) {
  std::string names;
  for (const ivp::MethodInfo* m : methods) names.append(names.empty() ? "" : ",").append(m->name);
  return names;
}

/// Methods by names separated by commas; "all": nlmech methods and the peers in this build.
Methods typed_methods(const std::string& list) {
  Methods methods;
  if (scene::trimmed(list) == "all") {
    for (const std::string& name : built_method_names()) methods.push_back(&any_method(name));
    return methods;
  }
  for (const std::string& piece : scene::split(list, ',')) {
    const std::string name = scene::trimmed(piece);
    const auto* method = about("--methods", [&] { return &any_method(name); });
    if (std::ranges::find(methods, method) != methods.end())
      throw input_error("--methods: {} is given twice", name);
    methods.push_back(method);
  }
  return methods;
}

/// Methods without `--methods`, see choices().
Methods default_methods(const UserProblem& problem, const RunOptions& r) {
  Methods methods;
  // Adds the first of the methods that this build has.
  const auto add = [&methods](std::initializer_list<std::string_view> names) {
    const auto built = [](std::string_view name) { return any_method(name).is_available(); };
    const auto* first = std::ranges::find_if(names, built);
    if (first != names.end()) methods.push_back(&any_method(*first));
  };
  const auto add_all = [&add](std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) add({name});
  };
  if (r.settings.step) {
    add_all({"rk4", "rk6", "radau-coll", "series"});
    if (problem.system.second_order()) add_all({"newmark", "laier"});
    return methods;
  }
  add({"adaptive-collocation"});
  const Features features = probe_problem(choice_request(problem, r)).features;
  if (features.stiffness < stiff_from) {
    add_all({"series", "ode45"});
    if (features.velocity_free) add({"rkn1210"});
    add({"odeint-fehlberg78", "gsl-rk8pd", "arkode-erk"});
    add({"odeint-bulirsch-stoer"});
    add({"cvode-adams", "gsl-msadams"});
  }
  add({"cvode-bdf", "gsl-msbdf"});
  add({"odeint-rosenbrock4", "arkode-dirk", "gsl-bsimp"});
  return methods;
}

/// Rounds to 12 digits, so that 1e-3/100 becomes 1e-5.
double as_typed(double value) { return std::stod(fmt::format("{:.12g}", value)); }

/// Tolerances: "1e-3:1e-12" by decades, or "1e-3,1e-6"; empty if nothing was typed.
std::vector<double> typed_tolerances(const std::string& list) {
  constexpr const char* option = "--tolerances";
  std::vector<double> all;
  if (list.empty()) return all;
  const auto colon = list.find(':');
  if (colon == std::string::npos) {
    for (const std::string& piece : scene::typed_words(option, list))
      all.push_back(scene::typed_positive(option, piece));
    return all;
  }
  const auto refuse = [&](const char* why) {
    return input_error("{} {}: {}", option, quoted_input(list), why);
  };
  if (colon == 0 || colon + 1 == list.size() || list.find(':', colon + 1) != std::string::npos)
    throw refuse("must be a larger and a smaller tolerance, as 1e-3:1e-12");
  const double from = scene::typed_positive(option, list.substr(0, colon));
  const double to = scene::typed_positive(option, list.substr(colon + 1));
  if (from < to) throw refuse("must be the larger tolerance first, as 1e-3:1e-12");
  if (!(from < to * 1e30)) throw refuse("more than thirty decades; give a shorter sweep");
  for (double next = from; next > to * 0.99; next = as_typed(next / 10)) all.push_back(next);
  return all;
}

/// Settings that apply to a method: of a step and tolerances, adaptive methods keep the tolerances.
Choice choice(const ivp::MethodInfo& method, ivp::Settings settings) {
  if (settings.step && (settings.tolerance || settings.absolute_tolerance)) {
    if (method.fixed_step())
      settings.tolerance.reset();
    else
      settings.step.reset();
  }
  if (method.fixed_step()) settings.absolute_tolerance.reset();
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    if (!method.has(*setting)) setting->reset(settings);
  }
  return {&method, settings};
}

/// Checks that every setting applies to some method. @throws InputError naming the option
void check_settings(const std::vector<Choice>& all, const ivp::Settings& settings, const std::string& names) {
  const auto none = [&all](auto has) { return std::ranges::none_of(all, has); };
  if (settings.step && none([](const Choice& c) { return c.settings.step.has_value(); }))
    throw input_error("--step {}: the methods {} have adaptive steps; give a tolerance only", *settings.step,
                      names);
  if (settings.tolerance && none([](const Choice& c) { return c.settings.tolerance.has_value(); }))
    throw input_error("--tolerance {}: none of the methods {} has adaptive steps; give --step only",
                      *settings.tolerance, names);
  if (settings.absolute_tolerance &&
      none([](const Choice& c) { return c.settings.absolute_tolerance.has_value(); }))
    throw input_error("--absolute-tolerance {}: none of the methods {} has adaptive steps",
                      *settings.absolute_tolerance, names);
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    const std::optional<double> value = setting->value(settings);
    if (value && none([setting](const Choice& c) { return c.method->has(*setting); }))
      throw input_error("--{} {}: none of the methods {} has the setting {}", setting->name, *value, names,
                        setting->name);
  }
}

/// Solution and times of a run. A short run is repeated and its first time dropped as a warm-up.
/// @param enough no repetition that would end after so many seconds
std::pair<ivp::Solution, Timing> timed(const std::function<ivp::Solution()>& work, double enough) {
  constexpr int repeats = 5;
  const Stopwatch watch;
  const ivp::Solution first = work();
  std::vector<double> seconds = {first.statistics.seconds};
  while (static_cast<int>(seconds.size()) <= repeats && watch.seconds() + seconds.back() < enough)
    seconds.push_back(work().statistics.seconds);
  if (seconds.size() > 1) seconds.erase(seconds.begin());
  const auto [least, most] = std::ranges::minmax(seconds);
  return {first, {median(seconds), least, most, static_cast<int>(seconds.size())}};
}

/// Output of `compare`: one CSV row per run; as messages the reference and the reasons of failures.
class ComparisonTable {
 public:
  /// @param say receives the messages
  /// @param reference its last time is the end; without a reference rows have no digits, and a message says
  /// so
  ComparisonTable(const std::function<void(const std::string&)>& say, const Reference& reference,
                  const ivp::State& x0)
      : say_(say), reference_(reference), size_(x0.cwiseAbs()) {
    const bool known = reference.status.ok();
    if (known) size_ = size_.cwiseMax(reference.size);
    say_(fmt::format("{}reference: {}", known ? "" : "no digits, because there is no ", reference.text()));
  }
  /// Adds a run.
  void add(const Choice& choice, const ivp::Solution& end, const Timing& time);
  /// Adds a method that does not apply to the problem or the settings, with the status `unsuitable`.
  void add_unsuitable(const Choice& choice, const std::string& why) {
    unsuitable_ += (unsuitable_.empty() ? "" : "; ") + why;
    say(choice, why);
    text_ += fmt::format("{},{},unsuitable,,,,{}\n", choice.method->name, choice.setting(), quoted_cell(why));
  }
  /// The rows and lines. @throws InputError if no method applies
  [[nodiscard]] Comparison take() {
    if (!some_) throw InputError("--methods: none of them suits the problem: " + unsuitable_);
    return {std::move(text_), std::move(lines_)};
  }

 private:
  void say(const Choice& choice, const std::string& sentence) const {
    const std::string method = fmt::format("{}: ", choice.method->name);
    // Most sentences contain the name of the method.
    const bool named = sentence.find(method.substr(0, method.size() - 1)) != std::string::npos;
    say_(fmt::format("{}{}", named ? "" : method, sentence));
  }
  /// Note on an error above most_tolerances; empty otherwise and for runs with a fixed step.
  [[nodiscard]] std::string note(const Choice& choice, const ivp::State& x) const;

  const std::function<void(const std::string&)>& say_;
  const Reference& reference_;
  ivp::State size_;
  bool some_ = false;
  std::string unsuitable_;
  std::vector<scene::MethodLine> lines_;
  std::string text_ = "method,setting,status,digits,seconds,right_hand_sides,note\n";
};

std::string ComparisonTable::note(const Choice& choice, const ivp::State& x) const {
  if (choice.settings.step) return "";
  const Tolerance tolerance = tolerance_of(choice.settings);
  double most = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index last = reference_.states.cols() - 1;
    const double exact = static_cast<double>(reference_.states(i, last));
    const double excess = std::abs(x[i] - exact) - reference_.difference(i, last);
    most = std::max(most, excess / (tolerance.absolute + tolerance.relative * std::abs(exact)));
  }
  if (most <= most_tolerances) return "";
  return quoted_cell(fmt::format("off by {:.3g} tolerances; a tolerance {}", most, tolerance_meaning));
}

void ComparisonTable::add(const Choice& choice, const ivp::Solution& end, const Timing& time) {
  some_ = true;
  std::string digits, note;
  std::optional<double> error;
  if (!end.status.ok()) {
    say(choice, end.status.text());
    note = quoted_cell(end.status.sentence());
  } else if (reference_.status.ok()) {
    error = std::max(relative_error(end.x, reference_.states.rightCols(1), size_), reference_.uncertainty());
    digits = fmt::format("{:.3f}", digits_of(*error));
    note = this->note(choice, end.x);
  }
  const std::string name(choice.method->name), status(to_string(end.status.outcome()));
  text_ += fmt::format("{},{},{},{},{:.4g},{},{}\n", name, choice.setting(), status, digits, time.median,
                       end.statistics.right_hand_sides, note);
  if (lines_.empty() || lines_.back().method != name)
    lines_.push_back(line_of(name, kind_of(*choice.method)));
  lines_.back().attempts.push_back(attempt_of(choice.setting(), status, error, end.statistics, time));
}

}  // namespace

std::string Choice::setting() const {
  std::string text = settings.step
                         ? fmt::format("step {}", *settings.step)
                         : fmt::format("tolerance {}", settings.tolerance.value_or(ivp::default_tolerance));
  if (settings.absolute_tolerance) text += fmt::format(" absolute {}", *settings.absolute_tolerance);
  for (const ivp::SettingInfo* setting : ivp::own_settings) {
    if (const auto value = setting->value(settings)) text += fmt::format(" {} {}", setting->name, *value);
  }
  return text;
}

std::vector<Choice> choices(const TypedOptions& typed, const UserProblem& problem, const RunOptions& r) {
  const Methods methods = typed.method.empty() ? default_methods(problem, r) : typed_methods(typed.method);
  const std::vector<double> tolerances = typed_tolerances(typed.tolerances);
  const std::string names = names_of(methods);
  if (typed.largest_step && std::ranges::all_of(methods, &ivp::MethodInfo::fixed_step))
    throw input_error("--largest-step {}: none of the methods {} has adaptive steps; give --step",
                      *typed.largest_step, names);
  std::vector<Choice> all;
  for (const ivp::MethodInfo* method : methods) {
    if (tolerances.empty() || method->fixed_step()) {
      all.push_back(choice(*method, r.settings));
      continue;
    }
    for (const double tolerance : tolerances) {
      ivp::Settings these = r.settings;
      these.tolerance = tolerance;
      all.push_back(choice(*method, these));
    }
  }
  if (!tolerances.empty() &&
      std::ranges::none_of(all, [](const Choice& c) { return c.settings.tolerance.has_value(); }))
    throw input_error("--tolerances: none of the methods {} has adaptive steps; give --step only", names);
  check_settings(all, r.settings, names);
  return all;
}

namespace {

/// Extended-precision candidates of the problem; none if the argument of a root reaches zero and the solution
/// continues from there, because a Taylor series follows the root to its other branch.
std::vector<Candidate> extended_candidates(const UserProblem& problem, const RunOptions& r,
                                           const WorkLimit& effort) {
  if (problem.domain && !problem.domain->arguments.empty()) {
    bool rests = false;
    constexpr double tolerance = 1e-6;
    const auto estimate = ivp::within_domain(any_method("dop853").with({.tolerance = tolerance}),
                                             problem.domain, {tolerance, tolerance}, &rests);
    static_cast<void>(
        estimate(problem.system, r.x0, r.t0, r.t1, {}, {.steps = 100'000, .seconds = effort.seconds / 4}));
    if (rests) return {};
  }
  return problem.extended(effort);
}

}  // namespace

Comparison comparison(const UserProblem& problem, const RunOptions& r, const std::vector<Choice>& methods,
                      const std::function<void(const std::string&)>& say) {
  const Stopwatch watch;
  const auto left = [&] { return r.limits.seconds - watch.seconds(); };
  constexpr double work = 6;  // about 6 s
  std::optional<scene::ProgressScope> doing("computing a reference");
  WorkLimit effort{
      work, left() / 3, reference_step_limit(r.t0, r.t1, r.limits.largest_step), {}, problem.domain};
  if (r.reached) effort.continues = [&r] { return r.reached(r.t0); };
  const Reference reference = reference_of(extended_candidates(problem, r, effort), problem.system, r.x0,
                                           r.t0, times_to_check(r.t0, r.t1, 64), {1e-13, 1e-30}, effort);
  ivp::Observer observer;
  if (r.reached) observer = [&r](const ivp::Step& step) { return r.reached(step.t1); };
  ComparisonTable table(say, reference, r.x0);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    doing.emplace(fmt::format("running {}", methods[i].method->name));
    const double share = left() / static_cast<double>(methods.size() - i);
    try {
      const ivp::Settings& settings = methods[i].settings;
      const Tolerance tolerance = settings.step ? Tolerance{0, 0} : tolerance_of(settings);
      const auto run = ivp::within_domain(methods[i].method->with(settings), problem.domain,
                                          {tolerance.relative, tolerance.absolute});
      const auto once = [&] {
        return run(problem.system, r.x0, r.t0, r.t1, observer,
                   {r.limits.steps, share, r.limits.largest_step});
      };
      const auto [end, time] = timed(once, std::min(0.5, share / 2));
      table.add(methods[i], end, time);
    } catch (const std::invalid_argument& error) {
      table.add_unsuitable(methods[i], error.what());
    }
  }
  return table.take();
}

}  // namespace nlmech::comparison
