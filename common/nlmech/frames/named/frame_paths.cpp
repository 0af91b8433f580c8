#include "nlmech/frames/named/frame_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::frames {
namespace {

using algebraic::CriticalPoint;
using algebraic::Path;
using algebraic::PathPoint;

/// A bifurcation point, and which halves of its other branch remain to be followed.
struct Crossing {
  PathPoint point;
  algebraic::PathVector direction;  ///< tangent of the other branch, scaled
  Eigen::VectorXd mode;             ///< as in FramePoint
  Eigen::Index negative;            ///< as in FramePoint
  int branch;                       ///< branch on which it was found
  Eigen::Index vanishing;           ///< as in FramePoint
  bool is_open[2] = {true, true};
};

/// Follows all branches.
class PathTracer {
 public:
  PathTracer(LoadedFrame& equations, const PathOptions& how, const Eigen::VectorXd& start)
      : how_(how),
        equations_(equations),
        first_(std::min(equations.first_load(start), std::abs(how.until.value_or(HUGE_VAL)) / 20)),
        path_({.first = first_,
               .turn = how.turn,
               .longest = 1e12,
               .iterations = 16,
               .aim = 8,
               .scale = equations.scale()},
              equations, start, 0) {
    std::sort(how_.at.begin(), how_.at.end());
  }

  FramePaths all() {
    Status status = path_.start(how_.until.value_or(1) > 0);
    if (status.ok() && path_.now().negative > 0)
      status = failed_with(Outcome::singular_matrix,
                           "frame: {} eigenvalues of the stiffness without load are negative by rounding: "
                           "elements are too short, or stiffnesses differ too much; take fewer elements",
                           path_.now().negative);
    if (status.ok()) status = along(0);
    note(status);
    for (std::size_t i = 0; i < crossings_.size() && out_.status.outcome() != Outcome::time_limit; ++i) {
      for (const int half : {0, 1}) follow_half(i, half);
    }
    out_.statistics = path_.statistics();
    return std::move(out_);
  }

 private:
  void note(const Status& status) {
    if (out_.status.ok() && !status.ok()) out_.status = status;
  }

  void follow_half(std::size_t i, int half) {
    if (!crossings_[i].is_open[half]) return;
    if (crossings_[i].vanishing > 1) return;
    if (out_.branches >= how_.branches) {
      ++out_.unfollowed;
      return;
    }
    crossings_[i].is_open[half] = false;
    const Crossing from = crossings_[i];
    const int branch = out_.branches + 1;
    Status status = start_branch(from, half);
    if (status.ok()) {
      out_.branches = branch_ = branch;
      first_size_ = greatest_ = 0;
      include_load(from.point.load);
      add(FramePoint::Kind::bifurcation, from.point, from.negative, from.mode, from.vanishing);
      status = along(branch);
    }
    note(status);
  }

  /// Switches to a branch: tries distances of 0.02 (of the size of the frame, or rad) and smaller.
  Status start_branch(const Crossing& from, int half) {
    // If the branch changes the load to first order, limit its change to a first step.
    const double step = std::abs(from.direction.m) / (first_ * path_.system().load_scale()),
                 farthest = std::max(from.direction.y.cwiseAbs().maxCoeff(), 0.02 * step);
    const auto go = [&](double reach) {
      return path_.switch_branch(from.point, from.direction, (half == 0 ? reach : -reach) / farthest);
    };
    Status status;
    double reach = 0.02;
    for (; reach > 1e-7; reach /= 4) {
      status = go(reach);
      if (status.ok()) break;
    }
    // The vanishing eigenvalue may have either sign. If the number of negative eigenvalues differs from that
    // at a smaller distance, a bifurcation point lies between: start at the smaller distance.
    for (int nearer = 0; status.ok() && nearer < 2; ++nearer) {
      const Eigen::Index negative = path_.now().negative;
      if (!go(reach / 16).ok()) return go(reach);
      const Eigen::Index closer = path_.now().negative;
      if (closer == negative) return go(reach);
      reach /= 16;
      if (closer == from.negative || closer == from.negative + 1) break;
    }
    return status;
  }

  /// Follows the path from now() to the end of the branch.
  Status along(int branch) {
    branch_ = branch;
    listed_ = 0;
    met_.clear();
    begin_ = out_.points.size();
    Status status = follow(
        path_, [this](const Path&) { return list(); }, how_.steps, met_);
    if (!lost_.ok()) return std::exchange(lost_, {});
    if (status.outcome() == Outcome::step_limit) return after_all_steps();
    // Near a crossing of branches the sign of the vanishing eigenvalue is rounding: end at a known
    // bifurcation ahead.
    if (!status.ok() && status.outcome() != Outcome::step_limit) {
      if (Crossing* const met = ahead()) {
        arrive(*met);
        status = {};
      }
    }
    return status.outcome() == Outcome::step_underflow ? step_failure(status) : status;
  }

