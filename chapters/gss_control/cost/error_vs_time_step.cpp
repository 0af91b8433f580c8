#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "chapters/gss_control/control/modal_loop.hpp"
#include "chapters/gss_control/craft.hpp"
#include "chapters/gss_control/grids.hpp"
#include "nlmech/ivp/integrate.hpp"
#include "nlmech/peers/ivp/sundials/cvode.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/scene/work_precision.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/response.hpp"

namespace nlmech::chapters::gss_control::error_vs_time_step {
namespace {

using spacecraft::Complex;

constexpr std::array places = {2.0};
/// Scale of the errors of the deflection: its peak in the manoeuvre, ft.
constexpr double deflection_scale = 0.0817;

/// theta and y(2 ft) at the output times.
struct History {
  std::vector<double> theta, deflection;
};
using Compute = std::function<History()>;

enum Group : std::size_t { residue_sums, inversion, truncation };
constexpr std::array sides = {scene::Side::subject, scene::Side::library, scene::Side::peer};

std::vector<double> end_times() { return equidistant(3, 6, 16); }

double error(const History& computed, const History& exact, std::size_t i) {
  return std::max(std::abs(computed.theta[i] - exact.theta[i]),
                  std::abs(computed.deflection[i] - exact.deflection[i]) / deflection_scale);
}

/// f(t) from its transform by the fixed Talbot method with @p nodes nodes (Abate and Valko 2004).
template <class Transform>
double talbot_sum(const Transform& transform, double time, int nodes) {
  const double r = 2. * nodes / (5 * time);  // intersection of the contour with the real axis
  double sum = std::exp(r * time) * transform(Complex(r)).real() / 2;
  for (int k = 1; k < nodes; ++k) {
    const double angle = k * std::numbers::pi / nodes, cotangent = 1 / std::tan(angle);
    const Complex s(r * angle * cotangent, r * angle);
    const double sigma = angle + (angle * cotangent - 1) * cotangent;
    sum += (std::exp(s * time) * transform(s) * Complex(1, sigma)).real();
  }
  return sum * r / nodes;
}

/// Measures all families of methods.
class Field {
 public:
  explicit Field(bool quick) : quick_(quick), loop_(craft(true), designed_gains), times_(end_times()) {
    const auto r = step_response(loop_, 1, places, {.pairs = 400});
    truth_ = sample(r);
  }

