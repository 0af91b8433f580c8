// adaptive-collocation on stiff problems without closed form, against two agreeing codes of other authors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nlmech/ivp/collocation/adaptive_collocation.hpp"
#include "nlmech/peers/ivp/registry.hpp"
#include "nlmech/problems/texts.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::ivp::ivp_stiff_codes_test {
namespace {

using randomised::Case;
using randomised::Draw;
using randomised::randomised_test;

constexpr double digits_and_a_half = 30;

bool has_codes() {
  return peers::peer_info("cvode-bdf").is_available() &&
         peers::peer_info("odeint-rosenbrock4").is_available();
}

/// An initial value problem with tolerances.
struct Question {
  System system;
  State x0;
  double end;
  double relative, absolute;
};

/// Reference: the common result of a multistep method with 1e-4 and a one-step method with 1e-3 times the
/// tolerances.
template <class Allowed>
Case compare_with_exact(const Question& q, Allowed allowed, const std::string& what) {
  const auto s =
      integrate(q.system, q.x0, 0, q.end,
                AdaptiveCollocation{.relative_tolerance = q.relative, .absolute_tolerance = q.absolute}, {},
                {.steps = 100'000});
  if (!s.status.ok()) return Case::refused(s.status.text());
  const double relative = 1e-3 * q.relative, absolute = 1e-3 * q.absolute;
  const Limits limits{.steps = 300'000};
  const auto run = [&](const char* name, double share) {
    return peers::peer_integrator(name, share * relative, share * absolute)(q.system, q.x0, 0, q.end, {},
                                                                            limits);
  };
  const auto bdf = run("cvode-bdf", 0.1), rosenbrock = run("odeint-rosenbrock4", 1);
  if (!bdf.status.ok() || !rosenbrock.status.ok()) return Case::undecided();
  const State bound = allowed(rosenbrock.x);
  const auto ratio = [&](const State& a, const State& b) {
    return ((a - b).cwiseAbs().array() / bound.array()).maxCoeff();
  };
  if (!(ratio(bdf.x, rosenbrock.x) < 0.2)) return Case::undecided(what);
  return Case::judged(std::min(ratio(s.x, bdf.x), ratio(s.x, rosenbrock.x)), 1, what);
}

/// Bound: thirty tolerances of each component, and the effect of a phase error of @p time_per_tolerance times
/// the relative tolerance.
auto tolerances(const Question& q, double time_per_tolerance) {
  return [&q, time_per_tolerance](const State& x) {
    State f(x.size());
    q.system.rhs(q.end, x, f);
    State bound(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i)
      bound[i] = digits_and_a_half * (q.absolute + q.relative * std::abs(x[i]) +
                                      q.relative * time_per_tolerance * std::abs(f[i]));
    return bound;
  };
}

// On the slow branch x moves at the rate 1/mu: an error of one tolerance in x is a time error of mu
// tolerances, at every fast transition.
TEST(RandomisedStiffCodes, VanDerPol) {
  if (!has_codes()) GTEST_SKIP() << "this build lacks the codes to compare with";
  randomised_test({.quick = 5, .full = 1500}, [](Draw& draw) {
    const double mu = draw.log_uniform(1, 1e4), end = draw.uniform(0.1, 2) * (mu + 5),
                 tolerance = draw.log_uniform(1e-8, 1e-3);
    const Question q{System(problems::TextProblem("van-der-pol", {{"mu", mu}})),
                     {2, 0},
                     end,
                     tolerance,
                     1e-3 * tolerance / mu};
    return compare_with_exact(q, tolerances(q, 10 * (1 + mu)),
                              fmt::format("mu {:.17g}, end {:.17g}, tolerance {:.17g}", mu, end, tolerance));
  });
}

TEST(RandomisedStiffCodes, Robertson) {
  if (!has_codes()) GTEST_SKIP() << "this build lacks the codes to compare with";
  randomised_test({.quick = 5, .full = 1500}, [](Draw& draw) {
    const double k1 = 0.04 * draw.log_uniform(0.1, 10), k2 = 1e4 * draw.log_uniform(0.01, 100),
                 k3 = 3e7 * draw.log_uniform(0.01, 100), end = draw.log_uniform(1e-3, 1e10),
                 tolerance = draw.log_uniform(1e-8, 1e-3);
    const problems::TextProblem p("robertson", {{"k1", k1}, {"k2", k2}, {"k3", k3}});
    const Question q{System(p), p.initial_state(), end, tolerance, 1e-11 * tolerance};
    return compare_with_exact(
        q, tolerances(q, 0),
        fmt::format("k {:.17g} {:.17g} {:.17g}, end {:.17g}, tolerance {:.17g}", k1, k2, k3, end, tolerance));
  });
}

// The last reaction ends within about ten units of time, so errors of its time matter.
TEST(RandomisedStiffCodes, Hires) {
  if (!has_codes()) GTEST_SKIP() << "this build lacks the codes to compare with";
  randomised_test({.quick = 5, .full = 1500}, [](Draw& draw) {
    const double k_plus = draw.log_uniform(10, 1e4), end = draw.log_uniform(0.1, 1000),
                 tolerance = draw.log_uniform(1e-8, 1e-3);
    const problems::TextProblem p("hires", {{"k_plus", k_plus}});
    const Question q{System(p), p.initial_state(), end, tolerance, 1e-6 * tolerance};
    return compare_with_exact(
        q, tolerances(q, 10),
        fmt::format("k_plus {:.17g}, end {:.17g}, tolerance {:.17g}", k_plus, end, tolerance));
  });
}

}  // namespace
}  // namespace nlmech::ivp::ivp_stiff_codes_test
