#include "nlmech/collocation/radial/kernels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/stability/extended.hpp"
#include "nlmech/scene/scene.hpp"

namespace nlmech::chapters::rbf_ivp::kernels {
namespace {

using collocation::Kernel;
using collocation::phi;
using collocation::phi_dot;

constexpr double ulp = std::numeric_limits<double>::epsilon();

/// A function with what its closed form gives at c r = 1.
struct Function {
  Kernel kernel;
  const char *label, *name;
  double at_one, within;

  [[nodiscard]] std::string word() const { return std::string(to_string(kernel)); }
  [[nodiscard]] double value_at_1() const { return phi(kernel, 1.0, 1.0); }
  [[nodiscard]] double slope_at_1() const { return phi_dot(kernel, 1.0, 1.0); }
  [[nodiscard]] double value_at_10() const { return phi(kernel, 1.0, 10.0); }
};
const std::array functions = {
    Function{Kernel::gaussian, "Gaussian exp(−{/:Italic c}^2{/:Italic r}^2)", "Gaussian", std::exp(-1.0),
             ulp},
    Function{Kernel::inverse_quadratic, "inverse quadratic 1/(1 + {/:Italic c}^2{/:Italic r}^2)",
             "inverse quadratic", 0.5, ulp},
    Function{Kernel::multiquadric, "multiquadric (1 + {/:Italic c}^2{/:Italic r}^2)^{1/2}", "multiquadric",
             std::sqrt(2.0), ulp},
    Function{Kernel::inverse_multiquadric, "inverse multiquadric (1 + {/:Italic c}^2{/:Italic r}^2)^{−1/2}",
             "inverse multiquadric", std::sqrt(0.5), 2 * ulp}};

/// Largest error of phi and of its derivative among the distances, in units of the last place of the greatest
/// value.
double largest_error(Kernel kernel, const std::vector<double>& distances) {
  double error = 0, slope_error = 0, scale = 0, slope_scale = 0;
  for (const double r : distances) {
    const Digits50 value = phi(kernel, Digits50(1), Digits50(r)),
                   slope = phi_dot(kernel, Digits50(1), Digits50(r));
    error = std::max(error, static_cast<double>(abs(phi(kernel, 1.0, r) - value)));
    slope_error = std::max(slope_error, static_cast<double>(abs(phi_dot(kernel, 1.0, r) - slope)));
    scale = std::max(scale, static_cast<double>(abs(value)));
    slope_scale = std::max(slope_scale, static_cast<double>(abs(slope)));
  }
  return std::max(error / scale, slope_error / slope_scale) / ulp;
}

void draw(const std::vector<double>& distances, scene::Show& show) {
  scene::Plot& plot = show.plots("Three radial functions decay; the multiquadric grows");
  scene::Table data({{"kernel", 3, true}, {"distance"}, {"value"}, {"derivative"}});
  scene::Panel& value = plot.panel("{/:Italic c r}", "φ").place(0.10, 0.49, 0.13, 0.76);
  scene::Panel& slope = plot.panel("{/:Italic c r}", "φ'/{/:Italic c}").place(0.58, 0.98, 0.13, 0.76);
  value.x_range(-4, 4).y_range(0, 4.2).set("xtics 2").set("ytics 1").set("ylabel norotate offset 1,0");
  value.key("at screen 0.52, screen 0.92 center top maxrows 2 samplen 3 width -6");
  slope.x_range(-4, 4).y_range(-1.1, 1.1).set("xtics 2").set("ytics 0.5").key("off");
  slope.set("ylabel norotate offset 1,0");
  for (int i = 0; const Function& f : functions) {
    for (const double r : distances)
      data.add({f.word(), r, phi(f.kernel, 1.0, r), phi_dot(f.kernel, 1.0, r)});
    value.columns(f.label, "distance:value", scene::lines(), i);
    slope.columns("", "distance:derivative", scene::lines(), i++);
  }
  plot.data(std::move(data));
}

void put(scene::Show& show) {
  std::vector<double> distances;
  for (int i = -160; i <= 160; ++i) distances.push_back(i / 40.0);
  draw(distances, show);
  show.table(functions, {{"kernel", &Function::word},
                         {"at c r = 1", &Function::value_at_1},
                         {"derivative there (c)", &Function::slope_at_1},
                         {"at c r = 10", &Function::value_at_10}});
  double worst = 0;
  for (const Function& f : functions) {
    worst = std::max(worst, largest_error(f.kernel, distances));
    show.near(std::string(f.name) + " at c r = 1", f.value_at_1(), f.at_one, f.within,
              "closed form; one rounding");
  }
  show.at_most("largest error of the functions and their derivatives", {worst, "ulp of the greatest value"},
               4, "against the same formulas with 50 digits; as their documentation states");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  return {{.name = "kernels",
           .title = "The four radial functions of Eq. 4.8 and their derivatives",
           .content = scene::Content(put)}};
}

}  // namespace nlmech::chapters::rbf_ivp::kernels
