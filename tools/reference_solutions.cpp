/// @file
/// Computes tables/reference/rbf_ivp.csv: end states of the initial value problems of nlmech/problems in
/// extended precision. Each is computed twice, by Taylor series of two orders with different step sizes; only
/// digits on which both agree are printed.
///
///     reference_solutions > tables/reference/rbf_ivp.csv      all problems that take seconds
///     reference_solutions duffing van-der-pol-stiff           these only; the stiff ones take an hour each

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <chrono>
#include <cstdio>
#include <exception>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/problems/duffing.hpp"
#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"
#include "nlmech/support/extended_real.hpp"

namespace {

using nlmech::Vector;
using namespace nlmech::problems;

using Real = nlmech::ExtendedReal<60>;

constexpr int fewest_digits = 30, most_digits = 50;

/// Decimal digits on which two values agree, less one for the rounding of both.
int agreed_digits(const Real& a, const Real& b) {
  if (a == b) return most_digits;
  const Real relative = abs(a - b) / std::max(Real(abs(a)), Real(abs(b)));
  return std::clamp(static_cast<int>(-log10(relative)) - 1, 0, most_digits);
}

/// Key of a row: problem, parameters that differ from the default, time.
struct Place {
  std::string problem, parameters, time;
};

/// Prints a row. @throws std::runtime_error if the values agree on too few digits
void print(const Place& place, const std::string& state, const Real& first, const Real& second) {
  const int digits = agreed_digits(first, second);
  const std::string text = second.str(digits - 1, std::ios_base::scientific);
  if (digits < fewest_digits) {
    throw std::runtime_error(place.problem + " " + place.parameters + " t = " + place.time + ": " + state +
                             " agrees on " + std::to_string(digits) + " digits only");
  }
  std::printf("%s,%s,%s,%s,%s\n", place.problem.c_str(), place.parameters.c_str(), place.time.c_str(),
              state.c_str(), text.c_str());
}

/// The same states by two orders.
template <int n>
struct Twice {
  std::vector<Vector<Real, n>> first, second;
};

/// The two computations.
struct WorkLimit {
  int order[2];
  double tolerance[2];
};
constexpr WorkLimit fine = {{46, 58}, {1e-62, 1e-64}};
/// For step sizes limited by stability, not accuracy: a lower order is cheaper.
constexpr WorkLimit stiff = {{28, 34}, {1e-42, 1e-44}};

/// From the problem's own initial state at time 0. @throws std::runtime_error if a solution does not reach
/// the end
template <class Problem>
Twice<Problem::dimension> solve_twice(const Problem& problem, const std::vector<Real>& times,
                                      const WorkLimit& effort) {
  Twice<Problem::dimension> states;
  const auto solve = [&](std::vector<Vector<Real, Problem::dimension>>& found, int order, double tolerance) {
    const auto start = std::chrono::steady_clock::now();
    const Vector<Real, Problem::dimension> x0 = problem.initial_state().template cast<Real>();
    const nlmech::Status status =
        reference_states(problem, x0, Real(0), std::span<const Real>(times), found,
                         {.order = order, .tolerance = tolerance, .most_steps = 100'000'000});
    if (!status.ok()) throw std::runtime_error(status.text());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    (void)std::fprintf(stderr, "%s: order %d, %.0f s\n", std::string(problem.name).c_str(), order,
                       seconds.count());
  };
  solve(states.first, effort.order[0], effort.tolerance[0]);
  solve(states.second, effort.order[1], effort.tolerance[1]);
  return states;
}

/// Rows for all states at the given times; @p texts are the exact times.
template <class Problem>
Twice<Problem::dimension> tabulate(const Problem& problem, const std::string& parameters,
                                   const std::vector<std::string>& texts, const WorkLimit& effort = fine) {
  std::vector<Real> times;
  for (const std::string& text : texts) times.emplace_back(text);
  auto states = solve_twice(problem, times, effort);
  const auto half = static_cast<int>(problem.initial_state().size()) / 2;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    for (int i = 0; i < 2 * half; ++i) {
      const std::string component = (i < half ? "x" : "v") + std::to_string(i % half + 1);
      print(Place{std::string(problem.name), parameters, texts[k]}, component, states.first[k][i],
            states.second[k][i]);
    }
  }
  return states;
}

/// The period for amplitude 1 by Duffing::period(), and by Boost's complete elliptic integral.
void print_period(const Place& place, const Duffing& problem) {
  const Real modulus = sqrt(problem.elliptic_parameter(Real(1)));
  print(place, "period", problem.period(Real(1)),
        Real(4 * boost::math::ellint_1(modulus) / problem.argument_frequency(Real(1))));
}

