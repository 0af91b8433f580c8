#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <utility>

#include "nlmech/ivp/failures.hpp"
#include "nlmech/peers/ivp/native.hpp"

namespace nlmech::peers {
namespace {

/// Scope in which GSL errors are return codes: GSL's default error handler ends the program. The last scope
/// of all threads restores the handler of the program. bsimp ignores the code of a singular linear system and
/// continues with meaningless numbers, so the handler records this error.
class ErrorsAsCodes {
 public:
  ErrorsAsCodes() {
    const std::lock_guard lock(shared().mutex);
    if (shared().users++ == 0) shared().before = gsl_set_error_handler(&note);
  }
  ~ErrorsAsCodes() {
    const std::lock_guard lock(shared().mutex);
    if (--shared().users == 0) gsl_set_error_handler(shared().before);
  }
  ErrorsAsCodes(const ErrorsAsCodes&) = delete;
  ErrorsAsCodes& operator=(const ErrorsAsCodes&) = delete;

  /// Has a singular matrix occurred in this thread since the last call?
  [[nodiscard]] static bool met_singular_matrix() { return std::exchange(singular(), false); }

 private:
  struct Shared {
    std::mutex mutex;
    int users = 0;
    gsl_error_handler_t* before = nullptr;
  };
  static Shared& shared() {
    static Shared state;  // global, as the handler
    return state;
  }
  static bool& singular() {
    thread_local bool met = false;
    return met;
  }
  static void note(const char* reason, const char* /*file*/, int /*line*/, int /*code*/) noexcept {
    if (std::strcmp(reason, "matrix is singular") == 0) singular() = true;
  }
};

/// Return code of the callbacks for an f that is not finite: not GSL_EBADFUNC, so that GSL tries a shorter
/// step. GSL itself would accept a step to NaN, because comparisons with NaN are false.
constexpr int not_finite = GSL_EDOM;

const gsl_odeiv2_step_type* step_type(Gsl::Formula formula) {
  switch (formula) {
    case Gsl::Formula::rkf45: return gsl_odeiv2_step_rkf45;
    case Gsl::Formula::bsimp: return gsl_odeiv2_step_bsimp;
    case Gsl::Formula::msadams: return gsl_odeiv2_step_msadams;
    case Gsl::Formula::msbdf: return gsl_odeiv2_step_msbdf;
    case Gsl::Formula::rk8pd: break;
  }
  return gsl_odeiv2_step_rk8pd;
}

/// The formula of dense output: a one-step formula for multistep formulas, else the same.
const gsl_odeiv2_step_type* type_between(Gsl::Formula formula) {
  switch (formula) {
    case Gsl::Formula::msadams: return gsl_odeiv2_step_rk8pd;
    case Gsl::Formula::msbdf: return gsl_odeiv2_step_bsimp;
    default: return step_type(formula);
  }
}

struct Callbacks {
  explicit Callbacks(Equations& e) : equations(e), jacobian_by_columns(square(e.size())) {}
  static std::size_t square(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }

  static int rhs(double t, const double* x, double* f, void* data) noexcept {
    auto& self = *static_cast<Callbacks*>(data);
    return self.exceptions.keep(GSL_EBADFUNC, [&] {
      self.equations.rhs(t, x, f);
      return self.equations.check(f) ? GSL_SUCCESS : not_finite;
    });
  }
  static int jacobian(double t, const double* x, double* by_rows, double* dfdt, void* data) noexcept {
    auto& self = *static_cast<Callbacks*>(data);
    return self.exceptions.keep(GSL_EBADFUNC, [&] {
      const int n = self.equations.size();
      self.equations.jacobian(t, x, self.jacobian_by_columns.data());
      self.equations.time_derivative(t, x, dfdt);
      Eigen::Map<Eigen::MatrixXd>(by_rows, n, n) =
          Eigen::Map<const Eigen::MatrixXd>(self.jacobian_by_columns.data(), n, n).transpose();
      return all_finite(by_rows, n * n) && all_finite(dfdt, n) ? GSL_SUCCESS : not_finite;
    });
  }

  Equations& equations;
  std::vector<double> jacobian_by_columns;
  Rethrower exceptions;
};

class GslStepper final : public PeerStepper {
 public:
  GslStepper(Equations& equations, const Gsl& method, double largest_step)
      : name_(method.name()),
        tolerances_{method.relative_tolerance, method.absolute_tolerance},
        largest_step_(largest_step),
        callbacks_(equations),
        system_{&Callbacks::rhs, &Callbacks::jacobian, static_cast<std::size_t>(equations.size()),
                &callbacks_},
        driver_(gsl_odeiv2_driver_alloc_y_new(&system_, step_type(method.formula), 1e-6, tolerances_.absolute,
                                              tolerances_.relative)),
        between_(gsl_odeiv2_driver_alloc_y_new(&system_, type_between(method.formula), 1e-6,
                                               tolerances_.absolute, tolerances_.relative)),
        x0_(system_.dimension),
        x1_(system_.dimension),
        f_(system_.dimension) {
    if (!driver_ || !between_) throw std::bad_alloc();
  }

  Status begin(double t, const double* x, double end) override {
    gsl_odeiv2_evolve_reset(driver_->e);
    gsl_odeiv2_step_reset(driver_->s);
    std::copy_n(x, x1_.size(), x1_.begin());
    t1_ = t;
    end_ = end;
    rejected_ = 0;
    callbacks_.equations.rhs(t, x, f_.data());
    if (!callbacks_.equations.check(f_.data())) return non_finite_rhs(name_, t, end - t);
    h_ = initial_step(t, x, f_.data(), callbacks_.equations.size(), end, tolerances_);
    return {};
  }

