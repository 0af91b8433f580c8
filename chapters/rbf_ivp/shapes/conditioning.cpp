/// What rounding and truncation make of the derivative of an arc by Gaussians, against their shape.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "chapters/rbf_ivp/shapes/arcs.hpp"
#include "nlmech/collocation/differentiation.hpp"
#include "nlmech/collocation/radial/radial_basis.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::conditioning {
namespace {

using collocation::Inversion;
using collocation::Kernel;

constexpr auto lobatto = collocation::NodeFamily::legendre_gauss_lobatto;

/// So many nodes on so many periods of the free Duffing oscillator, and the shape c h of the dissertation.
struct Setting {
  int nodes;
  double periods, shape;
  const char* step;  ///< in words
};
constexpr std::array settings = {Setting{7, 0.1, 0.367, "P/10"}, Setting{15, 0.5, 3.5, "P/2"},
                                 Setting{35, 1, 8.5, "P"}, Setting{60, 1, 14.75, "P"}};

/// D f with 50 digits, and the condition of Phi; nothing where 50 digits do not reach.
struct Exact {
  std::optional<double> error;      ///< largest at a node, relative to the largest derivative
  std::optional<double> condition;  ///< 2-norm
};

/// Errors at one shape.
struct Sample {
  double shape;                           ///< c h
  std::optional<double> inverse, solved;  ///< in double, D by the inverse and by solving, if there is one
  Exact exact;                            ///< with 50 digits
};

/// All shapes of one setting.
struct Study {
  Setting setting;
  double flat;               ///< error of polynomials
  Sample dissertation;       ///< at the dissertation's shape
  std::vector<Sample> scan;  ///< shapes ascending

