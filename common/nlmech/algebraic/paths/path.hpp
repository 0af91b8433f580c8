/// @file
/// Path following (numerical continuation) for equations with a load parameter, through limit and bifurcation
/// points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "nlmech/algebraic/paths/path_system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::algebraic {

/// Options of path following.
///
/// Lengths are in scaled unknowns: |S dx|^2 + (c dload)^2, with S of scale_of() and c such that a load counts
/// as much as the displacements it causes at the start. The predictor follows the tangent. The corrector is
/// Newton's iteration with one constraint:
///
///     riks       the normal plane of the tangent (Riks 1979)
///     crisfield  the sphere about the last point; of the two points where the linearised path meets it, the
///                one that turns less (Crisfield 1981)
///     gdc        no displacement along the displacements of the last step; the length of a step follows the
///                generalised stiffness parameter (Yang and Shieh 1990)
///
/// All three reject a step and halve its size if the iteration fails, if the tangent has turned by more than
/// 1.5 `turn`, or if the new point may lie on another path (see Path). The step-size control of riks and
/// crisfield aims at `turn`.
struct PathMethod {
  /// Constraint of the corrector.
  enum class Kind : std::uint8_t {
    riks,       ///< normal plane
    crisfield,  ///< sphere or cylinder
    gdc         ///< generalised displacement control
  };
  Kind kind = Kind::riks;  ///< constraint of the corrector
  double first = 0.05;     ///< load increment of the first step, positive
  double turn = 0.3;       ///< target rotation of the tangent in a step, rad; positive, at most 1
  double longest = 1e6;    ///< largest step size, in units of the first; positive
  double shortest = 1e-9;  ///< smallest step size over the first, in (0, 1); below it `step_underflow`
  int iterations = 10;     ///< limit of corrections of a step
  int aim = 4;             ///< target number of corrections for the step-size control of riks and crisfield
  Eigen::VectorXd scale = {};  ///< diagonal of S, positive; empty: chosen
};

/// A point of a path.
struct PathPoint {
  Eigen::VectorXd x;          ///< unknowns
  double load = 0;            ///< parameter
  double arc = 0;             ///< arc length from the start as a sum of chords, scaled
  double slope = 0;           ///< c dload/ds along the path, in [-1, 1]: 0 at a limit point
  Eigen::Index negative = 0;  ///< number of negative eigenvalues of K (if not symmetric: 1 if det K < 0)
  int sign = 0;   ///< sign of the determinant of K bordered by q and the tangent; changes at bifurcations
  PathVector at;  ///< the same point, scaled
  PathVector tangent;       ///< unit tangent, scaled, in the direction of travel
  bool is_rounded = false;  ///< is the sign of an eigenvalue of K lost in double rounding?
};

/// Type of a point of a path.
enum class PointKind : std::uint8_t {
  step,        ///< regular point at the end of a step
  maximum,     ///< maximum of the load along the path
  minimum,     ///< minimum of the load along the path
  bifurcation  ///< crossing with other branches
};

/// A point of a path where dF/dx is singular.
struct CriticalPoint {
  using Kind = PointKind;         ///< types of points
  Kind kind = Kind::bifurcation;  ///< type of the point; not a step
  PathPoint point;            ///< the point; `negative` may include an eigenvalue that is zero to rounding
  Eigen::VectorXd direction;  ///< null vector of dF/dx, in the units of x, of norm 1
  /// Number of eigenvalues of dF/dx that change sign, as far as known; 0 at a bifurcation where the load of
  /// the path has an extremum: the vanishing eigenvalue keeps its sign.
  Eigen::Index vanishing = 1;
  PathVector across = {};  ///< scaled tangent of the other branch, if one eigenvalue vanishes
};

/// "step", "maximum", "minimum", "bifurcation".
[[nodiscard]] std::string_view to_string(PointKind kind) noexcept;

struct PathChanges;

