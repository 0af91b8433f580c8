/// @file
/// Pictures that a user asks for by `--plot`, and what they need of a run.
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

/// The components of a run by time: places within each step, and of long runs the extremes of as many of them
/// as fall together, so that a picture shows every peak whatever the number of steps.
class SampledPath {
 public:
  /// For a run from @p t0 to @p t1.
  SampledPath(double t0, double t1) : t0_(t0), t1_(t1) {}

  /// A state.
  void add(double t, const Eigen::VectorXd& x);
  /// States within a step and before @p end, where it or the run is over.
  void see(const ivp::Step& step, double end);

  /// Is there none?
  [[nodiscard]] bool empty() const { return bins_.empty(); }
  /// Times and values of a component, in the order of time.
  [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> component(std::size_t i) const;

 private:
  struct Point {
    double t, x;
  };
  /// The least and the greatest value of a few places that follow each other.
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

/// A run as a picture shows it.
struct PlotSamples {
  /// A component of the state.
  struct Component {
    std::string name;           ///< "x"
    bool unknown = true;        ///< and no derivative of another component
    std::optional<int> rate{};  ///< the component that is its derivative
  };
  /// A state by its time.
  struct Moment {
    double t;               ///< time
    std::vector<double> x;  ///< state
  };
  std::vector<Component> components;  ///< of the state
  SampledPath path{0, 0};             ///< for runs without section
  std::vector<Moment> events;         ///< where they took place, points of the section among them
};

/// The unknowns against time, a panel each and at most most_panels of them, with a point at each event. The
/// time is logarithmic where most of the steps lie within the first thousandth of it.
/// @param heading as it stands, without markup
/// @throws Failure for a run of no length
[[nodiscard]] scene::Figure run_figure(const PlotSamples& run, const std::string& heading);

/// The points of a section: an unknown and its derivative, or two unknowns, the first pair of which neither
/// is constant there.
/// @throws Failure if there are none
[[nodiscard]] scene::Figure section_figure(const PlotSamples& run, const std::string& heading);

/// Digits against run time and against right-hand sides.
/// @throws Failure if no method has digits
[[nodiscard]] scene::Figure comparison_figure(const std::vector<scene::MethodLine>& lines,
                                              const std::string& heading);

/// Unknowns that a picture shows.
inline constexpr int most_panels = 12;

}  // namespace nlmech::comparison
