/// @file
/// What there is to see of a problem before it is solved: the few numbers by which problems are called alike.
#pragma once

#include <limits>
#include <string_view>

#include "nlmech/ivp/system.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::comparison {

/// Which equations a problem has, for methods that are made for some of them.
enum class Form {
  first_order,    ///< dx/dt = f
  accelerations,  ///< q'' = a(t, q, q')
  conservative    ///< q'' = a(t, q): no acceleration depends on a velocity
};
/// "first-order", "accelerations", "conservative".
[[nodiscard]] std::string_view to_string(Form form);

/// By the Jacobian at a state and beside it.
[[nodiscard]] Form form_of(const ivp::System& system, double t, const ivp::State& x);

/// Does f depend on the time, or on a component that moves at a constant rate? By the recorded equations; of
/// a problem that cannot be recorded by df/dt at (t, x), and true where it has none.
[[nodiscard]] bool depends_on_time(const ivp::System& system, double t, const ivp::State& x);

/// The features of a problem. Counts decide, and never times: two looks are the same.
struct Features {
  int components = 0;             ///< of the state
  Form form = Form::first_order;  ///< of the equations
  bool switches = false;          ///< do functions decide by their signs what the equations are?
  bool depends_on_time = false;   ///< do they change with the time itself? See depends_on_time()
  int operations = 0;    ///< of a right-hand side, as recorded for Taylor series; 0: they are refused
  double stiffness = 0;  ///< log10 of the mean of |h| rho over coarse steps h of an implicit method, rho the
                         ///< greatest modulus of an eigenvalue: about 1 where accuracy bounds the steps, more
                         ///< where stability would bound those of an explicit method
  double decay = 0;      ///< share of the decay in that eigenvalue: 1 decays, 0 swings
  double variation = 0;  ///< log10 of the ratio of long steps to short ones, the longest and the shortest
                         ///< tenth of the way aside
};

/// What came of a look.
struct Look {
  Features features;  ///< as far as seen
  Status status;      ///< a failure: the solution ends before the way does, or cannot be stepped along
  double seen = 0;    ///< share of the way, from 0 to 1
};

/// Looks at a problem by some coarse steps of `adaptive-collocation`, at most so many that it takes a few
/// milliseconds with few components.
/// @param largest_step that runs are held to
[[nodiscard]] Look look_at_problem(const ivp::System& system, const ivp::State& x0, double t0, double t1,
                                   double largest_step = std::numeric_limits<double>::infinity());

}  // namespace nlmech::comparison