  [[nodiscard]] int nodes() const { return setting.nodes; }
  [[nodiscard]] double periods() const { return setting.periods; }
  [[nodiscard]] double shape() const { return dissertation.shape; }
  [[nodiscard]] std::optional<double> condition() const { return dissertation.exact.condition; }
  [[nodiscard]] std::optional<double> inverse() const { return dissertation.inverse; }
  [[nodiscard]] std::optional<double> solved() const { return dissertation.solved; }
  [[nodiscard]] std::optional<double> exact() const { return dissertation.exact.error; }
  /// The least error of the solved D in the scan.
  [[nodiscard]] const Sample& best() const {
    return *std::ranges::min_element(scan, {}, [](const Sample& s) { return s.solved.value_or(HUGE_VAL); });
  }
  [[nodiscard]] std::optional<double> least() const { return best().solved; }
  [[nodiscard]] double best_shape() const { return best().shape; }
};

Arc50 arc_of(const Setting& setting) { return exact_duffing_arc(setting.nodes, setting.periods); }

/// max |found - slope| / max |slope|.
double relative_error(const Column50& found, const Arc50& a) {
  return static_cast<double>(
      Digits50((found - a.slopes).cwiseAbs().maxCoeff() / a.slopes.cwiseAbs().maxCoeff()));
}

/// Error of D f in double, nothing if there is no D.
std::optional<double> error_in_double(const Setting& setting, const Arc50& a, double shape,
                                      Inversion inversion) {
  const Eigen::VectorXd nodes = (collocation::nodes(lobatto, setting.nodes).array() + 1) / 2;
  const auto d = collocation::radial_differentiation(nodes, Kernel::gaussian, shape, inversion);
  if (d.matrix.size() == 0) return std::nullopt;
  const Eigen::VectorXd slope = d.matrix * a.values.cast<double>();
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

Exact exact(const Arc50& a, double shape) {
  const collocation::RadialBasis<Digits50> basis(a.nodes, Kernel::gaussian, Digits50(shape));
  const Eigen::PartialPivLU<collocation::Matrix<Digits50>> lu(basis.values());
  const double kappa = condition(basis.values(), lu);
  if (!(kappa < 1e34)) return {};  // 50 digits less these leave 16 for the error
  const Column50 weights = lu.solve(a.values);
  return {relative_error(basis.derivatives() * weights, a), kappa};
}

/// @param by_algebra with 50 digits as well
Sample sample(const Setting& setting, const Arc50& a, double shape, bool by_algebra = true) {
  return {shape, error_in_double(setting, a, shape, Inversion::inverse),
          error_in_double(setting, a, shape, Inversion::solve), by_algebra ? exact(a, shape) : Exact{}};
}

std::vector<Study> studies(bool quick) {
  std::vector<Study> all;
  for (const Setting& setting : settings) {
    const Arc50 a = arc_of(setting);
    const double flat = relative_error(polynomial_derivative(lobatto, setting.nodes) * a.values, a);
    Study study{setting, flat, sample(setting, a, setting.shape), {}};
    const int count = quick ? 12 : 96;
    bool reached = true;  // by 50 digits: the flatter the functions, the worse their condition
    for (int i = count; i >= 0; --i) {
      study.scan.push_back(sample(setting, a, 0.05 * std::pow(30 / 0.05, double(i) / count), reached));
      reached = study.scan.back().exact.error.has_value();
    }
    std::ranges::reverse(study.scan);
    all.push_back(std::move(study));
  }
  return all;
}

/// Errors above, and the condition below them.
void draw_setting(const Setting& setting, int i, scene::Plot& plot) {
  const double left = 0.12 + i * 0.22;
  const auto part = [&](const char* x_label, const char* y_label) -> scene::Panel& {
    scene::Panel& panel = plot.panel(x_label, i == 0 ? y_label : "");
    return panel.log_x(0.05, 30).set("xtics (0.1, 1, 10)").set("format x '%g'").set("mytics 1");
  };
  const auto capped = [](const std::string& name) {
    return fmt::format("shape:(column('{0}') > 1e3 ? 1e3 : column('{0}'))", name);
  };
  scene::Panel& error = part("", "error of D f");
  error.place(left, left + 0.202, 0.40, 0.81)
      .caption(fmt::format("N = {}, h = {}", setting.nodes, setting.step));
  error.log_y(1e-15, 1e3).set("ytics 1e3").set("format x ''");
  error.columns("inverse", capped("inverse"), {"lines dashtype 1 linewidth 1", 5}, i)
      .columns("solved by LU", capped("solve"), {"lines linewidth 1.5", 1}, i)
      .columns("50 digits", "shape:exact", {"lines linewidth 2.5", 2}, i)
      .columns("polynomials", "shape:flat", scene::lines(3), i)
      .also("keyentry with lines linestyle 11 title 'dissertation'");
  error.set(fmt::format("arrow 1 from {0:g}, graph 0 to {0:g}, graph 1 nohead linestyle 11", setting.shape));
  error.key(i == 0 ? "at screen 0.53, screen 0.945 center top maxrows 2 samplen 3 spacing 1.1" : "off");
  scene::Panel& condition = part("{/:Italic c h}", "condition");
  condition.place(left, left + 0.202, 0.11, 0.36).log_y(1, 1e34).set("ytics 1e8").key("off");
  condition.set(
      fmt::format("arrow 1 from {0:g}, graph 0 to {0:g}, graph 1 nohead linestyle 11", setting.shape));
  condition.set("arrow 2 from graph 0, first 4.5e15 to graph 1, first 4.5e15 nohead linestyle 13");
  if (i == 0) condition.set("label 3 '1/eps' at 0.06, 4.5e15 left offset 0,-0.7 textcolor rgb soft_ink");
  condition.columns("", "shape:condition", scene::lines(1), i);
  if (i > 0) {
    error.set("format y ''");
    condition.set("format y ''");
  }
}

void draw(const std::vector<Study>& all, scene::Show& show) {
  scene::Plot& plot = show.plots("Rounding from the left, truncation from the right");
  scene::Table data({{"nodes", 3, true},
                     {"shape"},
                     {"inverse"},
                     {"solve"},
                     {"exact"},
                     {"flat"},
                     {"condition"},
                     {"dissertation_shape"}});
  for (int i = 0; const Study& study : all) {
    for (const Sample& s : study.scan)
      data.add({study.setting.nodes, s.shape, s.inverse, s.solved, s.exact.error, study.flat,
                s.exact.condition, study.setting.shape});
    draw_setting(study.setting, i++, plot);
  }
  plot.size(760, 660).data(std::move(data));
}

void check(const std::vector<Study>& all, scene::Show& show) {
  // oracle: rbf_ivp_shapes N = ? polynomials, N = 15 polynomials, N = 35 polynomials, N = 7 c h = 0.05, N = 7
  // c h = 0.367, N = 7 c h = 1, N = 7 c h = 2, N = 15 c h = 2, N = 15 c h = 4, N = 35 c h = 4, N = 35 c h =
  // 6, N = 35 c h = 8.5, N = 35 c h = 12, N = 60 c h = 14.75
  constexpr double three_digits = 0.01;
  const char* program = "tools/oracles/rbf_ivp_shapes.py, three digits";
  constexpr std::array flat = {1.89e-6, 2.04e-5, 3.65e-8};
  for (std::size_t i = 0; i < flat.size(); ++i) {
    show.near(fmt::format("error of polynomials, N = {}", all[i].nodes()), all[i].flat, flat[i], three_digits,
              program);
  }
  struct Known {
    std::size_t setting;
    double shape, error;
  };
  for (const Known& k :
       {Known{0, 0.05, 1.84e-6}, Known{0, 0.367, 9.99e-7}, Known{0, 1, 8.71e-4}, Known{0, 2, 3.90e-2},
        Known{1, 2, 1.81e-6}, Known{1, 4, 2.37e-4}, Known{2, 4, 2.05e-9}, Known{2, 6, 5.44e-9},
        Known{2, 8.5, 5.90e-5}, Known{2, 12, 3.89e-3}, Known{3, 14.75, 3.09e-5}}) {
    const Setting& s = settings[k.setting];
    show.near(fmt::format("error with 50 digits, N = {}, c h = {}", s.nodes, k.shape),
              exact(arc_of(s), k.shape).error.value_or(NAN), k.error, three_digits, program);
  }
  show.near("condition, N = 7, c h = 0.37", exact(arc_of(settings[0]), 0.37).condition.value_or(NAN), 8.6e12,
            0.01, "recorded, two digits");
  show.near("error by solving, N = 35, c h = 8.5", all[2].solved().value_or(NAN), 6.1e-5, 0.25,
            "recorded: truncation 5.9e-5 and rounding");
}

void put(const std::vector<Study>& all, scene::Show& show) {
  draw(all, show);
  show.table(all, {{"N", &Study::nodes},
                   {"h (P)", &Study::periods, 2},
                   {"c h of the dissertation", &Study::shape, 4},
                   {"condition", &Study::condition},
                   {"error, inverse", &Study::inverse},
                   {"error, solve", &Study::solved},
                   {"error, 50 digits", &Study::exact},
                   {"least error, solve", &Study::least},
                   {"at c h", &Study::best_shape},
                   {"error, polynomials", &Study::flat}});
  check(all, show);
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result scans(
      "differentiation-against-shape",
      "Gaussians at Legendre-Gauss-Lobatto nodes on an arc of the free Duffing oscillator from t = 1.1 s; "
      "largest error at a node relative to the largest derivative",
      studies);
  return {{.name = "conditioning",
           .title = "Error of the differentiation matrix and condition of its basis against the shape",
           .content = scene::Content(put, scans)}};
}

}  // namespace nlmech::chapters::rbf_ivp::conditioning
