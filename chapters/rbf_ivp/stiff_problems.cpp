#include "chapters/rbf_ivp/stiff_problems.hpp"

#include <fmt/format.h>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/three_mass_chain.hpp"
#include "nlmech/problems/van_der_pol.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters {
namespace {

template <class Problem>
Stiff<Problem::dimension> stiff(std::string name, const Problem& problem, double end, double rate) {
  const auto x0 = Problem::initial_state();
  const auto reference = comparison::reference_end(problem, x0, 0.0, end, 2'000'000);
  if (!reference.status.ok()) throw Failure(reference.status);
  return {std::move(name), ivp::System<Problem::dimension>(problem), x0, end, rate, reference.x};
}

/// Near |x| = 2, where the motion creeps, the fast eigenvalue is -3 mu.
Stiff<2> van_der_pol(double mu, double end) {
  return stiff(fmt::format("van der Pol {:g}", mu), problems::VanDerPol{.mu = mu}, end, 3 * mu);
}

}  // namespace

std::vector<AnyStiff> stiff_problems(bool quick) {
  problems::ThreeMassChain chain;
  chain.k1 = 1e8;
  std::vector<AnyStiff> all = {
      stiff("Duffing 1e6", problems::Duffing{.hardening = 1e6}, 0.2, std::sqrt(3e6)),
      stiff("three masses 1e8", chain, 2, std::sqrt((chain.k1 + chain.k2) / chain.m1)), van_der_pol(10, 20),
      van_der_pol(100, 200)};
  if (!quick) all.push_back(van_der_pol(1000, 1000));
  return all;
}

}  // namespace nlmech::chapters