  /// Status of a path with step-size underflow: reports a beam-column shortened to zero length, or load
  /// factors whose squares underflow.
  [[nodiscard]] Status step_failure(const Status& status) const {
    const auto [left, x, y] = equations_.shortest(path_.now().x, path_.now().load);
    if (left < 1e-3)
      return failed_with(
          status.outcome(),
          "frame: at a load factor of {:.10g} a beam-column at ({:.6g}, {:.6g}) has {:.1e} of its "
          "length left, and the path ends: members shorten in proportion to their force, down to zero length",
          path_.now().load, x, y, left);
    if (first_ < 1e-140)
      return failed_with(status.outcome(),
                         "frame: the load factors of steps, {:.2g}, are too small to be squared; take "
                         "smaller loads and greater factors",
                         first_);
    return status;
  }

  /// Status of a branch that reaches the step limit.
  [[nodiscard]] Status after_all_steps() const {
    const double end = end_load();
    return failed_with(
        Outcome::step_limit,
        "frame: {} steps end at a load factor of {:.10g}, {}; allow more steps, or longer ones "
        "(turn){}",
        how_.steps, path_.now().load,
        std::isfinite(end) ? fmt::format("before {:.10g}", end)
                           : std::string("before the requested limit or branch point"),
        how_.until ? "" : ", or give the load factor at which it ends (until)");
  }

  /// Would another step of the duration of the last one exceed the time limit?
  bool exceeds_time() {
    const double now = time_.seconds(), last = now - std::exchange(asked_, now);
    if (now + last <= how_.seconds) return false;
    lost_ = failed_with(Outcome::time_limit,
                        "frame: the time limit is reached at a load factor of {:.10g}, after {:.3g} s; allow "
                        "more time, or longer steps (turn)",
                        path_.now().load, now);
    return true;
  }

  [[nodiscard]] double end_load() const {
    if (how_.until) return std::abs(*how_.until);
    return greatest_ > 0 && how_.critical == 0 ? 2 * greatest_ : std::numeric_limits<double>::infinity();
  }

  /// Updates the end load by the load of a limit or bifurcation point. Loads beyond twice the first do not
  /// count: a slender frame has infinitely many. The first one must exceed a thousandth of a first step.
  void include_load(double load) {
    const double size = std::abs(load);
    if (first_size_ == 0 && size > 1e-3 * first_) first_size_ = size;
    if (size <= 2 * first_size_) greatest_ = std::max(greatest_, size);
  }

  /// Records the points of the last step. @return true at the end of the branch
  bool list() {
    PathPoint before = path_.before();
    Eigen::Index negative = before.negative;
    const Eigen::Index change = direction_of_step();
    for (; listed_ < met_.size(); ++listed_) {
      const CriticalPoint& c = met_[listed_];
      add_requested(before, c.point);
      if (has_ended(before, c.point)) return true;
      if (Crossing* const met = known(c)) {
        arrive(*met);
        return true;
      }
      const Eigen::Index next = negative + change * c.vanishing,
                         least = c.vanishing == 0 ? c.point.negative
                                 : change != 0    ? std::min(negative, next)
                                                  : std::min(negative, c.point.negative);
      const Eigen::Index vanishing = std::max<Eigen::Index>(c.vanishing, 1);
      add(c.kind, c.point, least, c.direction, vanishing);
      include_load(c.point.load);
      if (c.kind == CriticalPoint::Kind::bifurcation)
        crossings_.push_back({c.point, c.across, c.direction, least, branch_, vanishing});
      if (branch_ == 0 && ++criticals_ == how_.critical) return true;
      before = c.point;
      if (c.vanishing > 0) negative = change != 0 ? next : c.point.negative;
    }
    if (out_.points.size() > begin_) {
      add_requested(before, path_.now());
      if (has_ended(before, path_.now())) return true;
    }
    add(FramePoint::Kind::step, path_.now(), path_.now().negative);
    return exceeds_time();
  }

  /// 1 if every critical point of the last step makes eigenvalues negative, -1 if positive, else 0.
  [[nodiscard]] Eigen::Index direction_of_step() const {
    Eigen::Index all = 0;
    for (std::size_t i = listed_; i < met_.size(); ++i) all += met_[i].vanishing;
    const Eigen::Index change = path_.now().negative - path_.before().negative;
    return all == 0 || std::abs(change) != all ? 0 : change / all;
  }