/// Path tracer: follows one path step by step.
///
/// A step is accepted as one along the same path, not a jump to a neighbouring one, if
/// - Newton's iteration converges, within the distance from the predictor that `turn` allows;
/// - the tangents at both ends differ, and the chord differs from the first, by at most the allowed turn;
/// - the chord bisects the angle of the tangents within 0.02, as for an arc; a jump to a parallel branch at
///   distance d is off by d over the length of the chord. Otherwise, and whenever a sign has changed, the
///   middle of the Hermite cubic must be within 1 % of the step from a solution, with a number of negative
///   eigenvalues between those of the ends;
/// - each change in the number of negative eigenvalues of dF/dx, and of the sign of the slope, belongs to a
///   limit or bifurcation point found in the step: dF/dx is singular there to 1e-5 of its norm, and the path
///   continues through it without a gap of more than 1e-3 of the step.
/// Otherwise the step is rejected and halved. These tests miss a jump of less than 2 % of a step between
/// branches with equal numbers of negative eigenvalues.
///
/// A secondary branch may pass through its own bifurcation point, such as the buckled branch of a column: its
/// load has an extremum there and no eigenvalue changes sign. refine_fork() finds such a point; it is listed
/// as one bifurcation.
///
/// Tests check F = 0 at points (1e-13), limit loads to 4 eps, also for two limit points within one step, and
/// bifurcation points to 1e-13 (next to others to 1e-7 of a step). They compare runs past neighbouring
/// branches, with much too long first steps, with the path that short steps follow.
class Path {
 public:
  /// @param method options
  /// @param equations must outlive this object
  /// @param x near a solution for @p load
  /// @param load load at the start
  /// @throws std::invalid_argument if an option is out of range or x has another size than the equations
  Path(const PathMethod& method, Loaded& equations, const Eigen::VectorXd& x, double load);

  /// Corrects the start at its load and computes the first tangent, towards greater or smaller loads.
  /// @param upwards towards greater loads?
  /// @return success, or `non_finite`, `not_converged`, `singular_matrix`
  [[nodiscard]] Status start(bool upwards = true);
  /// Takes one step. On failure now() and before() are unchanged.
  /// @return success; `step_underflow` if no step is short enough; `wrong_branch` if the equations report
  /// another branch within a thousandth of a first step ahead; `non_finite`
  [[nodiscard]] Status advance();
  /// Undoes the last step; the next one is a quarter as long. before() is not valid until then.
  /// @return false, without effect, if that step would be below the smallest step size
  [[nodiscard]] bool take_back();
  /// The last point.
  [[nodiscard]] const PathPoint& now() const { return now_; }
  /// The previous point.
  [[nodiscard]] const PathPoint& before() const { return before_; }

  /// Is there a limit point between before() and now()? Their slopes have different signs.
  [[nodiscard]] bool has_passed_fold() const { return (before_.slope > 0) != (now_.slope > 0); }

  /// The point between before() and now() at the fraction @p part of the step, measured along the tangent of
  /// before().
  [[nodiscard]] Outcome between(double part, PathPoint& out);
  /// The limit point between before() and now(), to the rounding of F: bracketing, then refine_fold().
  /// @return success; `not_converged` if there is none
  [[nodiscard]] Outcome fold(PathPoint& out);
  /// All limit points between before() and now(), in order: one if the slope changes sign; or a pair inside
  /// the step, searched for only if the parabola through the slopes at the ends and the mean slope falls to
  /// half of both or below.
  [[nodiscard]] Outcome folds(std::vector<PathPoint>& out);
  /// The point with the given load between @p begin and @p end, which lie in the interval from before() to
  /// now(). The loads at @p begin and @p end must bracket
  /// @p load, if their loads are on both sides of it or one is at it. Newton's iteration at that load ends
  /// it.
  [[nodiscard]] Outcome crossing(double load, const PathPoint& begin, const PathPoint& end, PathPoint& out);
  /// All points between before() and now() where dF/dx is singular, in order: limit points as in folds(), and
  /// bifurcation points by the number of negative eigenvalues (for equations that are not symmetric, by the
  /// sign of the determinant). Points within 1e-7 of a step count as one. Two that cancel each other within a
  /// step are searched for at seven inner points, and where an eigenvalue comes near zero between them.
  [[nodiscard]] Outcome critical_points(std::vector<CriticalPoint>& out);
  /// Switches to the other branch: corrects the point at the distance @p length (scaled; negative: opposite
  /// direction) along CriticalPoint::across from a bifurcation. The path continues from there, away from the
  /// bifurcation.
  [[nodiscard]] Status switch_branch(const PathPoint& point, const PathVector& across, double length);
  /// Newton's iteration at the fixed load of @p point, down to rounding.
  [[nodiscard]] Outcome polish(PathPoint& point);

  /// Evaluations and factorisations so far; steps, rejected ones, Newton's iterations.
  [[nodiscard]] const Statistics& statistics() const { return system_.statistics; }
  /// |F| of the last residual.
  [[nodiscard]] double residual_norm() const { return system_.residual_norm(); }
  /// The scaled system.
  [[nodiscard]] PathSystem& system() { return system_; }

