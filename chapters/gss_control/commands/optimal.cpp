#include <fmt/format.h>

#include <memory>
#include <string>

#include "chapters/gss_control/commands/commands.hpp"
#include "chapters/gss_control/commands/spacecraft_file.hpp"
#include "chapters/gss_control/commands/words.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/spacecraft/control/optimal_gains.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::gss_control {
namespace {

/// What was typed.
struct Words {
  std::string craft, deflection, torque;
  bool pd = false;
};

void optimise(const Words& words) {
  const spacecraft::Parameters craft = read_spacecraft(words.craft);
  const spacecraft::CostWeights weights{scene::typed_number("--deflection-weight", words.deflection),
                                        scene::typed_positive("--torque-weight", words.torque)};
  if (weights.deflection < 0)
    throw InputError(fmt::format("--deflection-weight {}: must not be negative", words.deflection));
  try {
    const spacecraft::OptimalGains best =
        words.pd ? optimal_pd_gains(craft, weights) : optimal_gains(craft, weights);
    scene::print_result(fmt::format("k1,k2,k3,cost\n{:.17g},{:.17g},{:.17g},{:.17g}\n", best.gains.k1,
                                    best.gains.k2, best.gains.k3, best.cost));
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--deflection-weight {} --torque-weight {}: {}", words.deflection,
                                 words.torque, error.what()));
  }
}

}  // namespace

void add_optimal_gains_command(CLI::App& app) {
  const auto words = std::make_shared<Words>();  // lives as long as the callback
  CLI::App* const command = app.add_subcommand(
      "optimal-gains",
      "Gains that minimise int (theta - theta_f)^2 + W y(L)^2 + R u^2 dt of a turn by 1 rad, as CSV: "
      "k1,k2,k3,cost");
  command->add_option("--spacecraft", words->craft, spacecraft_help);
  command->add_option("--deflection-weight", words->deflection, "W, 1/length^2; 0 or more")->required();
  command->add_option("--torque-weight", words->torque, "R, 1/torque^2; positive")->required();
  command->add_flag("--pd", words->pd, "with k2 = 0: no feedback of the root load");
  command->callback([words] { optimise(*words); });
}

}  // namespace nlmech::chapters::gss_control
