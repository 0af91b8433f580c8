#include "nlmech/peers/ivp/odeint/odeint_rosenbrock.hpp"

#include <algorithm>
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_controller.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace nlmech::peers::detail {
namespace {

using Column = boost::numeric::ublas::vector<double>;
using Matrix = boost::numeric::ublas::matrix<double>;  // by rows

/// Coefficients with the correct sign of the fourth coefficient of df/dt, a minus in RODAS (E. Hairer, G.
/// Wanner, Solving Ordinary Differential Equations II, 1996, IV.10). The wrong sign in Boost 1.74 reduces the
/// order to 1 if f depends on t.
struct Coefficients : boost::numeric::odeint::default_rosenbrock_coefficients<double> {
  const double d4 = -0.3620000000000023e-01;
};
using Formula = boost::numeric::odeint::rosenbrock4<double, Coefficients>;
using Controlled = boost::numeric::odeint::rosenbrock4_controller<Formula>;

struct Rhs {
  RosenbrockEquations* equations;
  void operator()(const Column& x, Column& f, double t) const {
    equations->rhs(t, &x.data()[0], &f.data()[0]);
  }
};

struct Derivatives {
  RosenbrockEquations* equations;
  std::vector<double>* by_columns;
  void operator()(const Column& x, Matrix& j, double t, Column& dfdt) const {
    equations->derivatives(t, &x.data()[0], by_columns->data(), &dfdt.data()[0]);
    const std::size_t n = x.size();
    for (std::size_t column = 0; column < n; ++column) {
      for (std::size_t row = 0; row < n; ++row) j(row, column) = (*by_columns)[column * n + row];
    }
  }
};

}  // namespace

struct Rosenbrock::Inside {
  Inside(RosenbrockEquations& equations, std::size_t n, double absolute, double relative)
      : absolute_tolerance(absolute),
        relative_tolerance(relative),
        by_columns(n * n),
        system(Rhs{&equations}, Derivatives{&equations, &by_columns}),
        x0(n),
        x1(n),
        next(n),
        out(n) {}
  double absolute_tolerance, relative_tolerance;
  std::optional<Controlled> controlled;  // optional, because Odeint's type cannot be assigned
  std::vector<double> by_columns;
  std::pair<Rhs, Derivatives> system;
  Column x0, x1, next, out;
  double t0 = 0, t1 = 0;
  bool is_prepared = false;
};

Rosenbrock::Rosenbrock(RosenbrockEquations& equations, int size, double absolute_tolerance,
                       double relative_tolerance)
    : inside_(std::make_unique<Inside>(equations, static_cast<std::size_t>(size), absolute_tolerance,
                                       relative_tolerance)) {}

Rosenbrock::~Rosenbrock() = default;

void Rosenbrock::restart(const double* x) {
  inside_->controlled.emplace(inside_->absolute_tolerance, inside_->relative_tolerance);
  if (x) std::copy_n(x, inside_->x1.size(), inside_->x1.begin());
}

bool Rosenbrock::try_step(double t, double& length) {
  return inside_->controlled->try_step(std::ref(inside_->system), inside_->x1, t, inside_->next, length) ==
         boost::numeric::odeint::success;
}

const double* Rosenbrock::next() const { return &inside_->next.data()[0]; }

void Rosenbrock::advance(double t0, double t1) {
  inside_->t0 = t0;
  inside_->t1 = t1;
  inside_->x0.swap(inside_->x1);
  inside_->x1.swap(inside_->next);
  inside_->is_prepared = false;
}

void Rosenbrock::at(double t, double* x) {
  auto& formula = inside_->controlled->stepper();
  if (!inside_->is_prepared) formula.prepare_dense_output();
  inside_->is_prepared = true;
  formula.calc_state(t, inside_->out, inside_->x0, inside_->t0, inside_->x1, inside_->t1);
  std::copy(inside_->out.begin(), inside_->out.end(), x);
}

}  // namespace nlmech::peers::detail
