#include "nlmech/collocation/kernels.hpp"

#include <array>
#include <cmath>
#include <string>

#include "chapters/rbf_ivp/scenes.hpp"
#include "chapters/rbf_ivp/stability/extended.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using collocation::Kernel;

constexpr std::array kernels = {Kernel::gaussian, Kernel::inverse_quadratic, Kernel::multiquadric,
                                Kernel::inverse_multiquadric};

/// Largest error of phi and of its derivative among the distances, in units of the last place of the greatest
/// value.
double largest_error(Kernel kernel, const std::vector<double>& distances) {
  double error = 0, slope_error = 0, scale = 0, slope_scale = 0;
  for (const double r : distances) {
    const Digits50 value = collocation::phi(kernel, Digits50(1), Digits50(r)),
                   slope = collocation::phi_dot(kernel, Digits50(1), Digits50(r));
    error = std::max(error, static_cast<double>(abs(collocation::phi(kernel, 1.0, r) - value)));
    slope_error =
        std::max(slope_error, static_cast<double>(abs(collocation::phi_dot(kernel, 1.0, r) - slope)));
    scale = std::max(scale, static_cast<double>(abs(value)));
    slope_scale = std::max(slope_scale, static_cast<double>(abs(slope)));
  }
  return std::max(error / scale, slope_error / slope_scale) / std::numeric_limits<double>::epsilon();
}

scene::Showing show() {
  scene::Table data({{"kernel", 3, true}, {"distance"}, {"value"}, {"derivative"}});
  scene::Table table({{"kernel"}, {"at c r = 1"}, {"derivative there (c)"}, {"at c r = 10"}});
  std::vector<double> distances;
  for (int i = -160; i <= 160; ++i) distances.push_back(i / 40.0);
  double worst = 0;
  for (const Kernel kernel : kernels) {
    const std::string name(to_string(kernel));
    for (const double r : distances)
      data.add({name, r, collocation::phi(kernel, 1.0, r), collocation::phi_dot(kernel, 1.0, r)});
    table.add({name, collocation::phi(kernel, 1.0, 1.0), collocation::phi_dot(kernel, 1.0, 1.0),
               collocation::phi(kernel, 1.0, 10.0)});
    worst = std::max(worst, largest_error(kernel, distances));
  }
  scene::Showing showing;
  showing.table = std::move(table);
  showing.figure = {std::move(data),
                    "rbf_ivp-kernels",
                    {{"heading", "Three of the four radial functions decay; the multiquadric grows"}}};
  const char* closed = "closed form; one rounding";
  constexpr double ulp = std::numeric_limits<double>::epsilon();
  showing.quantities = {
      scene::near("Gaussian at c r = 1", "1", collocation::phi(Kernel::gaussian, 1.0, 1.0), std::exp(-1.0),
                  ulp, closed),
      scene::near("inverse quadratic at c r = 1", "1", collocation::phi(Kernel::inverse_quadratic, 1.0, 1.0),
                  0.5, ulp, closed),
      scene::near("multiquadric at c r = 1", "1", collocation::phi(Kernel::multiquadric, 1.0, 1.0),
                  std::sqrt(2.0), ulp, closed),
      scene::near("inverse multiquadric at c r = 1", "1",
                  collocation::phi(Kernel::inverse_multiquadric, 1.0, 1.0), std::sqrt(0.5), 2 * ulp, closed),
      scene::at_most("largest error of the functions and their derivatives", "ulp of the greatest value",
                     worst, 4, "against the same formulas with 50 digits; as their documentation states"),
  };
  return showing;
}

}  // namespace

void add_kernels(scene::Chapter& chapter) {
  chapter.add({.name = "kernels",
               .title = "The four radial functions of Eq. 4.8 and their derivatives",
               .place = "our own",
               .needs = {},
               .show = [](scene::Workshop&) { return show(); }});
}

}  // namespace nlmech::chapters::rbf_ivp
