#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "nlmech/bvp/optimal_control/duffing.hpp"

namespace nlmech::bvp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

double energy(const DuffingSettings& s, const Vector2d& x) {
  const double square = x[0] * x[0];
  return (x[1] * x[1] + s.frequency * s.frequency * square) / 2 + s.beta / 4 * square * square;
}

/// Initial state: prescribed components, else 0.
Vector2d known_begin(const DuffingSettings& s) {
  const ExtremalProblem problem = duffing_problem(s);
  return {problem.task().begin[0].value_or(0), problem.task().begin[1].value_or(0)};
}

/// Approximate angular frequency of the oscillation through the target.
double fast_frequency(const DuffingSettings& s) {
  const Vector2d target = duffing_target(s);
  const double w2 = s.frequency * s.frequency, e = std::max(energy(s, target), energy(s, known_begin(s)));
  const double amplitude2 = 4 * e / (w2 + std::sqrt(w2 * w2 + 4 * std::max(s.beta, 0.0) * e));
  return std::sqrt(w2 + 0.75 * std::max(s.beta, 0.0) * amplitude2);
}

/// Number of oscillations from which starts without oscillations lead to expensive extremals or to none.
constexpr double many_swings = 4;

/// Number of oscillations within T at the energy of the target.
double swings(const DuffingSettings& s) { return fast_frequency(s) * s.final_time / (2 * std::numbers::pi); }

/// Number of steps of a tabulated trajectory.
int table_steps(const DuffingSettings& s) {
  const double cycles = swings(s);
  return std::clamp(static_cast<int>(std::lround(200 * cycles)), 400, 20000);
}

std::vector<double> mesh_for(const DuffingSettings& s) {
  const double cycles = swings(s);
  const int intervals = std::clamp(static_cast<int>(std::ceil(6 * cycles)), 8, 800);
  std::vector<double> mesh;
  for (int i = 0; i <= intervals; ++i) mesh.push_back(s.final_time * i / intervals);
  return mesh;
}

/// Start from a table of states and co-states, with one column per time, equally spaced.
Start tabled(const DuffingSettings& s, MatrixXd table) {
  const double h = s.final_time / static_cast<double>(table.cols() - 1);
  auto states = [table = std::move(table), h](double t, VectorXd& z) {
    const double at = std::clamp(t / h, 0.0, static_cast<double>(table.cols() - 1));
    const Index k = std::min<Index>(static_cast<Index>(at), table.cols() - 2);
    const double f = at - static_cast<double>(k);
    z = (1 - f) * table.col(k) + f * table.col(k + 1);
  };
  return {std::move(states), duffing_problem(s).own_parameters(), mesh_for(s)};
}

using Force = std::function<double(const Vector2d&)>;

/// Table of x along a trajectory under a force, by the classical Runge-Kutta method, forward or backward.
MatrixXd table_of(const DuffingSettings& s, Vector2d x, bool from_the_end, const Force& force) {
  const int steps = table_steps(s);
  const double h = (from_the_end ? -1 : 1) * s.final_time / steps;
  const auto slope = [&](const Vector2d& at) {
    return Vector2d(at[1], force(at) - s.frequency * s.frequency * at[0] - s.beta * at[0] * at[0] * at[0]);
  };
  MatrixXd table = MatrixXd::Zero(4, steps + 1);
  for (int k = 0; k <= steps; ++k) {
    table.col(from_the_end ? steps - k : k).head<2>() = x;
    const Vector2d k1 = slope(x), k2 = slope(x + h / 2 * k1), k3 = slope(x + h / 2 * k2),
                   k4 = slope(x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    // Keeps the table finite if the trajectory diverges.
    if (!x.allFinite() || x.norm() > 1e6) x.setZero();
  }
  return table;
}

/// m(E): mean of x2^2 over an unforced oscillation of energy E. With x1 = a sin(phi) the velocity is a
/// cos(phi) g with a smooth g, and the midpoint rule over a quarter period is nearly exact to rounding.
double mean_square_velocity(const DuffingSettings& s, double e) {
  const double w2 = s.frequency * s.frequency, beta = std::max(s.beta, 0.0);
  const double amplitude2 = 4 * e / (w2 + std::sqrt(w2 * w2 + 4 * beta * e));
  constexpr int points = 8;
  double squares = 0, times = 0;
  for (int i = 0; i < points; ++i) {
    const double phase = (i + 0.5) / points * std::numbers::pi / 2, sine = std::sin(phase),
                 cosine = std::cos(phase);
    const double g = std::sqrt(w2 + beta / 2 * amplitude2 * (1 + sine * sine));
    squares += amplitude2 * cosine * cosine * g;
    times += 1 / g;
  }
  return squares / times;
}

/// Integral of dE/sqrt(m(E)) from 0 to e, by the midpoint rule in sqrt(E), in which it is nearly linear.
double distance_of_energy(const DuffingSettings& s, double e) {
  constexpr int parts = 200;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double root = (i + 0.5) / parts, at = e * root * root;
    if (at > 0) sum += 2 * root * e / parts / std::sqrt(mean_square_velocity(s, at));
  }
  return sum;
}

