#include "nlmech/frames/named/mesh_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/frames/loaded_frame.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::frames {
namespace {

using Points = std::vector<FramePoint>;

constexpr double largest_load_difference = 0.5;  // relative; critical points with a greater one differ

/// A range of points of a branch between two limit or bifurcation points of both meshes.
struct Stretch {
  std::size_t begin, end;  ///< indices of points, both included
};

/// First and last point of a branch, if it has any.
std::optional<Stretch> branch_of(const Points& points, int branch) {
  const auto is_of = [&](const FramePoint& p) { return p.branch == branch; };
  const auto first = std::ranges::find_if(points, is_of);
  if (first == points.end()) return std::nullopt;
  const auto behind = std::find_if_not(first, points.end(), is_of);
  return Stretch{static_cast<std::size_t>(first - points.begin()),
                 static_cast<std::size_t>(behind - points.begin()) - 1};
}

/// Difference of the loads of two limit or bifurcation points, relative to the first.
double apart(const FramePoint& a, const FramePoint& b) {
  return a.load == b.load ? 0 : std::abs(a.load - b.load) / std::abs(a.load);
}

/// The greatest of some displacements (or forces) and its change from mesh to mesh: [0] along x and y, [1]
/// rotations (or moments).
class Changes {
 public:
  void add(Motion motion, double own, double other) {
    const std::size_t kind = motion == Motion::rotation ? 1 : 0;
    largest_[kind] = std::max(largest_[kind], std::abs(own));
    change_[kind] = std::max(change_[kind], std::abs(own - other));
  }
  /// The greater relative change of both kinds. Of a kind below 1e-6 of the other, which may be rounding, the
  /// change is relative to that. @param unit value of the first kind that compares with 1 of the second
  [[nodiscard]] double relative(double unit) const {
    const std::array least = {1e-6 * unit * largest_[1], 1e-6 / unit * largest_[0]};
    double worst = 0;
    for (const std::size_t kind : {0U, 1U}) {
      const double whole = std::max(largest_[kind], least[kind]);
      if (whole > 0) worst = std::max(worst, change_[kind] / whole);
    }
    return worst;
  }

 private:
  std::array<double, 2> largest_ = {}, change_ = {};
};

/// Compares the points of a mesh with the paths of the second one.
class Comparison {
 public:
  Comparison(const MeshPair& meshes, double seconds)
      : m_(meshes),
        second_(meshes.second),
        seconds_(seconds),
        errors_(meshes.paths.points.size()),
        scale_(second_.scale()) {}

  std::vector<std::optional<double>> all() {
    for (int branch = 0; branch <= m_.paths.branches; ++branch) {
      const auto own = branch_of(m_.paths.points, branch), other = branch_of(m_.compared.points, branch);
      if (own && other) compare(*own, *other);
    }
    return std::move(errors_);
  }

 private:
  /// Compares the points of a branch, from one shared limit or bifurcation point to the next.
  void compare(const Stretch& own, const Stretch& other) {
    const bool is_whole = m_.compared.status.ok();
    std::size_t begin = own.begin, reached = other.begin, from = reached;
    for (std::size_t i = own.begin; i <= own.end; ++i) {
      if (m_.paths.points[i].kind == FramePoint::Kind::step) continue;
      const auto met = same_point(m_.paths.points[i], {from, other.end});
      if (met) errors_[i] = share(apart(m_.paths.points[i], m_.compared.points[*met]));
      if (!met && is_whole) errors_[i] = 1;
      if (!met) continue;
      compare_steps({begin, i}, {reached, *met}, true);
      begin = i, reached = *met, from = reached + 1;
    }
    compare_steps({begin, own.end}, {reached, other.end}, is_whole);
  }

  /// The limit or bifurcation point of the second mesh that corresponds to one of the first.
  [[nodiscard]] std::optional<std::size_t> same_point(const FramePoint& p, const Stretch& among) const {
    for (std::size_t j = among.begin; j <= among.end; ++j) {
      const FramePoint& q = m_.compared.points[j];
      if (q.kind == p.kind && apart(p, q) <= largest_load_difference) return j;
    }
    return std::nullopt;
  }

  void compare_steps(const Stretch& own, const Stretch& other, bool is_whole) {
    if (m_.frame.motions.empty()) return;  // nothing to compare
    for (std::size_t i = own.begin; i <= own.end && time_.seconds() < seconds_; ++i) {
      const FramePoint& p = m_.paths.points[i];
      if (p.kind != FramePoint::Kind::step) continue;
      if (p.load == 0 && m_.frame.steady.size() == 0) {
        errors_[i] = 0;
        continue;
      }
      if (const auto off = off_path(p, other, is_whole)) errors_[i] = share(*off);
    }
  }

