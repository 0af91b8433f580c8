/// @file
/// `integrators_sensitivities_bench`: sensitivities at equal error by the variational equations, with Taylor
/// series, against CVODES; by Google Benchmark. Exit code 1 if a claim does not hold.
#include <map>
#include <memory>

#include "chapters/integrators/sensitivity_cases.hpp"
#include "chapters/speed.hpp"

namespace {

using namespace nlmech;
using chapters::integrators::SensitivityCase;
using chapters::integrators::SensitivityMethod;

/// The fastest tolerance of a method with at most the wanted error. @param c outlives the measurement
std::optional<chapters::Work> fastest(const SensitivityCase& c, const SensitivityMethod& method,
                                      double wanted, const std::string& name) {
  return chapters::fastest(
      name, chapters::half_decades(8, 27), wanted,
      [&](double tolerance) { return c.error(method.make(tolerance)); },
      [&c, method, runs = std::make_shared<std::map<double, SensitivityMethod::Run>>()](double tolerance) {
        SensitivityMethod::Run& run = (*runs)[tolerance];
        if (!run) run = method.make(tolerance);
        return run(c.end);
      });
}

void rows(chapters::Speed& all) {
  static const std::vector<SensitivityCase> cases = chapters::integrators::sensitivity_cases();
  for (const SensitivityCase& c : cases) {
    for (const double wanted : {1e-6, 1e-9, 1e-12}) {
      const std::string at = fmt::format("sensitivities of {} to {:.0e}, ", c.name, wanted);
      std::optional<chapters::Work> peer;
      std::string own;
      for (const SensitivityMethod& method : c.methods()) {
        const std::string name = at + method.name;
        if (method.name == "series") {
          all.add(fastest(c, method, wanted, own = name));
        } else if (method.name.starts_with("cvodes")) {
          auto found = fastest(c, method, wanted, name);
          if (found && (!peer || found->seconds < peer->seconds)) peer = std::move(found);
        }
      }
      if (peer) peer->name = at + "CVODES";
      all.add(peer);
      all.claim(own, at + "CVODES", 1);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("integrators_sensitivities", &rows, argc, argv);
}
