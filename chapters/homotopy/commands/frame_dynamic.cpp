#include "chapters/homotopy/commands/frame_dynamic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nlmech/frames/named/frame_paths.hpp"
#include "nlmech/ivp/named/named_integrators.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/ivp/structural/alpha_family.hpp"
#include "nlmech/ivp/system.hpp"
#include "nlmech/scene/picture.hpp"
#include "nlmech/scene/table.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::homotopy {
namespace {

using frames::LoadHistory;

constexpr double most_imbalance = 0.01;
constexpr double most_difference = 0.01;  // from half the step size, relative to the largest displacement
constexpr int most_halvings = 6;  // of the default step size: 64 times the work; comparison: twice that
constexpr std::size_t most_rows = 1'000'000;

/// Methods that need no derivative of the forces beyond the tangent.
constexpr std::array methods = {
    "newmark", "hht",    "generalized-alpha", "backward-euler", "explicit", "rk4", "rk6", "ode45",
    "dop853",  "rkn1210"};

LoadHistory history_of(const DynamicOptions& typed) {
  const LoadHistory::Kind kind = typed.history == "ramp"    ? LoadHistory::Kind::ramp
                                 : typed.history == "pulse" ? LoadHistory::Kind::pulse
                                                            : LoadHistory::Kind::step;
  if (kind == LoadHistory::Kind::step && typed.duration)
    throw InputError("--duration: is for --history ramp or pulse; leave it out or give one of them");
  if (kind != LoadHistory::Kind::step && !typed.duration)
    throw InputError("--history " + typed.history + " needs a --duration");
  return {kind, typed.factor.value_or(1), typed.duration.value_or(0)};
}

std::string method_of(const DynamicOptions& typed) { return typed.method.empty() ? "newmark" : typed.method; }

/// Step size or tolerance of the method. Default step size of fixed-step methods: time/2000, for `explicit`
/// within its stability limit.
ivp::Settings settings_of(const DynamicOptions& typed, const frames::FrameMotion& motion, double time) {
  if (typed.step && typed.tolerance) throw InputError("--step and --tolerance: give only one of them");
  const ivp::MethodInfo& method = ivp::method_info(method_of(typed));
  if (!method.fixed_step()) {
    if (typed.step && method.steps == ivp::Steps::adaptive)
      throw InputError("--step: " + typed.method + " adapts its steps to --tolerance");
    return {.step = typed.step, .tolerance = typed.tolerance};
  }
  if (typed.tolerance)
    throw input_error(
        "--tolerance {}: {} takes equal steps; give --step, or a method with adaptive steps, such as dop853",
        *typed.tolerance, method.name);
  if (typed.step) return {.step = typed.step};
  double step = time / 2000;
  // The stability limit is step * frequency = 2; the factor 1/2 allows for members that stiffen in tension.
  if (typed.method == "explicit") step = std::min(step, 1 / motion.highest_frequency());
  return {.step = step};
}

ivp::NamedIntegrator integrator_of(const DynamicOptions& typed, const ivp::Settings& settings) {
  if (typed.alpha) return ivp::named::with_options(ivp::Hht{.step = *settings.step, .alpha = *typed.alpha});
  if (typed.rho)
    return ivp::named::with_options(ivp::GeneralizedAlpha{.step = *settings.step, .rho_inf = *typed.rho});
  return ivp::named_integrator(method_of(typed), settings);
}

Moment moment_of(const frames::FrameMotion& motion, double t, const Eigen::VectorXd& x,
                 const frames::FrameEnergies& energies) {
  return {t,
          motion.history().at(t),
          x.head(x.size() / 2),
          energies.kinetic,
          energies.strain,
          energies.work,
          energies.dissipated};
}

/// Unknowns for the comparison of two motions: nodal translations; all unknowns if there are none.
std::vector<Eigen::Index> compared_of(const frames::Frame& frame) {
  std::vector<Eigen::Index> some;
  for (int node = 0; node < static_cast<int>(frame.nodes().size()); ++node) {
    for (const frames::Motion motion : {frames::Motion::x, frames::Motion::y}) {
      if (const Eigen::Index at = frame.unknown(node, motion); at >= 0) some.push_back(at);
    }
  }
  for (Eigen::Index i = 0; some.empty() && i < frame.size(); ++i) some.push_back(i);
  return some;
}

/// Runs of one motion with several step sizes.
class Runs {
 public:
  Runs(const frames::FrameMotion& motion, const DynamicOptions& typed, double seconds)
      : motion_(motion),
        system_(motion),
        typed_(typed),
        seconds_(seconds),
        compared_(compared_of(motion.frame().frame)) {}

