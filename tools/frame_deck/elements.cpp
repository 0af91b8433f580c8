#include "tools/frame_deck/elements.hpp"

#include <Eigen/SparseLU>
#include <cmath>
#include <vector>

#include "nlmech/frames/named/frame_paths.hpp"

namespace nlmech::frame_deck {
namespace {

using Real = long double;
using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Sparse = Eigen::SparseMatrix<Real>;
using frames::FramePoint;

/// F(x, load) = dU/dx - load q, and systems of its derivative with a row and a column more.
class Bordered {
 public:
  explicit Bordered(const frames::NamedFrame& f) : frame_(f.frame), q_(f.load.cast<Real>()) {}

  /// Solves (K column; row^T 0)(x; m) = (f; h) with the K of linearise().
  [[nodiscard]] Column solve(const Column& column, const Column& row, const Column& f, Real h) {
    const Eigen::Index n = f.size();
    std::vector<Eigen::Triplet<Real>> entries;
    for (int c = 0; c < k_.outerSize(); ++c) {
      for (Sparse::InnerIterator at(k_, c); at; ++at)
        entries.emplace_back(static_cast<int>(at.row()), c, at.value());
    }
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, static_cast<int>(n), column[i]);
      entries.emplace_back(static_cast<int>(n), i, row[i]);
    }
    Sparse all(n + 1, n + 1);
    all.setFromTriplets(entries.begin(), entries.end());
    Column right(n + 1);
    right << f, h;
    const Eigen::SparseLU<Sparse> lu(all);
    return lu.solve(right);
  }
  void linearise(const Column& x) { static_cast<void>(frame_.tangent<Real>(x, k_)); }
  [[nodiscard]] Column residual(const Column& x, Real load) const {
    Column f;
    static_cast<void>(frame_.force<Real>(x, f));
    return f - load * q_;
  }
  /// The equilibrium where row x = place, from a near one. @param still a direction in which x is not moved:
  /// that of the other branch, where two of them cross and only rounding tells how far to go along it
  [[nodiscard]] bool settle(const Column& row, Real place, Column& x, Real& load, const Column& still = {}) {
    Real before = HUGE_VALL;
    for (int i = 0; i < 30; ++i) {
      linearise(x);
      Column step = solve(-q_, row, residual(x, load), row.dot(x) - place);
      const Eigen::Index n = x.size();
      if (still.size() == n) step.head(n) -= still * still.dot(step.head(n));
      x -= step.head(n);
      load -= step[n];
      const Real size = step.head(n).norm() / (x.norm() + Real(1e-12));
      if (!std::isfinite(size)) return false;
      if (size < Real(1e-17) || (size < Real(1e-9) && size > before / 2)) return true;
      before = size;
    }
    return false;
  }
  /// A number that is 0 where K is singular, and its null vector there.
  [[nodiscard]] Real singular(const Column& x, Column& mode) {
    linearise(x);
    const Column out = solve(mode, mode, Column::Zero(mode.size()), 1);
    mode = out.head(mode.size()).normalized();
    return out[mode.size()];
  }

 private:
  const frames::Frame& frame_;
  Column q_;
  Sparse k_;
};

/// Where K is singular, between or near two places along `row`: the secant rule.
std::optional<Answer> critical(const frames::NamedFrame& f, const FramePoint& p, const Column& row,
                               Eigen::Index motion) {
  Bordered equations(f);
  Column x = p.x.cast<Real>(), mode = p.mode.cast<Real>();
  const Column still = p.kind == FramePoint::Kind::bifurcation ? mode : Column{};
  Real load = p.load, a = row.dot(x), b = a + Real(1e-6) * (std::abs(a) + x.norm() * row.norm());
  if (!equations.settle(row, a, x, load, still)) return std::nullopt;
  Real before = equations.singular(x, mode);
  for (int i = 0; i < 12; ++i) {
    if (!equations.settle(row, b, x, load, still)) return std::nullopt;
    const Real now = equations.singular(x, mode);
    if (now == before) break;
    const Real next = b - now * (b - a) / (now - before);
    a = b, before = now, b = next;
    if (std::abs(b - a) < Real(1e-13) * (std::abs(b) + x.norm() * row.norm())) break;
  }
  if (!equations.settle(row, b, x, load, still)) return std::nullopt;
  return Answer{load, x[motion]};
}

/// The load of a displacement, from a near point: in more and more parts, since Newton's iteration bears but
/// small turns of slender members.
std::optional<Answer> placed(const frames::NamedFrame& f, const FramePoint& p, Eigen::Index motion, Real to) {
  Bordered equations(f);
  Column row = Column::Zero(p.x.size());
  row[motion] = 1;
  for (int parts = 1; parts <= 64; parts *= 4) {
    Column x = p.x.cast<Real>();
    Real load = p.load;
    const Real from = x[motion];
    bool is_there = true;
    for (int i = 1; i <= parts && is_there; ++i)
      is_there = equations.settle(
          row, i == parts ? to : from + (to - from) * static_cast<Real>(i) / static_cast<Real>(parts), x,
          load);
    if (is_there) return Answer{load, x[motion]};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Answer> answer(const frames::FrameModel& model, int elements, const Question& q) {
  const frames::NamedFrame f = build(model, elements);
  Eigen::Index motion = -1;
  for (const frames::NamedMotion& m : f.motions) {
    if (m.name == q.motion) motion = m.unknown;
  }
  if (motion < 0) return std::nullopt;
  const frames::FramePaths paths = equilibrium_paths(
      f, {.steps = 400, .until = q.until > 0 ? std::optional(q.until) : std::nullopt, .turn = 0.08});
  const auto& points = paths.points;
  int met = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FramePoint& p = points[i];
    if (q.kind == Question::Kind::place) {
      if (i == 0 || (points[i - 1].x[motion] < q.at) == (p.x[motion] < q.at)) continue;
      return placed(f, p, motion, q.at);
    }
    const auto wanted = q.kind == Question::Kind::maximum   ? FramePoint::Kind::maximum
                        : q.kind == Question::Kind::minimum ? FramePoint::Kind::minimum
                                                            : FramePoint::Kind::bifurcation;
    if (p.kind != wanted || ++met < q.number) continue;
    // At a limit point the path goes along the mode. At a bifurcation the mode is another way: the path's is
    // told by its points before and behind.
    Column row = p.mode.cast<Real>();
    if (wanted == FramePoint::Kind::bifurcation) {
      const std::size_t next = i + 1 < points.size() ? i + 1 : i;
      row = (points[next].x - points[i - 1].x).cast<Real>().normalized();
    }
    return critical(f, p, row, motion);
  }
  return std::nullopt;
}

std::optional<Extrapolated> extrapolated(const frames::FrameModel& model, int least, int levels,
                                         const Question& q) {
  std::vector<Answer> row;
  Real last = 0;
  for (int level = 0, elements = least; level < levels; ++level, elements *= 2) {
    const std::optional<Answer> next = answer(model, elements, q);
    if (!next) return std::nullopt;
    std::vector<Answer> better = {*next};
    Real power = 1;
    for (const Answer& before : row) {
      power *= 4;
      const Answer now = better.back();
      better.push_back({now.load + (now.load - before.load) / (power - 1),
                        now.motion + (now.motion - before.motion) / (power - 1)});
    }
    if (!row.empty()) last = std::abs(better.back().load - row.back().load);
    row = better;
  }
  return Extrapolated{row.back(), last};
}

}  // namespace nlmech::frame_deck
