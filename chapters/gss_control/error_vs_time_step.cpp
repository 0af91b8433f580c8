#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "chapters/gss_control/modal_loop.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/peers/ivp/cvode.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/spacecraft/assumed_modes.hpp"
#include "nlmech/spacecraft/inverse_laplace.hpp"
#include "nlmech/spacecraft/response.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::gss_control {
namespace {

using spacecraft::Complex;

constexpr std::array places = {2.0};
/// By what errors of the deflection are divided: its peak in the manoeuvre, ft.
constexpr double deflection_scale = 0.0817;

/// theta and y(2 ft) at the asked times.
struct History {
  std::vector<double> theta, deflection;
};
using Compute = std::function<History()>;

struct Cost {
  std::string method, setting;
  double middle = 0, largest = 0;  ///< of the errors over the times
  Timing time;                     ///< of all times together

  [[nodiscard]] double seconds() const { return time.median; }
  [[nodiscard]] double digits() const { return std::clamp(-std::log10(middle), 0., 17.); }
};

std::vector<double> end_times() { return equidistant(3, 6, 16); }

double error(const History& ours, const History& truth, std::size_t i) {
  return std::max(std::abs(ours.theta[i] - truth.theta[i]),
                  std::abs(ours.deflection[i] - truth.deflection[i]) / deflection_scale);
}

/// One family after the other.
class Field {
 public:
  explicit Field(bool quick) : quick_(quick), loop_(craft(true), designed_gains), times_(end_times()) {
    const auto r = step_response(loop_, 1, places, {.pairs = 400});
    truth_ = sample(r);
  }

  std::vector<Cost> measure() {
    residues();
    inversions();
    bromwich_lines();
    if (peers::cvode_available()) discretised();
    return std::move(costs_);
  }

 private:
  [[nodiscard]] History sample(const spacecraft::TimeResponse& r) const {
    History h;
    for (const double t : times_) {
      h.theta.push_back(r.theta.value(t));
      h.deflection.push_back(r.deflection.front().value(t));
    }
    return h;
  }

  void add(const std::string& method, const std::string& setting, const Compute& compute, int repeats) {
    const Stopwatch watch;
    const History h = compute();
    const double once = watch.seconds();  // what takes long is timed once
    std::vector<double> errors;
    for (std::size_t i = 0; i < times_.size(); ++i) {
      const double e = i < h.theta.size() ? error(h, truth_, i) : HUGE_VAL;
      errors.push_back(std::isfinite(e) ? e : 1);
    }
    costs_.push_back({method, setting, std::max(median(errors), 1e-17),
                      *std::max_element(errors.begin(), errors.end()),
                      quick_ || once > 0.2 ? Timing{once, once, once, 1}
                                           : time_repeats([&] { static_cast<void>(compute()); }, repeats)});
  }

  void residues() {
    for (const int pairs : {1, 2, 4, 8, 16, 32, 64}) {
      if (quick_ && pairs > 16) continue;
      const spacecraft::ResidueOptions options{.pairs = pairs};
      add(
          "residues and their poles", fmt::format("{} pairs", pairs),
          [&] { return sample(step_response(loop_, 1, places, options)); }, 3);
      const auto known = step_response(loop_, 1, places, options);
      add(
          "residues, poles known", fmt::format("{} pairs", pairs), [&] { return sample(known); }, 11);
    }
  }

  [[nodiscard]] Complex transform(const Complex& s, bool hub) const {
    const auto r = loop_.response(s, places.front());
    return (hub ? r.theta : r.deflection) / s;
  }

  template <class Invert>
  [[nodiscard]] History inverted(const Invert& invert) const {
    History h;
    for (const double t : times_) {
      h.theta.push_back(invert([this](Complex s) { return transform(s, true); }, t));
      h.deflection.push_back(invert([this](Complex s) { return transform(s, false); }, t));
    }
    return h;
  }

  void inversions() {
    for (const int nodes : {8, 12, 16, 24, 32, 48}) {
      add(
          "Talbot", fmt::format("{} nodes", nodes),
          [&] {
            return inverted([nodes](const spacecraft::Transform& f, double t) {
              return spacecraft::talbot_sum(f, t, nodes);
            });
          },
          5);
    }
    for (const int degree : {10, 20, 40, 80, 160, 320}) {
      if (quick_ && degree > 80) continue;
      add(
          "de Hoog", fmt::format("degree {}", degree),
          [&] {
            return inverted([degree](const spacecraft::Transform& f, double t) {
              return spacecraft::de_hoog_sum(f, t, {.degree = degree});
            });
          },
          3);
    }
  }

  void bromwich_lines() {
    for (const double highest : {1e2, 3e2, 1e3, 3e3, 1e4}) {
      if (quick_ && highest > 3e3) continue;
      add(
          "Bromwich", fmt::format("to {} rad/s", highest),
          [&] {
            const spacecraft::BromwichOptions options{.frequency = highest};
            History h;
            for (const bool hub : {true, false}) {
              auto& values = hub ? h.theta : h.deflection;
              for (const auto& v :
                   bromwich([&](const Complex& s) { return transform(s, hub); }, times_, options))
                values.push_back(v.value);
            }
            return h;
          },
          3);
    }
  }