  /// Difference of a point from the point of the second mesh at the same load, in a range of its path; beyond
  /// a limit point the relative difference of the loads; empty if no equilibrium was found.
  [[nodiscard]] std::optional<double> off_path(const FramePoint& p, const Stretch& near, bool is_whole) {
    const Points& points = m_.compared.points;
    const double load = p.load;
    const auto off = [&](std::size_t j) { return points[j].load - load; };
    std::size_t at = near.begin;
    for (std::size_t j = near.begin; j < near.end; ++j) {
      if ((off(j) > 0) != (off(j + 1) > 0)) {
        at = j;
        break;
      }
      if (std::abs(off(j + 1)) < std::abs(off(at))) at = j + 1;
    }
    const std::size_t next = at < near.end ? at + 1 : at > near.begin ? at - 1 : at;
    const bool is_between = (off(at) > 0) != (off(next) > 0);
    const double part = is_between ? off(at) / (off(at) - off(next)) : 0;
    const auto free = [&](const Eigen::VectorXd& x) { return second_.free(x); };
    const Eigen::VectorXd start = free(points[at].x), chord = part * (free(points[next].x) - start);
    const double size = (free(points[next].x) - start).cwiseProduct(scale_).norm();
    // Slender members converge only for small rotations: divide the load step.
    for (const int parts : {1, 4, 16}) {
      Eigen::VectorXd x = start;
      bool is_settled = true;
      for (int i = 1; i <= parts && is_settled; ++i) {
        const double share = static_cast<double>(i) / parts;
        x += chord / parts;
        is_settled = settle(points[at].load - share * off(at), size, x);
      }
      if (is_settled && (x - start - chord).cwiseProduct(scale_).norm() <= size)
        return difference(p, second_.whole(x, load));
    }
    if (is_between || !is_whole) return std::nullopt;
    return std::abs(off(at) / load);  // beyond a limit point
  }

  /// Newton's iteration at a load, until its steps are rounding. @param size scaled size of a step of the
  /// path
  [[nodiscard]] bool settle(double load, double size, Eigen::VectorXd& x) {
    algebraic::SymmetricSolver solver;
    Eigen::VectorXd f, step(x.size());
    double before = HUGE_VAL;
    for (int k = 0; k < 20; ++k) {
      second_.residual(x, load, f);
      second_.linearise(x, load);
      solver.take(*second_.sparse(), scale_);
      if (!f.allFinite() || !solver.is_finite()) return false;
      solver.factorise();
      solver.solve(f.cwiseQuotient(scale_), step);
      x -= step.cwiseQuotient(scale_);
      const double length = step.norm();
      if (!(length <= 4 * size) || (k > 4 && length > 2 * before && length > 1e-4 * size)) return false;
      if (length <= 1e-12 * size || (length <= 1e-6 * size && length > before / 2)) return true;
      before = length;
    }
    return false;
  }

  /// Difference of the displacements of named nodes, and of the forces at prescribed displacements.
  [[nodiscard]] double difference(const FramePoint& p, const Eigen::VectorXd& x) const {
    Changes moves, forces;
    for (std::size_t i = 0; i < m_.frame.motions.size(); ++i)
      moves.add(m_.frame.motions[i].motion, p.x[m_.frame.motions[i].unknown],
                x[m_.second.motions[i].unknown]);
    const double size = size_of(m_.frame.frame);
    if (m_.frame.given.empty()) return moves.relative(size);
    Eigen::VectorXd own, other;
    if (!has_values(m_.frame.frame.force<double>(p.x, own)) ||
        !has_values(m_.second.frame.force<double>(x, other)))
      return 1;
    own -= loads_at(m_.frame, p.load), other -= loads_at(m_.second, p.load);
    for (std::size_t i = 0; i < m_.frame.motions.size(); ++i) {
      const NamedMotion &a = m_.frame.motions[i], &b = m_.second.motions[i];
      if (std::ranges::binary_search(m_.frame.given, a.unknown))
        forces.add(a.motion, own[a.unknown], other[b.unknown]);
    }
    return std::max(moves.relative(size), forces.relative(1 / size));
  }

  [[nodiscard]] double share(double difference) const { return std::min(1., m_.factor * difference); }

  const MeshPair& m_;
  LoadedFrame second_;
  double seconds_;
  Stopwatch time_;
  std::vector<std::optional<double>> errors_;
  Eigen::VectorXd scale_;
};

}  // namespace

int second_mesh(int elements, std::size_t beam_columns) {
  constexpr std::size_t many = 2000;
  if (elements == 1) return 3;
  if (beam_columns > many) return std::max(1, elements * 2 / 3);
  return elements + (elements + 1) / 2;
}

double mesh_factor(int elements, int others) {
  const double ratio = static_cast<double>(elements) / others;
  return 1 / std::abs(1 - ratio * ratio);
}

std::vector<std::optional<double>> mesh_errors(const MeshPair& meshes, double seconds) {
  return Comparison(meshes, seconds).all();
}

}  // namespace nlmech::frames
