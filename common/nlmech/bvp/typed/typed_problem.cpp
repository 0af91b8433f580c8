#include "nlmech/bvp/typed/typed_problem.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "nlmech/program/dual.hpp"
#include "nlmech/program/switches.hpp"
#include "nlmech/program/time_features.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using program::Program;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t index_of(int i) { return static_cast<std::size_t>(i); }

/// Whether the program depends on the state: a NaN state then yields NaN.
bool depends_on_state(const Program& program, double t, int n) {
  const auto plain = [&](double x) {
    double value = 0;
    program.run(t, VectorXd(VectorXd::Constant(n, x)), 0, 1, [&](int, double v) { value = v; });
    return value;
  };
  return std::isnan(plain(std::numeric_limits<double>::quiet_NaN())) && !std::isnan(plain(0.5));
}

double value_of(const Program& program, double t, const VectorXd& x) {
  double value = 0;
  program.run(t, x, 0, 1, [&](int, double v) { value = v; });
  return value;
}

/// The point of @p points next to @p t: equal but for rounding. The number of points if there is none.
std::size_t point_at(const std::vector<double>& points, double t) {
  const double least = 1e-13 * std::max(std::abs(points.front()), std::abs(points.back()));
  const auto same = [&](double point) { return std::abs(point - t) <= least; };
  return static_cast<std::size_t>(std::ranges::find_if(points, same) - points.begin());
}

}  // namespace

TypedProblem::TypedProblem(program::Equations equations, const std::vector<ConditionText>& conditions,
                           const Interval& interval, const std::string& guess)
    : equations_(std::move(equations)),
      conditions_(equations_, conditions, unknown_end(interval.until)),
      is_infinite_(interval.until == "inf") {
  if (equations_.final_time() || !equations_.lower_bounds().empty() || !equations_.conserved().empty())
    throw InputError(
        "--equation: end, bounds and conserved quantities are for initial value problems; give the end by "
        "--until");
  const std::size_t given = index_of(conditions_.count()), needed = names().size();
  if (given != needed)
    throw input_error("--conditions: {} conditions, but {} are needed, one for each of {}", given, needed,
                      quoted_input(fmt::format("{}", fmt::join(names(), ", ")), 200));
  divide_components();
  read_guess(guess);
  set_points(interval);
  place_values();
  find_singular_ends();
  map_singular_ends();
}

std::string TypedProblem::unknown_end(const std::string& until) const {
  const bool is_unknown = std::ranges::find(names(), until) != names().end();
  return is_unknown || until == "inf" ? until : std::string();
}

void TypedProblem::divide_components() {
  const std::vector<int>& constants = conditions_.constants();
  const bool all_are_constant = constants.size() == names().size() && conditions_.integrands().empty();
  std::vector<program::NodeId> slopes;
  for (int i = 0; i < equations_.size(); ++i) {
    const bool is_parameter = !all_are_constant && std::ranges::find(constants, i) != constants.end();
    std::vector<int>& list = is_parameter ? parameters_ : states_;
    components_.push_back({is_parameter, static_cast<int>(list.size())});
    list.push_back(i);
    if (!is_parameter) slopes.push_back(equations_.slopes()[index_of(i)]);
  }
  slopes.insert(slopes.end(), conditions_.integrands().begin(), conditions_.integrands().end());
  slopes_ = Program(equations_.graph(), slopes);
}

std::vector<program::NodeId> TypedProblem::integrated() const {
  std::vector<program::NodeId> all = equations_.slopes();
  all.insert(all.end(), conditions_.integrands().begin(), conditions_.integrands().end());
  return all;
}

