#include "chapters/two_body_series/stm/sensitivities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "nlmech/ivp/runge_kutta/rkn1210.hpp"
#include "nlmech/orbit/covariance.hpp"
#include "nlmech/orbit/scaled.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/sentences.hpp"

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
  const orbit::detail::PowerUnits units = rkn1210_units(r);
  const double time_unit = std::ldexp(1.0, units.time);
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
      ivp::integrate(System(VariationalField{units.own(r.gravity)}), x, 0, r.time / time_unit,
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
  TransitionSolution result;
  result.end.x = r.start;
  for (std::size_t i = 0; i <= times.size(); ++i) {
    if (r.watch.seconds() > r.seconds) {
      result.end.status =
          failed_with(Outcome::time_limit, "kepler: {} seconds were used up; allow more", r.seconds);
      break;
    }
    const double t = i < times.size() ? times[i] : r.time;
    orbit::KeplerTransition k;
    if (r.columns.any()) {
      k = orbit::kepler_transition(r.start, t, r.gravity.mu);
    } else {
      orbit::KeplerSolution at = orbit::propagate_kepler(r.start, t, r.gravity.mu);
      k.state = at.state;
      k.status = std::move(at.status);
    }
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
                                     {.seconds = std::max(0.0, r.seconds - r.watch.seconds())});
}

}  // namespace nlmech::chapters::two_body_series
