/// @file
/// The recursion of the dissertation with derivatives and binomial coefficients instead of Taylor
/// coefficients, for its drawing and for the study of its misprints.
#pragma once

#include <cmath>
#include <vector>

#include "nlmech/orbit/state.hpp"

namespace nlmech::chapters::two_body_series {

/// Readings of the sum of Eq. 3.66. There p/2 is printed like a binomial coefficient, and a bracket is
/// missing. The term before the sum is printed correctly.
enum class Equation366 {
  corrected,  ///< C(n, m) [(p/2) f^(m+1) g^(n-m) + f^(m) g^(n-m+1)]
  bracketed,  ///< C(n, m) [C(p, 2) f^(m+1) g^(n-m) + f^(m) g^(n-m+1)]
  literal     ///< C(n, m) C(p, 2) f^(m+1) g^(n-m) + f^(m) g^(n-m+1)
};

/// Derivatives r^(0) to r^(order) by Eqs. 3.62, 3.66 and 3.68 with p = 3. @param order at least 2
template <class T>
[[nodiscard]] std::vector<orbit::Vector3<T>> raw_derivatives(const orbit::BasicState<T>& s, const T& mu,
                                                             int order,
                                                             Equation366 reading = Equation366::corrected) {
  const T p_half = T(3) / 2, factor = reading == Equation366::corrected ? p_half : T(3);  // C(3, 2) = 3
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<orbit::Vector3<T>> r = {s.position, s.velocity};
  std::vector<T> f, g, binomial = {T(1)};  // row n of Pascal's triangle
  for (int n = 0; n + 2 <= order; ++n) {
    T sum = 0;
    for (int m = 0; m <= n; ++m) sum += binomial[at(m)] * r[at(m)].dot(r[at(n - m)]);
    f.push_back(sum);  // 3.62
    if (n == 0) {
      using std::sqrt;
      g.push_back(T(1 / (f[0] * sqrt(f[0]))));  // 3.63 with p = 3
    } else {
      const int k = n - 1;  // 3.66 for g^(k + 1), with row k
      T inner = p_half * f[1] * g[at(k)], c = 1;
      for (int m = 1; m <= k; ++m) {
        c = c * (k - m + 1) / m;
        inner += c * factor * f[at(m + 1)] * g[at(k - m)];
        inner += (reading == Equation366::literal ? T(1) : c) * f[at(m)] * g[at(k - m + 1)];
      }
      g.push_back(T(-inner / f[0]));
    }
    orbit::Vector3<T> a = orbit::Vector3<T>::Zero();
    for (int m = 0; m <= n; ++m) a += T(binomial[at(m)] * g[at(n - m)]) * r[at(m)];
    r.push_back(-mu * a);  // 3.68
    binomial.push_back(T(1));
    for (int m = n; m >= 1; --m) binomial[at(m)] += binomial[at(m - 1)];
  }
  return r;
}

/// One step by Taylor's formula from K + 1 derivatives: position to degree K, velocity to degree K - 1.
template <class T>
[[nodiscard]] orbit::BasicState<T> raw_step(const std::vector<orbit::Vector3<T>>& derivatives, const T& h) {
  orbit::BasicState<T> end{derivatives[0], derivatives[1]};
  T term = 1;  // h^k/k!
  for (std::size_t k = 1; k < derivatives.size(); ++k) {
    term = term * h / static_cast<int>(k);
    end.position += term * derivatives[k];
    if (k + 1 < derivatives.size()) end.velocity += term * derivatives[k + 1];
  }
  return end;
}

}  // namespace nlmech::chapters::two_body_series
