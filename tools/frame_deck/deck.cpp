#include "tools/frame_deck/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "chapters/homotopy/commands/frame_file.hpp"
#include "nlmech/scene/program/files.hpp"

namespace nlmech::frame_deck {
namespace {

using Kind = Question::Kind;
constexpr Real pi = std::numbers::pi_v<Real>;
constexpr int rod_steps = 60;

bool is_held(const frames::FrameModel& model, const std::string& node, frames::Motion motion) {
  return std::any_of(model.supports.begin(), model.supports.end(),
                     [&](const frames::NamedSupport& s) { return s.node == node && s.motion == motion; });
}

const frames::NamedNode& node_of(const frames::FrameModel& model, const std::string& name) {
  return *std::find_if(model.nodes.begin(), model.nodes.end(),
                       [&](const frames::NamedNode& n) { return n.name == name; });
}

/// Where a motion is on a chain of this model.
Place place_of(const frames::FrameModel& model, const std::string& motion) {
  const std::string node = motion.substr(0, motion.find('.')), word = motion.substr(motion.find('.') + 1);
  Place place{0, word == "x" ? Part::x : word == "y" ? Part::y : Part::rotation};
  while (model.members.at(place.rod).second != node) ++place.rod;
  return place;
}

/// Walks a chain along a displacement to two ends between which a function has its zero.
struct Walk {
  std::string frame, motion;
  double low, high;               ///< ends of the bracket
  int parts;                      ///< steps to the first of them
  std::string first_motion = {};  ///< along which to set out, where `motion` is of second order at rest
  double first = 0;               ///< how far

  [[nodiscard]] Shooting shooting(int steps, const std::string& along) const {
    const frames::FrameModel model = model_of(frame);
    return {chain_of(model), place_of(model, along), steps};
  }
  /// The equilibrium at the first end.
  [[nodiscard]] Equilibrium begin(const Shooting& s, int steps) const {
    const Equilibrium from =
        first_motion.empty() ? Equilibrium{} : shooting(steps, first_motion).reach(first, 10);
    return s.reach(low, parts, from);
  }
  /// A limit point.
  [[nodiscard]] std::optional<Real> limit(int steps) const {
    const Shooting s = shooting(steps, motion);
    return load(s.root(low, high, begin(s, steps), [](const Equilibrium& e) { return e.slope; }));
  }
  /// Where the whole structure has neighbours under the same load, though this half has none.
  [[nodiscard]] std::optional<Real> bifurcation(int steps, const std::string& whole) const {
    const Shooting s = shooting(steps, motion), all(chain_of(model_of(whole)), {}, steps);
    return load(s.root(low, high, begin(s, steps), [&](const Equilibrium& e) { return all.determinant(e); }));
  }
  /// The load of a displacement.
  [[nodiscard]] std::optional<Real> at(int steps) const {
    const Equilibrium e = begin(shooting(steps, motion), steps);
    return e.is_found ? std::optional(e.load()) : std::nullopt;
  }