  /// Adds the points at the requested load factors between two points and before the end of the branch.
  void add_requested(const PathPoint& from, const PathPoint& to) {
    const double low = std::min(from.load, to.load), high = std::max(from.load, to.load), end = end_load();
    const auto add_at = [&](double load) {
      if (!(load > low && load < high && std::abs(load) < end)) return;
      PathPoint point;
      if (const Outcome outcome = path_.crossing(load, from, to, point); outcome != Outcome::success)
        lost_ = failed_with(
            outcome, "frame: the path has no point at the load factor {:.10g}; take shorter steps (turn)",
            load);
      else
        add_at_load(point, load);
    };
    if (from.load < to.load)
      std::for_each(how_.at.begin(), how_.at.end(), add_at);
    else
      std::for_each(how_.at.rbegin(), how_.at.rend(), add_at);
  }

  /// Does the branch reach its end load between two points? Records the end, or the failure in lost_.
  bool has_ended(const PathPoint& from, const PathPoint& to) {
    const double end = end_load();
    if (std::abs(to.load) < end) return false;
    PathPoint last;
    const Outcome outcome = path_.crossing(to.load < 0 ? -end : end, from, to, last);
    if (outcome == Outcome::success)
      add_at_load(last, to.load < 0 ? -end : end);
    else
      lost_ =
          failed_with(outcome,
                      "frame: between the load factors {:.10g} and {:.10g} the path has no point at {:.10g}, "
                      "where it should end: the two points are not on one path; take shorter steps (turn)",
                      from.load, to.load, to.load < 0 ? -end : end);
    return true;
  }

  /// Adds a point at a given load factor, which the scales of the path have rounded.
  void add_at_load(PathPoint& p, double load) {
    p.load = load;
    add(FramePoint::Kind::step, p, p.negative);
  }

  void add(FramePoint::Kind kind, const PathPoint& p, Eigen::Index negative, const Eigen::VectorXd& mode = {},
           Eigen::Index vanishing = 0) {
    out_.points.push_back({branch_, kind, p.load, equations_.whole(p.x, p.load), negative,
                           mode.size() > 0 ? equations_.shape(mode) : mode, vanishing});
  }

  /// Distance of two points, without full rotations of members.
  [[nodiscard]] double distance(const PathPoint& a, const PathPoint& b) const {
    Eigen::VectorXd y = a.at.y - b.at.y;
    equations_.remove_full_rotations(y);
    return algebraic::PathVector{std::move(y), a.at.m - b.at.m}.norm();
  }

  /// Ends the branch at a bifurcation point of another branch, and marks the half just followed as done.
  void arrive(Crossing& met) {
    add(FramePoint::Kind::bifurcation, met.point, met.negative, met.mode, met.vanishing);
    met.is_open[path_.before().tangent.dot(met.direction) > 0 ? 1 : 0] = false;
  }

  /// The bifurcation point found on another branch that equals a critical point of this one; null if none.
  Crossing* known(const CriticalPoint& c) {
    // The load may have an extremum at the crossing along this branch, so its point is less accurate than the
    // one found along the other branch.
    return nearest(c.point, 1e-3 * distance(path_.before(), path_.now()));
  }

  /// Known bifurcation point ahead, within two lengths of the last step; null if none.
  Crossing* ahead() {
    const PathPoint& before = path_.before();
    Crossing* const met = nearest(path_.now(), 2 * distance(before, path_.now()));
    if (met == nullptr) return nullptr;
    const algebraic::PathVector chord{met->point.at.y - before.at.y, met->point.at.m - before.at.m};
    return before.tangent.dot(chord) > 0 ? met : nullptr;
  }

  Crossing* nearest(const PathPoint& point, double least) {
    Crossing* found = nullptr;
    for (Crossing& k : crossings_) {
      if (k.branch == branch_) continue;
      const double off = distance(k.point, point);
      if (off > least) continue;
      least = off;
      found = &k;
    }
    return found;
  }

  PathOptions how_;
  const LoadedFrame& equations_;
  double first_;
  Path path_;
  FramePaths out_;
  std::vector<Crossing> crossings_;
  std::vector<CriticalPoint> met_;
  std::size_t listed_ = 0, begin_ = 0;
  double first_size_ = 0, greatest_ = 0, asked_ = 0;
  Stopwatch time_;
  Status lost_;
  int branch_ = 0, criticals_ = 0;
};

void require(const PathOptions& options) {
  if (options.steps < 1 || options.branches < 0 || options.critical < 0)
    throw invalid_argument("equilibrium_paths: {} steps, {} branches and {} critical points", options.steps,
                           options.branches, options.critical);
  for (const double load : options.at) {
    if (!std::isfinite(load)) throw invalid_argument("equilibrium_paths: at = {}; it must be finite", load);
  }
  if (options.until && !(*options.until != 0 && std::isfinite(*options.until)))
    throw invalid_argument("equilibrium_paths: until = {}; it must be finite and not 0", *options.until);
}

}  // namespace

