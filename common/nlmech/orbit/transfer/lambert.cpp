#include "nlmech/orbit/transfer/lambert.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nlmech/orbit/gravity.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/orbit/transfer/lambert_core.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::orbit {
namespace {

using detail::Chord;
using detail::Span;

void check_position(const Vector3<double>& r, const char* which) {
  if (!r.allFinite()) {
    throw invalid_argument("lambert: the position of {} must be finite, not ({}, {}, {})", which, r[0], r[1],
                           r[2]);
  }
  if (r == Vector3<double>::Zero()) {
    throw invalid_argument("lambert: the position of {} is 0, the centre of attraction", which);
  }
  if (!std::isfinite(r.stableNorm())) {
    throw invalid_argument(
        "lambert: the distance of {} from the centre, that of ({}, {}, {}), is beyond the range of doubles; "
        "take other units",
        which, r[0], r[1], r[2]);
  }
}

void check_problem(const LambertProblem& problem) {
  check_position(problem.from, "departure");
  check_position(problem.to, "arrival");
  check(Gravity{.mu = problem.mu});
  if (problem.normal && !(problem.normal->allFinite() && *problem.normal != Vector3<double>::Zero())) {
    throw invalid_argument("lambert: the plane's normal must be finite and not 0, not ({}, {}, {})",
                           (*problem.normal)[0], (*problem.normal)[1], (*problem.normal)[2]);
  }
}

/// Lambert's problem in units, powers of two, in which squares and cubes do not overflow.
struct ScaledChord {
  Chord chord;
  Span span = Span::plane;
  double wanted = 0;     ///< T
  double time_unit = 1;  ///< unit of time, in units of the user
  double unit = 1;       ///< unit of length, in units of the user

  ScaledChord(const LambertProblem& problem, bool long_way) {
    const double size1 = problem.from.cwiseAbs().maxCoeff(), size2 = problem.to.cwiseAbs().maxCoeff();
    const double largest = std::max({size1, size2, problem.mu}), least = std::min({size1, size2, problem.mu});
    Vector3<double> normal(0, 0, 0);
    if (problem.normal) normal = *problem.normal / problem.normal->cwiseAbs().maxCoeff();
    const Vector3<double>* given = problem.normal ? &normal : nullptr;
    if (largest < 1e100 && least > 1e-100) {
      span = detail::make_chord(problem.from, problem.to, problem.mu, given, chord);
    } else {
      const int length = std::ilogb(std::max(size1, size2));
      const int time = (3 * length - std::ilogb(problem.mu)) / 2;  // mu becomes 1/2 to 4
      unit = std::ldexp(1.0, length);
      time_unit = std::ldexp(1.0, time);
      span = detail::make_chord(problem.from / unit, problem.to / unit,
                                std::ldexp(problem.mu, 2 * time - 3 * length), given, chord);
    }
    if (span == Span::opposite && given != nullptr &&
        cross(normal, chord.out1).norm() < 1e-8 * normal.norm()) {
      throw invalid_argument(
          "lambert: the plane's normal ({}, {}, {}) is along the positions; it must be across them",
          (*problem.normal)[0], (*problem.normal)[1], (*problem.normal)[2]);
    }
    if (long_way) chord.turn();
    wanted = problem.time / time_unit * chord.rate;
  }
};

[[nodiscard]] Status no_plane(const LambertProblem& problem, Span span) {
  if (span == Span::same) {
    return failed_with(Outcome::outside_validity,
                       "lambert: the positions lie in one direction from the centre (a transfer by 0 or 360 "
                       "degrees) at distances {:.6g} and {:.6g}; no plane is determined and the arc is a "
                       "straight line; move one of them",
                       problem.from.stableNorm(), problem.to.stableNorm());
  }
  return Status::failure(Outcome::outside_validity,
                         "lambert: the positions are opposite (a transfer by 180 degrees), so that the plane "
                         "is undetermined; give its normal");
}

[[nodiscard]] Status no_such_arc(const LambertProblem& problem, const LambertArc& arc) {
  return failed_with(Outcome::infeasible,
                     "lambert: {} revolution{} the {} way take{} at least {:.17g}, and {:.17g} is given; ask "
                     "for fewer, or for more time",
                     arc.revolutions, arc.revolutions == 1 ? "" : "s", arc.long_way ? "long" : "short",
                     arc.revolutions == 1 ? "s" : "", least_time(problem, arc.long_way, arc.revolutions),
                     problem.time);
}

[[nodiscard]] Status out_of_reach(const LambertProblem& problem, double wanted) {
  return failed_with(Outcome::outside_validity,
                     "lambert: a flight of {:.6g}, T = {:.3g} in Izzo's measure, is too {} to be determined "
                     "by velocities in double precision",
                     problem.time, wanted, wanted > 1 ? "long" : "short");
}

/// Smallest component of v_1 normal to r_1, relative to |v_1|. Rounding rotates v_1 by at most 4 eps: eps for
/// the unit vector along r_1, eps for the sum of both parts, and as much again for the parts. With sixteen
/// times that, the angular momentum keeps its sign, and its magnitude to 1/16.
constexpr double least_across = 64 * std::numeric_limits<double>::epsilon();
/// Error of the end, relative to |r_2|, up to which the side of passing the centre is irrelevant.
constexpr double largest_without_side = 1e-6;

/// Does the orbit with the rounded v_1 pass the centre on the requested side, or reach r_2 on either side?
/// True for thin ellipses, false for fast passages near the centre. Uses the bound of the miss, because a
/// computed miss may be small by chance.
[[nodiscard]] bool is_on_requested_side(const LambertProblem& problem, const Chord& chord,
                                        const Vector3<double>& across, const Vector3<double>& v1) {
  if (across.dot(chord.ahead1) > least_across * std::sqrt(across.dot(across))) return true;
  const double kappa = kepler_condition({problem.from, v1}, problem.time, problem.mu).position;
  return 8 * kappa * std::numeric_limits<double>::epsilon() <= largest_without_side;
}

[[nodiscard]] Status passes_too_near(const LambertProblem& problem, const LambertArc& arc) {
  return failed_with(
      Outcome::outside_validity,
      "lambert: the arc the {} way in {:.6g} passes the centre so closely that the rounding of its "
      "velocities decides on which side; take {}another time, or positions farther from a common line",
      arc.long_way ? "long" : "short", problem.time, arc.revolutions == 0 ? "the other way, " : "");
}

[[nodiscard]] Status undetermined(const LambertProblem& problem, double wanted, double kappa) {
  return failed_with(
      Outcome::outside_validity,
      "lambert: rounding of the velocities leaves the place after {:.6g} undetermined (the arc's condition, "
      "{:.2g}, times the rounding of doubles leaves not one digit); take a {} time",
      problem.time, kappa, wanted > 1 ? "shorter" : "longer");
}

[[nodiscard]] LambertSolution solve(const LambertProblem& problem, const ScaledChord& scaled,
                                    const LambertArc& arc) {
  LambertSolution solution;
  detail::Found found;
  const detail::Arrived arrived =
      detail::find_x(scaled.chord, scaled.wanted, arc.revolutions, arc.branch, found);
  solution.iterations = found.iterations;
  if (arrived == detail::Arrived::no_such_arc) {
    solution.status = no_such_arc(problem, arc);
    return solution;
  }
  Vector3<double> v1, v2;
  detail::velocities(scaled.chord, found.x, v1, v2);
  const Vector3<double> scaled_v1 = v1;
  const double speed = scaled.unit / scaled.time_unit;
  v1 *= speed;
  v2 *= speed;
  if (arrived == detail::Arrived::lost || !v1.allFinite() || !v2.allFinite()) {
    solution.status = out_of_reach(problem, scaled.wanted);
    return solution;
  }
  if (!is_on_requested_side(problem, scaled.chord, scaled_v1, v1)) {
    solution.status = passes_too_near(problem, arc);
    return solution;
  }
  const double kappa = large_condition({problem.from, v1}, {problem.to, v2}, problem.time, problem.mu);
  if (kappa != 0) {
    solution.status = undetermined(problem, scaled.wanted, kappa);
    return solution;
  }
  solution.v1 = v1;
  solution.v2 = v2;
  solution.reciprocal_axis = 2 * (1 - found.x) * (1 + found.x) / scaled.chord.s / scaled.unit;
  return solution;
}

}  // namespace