void TypedProblem::set_points(const Interval& interval) {
  std::vector<double> times;
  for (const Conditions::Value& value : conditions_.values()) {
    if (value.time != infinity) times.push_back(value.time);
  }
  std::ranges::sort(times);
  const auto number = [&](const char* option, const std::string& text, double otherwise) {
    return text.empty() ? otherwise : equations_.number(option, text);
  };
  const bool has_times = !times.empty();
  const program::Switches switches(equations_.graph(), integrated());
  double from = number("--from", interval.from, has_times ? std::min(times.front(), times.back()) : 0);
  const std::string end = unknown_end(interval.until);
  double until = number("--until", end.empty() ? interval.until : "", has_times ? times.back() : from + 1);
  if (!end.empty() && end != "inf") {
    const auto component = std::ranges::find(names(), end) - names().begin();
    const Component& found = components_[index_of(static_cast<int>(component))];
    if (!found.is_parameter) throw input_error("--until {}: is no unknown constant", quoted_input(end));
    end_ = found.index;
    const auto& guessed = guess_[static_cast<std::size_t>(component)];
    const double last = std::max(from, until);
    until = guessed ? value_of(*guessed, from, VectorXd::Zero(equations_.size())) : last + 1;
    if (!(until > last))
      throw input_error("--guess {} = {}: must be later than {}, the last known point", end, until, last);
  } else if (end == "inf") {
    until = std::max(from, until);
    constexpr double horizon = 1e4;  // jumps up to it are points
    const std::vector<double> jumps = switches.times(from, from + horizon);
    if (!jumps.empty() && jumps.size() <= most_jumps) until = std::max(until, jumps.back());
    until += 8;
  } else if (!(until > from)) {
    throw input_error("--until {}: must be later than {}, the start{}", until, from,
                      interval.until.empty() ? "; the conditions have no later time" : "");
  }
  points_ = {from, until};
  const std::vector<double> jumps = switches.times(from, until);
  if (jumps.size() <= most_jumps) times.insert(times.end(), jumps.begin(), jumps.end());
  for (const double t : times) {
    if (point_at(points_, t) < points_.size()) continue;
    if (!(t > from && t < until))
      throw input_error("--conditions: the time {} is outside the interval from {} to {}", t, from, until);
    points_.insert(std::ranges::upper_bound(points_, t), t);
  }
}

void TypedProblem::place_values() {
  for (const Conditions::Value& value : conditions_.values()) {
    const std::size_t point = value.time == infinity ? points_.size() - 1 : point_at(points_, value.time);
    const bool is_last = point + 1 == points_.size();
    if (is_last && value.time != infinity && (is_infinite_ || end_ >= 0))
      throw input_error("--conditions: the time {} is at the guess of the end; give another --guess of it",
                        value.time);
    const auto column = static_cast<Index>(2 * point) - (is_last ? 1 : 0);
    values_.push_back({Program(equations_.graph(), {value.what}), point, column});
  }
}

// An end is singular if f is not finite there for a state for which it is finite inside.
void TypedProblem::find_singular_ends() {
  const VectorXd x = VectorXd::LinSpaced(equations_.size(), 0.57, 0.91);
  const auto is_finite = [&](double t) {
    bool finite = true;
    slopes_.run(t, x, 0, slopes_.outputs(), [&](int, double value) { finite &= std::isfinite(value); });
    differentiate(slopes_, t, x, false, [&](int, int, double value) { finite &= std::isfinite(value); });
    return finite;
  };
  const double from = points_.front(), until = points_.back();
  if (!is_finite(from + 0.37 * (until - from))) return;
  maps_start_ = !is_finite(from);
  maps_end_ = end_ < 0 && !is_infinite_ && !is_finite(until);
  is_singular_ = maps_start_ || maps_end_;
}

void TypedProblem::map_singular_ends() {
  from_ = points_.front();
  until_ = is_infinite_ ? from_ + 1 : points_.back();
  if (end_ >= 0) maps_start_ = false;
  if (!maps_start_ && !maps_end_) return;
  for (double& point : points_) point = place(point, {});
}