FramePaths equilibrium_paths(const NamedFrame& frame, const PathOptions& options) {
  require(options);
  Start start = start_of(frame, options);
  if (!start.status.ok()) {
    FramePaths failed;
    failed.status = std::move(start.status);
    return failed;
  }
  LoadedFrame equations(frame);
  return PathTracer(equations, options, equations.free(start.x)).all();
}

Start start_of(const NamedFrame& frame, const PathOptions& options) {
  Start start{Eigen::VectorXd::Zero(frame.frame.size()), {}};
  if (frame.steady.size() == 0) return start;
  NamedFrame growing = frame;
  growing.load = std::exchange(growing.steady, {});
  growing.displacement.setZero();
  FramePaths paths = equilibrium_paths(
      growing,
      {.steps = options.steps, .until = 1, .turn = options.turn, .critical = 1, .seconds = options.seconds});
  const auto critical = std::ranges::find_if(
      paths.points, [](const FramePoint& p) { return p.kind != FramePoint::Kind::step; });
  start.status = std::move(paths.status);
  if (critical != paths.points.end())
    start.status =
        failed_with(Outcome::wrong_branch,
                    "frame: at {:.6g} of the constant loads, before any others, the frame reaches a {}; "
                    "take smaller constant loads, or let them grow",
                    critical->load, to_string(critical->kind));
  else if (start.status.ok())
    start.x = paths.points.back().x;
  return start;
}

namespace {

/// Displacements x and y of the nodes for a shape.
std::vector<Node> displacements_of(const Frame& frame, const Eigen::VectorXd& shape) {
  std::vector<Node> all;
  const auto at = [&](Eigen::Index i) { return i < 0 ? 0 : shape[i]; };
  for (int node = 0; node < static_cast<int>(frame.nodes().size()); ++node)
    all.push_back({at(frame.unknown(node, Motion::x)), at(frame.unknown(node, Motion::y))});
  return all;
}

}  // namespace

double factor_of(const Frame& frame, const Eigen::VectorXd& shape) {
  const std::vector<Node> moves = displacements_of(frame, shape);
  double most = 0;
  for (const Node& m : moves) most = std::max({most, std::abs(m.x), std::abs(m.y)});
  double across = 0;  // by the rotations, over the members' lengths
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    const Member& m = frame.members()[i];
    const Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
               &b = frame.nodes()[static_cast<std::size_t>(m.second)];
    const Vector<double, 6> d = frame.ends<double>(shape, i);
    across = std::max(across, std::hypot(b.x - a.x, b.y - a.y) * std::max(std::abs(d[2]), std::abs(d[5])));
  }
  if (most <= 1e-9 * across) return HUGE_VAL;
  for (const Node& m : moves) {
    for (const double part : {m.x, m.y}) {
      if (std::abs(part) >= (1 - 1e-6) * most) return 1 / std::copysign(most, part);
    }
  }
  return HUGE_VAL;
}

Imperfect imperfect(const NamedFrame& perfect, const Imperfection& imperfection, const PathOptions& options) {
  const auto& [mode, amplitude] = imperfection;
  if (mode < 1 || !std::isfinite(amplitude))
    throw invalid_argument("imperfect: mode {} with the amplitude {}; modes are numbered from 1", mode,
                           amplitude);
  PathOptions how = options;
  how.branches = 0;
  how.critical = mode;
  const FramePaths paths = equilibrium_paths(perfect, how);
  Imperfect out{perfect, {}, paths.status};
  int met = 0;
  for (const FramePoint& p : paths.points) {
    if (p.kind != FramePoint::Kind::step && ++met == mode) out.buckled = p;
  }
  if (met < mode) {
    if (out.status.ok() || out.status.outcome() == Outcome::step_limit)
      out.status = Status::failure(
          Outcome::not_converged,
          fmt::format(
              "imperfection: the perfect frame has {} limit and branch points in {} steps, and mode {} "
              "is beyond these; take more steps, or a lower mode",
              met, options.steps, mode));
    return out;
  }
  out.status = {};
  const std::vector<Node> moves = displacements_of(perfect.frame, out.buckled.mode);
  const double factor = amplitude * factor_of(perfect.frame, out.buckled.mode);
  if (!std::isfinite(factor)) {
    out.status =
        Status::failure(Outcome::not_converged,
                        "imperfection: the mode only rotates nodes and displaces none; take another mode");
    return out;
  }
  std::vector<Node> nodes = perfect.frame.nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].x += factor * moves[i].x;
    nodes[i].y += factor * moves[i].y;
  }
  out.frame.frame =
      Frame(std::move(nodes), perfect.frame.members(), perfect.supports, perfect.frame.springs());
  out.frame.load = out.frame.growing.on_unknowns(out.frame.frame);
  if (out.frame.steady.size() > 0) out.frame.steady = out.frame.constant.on_unknowns(out.frame.frame);
  return out;
}

}  // namespace nlmech::frames
