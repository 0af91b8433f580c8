/// @file
/// Odeint's rosenbrock4 behind an interface of plain arrays. Its source is compiled as C++17, since the
/// matrices that it stands on (Boost 1.74, uBLAS) call std::allocator::construct, which C++20 has no more; so
/// this header includes nothing of the suite.
#pragma once

#include <memory>

namespace nlmech::peers::detail {

/// What rosenbrock4 evaluates.
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
  /// @param equations outlive this object
  Rosenbrock(RosenbrockEquations& equations, int size, double absolute_tolerance, double relative_tolerance);
  ~Rosenbrock();
  Rosenbrock(const Rosenbrock&) = delete;
  Rosenbrock& operator=(const Rosenbrock&) = delete;

  /// Forgets earlier steps. @param x state to go on from; null: the present one
  void restart(const double* x);
  /// Tries a step of @p length from @p t. True if Odeint accepts it; @p length becomes its next wish.
  [[nodiscard]] bool try_step(double t, double& length);
  /// State that the latest try led to.
  [[nodiscard]] const double* next() const;
  /// Goes over to next(), which was reached from @p t0 at @p t1.
  void advance(double t0, double t1);
  /// State at @p t within the latest step that advance() took, as long as no other was tried.
  void at(double t, double* x);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace nlmech::peers::detail
