/// @file
/// Following the path of solutions of equations with a parameter, through limit points and past branches.
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

/// How to step along a path.
///
/// Lengths are of scaled unknowns: |S dx|^2 + (c dload)^2, with S of scale_of() and c such that a load counts
/// as much as the displacements it causes at the start. A step goes along the tangent and is corrected by
/// Newton's iteration with one more condition:
///
///     riks       the normal plane of the tangent (Riks 1979)
///     crisfield  the sphere about the last point; of the two points where the linearised path meets it, the
///                one that turns less (Crisfield 1981)
///     gdc        no displacement along the displacements of the last step; the length of a step follows the
///                generalised stiffness parameter (Yang and Shieh 1990)
///
/// In all three a step is repeated at half its length if the iteration fails, the path has turned by more
/// than 1.5 `turn`, or the new point cannot be told to lie on the same path (see Path); steps of riks and
/// crisfield are chosen for that turn.
struct PathMethod {
  /// Which condition.
  enum class Kind : std::uint8_t {
    riks,       ///< normal plane
    crisfield,  ///< sphere or cylinder
    gdc         ///< generalised displacement control
  };
  Kind kind = Kind::riks;      ///< which condition
  double first = 0.05;         ///< load of the first step, positive
  double turn = 0.3;           ///< of the tangent in a step, as it should be, rad; positive
  double longest = 1e6;        ///< no step is longer than so many first steps; positive
  double shortest = 1e-9;      ///< a step shorter than so many first steps is `step_underflow`
  int iterations = 10;         ///< limit of corrections of a step
  int aim = 4;                 ///< steps of riks and crisfield are chosen for so many of them at most
  Eigen::VectorXd scale = {};  ///< diagonal of S, positive; empty: chosen
};

/// A solution on a path.
struct PathPoint {
  Eigen::VectorXd x;          ///< unknowns
  double load = 0;            ///< parameter
  double arc = 0;             ///< length of the path from its start, as a sum of chords, scaled
  double slope = 0;           ///< c dload/ds along the path, in [-1, 1]: 0 at a limit point
  Eigen::Index negative = 0;  ///< negative eigenvalues of K (if not symmetric: is det K < 0?)
  int sign = 0;               ///< of the determinant of K bordered by q and the tangent: changes at branches
  PathVector at;              ///< the same point, scaled
  PathVector tangent;         ///< unit tangent, scaled, along the walk
  bool is_rounded = false;    ///< is an eigenvalue of K that near to zero that double does not tell its sign?
};

/// A point of a path where dF/dx is singular.
struct CriticalPoint {
  /// What the path does there.
  enum class Kind : std::uint8_t {
    maximum,     ///< of the load, along the walk
    minimum,     ///< of the load, along the walk
    bifurcation  ///< other branches leave the path
  };
  Kind kind = Kind::bifurcation;  ///< which
  PathPoint point;                ///< where; `negative` may count an eigenvalue that is zero but for rounding
  Eigen::VectorXd direction;      ///< null vector of dF/dx there, in the units of x, of length 1
  /// Eigenvalues of dF/dx that change their signs there, as far as is known; 0 at a bifurcation where the
  /// load of the path has an extremum, so that the one that vanishes returns.
  Eigen::Index vanishing = 1;
  PathVector across =
      {};  ///< of a bifurcation: tangent of the other branch, scaled, if one eigenvalue vanishes
};

/// "maximum", "minimum", "bifurcation".
[[nodiscard]] std::string_view to_string(CriticalPoint::Kind kind) noexcept;

struct PathChanges;