double pump_gain(const DuffingSettings& s, double strength) {
  const double rise =
      distance_of_energy(s, energy(s, duffing_target(s))) - distance_of_energy(s, energy(s, known_begin(s)));
  return strength * rise / s.final_time;
}

Force pump(const DuffingSettings& s, double strength) {
  const double gain = pump_gain(s, strength), least = 1e-9 * energy(s, duffing_target(s));
  return [s, gain, least](const Vector2d& x) {
    const double e = energy(s, x);
    return e > least ? gain * x[1] / std::sqrt(mean_square_velocity(s, e)) : 0;
  };
}

/// Forces as functions of time, as guesses for the direct method.
std::vector<std::function<double(double)>> forces_in_time(const DuffingSettings& s, int count) {
  std::vector<std::function<double(double)>> forces;
  const double scale = std::sqrt(2 * energy(s, duffing_target(s))) / s.final_time;
  forces.push_back([](double) { return 0; });
  forces.push_back([scale](double) { return scale; });
  forces.push_back([scale](double) { return -scale; });
  for (int k = 0; static_cast<int>(forces.size()) < count; ++k) {
    const int half_waves = 1 + k / 2;
    const double T = s.final_time, sign = k % 2 == 0 ? 2 : -2;
    forces.push_back(
        [=](double t) { return sign * scale * std::cos(std::numbers::pi * half_waves * t / T); });
  }
  forces.resize(static_cast<std::size_t>(count), forces.front());
  return forces;
}

/// Initial states: prescribed components, and for the free ones a range up to and beyond the energy of the
/// target.
std::vector<Vector2d> begins(const DuffingSettings& s, int count) {
  const ExtremalProblem problem = duffing_problem(s);
  const bool free1 = !problem.task().begin[0], free2 = !problem.task().begin[1];
  const Vector2d known = known_begin(s);
  const double speed = std::sqrt(2 * std::max(energy(s, duffing_target(s)), 1.0));
  const double w = fast_frequency(s);
  std::vector<Vector2d> result;
  for (int k = 0; k < count; ++k) {
    // From -1.6 to 1.6 times the speed of the target, the smallest first.
    const int step = k / 2 + 1, steps = (count + 1) / 2;
    const double place = (k % 2 == 0 ? 1 : -1) * 1.6 * step / steps;
    Vector2d x = known;
    if (free1) x[0] = place * speed / w;
    if (free2) x[1] = free1 ? 0.5 * speed * std::cos(3.0 * k) : place * speed;
    result.push_back(x);
  }
  return result;
}

void add_direct(const DuffingSettings& s, const DuffingStarts& which, std::vector<Start>& starts) {
  const ExtremalProblem problem = duffing_problem(s);
  // Newton's iteration follows, so a low accuracy suffices.
  const DirectOptions options{.pieces = std::clamp(static_cast<int>(std::lround(60 * swings(s))), 80, 2000),
                              .weight_growth = 40,
                              .rounds = 4,
                              .tolerance = 1e-4};
  const auto forces = forces_in_time(s, which.direct);
  const auto from = begins(s, which.direct);
  const bool begin_is_free = !problem.task().begin[0] || !problem.task().begin[1];
  for (int k = 0; k < which.direct; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const auto force = begin_is_free ? forces.front() : forces[index];
    const ControlGuess guess{from[index], [force](double t, VectorXd& u) { u[0] = force(t); }};
    DirectResult result = direct_start(problem, guess, options);
    if (!result.status.ok()) continue;
    result.start.mesh = mesh_for(s);
    starts.push_back(std::move(result.start));
  }
}

