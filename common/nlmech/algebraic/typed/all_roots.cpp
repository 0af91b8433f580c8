#include "nlmech/algebraic/typed/all_roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::algebraic {
namespace {

using program::Interval;

/// The common part; nothing if there is none.
std::optional<Box> common_part(const Box& a, const Box& b) {
  Box both = a;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double low = std::max(a[i].low, b[i].low), high = std::min(a[i].high, b[i].high);
    if (!(low <= high)) return std::nullopt;
    both[i] = {low, high};
  }
  return both;
}

/// Bisection of one box.
class RootSearch {
 public:
  RootSearch(const TypedSystem& system, const Box& box, const AllRootsOptions& options)
      : system_(system), whole_(box), options_(options), open_{box} {}

  AllRoots run() {
    const Stopwatch time;
    bool is_limited = false;
    while (!open_.empty()) {
      is_limited = ++out_.examined > options_.boxes || time.seconds() > options_.seconds;
      if (is_limited) break;
      const Box box = std::move(open_.back());
      open_.pop_back();
      examine(box);
    }
    for (Box& box : open_) undecided_.push_back(std::move(box));
    finish(is_limited);
    return std::move(out_);
  }

 private:
  /// A proved root and the box in which it is the only one.
  struct Proved {
    Box root, only_one_in;
  };

  void examine(const Box& box) {
    const bool is_known =
        std::ranges::any_of(proved_, [&](const Proved& known) { return is_inside(box, known.only_one_in); });
    if (is_known) return;
    Box f, j;
    const auto domain = system_.enclose(box, f, j);
    if (domain == TypedSystem::Domain::outside || !may_be_zero(f)) return;
    // Wider than the part, so that a root on its edge is inside.
    Box wide;
    for (std::size_t i = 0; i < box.size(); ++i)
      wide.push_back(box[i].inflated(0.1 * box[i].width() + least_width(i) / 10));
    if (system_.enclose(wide, f, j) == TypedSystem::Domain::smooth) {
      if (const std::optional<Box> image = krawczyk(system_, wide, j)) {
        if (is_inside(*image, wide) && prove(*image, wide)) return;
        const std::optional<Box> rest = common_part(*image, box);
        if (!rest) return;
        if (widest(*rest).second < 0.7 * widest(box).second) {
          open_.push_back(*rest);
          return;
        }
        return divide(*rest, j);
      }
    }
    divide(box, j);
  }

  static bool may_be_zero(const Box& f) {
    return std::ranges::all_of(f, [](const Interval& value) { return value.has(0); });
  }
  [[nodiscard]] double least_width(std::size_t i) const { return options_.width * whole_[i].width(); }

  // Tightens the enclosure @p root of the only root in a box, down to rounding: by Krawczyk's operator, and
  // where that stalls, as for x^20 = 1 in a wide box, by Newton's iteration. False if both leave it wide.
  [[nodiscard]] bool prove(Box root, const Box& only_one_in) {
    for (int k = 0; k < 60; ++k) {
      Box f, j, wide;
      for (const Interval& side : root) wide.push_back(side.inflated(1e-3 * side.width() + 1e-300));
      static_cast<void>(system_.enclose(wide, f, j));
      const std::optional<Box> next = krawczyk(system_, wide, j),
                               smaller = next ? common_part(*next, root) : std::nullopt;
      if (!smaller || !(widest(*smaller).second < 0.9 * widest(root).second)) break;
      root = *smaller;
    }
    if (!is_narrow(root)) {
      Eigen::VectorXd middle(system_.size()), typical(system_.size());
      for (Eigen::Index i = 0; i < middle.size(); ++i) {
        const Interval& side = root[static_cast<std::size_t>(i)];
        middle[i] = side.low + side.width() / 2;
        typical[i] = std::max(std::abs(middle[i]), side.width());
      }
      const CheckedRoot found = check_root(system_, middle, typical);
      Box bounds;
      for (Eigen::Index i = 0; i < middle.size(); ++i)
        bounds.push_back(Interval::outwards(found.x[i] - found.bound[i], found.x[i] + found.bound[i]));
      if (found.kind != CheckedRoot::Kind::proved || !is_inside(bounds, only_one_in)) return false;
      root = bounds;
    }
    proved_.push_back({root, only_one_in});
    return true;
  }
  /// Is the half width at most 1e-10 of the middle, or of the whole box about 0?
  [[nodiscard]] bool is_narrow(const Box& root) const {
    for (std::size_t i = 0; i < root.size(); ++i) {
      const double size = std::max(std::abs(root[i].low), std::abs(root[i].high));
      if (!(root[i].width() <= 2e-10 * std::max(size, 1e-3 * whole_[i].width()))) return false;
    }
    return true;
  }

