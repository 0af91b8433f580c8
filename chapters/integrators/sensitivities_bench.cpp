/// @file
/// `integrators_sensitivities_bench`: sensitivities at equal error by the variational equations against
/// CVODES; by Google Benchmark. Exit code 1 if a claim does not hold.
#include "chapters/integrators/sensitivity_cases.hpp"
#include "chapters/speed.hpp"
#include "nlmech/comparison/cost/accuracy.hpp"

namespace {

using namespace nlmech;
using chapters::integrators::SensitivityCase;

/// The fastest tolerance of a method with at most the wanted error. @param c outlives the measurement
std::optional<chapters::Work> fastest(const SensitivityCase& c, const std::string& method, double wanted,
                                      const std::string& name) {
  std::vector<ivp::NamedIntegrator> runs;
  for (const double tolerance : chapters::half_decades(8, 27)) runs.push_back(c.method(method, tolerance));
  const comparison::Example& e = c.example;
  return chapters::fastest(
      name, runs, wanted, [&e](const auto& run) { return comparison::accuracy_of(e, run, {}).error; },
      [&e](const auto& run) { return run(e.system, e.x0, e.t0, e.t1, {}, {}).x; });
}

/// Adds the fastest nlmech method, the fastest formula of CVODES and their claim.
void add(chapters::Speed& all, const SensitivityCase& c, double wanted) {
  const std::string at = fmt::format("sensitivities of {} to {:.0e}, ", c.name, wanted);
  std::optional<chapters::Work> mine, peer;
  for (const std::string& method : c.methods()) {
    if (method == "differences") continue;
    std::optional<chapters::Work>& best = method.starts_with("cvodes") ? peer : mine;
    auto found = fastest(c, method, wanted, at + method);
    if (found && (!best || found->seconds < best->seconds)) best = std::move(found);
  }
  if (mine) mine->name = at + "nlmech";
  if (peer) peer->name = at + "CVODES";
  all.add(mine);
  all.add(peer);
  // Measured on a busy machine: 74 and more, stiff 8 and more.
  all.claim(at + "nlmech", at + "CVODES", c.stiff ? 5 : 20, at + "nlmech against CVODES");
}

void rows(chapters::Speed& all) {
  static const std::vector<SensitivityCase> cases[] = {chapters::integrators::sensitivity_cases(false),
                                                       chapters::integrators::sensitivity_cases(true)};
  for (const auto& some : cases) {
    for (const SensitivityCase& c : some) {
      for (const double wanted : {1e-6, 1e-9, 1e-12}) add(all, c, wanted);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("integrators_sensitivities", &rows, argc, argv);
}
