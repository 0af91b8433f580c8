/// Derivatives of solutions by initial values and parameters, against closed forms and invariants.
#include "nlmech/ivp/sensitivities.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "nlmech/ivp/domain.hpp"
#include "nlmech/ivp/events.hpp"
#include "nlmech/ivp/named/named_methods.hpp"
#include "nlmech/program/recorded.hpp"
#include "tests/random.hpp"
#include "tests/thrown.hpp"

namespace nlmech::tests::sensitivities_test {
namespace {

using ivp::State;
using program::Equations;

/// Equations with sensitivities and their initial state.
struct Extended {
  Equations equations;
  State x0;

  Extended(const std::string& text, const std::vector<std::string>& of, double scale = 1)
      : equations(Equations(program::SourceText("test", text)).with_sensitivities("test", of, scale)) {
    const std::vector<double> x = Equations(equations).initial_state("test", "");
    x0 = Eigen::Map<const Eigen::VectorXd>(x.data(), std::ssize(x));
  }
  [[nodiscard]] ivp::System system() const { return ivp::System(program::Problem(equations)); }
  [[nodiscard]] ivp::Solution run(double t1, const std::string& method = "series",
                                  double tolerance = 1e-14) const {
    return ivp::named_integrator(method, {.tolerance = tolerance})(system(), x0, 0, t1, {}, {});
  }
  /// The columns at a state, one component a row.
  [[nodiscard]] Eigen::MatrixXd columns(const State& x) const {
    const program::VariationalLayout& layout = equations.layout();
    Eigen::MatrixXd all(layout.size, layout.columns);
    for (int k = 1; k <= layout.columns; ++k) {
      for (int i = 0; i < layout.size; ++i) all(i, k - 1) = x[layout.place(i, k)];
    }
    return all;
  }
  [[nodiscard]] Eigen::MatrixXd columns_at(double t1, const std::string& method = "series",
                                           double tolerance = 1e-14) const {
    const ivp::Solution end = run(t1, method, tolerance);
    EXPECT_TRUE(end.status.ok()) << method << ": " << end.status.text();
    return columns(end.x);
  }
};

double greatest(const Eigen::MatrixXd& difference) { return difference.cwiseAbs().maxCoeff(); }

// x = K x0 E/(K + x0 (E - 1)) with E = exp(r t); every adaptive method, at 1e-10. Bound: a thousand
// tolerances, for the errors of some hundred steps at the sensitivities' sizes up to 2.
TEST(Sensitivities, OfTheLogisticEquationByEveryAdaptiveMethod) {
  const Extended logistic("x' = r x (1 - x/K); r = 1.5; K = 2; x(0) = 0.25", {"x", "r", "K"});
  const double r = 1.5, k = 2, x0 = 0.25, t = 1.75, e = std::exp(r * t), below = k + x0 * (e - 1),
               x = k * x0 * e / below;
  const Eigen::RowVector3d exact(k * k * e / (below * below), t * x * (1 - x / k),
                                 x0 * x0 * e * (e - 1) / (below * below));
  int methods = 0;
  for (const ivp::MethodInfo& method : ivp::named_methods()) {
    if (method.fixed_step() || method.second_order_only) continue;
    ++methods;
    EXPECT_LE(greatest(logistic.columns_at(t, std::string(method.name), 1e-10) - exact), 1e-7) << method.name;
  }
  EXPECT_GE(methods, 4);
}

// A second application gives d^2 x/dx0^2 = -2 K^2 E (E - 1)/(K + x0 (E - 1))^3.
TEST(Sensitivities, OfSecondOrderByASecondApplication) {
  const Equations logistic(program::SourceText("test", "x' = 1.5 x (1 - x/2)"));
  const auto once = program::variational_equations(logistic.graph(), logistic.slopes(), {1, 1});
  const auto twice = program::variational_equations(once.graph, once.slopes, {2, 1});
  const ivp::System system(program::Problem(twice.graph, twice.slopes, {4}));
  // x, dx/dx0, and their derivatives by x0
  const auto end =
      ivp::named_integrator("series", {.tolerance = 1e-14})(system, {0.25, 1, 1, 0}, 0, 1.75, {}, {});
  const double e = std::exp(1.5 * 1.75), below = 2 + 0.25 * (e - 1);
  ASSERT_TRUE(end.status.ok()) << end.status.text();
  EXPECT_NEAR(end.x[3], -8 * e * (e - 1) / (below * below * below), 1e-13);
  EXPECT_EQ(end.x[1], end.x[2]);
}

// The equations of a program in C++ are recorded.
struct Pendulum {
  static constexpr int dimension = 2;
  template <class T>
  void operator()(const T& /*t*/, const Vector<T, 2>& x, Vector<T, 2>& f) const {
    using std::sin;
    f[0] = x[1];
    f[1] = -sin(x[0]);
  }
};

// Liouville: the determinant is 1, as the trace of f_x is 0.
TEST(Sensitivities, OfARecordedProblem) {
  const program::Recording pendulum = program::record(Pendulum(), 0, 2, false);
  const program::VariationalLayout layout{2, 2, true};
  const auto all = program::variational_equations(pendulum.graph, pendulum.slopes, layout);
  const ivp::System system(program::Problem(all.graph, all.slopes, layout));
  State x0(6);
  x0.setZero();
  x0[layout.place(0)] = 1;
  for (const int i : {0, 1}) x0[layout.place(i, i + 1)] = 1;
  const auto end = ivp::named_integrator("rkn1210", {.tolerance = 1e-13})(system, x0, 0, 5, {}, {});
  ASSERT_TRUE(end.status.ok()) << end.status.text();
  const auto s = [&](int i, int k) { return end.x[layout.place(i, k)]; };
  EXPECT_NEAR(s(0, 1) * s(1, 2) - s(1, 1) * s(0, 2), 1, 1e-11);
}

// oracle: integrators_sensitivities *
const double kepler[4][5] = {{-0.81849193004346409048, 2.5641646080690709016, 1.8409540559455798852,
                              1.0240735949569376595, 0.29005981362035682388},
                             {-2.3575610361852870971, 6.7627189204120369641, 2.4476901411730313596,
                              1.0939865123919608809, 2.6238226371147939221},
                             {0.47365539829232358185, -2.2588244528537144020, 0.36295385950851839382,
                              0.026012265741085805336, -0.69237136909589978478},
                             {-3.6250325445487518893, 8.9178504226221155706, 2.4751981086069022684,
                              1.2385707540788468594, 3.6256153866980371591}};

// Bound: a hundred rounding errors at the size of the largest sensitivity, 9.
TEST(Sensitivities, OfKeplersMotion) {
  const Extended orbit(
      "x'' = -mu x/r^3; y'' = -mu y/r^3; r = sqrt(x^2 + y^2); mu = 1; x(0) = 0.5; y(0) = 0; x'(0) = 0; "
      "y'(0) = sqrt(3)",
      {"mu", "x", "y", "x'", "y'"});
  const Eigen::MatrixXd exact = Eigen::Map<const Eigen::Matrix<double, 4, 5, Eigen::RowMajor>>(kepler[0]);
  for (const char* method : {"series", "rkn1210", "dop853"})
    EXPECT_LE(greatest(orbit.columns_at(1.25, method) - exact), 100 * 9 * 2.3e-16) << method;
}

// A system of second order without velocities: S^T J S = J, S(t2, t0) = S(t2, t1) S(t1, t0).
TEST(Sensitivities, OfHenonAndHeilesAreSymplecticAndMultiply) {
  const std::string text = "x'' = -x - 2 x y; y'' = -y - x^2 + y^2; x'(0) = 0.3; y(0) = 0.1; y'(0) = 0; ";
  const Extended from_start(text + "x(0) = 0.1", {"x", "y", "x'", "y'"});
  const ivp::Solution middle = from_start.run(4, "rkn1210", 1e-13),
                      end = from_start.run(10, "rkn1210", 1e-13);
  ASSERT_TRUE(middle.status.ok() && end.status.ok());
  Eigen::Matrix4d j = Eigen::Matrix4d::Zero();
  j.topRightCorner(2, 2).setIdentity();
  j.bottomLeftCorner(2, 2) = -Eigen::Matrix2d::Identity();
  const Eigen::MatrixXd s = from_start.columns(end.x);
  EXPECT_LE(greatest(s.transpose() * j * s - j), 1e-10);

  Extended from_middle = from_start;
  const program::VariationalLayout& layout = from_start.equations.layout();
  for (int i = 0; i < 4; ++i) from_middle.x0[layout.place(i)] = middle.x[layout.place(i)];
  const Eigen::MatrixXd rest = from_middle.columns_at(6, "rkn1210", 1e-13);
  EXPECT_LE(greatest(rest * from_start.columns(middle.x) - s), 1e-10 * greatest(s));
}

// Liouville's formula: the trace of f_x is -(sigma + 1 + b). Bound: rounding errors at the product of the
// largest elements, 1e3.
TEST(Sensitivities, OfLorenzsEquationsHaveLiouvillesDeterminant) {
  const Extended lorenz(
      "u' = 10 (v - u); v' = 28 u - v - u w; w' = u v - 8/3 w; u(0) = 1; v(0) = 1; w(0) = 20",
      {"u", "v", "w"});
  const double exact = std::exp(-(10 + 1 + 8. / 3) * 0.5);
  EXPECT_NEAR(lorenz.columns_at(0.5).determinant(), exact, 1e-12);
}

// exp(A t) of x'' + 2 d w x' + w^2 x = 0, and its derivative by w in the upper right block of
// exp([A, A_w; 0, A] t) (C. F. Van Loan 1978), by their power series.
TEST(Sensitivities, OfALinearEquationAreThoseOfTheMatrixExponential) {
  const double d = 0.2, w = 1.5, t = 2;
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a.topLeftCorner(2, 2) << 0, 1, -w * w, -2 * d * w;
  a.bottomRightCorner(2, 2) = a.topLeftCorner(2, 2);
  a.topRightCorner(2, 2) << 0, 0, -2 * w, -2 * d;
  Eigen::Matrix4d sum = Eigen::Matrix4d::Identity(), term = sum;
  for (int k = 1; k < 60; ++k) sum += term = (term * a * t / k).eval();
  const Extended damped("x'' + 2 d w x' + w^2 x = 0; d = 0.2; w = 1.5; x(0) = 1; x'(0) = 0.5",
                        {"x", "x'", "w"});
  Eigen::MatrixXd exact(2, 3);
  exact << sum.topLeftCorner(2, 2), sum.topRightCorner(2, 2) * Eigen::Vector2d(1, 0.5);
  EXPECT_LE(greatest(damped.columns_at(t) - exact), 1e-13);
}

// Runge and Kutta's steps of the variational equations are the derivative of the steps of x, which central
// differences with a change of 1e-6 in long double have to 1e-12 of the sizes of derivatives up to 100.
RC_GTEST_PROP(Sensitivities, AreTheDifferencesOfRandomEquations, ()) {
  const auto draw = [] { return *between(-1, 1); };
  const std::string text = fmt::format(
      "x' = p y + a x y - x^3 + exp(q x)/(2 + sin(a y)); y' = r x - y abs(y) + tanh(a x + s t) + atan2(y, 3 "
      "+ "
      "a) + (1.5 + cos(x))^a; x(0) = u + a^2; y(0) = v; a = {:.17g}; p = {:.17g}; q = {:.17g}; r = {:.17g}; "
      "s = {:.17g}; u = {:.17g}; v = {:.17g}",
      draw(), draw(), draw(), draw(), draw(), draw(), draw());
  const Equations equations(program::SourceText("test", text));
  const auto ends = [](const Equations& e, std::vector<double> start, int component, long double change) {
    using V = Vector<long double, Eigen::Dynamic>;
    V x = Eigen::Map<const Eigen::VectorXd>(start.data(), std::ssize(start)).cast<long double>();
    if (component >= 0) x[component] += change;
    const program::Problem f(e);
    const long double h = 0.0625L;
    V k1(x.size()), k2(k1), k3(k1), k4(k1);
    for (int step = 0; step < 8; ++step) {
      const long double t = step * h;
      f(t, x, k1);
      f(t + h / 2, V(x + h / 2 * k1), k2);
      f(t + h / 2, V(x + h / 2 * k2), k3);
      f(t + h, V(x + h * k3), k4);
      x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return x;
  };
  Equations all = equations.with_sensitivities("test", {"x", "a", "y"});
  const auto s = ends(all, all.initial_state("test", ""), -1, 0);
  const std::vector<double> start = Equations(equations).initial_state("test", "");
  const double a = equations.parameters().front().second;
  for (const int column : {1, 2, 3}) {
    const auto moved = [&](double change) {
      if (column != 2) return ends(equations, start, column == 1 ? 0 : 1, change);
      Equations other(equations.source(), {{"a", a + change}});
      return ends(other, other.initial_state("test", ""), -1, 0);
    };
    // Differences by the parameter start from doubles; their rounding is 1e-16/1e-6.
    const double change = 0x1p-20, tolerance = column == 2 ? 1e-8 : 1e-9;
    const auto plus = moved(change), minus = moved(-change);
    for (int i = 0; i < 2; ++i) {
      const auto difference = static_cast<double>((plus[i] - minus[i]) / (2 * change)),
                 found = static_cast<double>(s[all.layout().place(i, column)]);
      if (std::isfinite(difference))
        RC_ASSERT(std::abs(found - difference) <= tolerance * (1 + std::abs(difference)));
    }
  }
}

TEST(Sensitivities, StartAsTheIdentityAndTheDerivativesOfInitialValues) {
  Equations all =
      Equations(program::SourceText("test", "x'' = -w^2 x; w = 2; b = 3 w; x(0) = b^2; x'(0) = 1"))
          .with_sensitivities("test", {"x'", "w"});
  EXPECT_EQ(all.state_names(), (std::vector<std::string>{"x", "dx/dx'", "dx/dw", "x'", "dx'/dx'", "dx'/dw"}));
  EXPECT_TRUE(all.second_order());
  // x(0) = 9 w^2
  EXPECT_EQ(all.initial_state("test", ""), (std::vector<double>{36, 0, 36, 1, 1, 0}));
  EXPECT_EQ(all.initial_state("test", "x=2, x'=w"), (std::vector<double>{2, 0, 0, 2, 1, 1}));
}

// Steps that do not see the sensitivities are those of the equations alone; the sensitivities are as exact as
// x then, exp(t) cos(t) here. A power of two as scale is exact.
TEST(Sensitivities, ThatAreNotControlledChangeNoStep) {
  const std::string text = "x' = x - y; y' = x + y; x(0) = 1; y(0) = 0";
  const Extended plain(text, {}), all(text, {"x"}), scaled(text, {"x"}, ivp::unseen_scale);
  for (const char* method : {"ode45", "series", "adaptive-collocation"}) {
    const auto run = ivp::named_integrator(method, {.tolerance = 1e-8});
    const ivp::Solution alone = run(plain.system(), plain.x0, 0, 2, {}, {}),
                        unseen = ivp::controlled_by_solution(run, scaled.system())(all.system(), all.x0, 0, 2,
                                                                                   {}, {});
    ASSERT_TRUE(unseen.status.ok()) << unseen.status.text();
    EXPECT_EQ(unseen.statistics.steps, alone.statistics.steps) << method;
    EXPECT_NEAR(unseen.x[0], alone.x[0], 1e-14) << method;
    // The same linear equation: the errors are those of x, ten steps of 1e-8 and their growth by exp(2).
    EXPECT_NEAR(unseen.x[2], std::exp(2) * std::cos(2), 1e-5) << method;
  }
}

// A ball falls from h and bounces with the coefficient e at t1 = sqrt(2 h/g); closed form by complex steps.
TEST(Sensitivities, JumpAtAnEventThatChangesTheState) {
  const Extended ball("y'' = -g; g = 9.81; e = 0.8; y(0) = 2; y'(0) = 0", {"y", "e", "g"});
  const auto height = [](std::complex<double> h, std::complex<double> e, std::complex<double> g) {
    const std::complex<double> first = std::sqrt(2. * h / g), s = 1. - first;
    return e * g * first * s - g * s * s / 2.;
  };
  const std::complex<double> step(0, 1e-100);
  const Eigen::RowVector3d exact(height(2. + step, 0.8, 9.81).imag() / 1e-100,
                                 height(2, 0.8 + step, 9.81).imag() / 1e-100,
                                 height(2, 0.8, 9.81 + step).imag() / 1e-100);
  Equations equations = ball.equations;
  const program::NodeId ground = equations.expression("test", "y = 0");
  ivp::Event event = ivp::event_of(equations.graph(), ground, equations.slopes());
  event.crossing = ivp::Crossing::falling;
  event.change = [change = equations.change_at("test", "y = 0", {{equations.layout().place(1), "-e y'"}})](
                     double t, State& x) {
    const State before = x;
    change.run(t, before, 0, change.outputs(), [&x](int i, double value) { x[i] = value; });
  };
  const auto run = ivp::named_integrator("series", {.tolerance = 1e-13});
  const auto end = ivp::integrate_with_events(run, ball.system(), ball.x0, 0, 1, {event}, {}, {}, {});
  ASSERT_TRUE(end.solution.status.ok()) << end.solution.status.text();
  ASSERT_EQ(end.hits.size(), 1U);
  EXPECT_LE(greatest(ball.columns(end.solution.x).row(0) - exact), 1e-11);
}

// x' = 1 below 1, then 3: x(2) = 1 + 3 (2 - (1 - x0)/1). abs() has no jump of f, so that nothing jumps.
TEST(Sensitivities, JumpWhereTheEquationsSwitch) {
  const Extended faster("x' = if(x < 1, a, b); a = 1; b = 3; x(0) = 0", {"x", "a", "b"});
  const Eigen::RowVector3d exact(3, 3, 1);  // t* = (1 - x0)/a, x = 1 + b (2 - t*)
  for (const char* method : {"series", "dop853", "adaptive-collocation"})
    EXPECT_LE(greatest(faster.columns_at(2, method, 1e-12) - exact), 1e-11) << method;
  const Extended corner("x' = 1; y' = abs(x); x(0) = -1; y(0) = 0", {"x"});
  EXPECT_LE(greatest(corner.columns_at(3) - Eigen::Vector2d(1, 1)), 1e-13);  // x(3) + x(0) = 2 - 1
}

// A run that ends at the time of a switch, 1, is continued by another one.
TEST(Sensitivities, AtTheTimeOfASwitchAreThoseAfterIt) {
  const Extended ramp("x' = step(t - a); a' = 0; a(0) = 1; x(0) = 0", {"a"});
  const ivp::Solution middle = ramp.run(1, "dop853", 1e-12);
  EXPECT_NEAR(ramp.columns(middle.x)(0, 0), -1, 1e-12);
  const auto end =
      ivp::named_integrator("dop853", {.tolerance = 1e-12})(ramp.system(), middle.x, 1, 2, {}, {});
  EXPECT_NEAR(ramp.columns(end.x)(0, 0), -1, 1e-12);
}

TEST(Sensitivities, EndWhereTheSolutionStaysOnASurface) {
  const Extended friction("x' = 0.5 - sign(x); x(0) = 1", {"x"});
  const ivp::Solution end = friction.run(4);
  EXPECT_EQ(end.status.outcome(), Outcome::outside_validity);
  EXPECT_NE(end.status.text().find("sensitivities do not continue"), std::string::npos) << end.status.text();
}

std::string refusal(const std::string& text, const std::vector<std::string>& of) {
  return thrown<InputError>([&] { static_cast<void>(Extended(text, of)); });
}

TEST(Sensitivities, AreRefusedWithTheName) {
  const std::string text = "x' = -a x + step(t - b); a = 1; b = 2; x(0) = 1";
  EXPECT_EQ(refusal(text, {"x", "c"}), "test c: neither an initial value nor a parameter; choose from x,a,b");
  EXPECT_EQ(refusal(text, {"a", "x", "a"}), "test: a is given twice");
  EXPECT_NE(refusal(text, {"b"}).find("test b: the equations switch where b decides"), std::string::npos);
}

}  // namespace
}  // namespace nlmech::tests::sensitivities_test