/// A walk along a path.
///
/// A step is taken for one along the same path, and not for a jump to a neighbouring one, if
/// - Newton's iteration converges from the predictor, not farther from it than the turn allows;
/// - tangents at both ends differ, and the chord from the first, by no more than the turn allows;
/// - the chord halves the angle of the tangents, within 0.02: an arc's does, and the chord of a jump to a
///   parallel branch at a distance d is off by d over its length. Else the middle of the cubic through both
///   points with their tangents, which is the same from either end, is within 1 % of the length of a
///   solution, with a number of negative eigenvalues between theirs; that is asked, too, if a sign has
///   changed;
/// - each change in the number of negative eigenvalues of dF/dx, and of the sign of the slope, is that of a
///   limit or branch point which is found between: dF/dx is singular there, to 1e-5 of its norm, and the
///   path goes on through it without a gap of more than 1e-3 of the step.
/// Else it is shortened. What none of this sees is a jump of less than 2 % of a step between branches with as
/// many negative eigenvalues.
///
/// A branch may reach a bifurcation where it leaves from, as the bent one of a column does: there its load
/// has an extremum and no eigenvalue changes its sign. Such a point is found by refine_fork() and listed as
/// one bifurcation.
///
/// Tests hold points to F = 0 (1e-13), limit loads to 4 eps, also of two limit points within one step, and
/// branch points to 1e-13 (next to other ones to 1e-7 of a step); and walks past neighbouring branches, with
/// first steps far too long, to the path that short steps follow.
class Path {
 public:
  /// @param method how to step
  /// @param equations must outlive this object
  /// @param x near a solution for @p load
  /// @param load where to start
  /// @throws std::invalid_argument if an option is out of range or x has another size than the equations
  Path(const PathMethod& method, Loaded& equations, const Eigen::VectorXd& x, double load);

  /// Corrects the start at its load, and sets out towards greater loads, or smaller ones.
  /// @param upwards towards greater loads?
  /// @return success, or `non_finite`, `not_converged`, `singular_matrix`
  [[nodiscard]] Status start(bool upwards = true);
  /// One step. On failure now() and before() are as they were.
  /// @return success; `step_underflow` if no step is short enough; `wrong_branch` if what lies ahead is what
  /// the equations call another branch, up to a thousandth of a first step; `non_finite`
  [[nodiscard]] Status advance();
  /// Goes back to before(), from where the next step is a quarter as long; before() is of no use until then.
  /// @return false, and nothing is done, if that step would be shorter than the shortest
  [[nodiscard]] bool take_back();
  /// The last point.
  [[nodiscard]] const PathPoint& now() const { return now_; }
  /// The point before it.
  [[nodiscard]] const PathPoint& before() const { return before_; }

  /// Is there a limit point between before() and now()? Their slopes have different signs.
  [[nodiscard]] bool has_passed_fold() const { return (before_.slope > 0) != (now_.slope > 0); }

  /// The point between before() and now() whose place along the tangent of before() is a part @p part of
  /// that of now().
  [[nodiscard]] Outcome between(double part, PathPoint& out);
  /// The limit point between them, by bisection and refine_fold(), to the rounding of F.
  /// @return success; `not_converged` if there is none
  [[nodiscard]] Outcome fold(PathPoint& out);
  /// All limit points between them, in order: the one that a change of sign shows; or a pair within the step,
  /// which no sign shows, if the slope as the ends and the mean tell it comes down by half or more there.
  [[nodiscard]] Outcome folds(std::vector<PathPoint>& out);
  /// A point between @p begin and @p end, which lie between before() and now() or are these, where the load
  /// is
  /// @p load, if their loads are on both sides of it or one is at it. Newton's iteration at that load ends
  /// it.
  [[nodiscard]] Outcome crossing(double load, const PathPoint& begin, const PathPoint& end, PathPoint& out);
  /// All points between them where dF/dx is singular, in order: limit points as folds() finds them, and
  /// branch points by the number of negative eigenvalues (of equations that are not symmetric, by the sign of
  /// the determinant). Those within 1e-7 of a step count as one. Two that
  /// undo each other within a step are looked for at seven places inside, and where an eigenvalue comes down
  /// to near zero between them.
  [[nodiscard]] Outcome critical_points(std::vector<CriticalPoint>& out);
  /// Goes over to the other branch: to the solution at a distance @p length (scaled; negative: the other way)
  /// along CriticalPoint::across from a bifurcation; the walk goes on from there, away from the point.
  [[nodiscard]] Status switch_branch(const PathPoint& point, const PathVector& across, double length);
  /// Solves at the load of now(), or any point, by Newton's iteration down to rounding.
  [[nodiscard]] Outcome polish(PathPoint& point);

