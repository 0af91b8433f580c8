#include "nlmech/frames/loaded_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "nlmech/algebraic/symmetric_solver.hpp"
#include "nlmech/support/doubles.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::frames {

double size_of(const Frame& frame) {
  const auto& nodes = frame.nodes();
  const auto [left, right] =
      std::minmax_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.y < b.y; });
  return std::hypot(right->x - left->x, high->y - low->y);
}

namespace {

/// Ratio of displacements to the limits of a first step; at most 1 if they are allowed.
double excess_of(const Frame& frame, const Eigen::VectorXd& x) {
  const double far = 1e-3 * size_of(frame), turn = 0.02;
  double worst = 0;
  for (std::size_t i = 0; i < frame.members().size(); ++i) {
    const Vector<double, 6> d = frame.ends<double>(x, i);
    for (int j = 0; j < 6; ++j) worst = std::max(worst, std::abs(d[j]) / (j % 3 == 2 ? turn : far));
    // Limit the relative displacement of the ends, so that a short member does not invert.
    const Member& m = frame.members()[i];
    const Node &a = frame.nodes()[static_cast<std::size_t>(m.first)],
               &b = frame.nodes()[static_cast<std::size_t>(m.second)];
    worst = std::max(worst, std::hypot(d[3] - d[0], d[4] - d[1]) / (0.1 * std::hypot(b.x - a.x, b.y - a.y)));
  }
  return worst;
}

}  // namespace

LoadedFrame::LoadedFrame(const Frame& frame, Eigen::VectorXd load, Coupling coupling)
    : frame_(frame), load_(std::move(load)), size_(frame.size()), coupling_(coupling), column_(-load_) {
  if (load_.size() != frame.size() || !load_.allFinite()) {
    throw invalid_argument("LoadedFrame: {} forces for {} unknowns, or some are not finite", load_.size(),
                           frame.size());
  }
}

LoadedFrame::LoadedFrame(const NamedFrame& frame) : LoadedFrame(frame.frame, frame.load) {
  steady_ = frame.steady;
  if (frame.given.empty()) return;
  displacement_ = frame.displacement;
  std::vector<Eigen::Index> place(static_cast<std::size_t>(size_), -1);
  for (Eigen::Index i = 0; i < size_; ++i) {
    if (std::binary_search(frame.given.begin(), frame.given.end(), i)) continue;
    place[static_cast<std::size_t>(i)] = static_cast<Eigen::Index>(free_.size());
    free_.push_back(i);
  }
  size_ = static_cast<Eigen::Index>(free_.size());
  // Sparsity pattern of the tangent at rest, which always exists. Rows, columns and values keep their order.
  static_cast<void>(frame_.tangent<double>(Eigen::VectorXd::Zero(frame_.size()), all_));
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index from = 0;
  for (int column = 0; column < all_.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator at(all_, column); at; ++at, ++from) {
      const Eigen::Index row = place[static_cast<std::size_t>(at.row())],
                         own = place[static_cast<std::size_t>(column)];
      if (row < 0 || own < 0) continue;
      slots_.emplace_back(from, static_cast<Eigen::Index>(entries.size()));
      entries.emplace_back(static_cast<int>(row), static_cast<int>(own), 0.);
    }
  }
  tangent_.resize(size_, size_);
  tangent_.setFromTriplets(entries.begin(), entries.end());
  tangent_.makeCompressed();
}

Eigen::VectorXd LoadedFrame::whole(const Eigen::VectorXd& free, double load) const {
  if (!has_given()) return free;
  Eigen::VectorXd x = load * displacement_;
  x(free_) = free;
  return x;
}

algebraic::LongVector LoadedFrame::long_whole(const algebraic::LongVector& free, double load) const {
  if (!has_given()) return free;
  algebraic::LongVector x = load * displacement_.cast<long double>();
  x(free_) = free;
  return x;
}

Eigen::VectorXd LoadedFrame::free(const Eigen::VectorXd& all) const {
  if (!has_given()) return all;
  return all(free_);
}

Eigen::VectorXd LoadedFrame::shape(const Eigen::VectorXd& direction) const {
  if (!has_given()) return direction;
  Eigen::VectorXd v = Eigen::VectorXd::Zero(frame_.size());
  v(free_) = direction;
  return v;
}

void LoadedFrame::residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) {
  Eigen::VectorXd& all = has_given() ? forces_ : f;
  status_ = has_given() ? frame_.force<double>(whole(x, load), all) : frame_.force<double>(x, all);
  if (!has_values(status_)) {
    f.setConstant(size(), nan);
    return;
  }
  all -= load * load_;
  if (steady_.size() > 0) all -= steady_;
  if (has_given()) f = forces_(free_);
}

void LoadedFrame::linearise(const Eigen::VectorXd& x, double load) {
  Eigen::SparseMatrix<double>& k = has_given() ? all_ : tangent_;
  status_ = has_given() ? frame_.tangent<double>(whole(x, load), k, coupling_)
                        : frame_.tangent<double>(x, k, coupling_);
  if (!has_values(status_)) k.coeffs().setConstant(nan);
  if (!has_given()) return;
  for (const auto& [from, to] : slots_) tangent_.valuePtr()[to] = all_.valuePtr()[from];
  column_ = free(all_ * displacement_ - load_);
}

bool LoadedFrame::long_residual(const algebraic::LongVector& x, double load, Eigen::VectorXd& f) {
  algebraic::LongVector forces;
  status_ = frame_.force<long double>(long_whole(x, load), forces);
  if (steady_.size() > 0) forces -= steady_.cast<long double>();
  if (has_values(status_))
    f = free((forces - load * load_.cast<long double>()).cast<double>());
  else
    f.setConstant(size(), nan);
  return true;
}

