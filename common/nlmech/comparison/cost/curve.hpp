/// @file
/// What the settings of a method cost, and what it is drawn with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nlmech/comparison/any_method.hpp"
#include "nlmech/support/statistics.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::comparison {

/// Which methods belong together in a picture.
enum class Kind {
  source,         ///< the method of the page's source
  own,            ///< what became of it: adaptive collocation, analytic continuation
  closed_form,    ///< no integration at all
  series,         ///< Taylor series
  polynomial,     ///< collocation and Picard iteration, steps by hand
  classical,      ///< the other methods of fixed step, steps by hand
  explicit_,      ///< Runge-Kutta and Nystrom methods with step control
  extrapolation,  ///< explicit, with control of step and order
  adams,          ///< multistep, not for stiff problems
  implicit        ///< step control, for stiff problems
};

/// The kind of a method or peer, where no page has a source of its own.
[[nodiscard]] Kind kind_of(const ivp::MethodInfo& method);

/// What one setting of one method came to.
struct Cost {
  std::string setting;          ///< "tolerance 1e-06"
  std::string status;           ///< "success"
  std::optional<double> error;  ///< median of the relative errors; nothing if the run failed
  Statistics work;              ///< of one run
  Timing time;                  ///< seconds
};

/// A method with what its settings cost.
struct Curve {
  std::string name;         ///< of the method
  Kind kind;                ///< for its colour
  std::vector<Cost> costs;  ///< empty: not in this build
};

}  // namespace nlmech::comparison
