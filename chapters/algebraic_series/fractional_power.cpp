#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "chapters/algebraic_series/scenes.hpp"
#include "nlmech/series/power_series.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<40>, boost::multiprecision::et_off>;

/// The fifth root of a polynomial, whose nearest zero is that far from 0.
struct Root {
  std::string name;
  std::vector<Real> f;  ///< coefficients
  double zero;          ///< distance of its nearest zero
};

const std::vector<Root>& roots() {
  static const std::vector<Root> all = {
      {"1 + 0.3 t + 0.2 t^2", {1, Real(3) / 10, Real(2) / 10}, std::sqrt(5.0)},
      {"1 - t/1.1", {1, -Real(10) / 11}, 1.1},
      {"1 - t/1.01", {1, -Real(100) / 101}, 1.01},
      {"1 - t", {1, -1}, 1}};
  return all;
}

/// Errors at t = 1 of the sums of the first 1, 2, ... terms of f^(1/5).
std::vector<double> errors(const Root& root, int terms) {
  // k f_0 h_k = sum_j (k/5 - 6 j/5) f_{k-j}... in the form for few f: only f_1 and f_2 differ from zero.
  std::vector<Real> h = {1};
  Real at_one = 0;
  for (const Real& c : root.f) at_one += c;
  const Real truth = at_one == 0 ? Real(0) : Real(pow(at_one, Real(1) / 5));
  Real sum = h[0];
  std::vector<double> found = {static_cast<double>(abs(sum - truth))};
  const Real p = Real(1) / 5;
  for (int k = 1; k < terms; ++k) {
    Real next = 0;
    for (int m = 1; m < static_cast<int>(root.f.size()) && m <= k; ++m)
      next += (p * m - (k - m)) * root.f[static_cast<std::size_t>(m)] * h[static_cast<std::size_t>(k - m)];
    h.push_back(next / k);
    sum += h.back();
    found.push_back(static_cast<double>(abs(sum - truth)));
  }
  return found;
}

/// Terms after which the error stays below @p bound; 0 if that does not happen.
int terms_for(const std::vector<double>& errors, double bound) {
  std::size_t last = errors.size();
  while (last > 0 && errors[last - 1] < bound) --last;
  return last == errors.size() ? 0 : static_cast<int>(last) + 1;
}

struct Measured {
  std::vector<std::vector<double>> errors;  ///< as roots()
};

Measured measure() {
  Measured m;
  for (const Root& root : roots()) m.errors.push_back(errors(root, 3000));
  return m;
}

scene::Showing show(const Measured& m) {
  scene::Table data({{"function", 3, true}, {"terms"}, {"error"}});
  scene::Table table({{"f(t)"},
                      {"distance of its nearest zero"},
                      {"terms for 1e-6 at t = 1"},
                      {"for 1e-16"},
                      {"error of 60 terms", 2},
                      {"error of 3000 terms", 2}});
  for (std::size_t i = 0; i < roots().size(); ++i) {
    const auto& e = m.errors[i];
    for (std::size_t k = 0; k < e.size(); k = k < 100 ? k + 1 : k + 25)
      data.add({roots()[i].name, static_cast<std::int64_t>(k + 1), std::max(e[k], 1e-40)});
    const auto cell = [](int terms) {
      return terms > 0 ? scene::Cell(std::int64_t{terms}) : scene::Cell("more than 3000");
    };
    table.add({roots()[i].name, roots()[i].zero, cell(terms_for(e, 1e-6)), cell(terms_for(e, 1e-16)), e[59],
               e.back()});
  }
  scene::Showing showing;
  showing.figure = {std::move(data),
                    "algebraic_series-fractional-power",
                    {{"heading", "Fifth roots: the nearest zero of f says how many terms, not the root"}}};
  showing.table = std::move(table);
  // The library's own power, to the same terms.
  const auto variable = PowerSeries<Real>::variable(Real(0), 59);
  const auto f = Real(1) + Real(3) / 10 * variable + Real(2) / 10 * variable * variable;
  const auto h = pow(f, Real(1) / 5);
  Real sum = 0;
  for (std::size_t i = 0; i < 60; ++i) sum += h[i];
  const auto library = static_cast<double>(abs(sum - pow(Real(3) / 2, Real(1) / 5)));
  // oracle: algebraic_series_sums fifth *
  showing.quantities = {
      {"error of 60 terms, f = 1 + 0.3 t + 0.2 t^2", "1", m.errors[0][59], 9e-25 / 1.1, 9e-25 * 1.1,
       "tools/oracles/algebraic_series_sums.py: 9e-25"},
      scene::near("the same by the library's power series", "1", library, m.errors[0][59], 1e-6,
                  "the recurrence written out here; 40 digits less 24"),
      scene::near("error of 3000 terms, f = 1 - t", "1", m.errors[3].back(), 0.173, 0.003,
                  "tools/oracles/algebraic_series_sums.py: 0.173; half a unit of its last digit")};
  return showing;
}

}  // namespace

void add_fractional_power(scene::Chapter& chapter) {
  const auto& run = chapter.add_run<Measured>(
      "fifth-roots",
      "sums of the series of f^(1/5) at t = 1, the end of the paper's unit interval; 40 digits", {},
      [](Workshop&) { return measure(); });
  chapter.add({.name = "fractional-power",
               .title = "How many terms the fifth root of a function needs",
               .place = "our own, for the claim of section 2.5",
               .needs = {&run},
               .show = [&run](Workshop& w) { return show(w.result(run)); }});
  chapter.add({.name = "filipich-rosales/claim-2.5/fractional power n = 5/terms needed (at least)",
               .needs = {&run},
               .measure = [&run](Workshop& w) {
                 return scene::Measured{double(terms_for(w.result(run).errors[0], 1e-24)), {}};
               }});
}

}  // namespace nlmech::chapters