std::vector<double> TypedProblem::mesh() const {
  const double until = end_ < 0 ? time(points_.back(), {}) : points_.back();
  std::vector<double> mesh =
      program::TimeFeatures(equations_.graph(), integrated()).between(points_.front(), until);
  if (mesh.empty()) return mesh;
  if (end_ < 0) {
    for (double& t : mesh) t = place(t, {});
  }
  constexpr int intervals = 10;  // additional equal intervals
  for (int k = 0; k <= intervals; ++k)
    mesh.push_back(points_.front() + (points_.back() - points_.front()) * k / intervals);
  std::ranges::sort(mesh);
  return mesh;
}

double TypedProblem::last_pulse() const {
  constexpr double horizon = 1e6;
  const double from = time(points_.front(), {}), until = from + horizon;
  double last = from;
  for (const auto& pulse :
       program::TimeFeatures(equations_.graph(), integrated()).short_activities(from, until, horizon / 2)) {
    if (pulse.t1 < until) last = std::max(last, pulse.t1);
  }
  return place(last, {});
}

void TypedProblem::read_guess(const std::string& text) {
  guess_.resize(names().size());
  std::vector<std::optional<program::NodeId>> given(names().size());
  program::Equations equations = equations_;
  for (const ConditionText& piece : conditions_of("--guess", text)) {
    const std::size_t equals = piece.text.find('=');
    std::string name = piece.text.substr(0, equals);
    name.erase(name.find_last_not_of(" \t\n") + 1);
    const auto at = std::ranges::find(names(), name);
    if (at == names().end())
      throw input_error("--guess {}: must begin with a component and =; the components are {}",
                        quoted_input(piece.text),
                        quoted_input(fmt::format("{}", fmt::join(names(), ", ")), 200));
    const auto i = static_cast<std::size_t>(at - names().begin());
    std::optional<Program>& one = guess_[i];
    if (one) throw input_error("--guess {}: {} is given twice", quoted_input(piece.text), *at);
    const program::NodeId node = equations.expression("--guess", piece.text.substr(equals + 1));
    one = Program(equations.graph(), {node});
    if (depends_on_state(*one, 0.5, equations_.size()))
      throw input_error("--guess {}: must be a function of the time t only", quoted_input(piece.text));
    given[i] = node;
  }
  // A missing component is the derivative of the given one of the highest order below its own.
  program::Graph graph = equations.graph();
  for (std::size_t i = 0; i < names().size(); ++i) {
    std::string name = names()[i];
    std::size_t lower = i;
    while (!given[lower] && name.ends_with('\'')) {
      name.pop_back();
      lower = static_cast<std::size_t>(std::ranges::find(names(), name) - names().begin());
    }
    if (lower == i || !given[lower]) continue;
    program::NodeId node = *given[lower];
    for (std::size_t k = name.size(); k < names()[i].size(); ++k)
      node = rates(graph, {node}, equations_.slopes()).front();
    guess_[i] = Program(graph, {node});
  }
}

Start TypedProblem::guess() const {
  const VectorXd zero = VectorXd::Zero(equations_.size());
  Start start;
  start.parameters = VectorXd::Zero(parameters());
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    const auto& given = guess_[index_of(parameters_[k])];
    if (given) start.parameters[static_cast<Index>(k)] = value_of(*given, points_.front(), zero);
  }
  if (end_ >= 0) start.parameters[end_] = points_.back();
  const auto time_of = [problem = *this](double s) {
    return problem.maps_start_ || problem.maps_end_ ? problem.time(s, {}) : s;
  };
  start.states = [guess = guess_, states = states_, zero, time_of](double s, VectorXd& x) {
    const double t = time_of(s);
    x.setZero();
    for (std::size_t k = 0; k < states.size(); ++k) {
      const std::optional<Program>& one = guess[index_of(states[k])];
      if (one) x[static_cast<Index>(k)] = value_of(*one, t, zero);
    }
  };
  return start;
}

