/// Random orbits by `two_body_series propagate`, forwards and backwards, with rows between: each row beside
/// Kepler's classical equation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/program/files.hpp"
#include "tests/adversary/commands/command_run.hpp"
#include "tests/adversary/kepler_oracle.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::orbit::adversary::commands_orbit_test {
namespace {

using nlmech::adversary::Case;
using nlmech::adversary::hunt;
using nlmech::adversary::number;
using nlmech::adversary::Ran;

/// An orbit as the command takes it.
struct Asked {
  Motion motion;
  std::string method, words;
  double tolerance = 1e-15, every = 0;
};

Asked ask(Draw& draw) {
  Asked a{any_motion(draw), draw.one_of({"kepler", "series", "rkn1210"}), "", 1e-15, 0};
  Motion& m = a.motion;
  if (a.method != "kepler") {  // some hundred revolutions at most
    const double scale = m.start.position.norm() * std::sqrt(m.start.position.norm() / m.mu);
    m.time = std::clamp(m.time, -300 * scale, 300 * scale);
    a.tolerance = draw.chance(0.3) ? 1e-15 : draw.log_uniform(1e-16, 1e-4);
  }
  a.every = std::abs(m.time) / draw.uniform(0.5, 24);
  a.words = fmt::format("two_body_series propagate {} --every {:.17g} --method {}",
                        words(m.start, m.time, m.mu), a.every, a.method);
  if (a.method != "kepler") a.words += fmt::format(" --tolerance {:.17g}", a.tolerance);
  return a;
}

/// How far off the distance may be at the time of a row, as a share: what the data determine, and for steps
/// what each of them adds (AnalyticContinuation), times the condition of the rest of the way.
struct Step {
  double t;
  State end;
};
std::vector<Step> steps_of(const Asked& a) {
  std::vector<Step> all;
  // RKN12(10) is held to the steps that the series takes: it takes as many within a factor of a few.
  const auto run = propagate(a.motion.start, 0, a.motion.time, {.mu = a.motion.mu},
                             AnalyticContinuation{.tolerance = a.tolerance},
                             [&](const orbit::Step& step) {
                               all.push_back({step.t1, step.x1});
                               return true;
                             },
                             {.steps = 1000});
  if (!run.status.ok()) all.clear();
  return all;
}
double allowed_at(const Asked& a, const std::vector<Step>& steps, double t) {
  double allowed = 8 * eps * kepler_condition(a.motion.start, t, a.motion.mu).position;
  if (a.method == "kepler") return allowed;
  // An estimate of an error is not a bound of it.
  const double of_step = (a.method == "series" ? 2 : 50) * a.tolerance + 9 * eps;
  allowed += 2 * of_step;  // of the row's own series
  for (const Step& s : steps) {
    if (std::abs(s.t) > std::abs(t)) break;
    const double circular = std::sqrt(a.motion.mu / s.end.position.norm());
    allowed += of_step * std::max(1.0, circular / s.end.velocity.norm()) *
               kepler_condition(s.end, t - s.t, a.motion.mu).position;
  }
  return allowed;
}

std::string untimely(const Asked& a, const Ran& r) {
  std::vector<double> times = {0};
  const double way = std::abs(a.motion.time), sign = a.motion.time < 0 ? -1 : 1;
  for (int k = 1; way - k * a.every > 1e-9 * a.every; ++k) times.push_back(sign * k * a.every);
  times.push_back(a.motion.time);
  if (r.rows.size() != times.size()) return fmt::format("{} rows", r.rows.size());
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (r.rows[k].size() != 7 || number(r.rows[k][0]) != times[k]) return "a row at " + r.rows[k][0];
  }
  return "";
}

