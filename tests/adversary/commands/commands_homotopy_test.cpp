/// Random toggles by `homotopy solve` and `limit-points`: forces, stability, limit points and bifurcations by
/// beam-columns written anew, Williams' equation by its closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/algebraic/named_solvers.hpp"
#include "nlmech/frames/equilibrium.hpp"
#include "nlmech/frames/toggle.hpp"
#include "tests/adversary/commands/command_run.hpp"
#include "tests/adversary/commands/half_toggle.hpp"

namespace nlmech::adversary::commands_homotopy_test {
namespace {

constexpr Real eps = std::numeric_limits<double>::epsilon();
constexpr Real length = 12.94, ea = 1.885e6L, ei = 9.27e3L;  // Table 2.1; 12.94 is the double

/// A toggle as typed.
struct Asked {
  double height = 0, load = 0, tolerance = 0;  ///< tolerance 0: not given
  int elements = 4;
  bool is_williams = false;
  std::string solver = "energy-trust-region", words;
};

void ask_toggle(Draw& draw, Asked& a, const char* command) {
  a.height = draw.chance(0.5) ? draw.uniform(0.2, 1.2) : draw.log_uniform(0.02, 12.93);
  a.words = fmt::format("homotopy {} --height {:.17g}", command, a.height);
  a.is_williams = draw.chance(0.2);
  if (a.is_williams) {
    a.words += " --model williams";
  } else if (draw.chance(0.7)) {
    a.elements = draw.whole(1, draw.chance(0.2) ? 14 : 6);
    a.words += fmt::format(" --elements {}", a.elements);
  }
}

/// Williams' equation (2.17 to 2.21).
struct Closed {
  explicit Closed(double height) : h(height) {}
  [[nodiscard]] Real compression(Real d) const {
    return ea / length * (d * h / length - 0.6L * d * d / length);
  }
  [[nodiscard]] Real load(Real d) const {
    const Real p = compression(d), n = -p * length * length / ei;
    return 2 * (ei / (length * length * length) * (4 / flexibility(n / 4).u + n) * d + p * h / length);
  }
  [[nodiscard]] Real slope(Real d) const {
    const Real p = ea / length * (h / length - 1.2L * d / length), n = -compression(d) * length * length / ei;
    const Flexibility f = flexibility(n / 4);
    const Real by_n = 1 - f.slope / (f.u * f.u);
    return 2 * (ei / (length * length * length) * (4 / f.u + n - by_n * p * length * length / ei * d) +
                p * h / length);
  }
  /// The drop at the pole of d_5, if there is one before @p end.
  [[nodiscard]] Real last(Real end) const {
    const Real most = 80.762914225706519903L;  // 4 x^2, tan x = x
    const Real top = std::min(h / 1.2L, end);  // of the compression
    if (compression(top) * length * length / ei < most) return end;
    Real low = 0, high = top;
    for (int i = 0; i < 64; ++i)
      (compression((low + high) / 2) * length * length / ei < most ? low : high) = (low + high) / 2;
    return low;
  }
  Real h;
};

/// The motions of a shape given by the library, as HalfToggle has them.
RealVector motions(const frames::ToggleFrame& half, const Eigen::VectorXd& x, int elements) {
  RealVector all = RealVector::Zero(3 * Eigen::Index{elements});
  for (int i = 1; i <= elements; ++i) {
    int place = 3 * i - 3;
    for (const auto motion : {frames::Motion::x, frames::Motion::y, frames::Motion::rotation}) {
      const Eigen::Index from = half.frame.unknown(i, motion);
      if (from >= 0) all[place] = x[from];
      ++place;
    }
  }
  return all;
}

/// The rows of the printed success.
struct Solved {
  double drop, bound;
  std::string stability, critical;
};

/// The part of the path from rest up to a load, or to the first change of stability.
struct FromRest {
  std::vector<AtDrop> path;
  bool is_whole = false;  ///< followed so far
};

FromRest from_rest(const HalfToggle& toggle, const Asked& a) {
  const auto is_stable = [](const AtDrop& p) { return p.inertia.symmetric + p.inertia.antisymmetric == 0; };
  FromRest r;
  const Real sign = a.load < 0 ? -1 : 1, linear = toggle.rest().slope;
  const Real share = std::min<Real>(0.02L, 0.1L * std::abs(a.load) / linear / a.height + 1e-9L);
  int steps = 0;
  r.path = toggle.path(sign, share, [&](const AtDrop& p) {
    return ++steps < 3000 && is_stable(p) && sign * p.load < std::abs(a.load);
  });
  r.is_whole = !is_stable(r.path.back()) || sign * r.path.back().load >= std::abs(a.load);
  return r;
}

/// The place between two neighbours on a path where a property of the second begins.
template <class Has>
std::pair<AtDrop, AtDrop> between(const HalfToggle& toggle, AtDrop low, AtDrop high, const Has& has) {
  for (int i = 0; i < 32; ++i) {  // 2e-10 of a step
    AtDrop guess = low;
    guess.x = (low.x + high.x) / 2;
    const auto found = toggle.at((low.drop + high.drop) / 2, guess);
    // Where Newton's iteration by differences does not converge, a mean will do.
    const AtDrop middle = found ? *found : toggle.described(guess.x);
    (has(middle) ? high : low) = middle;
  }
  return {low, high};
}

/// What the command says of the way from rest, beside the independent one.
Case judged_way(const Asked& a, const Solved& s, const HalfToggle& toggle, const Ran& r) {
  const FromRest way = from_rest(toggle, a);
  if (!way.is_whole || way.path.size() < 2) return Case::undecided(r.words);
  const auto is_stable = [](const AtDrop& p) { return p.inertia.symmetric + p.inertia.antisymmetric == 0; };
  const auto& path = way.path;
  if (!is_stable(path.back())) {
    const auto [low, high] =
        between(toggle, path[path.size() - 2], path.back(), [&](const AtDrop& p) { return !is_stable(p); });
    const Real critical = low.load;
    if (std::abs(critical / static_cast<Real>(a.load) - 1) < 1e-5L) return Case::undecided(r.words);
    if (critical < a.load) {
      if (s.critical.empty())
        return Case::wrong(r.words + fmt::format(": a critical load, {}", double(critical)));
      return Case::judged(static_cast<double>(std::abs(number(s.critical) / critical - 1)), 1e-6,
                          r.words + fmt::format(": critical load {}, {}", s.critical, double(critical)));
    }
  }
  if (!s.critical.empty()) return Case::wrong(r.words + ": no critical load, and not " + s.critical);
  const auto [low, high] = between(toggle, path[path.size() - 2], path.back(), [&](const AtDrop& p) {
    return std::abs(p.load) >= std::abs(static_cast<Real>(a.load));
  });
  const double other = static_cast<double>(std::abs(high.drop - s.drop));
  // Is it said that the shape is another one than that on the path from rest?
  const bool is_said = r.errors.find("another equilibrium") != std::string::npos;
  if (is_said != (other > 1e-3 * a.height) && std::abs(other / (1e-3 * a.height) - 1) > 1e-3)
    return Case::wrong(r.words + fmt::format(": from rest a drop of {}; {}", double(high.drop), r.errors));
  return Case::judged(0, 1, r.words);
}

/// The residual and the stability by the independent elements, at the shape that the solver hands to the
/// command.
Case judged_shape(const Asked& a, const Solved& s, const Ran& r) {
  const frames::Toggle own{.height = a.height, .elements = a.elements};
  const frames::ToggleFrame half = make_frame(own);
  frames::Equilibrium equations(half.frame, half.load, a.load);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(half.frame.size());
  const double scale = a.load != 0 ? std::abs(a.load) / 2 : 1;
  const bool is_given = a.tolerance > 0;
  const auto report = find_root({.name = a.solver,
                                 .tolerance = is_given ? a.tolerance : 1e-10,
                                 .scale = scale,
                                 .to_rounding = !is_given},
                                equations, x);
  if (!report.status.ok() || -x[half.apex] != s.drop) return Case::wrong(r.words + ": another drop");
  const HalfToggle toggle(a.height, a.elements);
  const RealVector shape = motions(half, x, a.elements);
  RealVector f = toggle.force(shape);
  if (!f.allFinite()) return Case::undecided(r.words);
  const RealMatrix k = toggle.stiffness(shape);
  f[toggle.apex()] += static_cast<Real>(a.load) / 2;
  f[toggle.apex() - 1] = f[toggle.apex() + 1] = 0;  // held
  // F in double is rounded with every displacement, with the load, and with the places of nodes, which an
  // element of a share 1/m of the member has m times as much of.
  const Real rounding =
      16 * (4 + a.elements) * eps * ((k.cwiseAbs() * shape.cwiseAbs()).norm() + std::abs(a.load));
  const double ratio = static_cast<double>(f.norm() / (s.bound * scale * (1 + 1e-5) + rounding));
  if (!(ratio <= 1)) return Case::judged(ratio, 1, r.words + ": residual");
  const Inertia found = toggle.inertia(k);
  const bool is_stable = found.symmetric + found.antisymmetric == 0;
  if (found.least > 1e-6L && s.stability != "unknown" && is_stable != (s.stability == "stable"))
    return Case::wrong(fmt::format("{}: {}, and there are {} and {} motions", r.words, s.stability,
                                   found.symmetric, found.antisymmetric));
  Case way = judged_way(a, s, toggle, r);
  way.ratio = std::max(way.ratio, ratio);
  return way.verdict == Case::Verdict::undecided ? Case::judged(ratio, 1, r.words) : way;
}

Case judged_closed(const Asked& a, const Solved& s, const Ran& r) {
  const Closed w(a.height);
  const double scale = a.load != 0 ? std::abs(a.load) / 2 : 1;
  const Real rest = std::abs(w.load(s.drop) - static_cast<Real>(a.load)) / 2;
  const Real rounding =
      64 * eps *
      (std::abs(static_cast<Real>(s.drop)) * (std::abs(w.slope(s.drop)) + std::abs(w.slope(0))) +
       std::abs(a.load));
  return Case::judged(static_cast<double>(rest / (s.bound * scale * (1 + 1e-5) + rounding)), 1, r.words);
}

Case solve(Draw& draw) {
  Asked a;
  ask_toggle(draw, a, "solve");
  a.load = draw.signed_log(1e-3, draw.chance(0.3) ? 1e4 : 300);
  if (draw.chance(0.7)) a.load = std::abs(a.load);
  const auto names = algebraic::solver_names();
  if (draw.chance(0.7)) {
    a.solver = std::string(draw.one_of(names));
    a.words += " --solver " + a.solver;
  }
  a.words += fmt::format(" --load {:.17g}", a.load);
  if (draw.chance(0.5)) {
    a.tolerance = draw.log_uniform(1e-14, 1e-2);
    a.words += fmt::format(" --tolerance {:.17g}", a.tolerance);
  }
  const Ran r = ran(a.words);
  if (const auto failure = failed(r)) return *failure;
  if (r.rows.size() != 1 || r.rows[0].size() != 7 || r.rows[0][0] != "success")
    return Case::wrong(r.words + ": rows");
  const auto& cells = r.rows[0];
  const Solved s{number(cells[1]), number(cells[4]), cells[5], cells[6]};
  if (!std::isfinite(s.drop) || !(number(cells[2]) <= s.bound)) return Case::wrong(r.words + ": " + cells[2]);
  return a.is_williams ? judged_closed(a, s, r) : judged_shape(a, s, r);
}

/// A limit point or bifurcation.
struct Event {
  std::string kind, motion;
  double load, drop;
};

std::string words_of(const std::vector<Event>& events) {
  std::string all;
  for (const Event& e : events)
    all += fmt::format("; {} {} {:.12g} {:.12g}", e.kind, e.motion, e.load, e.drop);
  return all;
}

/// The changes of inertia between two neighbours on the path.
void add_changes(const HalfToggle& toggle, AtDrop low, const AtDrop& high, std::vector<Event>& events) {
  const auto same = [](const Inertia& p, const Inertia& q) {
    return p.symmetric == q.symmetric && p.antisymmetric == q.antisymmetric;
  };
  for (int i = 0; i < 8 && !same(low.inertia, high.inertia); ++i) {
    const auto [before, after] =
        between(toggle, low, high, [&](const AtDrop& p) { return !same(p.inertia, low.inertia); });
    // The slope on both sides, away from its own rounding.
    const Real off = 1e-7L * toggle.rise();
    const AtDrop behind = toggle.at(before.drop - off, before).value_or(before),
                 ahead = toggle.at(after.drop + off, after).value_or(after);
    const bool is_limit = (behind.slope > 0) != (ahead.slope > 0) &&
                          before.inertia.antisymmetric == after.inertia.antisymmetric;
    const bool is_symmetric = before.inertia.antisymmetric == after.inertia.antisymmetric;
    events.push_back({is_limit ? (behind.slope > 0 ? "maximum" : "minimum") : "bifurcation",
                      is_symmetric ? "symmetric" : "antisymmetric", static_cast<double>(before.load),
                      static_cast<double>(before.drop)});
    low = after;
  }
}

/// As long as the drop grows along the path.
std::vector<Event> expected_events(const HalfToggle& toggle, double height, bool& is_whole) {
  const auto is_through = [&](const AtDrop& p) {
    return p.drop >= 2.2L * height && p.slope > 0 && p.inertia.symmetric + p.inertia.antisymmetric == 0;
  };
  int steps = 0;
  const auto path = toggle.path(1, 0.01L, [&](const AtDrop& p) { return ++steps < 2000 && !is_through(p); });
  is_whole = is_through(path.back());
  std::vector<Event> events;
  for (std::size_t i = 1; i < path.size(); ++i) add_changes(toggle, path[i - 1], path[i], events);
  return events;
}

std::vector<Event> expected_events(const Closed& w, double end) {
  std::vector<Event> events;
  constexpr int parts = 20'000;
  const auto n = [&](Real d) { return w.compression(d) * length * length / ei; };
  const Real sway = 20.190728556426629975L, bow = 39.478417604357434475L;  // tan x = x, 2 pi
  const auto root = [](const auto& f, Real low, Real high) {
    const bool sign = f(low) > 0;
    for (int i = 0; i < 60; ++i) ((f((low + high) / 2) > 0) == sign ? low : high) = (low + high) / 2;
    return low;
  };
  for (int i = 1; i < parts; ++i) {
    const Real low = static_cast<Real>(end) * (i - 1) / parts, high = static_cast<Real>(end) * i / parts;
    const auto add = [&](const std::string& kind, const std::string& motion, const auto& f) {
      if ((f(low) > 0) == (f(high) > 0)) return;
      const Real d = root(f, low, high);
      events.push_back({kind.empty() ? (f(low) > 0 ? "maximum" : "minimum") : kind, motion,
                        static_cast<double>(w.load(d)), static_cast<double>(d)});
    };
    const std::size_t first = events.size();
    add("", "symmetric", [&](Real d) { return w.slope(d); });
    add("bifurcation", "antisymmetric", [&](Real d) { return n(d) - sway; });
    add("bifurcation", "symmetric", [&](Real d) { return n(d) - bow; });
    std::sort(events.begin() + static_cast<std::ptrdiff_t>(first), events.end(),
              [](const Event& p, const Event& q) { return p.drop < q.drop; });
  }
  return events;
}

/// Both lists, as far as the expected one goes. critical_points() promises 1e-8 of loads.
Case compared(const std::vector<Event>& printed, const std::vector<Event>& expected, bool is_whole,
              const Ran& r) {
  const std::string what = fmt::format("{}{}; expected{}", r.words, words_of(printed), words_of(expected));
  if (printed.size() < expected.size() || (is_whole && printed.size() > expected.size()))
    return Case::wrong(what);
  double worst = 0, scale = 0;
  for (const Event& e : expected) scale = std::max(scale, std::abs(e.load));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (printed[i].kind != expected[i].kind || printed[i].motion != expected[i].motion)
      return Case::wrong(what);
    worst = std::max(worst, std::abs(printed[i].load - expected[i].load) / scale);
  }
  return expected.empty() && !is_whole ? Case::undecided(what) : Case::judged(worst, 1e-8, what);
}

Case limit_points(Draw& draw) {
  Asked a;
  ask_toggle(draw, a, "limit-points");
  const Ran r = ran(a.words);
  if (const auto failure = failed(r)) return *failure;
  std::vector<Event> printed;
  for (const auto& row : r.rows) {
    if (row.size() != 4) return Case::wrong(r.words + ": rows");
    printed.push_back({row[0], row[3], number(row[1]), number(row[2])});
  }
  if (a.is_williams) {
    const Closed w(a.height);
    const double end = static_cast<double>(w.last(2.2L * a.height) * (1 - 1e-9L));
    return compared(printed, expected_events(w, end), true, r);
  }
  bool is_whole = false;
  const auto expected = expected_events(HalfToggle(a.height, a.elements), a.height, is_whole);
  return compared(printed, expected, is_whole, r);
}

// Forces of motions that are tiny against the members are as exact as others: linear in the motions.
TEST(HalfToggle, TinyMotionsHaveAllDigits) {
  const HalfToggle toggle(6.1, 11);
  RealVector x(33);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 1e-15L * std::sin(static_cast<Real>(i + 1));
  const RealVector once = toggle.force(x), twice = toggle.force(2 * x);
  // 33 motions' roundings, and what is not linear, 1e-15 of the force.
  EXPECT_LT((twice - 2 * once).norm(), 1e-13L * once.norm());
}

TEST(AdversaryCommands, TogglesCarryTheirLoad) {
  if (const std::string what = missing_program("homotopy"); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 10, .full = 3'000}, solve);
}

TEST(AdversaryCommands, LimitPointsAreThoseOfAnotherElement) {
  if (const std::string what = missing_program("homotopy"); !what.empty()) GTEST_SKIP() << what;
  hunt({.quick = 5, .full = 1'000}, limit_points);
}

}  // namespace
}  // namespace nlmech::adversary::commands_homotopy_test
