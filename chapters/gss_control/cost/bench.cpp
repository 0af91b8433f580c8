/// @file
/// `gss_control_bench`: theta/u and y(x)/u at one frequency, exact, by ten assumed modes dense and
/// diagonalised and by finite elements, by Google Benchmark. Exit code 1 if a claim fails.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "chapters/speed.hpp"
#include "nlmech/spacecraft/plant/discrete_model.hpp"
#include "nlmech/spacecraft/plant/plant.hpp"
#include "nlmech/support/errors.hpp"

namespace {

using namespace nlmech;
using namespace nlmech::spacecraft;

constexpr int frequencies = 1000;
constexpr double place = 2;

std::vector<double> grid() {
  std::vector<double> omega;
  for (int i = 0; i < frequencies; ++i) omega.push_back(0.1 * std::pow(1e5, i / (frequencies - 1.)));
  return omega;
}

/// Both transfer functions at a thousand frequencies, 0.1 to 10 000 rad/s.
/// @param at function of omega that returns a Response or an AxisResponse
template <class At>
void add_sweep(chapters::Speed& all, const std::string& name, const At& at) {
  const auto sweep = [at, omega = grid()] {
    double sum = 0;
    for (const double w : omega) {
      const auto r = at(w);
      sum += std::abs(r.theta) + std::abs(r.deflection);
    }
    return sum;
  };
  if (!std::isfinite(sweep())) throw Failure(name + " fails");
  all.add(name, sweep);
}

/// On the imaginary axis, and to the left of it.
template <class Model>
void add_model(chapters::Speed& all, const std::string& name, const Model& model) {
  const auto shared = std::make_shared<Model>(model);
  add_sweep(all, name + ", on the axis", [shared](double w) { return shared->at_frequency(w); });
  add_sweep(all, name + ", in the plane", [shared](double w) { return shared->response({-0.01 * w, w}); });
}

/// Exact plant with the interface of the models.
struct Exact {
  Plant plant{table_3_1()};
  [[nodiscard]] auto at_frequency(double w) const { return plant.at_frequency(w, place); }
  [[nodiscard]] auto response(Complex s) const { return plant.response(s, place); }
};

void rows(chapters::Speed& all) {
  const std::string axis = ", on the axis", plane = ", in the plane", budget = "one microsecond a frequency";
  const std::string dense = "10 assumed modes, dense", diagonal = "10 assumed modes, diagonalised";
  const DiscreteModel ten = assumed_modes(table_3_1(), 10);
  add_model(all, "exact", Exact{});
  add_model(all, dense, DenseResponse(ten, place));
  add_model(all, diagonal, ModalResponse(diagonalise(ten), place));
  add_sweep(all, "80 assumed modes, diagonalised" + axis,
            [eighty = ModalResponse(diagonalise(assumed_modes(table_3_1(), 80)), place)](double w) {
              return eighty.at_frequency(w);
            });
  const auto elements = std::make_shared<DenseResponse>(finite_elements(table_3_1(), 10), place);
  add_sweep(all, "10 finite elements, dense" + axis,
            [elements](double w) { return elements->at_frequency(w); });
  all.add_budget(budget, frequencies);
  for (const std::string& where : {axis, plane}) {
    all.claim("exact" + where, budget, 1, "theta/u and y/u at most a microsecond a frequency" + where);
    all.claim("exact" + where, dense + where, 5, "exact against ten assumed modes dense" + where);
    // The diagonalised form is a sum of ten fractions: faster than the exact form, but with a truncation
    // error.
    all.claim("exact" + where, diagonal + where, where == axis ? 0.02 : 0.2,
              "exact against ten assumed modes diagonalised" + where);
  }
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("gss_control", &rows, argc, argv); }
