/// @file
/// Position errors of runs under one reading or another, of all three examples alike.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "chapters/rbf_ivp/examples/runs.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Errors of one run in time.
struct Trace {
  /// A value that the method gave.
  struct Value {
    double t;                    ///< time
    bool end;                    ///< the end of a step
    std::vector<double> errors;  ///< of all components
  };
  std::vector<Value> values;  ///< without the begin
  double amplitude = 1;       ///< of the first component

  /// RMS error of component @p i up to a time; the begin is counted among the ends of steps if asked for.
  [[nodiscard]] double rms(double until, Points points = Points::ends, std::size_t i = 0,
                           bool begin = true) const;
  /// The same of the norm of all components.
  [[nodiscard]] double rms_of_norm(double until) const;
};

/// A table's steps.
struct Setting {
  std::string table;  ///< "table-4.2"
  std::string steps;  ///< as in the row's name: "(P/10)"
  double first;       ///< step
  double second = 0;  ///< step after the impact
};

/// The end to which the printed errors of a table seem to belong.
[[nodiscard]] double inferred_end(const std::string& table);

/// The first and second settings of the step methods, with steps of a period @p P: Newmark's and HHT's.
[[nodiscard]] std::vector<Setting> implicit_settings(double P);

/// Runs a procedure on the free oscillator, whose reference is a Taylor series here.
[[nodiscard]] Trace trace_of_duffing(const Procedure& procedure);
/// Runs a procedure on the oscillator under the impact.
[[nodiscard]] Trace trace_of_impact(const Procedure& procedure);
/// Runs a procedure on the three masses.
[[nodiscard]] Trace trace_of_chain(const Procedure& procedure);

/// Runs a method with the steps of a setting on the example of its table.
template <class Method>
[[nodiscard]] Trace trace(const Setting& setting, Method method) {
  method.step = setting.first;
  if (setting.table == "table-4.2") return trace_of_duffing(throughout(method));
  if (setting.table == "table-4.6") return trace_of_chain(throughout(method));
  Method after = method;
  after.step = setting.second;
  return trace_of_impact(in_two_phases(method, after));
}

}  // namespace nlmech::chapters::rbf_ivp
