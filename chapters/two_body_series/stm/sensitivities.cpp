#include "chapters/two_body_series/stm/sensitivities.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "chapters/two_body_series/series/accuracy.hpp"
#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/covariance.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

using orbit::State;
using orbit::TransitionMatrix;
using orbit::TransitionSolution;

/// r'' and, for the six columns of a transition matrix, dr'' = A dr, with the gradient A of the acceleration
/// by dual numbers. State: r and the positions of the columns, then velocities.
struct VariationalField {
  static constexpr int dimension = 42;  ///< seven positions, then seven velocities
  orbit::Gravity gravity;               ///< of the centre
  using Half = Vector<double, dimension / 2>;

  /// The accelerations at the positions @p q.
  void acceleration(double /*t*/, const Half& q, const Half& /*v*/, Half& a) const {
    using D = Dual<double, 3>;
    const auto field =
        orbit::acceleration<D>(variables<double, 3>(orbit::Vector3<double>(q.head<3>())), gravity);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto& gradient = field[i].partial;
      a[i] = field[i].value;
      for (Eigen::Index j = 3; j < q.size(); j += 3)
        a[j + i] = gradient[0] * q[j] + gradient[1] * q[j + 1] + gradient[2] * q[j + 2];
    }
  }
  /// The equation in first-order form.
  void operator()(double t, const Vector<double, dimension>& x, Vector<double, dimension>& f) const {
    Half a;
    acceleration(t, x.head<21>(), x.tail<21>(), a);
    f << x.tail<21>(), a;
  }
};

TransitionSolution by_rkn1210(const OrbitRequest& r, std::span<const double> times,
                              const orbit::TransitionSink& sink) {
  using System = ivp::Direct<VariationalField>;
  const orbit::detail::PowerUnits units(r.start.position.stableNorm(), r.gravity.mu);
  const double time_unit = std::ldexp(1.0, units.time);
  orbit::Gravity gravity = r.gravity;
  gravity.mu = units.own_mu(r.gravity.mu);
  gravity.radius = std::ldexp(r.gravity.radius, -units.length);
  const State start = units.own(r.start);
  System::State x = System::State::Zero();
  x.head<3>() = start.position;
  x.segment<3>(21) = start.velocity;
  for (Eigen::Index k = 0; k < 3; ++k) x[3 + 4 * k] = x[21 + 12 + 4 * k] = 1;
  TransitionSolution result;
  const auto read = [&](double t, const System::State& at) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double unit = j < 3 ? 1 : time_unit;
      result.transition.col(j) << unit * at.segment<3>(3 + 3 * j),
          unit / time_unit * at.segment<3>(24 + 3 * j);
    }
    result.end.t = t;
    result.end.x = units.users({at.head<3>(), at.segment<3>(21)});
  };
  std::size_t next = 0;
  const auto observe = [&](const ivp::StepOf<System>& step) {
    for (; next < times.size() && std::abs(times[next]) <= std::abs(step.t1 * time_unit); ++next) {
      read(times[next], step.at(times[next] / time_unit));
      if (!sink(result.end.t, result.end.x, result.transition)) return false;
    }
    return true;
  };
  const auto end =
      ivp::integrate(System(VariationalField{gravity}), x, 0, r.time / time_unit,
                     ivp::Rkn1210{.relative_tolerance = r.tolerance, .absolute_tolerance = r.tolerance},
                     observe, {.seconds = r.seconds});
  read(end.status.ok() ? r.time : end.t * time_unit, end.x);
  if (!end.status.ok())  // the message of the status has scaled units
    result.end.status = failed_with(end.status.outcome(),
                                    "rkn1210: with the transition matrix stopped at t = {:.17g}; loosen the "
                                    "tolerance {:g}, or use the method series",
                                    result.end.t, r.tolerance);
  return result;
}

TransitionSolution by_kepler(const OrbitRequest& r, std::span<const double> times,
                             const orbit::TransitionSink& sink) {
  const Stopwatch watch;
  TransitionSolution result;
  result.end.x = r.start;
  for (std::size_t i = 0; i <= times.size(); ++i) {
    if (watch.seconds() > r.seconds) {
      result.end.status =
          failed_with(Outcome::time_limit, "kepler: {} seconds were used up; allow more", r.seconds);
      break;
    }
    const double t = i < times.size() ? times[i] : r.time;
    orbit::KeplerTransition k = orbit::kepler_transition(r.start, t, r.gravity.mu);
    if (!k.status.ok()) {
      result.end.status = std::move(k.status);
      break;
    }
    result.end.t = t;
    result.end.x = k.state;
    result.transition = k.transition;
    if (i < times.size() && !sink(t, k.state, k.transition)) break;
  }
  return result;
}

}  // namespace

