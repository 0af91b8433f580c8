#include "chapters/rbf_ivp/stability/stiff_problems.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

/// Problem with a reference by Taylor series; errors relative to the largest component.
template <class Problem>
Stiff by_series(std::string name, const Problem& problem, double end, double rate) {
  const auto& x0 = problem.initial_state();
  ivp::LongState reference;
  const Status status = problems::integrate_reference<long double>(
      problem, x0.template cast<long double>(), 0, end, {.most_steps = 2'000'000},
      [&](const auto& /*step*/, const auto& x) { reference = x; });
  if (!status.ok()) throw Failure(status);
  const long double size = reference.cwiseAbs().maxCoeff();
  return {std::move(name),
          ivp::System(problem),
          x0,
          end,
          rate,
          reference,
          ivp::LongState::Constant(x0.size(), size)};
}

/// Problem with a published reference; errors relative to each component.
Stiff by_test_set(std::string name, const problems::TextProblem& problem, double end, double rate,
                  std::initializer_list<long double> digits) {
  ivp::LongState reference(static_cast<Eigen::Index>(digits.size()));
  std::copy(digits.begin(), digits.end(), reference.begin());
  return {std::move(name), ivp::System(problem), problem.initial_state(), end, rate,
          reference,       reference.cwiseAbs()};
}

/// Van der Pol oscillator. In the slow phase near |x| = 2 the fast eigenvalue is -3 mu.
Stiff van_der_pol(double mu, double end) {
  return by_series(fmt::format("van der Pol {:g}", mu), problems::TextProblem("van-der-pol", {{"mu", mu}}),
                   end, 3 * mu);
}

}  // namespace

Stiff stiff_duffing() {
  return by_series("Duffing 1e6", problems::TextProblem("duffing", {{"hardening", 1e6}}), 0.2,
                   std::sqrt(3e6));
}

Stiff stiff_masses() {
  const problems::TextProblem chain("three-dof", {{"k1", 1e8}});
  return by_series("three masses 1e8", chain, 2, std::sqrt((1e8 + 1) / 2));  // frequency of k1 + k2 and m1
}

// References of these three and their source: tables/reference/ivp_test_set.csv.
Stiff van_der_pol_of_the_test_set() {
  auto p = by_test_set("van der Pol 1000", problems::TextProblem("van-der-pol", {{"mu", 1000}}), 2000, 3000,
                       {1.706167732170483L, -0.8928097010247975e-3L});
  p.absolute = 1e-3;
  return p;
}

Stiff robertson() {
  // Eigenvalue of y2: -k1 at the start, later about -k2.
  auto p = by_test_set("Robertson", problems::TextProblem("robertson"), 1e11, 1e4,
                       {0.2083340149701255e-7L, 0.8333360770334713e-13L, 0.9999999791665050L});
  p.absolute = 1e-8;
  p.halvings = 10;  // of 1e11 s; equal steps short enough for the first second would be 1e14
  return p;
}

Stiff hires() {
  auto p =
      by_test_set("HIRES", problems::TextProblem("hires"), 321.8122, 100,
                  {0.73713125733256e-3L, 0.14424857263161e-3L, 0.58887297409675e-4L, 0.11756513432831e-2L,
                   0.23863561988313e-2L, 0.62389682527427e-2L, 0.28499983951857e-2L, 0.28500016048142e-2L});
  p.absolute = 1e-4;
  p.halvings = 18;
  return p;
}

std::vector<Stiff> stiff_problems(bool quick) {
  std::vector<Stiff> all = {stiff_duffing(), stiff_masses(), van_der_pol(10, 20), van_der_pol(100, 200)};
  if (!quick) all.emplace_back(van_der_pol(1000, 1000));
  all.emplace_back(robertson());
  all.emplace_back(hires());
  return all;
}

}  // namespace nlmech::chapters::rbf_ivp