Start TypedProblem::guess_from(const std::vector<double>& times, const MatrixXd& values) const {
  Start start = guess();
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    start.parameters[static_cast<Index>(k)] = values(parameters_[k], 0);
  MatrixXd of_states = MatrixXd::Zero(states(), values.cols());
  for (std::size_t k = 0; k < states_.size(); ++k)
    of_states.row(static_cast<Index>(k)) = values.row(states_[k]);
  std::vector<double> places;
  for (const double t : times) places.push_back(place(t, start.parameters));
  start.states = [places, of_states](double s, VectorXd& x) {
    const auto after = std::ranges::upper_bound(places, s) - places.begin();
    const Index i = std::clamp<Index>(after - 1, 0, of_states.cols() - 2);
    const double a = places[static_cast<std::size_t>(i)], b = places[static_cast<std::size_t>(i) + 1];
    const double share = std::clamp((s - a) / (b - a), 0.0, 1.0);
    x = (1 - share) * of_states.col(i) + share * of_states.col(i + 1);
  };
  constexpr std::size_t most_intervals = 200;
  const std::size_t every = (places.size() + most_intervals - 1) / most_intervals;
  start.mesh = {points_.front()};
  for (std::size_t i = 0; i < places.size(); i += every) {
    if (places[i] > points_.front() && places[i] < points_.back()) start.mesh.push_back(places[i]);
  }
  start.mesh.push_back(points_.back());
  return start;
}

Start TypedProblem::random_guess(double size, unsigned seed) const {
  const VectorXd amplitudes = VectorXd::Constant(states() + parameters(), size);
  Start all = random_start(amplitudes, points_.front(), points_.back(), seed);
  VectorXd both(states() + parameters());
  all.states((points_.front() + points_.back()) / 2, both);
  Start start;
  start.parameters = both.tail(parameters());
  const Start given = guess();
  for (int i = 0; i < parameters(); ++i) {
    if (guess_[index_of(parameters_[index_of(i)])] || i == end_) start.parameters[i] = given.parameters[i];
  }
  start.states = [all = std::move(all), both](double t, VectorXd& x) mutable {
    all.states(t, both);
    x = both.head(x.size());
  };
  return start;
}

bool TypedProblem::has_guess_of_states() const {
  return std::ranges::any_of(states_, [&](int i) { return guess_[index_of(i)].has_value(); });
}

std::vector<int> TypedProblem::components_at_infinity() const {
  std::vector<int> all;
  for (const Conditions::Value& value : conditions_.values()) {
    if (value.time != infinity) continue;
    for (int k = 0; k < equations_.size(); ++k) {
      if (value.what == program::Graph::state(k)) all.push_back(k);
    }
  }
  return all;
}

std::optional<int> TypedProblem::end_parameter() const {
  return end_ < 0 ? std::nullopt : std::optional(end_);
}

std::optional<int> TypedProblem::parameter_of(int i) const {
  const Component& component = components_[index_of(i)];
  return component.is_parameter ? std::optional(component.index) : std::nullopt;
}

double TypedProblem::rate(double s, const VectorXd& p) const {
  const double length = until_ - from_, u = (s - from_) / length, last = points_[points_.size() - 2];
  if (maps_start_ && is_infinite_) return u * (u + 2) / ((1 + u) * (1 + u));
  if (maps_start_ && maps_end_) return std::numbers::pi / 2 * std::sin(std::numbers::pi * u);
  if (maps_start_) return 2 * u;
  if (maps_end_) return 2 * (1 - u);
  return end_ < 0 || s < last ? 1 : (p[end_] - last) / (points_.back() - last);
}