std::string Sensitivities::names() const {
  std::string text;
  const auto add = [&text](const char* name) {
    for (int i = 1; i <= 6; ++i)
      for (int j = 1; j <= 6; ++j) text += fmt::format(",{}_{}{}", name, i, j);
  };
  if (transition) add("phi");
  if (initial_root) add("p");
  return text;
}

std::string Sensitivities::cells(const TransitionMatrix& phi) const {
  std::string text;
  const auto add = [&text](const Matrix<double, 6>& m) {
    for (Eigen::Index i = 0; i < 6; ++i)
      for (Eigen::Index j = 0; j < 6; ++j) fmt::format_to(std::back_inserter(text), ",{:.17g}", m(i, j));
  };
  if (transition) add(phi);
  if (initial_root) {
    const Matrix<double, 6> root = phi * *initial_root;
    add(root * root.transpose());
  }
  return text;
}

Matrix<double, 6> read_covariance(const std::string& file) {
  const std::string name = file == "-" ? "standard input" : file;
  const std::vector<std::string> names = {"x", "y", "z", "vx", "vy", "vz"};
  const scene::NumberColumns numbers = scene::parse_numbers(scene::read_whole(file), name, names);
  if (numbers.rows() != names.size())
    throw input_error("{}: {} rows of numbers; a covariance of x,y,z,vx,vy,vz has 6 of 6 numbers", name,
                      numbers.rows());
  Matrix<double, 6> covariance, root;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j)
      covariance(i, j) = numbers.column[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
  if (const auto fault = orbit::root_of_covariance(covariance, root)) {
    throw input_error("{}: line {}, column {} ({}): {}", name,
                      numbers.line[static_cast<std::size_t>(fault->row)], fault->column + 1,
                      names[static_cast<std::size_t>(fault->column)], fault->why);
  }
  return root;
}

orbit::TransitionSolution propagate_with_transition(const OrbitRequest& r, std::string_view method,
                                                    std::span<const double> times,
                                                    const orbit::TransitionSink& sink) {
  if (r.time == 0) return {{0, r.start, {}, {}}};
  if (method == "kepler") return by_kepler(r, times, sink);
  if (method == "rkn1210") return by_rkn1210(r, times, sink);
  return orbit::propagate_transition(r.start, 0, r.time, r.gravity, {.tolerance = r.tolerance}, times, sink,
                                     {.seconds = r.seconds});
}

std::vector<double> inner_times(double until, const std::optional<double>& every) {
  std::vector<double> times;
  if (!every) return times;
  // The final time has its own row; k DT equal to it up to rounding has no second one.
  for (std::int64_t k = 1;; ++k) {
    const double t = static_cast<double>(k) * *every;
    if (!(std::abs(until) - t > 1e-9 * *every)) return times;
    times.push_back(std::copysign(t, until));
  }
}

std::string rows_with(const Sensitivities& columns, const OrbitRequest& r, std::string_view method) {
  std::string text = "t,x,y,z,vx,vy,vz" + columns.names() + '\n';
  const ComputedBy by{method, method == "kepler" ? std::nullopt : std::optional(r.tolerance)};
  Accuracy worst;
  Status refused;
  const auto add = [&](double t, const State& s, const TransitionMatrix& phi) {
    Accuracy accuracy = accuracy_of(s, r.start, t, r.gravity, by);
    refused = accuracy.status;
    if (accuracy.off > worst.off) worst = std::move(accuracy);
    const auto &p = s.position, &v = s.velocity;
    fmt::format_to(std::back_inserter(text), "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}{}\n", t,
                   p[0], p[1], p[2], v[0], v[1], v[2], columns.cells(phi));
    return refused.ok();
  };
  if (r.at.empty() || r.at.front() == 0) (void)add(0, r.start, TransitionMatrix::Identity());
  std::vector<double> inner = r.at.empty() ? inner_times(r.time, r.every) : r.at;
  std::erase_if(inner, [&](double t) { return t == 0 || t == r.time; });
  const TransitionSolution run = propagate_with_transition(r, method, inner, add);
  if (!refused.ok()) throw Failure(refused);
  if (!run.end.status.ok()) throw Failure(run.end.status);
  if (r.time != 0 && !add(r.time, run.end.x, run.transition)) throw Failure(refused);
  if (!worst.sentence.empty()) scene::print_message(fmt::format("two_body_series: {}", worst.sentence));
  return text;
}

}  // namespace nlmech::chapters::two_body_series
