#include "nlmech/orbit/transfer/transfer.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::orbit {
namespace {

/// Limit of steps of all corrections of one transfer.
constexpr std::int64_t most_steps = 20'000'000;

/// Propagates the orbit from r_0 with v_1 to the arrival and counts steps. @return false if the propagation
/// fails
[[nodiscard]] bool propagate_arc(const TransferProblem& p, const Vector3<double>& v1, State& end,
                                 std::int64_t& steps) {
  if (!v1.allFinite()) return false;
  const State start{p.from, v1};
  if (p.gravity.degree() == 0) {
    const KeplerSolution solution = propagate_kepler(start, p.time, p.gravity.mu);
    end = solution.state;
    return solution.status.ok();
  }
  const Solution solution = propagate(start, 0, p.time, p.gravity, AnalyticContinuation{.tolerance = 1e-17},
                                      {}, {.steps = 1'000'000});
  steps += solution.statistics.steps;
  end = solution.x;
  return solution.status.ok();
}

/// Broyden's iteration for r(t; v_1) = r_F.
class Correction {
 public:
  Correction(const TransferProblem& problem, const Vector3<double>& start) : p_(problem), v_(start) {}

  [[nodiscard]] bool run(Transfer& transfer) {
    Vector3<double> miss;
    if (!measure(v_, miss, transfer) || !differentiate(miss, transfer.statistics.steps)) return false;
    Eigen::Matrix3d inverse = jacobian_.inverse();
    ++transfer.statistics.jacobians;
    double least = HUGE_VAL;
    int worse = 0;  // stop after two updates without progress: rounding
    for (int i = 0; i < 60 && worse < 2; ++i) {
      const Vector3<double> step = -(inverse * miss);
      Vector3<double> next_miss;
      if (transfer.statistics.steps > most_steps || !step.allFinite() ||
          !measure(v_ + step, next_miss, transfer))
        return false;
      ++transfer.statistics.newton_iterations;
      const Vector3<double> change = next_miss - miss, predicted = inverse * change;
      const double denominator = step.dot(predicted);
      if (denominator != 0) inverse += (step - predicted) * (step.transpose() * inverse) / denominator;
      v_ += step;
      miss = next_miss;
      worse = transfer.miss < 0.5 * least ? 0 : worse + 1;
      least = std::min(least, transfer.miss);
    }
    return true;
  }

 private:
  /// Computes the miss for @p v; stores the best one in @p transfer.
  [[nodiscard]] bool measure(const Vector3<double>& v, Vector3<double>& miss, Transfer& transfer) {
    State end;
    if (!propagate_arc(p_, v, end, transfer.statistics.steps)) return false;
    miss = end.position - p_.to;
    if (miss.norm() < best_) {
      best_ = transfer.miss = miss.norm();
      transfer.v1 = v;
      transfer.v2 = end.velocity;
    }
    return true;
  }
  [[nodiscard]] bool differentiate(const Vector3<double>& miss, std::int64_t& steps) {
    const double change = 1e-7 * v_.norm();
    for (int i = 0; i < 3; ++i) {
      Vector3<double> v = v_;
      v[i] += change;
      State end;
      if (!propagate_arc(p_, v, end, steps)) return false;
      jacobian_.col(i) = (end.position - p_.to - miss) / change;
    }
    return true;
  }

  const TransferProblem& p_;
  Vector3<double> v_;
  Eigen::Matrix3d jacobian_;
  double best_ = std::numeric_limits<double>::infinity();
};

/// Continuation from the conic to the full field in the size of the zonal terms; one step if that converges.
[[nodiscard]] bool follow_field(const TransferProblem& problem, Transfer& transfer) {
  const double enough = 1e-9 * problem.to.stableNorm();
  double part = 0, step = 1;
  Transfer reached = transfer;
  while (part < 1) {
    TransferProblem p = problem;
    for (double& j : p.gravity.zonal) j *= part + step;
    Transfer next = reached;
    const bool integrated = Correction(p, reached.v1).run(next);
    reached.statistics = next.statistics;
    if (integrated && next.miss <= enough) {
      reached = next;
      part += step;
      step = std::min(2 * step, 1 - part);
    } else if ((step /= 2) < 1.0 / 256 || reached.statistics.steps > most_steps) {
      transfer.miss = miss_of(problem, transfer.v1, &transfer.v2);
      transfer.statistics = reached.statistics;
      return false;
    }
  }
  transfer = reached;
  return true;
}

}  // namespace

