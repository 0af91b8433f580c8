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
  radial = 1,   ///< collocation by radial functions, steps by hand
  polynomial,   ///< collocation by polynomials and Picard iteration, steps by hand
  classical,    ///< the other methods of fixed step, steps by hand
  explicit_,    ///< step control, explicit
  implicit,     ///< step control, implicit
  series,       ///< Taylor series
  closed_form,  ///< no integration at all
  own           ///< adaptive collocation
};

/// The kind of a method or peer.
[[nodiscard]] Kind kind_of(const AnyMethod& method);

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
