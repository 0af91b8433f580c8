/// @file
/// Figures of `--plot`, and the samples of a run that they show.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/ivp/solution.hpp"
#include "nlmech/scene/cost/lines.hpp"
#include "nlmech/scene/show.hpp"

namespace nlmech::comparison {

/// Samples of the components of a run within each step, in at most 4000 bins of consecutive samples. A bin
/// keeps its minimum and maximum, so that a figure shows every peak whatever the number of steps.
class SampledPath {
 public:
  /// For a run from @p t0 to @p t1.
  SampledPath(double t0, double t1) : t0_(t0), t1_(t1) {}

  /// Adds a state.
  void add(double t, const Eigen::VectorXd& x);
  /// Adds 8 to 1000 states of a step up to @p end, the end of the step or of the run.
  void see(const ivp::Step& step, double end);

  /// Are there no states?
  [[nodiscard]] bool empty() const { return bins_.empty(); }
  /// Times and values of a component, ordered by time.
  [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> component(std::size_t i) const;

 private:
  struct Point {
    double t, x;
  };
  /// Minimum and maximum of a few consecutive samples.
  struct Bin {
    Point low, high;
    void include(const Bin& other) {
      if (other.low.x < low.x) low = other.low;
      if (other.high.x > high.x) high = other.high;
    }
  };
  static constexpr std::size_t most_bins = 4000;  // even

  void halve();

  double t0_, t1_;
  std::vector<std::vector<Bin>> bins_;  // by component
  std::size_t stride_ = 1, inside_ = 0;
};

/// Samples of a run for plotting.
struct PlotSamples {
  /// A component of the state.
  struct Component {
    std::string name;           ///< "x"
    bool unknown = true;        ///< false for the derivative of another component
    std::optional<int> rate{};  ///< index of the component that is its derivative
  };
  /// A time and the state there.
  struct Moment {
    double t;               ///< time
    std::vector<double> x;  ///< state
  };
  std::vector<Component> components;  ///< components of the state
  SampledPath path{0, 0};             ///< samples of a run without section
  std::vector<Moment> events;         ///< states at events, including the points of a section
};

/// Figure of the unknowns against time, one panel each and at most most_panels, with a point at each event.
/// The time axis is logarithmic if most of the steps lie within its first thousandth.
/// @param heading plain text without markup
/// @throws Failure for a run of length zero
[[nodiscard]] scene::Figure run_figure(const PlotSamples& run, const std::string& heading);

/// Figure of the points of a section in the plane of two components: the first pair of which neither is
/// constant, pairs of an unknown and its derivative first; else a component against time.
/// @throws Failure for fewer than two points to show
[[nodiscard]] scene::Figure section_figure(const PlotSamples& run, const std::string& heading);

/// Figure of digits against run time and against right-hand sides.
/// @throws Failure if no method has any correct digits
[[nodiscard]] scene::Figure comparison_figure(const std::vector<scene::MethodLine>& lines,
                                              const std::string& heading);

/// Greatest number of unknowns in a figure.
inline constexpr int most_panels = 12;

}  // namespace nlmech::comparison
