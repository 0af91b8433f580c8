#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "nlmech/scene/scene.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::algebraic_series::bessel {
namespace {

using Real = ExtendedReal<80>;

/// J_n(x), by MPFR, also for negative n.
Real bessel_j(int n, const Real& x) {
  Real j;
  mpfr_jn(j.backend().data(), n, x.backend().data(), MPFR_RNDN);
  return j;
}

/// Solution of Bessel's equation on (0, T), Eq. 32, expanded about tau = x/T = 1.
struct Expansion {
  int order;                ///< nu, order of the equation
  int length;               ///< T
  std::vector<Real> value;  ///< coefficients of (tau - 1)^i

  /// Sum of the first @p terms terms.
  [[nodiscard]] Real at(const Real& tau, int terms) const {
    Real sum = 0;
    for (int i = terms - 1; i >= 0; --i) sum = sum * (tau - 1) + value[static_cast<std::size_t>(i)];
    return sum;
  }
};

/// Continues the coefficients from A_0 and A_1 by the recurrence of Eqs. 36 to 38 with alpha = (1, 1, 0,
/// ...), beta = (1, 2, 1, 0, ...). D_i, the coefficient of tau^2 v, has three terms, C_i and B_i have two.
Expansion continued(Expansion e, int terms) {
  const int nu = e.order, T = e.length;
  const auto A = [&](int i) { return i < 0 ? Real(0) : e.value[static_cast<std::size_t>(i)]; };
  for (int i = 0; i + 2 < terms; ++i) {
    const Real B = 2 * (Real(i) * (i + 1)) * A(i + 1) + (Real(i - 1) * i) * A(i);
    const Real C = Real(i + 1) * A(i + 1) + Real(i) * A(i);
    const Real D = A(i) + 2 * A(i - 1) + A(i - 2);
    e.value.push_back((Real(nu) * nu * A(i) - (B + C + Real(T) * T * D)) / (Real(i + 1) * (i + 2)));
  }
  return e;
}

/// The solution J_nu(T tau).
Expansion expand(int nu, int T, int terms) {
  const Real slope = (bessel_j(nu - 1, Real(T)) - bessel_j(nu + 1, Real(T))) / 2;
  return continued({nu, T, {bessel_j(nu, Real(T)), T * slope}}, terms);
}

double error(const Expansion& e, const Real& tau, int terms) {
  return static_cast<double>(abs(e.at(tau, terms) - bessel_j(e.order, Real(e.length * tau))));
}

/// Ratio of the last two coefficients of the solution with A_0 = 1, A_1 = 0. It contains the logarithm of
/// Y_nu, and its series does not converge at 0.
double growth_of_the_free_solution(int nu, int T, int terms) {
  const Expansion e = continued({nu, T, {1, 0}}, terms);
  return static_cast<double>(abs(e.value.back() / e.value[e.value.size() - 2]));
}

void draw(const Expansion& two, const Expansion& zero, scene::Show& show) {
  scene::Table data({{"case", 3, true}, {"tau"}, {"error"}});
  const int samples = show.quick() ? 50 : 200;
  const auto add = [&](const char* name, const Expansion& e, int terms) {
    for (int k = 1; k < samples; ++k) {
      const double tau = static_cast<double>(k) / samples;
      data.add({name, tau, std::max(error(e, tau, terms), 1e-70)});
    }
  };
  add("J2 T=5, 20 terms", two, 20);
  add("J2 T=5, 100 terms", two, 100);
  add("J0 T=10, 20 terms", zero, 20);
  add("J0 T=10, 100 terms", zero, 100);
  show.plot("Bessel series about {/:Italic τ} = 1: error on (0, 1) falls with the number of terms",
            "{/:Italic τ} = {/:Italic x}/{/:Italic T}", "error")
      .x_range(0, 1)
      .log_y(1e-70, 1e5)
      .key("at graph 0.34, 0.52 left top")
      .columns("J_0, T = 10, 20 terms", "tau:error", scene::lines(5), 2)
      .columns("J_2, T = 5, 20 terms", "tau:error", scene::lines(2), 0)
      .columns("J_0, T = 10, 100 terms", "tau:error", scene::lines(1), 3)
      .columns("J_2, T = 5, 100 terms", "tau:error", scene::lines(4), 1);
  show.figure().data(std::move(data));
}

void put(scene::Show& show) {
  const Expansion two = expand(2, 5, 100), zero = expand(0, 10, 100);
  draw(two, zero, show);
  // oracle: algebraic_series_sums J_*
  const char* known = "tools/oracles/algebraic_series_sums.py, one digit; within a factor of two";
  const Real near_zero = Real(1) / 100, near_one = Real(9) / 10;
  show.between("error of 20 terms, J_2, T = 5, tau = 0.9", error(two, near_one, 20), 1e-26 / 2, 1e-26 * 2,
               known);
  show.between("error of 20 terms, J_2, T = 5, tau = 0.01", error(two, near_zero, 20), 2e-7 / 2, 2e-7 * 2,
               known);
  show.near("error of 20 terms, J_0, T = 10, tau = 0.01", error(zero, near_zero, 20), 5.2, 0.02,
            "tools/oracles/algebraic_series_sums.py: 5.2; half a unit of its last digit");
  show.at_most("error of 100 terms, J_2, T = 5, tau = 0.01", error(two, near_zero, 100), 4e-27,
               "regression value in fewer digits: 2e-27, rounding");
  show.at_most("error of 100 terms, J_0, T = 10, tau = 0.01", error(zero, near_zero, 100), 8e-26,
               "regression value in fewer digits: 4e-26, rounding");
  show.near("ratio of the last coefficients of the solution with A_0 = 1, A_1 = 0",
            growth_of_the_free_solution(2, 5, 400), 1, 0.02,
            "a singularity at tau = 0: the ratio tends to 1/rho = 1 like 1 + O(1/i)");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "bessel",
           .title = "Bessel's equation expanded about tau = 1: error against tau and terms",
           .place = "our own, for section 3.1",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::algebraic_series::bessel