double TypedProblem::time(double s, const VectorXd& p) const {
  const double length = until_ - from_, u = (s - from_) / length, last = points_[points_.size() - 2];
  const auto square = [](double x) { return x * x; };
  if (maps_start_ && is_infinite_) return from_ + length * u * u / (1 + u);
  if ((maps_start_ || maps_end_) && u >= 1) return until_;
  if (maps_end_ && (!maps_start_ || u > 0.5))
    return until_ - length * square(maps_start_ ? std::sin(std::numbers::pi / 2 * (1 - u)) : 1 - u);
  if (maps_start_) return from_ + length * square(maps_end_ ? std::sin(std::numbers::pi / 2 * u) : u);
  return end_ < 0 || s < last ? s : last + rate(s, p) * (s - last);
}

double TypedProblem::place(double t, const VectorXd& p) const {
  const double length = until_ - from_, v = (t - from_) / length, last = points_[points_.size() - 2];
  if (maps_start_ && is_infinite_) return from_ + length * (v + std::sqrt(v * (v + 4))) / 2;
  if ((maps_start_ || maps_end_) && t >= until_) return until_;
  if (maps_start_ && maps_end_) return from_ + length * 2 / std::numbers::pi * std::asin(std::sqrt(v));
  if (maps_start_) return from_ + length * std::sqrt(v);
  if (maps_end_) return until_ - length * std::sqrt((until_ - t) / length);
  return end_ < 0 || t < last ? t : last + (t - last) / rate(last, p);
}

VectorXd TypedProblem::components(const VectorXd& x, const VectorXd& p) const {
  VectorXd all(equations_.size());
  for (int i = 0; i < equations_.size(); ++i) all[i] = Components{components_, x, p}[i];
  return all;
}

VectorXd TypedProblem::components_at(const Solution& solution, double t) const {
  const VectorXd& p = solution.parameters();
  return components(solution.at(place(t, p)), p);
}

std::string TypedProblem::unknown_name(int i) const {
  const int components = static_cast<int>(states_.size());
  if (i >= states()) return names()[index_of(parameters_[index_of(i - states())])];
  return i < components ? names()[index_of(states_[index_of(i)])]
                        : fmt::format("integral {}", i - components + 1);
}

void TypedProblem::rhs(double s, const VectorXd& x, const VectorXd& p, VectorXd& dxds) const {
  slopes_.run(time(s, p), Components{components_, x, p}, 0, slopes_.outputs(),
              [&](int i, double value) { dxds[i] = value; });
  dxds *= rate(s, p);
}

void TypedProblem::jacobian(double s, const VectorXd& x, const VectorXd& p, MatrixXd& by_state,
                            MatrixXd& by_parameter) const {
  by_state.setZero();
  by_parameter.setZero();
  const double last = points_[points_.size() - 2];
  const bool is_stretched = end_ >= 0 && s >= last;
  const double factor = rate(s, p), length = points_.back() - last;
  differentiate(slopes_, time(s, p), components(x, p), is_stretched, [&](int i, int j, double value) {
    if (j == equations_.size()) {
      by_parameter(i, end_) += factor * value * (s - last) / length;
      return;
    }
    const Component& c = components_[index_of(j)];
    if (c.is_parameter)
      by_parameter(i, c.index) += factor * value;
    else
      by_state(i, c.index) = factor * value;
  });
  if (!is_stretched) return;
  VectorXd slope(states());
  rhs(s, x, p, slope);
  by_parameter.col(end_) += slope / (factor * length);
}

VectorXd TypedProblem::arguments(const MatrixXd& ends, const VectorXd& p) const {
  VectorXd all(conditions_.arguments());
  Index k = 0;
  for (const Value& value : values_)
    all[k++] =
        bvp::value_of(value.what, time(points_[value.point], p), components(ends.col(value.column), p));
  const auto integrals = static_cast<Index>(conditions_.integrands().size());
  all.segment(k, integrals) = ends.rightCols(1).bottomRows(integrals);
  k += integrals;
  const VectorXd first = components(ends.col(0), p);
  for (const int i : conditions_.constants()) all[k++] = first[i];
  return all;
}

