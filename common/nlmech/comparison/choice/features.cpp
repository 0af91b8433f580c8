#include "nlmech/comparison/choice/features.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "nlmech/comparison/any_method.hpp"

namespace nlmech::comparison {
namespace {

// Steps as the solution asks for them, and no more; the second where roots of coarse steps mislead.
constexpr ivp::Settings coarse[] = {{.tolerance = 1e-3, .absolute_tolerance = 1e-6},
                                    {.tolerance = 1e-6, .absolute_tolerance = 1e-12}};
constexpr int most_eigenvalues = 32;  // components; their eigenvalues take the cube

/// The eigenvalue of the greatest modulus: the modulus, and the share of its decay.
struct Fastest {
  double rate = 0, decay = 0;
};

/// By powers of the matrix, whose growth is the modulus also of a pair; the decay by the diagonal.
Fastest fastest_of_many(const Eigen::MatrixXd& j, double direction) {
  constexpr int powers = 30, counted = 15;
  Eigen::VectorXd v = Eigen::VectorXd::LinSpaced(j.rows(), 1, 2);
  double growth = 0;
  for (int k = 0; k < powers; ++k) {
    v.normalize();
    v = (j * v).eval();
    const double norm = v.norm();
    if (!(norm > 0)) return {};
    if (k >= powers - counted) growth += std::log(norm);
  }
  const double rate = std::exp(growth / counted);
  return {rate, std::clamp((-direction * j.diagonal()).maxCoeff() / rate, 0.0, 1.0)};
}

Fastest fastest_of(const Eigen::MatrixXd& j, double direction) {
  if (!j.allFinite()) return {};
  if (j.rows() > most_eigenvalues) return fastest_of_many(j, direction);
  Fastest found;
  for (const std::complex<double>& value : j.eigenvalues()) {
    if (std::abs(value) > found.rate)
      found = {std::abs(value), std::max(0.0, -direction * value.real()) / std::abs(value)};
  }
  return found;
}

/// Does an acceleration depend on velocities?
bool is_damped(const ivp::System& system, double t, const ivp::State& x) {
  const Eigen::Index half = system.size() / 2;
  ivp::Jacobian j(system.size(), system.size());
  for (const double shift : {0.0, 0.1}) {  // at rest or in a point of symmetry a product may vanish
    system.jacobian(t, (x.array() + shift).matrix(), j);
    if (!j.bottomRightCorner(half, half).isZero(0)) return true;
  }
  return false;
}

/// Ratio of long steps to short ones, weighted by the way that they make.
double variation_of(std::vector<double> lengths, double way) {
  std::ranges::sort(lengths);
  const auto within = [&](double share) {
    double sum = 0;
    for (const double length : lengths) {
      sum += length;
      if (sum >= share * way) return length;
    }
    return lengths.back();
  };
  return std::log10(within(0.9) / within(0.1));
}

/// The equations as recorded, those of one mode where they switch; nothing: they are refused.
std::optional<Tape> tape_of(const ivp::System& system, double t) {
  const auto modes = static_cast<std::size_t>(system.switches());
  try {
    return (modes > 0 ? system.in_mode(ivp::Mode(modes, 1)) : system).record(t);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// depends_on_time() by the recorded equations.
bool time_in(const std::optional<Tape>& tape, const ivp::System& system, double t, const ivp::State& x) {
  if (tape) return tape->depends_on_time();
  ivp::State dfdt(x.size());
  return !system.time_derivative(t, x, dfdt) || !dfdt.isZero(0);
}

/// What the steps of a run show.
class Steps {
 public:
  Steps(const ivp::System& system, double direction)
      : system_(system), direction_(direction), j_(system.size(), system.size()) {}

  /// An observer; true.
  bool see(const ivp::Step& step) {
    const double length = std::abs(step.t1 - step.t0);
    lengths_.push_back(length);
    way_ += length;
    // Of many steps a few, closely at first.
    if (lengths_.size() % (1 + lengths_.size() / few) != 0) return true;
    system_.jacobian(step.t1, step.x1, j_);
    const Fastest fastest = fastest_of(j_, direction_);
    turned_ += fastest.rate * length;
    decayed_ += fastest.decay * fastest.rate * length;
    ++looks_;
    return true;
  }
  /// Fills in what was seen.
  void put(Features& f) const {
    if (looks_ == 0) return;
    f.stiffness = std::log10(std::max(turned_ / looks_, 1e-3));
    f.decay = turned_ > 0 ? decayed_ / turned_ : 0;
    f.variation = variation_of(lengths_, way_);
  }

 private:
  static constexpr std::size_t few = 24;
  const ivp::System& system_;
  double direction_;
  ivp::Jacobian j_;
  std::vector<double> lengths_;
  double turned_ = 0, decayed_ = 0, way_ = 0;
  int looks_ = 0;
};

/// Some steps, and what they show.
ivp::Solution stepped(const ivp::System& system, const ivp::State& x0, double t0, double t1,
                      const ivp::Settings& settings, double largest_step, Features& features) {
  const std::int64_t most_steps = std::clamp<std::int64_t>(2000 / system.size(), 20, 400);
  Steps steps(system, t1 > t0 ? 1 : -1);
  const ivp::Observer see = [&steps](const ivp::Step& step) { return steps.see(step); };
  const auto run = any_integrator(any_method("adaptive-collocation"), settings);
  ivp::Solution end =
      run(system, x0, t0, t1, see, {.steps = most_steps, .seconds = 0.5, .largest_step = largest_step});
  steps.put(features);
  return end;
}

}  // namespace

std::string_view to_string(Form form) {
  switch (form) {
    case Form::first_order: return "first-order";
    case Form::accelerations: return "accelerations";
    case Form::conservative: break;
  }
  return "conservative";
}

Form form_of(const ivp::System& system, double t, const ivp::State& x) {
  if (!system.second_order()) return Form::first_order;
  return is_damped(system, t, x) ? Form::accelerations : Form::conservative;
}

bool depends_on_time(const ivp::System& system, double t, const ivp::State& x) {
  return time_in(tape_of(system, t), system, t, x);
}

Look look_at_problem(const ivp::System& system, const ivp::State& x0, double t0, double t1,
                     double largest_step) {
  Look look;
  look.features.components = system.size();
  look.features.form = form_of(system, t0, x0);
  look.features.switches = system.switches() > 0;
  const std::optional<Tape> tape = tape_of(system, t0);
  look.features.operations = tape ? std::max(1, tape->instructions()) : 0;
  look.features.depends_on_time = time_in(tape, system, t0, x0);
  for (const ivp::Settings& settings : coarse) {
    const ivp::Solution end = stepped(system, x0, t0, t1, settings, largest_step, look.features);
    look.seen = t1 == t0 ? 1 : std::abs((end.t - t0) / (t1 - t0));
    const Outcome outcome = end.status.outcome();
    look.status = outcome == Outcome::step_limit || outcome == Outcome::time_limit ? Status{} : end.status;
    if (look.status.ok()) break;
  }
  return look;
}

}  // namespace nlmech::comparison