Case trial(Draw& draw) {
  const Asked a = ask(draw);
  const Ran r = nlmech::adversary::ran(a.words);
  if (const auto failure = failed(r)) return *failure;
  if (const std::string what = untimely(a, r); !what.empty()) return Case::wrong(r.words + ": " + what);
  const std::vector<Step> steps = a.method == "kepler" ? std::vector<Step>() : steps_of(a);
  if (a.method != "kepler" && steps.empty()) return Case::undecided(r.words);
  Case worst = Case::undecided(r.words);
  for (std::size_t k = 1; k < r.rows.size(); ++k) {
    const double t = number(r.rows[k][0]);
    const Vector3<double> x(number(r.rows[k][1]), number(r.rows[k][2]), number(r.rows[k][3]));
    const double allowed = allowed_at(a, steps, t);
    if (!x.allFinite()) return Case::wrong(r.words + ": no number");
    if (!(allowed < 0.1)) continue;
    const auto truth = conic<Real>(a.motion.start, t, a.motion.mu);
    const double error = distance(x, truth.position) / static_cast<double>(length(truth.position));
    Case found = Case::judged(error, allowed, fmt::format("{}: at t = {:.17g}", r.words, t));
    if (found.verdict == Case::Verdict::wrong) return found;
    if (worst.verdict != Case::Verdict::right || found.ratio > worst.ratio) worst = found;
  }
  return worst;
}

TEST(AdversaryCommands, OrbitsRowByRow) {
  if (const std::string what = nlmech::adversary::missing_program("two_body_series"); !what.empty())
    GTEST_SKIP() << what;
  hunt({.quick = 20, .full = 3'000}, trial);
}

/// A nearly parabolic orbit and when it is asked for: up to where rounding of its energy leaves no digit.
Motion nearly_parabolic(Draw& draw) {
  const double speed = std::numbers::sqrt2 * (1 + draw.signed_log(1e-18, 1e-3));
  return {state_of(draw, draw.log_uniform(0.1, 10), 1, speed, draw.uniform(0, std::numbers::pi)),
          draw.signed_log(1e3, 1e30), 1};
}

/// One row of the answer. `success` has six digits (8 kappa eps with kappa eps < 1e-6), `low_accuracy` one.
Case judge_row(const Motion& m, const std::vector<std::string>& cells) {
  const std::string& status = cells.back();
  if (status != "success" && status != "low_accuracy") return Case::refused();
  const std::string what = words(m.start, m.time, m.mu) + " " + status;
  if (number(cells[1]) != m.time) return Case::wrong(what + ": another time");
  const Vector3<double> x(number(cells[2]), number(cells[3]), number(cells[4]));
  const auto truth = conic<Real>(m.start, m.time, m.mu);
  return Case::judged(distance(x, truth.position) / static_cast<double>(length(truth.position)),
                      status == "success" ? 8e-6 : 0.125, what);
}

TEST(AdversaryCommands, NearlyParabolicCatalogues) {
  if (const std::string what = nlmech::adversary::missing_program("two_body_series"); !what.empty())
    GTEST_SKIP() << what;
  const tests::TemporaryFolder folder;
  hunt({.quick = 10, .full = 500}, [&](Draw& draw) {
    std::vector<Motion> motions;
    std::string text = "x,y,z,vx,vy,vz,until\n";
    for (int k = 0; k < 40; ++k) {
      const Motion& m = motions.emplace_back(nearly_parabolic(draw));
      const auto &r = m.start.position, &v = m.start.velocity;
      text += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", r[0], r[1], r[2], v[0],
                          v[1], v[2], m.time);
    }
    const auto file = folder.path() / "states.csv";
    scene::write_whole(file, text);
    const Ran run =
        nlmech::adversary::ran(fmt::format("two_body_series propagate --states {} --mu 1 --method {}",
                                           file.string(), draw.one_of({"kepler", "series"})));
    if (run.rows.size() != motions.size()) return Case::wrong(run.words + ": rows are missing " + run.errors);
    Case worst = Case::refused(run.words);
    for (std::size_t k = 0; k < motions.size(); ++k) {
      Case found = judge_row(motions[k], run.rows[k]);
      if (found.verdict == Case::Verdict::wrong) return found;
      if (found.verdict == Case::Verdict::right && found.ratio >= worst.ratio) worst = std::move(found);
    }
    return worst;
  });
}

}  // namespace
}  // namespace nlmech::orbit::adversary::commands_orbit_test