/// Starts for many oscillations: direct method from pump_start(). One round, with a penalty that outweighs
/// the cost, suffices because Newton's iteration satisfies the end conditions.
void add_driven(const DuffingSettings& s, const DuffingStarts& which, std::vector<Start>& starts) {
  const ExtremalProblem problem = duffing_problem(s);
  const double cycles = swings(s);
  const Vector2d target = duffing_target(s);
  const double cost = 1.5 * energy(s, target) / s.final_time;
  DirectOptions options{.pieces = std::clamp(static_cast<int>(std::lround(60 * cycles)), 80, 4000),
                        .first_weight = 2000 * cost / target.squaredNorm(),
                        .rounds = 1};
  for (int k = 0; k < which.driven; ++k) {
    const double strength = 1 + 0.016 * k;
    const Start guess = pump_start(s, strength);
    VectorXd z(4);
    const auto force = [&guess, &z](double t, VectorXd& u) {
      guess.states(t, z);
      u[0] = -z[3];
    };
    DirectResult result = direct_start(problem, {known_begin(s), force}, options);
    if (!result.status.ok()) continue;
    result.start.mesh = guess.mesh;
    starts.push_back(std::move(result.start));
  }
}

}  // namespace

Start pump_start(const DuffingSettings& s, double strength) {
  const Force force = pump(s, strength);
  MatrixXd table = table_of(s, duffing_target(s), true, force);
  const Index last = table.cols() - 1;
  for (Index k = 0; k <= last; ++k) table(3, k) = -force(table.col(k).head<2>());
  // lambda1 = -lambda2'.
  const double h = s.final_time / static_cast<double>(last);
  for (Index k = 0; k <= last; ++k) {
    const Index before = std::max<Index>(k - 1, 0), after = std::min(k + 1, last);
    table(2, k) = (table(3, before) - table(3, after)) / (h * static_cast<double>(after - before));
  }
  return tabled(s, std::move(table));
}

Start unforced_start(const DuffingSettings& s, const Vector2d& x, bool from_the_end) {
  return tabled(s, table_of(s, x, from_the_end, [](const Vector2d&) { return 0.0; }));
}

std::vector<Start> duffing_starts(const DuffingSettings& s, const DuffingStarts& which) {
  std::vector<Start> starts;
  const VectorXd parameters = duffing_problem(s).own_parameters();
  if (swings(s) >= many_swings && energy(s, duffing_target(s)) > 0) add_driven(s, which, starts);
  add_direct(s, which, starts);
  for (int k = 0; k < which.pumps; ++k) {
    const double share = which.pumps > 1 ? static_cast<double>(k) / (which.pumps - 1) : 0.5;
    starts.push_back(pump_start(s, 0.9 + 0.3 * share));
  }
  for (const Vector2d& x : begins(s, which.unforced)) starts.push_back(unforced_start(s, x, false));
  if (which.unforced > 0) starts.push_back(unforced_start(s, duffing_target(s), true));
  if (which.constants) {
    for (const double value : {0.0, 1.0}) {
      Start start = constant_start(Vector4d::Constant(value), parameters);
      start.mesh = mesh_for(s);
      starts.push_back(std::move(start));
    }
  }
  for (int k = 0; k < which.random; ++k) {
    const double size = std::max(1.0, duffing_target(s).cwiseAbs().maxCoeff());
    Start start = random_start(Vector4d::Constant(size), 0, s.final_time,
                               which.seed + static_cast<unsigned>(k), parameters);
    start.mesh = mesh_for(s);
    starts.push_back(std::move(start));
  }
  return starts;
}

}  // namespace nlmech::bvp