  scene::ProblemLines measure() {
    residues();
    inversion_sums();
    discretised();
    return std::move(all_);
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

  /// Starts a new line for the next attempts.
  void begin(const std::string& method, Group group) {
    all_.lines.push_back({method, group, {}, sides.at(group)});
  }

  void add(const std::string& setting, const Compute& compute) {
    double largest = 0;
    const auto ending_of = [&](const History& h) -> scene::Ending {
      std::vector<double> errors;
      for (std::size_t i = 0; i < times_.size(); ++i) {
        const double e = i < h.theta.size() ? error(h, truth_, i) : HUGE_VAL;
        errors.push_back(std::isfinite(e) ? e : 1);
      }
      largest = *std::max_element(errors.begin(), errors.end());
      return {Status(), std::clamp(median(errors), 1e-17, 1.)};
    };
    scene::Attempt attempt = scene::attempt(setting, compute, ending_of, quick_);
    attempt.work = {largest};
    all_.lines.back().attempts.push_back(std::move(attempt));
  }

  void residues() {
    const std::vector<int> all_pairs =
        quick_ ? std::vector{1, 2, 4, 8, 16} : std::vector{1, 2, 4, 8, 16, 32, 64};
    const auto setting = [](int pairs) { return fmt::format("{} pairs", pairs); };
    begin("residues, poles sought", residue_sums);
    for (const int pairs : all_pairs)
      add(setting(pairs), [&] { return sample(step_response(loop_, 1, places, {.pairs = pairs})); });
    begin("residues, poles known", residue_sums);
    for (const int pairs : all_pairs) {
      const auto known = step_response(loop_, 1, places, {.pairs = pairs});
      add(setting(pairs), [&] { return sample(known); });
    }
  }

  void inversion_sums() {
    const auto transform = [this](bool hub) {
      return [this, hub](Complex s) {
        const auto r = loop_.response(s, places.front());
        return (hub ? r.theta : r.deflection) / s;
      };
    };
    begin("Talbot", inversion);
    for (const int nodes : {8, 12, 16, 24, 32, 48}) {
      add(fmt::format("{} nodes", nodes), [&] {
        History h;
        for (const double t : times_) {
          h.theta.push_back(talbot_sum(transform(true), t, nodes));
          h.deflection.push_back(talbot_sum(transform(false), t, nodes));
        }
        return h;
      });
    }
  }

  [[nodiscard]] History integrated(const ivp::System& system, const ModalLoop& loop,
                                   const Eigen::VectorXd& shapes, double tolerance) const {
    History h;
    const auto watch = [&](const ivp::Step& step) {
      ivp::State x;
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
                                         ivp::Observer(watch), {.steps = 400'000});
    if (!solution.status.ok()) return {};
    return h;
  }

  void discretised() {
    for (const int modes : {5, 10, 20}) {
      begin(fmt::format("{} assumed modes by CVODE", modes), truncation);
      if ((quick_ && modes > 5) || !peers::cvode_available()) continue;
      const auto model = diagonalise(spacecraft::assumed_modes(loop_.parameters(), modes));
      const ModalLoop problem(model, designed_gains, 1);
      const ivp::System system(problem);
      const Eigen::VectorXd shapes = model.mode_shapes(places.front());
      for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
        if (modes > 10 && tolerance != 1e-5) continue;
        add(fmt::format("tolerance {:.0e}", tolerance),
            [&] { return integrated(system, problem, shapes, tolerance); });
      }
    }
  }

  bool quick_;
  spacecraft::ClosedLoop loop_;
  std::vector<double> times_;
  History truth_;
  scene::ProblemLines all_;
};

scene::ProblemLines measure_all(bool quick) { return Field(quick).measure(); }

void put(const scene::ProblemLines& all, scene::Show& show) {
  scene::show_work_precision(
      {.heading = "Digits of the motion: ten by residues, three by ten assumed modes",
       .digits = "digits of {/:Italic θ} and {/:Italic y}, median",
       .most_digits = 17,
       .error = "median error",
       .time = "time for 16 instants (s)",
       .work = {"largest error"},
       .groups = {{"residues", 2}, {"numerical inversion", 3}, {"truncated models", 1}}},
      {all}, show);
  const auto best = [&](const char* method) { return all.of(method).least_error(); };
  show.at_most("least error of residues", best("residues, poles known"), 1e-7,
               "theta and y fall like n^-6 and n^-5: 16 pairs leave 16^-4 of a small part");
  show.between("least error of Talbot's sums", best("Talbot"), 1e-3, 0.1,
               "all modes above the contour's frequencies, some M/t, are left out");
  if (peers::cvode_available())
    show.between("least error of five assumed modes by CVODE", best("5 assumed modes by CVODE"), 1e-6, 0.2,
                 "truncation: y of ten modes is off by 5e-4 ft of 0.082 ft "
                 "(tests/spacecraft/lyapunov_test.cpp)");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result times(
      "step-times",
      "designed gains, from rest to 1 rad; theta and y(2 ft) at 16 instants from 3 to 6 s; error against 400 "
      "residues, the deflection's over its peak; one thread, median of repeats; models are made beforehand",
      measure_all);
  return {{.name = "error-vs-time-step",
           .title = "Digits of a manoeuvre against time: residues, numerical inversion, assumed modes",
           .content = scene::Content(put, times)}};
}

}  // namespace nlmech::chapters::gss_control::error_vs_time_step
