/// @file
/// Ours and the peers, each with a sweep of steps or tolerances: what the error-vs-time scenes and the
/// benchmark set side by side.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nlmech/ivp/named_methods.hpp"

namespace nlmech::chapters {

/// Which methods belong together in a picture.
enum class Kind {
  radial = 1,  ///< collocation by radial functions, steps by hand
  polynomial,  ///< collocation by polynomials and Picard iteration, steps by hand
  classical,   ///< the other methods of fixed step, steps by hand
  explicit_,   ///< step control, explicit
  implicit     ///< step control, implicit
};

/// One setting of a method.
struct Setting {
  std::string text;        ///< "step 0.5", "tolerance 1e-06"
  ivp::Settings settings;  ///< the same
};

/// One method with its sweep, or a peer that this build lacks: no settings.
struct Contender {
  std::string name;               ///< of the method or peer: "rbf-coll"
  std::optional<int> nodes;       ///< of a collocation
  Kind kind;                      ///< for its colour
  std::vector<Setting> settings;  ///< cheapest first

  /// "rbf-coll, N = 35"
  [[nodiscard]] std::string label() const;
};

/// Lengths of steps to begin with, as the dissertation takes them for a problem (Tables 4.2, 4.4, 4.6).
struct StepScales {
  double few_nodes;   ///< step of RBF-Coll with N = 7
  double many_nodes;  ///< step of RBF-Coll with N = 35
  double few_shape;   ///< c times the step for N = 7
  double many_shape;  ///< c times the step for N = 35
};

/// Scales of the free Duffing oscillator: P/10 and P.
[[nodiscard]] StepScales free_duffing_steps();
/// Scales of the impact after its end: 0.5 and 6, and the shape 0.66 that Table 4.4 leaves out.
[[nodiscard]] StepScales impact_steps();
/// Scales of the three masses: 0.625 and 20.
[[nodiscard]] StepScales three_mass_steps();

/// All methods and peers: those of fixed step with steps that begin at the scales, those with step control
/// with one sweep of tolerances for all.
/// @param quick fewer settings of each
[[nodiscard]] std::vector<Contender> contenders(const StepScales& scales, bool quick);

/// Ready to run.
template <int n>
[[nodiscard]] ivp::NamedIntegrator<n> integrator(const Contender& contender, const Setting& setting);

}  // namespace nlmech::chapters