// Conditions of the user, integrals from 0, then continuity of each state at each interior point.
void TypedProblem::conditions(const MatrixXd& ends, const VectorXd& p, VectorXd& r) const {
  const int n = states(), last = static_cast<int>(ends.cols()) - 1;
  conditions_.residuals().run(0., arguments(ends, p), 0, conditions_.residuals().outputs(),
                              [&](int i, double value) { r[i] = value; });
  const auto integrals = static_cast<Index>(conditions_.integrands().size());
  Index row = conditions_.count();
  r.segment(row, integrals) = ends.col(0).tail(integrals);
  row += integrals;
  for (int k = 1; k < last; k += 2, row += n) r.segment(row, n) = ends.col(k) - ends.col(k + 1);
}

void TypedProblem::condition_jacobian(const MatrixXd& ends, const VectorXd& p, MatrixXd& by_ends,
                                      MatrixXd& by_parameter) const {
  const int n = states(), last = static_cast<int>(ends.cols()) - 1;
  const auto integrals = static_cast<Index>(conditions_.integrands().size());
  by_ends.setZero();
  by_parameter.setZero();
  MatrixXd by_argument(conditions_.count(), conditions_.arguments());
  differentiate(conditions_.residuals(), 0, arguments(ends, p), false,
                [&](int i, int j, double value) { by_argument(i, j) = value; });
  const auto add = [&](Index argument, Index column, int component, double value) {
    const Component& c = components_[index_of(component)];
    if (c.is_parameter)
      by_parameter.col(c.index).head(conditions_.count()) += value * by_argument.col(argument);
    else
      by_ends.col(column * n + c.index).head(conditions_.count()) += value * by_argument.col(argument);
  };
  Index k = 0;
  for (const Value& value : values_) {
    const bool moves = end_ >= 0 && value.point + 1 == points_.size();
    differentiate(value.what, time(points_[value.point], p), components(ends.col(value.column), p), moves,
                  [&](int, int j, double slope) {
                    if (j < equations_.size())
                      add(k, value.column, j, slope);
                    else
                      by_parameter.col(end_).head(conditions_.count()) += slope * by_argument.col(k);
                  });
    ++k;
  }
  for (Index i = 0; i < integrals; ++i, ++k)
    by_ends.col(last * n + n - integrals + i).head(conditions_.count()) += by_argument.col(k);
  for (const int i : conditions_.constants()) add(k++, 0, i, 1);
  Index row = conditions_.count();
  for (Index i = 0; i < integrals; ++i) by_ends(row++, n - integrals + i) = 1;
  for (Index column = 1; column < last; column += 2, row += n) {
    auto rows = by_ends.middleRows(row, n);
    rows.middleCols(column * n, n).setIdentity();
    rows.middleCols((column + 1) * n, n) = -MatrixXd::Identity(n, n);
  }
}

TypedProblem read_problem(const ProblemText& text, const std::string& guess) {
  std::vector<std::string> unknowns = names_in("--unknown", text.unknowns);
  for (const std::string& name : unknowns) {
    if (name != text.until && !mentions(text.equations, name) && !mentions(text.conditions, name))
      throw input_error("--unknown {}: stands in no equation and in no condition, so nothing determines it",
                        name);
  }
  const std::string end = free_end_name(text.equations, text.settings, text.until);
  if (!end.empty() && std::ranges::find(unknowns, end) == unknowns.end()) unknowns.push_back(end);
  if (!text.parameter.empty()) unknowns.push_back(text.parameter);
  DividedText divided = divide(text.name, text.equations, unknowns, text.parameter);
  for (const std::string& name : unknowns) divided.equations += fmt::format("\n{}' = 0", name);
  std::vector<ConditionText> conditions = divided.conditions;
  const std::vector<ConditionText> further = conditions_of("--conditions", text.conditions);
  conditions.insert(conditions.end(), further.begin(), further.end());
  return {equations_of(text.name, text.equations, divided, text.settings),
          conditions,
          {text.from, text.until},
          guess};
}

}  // namespace nlmech::bvp