bool LoadedFrame::long_matrix(const algebraic::LongVector& x, double load,
                              Eigen::SparseMatrix<long double>& k) {
  if (!has_given()) return has_values(frame_.tangent<long double>(x, k));
  Eigen::SparseMatrix<long double> all;
  if (!has_values(frame_.tangent<long double>(long_whole(x, load), all))) return false;
  k = block(all);
  return true;
}

template <class T>
Eigen::SparseMatrix<T> LoadedFrame::block(const Eigen::SparseMatrix<T>& all) const {
  if (!has_given()) return all;
  Eigen::SparseMatrix<T> k = tangent_.cast<T>();
  for (const auto& [from, to] : slots_) k.valuePtr()[to] = all.valuePtr()[from];
  return k;
}

std::optional<Eigen::SparseMatrix<double>> LoadedFrame::geometric(const Eigen::VectorXd& x, double load) {
  algebraic::SymmetricSolver solver;
  const Eigen::VectorXd scale = algebraic::scale_of(tangent_.diagonal());
  solver.take(tangent_, scale);
  if (!solver.is_finite() || solver.factorise().zero > 0) return std::nullopt;
  Eigen::VectorXd rate(size());
  solver.solve((-column_).cwiseQuotient(scale), rate);
  rate = shape(rate.cwiseQuotient(scale));
  if (has_given()) rate += displacement_;
  Eigen::SparseMatrix<double> all;
  if (!has_values(frame_.geometric(whole(x, load), rate, all))) return std::nullopt;
  return block(all);
}

Eigen::VectorXd LoadedFrame::scale() const {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(frame_.size());
  const double translation = 1 / size_of(frame_);
  for (int node = 0; node < static_cast<int>(frame_.nodes().size()); ++node) {
    for (const Motion motion : {Motion::x, Motion::y}) {
      if (const Eigen::Index at = frame_.unknown(node, motion); at >= 0) all[at] = translation;
    }
  }
  return free(all);
}

void LoadedFrame::remove_full_rotations(Eigen::VectorXd& change) const {
  if (frame_.has_springs()) return;  // a full turn strains them
  if (has_given()) return;  // the prescribed displacements grow with the load, so no configuration recurs
  constexpr double turn = 2 * std::numbers::pi;
  const auto turns = [&](Eigen::Index i) { return i < 0 ? 0 : std::round(change[i] / turn); };
  for (std::size_t i = 0; i < frame_.members().size(); ++i) {
    if (turns(frame_.unknowns_of(i)[2]) != turns(frame_.unknowns_of(i)[5])) return;
  }
  for (std::size_t i = 0; i < frame_.members().size(); ++i) {
    for (const Eigen::Index at : {frame_.unknowns_of(i)[2], frame_.unknowns_of(i)[5]}) {
      if (at >= 0) change[at] -= turn * turns(at);
    }
  }
}

ShortestMember LoadedFrame::shortest(const Eigen::VectorXd& x, double load) const {
  ShortestMember found{HUGE_VAL, 0, 0};
  const Eigen::VectorXd all = whole(x, load);
  for (std::size_t i = 0; i < frame_.members().size(); ++i) {
    const Node &a = frame_.nodes()[static_cast<std::size_t>(frame_.members()[i].first)],
               &b = frame_.nodes()[static_cast<std::size_t>(frame_.members()[i].second)];
    const Vector<double, 6> d = frame_.ends<double>(all, i);
    const double left =
        std::hypot(b.x - a.x + d[3] - d[0], b.y - a.y + d[4] - d[1]) / std::hypot(b.x - a.x, b.y - a.y);
    if (left < found.left) found = {left, a.x, a.y};
  }
  return found;
}

double LoadedFrame::first_load(const Eigen::VectorXd& start) {
  linearise(start, 0);
  algebraic::SymmetricSolver solver;
  const Eigen::VectorXd scale = algebraic::scale_of(tangent_.diagonal());
  solver.take(tangent_, scale);
  const Eigen::Index negative = solver.factorise().negative;
  const Eigen::VectorXd scaled = (-column_).cwiseQuotient(scale);
  Eigen::VectorXd x(size());
  solver.solve(scaled, x);
  x = x.cwiseQuotient(scale);
  double first = 1 / excess_of(frame_, whole(x, 1));
  if (!(std::isfinite(first) && first > 0)) return 1;
  for (int halving = 0; halving < 60; ++halving, first /= 2) {
    linearise(start + first * x, first);
    solver.take(tangent_, scale);
    if (solver.is_finite() && solver.factorise().negative == negative) break;
  }
  return first;
}

LoadedWilliams::LoadedWilliams(const Williams& toggle) : toggle_(toggle) {
  for (const double number : {toggle.height, toggle.length, toggle.ea, toggle.ei}) {
    if (!(number > 0 && std::isfinite(number)))
      throw invalid_argument("LoadedWilliams: {} among height, length, EA, EI; all are positive", number);
  }
}

void LoadedWilliams::residual(const Eigen::VectorXd& x, double load, Eigen::VectorXd& f) {
  const bool exists = toggle_.outcome(x[0]) == Outcome::success;
  f.setConstant(1, exists ? (toggle_.load(x[0]) - load) / 2 : nan);
}

void LoadedWilliams::linearise(const Eigen::VectorXd& x, double load) {
  static_cast<void>(load);
  slope_ = toggle_.outcome(x[0]) == Outcome::success ? toggle_.stiffness(x[0]) / 2 : nan;
}

}  // namespace nlmech::frames
