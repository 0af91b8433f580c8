#include "nlmech/ivp/hermitian/hermitian_operators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace nlmech::ivp {
namespace {

/// k (k - 1) ... with @p factors factors: the derivative of t^k of that order at t = 1.
double falling(int k, int factors) {
  double product = 1;
  for (int i = 0; i < factors; ++i) product *= k - i;
  return product;
}

/// The derivative of t^k of order @p factors at t = 0.
double falling_at_zero(int k, int factors) { return k == factors ? falling(k, factors) : 0; }

}  // namespace

const HermitianPair& hermitian_pair(std::string_view name) {
  std::string known;
  for (const HermitianPair& pair : hermitian_table) {
    if (pair.name == name) return pair;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", pair.name);
  }
  throw std::invalid_argument(fmt::format("there are no operators '{}'; choose one of {}", name, known));
}

double residual_on_power(const HermitianOperator& op, int k) {
  const double begin = op.A * falling_at_zero(k, 0) + op.C * falling_at_zero(k, 1) +
                       op.E * falling_at_zero(k, 2) + op.G * falling_at_zero(k, 3);
  return begin + op.B + op.D * falling(k, 1) + op.F * falling(k, 2) + op.H * falling(k, 3);
}

HermitianStep solved_for_end(const HermitianPair& pair) {
  const HermitianOperator &p = pair.first, &s = pair.second;
  const double determinant = p.B * s.D - p.D * s.B;
  const double size = std::max(std::abs(p.B), std::abs(p.D)) * std::max(std::abs(s.B), std::abs(s.D));
  if (!(std::abs(determinant) > 1e-12 * size))
    throw std::invalid_argument(
        fmt::format("{}: the two operators do not determine the end of a step: B D1 - D B1 = {:.6g}",
                    pair.name, determinant));
  // By Cramer's rule; for the rows of the table numerators and denominators are exact.
  const auto q = [&](double of_first, double of_second) {
    return -(s.D * of_first - p.D * of_second) / determinant;
  };
  const auto v = [&](double of_first, double of_second) {
    return -(p.B * of_second - s.B * of_first) / determinant;
  };
  const std::array<double, 4> moved = {q(p.A, s.A), q(p.C, s.C), v(p.A, s.A), v(p.C, s.C)};
  constexpr std::array<double, 4> uniform = {1, 1, 0, 1};
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (!(std::abs(moved[i] - uniform[i]) <= 1e-12))
      throw std::invalid_argument(
          fmt::format("{}: uniform motion is not preserved: q1 = {:.6g} q0 + {:.6g} h v0, h v1 = {:.6g} q0 "
                      "+ {:.6g} h v0",
                      pair.name, moved[0], moved[1], moved[2], moved[3]));
  }
  return {.qa0 = q(p.E, s.E),
          .qa1 = q(p.F, s.F),
          .qj0 = q(p.G, s.G),
          .qj1 = q(p.H, s.H),
          .va0 = v(p.E, s.E),
          .va1 = v(p.F, s.F),
          .vj0 = v(p.G, s.G),
          .vj1 = v(p.H, s.H)};
}

int order_of(const HermitianStep& s) {
  const HermitianOperator q = {1, -1, 1, 0, s.qa0, s.qa1, s.qj0, s.qj1};
  const HermitianOperator v = {0, 0, 1, -1, s.va0, s.va1, s.vj0, s.vj1};
  // A velocity of degree k is a position of degree k + 1.
  int order = 0;
  while (order < 5 && std::abs(residual_on_power(q, order + 1)) < 1e-12 &&
         std::abs(residual_on_power(v, order + 2)) < 1e-12)
    ++order;
  return order;
}

Amplification amplification(const HermitianStep& s, double z, double xi) {
  if (!(z >= 0) || !std::isfinite(z))
    throw std::invalid_argument(fmt::format("amplification: z must be finite and not negative, not {}", z));
  if (!(xi >= 0 && xi < 1))
    throw std::invalid_argument(fmt::format("amplification: xi must be from 0 to below 1, not {}", xi));
  using Real = long double;
  // In units of the step, with w = h v: h^2 a = aq q + aw w, h^3 j = jq q + jw w.
  const Real z2 = Real(z) * z, c = 2 * Real(xi) * z;
  const Real aq = -z2, aw = -c, jq = c * z2, jw = c * c - z2;
  // M1 (q1, w1) = M0 (q0, w0).
  const Real m11 = 1 - s.qa1 * aq - s.qj1 * jq, m12 = -s.qa1 * aw - s.qj1 * jw;
  const Real m21 = -s.va1 * aq - s.vj1 * jq, m22 = 1 - s.va1 * aw - s.vj1 * jw;
  const Real k11 = 1 + s.qa0 * aq + s.qj0 * jq, k12 = 1 + s.qa0 * aw + s.qj0 * jw;
  const Real k21 = s.va0 * aq + s.vj0 * jq, k22 = 1 + s.va0 * aw + s.vj0 * jw;
  const Real below = m11 * m22 - m12 * m21;
  const Real determinant = (k11 * k22 - k12 * k21) / below;
  const Real half_trace = (m22 * k11 - m12 * k21 + m11 * k22 - m21 * k12) / (2 * below);
  Real discriminant = half_trace * half_trace - determinant;
  if (std::abs(discriminant) <= 0x1p-58L * (half_trace * half_trace + std::abs(determinant)))
    discriminant = 0;
  const Real root = std::sqrt(std::abs(discriminant));
  const Real radius = discriminant > 0 ? std::abs(half_trace) + root : std::sqrt(std::abs(determinant));
  const Real phase =
      discriminant > 0 ? (half_trace > 0 ? Real(0) : std::acos(Real(-1))) : std::atan2(root, half_trace);
  return {static_cast<double>(determinant), static_cast<double>(half_trace), static_cast<double>(radius),
          static_cast<double>(phase)};
}

}  // namespace nlmech::ivp
