/// @file
/// Figures of errors against time, and of solutions over a short window.
#pragma once

#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/rows.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Which error a figure shows, normalised by the amplitudes of the response (Eq. 4.21).
enum class Shown {
  state,      ///< "Normalized State Error": Euclidean norm of position and velocity
  positions,  ///< "Normalized Position Error": one curve a mass
  velocities  ///< "Normalized Velocity Error": one curve a mass
};

/// A figure of the error of a row.
struct History {
  int figure;              ///< 14: Figure 4.14
  std::string method;      ///< of the row: "RBF-Coll-1"
  Shown shown;             ///< what its caption says
  Expected velocity = {};  ///< RMS error of the first velocity, where the figure shows velocities
};

/// "fig-4.<figure>": the error at all values that the method gives, and at the ends of its steps where it
/// gives more than those; where the inferred reading has settings of its own, its errors beside them.
[[nodiscard]] scene::Scene history(const Example& example, const History& figure);

/// The greatest position error in time of several runs, a panel each on common axes: methods whose settings
/// follow each other stand side by side.
/// @param methods of rows, two a line of panels
[[nodiscard]] scene::Scene histories(const Example& example, const std::string& name,
                                     const std::vector<std::string>& methods);

/// A figure of solutions over the window that the runs of an example keep.
struct Comparison {
  int figure;                        ///< 16: Figure 4.16
  int component;                     ///< of the state
  std::string symbol;                ///< "x_1(t)"
  std::vector<std::string> methods;  ///< rows of the example
  std::string also_inferred = {};    ///< one of them whose inferred reading is drawn too
};

/// "fig-4.<figure>": the reference, dense output and step ends of each method.
[[nodiscard]] scene::Scene comparison(const Example& example, const Comparison& figure);

/// A point of a curve.
struct TimeError {
  double t;      ///< time
  double error;  ///< magnitude
};

/// The greatest error of each of @p bins equal parts of [begin, end], at the time where it occurs; parts
/// without errors are left out.
[[nodiscard]] std::vector<TimeError> greatest_by_bin(const std::vector<TimeError>& errors, double begin,
                                                     double end, int bins);

/// The power of time as which a curve grows over the last nine tenths of its time: slope of the straight line
/// that fits log error against log time best.
[[nodiscard]] double growth_exponent(const std::vector<TimeError>& errors);

}  // namespace nlmech::chapters::rbf_ivp