  /// Runs the motion once. @param coarse run to compare with; sets difference_, the relative difference of
  /// displacements
  /// @param has_rows whether to record rows
  FrameRun run(const ivp::Settings& settings, const FrameRun* coarse = nullptr, bool has_rows = true) {
    const auto integrate = integrator_of(typed_, settings);
    frames::FrameEnergies energies(motion_);
    FrameRun run;
    run.moments.push_back(moment_of(motion_, 0, motion_.rest(), energies));
    double most = 0, apart = 0;
    std::size_t compared = 0;
    const auto see = [&](const ivp::Step& step) {
      if (has_rows && typed_.every) add_rows(step, energies, run.moments);
      energies.take(step);
      const bool is_last = step.t1 == *typed_.time;
      for (; coarse != nullptr && compared < coarse->moments.size(); ++compared) {
        const Moment& other = coarse->moments[compared];
        if (other.time > step.t1 && !is_last) break;
        const Eigen::VectorXd here = step.at(std::min(other.time, step.t1));
        most = std::max(most, here(compared_).cwiseAbs().maxCoeff());
        apart = std::max(apart, (here(compared_) - other.x(compared_)).cwiseAbs().maxCoeff());
      }
      if (!has_rows || typed_.every) return true;
      if (run.moments.size() > most_rows)
        throw InputError(
            fmt::format("without --every each step has a row: more than {} rows at t = {:.6g}; give --every",
                        most_rows, step.t1));
      run.moments.push_back(moment_of(motion_, step.t1, step.x1, energies));
      return true;
    };
    run.status = integrate(system_, motion_.rest(), 0, *typed_.time, see,
                           {.seconds = std::max(seconds_ - time_.seconds(), 1e-3)})
                     .status;
    difference_ = most > 0 ? apart / most : 0;
    run.imbalance = energies.greatest > 0 ? energies.imbalance / energies.greatest : 0;
    if (run.status.ok() && !(run.imbalance <= most_imbalance))
      run.status =
          Status::failure(Outcome::not_converged,
                          fmt::format("{}: the energies do not balance: the error is {:.2g} of the largest "
                                      "energy, more than {}; take a shorter "
                                      "step, a smaller tolerance, or newmark, which does not dissipate",
                                      method_of(typed_), run.imbalance, most_imbalance));
    return run;
  }

  /// The initial part of a step.
  struct PartOfStep {
    const ivp::Step& step;
    double t0, t1;
    const Eigen::VectorXd &x0, &x1;
    [[nodiscard]] Eigen::VectorXd at(double t) const { return step.at(t); }
  };

  /// Adds rows at the requested times within a step, by dense output.
  /// @param before energies at the start of the step
  void add_rows(const ivp::Step& step, const frames::FrameEnergies& before, std::vector<Moment>& rows) const {
    // The end time always has a row; a requested time that equals it up to rounding has no second one.
    const double every = *typed_.every, end = *typed_.time, last = std::ceil(end / every - 1e-9);
    for (;;) {
      const auto number = static_cast<double>(rows.size());
      const double t = number < last ? number * every : end;
      if (number > last || t > step.t1) return;
      const Eigen::VectorXd x = step.at(t);
      frames::FrameEnergies energies = before;
      energies.take(PartOfStep{step, step.t0, t, step.x0, x});
      rows.push_back(moment_of(motion_, t, x, energies));
    }
  }

  /// Runs the motion and compares it with half the step size. The default step size is halved until both
  /// agree.
  FrameRun run_with_check(ivp::Settings settings) {
    FrameRun coarse = run(settings);
    for (int halving = 0; settings.step; ++halving) {
      const bool has_room =
          typed_.every || 2 * *typed_.time / *settings.step < static_cast<double>(most_rows);
      const bool is_free = !typed_.step && halving < most_halvings && has_room;
      if (!coarse.status.ok() && !is_free) break;
      const double step = *settings.step;
      settings.step = step / 2;
      FrameRun fine = run(settings, &coarse, is_free);
      if (coarse.status.ok() && fine.status.ok() && difference_ <= most_difference) break;
      if (is_free) {
        coarse = std::move(fine);
        continue;
      }
      if (coarse.status.ok())
        coarse.status =
            fine.status.ok()
                ? Status::failure(
                      Outcome::not_converged,
                      fmt::format("{}: with half the step of {:.3g} displacements differ by {:.2g} of the "
                                  "largest, more than {}; take a shorter --step, or --method dop853 with a "
                                  "--tolerance",
                                  method_of(typed_), step, difference_, most_difference))
                : fine.status;
      break;
    }
    return coarse;
  }

 private:
  const frames::FrameMotion& motion_;
  ivp::System system_;
  const DynamicOptions& typed_;
  double seconds_;
  Stopwatch time_;
  std::vector<Eigen::Index> compared_;
  double difference_ = 0;
};

}  // namespace