  /// The side of the largest width in units of the whole box.
  [[nodiscard]] std::pair<std::size_t, double> widest(const Box& box) const {
    std::pair<std::size_t, double> most = {0, -1};
    for (std::size_t i = 0; i < box.size(); ++i) {
      const double share = box[i].width() / whole_[i].width();
      if (share > most.second) most = {i, share};
    }
    return most;
  }

  // Divides the side that changes F most, in units of its size, if it is not much narrower than the widest.
  void divide(const Box& box, const Box& j) {
    const auto [wide, share] = widest(box);
    if (share < options_.width) {
      undecided_.push_back(box);
      return;
    }
    std::size_t side = wide;
    double most = -1;
    for (std::size_t i = 0; i < box.size(); ++i) {
      if (box[i].width() / whole_[i].width() < 0.05 * share) continue;
      double effect = 0;
      for (std::size_t row = 0; row < box.size(); ++row) {
        double size = 0;
        for (std::size_t k = 0; k < box.size(); ++k)
          size += j[row * box.size() + k].magnitude() * box[k].width();
        if (std::isfinite(size) && size > 0)
          effect += j[row * box.size() + i].magnitude() * box[i].width() / size;
      }
      if (effect > most) most = effect, side = i;
    }
    // Off the middle, where roots of symmetric equations lie.
    const double cut = box[side].low + 0.4870 * box[side].width();
    Box left = box, right = box;
    left[side] = {box[side].low, cut};
    right[side] = {cut, box[side].high};
    open_.push_back(std::move(right));
    open_.push_back(std::move(left));
  }

  // Removes doubles and roots outside the box, joins undecided neighbours.
  void finish(bool is_limited) {
    std::vector<Proved> different;
    for (const Proved& root : proved_) {
      const bool is_same = std::ranges::any_of(different, [&](const Proved& other) {
        return is_inside(root.root, other.only_one_in) || is_inside(other.root, root.only_one_in);
      });
      if (!is_same && common_part(root.root, whole_)) different.push_back(root);
    }
    std::ranges::sort(different, {}, [](const Proved& root) { return root.root[0].low; });
    for (const Proved& root : different) out_.boxes.push_back({root.root, true});
    join_undecided();
    for (const Box& box : undecided_) out_.boxes.push_back({box, false});
    if (!undecided_.empty())
      out_.status = failed_with(
          is_limited ? Outcome::step_limit : Outcome::singular_matrix, "{} box{} undecided{}: {}",
          undecided_.size(), undecided_.size() == 1 ? " is" : "es are",
          is_limited ? fmt::format(" after {} boxes", out_.examined) : "",
          is_limited ? "allow more boxes or time, or give a smaller box"
                     : "a singular root, a kink or jump, or the end of the domain of F may lie there");
  }
  void join_undecided() {
    for (bool is_joined = true; is_joined && undecided_.size() < 5000;) {
      is_joined = false;
      for (std::size_t a = 0; a < undecided_.size(); ++a) {
        for (std::size_t b = undecided_.size(); b-- > a + 1;) {
          if (!common_part(undecided_[a], undecided_[b])) continue;
          for (std::size_t i = 0; i < whole_.size(); ++i)
            undecided_[a][i] = hull(undecided_[a][i], undecided_[b][i]);
          undecided_.erase(undecided_.begin() + static_cast<std::ptrdiff_t>(b));
          is_joined = true;
        }
      }
    }
  }

  const TypedSystem& system_;
  Box whole_;
  AllRootsOptions options_;
  std::vector<Box> open_, undecided_;
  std::vector<Proved> proved_;
  AllRoots out_;
};

}  // namespace

AllRoots all_roots(const TypedSystem& system, const Box& box, const AllRootsOptions& options) {
  if (static_cast<Eigen::Index>(box.size()) != system.size())
    throw invalid_argument("all_roots: a box of {} sides for {} unknowns", box.size(), system.size());
  for (const Interval& side : box) {
    if (!std::isfinite(side.width()) || !(side.width() > 0))
      throw invalid_argument("all_roots: a side from {} to {}; it must be finite and not empty", side.low,
                             side.high);
  }
  Box bounds;
  for (Eigen::Index i = 0; i < system.size(); ++i) bounds.emplace_back(system.lower()[i], system.upper()[i]);
  const std::optional<Box> allowed = common_part(box, bounds);
  if (!allowed) return {};
  if (std::ranges::any_of(*allowed, [](const Interval& side) { return side.width() == 0; }))
    return {{{*allowed, false}},
            failed_with(Outcome::singular_matrix,
                        "the bounds leave a single value of an unknown in the box; define it as a number")};
  return RootSearch(system, *allowed, options).run();
}

}  // namespace nlmech::algebraic
