#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chapters/homotopy/curves.hpp"
#include "chapters/homotopy/scenes.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

/// A figure of one row of a table.
struct Subject {
  std::string name, title, heading;
  std::string table;
  Scheme scheme;
  bool other;        ///< shows the iteration with the other Jacobian too
  int shown;         ///< iterations at most
  double root;       ///< known from elsewhere
  double stiffness;  ///< dF/ddelta there, at least
};

const Row& row_of(const std::vector<Row>& rows, const Subject& s) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return row.printed.table == s.table && row.printed.iteration.scheme == s.scheme;
  });
}

void draw(Curves& figure, const Ran& ran, const std::string& legend, const std::string& look, int shown,
          bool residual) {
  figure.begin(legend, look);
  for (std::size_t k = 0; k < ran.trace.size() && k <= static_cast<std::size_t>(shown); ++k) {
    const Trace& t = ran.trace[k];
    figure.add(static_cast<double>(k), residual ? t.residual / ran.scale : t.deflection);
  }
}

/// What must be true of an iteration that has converged.
std::vector<scene::Quantity> promises(const Subject& s, const Row& row, const Ran& ran) {
  const double tolerance = row.printed.iteration.tolerance;
  return {scene::at_most("|F| of the last iterate", "lb", ran.count.residual, tolerance, "the tolerance"),
          scene::at_most("error of the last deflection", "in", std::abs(ran.trace.back().deflection - s.root),
                         tolerance / s.stiffness + 1e-9,
                         "|F| over the slope of F near the root of tools/oracles/homotopy_williams.py or "
                         "homotopy_frames.py")};
}

std::string other_name(const Row& row) {
  return row.printed.model == Model::williams ? "{/:Italic d}_{5} held constant in the Jacobian"
                                              : "{/:Italic A}_{nd} as printed";
}

scene::Showing show(const Subject& s, const Row& row, Workshop& w) {
  const bool residual = row.printed.model == Model::element;
  const Ran& exact = w.result(*row.exact);
  Curves figure(s.heading, "iteration",
                residual ? "|{/:Italic F}|/|{/:Italic F}(0)|" : "deflection of the apex {/:Italic δ} (in)");
  figure.begin(residual ? "tolerance" : "root", "l13");
  const double level = residual ? row.printed.iteration.tolerance / exact.scale : s.root;
  figure.add(0, level);
  figure.add(s.shown, level);
  if (s.other) draw(figure, w.result(*row.misprinted), other_name(row), "b5", s.shown, residual);
  draw(figure, exact, s.other ? (residual ? "consistent tangent" : "derivative of {/:Italic F}") : "iterates",
       "b1", s.shown, residual);
  figure.with("xrange", fmt::format("[0:{}]", s.shown));
  if (s.other) figure.with("below", "1").with("height", "520");
  if (!s.other) figure.with("key", "bottom right");
  if (!residual && s.other) figure.with("yrange", "[-0.6:1.6]");
  if (residual) figure.with("logy", "1");
  std::vector<scene::Quantity> quantities = promises(s, row, exact);
  if (s.scheme == Scheme::newton && s.other) {
    const Ran& other = w.result(*row.misprinted);
    quantities.push_back(scene::near("iterations with the other Jacobian", "1", other.count.iterations, 1000,
                                     0, "it does not converge (misprint-study); printed: 1000"));
  }
  return {figure.take(), {}, quantities};
}

std::vector<Subject> subjects() {
  // oracle: homotopy_williams Williams 0.32 drop under 27.11, Williams 0.44 drop under 43.79
  // oracle: homotopy_frames toggle 0.44 of 1 drop under *
  constexpr double low = 0.266690787315, near_root = 0.635331561089, element_root = 0.621922545486,
                   last_root = 0.623070489;
  using enum Scheme;
  return {
      {"fig-2.8", "Newton's iterates, l sin(beta) = 0.32 in, W = 27.11 lb",
       "Without a limit point Newton's iteration is done at once", "table-2.2", newton, false, 10, low, 6},
      {"fig-2.9", "Scalar fixed-point homotopy, l sin(beta) = 0.32 in, W = 27.11 lb",
       "The homotopy approaches the same root slowly", "table-2.2", fixed_point, false, 32, low, 6},
      {"fig-2.10", "Newton's iterates, l sin(beta) = 0.44 in, W = 43.79 lb",
       "Newton wanders, and arrives: with a wrong Jacobian never", "table-2.3", newton, true, 150, near_root,
       40},
      {"fig-2.11", "Scalar fixed-point homotopy, l sin(beta) = 0.44 in, W = 43.79 lb",
       "The homotopy wanders too, and is thrown past the maximum", "table-2.3", fixed_point, false, 150,
       near_root, 40},
      {"fig-2.16", "Newton's residual, element, l sin(beta) = 0.44 in, W = 43.79 lb",
       "A misprint in the tangent makes Newton oscillate for ever", "table-2.4", newton, true, 40,
       element_root, 40},
      {"fig-2.17", "Residual of the scalar fixed-point homotopy, element, W = 43.79 lb, tolerance 1e-6",
       "Fixed-point homotopy, 43.79 lb: wandering, then capture", "table-2.4", fixed_point, true, 200,
       element_root, 40},
      {"fig-2.18", "Residual of the scalar Newton homotopy, element, W = 43.79 lb, tolerance 1e-6",
       "Newton homotopy, 43.79 lb: the same, another count", "table-2.4", newton_homotopy, true, 200,
       element_root, 40},
      {"fig-2.19", "Residual of the scalar fixed-point homotopy, element, W = 44 lb, tolerance 0.1 %",
       "Fixed-point homotopy, 44 lb, to a thousandth", "table-2.5", fixed_point, true, 80, last_root, 40},
      {"fig-2.20", "Residual of the scalar Newton homotopy, element, W = 44 lb, tolerance 0.1 %",
       "Newton homotopy, 44 lb, to a thousandth", "table-2.5", newton_homotopy, true, 200, last_root, 40}};
}

}  // namespace

void add_histories(scene::Chapter& chapter, const std::vector<Row>& rows, bool element) {
  for (const Subject& s : subjects()) {
    const Row row = row_of(rows, s);
    if ((row.printed.model == Model::element) != element) continue;
    std::vector<const scene::AnyRun*> needs = {row.exact};
    if (s.other) needs.push_back(row.misprinted);
    chapter.add({.name = s.name,
                 .title = s.title,
                 .place = "Figure " + s.name.substr(4),
                 .needs = needs,
                 .show = [s, row](Workshop& w) { return show(s, row, w); }});
  }
}

}  // namespace nlmech::chapters
