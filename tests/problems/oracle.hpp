/// @file
/// References for the tests of the problems: closed forms and a Runge-Kutta method of Boost, independent of
/// the Taylor series of the reference solutions.
#pragma once

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/numeric/odeint.hpp>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "nlmech/problems/duffing.hpp"
#include "tests/places.hpp"
#include "tests/program/numbers.hpp"

namespace nlmech::problems::tests {

using nlmech::tests::between;
using nlmech::tests::epsilon;
using nlmech::tests::Real;

/// Position and velocity of the free oscillator released at its amplitude X at time 0, by Boost's Jacobi
/// functions in 50 digits: X cn(omega t), -X omega sn dn.
inline Vector<Real, 2> free_oscillation(const Duffing& problem, const Real& amplitude, const Real& t) {
  const Real omega = sqrt(Real(problem.natural_frequency) * problem.natural_frequency +
                          problem.hardening * amplitude * amplitude);
  const Real modulus = sqrt(problem.hardening * amplitude * amplitude / (2 * omega * omega));
  Real cn, dn;
  const Real sn = boost::math::jacobi_elliptic(modulus, Real(omega * t), &cn, &dn);
  return {amplitude * cn, -amplitude * omega * sn * dn};
}

/// The state at time @p t1 by Odeint's Runge-Kutta-Fehlberg method of order 8 in T with a local tolerance of
/// @p tolerance.
template <class T, class Problem>
Vector<T, Problem::dimension> by_odeint(const Problem& problem, const Vector<T, Problem::dimension>& x0,
                                        const T& t0, const T& t1, const T& tolerance) {
  namespace odeint = boost::numeric::odeint;
  constexpr int n = Problem::dimension;
  using State = std::vector<T>;
  const Eigen::Index size = x0.size();
  State state(x0.data(), x0.data() + size);
  const auto slope = [&problem, size](const State& x, State& dxdt, T t) {
    Vector<T, n> f(size);
    problem(t, Vector<T, n>(Eigen::Map<const Vector<T, n>>(x.data(), size)), f);
    std::copy(f.data(), f.data() + size, dxdt.begin());
  };
  using Stepper = odeint::runge_kutta_fehlberg78<State, T>;
  odeint::integrate_adaptive(odeint::make_controlled<Stepper>(tolerance, tolerance), slope, state, t0, t1,
                             T(1) / 100000);
  return Eigen::Map<const Vector<T, n>>(state.data(), size);
}

/// A row of tables/reference/rbf_ivp.csv.
struct Reference {
  std::string problem, parameters, t, state, value;
};

/// All rows of the table.
inline std::vector<Reference> read_references() {
  std::ifstream in(NLMECH_SOURCE_DIR "/tables/reference/rbf_ivp.csv");
  std::vector<Reference> rows;
  std::string line;
  std::getline(in, line);
  if (line != "problem,parameters,t,state,value") throw std::runtime_error("reference table: header " + line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    Reference row;
    for (std::string* cell : {&row.problem, &row.parameters, &row.t, &row.state, &row.value}) {
      std::getline(cells, *cell, ',');
    }
    rows.push_back(row);
  }
  return rows;
}

/// The value of a row of the table.
inline Real reference(const std::string& problem, const std::string& parameters, const std::string& t,
                      const std::string& state) {
  static const std::vector<Reference> rows = read_references();
  for (const Reference& row : rows) {
    if (row.problem == problem && row.parameters == parameters && row.t == t && row.state == state)
      return Real(row.value);
  }
  throw std::runtime_error("reference table: no row " + problem + "," + parameters + "," + t + "," + state);
}

/// A state of the table: positions x1, ..., then velocities v1, ...
template <int n>
Vector<Real, n> reference_state(const std::string& problem, const std::string& parameters,
                                const std::string& t) {
  Vector<Real, n> x;
  for (int i = 0; i < n; ++i)
    x[i] = reference(problem, parameters, t, (i < n / 2 ? "x" : "v") + std::to_string(i % (n / 2) + 1));
  return x;
}

/// Largest difference of two states.
template <class A, class B>
double distance(const A& a, const B& b) {
  double greatest = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    greatest = std::max(greatest, static_cast<double>(abs(Real(a[i]) - Real(b[i]))));
  return greatest;
}

}  // namespace nlmech::problems::tests
