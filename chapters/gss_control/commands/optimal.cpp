#include <fmt/format.h>

#include <string>

#include "chapters/gss_control/commands/commands.hpp"
#include "chapters/gss_control/commands/spacecraft_file.hpp"
#include "chapters/gss_control/commands/words.hpp"
#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {
namespace {

/// What was typed.
struct Words {
  Craft craft;
  spacecraft::CostWeights weights;
  bool pd = false;
};

void declare(scene::Options& options, Words& words) {
  declare_craft(options, words.craft, false);
  options.add("--deflection-weight", words.weights.deflection, "W, 1/length^2; 0 or more").required();
  options.add("--torque-weight", words.weights.torque, "R, 1/torque^2").positive().required();
  options.add("--pd", words.pd, "with k2 = 0: no feedback of the root load");
}

std::string optimise(const Words& words) {
  const spacecraft::Parameters craft = read_spacecraft(words.craft.file);
  const spacecraft::CostWeights& w = words.weights;
  if (w.deflection < 0)
    throw InputError(fmt::format("--deflection-weight {}: must not be negative", w.deflection));
  try {
    const spacecraft::OptimalGains best = words.pd ? optimal_pd_gains(craft, w) : optimal_gains(craft, w);
    return fmt::format("k1,k2,k3,cost\n{:.17g},{:.17g},{:.17g},{:.17g}\n", best.gains.k1, best.gains.k2,
                       best.gains.k3, best.cost);
  } catch (const std::invalid_argument& error) {
    throw InputError(
        fmt::format("--deflection-weight {} --torque-weight {}: {}", w.deflection, w.torque, error.what()));
  }
}

}  // namespace

void add_optimal_gains_command(scene::Commands& all) {
  all.add("optimal-gains",
          "Gains that minimise int (theta - theta_f)^2 + W y(L)^2 + R u^2 dt of a turn by 1 rad, as CSV: "
          "k1,k2,k3,cost",
          declare, optimise);
}

}  // namespace nlmech::chapters::gss_control
