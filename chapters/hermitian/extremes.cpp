#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::hermitian::extremes {
namespace {

using ivp::Hermitian;
/// A table row: one run with its outcome.
struct Attempt {
  std::string what, operators, setting, status;
  std::optional<double> error;  ///< error of the position at the end; nothing after a failure
  std::int64_t steps, evaluations;
};

/// A problem with initial state, end time and reference position at the end.
struct Subject {
  std::string what;
  ivp::System system;
  ivp::State x0;
  double end, reference;
};

Attempt attempt(const Subject& s, const Hermitian& method) {
  const auto run = ivp::integrate(s.system, s.x0, 0, s.end, method, {}, {.steps = 5'000'000});
  Attempt a{s.what,
            std::string(method.operators.name),
            method.step > 0 ? fmt::format("step {:.4g}", method.step)
                            : fmt::format("tolerance {:.0e}", method.relative_tolerance),
            std::string(to_string(run.status.outcome())),
            {},
            run.statistics.steps,
            run.statistics.right_hand_sides};
  if (run.status.ok()) a.error = std::abs(run.x[0] - s.reference);
  return a;
}

Hermitian controlled(const ivp::HermitianPair& pair, double tolerance) {
  return {.operators = pair, .relative_tolerance = tolerance, .absolute_tolerance = tolerance};
}

// Reference positions by Taylor series in 113 bits.
std::vector<Subject> relaxations() {
  const auto make = [](double mu, double end, double reference) {
    return Subject{fmt::format("van der Pol, mu = {}", mu),
                   ivp::System(problems::TextProblem("van-der-pol", {{"mu", mu}})),
                   {2, 0},
                   end,
                   reference};
  };
  return {make(10, 40, 1.872808279858089700), make(100, 200, 1.718587208019240655),
          make(1000, 2000, 1.706167732170465008)};
}

// x'' + 10^6 x + m x^3 = cos t to t = 1, with omega = 1000.
Subject fast_duffing(const std::string& what, double hardening, double x0) {
  const problems::TextProblem problem(
      "driven-duffing",
      {{"damping", 0}, {"stiffness", 1e6}, {"hardening", hardening}, {"force", 1}, {"frequency", 1}});
  const problems::ReferenceTrajectory<long double, problems::TextProblem> reference(problem, {x0, 0}, 0, 1);
  if (!reference.status().ok()) throw Failure(reference.status());
  return {what, ivp::System(problem), {x0, 0}, 1, static_cast<double>(reference(1)[0])};
}

std::vector<Attempt> attempts(bool quick) {
  std::vector<Attempt> all;
  for (const Subject& s : relaxations()) {
    for (const double step : {0.5, 0.125, 0.03125, 0.00390625}) all.push_back(attempt(s, {.step = step}));
    for (const double tolerance : {1e-4, 1e-8, 1e-12})
      all.push_back(attempt(s, controlled(ivp::laier, tolerance)));
    all.push_back(attempt(s, controlled(ivp::argyris, 1e-8)));
    all.push_back(attempt(s, controlled(ivp::newmark_pair, 1e-6)));
  }
  const Subject smooth = fast_duffing("fast Duffing, smooth start", 1, 1e-6);
  const Subject swinging = fast_duffing("fast Duffing, oscillating start", 1, 1);
  const Subject hard = fast_duffing("the same, 1000 x^3", 1000, 1);
  for (const ivp::HermitianPair& pair : {ivp::laier, ivp::argyris, ivp::newmark_pair}) {
    for (const double step : {0.1, 0.01, 0.001})
      all.push_back(attempt(smooth, {.operators = pair, .step = step}));
  }
  for (const Subject& s : {swinging, hard}) {
    for (const double step : {1e-3, 1e-4, 1e-5}) {
      if (!quick || step > 5e-5) all.push_back(attempt(s, {.step = step}));
    }
    all.push_back(attempt(s, controlled(ivp::laier, 1e-10)));
  }
  for (const double z : {1e2, 1e4, 1e6}) {
    const Subject linear{fmt::format("linear, h omega = {:.0e}", z),
                         ivp::System(problems::TextProblem("linear", {{"natural_frequency", z}})),
                         {1, 0},
                         100,
                         std::cos(100 * z)};
    for (const ivp::HermitianPair& pair : {ivp::laier, ivp::argyris, ivp::newmark_pair})
      all.push_back(attempt(linear, {.operators = pair, .step = 1}));
  }
  return all;
}

const Attempt& of(const std::vector<Attempt>& all, const std::string& what, const std::string& operators,
                  const std::string& setting) {
  for (const Attempt& a : all) {
    if (a.what == what && a.operators == operators && a.setting == setting) return a;
  }
  throw std::out_of_range("no case " + what + ", " + operators + ", " + setting);
}

void put(const std::vector<Attempt>& all, scene::Show& show) {
  show.table(all, {{"case", &Attempt::what},
                   {"operators", &Attempt::operators},
                   {"setting", &Attempt::setting},
                   {"status", &Attempt::status},
                   {"error at the end", &Attempt::error, 2},
                   {"steps", &Attempt::steps},
                   {"evaluations", &Attempt::evaluations}});
  const auto error = [&](const std::string& what, const std::string& operators, const std::string& setting) {
    return of(all, what, operators, setting).error.value_or(NAN);
  };
  const auto smooth = [&](const std::string& operators) {
    std::vector<double> errors;
    for (const char* step : {"step 0.1", "step 0.01", "step 0.001"})
      errors.push_back(error("fast Duffing, smooth start", operators, step));
    return errors;
  };
  show.equals("successes on van der Pol's oscillator that err by more than 0.1",
              std::ranges::count_if(all,
                                    [](const Attempt& a) {
                                      return a.what.starts_with("van der Pol") && a.error.value_or(0) > 0.1;
                                    }),
              0, "the error estimate must reject them");
  show.between("steps that are refused as wrong branches",
               std::ranges::count(all, "wrong_branch", &Attempt::status), 6, 12,
               "all that are longer than the fast transition of the three oscillators");
  show.at_most("error for mu = 1000, steps chosen, tolerance 1e-8",
               error("van der Pol, mu = 1000", "laier", "tolerance 1e-08"), 1e-6,
               "tolerance 1e-8; the limit cycle damps errors between transitions");
  show.at_most("evaluations for mu = 1000, steps chosen, tolerance 1e-8",
               of(all, "van der Pol, mu = 1000", "laier", "tolerance 1e-08").evaluations, 60000,
               "fixed steps: 8.2 million for an error of 5e-4; regression value");
  show.at_most("fast Duffing, smooth start: greatest error of Laier", std::ranges::max(smooth("laier")),
               4e-12, "twice the fast part of the start, 1e-12: it stays, its phase is lost");
  // The error of a failed run is NaN and compares false.
  show.equals(
      "the same, runs of Argyris with h omega = 10 or 100 that end well",
      std::ranges::count_if(smooth("argyris") | std::views::take(2), [](double e) { return e < 1e-9; }), 0,
      "both lie beyond sqrt(60); the other run ends at 3e20");
  show.at_most("fast Duffing, oscillating start: error with tolerance 1e-10",
               error("fast Duffing, oscillating start", "laier", "tolerance 1e-10"), 1e-4,
               "an error of 1e-10 a step, of one sign, over all its steps");
  show.at_most("linear, h omega = 1e6: error of Laier after 100 steps",
               error("linear, h omega = 1e+06", "laier", "step 1"), 2.001,
               "|x| <= 1 for the exact and, with the spectral radius 1, for the computed motion");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result(
      "extremes",
      "van der Pol from (2, 0) to t = 40, 200, 2000; Duffing with omega = 1000 to t = 1; linear to t = 100",
      attempts);
  return {{.name = "extremes",
           .title = "Relaxation oscillations, fast oscillators and much too long steps",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::hermitian::extremes
