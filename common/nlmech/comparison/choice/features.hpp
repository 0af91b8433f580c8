/// @file
/// The features of an initial value problem by which a method is chosen, found before it is solved.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// A problem for which a method is to be chosen.
struct ChoiceRequest {
  ivp::System system;                                             ///< equations
  ivp::State x0;                                                  ///< state at t0
  double t0;                                                      ///< start
  double t1;                                                      ///< end
  double absolute = 1;                                            ///< absolute over relative tolerance
  std::vector<std::string> methods = {};                          ///< that may be chosen; empty: all
  double largest_step = std::numeric_limits<double>::infinity();  ///< bound on the steps

  /// Limits of a short run. @param steps with one component; fewer with more, at least 50
  [[nodiscard]] ivp::Limits limits(std::int64_t steps) const;
};

/// Does f depend on the time, or on a component that moves at a constant rate? By the recorded equations; of
/// a problem that cannot be recorded by df/dt at (t, x), and true where it has none.
[[nodiscard]] bool depends_on_time(const ivp::System& system, double t, const ivp::State& x);

/// The features of a problem. They are counts and ratios: found twice, they are the same, unless half a
/// second cuts the probe short.
struct Features {
  bool velocity_free = false;  ///< the equations are q'' = a(t, q)
  bool switches = false;       ///< abs, sign, min or max of the state decide which equations hold
  int operations = 0;    ///< of one right-hand side, as recorded for Taylor series; 0: it cannot be recorded
  double stiffness = 0;  ///< mean of |h| rho over coarse steps h of an implicit method, rho the greatest
                         ///< modulus of an eigenvalue of the Jacobian: about 1 where accuracy bounds the
                         ///< steps, more where stability would bound those of an explicit method
};

/// The features, or why there are none.
struct Probe {
  Features features;  ///< as far as the steps went
  Status status;      ///< a failure: the solution ends before t1, or the implicit method fails
};

/// Finds the features by some coarse steps of `adaptive-collocation`, at most so many that they take a few
/// milliseconds with few components.
[[nodiscard]] Probe probe_problem(const ChoiceRequest& request);

}  // namespace nlmech::comparison
