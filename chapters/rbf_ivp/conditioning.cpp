#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <optional>

#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/extended.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/problems/duffing.hpp"

namespace nlmech::chapters {
namespace {

using collocation::Inversion;
using collocation::Kernel;
using collocation::NodeFamily;
using scene::Workshop;
using Column50 = collocation::Vector<Digits50>;

constexpr auto lobatto = NodeFamily::legendre_gauss_lobatto;
constexpr double begin = 1.1;  // s, of the arc: at no symmetry of the motion, where errors would cancel

/// So many nodes on so many periods of the free Duffing oscillator, and the shape c h of the dissertation.
struct Setting {
  int nodes;
  double periods, shape;
};
constexpr std::array settings = {Setting{7, 0.1, 0.367}, Setting{15, 0.5, 3.5}, Setting{35, 1, 8.5},
                                 Setting{60, 1, 14.75}};

/// The motion x(t) of Eq. 4.23 and its derivative with 50 digits at the nodes of an interval, which is the
/// unit of time.
struct Arc {
  Column50 value, slope;
};

Arc arc(const Setting& setting) {
  const problems::Duffing problem;
  const Digits50 X = 1, omega = problem.argument_frequency(X), h = setting.periods * problem.period(X);
  const Digits50 m = problem.elliptic_parameter(X), modulus = sqrt(m);
  const Column50 nodes = unit_nodes(lobatto, setting.nodes);
  Arc a{Column50(nodes.size()), Column50(nodes.size())};
  for (Eigen::Index j = 0; j < nodes.size(); ++j) {
    Digits50 cn;
    const Digits50 u = omega * (begin + h * nodes[j]), sn = boost::math::jacobi_elliptic(modulus, u, &cn);
    const Digits50 dn = sqrt(1 - m * sn * sn);  // the library's own is a quotient of zeros at quarter periods
    a.value[j] = X * cn;
    a.slope[j] = -X * omega * h * sn * dn;
  }
  return a;
}

/// max |found - slope| / max |slope|.
double relative_error(const Column50& found, const Arc& a) {
  return static_cast<double>(
      Digits50((found - a.slope).cwiseAbs().maxCoeff() / a.slope.cwiseAbs().maxCoeff()));
}

/// Error of D f in double, nothing if there is no D.
std::optional<double> error_in_double(const Setting& setting, const Arc& a, double shape,
                                      Inversion inversion) {
  const Eigen::VectorXd nodes = (collocation::nodes(lobatto, setting.nodes).array() + 1) / 2;
  const auto d = collocation::radial_differentiation(nodes, Kernel::gaussian, shape, inversion);
  if (d.matrix.size() == 0) return std::nullopt;
  const Eigen::VectorXd slope = d.matrix * a.value.cast<double>();
  return relative_error(slope.cast<Digits50>(), a);
}

/// Condition number of a symmetric positive matrix: the power method for its ends. Eigenvalues of Gaussians
/// lie far apart at the small end; at the large end a percent will do.
double condition(const collocation::Matrix<Digits50>& matrix,
                 const Eigen::PartialPivLU<collocation::Matrix<Digits50>>& lu) {
  const auto grown = [](Column50 x, auto&& apply) {
    Digits50 growth = 0;
    for (int k = 0; k < 30; ++k) {
      x = apply(x);
      growth = x.norm();
      x /= growth;
    }
    return growth;
  };
  Column50 start(matrix.rows());
  for (Eigen::Index j = 0; j < start.size(); ++j) start[j] = j % 2 == 0 ? 1 + Digits50(j) / 100 : -1;
  const Digits50 largest = grown(start.cwiseAbs(), [&](const Column50& x) { return Column50(matrix * x); });
  const Digits50 inverse_of_least = grown(start, [&](const Column50& x) { return Column50(lu.solve(x)); });
  return static_cast<double>(Digits50(largest * inverse_of_least));
}

/// D f with 50 digits, and the condition of Phi; nothing where 50 digits do not reach.
struct Exact {
  std::optional<double> error, condition;
};

Exact exact(const Setting& setting, const Arc& a, double shape) {
  const Column50 nodes = unit_nodes(lobatto, setting.nodes);
  const collocation::RadialBasis<Digits50> basis(nodes, Kernel::gaussian, Digits50(shape));
  const Eigen::PartialPivLU<collocation::Matrix<Digits50>> lu(basis.values());
  const double kappa = condition(basis.values(), lu);
  if (!(kappa < 1e34)) return {};  // 50 digits less these leave 16 for the error
  const Column50 weights = lu.solve(a.value);
  return {relative_error(basis.derivatives() * weights, a), kappa};
}

double flat_limit(const Setting& setting, const Arc& a) {
  return relative_error(polynomial_derivative(lobatto, setting.nodes) * a.value, a);
}

struct Sample {
  double shape;
  std::optional<double> inverse, solve;
  Exact exact;
};

struct Study {
  Setting setting;
  double flat;
  Sample dissertation;
  std::vector<Sample> scan;
};

/// @param by_algebra with 50 digits as well
Sample sample(const Setting& setting, const Arc& a, double shape, bool by_algebra = true) {
  return {shape, error_in_double(setting, a, shape, Inversion::inverse),
          error_in_double(setting, a, shape, Inversion::solve),
          by_algebra ? exact(setting, a, shape) : Exact{}};
}

std::vector<Study> studies(bool quick) {
  std::vector<Study> all;
  for (const Setting& setting : settings) {
    const Arc a = arc(setting);
    Study study{setting, flat_limit(setting, a), sample(setting, a, setting.shape), {}};
    const int count = quick ? 12 : 96;
    bool reached = true;  // by 50 digits: the flatter the functions, the worse their condition
    for (int i = count; i >= 0; --i) {
      study.scan.push_back(sample(setting, a, 0.05 * std::pow(30 / 0.05, double(i) / count), reached));
      reached = study.scan.back().exact.error.has_value();
    }
    std::reverse(study.scan.begin(), study.scan.end());
    all.push_back(std::move(study));
  }
  return all;
}

/// The least error of the solved D in the scan.
const Sample& best(const Study& study) {
  return *std::min_element(study.scan.begin(), study.scan.end(), [](const Sample& a, const Sample& b) {
    return a.solve.value_or(HUGE_VAL) < b.solve.value_or(HUGE_VAL);
  });
}

scene::Table table_of(const std::vector<Study>& all) {
  scene::Table table({{"N"},
                      {"h (P)", 2},
                      {"c h of the dissertation", 4},
                      {"condition"},
                      {"error, inverse"},
                      {"error, solve"},
                      {"error, 50 digits"},
                      {"least error, solve"},
                      {"at c h"},
                      {"error, polynomials"}});
  for (const Study& study : all) {
    const Sample &given = study.dissertation, &least = best(study);
    table.add({std::int64_t(study.setting.nodes), study.setting.periods, given.shape,
               scene::to_cell(given.exact.condition), scene::to_cell(given.inverse),
               scene::to_cell(given.solve), scene::to_cell(given.exact.error), scene::to_cell(least.solve),
               least.shape, study.flat});
  }
  return table;
}

scene::Table data_of(const std::vector<Study>& all) {
  scene::Table data({{"nodes", 3, true},
                     {"shape"},
                     {"inverse"},
                     {"solve"},
                     {"exact"},
                     {"flat"},
                     {"condition"},
                     {"dissertation_shape"}});
  for (const Study& study : all) {
    for (const Sample& s : study.scan)
      data.add({std::int64_t(study.setting.nodes), s.shape, scene::to_cell(s.inverse),
                scene::to_cell(s.solve), scene::to_cell(s.exact.error), study.flat,
                scene::to_cell(s.exact.condition), study.setting.shape});
  }
  return data;
}

/// Errors and condition at shapes where they were found independently before.
std::vector<scene::Quantity> quantities(const std::vector<Study>& all) {
  constexpr double two_digits = 0.06;
  const char* independent = "found independently with 60 digits; printed with two";
  std::vector<scene::Quantity> list;
  constexpr std::array flat = {1.9e-6, 2.0e-5, 3.6e-8};
  for (std::size_t i = 0; i < flat.size(); ++i) {
    list.push_back(scene::near(fmt::format("error of polynomials, N = {}", all[i].setting.nodes), "1",
                               all[i].flat, flat[i], two_digits, independent));
  }
  struct Known {
    std::size_t setting;
    double shape, error;
  };
  for (const Known& k :
       {Known{0, 0.05, 1.8e-6}, Known{0, 0.367, 9.9e-7}, Known{0, 1, 8.7e-4}, Known{0, 2, 3.9e-2},
        Known{1, 2, 1.9e-6}, Known{1, 4, 2.4e-4}, Known{2, 4, 2.1e-9}, Known{2, 6, 5.4e-9},
        Known{2, 8.5, 5.9e-5}, Known{2, 12, 3.9e-3}, Known{3, 14.75, 3.1e-5}}) {
    const Setting& s = settings[k.setting];
    const double error = exact(s, arc(s), k.shape).error.value_or(NAN);
    list.push_back(scene::near(fmt::format("error with 50 digits, N = {}, c h = {}", s.nodes, k.shape), "1",
                               error, k.error, two_digits, independent));
  }
  list.push_back(scene::near("condition, N = 7, c h = 0.37", "1",
                             exact(settings[0], arc(settings[0]), 0.37).condition.value_or(NAN), 8.6e12, 0.01,
                             "found independently; printed with two digits"));
  list.push_back(scene::near("error by solving, N = 35, c h = 8.5", "1",
                             all[2].dissertation.solve.value_or(NAN), 6.1e-5, 0.25,
                             "found independently; truncation 5.9e-5 and rounding"));
  return list;
}

scene::Showing show(const std::vector<Study>& all) {
  scene::Showing showing;
  showing.table = table_of(all);
  showing.figure = {data_of(all),
                    "rbf_ivp-conditioning",
                    {{"heading", "Rounding from the left, truncation from the right: 1e-7 is left between"},
                     {"height", "660"}}};
  showing.quantities = quantities(all);
  return showing;
}

}  // namespace

void add_conditioning(scene::Chapter& chapter) {
  const auto& scans = chapter.add_run<std::vector<Study>>(
      "differentiation-against-shape",
      "Gaussians at Legendre-Gauss-Lobatto nodes on an arc of the free Duffing oscillator from t = 1.1 s; "
      "largest error at a node relative to the largest derivative",
      {}, [](Workshop& w) { return studies(w.quick()); });
  chapter.add({.name = "conditioning",
               .title = "Error of the differentiation matrix and condition of its basis against the shape",
               .place = "our own",
               .needs = {&scans},
               .seconds = 4,
               .show = [&scans](Workshop& w) { return show(w.result(scans)); }});
}

}  // namespace nlmech::chapters
