/// The reference values of tables/frames/deck.csv, and convergence of the library's elements to them.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/homotopy/commands/frame_file.hpp"
#include "nlmech/frames/named/frame_forces.hpp"
#include "nlmech/frames/named/frame_modes.hpp"
#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "tests/places.hpp"

namespace nlmech::chapters::homotopy::deck_test {
namespace {

using frames::FramePoint;

/// A row, and the numbers of elements for its computation.
struct Row {
  const char *frame, *quantity, *motion;
  double at, value;  ///< the displacement of a node, if not 0; the load factor, or as the quantity says
  int least, levels;
};
constexpr const char *maximum = "first maximum", *minimum = "first minimum", *fork = "first bifurcation",
                     *second = "second bifurcation", *third = "third bifurcation",
                     *place = "load at the displacement", *moment = "moment at the base at the displacement",
                     *frequency = "first frequency at the load factor 0.5";

// oracle: homotopy_deck *
constexpr std::array deck = {
    Row{"toggle", maximum, "B.y", 0, 42.4397755886, 4, 3},
    Row{"toggle", minimum, "B.y", 0, 32.1221640887, 4, 3},
    Row{"toggle", place, "B.y", -0.1, 31.2811575124, 4, 3},
    Row{"toggle", place, "B.y", -0.625, 44.3432474912, 4, 3},
    Row{"lee", maximum, "load.x", 0, 1.85567275376, 2, 3},
    Row{"lee", minimum, "load.x", 0, -0.941443155560, 2, 3},
    Row{"lee", place, "load.x", 10, 1.58298251914, 2, 3},
    Row{"lee", place, "load.x", 60, 1.25453516498, 2, 3},
    Row{"half-shallow-arch", maximum, "crown.y", 0, 34.0900034632, 2, 4},
    Row{"half-shallow-arch", minimum, "crown.y", 0, 14.2530270884, 2, 4},
    Row{"shallow-arch", fork, "crown.y", 0, 27.0970708750, 4, 3},
    Row{"shallow-arch", second, "crown.y", 0, 21.7344379534, 4, 3},
    Row{"half-shallow-arch", place, "crown.y", -1, 20.1573568660, 2, 4},
    Row{"deep-arch", maximum, "crown.y", 0, 8.97294947594, 2, 3},
    Row{"deep-arch", place, "crown.y", -50, 5.54191183320, 2, 3},
    Row{"portal", maximum, "B.x", 0, 9.00249954706, 6, 5},
    Row{"truss", maximum, "apex.y", 0, 0.0383837398174, 1, 2},
    Row{"truss", minimum, "apex.y", 0, -0.0383837398174, 1, 2},
    Row{"cantilever", place, "tip.y", 0.6366197723675814, 0.250000000000, 2, 3},
    Row{"inclined-brace", fork, "foot.x", 0, 0.353553265593, 1, 2},
    Row{"level-brace", fork, "foot.x", 0, 0.999999000001, 1, 2},
    Row{"column", fork, "middle.y", 0, 1.00000986980, 4, 3},
    Row{"column", second, "middle.y", 0, 4.00015792614, 4, 3},
    Row{"column", third, "middle.y", 0, 9.00079958001, 4, 3},
    Row{"spring-column", fork, "top.x", 0, 0.740174432253, 2, 3},
    Row{"joint-cantilever", place, "tip.y", 0.9003163161571061, 0.250000000000, 2, 3},
    Row{"heavy-cantilever", place, "tip.y", -0.5, 5.06437817114, 4, 4},
    Row{"heavy-cantilever", moment, "tip.y", -0.5, -2.25041733266, 4, 4},
    Row{"heavy-column", fork, "top.x", 0, 7.83737654040, 4, 4},
    Row{"loaded-column", fork, "top.x", 0, 1.24336691836, 4, 4},
    Row{"braced-column", fork, "top.x", 0, 4.07003177508, 4, 3},
    Row{"column", frequency, "", 0, 1.11072895636, 4, 4}};

double number(const std::string& text) {
  double value = NAN;
  EXPECT_TRUE(scene::parse_number(text, value)) << text;
  return value;
}

TEST(FrameDeck, FileHasTheNumbersOfTheOracle) {
  const std::string path = NLMECH_SOURCE_DIR "/tables/frames/deck.csv";
  const auto kept = scene::parse_csv(scene::read_whole(path), path);
  ASSERT_EQ(kept.size(), deck.size() + 1);
  EXPECT_EQ(kept[0].cells, (std::vector<std::string>{"frame", "quantity", "motion", "displacement", "value",
                                                     "digits", "route"}));
  for (std::size_t i = 0; i < deck.size(); ++i) {
    const auto& cells = kept[i + 1].cells;
    EXPECT_EQ(cells[0], deck[i].frame);
    EXPECT_EQ(cells[1], deck[i].quantity);
    EXPECT_EQ(cells[2], deck[i].motion);
    if (deck[i].at != 0) {
      EXPECT_EQ(number(cells[3]), deck[i].at);
    }
    EXPECT_EQ(number(cells[4]), deck[i].value) << deck[i].frame << ", " << deck[i].quantity;
  }
}

/// The point at which a motion has a given displacement, from a near point: Newton's iteration with that
/// condition, in increments, because slender members do not allow large rotations in one; a load of NaN
/// without convergence.
FramePoint point_at(const frames::NamedFrame& f, const FramePoint& near, Eigen::Index motion, double at) {
  constexpr int iterations = 7;
  const Eigen::Index n = near.x.size();
  Eigen::VectorXd force, right(n + 1), step;
  Eigen::SparseMatrix<double> k;
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + 1, n + 1);
  bordered(n, motion) = 1;
  for (const int parts : {1, 16}) {
    FramePoint p = near;
    for (int i = 0; i < parts * iterations; ++i) {
      const int reached = i / iterations + 1;
      const double part = static_cast<double>(reached) / parts;
      if (!f.frame.tangent<double>(p.x, k).ok() || !f.frame.force<double>(p.x, force).ok()) break;
      bordered.topLeftCorner(n, n) = k;
      bordered.topRightCorner(n, 1) = -f.load;
      right << force - p.load * f.load, p.x[motion] - (near.x[motion] + part * (at - near.x[motion]));
      step = bordered.partialPivLu().solve(right);
      p.x -= step.head(n);
      p.load -= step[n];
    }
    if (step.norm() < 1e-9 * p.x.norm()) return p;
  }
  return {.load = NAN, .x = near.x};
}

/// The result for one number of elements; NaN if there is none.
double value_by_elements(const Row& row, int elements) {
  const std::string file = std::string(row.frame) + ".toml";
  const std::string path = NLMECH_SOURCE_DIR "/chapters/homotopy/frames/" + file;
  const frames::FrameModel model = parse_frame(scene::read_whole(path), file).model;
  const frames::NamedFrame f = build(model, elements);
  Eigen::Index motion = -1;
  for (const frames::NamedMotion& m : f.motions) {
    if (m.name == row.motion) motion = m.unknown;
  }
  const bool is_column = std::string(row.frame) == "column";
  // The path of the deep arch continues far beyond its maximum.
  const bool is_first = row.quantity == maximum || std::string(row.frame) == "deep-arch";
  const auto paths =
      equilibrium_paths(f, {.steps = 400,
                            .until = row.quantity == frequency                      ? std::optional(0.5)
                                     : is_column                                    ? std::optional(10.)
                                     : std::string(row.frame) == "heavy-cantilever" ? std::optional(6.)
                                                                                    : std::nullopt,
                            .turn = 0.08,
                            .critical = is_first ? 1 : 0});
  if (const FramePoint& end = paths.points.back(); row.quantity == frequency)
    return frame_modes(f, end.x, end.load, 1).modes.back().value;
  const auto kind = row.quantity == maximum   ? FramePoint::Kind::maximum
                    : row.quantity == minimum ? FramePoint::Kind::minimum
                                              : FramePoint::Kind::bifurcation;
  int wanted = row.quantity == second ? 2 : row.quantity == third ? 3 : 1;
  for (std::size_t i = 1; i < paths.points.size(); ++i) {
    const FramePoint &before = paths.points[i - 1], &p = paths.points[i];
    if (row.at == 0 && p.kind == kind && --wanted == 0) return p.load;
    if (row.at != 0 && (before.x[motion] < row.at) != (p.x[motion] < row.at)) {
      const FramePoint there = point_at(f, p, motion, row.at);
      return row.quantity == place ? there.load
                                   : forces_of(model, f, there.x, there.load).members[0].first.moment;
    }
  }
  return NAN;
}

// Errors are a series of even powers of the element length (Richardson). Rounding of a member's length gives
// an axial force of eps EA; if EA is at least 1e5 times the load, nine digits remain.
TEST(FrameDeck, ElementsConvergeToIt) {
  for (const Row& row : deck) {
    std::vector<double> last;
    double change = HUGE_VAL;
    for (int level = 0; level < row.levels; ++level) {
      std::vector<double> better = {value_by_elements(row, row.least << level)};
      for (std::size_t j = 0; j < last.size(); ++j)
        better.push_back(better.back() + (better.back() - last[j]) / (std::pow(4, j + 1) - 1));
      if (!last.empty()) change = std::abs(better.back() - last.back());
      last = better;
    }
    const std::string what = std::string(row.frame) + ", " + row.quantity;
    EXPECT_LT(change, 1e-5 * std::abs(row.value)) << what;
    EXPECT_NEAR(last.back(), row.value, change + 1e-9 * std::abs(row.value)) << what;
  }
}

}  // namespace
}  // namespace nlmech::chapters::homotopy::deck_test