double miss_of(const TransferProblem& problem, const Vector3<double>& v1, Vector3<double>* v2) {
  State end;
  std::int64_t steps = 0;
  if (!propagate_arc(problem, v1, end, steps)) return std::numeric_limits<double>::infinity();
  if (v2 != nullptr) *v2 = end.velocity;
  return (end.position - problem.to).stableNorm();
}

TransferProblem in_plane(const TransferProblem& problem, const Vector3<double>& normal) {
  const auto fail = [&](const char* why) {
    return invalid_argument("lambert: the plane's normal ({}, {}, {}) {}", normal[0], normal[1], normal[2],
                            why);
  };
  if (!normal.allFinite()) throw fail("must be finite");
  const Vector3<double> out = problem.from / problem.from.stableNorm(), n = normal / normal.stableNorm();
  const Vector3<double> across = n - n.dot(out) * out;
  if (!(across.norm() > 1e-8)) throw fail("is along the departure; it must be across it");
  TransferProblem p = problem;
  const Vector3<double> unit = across / across.norm();
  // Once more, since the first difference cancels where the given normal is nearly along the departure.
  p.normal = (unit - unit.dot(out) * out).normalized();
  p.to -= p.to.dot(*p.normal) * *p.normal;
  if (!(p.to.stableNorm() > 1e-8 * problem.to.stableNorm())) throw fail("is along the arrival");
  return p;
}

namespace {

void measure_arc(const TransferProblem& problem, Transfer& transfer) {
  transfer.miss = miss_of(problem, transfer.v1);
  if (!(transfer.miss <= largest_miss * problem.to.stableNorm())) {
    transfer.status =
        failed_with(Outcome::outside_validity,
                    "lambert: integrated, the arc found misses by {:.3g}, more than a millionth of the "
                    "distance: doubles do not hold its velocity exactly enough (it passes near the centre, "
                    "or makes very many revolutions); take another arc or time",
                    transfer.miss);
  }
}

}  // namespace

void turn_into_plane(const TransferProblem& problem, Transfer& transfer) {
  const auto turn = [&](const Vector3<double>& r, Vector3<double>& v) {
    const Vector3<double> out = r / r.stableNorm(), ahead = cross(*problem.normal, out);
    const Vector3<double> across = v - v.dot(out) * out;
    v += std::copysign(across.stableNorm(), across.dot(ahead)) * ahead - across;
  };
  turn(problem.from, transfer.v1);
  turn(problem.to, transfer.v2);
  measure_arc(problem, transfer);
}

Transfer corrected_transfer(const TransferProblem& problem, const LambertArc& arc) {
  check(problem.gravity);
  const Stopwatch watch;
  Transfer transfer;
  const LambertSolution conic =
      solve_lambert({problem.from, problem.to, problem.time, problem.gravity.mu, problem.normal}, arc);
  transfer.status = conic.status;
  if (!conic.status.ok()) return transfer;
  transfer.v1 = conic.v1;
  transfer.v2 = conic.v2;
  if (problem.gravity.degree() == 0) {
    measure_arc(problem, transfer);
  } else if (!follow_field(problem, transfer)) {
    transfer.status =
        failed_with(Outcome::not_converged,
                    "corrected transfer: after {} corrections of Lambert's arc for the zonal terms the orbit "
                    "still misses by {:.3g}; take another arc, or positions farther from 180 degrees",
                    transfer.statistics.newton_iterations, transfer.miss);
  }
  transfer.statistics.seconds = watch.seconds();
  return transfer;
}

}  // namespace nlmech::orbit
