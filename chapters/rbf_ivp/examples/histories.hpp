/// @file
/// Figures of errors against time, and of solutions over a short window.
#pragma once

#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/rows.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Error shown in a figure, normalised by the amplitudes of the response (Eq. 4.21).
enum class Shown {
  state,      ///< "Normalized State Error": Euclidean norm of position and velocity
  positions,  ///< "Normalized Position Error": one curve per mass
  velocities  ///< "Normalized Velocity Error": one curve per mass
};

/// Figure of the error of a row against time.
struct History {
  int figure;              ///< number; 14 is Figure 4.14
  std::string method;      ///< method of the row, such as "RBF-Coll-1"
  Shown shown;             ///< error named in the printed caption
  Expected velocity = {};  ///< expected RMS error of the first velocity, if the figure shows velocities
};

/// Scene "fig-4.<figure>": errors at all values of the method, and at the ends of steps if there are other
/// values. Also draws the inferred reading if it has different settings.
[[nodiscard]] scene::Scene history(const Example& example, const History& figure);

/// Scene of the largest position error against time, one panel per run with common axes.
/// @param methods of rows; two successive ones are side by side
[[nodiscard]] scene::Scene histories(const Example& example, const std::string& name,
                                     const std::vector<std::string>& methods);

/// Figure of solutions over the window of the runs of an example.
struct Comparison {
  int figure;                        ///< number; 16 is Figure 4.16
  int component;                     ///< component of the state
  std::string symbol;                ///< label, such as "x_1(t)"
  std::vector<std::string> methods;  ///< rows of the example
  std::string also_inferred = {};    ///< method of which the inferred reading is drawn too
};

/// Scene "fig-4.<figure>": reference, dense output and step ends of each method.
[[nodiscard]] scene::Scene comparison(const Example& example, const Comparison& figure);

/// A point of a curve.
struct TimeError {
  double t;      ///< time
  double error;  ///< magnitude of the error
};

/// Largest error in each of @p bins equal intervals of [begin, end], with its time; intervals without errors
/// are omitted.
[[nodiscard]] std::vector<TimeError> greatest_by_bin(const std::vector<TimeError>& errors, double begin,
                                                     double end, int bins);

/// Growth exponent of an error over the last nine tenths of the time: least-squares slope of log error
/// against log time.
[[nodiscard]] double growth_exponent(const std::vector<TimeError>& errors);

}  // namespace nlmech::chapters::rbf_ivp