  Attempt attempt(double* x, Statistics& statistics) override {
    t0_ = t1_;
    x0_ = x1_;
    double t = t1_;
    h_ =
        std::copysign(std::min(std::abs(h_), largest_step_), h_);  // GSL applies its bound only in its driver
    const int code = advance(*driver_, t, end_, h_, x1_.data());
    const auto rejected = static_cast<std::int64_t>(driver_->e->failed_steps);
    statistics.rejected += rejected - rejected_;
    rejected_ = rejected;
    if (ErrorsAsCodes::met_singular_matrix()) return halved();
    if (code == not_finite) return {Attempt::Result::failed, t0_, h_, non_finite_rhs(name_, t0_, h_)};
    // After a failure GSL may leave t and x at the rejected step; integrate_steps() has its own copies.
    if (code != GSL_SUCCESS) return {Attempt::Result::failed, t0_, h_, ivp::step_underflow(name_, t0_, h_)};
    t1_ = t;
    std::copy(x1_.begin(), x1_.end(), x);
    return {Attempt::Result::accepted, t, driver_->e->last_step, {}};
  }

  void at(double t, double* x) override {
    const Uncounted uncounted(callbacks_.equations);
    if (t == t0_ || t == t1_) {
      std::copy_n((t == t0_ ? x0_ : x1_).begin(), x0_.size(), x);
    } else if (!steps_to(t, x)) {
      miss(name_, t, t0_, t1_);
    }
  }

  void add_counters(Statistics& /*statistics*/) const override {}  // GSL counts no factorisations

 private:
  /// A step of about @p h from @p t, at most to @p end. @returns GSL's return code
  int advance(gsl_odeiv2_driver& driver, double& t, double end, double& h, double* x) {
    // GSL shortens a longer step to meet the end exactly, but a step of exactly this length misses it by
    // rounding.
    if (h == end - t) h *= 2;
    (void)ErrorsAsCodes::met_singular_matrix();  // resets errors of earlier calls
    const int code = gsl_odeiv2_evolve_apply(driver.e, driver.c, driver.s, &system_, &t, end, &h, x);
    callbacks_.exceptions.rethrow();
    return code;
  }

  /// State at @p t by steps, usually one, from the start of the latest step; false if GSL does not reach @p
  /// t. A shorter step may fail where the longer one succeeded, as bsimp near a singular matrix 1 - c h
  /// df/dx. It then returns the old state, and only a large error estimate shows the failure.
  bool steps_to(double t, double* x) {
    constexpr int most_tries = 1000;
    std::vector<double> from = x0_;
    double reached = t0_, h = t - t0_;
    gsl_odeiv2_evolve_reset(between_->e);
    gsl_odeiv2_step_reset(between_->s);
    for (int tries = 0; reached != t; ++tries) {
      if (tries == most_tries) return false;
      const double begin = reached;
      std::copy(from.begin(), from.end(), x);
      const int code = advance(*between_, reached, t, h, x);
      if (ErrorsAsCodes::met_singular_matrix()) {
        reached = begin;
        h = between_->e->last_step / 2;
        gsl_odeiv2_evolve_reset(between_->e);
        gsl_odeiv2_step_reset(between_->s);
      } else if (code != GSL_SUCCESS || !all_finite(x, callbacks_.equations.size())) {
        return false;
      } else {
        std::copy_n(x, from.size(), from.begin());
      }
    }
    return true;
  }

  /// Rejects a step with a singular matrix and halves the step size.
  Attempt halved() {
    const double tried = driver_->e->last_step;
    gsl_odeiv2_evolve_reset(driver_->e);  // discards the slope at the end of the rejected step
    gsl_odeiv2_step_reset(driver_->s);
    rejected_ = 0;
    x1_ = x0_;
    h_ = tried / 2;
    if (t1_ + h_ != t1_) return {Attempt::Result::rejected, t1_, tried, {}};
    return {Attempt::Result::failed, t1_, tried,
            ivp::step_not_solved(name_, Outcome::singular_matrix, t1_, tried, 1)};
  }

  struct Free {
    void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
  };

  ErrorsAsCodes errors_as_codes_;
  std::string_view name_;
  Tolerances tolerances_;
  double largest_step_;
  Callbacks callbacks_;
  gsl_odeiv2_system system_;
  std::unique_ptr<gsl_odeiv2_driver, Free> driver_, between_;
  std::vector<double> x0_, x1_, f_;
  double t0_ = 0, t1_ = 0, end_ = 0, h_ = 0;
  std::int64_t rejected_ = 0;
};

}  // namespace

bool gsl_available() noexcept { return true; }

Status integrate_by(Run& run, const Gsl& method) {
  require_tolerances(method.name(), {method.relative_tolerance, method.absolute_tolerance});
  GslStepper stepper(run.equations, method, run.limits.largest_step);
  return integrate_steps(method.name(), stepper, run);
}

bool gsl_natively(const Gsl& method, const NativeEquations& equations, double t0, double t1, double* x) {
  gsl_error_handler_t* before = gsl_set_error_handler_off();  // the handler would end the program
  gsl_odeiv2_system system = {equations.rhs, equations.jacobian, static_cast<std::size_t>(equations.size),
                              equations.data};
  gsl_odeiv2_driver* driver = gsl_odeiv2_driver_alloc_y_new(
      &system, step_type(method.formula), 1e-6, method.absolute_tolerance, method.relative_tolerance);
  double t = t0;
  const bool there = driver != nullptr && gsl_odeiv2_driver_apply(driver, &t, t1, x) == GSL_SUCCESS;
  if (driver != nullptr) gsl_odeiv2_driver_free(driver);
  gsl_set_error_handler(before);
  return there;
}

}  // namespace nlmech::peers