void declare_dynamic(scene::Options& options, DynamicOptions& typed) {
  options.add("--dynamic", typed.is_wanted, "compute the motion in time instead; members need a mass");
  options
      .add("--history", typed.history,
           "with --dynamic: history of the load factor from time 0 (default step)")
      .one_of({"step", "ramp", "pulse"});
  options.add("--factor", typed.factor, "with --dynamic: the largest load factor (default 1)");
  options
      .add("--duration", typed.duration,
           "with --dynamic: time in which a ramp rises, or after which a pulse ends")
      .positive();
  options.add("--time", typed.time, "with --dynamic: end of the motion").positive();
  options.add("--method", typed.method, "with --dynamic: the integrator (default newmark)")
      .one_of({methods.begin(), methods.end()});
  options
      .add("--step", typed.step,
           "with --dynamic: time step. Default: 1/2000 of --time, halved until halving it changes no "
           "displacement by more than 1/100 of the largest")
      .positive();
  options.add("--tolerance", typed.tolerance, "with --dynamic: tolerance of methods with adaptive steps")
      .positive();
  options
      .add("--every", typed.every,
           "with --dynamic: rows at multiples of this time and at the end, by dense output (default: a row "
           "for each step)")
      .positive();
  options
      .add("--alpha", typed.alpha,
           "with --method hht: its parameter, less dissipation towards 0 (default -0.1)")
      .range(-1. / 3, 0);
  options
      .add("--rho", typed.rho,
           "with --method generalized-alpha: spectral radius at infinite frequency (default 0.8)")
      .range(0, 1);
}

void require_none(const DynamicOptions& typed) {
  const std::array given = {
      std::pair{"--history", !typed.history.empty()},        std::pair{"--factor", typed.factor.has_value()},
      std::pair{"--duration", typed.duration.has_value()},   std::pair{"--time", typed.time.has_value()},
      std::pair{"--method", !typed.method.empty()},          std::pair{"--step", typed.step.has_value()},
      std::pair{"--tolerance", typed.tolerance.has_value()}, std::pair{"--every", typed.every.has_value()},
      std::pair{"--alpha", typed.alpha.has_value()},         std::pair{"--rho", typed.rho.has_value()}};
  for (const auto& [option, is_typed] : given) {
    if (is_typed)
      throw InputError(fmt::format("{}: is for a motion in time; add --dynamic or leave it out", option));
  }
}

FrameRun run_frame(const FrameFile& file, const frames::NamedFrame& frame, const DynamicOptions& typed,
                   double seconds) {
  if (!typed.time) throw InputError("--dynamic: needs --time T, the end of the motion");
  if (typed.alpha && typed.method != "hht") throw InputError("--alpha: is for --method hht");
  if (typed.rho && typed.method != "generalized-alpha")
    throw InputError("--rho: is for --method generalized-alpha");
  const LoadHistory history = history_of(typed);
  if (typed.every && *typed.time / *typed.every > static_cast<double>(most_rows))
    throw InputError(fmt::format("--every {}: more than {} rows", *typed.every, most_rows));
  try {
    frames::Start start = start_of(frame, {.seconds = seconds});
    if (!start.status.ok()) throw Failure(start.status);
    const frames::FrameMotion motion(frame, history, std::move(start.x));
    const ivp::Settings settings = settings_of(typed, motion, *typed.time);
    if (!typed.every && settings.step && *typed.time / *settings.step > static_cast<double>(most_rows))
      throw InputError(
          fmt::format("without --every each of {:.3g} steps has a row, more than {}; give --every",
                      *typed.time / *settings.step, most_rows));
    return Runs(motion, typed, seconds).run_with_check(settings);
  } catch (const frames::ModelError& error) {
    complain_of(file, error);
  }
}

std::string csv_of(const frames::NamedFrame& frame, const FrameRun& run) {
  std::string text("time,load_factor");
  for (const frames::NamedMotion& m : frame.motions) text.append(",").append(scene::csv_field(m.name));
  text += ",kinetic_energy,strain_energy,work,dissipated\n";
  for (const Moment& m : run.moments) {
    text += fmt::format("{:.12g},{:.12g}", m.time, m.load);
    for (const frames::NamedMotion& motion : frame.motions)
      text += fmt::format(",{:.12g}", m.x[motion.unknown]);
    text += fmt::format(",{:.12g},{:.12g},{:.12g},{:.12g}\n", m.kinetic, m.strain, m.work, m.dissipated);
  }
  return text;
}

scene::Figure motion_picture(const frames::NamedFrame& frame, const FrameRun& run) {
  const frames::NamedMotion* most = &frame.motions.front();
  double farthest = -1;
  for (const frames::NamedMotion& m : frame.motions) {
    if (m.motion == frames::Motion::rotation) continue;
    for (const Moment& at : run.moments) {
      if (std::abs(at.x[m.unknown]) > farthest) {
        farthest = std::abs(at.x[m.unknown]);
        most = &m;
      }
    }
  }
  scene::Show show(false);
  scene::Plot& plot = show.plots("The largest displacement, and the energies");
  plot.size(960, 480).columns({"panel", "curve", "x", "y"});
  plot.panel("time", scene::without_markup(most->name))
      .key("off")
      .curve(
          "", run.moments, &Moment::time, [&](const Moment& m) { return m.x[most->unknown]; },
          scene::lines(1));
  plot.panel("time", "energy")
      .key("bottom right")
      .curve("work of the loads", run.moments, &Moment::time, &Moment::work, scene::lines(1))
      .curve("strain", run.moments, &Moment::time, &Moment::strain, scene::lines(2))
      .curve("kinetic", run.moments, &Moment::time, &Moment::kinetic, scene::lines(4))
      .curve("dissipated", run.moments, &Moment::time, &Moment::dissipated, scene::lines(3));
  return *show.take().figure;
}

}  // namespace nlmech::chapters::homotopy
