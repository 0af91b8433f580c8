/// @file
/// The shipped examples, integrated.
#pragma once

#include <string>
#include <vector>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/program/equations.hpp"

namespace nlmech::chapters::integrators {

/// A solution at some times, and how far an independent one is from its end.
struct Course {
  std::vector<std::string> names;            ///< of the components
  std::vector<double> t;                     ///< times
  std::vector<std::vector<double>> columns;  ///< a component each
  double difference =
      0;  ///< of the end states of two methods, relative to the greatest values; 0 of one alone

  /// The column of a component.
  [[nodiscard]] const std::vector<double>& operator[](const std::string& name) const;
};

/// The equations of chapters/integrators/examples/<name>.ode. @throws Failure if the file is not there
[[nodiscard]] program::Equations example(const std::string& name);

/// From the file's initial values to each of @p times, which rise. @p method and @p other begin anew at each
/// time that is asked for with a tolerance of 1e-13. Where nothing determines the end @p other is empty.
/// @throws Failure if one of them fails
[[nodiscard]] Course course(const program::Equations& equations, const std::vector<double>& times,
                            const std::string& method, const std::string& other);

/// @p count + 1 equidistant times from @p begin to @p end.
[[nodiscard]] std::vector<double> equidistant(double begin, double end, int count);

}  // namespace nlmech::chapters::integrators