 private:
  /// Newton's iteration for F = 0 in the plane through @p at normal to @p normal.
  [[nodiscard]] Outcome correct_in_plane(const PathVector& normal, double size, PathVector& at, int& count);
  [[nodiscard]] double noise_at(const PathVector& normal, const PathVector& at);
  /// Newton's iteration for F = 0 on Crisfield's sphere about now_.
  [[nodiscard]] Outcome correct_on_sphere(double length, PathVector& at, int& count);
  [[nodiscard]] Outcome step(double length, PathPoint& next, int& count);
  /// Computes all members of a point from its position; the tangent points along @p direction.
  [[nodiscard]] Outcome describe(const PathVector& direction, PathPoint& point);
  [[nodiscard]] Outcome start_tangent(const PathVector& along);
  [[nodiscard]] double proposed() const;
  void adapt(double length, double angle, int count);
  [[nodiscard]] bool is_continuous(const PathPoint& next, const PathChanges& changes);
  [[nodiscard]] bool go_to(const PathPoint& next);
  [[nodiscard]] bool is_other_branch() const;
  /// Bracket of a zero: a function of the fraction of the step, with different signs at both ends.
  struct Bracket {
    double low, low_value, high, high_value;
  };
  /// Narrows a bracket of value() down to @p width; @p out is the last point.
  [[nodiscard]] Outcome narrow(const std::function<double(const PathPoint&)>& value, double width,
                               Bracket& bracket, PathPoint& out);
  [[nodiscard]] Outcome fold_in(Bracket bracket, PathPoint& out);
  /// Bracket of a change of sign of the slope inside the step, when both ends have the same sign.
  [[nodiscard]] Outcome slope_between(std::optional<Bracket>& first);
  [[nodiscard]] Outcome branch_in(Bracket bracket, PathPoint& out, Eigen::VectorXd& direction);
  [[nodiscard]] Outcome settle_branch(PathPoint& point);
  /// Position within a step with the signs that identify critical points.
  struct Mark {
    double part, slope;
    Eigen::Index negative;
    int sign;
    bool is_rounded;
  };
  [[nodiscard]] Mark mark(double part, const PathPoint& point) const;
  [[nodiscard]] bool is_of_rounding(const Mark& low, const Mark& high, PathPoint& fold);
  /// The bifurcation between two positions at which the load has an extremum.
  [[nodiscard]] Outcome bifurcation_in(const Mark& low, const Mark& high, std::vector<CriticalPoint>& out);
  [[nodiscard]] Outcome critical_in(const Mark& low, const Mark& high, std::vector<CriticalPoint>& out);
  [[nodiscard]] Outcome add_critical(CriticalPoint::Kind kind, Eigen::Index vanishing, const PathPoint& point,
                                     std::vector<CriticalPoint>& out);
  /// Magnitudes of the greatest negative and the smallest positive eigenvalue.
  struct AroundZero {
    double negative, positive;
  };
  [[nodiscard]] AroundZero around_zero();
  [[nodiscard]] std::optional<double> extremum_between(double low, double high, double AroundZero::*side,
                                                       Eigen::Index negative);
  void split_between(double low, double high, Eigen::Index first, Eigen::Index last,
                     std::vector<double>& parts);
  [[nodiscard]] Outcome split_points(std::vector<double>& parts);
  [[nodiscard]] bool is_change_at(double part, CriticalPoint::Kind kind);
  [[nodiscard]] double part_of(const PathPoint& point) const;
  [[nodiscard]] double expected_slope(double part) const;
  [[nodiscard]] Outcome interpolate(const std::function<double(const PathPoint&)>& value, double farthest,
                                    PathPoint& out);
  [[nodiscard]] Status failure(Outcome outcome, const char* what) const;

  PathMethod method_;
  PathSystem system_;
  PathPoint now_, before_, earlier_;
  PathVector step_, previous_tangent_;
  Eigen::VectorXd rest_, free_, forced_;
  std::optional<PathVector> separated_, separated_before_;  // last bifurcation perturbed by rounding
  std::vector<CriticalPoint> critical_;  // between before_ and now_, without pairs that no sign shows
  double first_length_ = 0, length_ = 0, factor_ = 1, greatest_ = 0;
};

/// Follows a path until @p is_done returns true (evaluated before every step) and collects its critical
/// points. A step whose critical points are not found is rejected and repeated shorter.
/// @param path a started path; its now() is the last point afterwards
/// @param steps limit of steps
/// @param found receives the critical points, in order
/// @return success; `step_limit`; the failures of Path::advance(); `not_converged` if no critical point is
/// found for a change of signs; a failure that the equations report for a point, such as `wrong_branch`
[[nodiscard]] Status follow(Path& path, const std::function<bool(const Path&)>& is_done, std::int64_t steps,
                            std::vector<CriticalPoint>& found);

}  // namespace nlmech::algebraic