  [[nodiscard]] History integrated(const ivp::System<Eigen::Dynamic>& system, const ModalLoop& loop,
                                   const Eigen::VectorXd& shapes, double tolerance) const {
    History h;
    const auto watch = [&](const ivp::Step<Eigen::Dynamic>& step) {
      Eigen::VectorXd x;
      while (h.theta.size() < times_.size() && times_[h.theta.size()] <= step.t1) {
        x.resize(step.x1.size());
        step.dense.at(times_[h.theta.size()], x);
        h.theta.push_back(loop.angle(x));
        h.deflection.push_back(shapes.dot(x.segment(1, shapes.size())));
      }
      return true;
    };
    const peers::Cvode method{peers::Cvode::Formula::adams, tolerance, 1e-3 * tolerance};
    const auto solution = ivp::integrate(system, Eigen::VectorXd::Zero(loop.size()), 0, times_.back(), method,
                                         ivp::Observer<Eigen::Dynamic>(watch), {.steps = 400'000});
    if (!solution.status.ok()) return {};
    return h;
  }

  void discretised() {
    for (const int modes : {5, 10, 20}) {
      if (quick_ && modes > 5) continue;
      const auto model = diagonalise(spacecraft::assumed_modes(loop_.parameters(), modes));
      const ModalLoop problem(model, designed_gains, 1);
      const ivp::System<Eigen::Dynamic> system(problem);
      const Eigen::VectorXd shapes = model.mode_shapes(places.front());
      for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        if (modes > 10 && tolerance != 1e-5) continue;
        add(
            fmt::format("{} assumed modes by CVODE", modes), fmt::format("tolerance {:.0e}", tolerance),
            [&] { return integrated(system, problem, shapes, tolerance); }, 1);
      }
    }
  }

  bool quick_;
  spacecraft::ClosedLoop loop_;
  std::vector<double> times_;
  History truth_;
  std::vector<Cost> costs_;
};

std::vector<Cost> measure_all(bool quick) { return Field(quick).measure(); }

/// Those of a method; none of CVODE's without CVODE.
std::vector<Cost> of(const std::vector<Cost>& all, const std::string& method) {
  std::vector<Cost> found;
  std::ranges::copy_if(all, std::back_inserter(found), [&](const Cost& c) { return c.method == method; });
  return found;
}

double best(const std::vector<Cost>& all, const std::string& method) {
  return std::ranges::min(of(all, method), {}, &Cost::middle).middle;
}

void draw(const std::vector<Cost>& all, scene::Show& show) {
  scene::Panel& panel =
      show.plot("Residues gain digits; ten assumed modes stop at three", "time for 16 instants (s)",
                "digits of {/:Italic θ} and {/:Italic y}, median");
  panel.log_x(1e-6, 10)
      .y_range(0, 17)
      .set("ytics 0, 2")
      .set("bmargin at screen 0.31")
      .key("at screen 0.53, screen 0.005 center bottom samplen 3 width -2 spacing 1.1 maxrows 5 maxcols 2");
  show.figure().size(760, 600).columns({"curve", "panel", "time_s", "y"});
  struct Drawn {
    const char* method;
    int style;
  };
  for (const Drawn& d : {Drawn{"residues, poles known", 1},
                         {"residues and their poles", 6},
                         {"Talbot", 2},
                         {"de Hoog", 4},
                         {"Bromwich", 3},
                         {"5 assumed modes by CVODE", 7},
                         {"10 assumed modes by CVODE", 5},
                         {"20 assumed modes by CVODE", 8}}) {
    const std::vector<Cost> costs = of(all, d.method);
    if (!costs.empty())
      panel.curve(d.method, costs, &Cost::seconds, &Cost::digits, scene::linespoints(d.style));
  }
}

void put(const std::vector<Cost>& all, scene::Show& show) {
  draw(all, show);
  show.table(all, {{"method", &Cost::method},
                   {"setting", &Cost::setting},
                   {"median error", &Cost::middle, 2},
                   {"largest error", &Cost::largest, 2},
                   {"time (ms)", [](const Cost& c) { return 1e3 * c.time.median; }, 3},
                   {"from", [](const Cost& c) { return 1e3 * c.time.smallest; }, 3},
                   {"to", [](const Cost& c) { return 1e3 * c.time.largest; }, 3}});
  show.at_most("least error of residues", best(all, "residues, poles known"), 1e-7,
               "theta and y fall like n^-6 and n^-5: 16 pairs leave 16^-4 of a small part");
  show.at_most("least error of the Bromwich integral", best(all, "Bromwich"), 1e-6,
               "what lies beyond 1.2e4 rad/s, below 1e-8 ft in y");
  if (peers::cvode_available())
    show.between("least error of five assumed modes by CVODE", best(all, "5 assumed modes by CVODE"), 1e-6,
                 0.2,
                 "truncation: y of ten modes is off by 5e-4 ft of 0.082 ft "
                 "(tests/spacecraft/lyapunov_test.cpp)");
}

}  // namespace

std::vector<scene::Scene> error_vs_time_step() {
  const scene::Result times(
      "step-times",
      "designed gains, from rest to 1 rad; theta and y(2 ft) at 16 instants from 3 to 6 s; error against 400 "
      "residues, the deflection's over its peak; one thread, median of repeats; models are made beforehand",
      measure_all);
  return {{.name = "error-vs-time-step",
           .title = "Digits of a manoeuvre against time: residues, numerical inversion, assumed modes",
           .content = scene::Content(put, times)}};
}

}  // namespace nlmech::chapters::gss_control
