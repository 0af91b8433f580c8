/// @file
/// Odeint's rosenbrock4 with an interface of plain arrays. Its source is compiled as C++17, because its
/// matrices (Boost 1.74, uBLAS) call std::allocator::construct, which C++20 has removed; so this header
/// includes no other nlmech header.
#pragma once

#include <memory>

namespace nlmech::peers::detail {

/// Equations and derivatives for rosenbrock4.
class RosenbrockEquations {
 public:
  RosenbrockEquations() = default;
  RosenbrockEquations(const RosenbrockEquations&) = delete;
  RosenbrockEquations& operator=(const RosenbrockEquations&) = delete;
  virtual ~RosenbrockEquations() = default;
  /// f(t, x) into @p f.
  virtual void rhs(double t, const double* x, double* f) = 0;
  /// df/dx into @p j, by columns, and df/dt into @p dfdt.
  virtual void derivatives(double t, const double* x, double* j, double* dfdt) = 0;
};

/// rosenbrock4_controller with its states.
class Rosenbrock {
 public:
  /// @param equations must outlive this object
  Rosenbrock(RosenbrockEquations& equations, int size, double absolute_tolerance, double relative_tolerance);
  ~Rosenbrock();
  Rosenbrock(const Rosenbrock&) = delete;
  Rosenbrock& operator=(const Rosenbrock&) = delete;

  /// Discards information from earlier steps. @param x new state; null: the current one
  void restart(const double* x);
  /// Tries a step of size @p length from @p t. True if Odeint accepts it; @p length becomes its next step
  /// size.
  [[nodiscard]] bool try_step(double t, double& length);
  /// State at the end of the latest trial step.
  [[nodiscard]] const double* next() const;
  /// Accepts next(), reached from @p t0 at @p t1, as the current state.
  void advance(double t0, double t1);
  /// State at @p t within the latest step of advance(); valid until the next try_step().
  void at(double t, double* x);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace nlmech::peers::detail
