#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "nlmech/program/power_series.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::algebraic_series::fractional_power {
namespace {

using Real = ExtendedReal<40>;

/// A polynomial f whose fifth root is expanded about 0.
struct Root {
  std::string name;
  std::vector<Real> f;  ///< coefficients of f
  double zero;          ///< distance from 0 to the nearest zero of f
};

const std::vector<Root>& roots() {
  static const std::vector<Root> all = {
      {"1 + 0.3 t + 0.2 t^2", {1, Real(3) / 10, Real(2) / 10}, std::sqrt(5.0)},
      {"1 - t/1.1", {1, -Real(10) / 11}, 1.1},
      {"1 - t/1.01", {1, -Real(100) / 101}, 1.01},
      {"1 - t", {1, -1}, 1}};
  return all;
}

/// Errors at t = 1 of the partial sums of 1, 2, ... terms of f^(1/5).
std::vector<double> errors(const Root& root, int terms) {
  // k f_0 h_k = sum_m (m/5 - (k - m)) f_m h_{k-m}; f_0 = 1, and only f_1 and f_2 can be non-zero.
  std::vector<Real> h = {1};
  Real at_one = 0;
  for (const Real& c : root.f) at_one += c;
  const Real reference = at_one == 0 ? Real(0) : Real(pow(at_one, Real(1) / 5));
  Real sum = h[0];
  std::vector<double> found = {static_cast<double>(abs(sum - reference))};
  const Real p = Real(1) / 5;
  for (int k = 1; k < terms; ++k) {
    Real next = 0;
    for (int m = 1; m < static_cast<int>(root.f.size()) && m <= k; ++m)
      next += (p * m - (k - m)) * root.f[static_cast<std::size_t>(m)] * h[static_cast<std::size_t>(k - m)];
    h.push_back(next / k);
    sum += h.back();
    found.push_back(static_cast<double>(abs(sum - reference)));
  }
  return found;
}

/// Errors of the partial sums of a root.
struct Sums {
  std::string name;
  double zero;                 ///< distance from 0 to the nearest zero of f
  std::vector<double> errors;  ///< errors of 1, 2, ... terms

  /// Number of terms from which on the error stays below @p bound; 0 if there is none.
  [[nodiscard]] int terms_for(double bound) const {
    std::size_t last = errors.size();
    while (last > 0 && errors[last - 1] < bound) --last;
    return last == errors.size() ? 0 : static_cast<int>(last) + 1;
  }
  /// terms_for() as a table cell.
  [[nodiscard]] scene::Cell terms(double bound) const {
    return terms_for(bound) > 0 ? scene::Cell(terms_for(bound)) : scene::Cell("more than 3000");
  }
};

std::vector<Sums> compute() {
  std::vector<Sums> all;
  for (const Root& root : roots()) all.push_back({root.name, root.zero, errors(root, 3000)});
  return all;
}

/// Error of 60 terms of the first root by the library's pow().
double error_of_the_library() {
  const auto variable = PowerSeries<Real>::variable(Real(0), 59);
  const auto f = Real(1) + Real(3) / 10 * variable + Real(2) / 10 * variable * variable;
  const auto h = pow(f, Real(1) / 5);
  Real sum = 0;
  for (std::size_t i = 0; i < 60; ++i) sum += h[i];
  return static_cast<double>(abs(sum - pow(Real(3) / 2, Real(1) / 5)));
}

void draw(const std::vector<Sums>& all, scene::Show& show) {
  scene::Table data({{"function", 3, true}, {"terms"}, {"error"}});
  for (const Sums& s : all) {
    for (std::size_t k = 0; k < s.errors.size(); k = k < 100 ? k + 1 : k + 25)
      data.add({s.name, k + 1, std::max(s.errors[k], 1e-40)});
  }
  show.plot("Fifth roots by series: the nearer the zero of f, the more terms", "terms",
            "error at {/:Italic t} = 1")
      .log_x(1, 3000)
      .log_y(1e-40, 1e2)
      .key("bottom left")
      .columns("f = 1 − t", "terms:error", scene::lines(5), 3)
      .columns("f = 1 − t/1.01", "terms:error", scene::lines(2), 2)
      .columns("f = 1 − t/1.1", "terms:error", scene::lines(4), 1)
      .columns("f = 1 + 0.3 t + 0.2 t^2", "terms:error", scene::lines(1), 0);
  show.figure().data(std::move(data));
}

void put(const std::vector<Sums>& all, scene::Show& show) {
  draw(all, show);
  show.table(all, {{"f(t)", &Sums::name},
                   {"distance of its nearest zero", &Sums::zero},
                   {"terms for 1e-6 at t = 1", [](const Sums& s) { return s.terms(1e-6); }},
                   {"for 1e-16", [](const Sums& s) { return s.terms(1e-16); }},
                   {"error of 60 terms", [](const Sums& s) { return s.errors[59]; }, 2},
                   {"error of 3000 terms", [](const Sums& s) { return s.errors.back(); }, 2}});
  // oracle: algebraic_series_sums fifth *
  show.between("error of 60 terms, f = 1 + 0.3 t + 0.2 t^2", all[0].errors[59], 9e-25 / 1.1, 9e-25 * 1.1,
               "tools/oracles/algebraic_series_sums.py: 9e-25");
  show.near("the same by the library's power series", error_of_the_library(), all[0].errors[59], 1e-6,
            "the recurrence written out here; 40 digits less 24");
  show.near("error of 3000 terms, f = 1 - t", all[3].errors.back(), 0.173, 0.003,
            "tools/oracles/algebraic_series_sums.py: 0.173; half a unit of its last digit");
  show.measured("filipich-rosales/claim-2.5/fractional power n = 5/terms needed (at least)",
                all[0].terms_for(1e-24));
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result sums(
      "fifth-roots",
      "sums of the series of f^(1/5) at t = 1, the end of the paper's unit interval; 40 digits", compute);
  return {{.name = "fractional-power",
           .title = "Terms that the fifth root of a function needs",
           .place = "our own, for the claim of section 2.5",
           .content = scene::Content(put, sums)}};
}

}  // namespace nlmech::chapters::algebraic_series::fractional_power
