/// @file
/// What a picture shows of a run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/ivp/solution.hpp"

namespace nlmech::comparison {

/// The components of a run by time: places within each step, and of long runs the extremes of as many of them
/// as fall together, so that a picture shows every peak whatever the number of steps.
class Samples {
 public:
  /// For a run from @p t0 to @p t1.
  Samples(double t0, double t1) : t0_(t0), t1_(t1) {}

  /// A state.
  template <class State>
  void add(double t, const State& x) {
    bins_.resize(static_cast<std::size_t>(x.size()));
    const bool joins = inside_ > 0 && inside_ < stride_;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      const Point here{t, x[static_cast<Eigen::Index>(i)]};
      if (joins)
        bins_[i].back().include({here, here});
      else
        bins_[i].push_back({here, here});
    }
    inside_ = joins ? inside_ + 1 : 1;
    if (bins_.front().size() > most_bins) halve();
  }
  /// States within a step and before @p end, where it or the run is over.
  void see(const ivp::Step& step, double end) {
    const double way = end - step.t0, share = std::abs(way / (t1_ - t0_));
    const int places = static_cast<int>(std::clamp(std::ceil(1000 * share), 8.0, 1000.0));
    for (int k = 1; k < places; ++k) {
      const double t = step.t0 + way * k / places;
      add(t, step.at(t));
    }
    add(end, step.at(end));
  }

  /// Is there none?
  [[nodiscard]] bool empty() const { return bins_.empty(); }
  /// Times and values of a component, in the order of time.
  [[nodiscard]] std::pair<std::vector<double>, std::vector<double>> component(std::size_t i) const {
    std::pair<std::vector<double>, std::vector<double>> all;
    const auto put = [&](const Point& p) {
      all.first.push_back(p.t);
      all.second.push_back(p.x);
    };
    for (const Bin& bin : bins_.at(i)) {
      const bool low_first = (bin.high.t - bin.low.t) * (t1_ - t0_) >= 0;
      put(low_first ? bin.low : bin.high);
      if (bin.low.t != bin.high.t) put(low_first ? bin.high : bin.low);
    }
    return all;
  }

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

  void halve() {
    for (std::vector<Bin>& bins : bins_) {
      for (std::size_t k = 0; 2 * k < bins.size(); ++k) {
        bins[k] = bins[2 * k];
        if (2 * k + 1 < bins.size()) bins[k].include(bins[2 * k + 1]);
      }
      bins.resize((bins.size() + 1) / 2);
    }
    stride_ *= 2;  // the last one, which had no partner, gets what follows
  }

  double t0_, t1_;
  std::vector<std::vector<Bin>> bins_;  // by component
  std::size_t stride_ = 1, inside_ = 0;
};

/// A component of the state, as pictures show it.
struct Shown {
  std::string name;           ///< "x"
  bool unknown = true;        ///< and no derivative of another component
  std::optional<int> rate{};  ///< the component that is its derivative
};

/// A run as a picture shows it.
struct Seen {
  /// A state by its time.
  struct Moment {
    double t;               ///< time
    std::vector<double> x;  ///< state
  };
  std::vector<Shown> components;  ///< of the state
  Samples path{0, 0};             ///< the way, for runs without section
  std::vector<Moment> events;     ///< where they took place, points of the section among them
};

}  // namespace nlmech::comparison