LambertSolution solve_lambert(const LambertProblem& problem, const LambertArc& arc) {
  check_problem(problem);
  if (!(problem.time > 0) || !std::isfinite(problem.time)) {
    throw invalid_argument("lambert: the time of flight must be positive and finite, not {}", problem.time);
  }
  if (arc.revolutions < 0)
    throw invalid_argument("lambert: the number of revolutions must be 0 or more, not {}", arc.revolutions);
  const ScaledChord scaled(problem, arc.long_way);
  if (scaled.span == Span::same || (scaled.span == Span::opposite && !problem.normal)) {
    LambertSolution refused;
    refused.status = no_plane(problem, scaled.span);
    return refused;
  }
  return solve(problem, scaled, arc);
}

double least_time(const LambertProblem& problem, bool long_way, int revolutions) {
  check_problem(problem);
  if (revolutions < 1) {
    throw invalid_argument("lambert: a least time exists for 1 revolution or more, not for {}", revolutions);
  }
  LambertProblem timeless = problem;
  timeless.time = 1;
  const ScaledChord scaled(timeless, long_way);
  if (scaled.span == Span::same) return std::numeric_limits<double>::quiet_NaN();
  const detail::TimeCurve curve{scaled.chord.lambda, scaled.chord.complement, revolutions * std::numbers::pi};
  detail::TimeCurve::At a;
  (void)detail::find_minimum(curve, a);
  return a.t / scaled.chord.rate * scaled.time_unit;
}

bool are_opposite(const LambertProblem& problem) {
  check_problem(problem);
  return ScaledChord({problem.from, problem.to, 1, problem.mu}, false).span == Span::opposite;
}

std::vector<SolvedArc> lambert_arcs(const LambertProblem& problem, int most_revolutions) {
  std::vector<SolvedArc> arcs;
  for (const bool long_way : {false, true}) {
    for (int m = 0; m <= most_revolutions; ++m) {
      for (const LambertBranch branch : {LambertBranch::low, LambertBranch::high}) {
        if (m == 0 && branch == LambertBranch::high) continue;
        SolvedArc one{{long_way, m, branch}, {}};
        one.solution = solve_lambert(problem, one.arc);
        if (one.solution.status.ok())
          arcs.push_back(std::move(one));
        else if (one.solution.status.outcome() == Outcome::infeasible)
          m = most_revolutions;  // more revolutions take longer
      }
    }
  }
  return arcs;
}

}  // namespace nlmech::orbit