void duffing() {
  const Duffing problem;
  print_period(Place{"duffing", "", "0"}, problem);
  tabulate(problem.text(), "", {"500"});
}

/// A fast oscillation: 101 periods in 0.75 units of time.
void duffing_hard() {
  const Duffing problem{.hardening = 1e6};
  print_period(Place{"duffing", "hardening=1e6", "0"}, problem);
  tabulate(problem.text(), "hardening=1e6", {"0.75"});
}

void impact() {
  const TextProblem problem("impact");
  const auto states = tabulate(problem, "", {"0.5", "1", "499", "500"});
  // Values of the free oscillation after the force.
  const Place place{"impact", "", "1"};
  const Duffing free;
  const auto &a = states.first[1], &b = states.second[1];
  print(place, "energy", free.energy(a), free.energy(b));
  print(place, "amplitude", free.amplitude(a), free.amplitude(b));
  print(place, "period", free.period(free.amplitude(a)), free.period(free.amplitude(b)));
}

/// three-dof.ode with the decimals of Table 4.5 instead of their nearest doubles.
struct DecimalChain {
  static constexpr int dimension = 6;
  static constexpr std::string_view name = "three-dof";
  Real k1 = 2, twentieth = Real(1) / 20, fifth = Real(1) / 5, frequency = sqrt(Real(1) / 2);

  static Vector<double, 6> initial_state() { return Vector<double, 6>::Zero(); }
  template <class T>
  void operator()(const T& t, const Vector<T, 6>& x, Vector<T, 6>& dxdt) const {
    const T wall = k1 * x[0] + fifth * (x[0] * x[0] * x[0]), damper = twentieth * (x[3] - x[4]);
    const T first = x[0] - x[1] + damper, second = (x[1] - x[2]) / 2;
    for (int i = 0; i < 3; ++i) dxdt[i] = x[i + 3];
    dxdt[3] = (-wall - first) / 2;
    dxdt[4] = fifth * cos(frequency * t) + first - second;
    dxdt[5] = second * 2;
  }
};

/// With the decimals of the table, and with their nearest doubles, which a program in double solves.
void three_masses() {
  tabulate(DecimalChain(), "", {"200"});
  tabulate(TextProblem("three-dof"), "as doubles", {"200"});
}

void three_masses_stiff() {
  DecimalChain problem;
  problem.k1 = 100'000'000;
  tabulate(problem, "k1=1e8", {"200"}, stiff);
}

void van_der_pol() {
  tabulate(TextProblem("van-der-pol", {{"mu", 10}}), "mu=10", {"20", "100"});
  tabulate(TextProblem("van-der-pol", {{"mu", 100}}), "mu=100", {"200"});
}

void van_der_pol_stiff() {
  tabulate(TextProblem("van-der-pol", {{"mu", 1000}}), "mu=1000", {"800", "1000", "2000"});
}

struct Case {
  const char* name;
  void (*make)();
  bool stiff = false;  // an explicit series takes hundreds of thousands of steps: only if asked for
};
constexpr Case cases[] = {{"duffing", duffing},
                          {"duffing-hard", duffing_hard},
                          {"impact", impact},
                          {"three-dof", three_masses},
                          {"three-dof-stiff", three_masses_stiff, true},
                          {"van-der-pol", van_der_pol},
                          {"van-der-pol-stiff", van_der_pol_stiff, true}};

}  // namespace

int main(int count, char** arguments) {
  const std::set<std::string> chosen(arguments + 1, arguments + count);
  for (const std::string& name : chosen) {
    if (std::none_of(std::begin(cases), std::end(cases), [&](const Case& c) { return name == c.name; })) {
      (void)std::fprintf(stderr, "reference_solutions: there is no problem '%s'; the problems are",
                         name.c_str());
      for (const Case& c : cases) (void)std::fprintf(stderr, " %s", c.name);
      (void)std::fprintf(stderr, "\n");
      return 2;
    }
  }
  try {
    std::printf("problem,parameters,t,state,value\n");
    for (const Case& c : cases) {
      if (chosen.empty() ? !c.stiff : chosen.contains(c.name)) c.make();
      (void)std::fflush(stdout);
    }
  } catch (const std::exception& failed) {
    (void)std::fprintf(stderr, "reference_solutions: %s\n", failed.what());
    return 1;
  }
  return 0;
}