 private:
  static std::optional<Real> load(const std::optional<Equilibrium>& e) {
    return e ? std::optional(e->load()) : std::nullopt;
  }
};

Row limit(Kind kind, const Walk& walk, int least, int levels) {
  return {walk.frame,
          kind == Kind::maximum ? "first maximum" : "first minimum",
          {kind, 1, walk.motion, 0},
          least,
          levels,
          "elastica",
          [walk](int steps) { return walk.limit(steps); }};
}

Row at_place(const Walk& walk, int least, int levels) {
  return {walk.frame,
          "load at the displacement",
          {Kind::place, 1, walk.motion, walk.low},
          least,
          levels,
          "elastica",
          [walk](int steps) { return walk.at(steps); }};
}

Row fork(int number, const std::string& whole, const Walk& half, int least, int levels) {
  return {whole,
          number == 1 ? "first bifurcation" : "second bifurcation",
          {Kind::bifurcation, number, half.motion, 0},
          least,
          levels,
          "elastica",
          [half, whole](int steps) { return half.bifurcation(steps, whole); }};
}

Row closed(const std::string& frame, const std::string& quantity, const Question& question, int least,
           int levels, Real value) {
  return {frame, quantity, question, least, levels, "closed form", [value](int) { return value; }};
}

}  // namespace

frames::FrameModel model_of(const std::string& frame) {
  const std::string file = frame + ".toml";
  frames::FrameModel model =
      chapters::homotopy::parse_frame(
          scene::read_whole(scene::data_folder() / "chapters" / "homotopy" / "frames" / file), file)
          .model;
  model.imperfection.reset();
  return model;
}

Chain chain_of(const frames::FrameModel& model) {
  Chain chain;
  for (const frames::NamedMember& m : model.members) {
    const frames::NamedNode &a = node_of(model, m.first), &b = node_of(model, m.second);
    if (&m != &model.members.front() && m.first != (&m - 1)->second)
      throw std::runtime_error("frame_deck: the members are no chain");
    const Real dx = Real(b.x) - a.x, dy = Real(b.y) - a.y, chord = std::hypot(dx, dy);
    Rod rod{chord, std::atan2(dy, dx), 0, m.ea, m.ei};
    if (m.radius != 0) {
      const Real half = std::asin(chord / (2 * Real(m.radius)));  // clockwise if positive
      rod.length = 2 * half * Real(m.radius);
      rod.angle += half;
      rod.curvature = -1 / Real(m.radius);
    }
    chain.rods.push_back(rod);
    std::array<Real, 3> loads{};
    for (const frames::NamedLoad& l : model.loads) {
      if (l.node == m.second) loads[static_cast<std::size_t>(l.motion)] += Real(l.value);
    }
    chain.loads.push_back(loads);
  }
  const std::string& first = model.members.front().first;
  const std::string& last = model.members.back().second;
  chain.is_clamped = is_held(model, first, frames::Motion::rotation);
  for (int i = 0; i < 3; ++i)
    chain.fixed[static_cast<std::size_t>(i)] =
        static_cast<Part>(is_held(model, last, static_cast<frames::Motion>(i)) ? i : i + 3);
  return chain;
}

std::vector<Row> rows() {
  const Real slope = 1 / std::hypot(Real(1), Real(0.5L));
  const Real truss = 2 * std::pow(1 - std::pow(slope, Real(2) / 3), Real(1.5L));
  const Real brace = 1 / (2 * std::sqrt(Real(2)));
  std::vector<Row> all = {
      limit(Kind::maximum, {"toggle", "B.y", -0.2, -0.25, 10}, 4, 5),
      limit(Kind::minimum, {"toggle", "B.y", -0.45, -0.5, 20}, 4, 5),
      at_place({"toggle", "B.y", -0.1, 0, 5}, 4, 5),
      at_place({"toggle", "B.y", -0.625, 0, 30}, 4, 5),
      limit(Kind::maximum, {"lee", "load.x", 20, 30, 10, "load.y", -20}, 2, 4),
      limit(Kind::minimum, {"lee", "load.x", 85, 93, 160, "load.y", -20}, 2, 4),
      at_place({"lee", "load.x", 10, 0, 10, "load.y", -20}, 2, 4),
      at_place({"lee", "load.x", 60, 0, 100, "load.y", -20}, 2, 4),
      limit(Kind::maximum, {"half-shallow-arch", "crown.y", -0.3, -0.5, 20}, 2, 5),
      limit(Kind::minimum, {"half-shallow-arch", "crown.y", -1.2, -1.45, 60}, 2, 5),
      fork(1, "shallow-arch", {"half-shallow-arch", "crown.y", -0.7, -0.8, 40}, 4, 4),
      fork(2, "shallow-arch", {"half-shallow-arch", "crown.y", -0.85, -0.97, 50}, 4, 4),
      at_place({"half-shallow-arch", "crown.y", -1, 0, 50}, 2, 5),
      limit(Kind::maximum, {"deep-arch", "crown.y", -105, -120, 60}, 2, 5),
      at_place({"deep-arch", "crown.y", -50, 0, 30}, 2, 4),
      limit(Kind::maximum, {"portal", "B.x", 0.756, 0.768, 125, "B.x", 0.002}, 6, 5),
      closed("truss", "first maximum", {Kind::maximum, 1, "apex.y", 0}, 1, 2, truss),
      closed("truss", "first minimum", {Kind::minimum, 1, "apex.y", 0}, 1, 2, -truss),
      closed("cantilever", "load at the displacement", {Kind::place, 1, "tip.y", 2 / std::numbers::pi}, 2, 4,
             0.25L),
      closed("inclined-brace", "first bifurcation", {Kind::bifurcation, 1, "foot.x", 0}, 1, 2,
             brace / (1 + brace / 1e6L)),
      closed("level-brace", "first bifurcation", {Kind::bifurcation, 1, "foot.x", 0}, 1, 2, 1 / (1 + 1e-6L)),
  };
  for (int mode = 1; mode <= 3; ++mode) {
    // P (1 - P/EA) = pi^2 EI n^2/l^2; the load factor counts in the double that is pi^2.
    const Real euler = pi * pi * static_cast<Real>(mode * mode);
    const char* const names[] = {"first bifurcation", "second bifurcation", "third bifurcation"};
    all.push_back(closed("column", names[mode - 1], {Kind::bifurcation, mode, "middle.y", 0, 10}, 4, 5,
                         2 * euler / (1 + std::sqrt(1 - 4 * euler / 1e6L)) / Real(9.869604401089358)));
  }
  return all;
}

Made make(const Row& row) {
  const auto elements = extrapolated(model_of(row.frame), row.least, row.levels, row.question);
  const auto other = row.independent(rod_steps);
  if (!elements || !other)
    throw std::runtime_error(fmt::format("frame_deck: {}, {}: {} found nothing", row.frame, row.quantity,
                                         elements ? row.route : "elements"));
  Made made{*other, elements->answer.load, elements->last, elements->answer.motion, 0};
  const Real off = std::abs(made.elements / made.load - 1);
  made.digits = off > 0 ? static_cast<int>(std::clamp<Real>(-std::log10(2 * off), 0, 12)) : 12;
  return made;
}

std::string deck() {
  std::string text =
      "frame,quantity,motion,displacement,load_factor,digits,elements,elements_last_change,independent,"
      "route\n";
  for (const Row& row : rows()) {
    const Made m = make(row);
    const bool is_given = row.question.kind == Kind::place;
    text += fmt::format(
        "{},{},{},{},{:.{}g},{},{:.15g},{:.1e},{:.15g},{}\n", row.frame, row.quantity, row.question.motion,
        is_given ? fmt::format("{:.16g}", row.question.at)
                 : fmt::format("{:.6g}", static_cast<double>(m.displacement)),
        static_cast<double>(m.load), std::max(m.digits, 1), m.digits, static_cast<double>(m.elements),
        static_cast<double>(m.spread), static_cast<double>(m.load), row.route);
  }
  return text;
}

}  // namespace nlmech::frame_deck