  /// Evaluations and factorisations so far; steps, rejected ones, Newton's iterations.
  [[nodiscard]] const Statistics& statistics() const { return system_.statistics; }
  /// |F| of the residual computed last.
  [[nodiscard]] double residual_norm() const { return system_.residual_norm(); }
  /// The scaled system.
  [[nodiscard]] PathSystem& system() { return system_; }

 private:
  /// Newton's iteration for F = 0 in the plane through @p at normal to @p normal.
  [[nodiscard]] Outcome correct_in_plane(const PathVector& normal, double size, PathVector& at, int& count);
  [[nodiscard]] double noise_at(const PathVector& normal, const PathVector& at);
  /// The same on Crisfield's sphere about now_.
  [[nodiscard]] Outcome correct_on_sphere(double length, PathVector& at, int& count);
  [[nodiscard]] Outcome step(double length, PathPoint& next, int& count);
  /// Fills all members of a point from its place; the tangent goes along @p direction.
  [[nodiscard]] Outcome describe(const PathVector& direction, PathPoint& point);
  [[nodiscard]] Outcome start_tangent(const PathVector& along);
  [[nodiscard]] double proposed() const;
  void adapt(double length, double angle, int count);
  [[nodiscard]] bool is_continuous(const PathPoint& next, const PathChanges& changes);
  [[nodiscard]] bool go_to(const PathPoint& next);
  [[nodiscard]] bool is_other_branch() const;
  /// A function of the part of a step that has different signs at two ends.
  struct Bracket {
    double low, low_value, high, high_value;
  };
  /// Narrows a bracket of value() down to @p width; @p out is the last point.
  [[nodiscard]] Outcome narrow(const std::function<double(const PathPoint&)>& value, double width,
                               Bracket& bracket, PathPoint& out);
  [[nodiscard]] Outcome fold_in(Bracket bracket, PathPoint& out);
  /// A part of the step where the slope has the other sign though it has the same at both ends.
  [[nodiscard]] Outcome slope_between(std::optional<Bracket>& first);
  [[nodiscard]] Outcome branch_in(Bracket bracket, PathPoint& out, Eigen::VectorXd& direction);
  [[nodiscard]] Outcome settle_branch(PathPoint& point);
  /// A place within a step, and what tells its neighbours apart.
  struct Mark {
    double part, slope;
    Eigen::Index negative;
    int sign;
    bool is_rounded;
  };
  [[nodiscard]] Mark mark(double part, const PathPoint& point) const;
  [[nodiscard]] bool is_of_rounding(const Mark& low, const Mark& high, PathPoint& fold);
  /// The bifurcation between two places at which the load has an extremum.
  [[nodiscard]] Outcome bifurcation_in(const Mark& low, const Mark& high, std::vector<CriticalPoint>& out);
  [[nodiscard]] Outcome critical_in(const Mark& low, const Mark& high, std::vector<CriticalPoint>& out);
  [[nodiscard]] Outcome add_critical(CriticalPoint::Kind kind, Eigen::Index vanishing, const PathPoint& point,
                                     std::vector<CriticalPoint>& out);
  /// Sizes of the greatest negative and the least positive eigenvalue.
  struct AroundZero {
    double negative, positive;
  };
  [[nodiscard]] AroundZero around_zero();
  [[nodiscard]] std::optional<double> dip_in(double low, double high, double AroundZero::*side,
                                             Eigen::Index negative);
  [[nodiscard]] Outcome splits(std::vector<double>& parts);
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
  std::optional<PathVector> parted_, parted_before_;  // the last bifurcation that rounding has parted
  std::vector<CriticalPoint> critical_;  // between before_ and now_, but for pairs that no sign shows
  double first_length_ = 0, length_ = 0, factor_ = 1, greatest_ = 0;
};

/// Walks on until @p is_done says so, asked before every step, and lists the critical points on the way. A
/// step whose critical points are not found is repeated, shorter.
/// @param path started; stands at its last point afterwards
/// @param steps at most so many
/// @param found gets the points, in order
/// @return success; `step_limit`; as Path::advance(); `not_converged` if a change of signs has no critical
/// point; what the equations say of a point, `wrong_branch` for one
[[nodiscard]] Status follow(Path& path, const std::function<bool(const Path&)>& is_done, std::int64_t steps,
                            std::vector<CriticalPoint>& found);

}  // namespace nlmech::algebraic
