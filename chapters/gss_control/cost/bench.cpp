/// @file
/// `gss_control_bench`: theta/u and y(x)/u at one frequency, exact, by ten assumed modes dense and
/// diagonalised and by finite elements, by Google Benchmark. Writes results/bench/gss_control.json under the
/// current folder; exit code 1 if a claim is not held.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <functional>
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

/// Both transfer functions at a thousand frequencies, 0.1 to 10 000 rad/s.
struct Work {
  std::string name;
  std::function<bool()> run;
};

constexpr int frequencies = 1000;
constexpr double place = 2;

std::vector<double> grid() {
  std::vector<double> omega;
  for (int i = 0; i < frequencies; ++i) omega.push_back(0.1 * std::pow(1e5, i / (frequencies - 1.)));
  return omega;
}

/// @param at gives a Response or an AxisResponse for a number omega
template <class At>
Work sweep(const std::string& name, const At& at) {
  return {name, [at, omega = grid()] {
            double sum = 0;
            for (const double w : omega) {
              const auto r = at(w);
              sum += std::abs(r.theta) + std::abs(r.deflection);
            }
            benchmark::DoNotOptimize(sum);
            return std::isfinite(sum);
          }};
}

std::vector<Work> all_work() {
  const Plant plant(table_3_1());
  const DiscreteModel ten = assumed_modes(table_3_1(), 10);
  const auto dense = std::make_shared<DenseResponse>(ten, place);
  const auto elements = std::make_shared<DenseResponse>(finite_elements(table_3_1(), 10), place);
  const auto modal = std::make_shared<ModalResponse>(diagonalise(ten), place);
  const auto eighty = std::make_shared<ModalResponse>(diagonalise(assumed_modes(table_3_1(), 80)), place);
  return {sweep("exact, on the axis", [plant](double w) { return plant.at_frequency(w, place); }),
          sweep("exact, in the plane",
                [plant](double w) {
                  return plant.response({-0.01 * w, w}, place);
                }),
          sweep("10 assumed modes, dense, on the axis", [dense](double w) { return dense->at_frequency(w); }),
          sweep("10 assumed modes, dense, in the plane",
                [dense](double w) {
                  return dense->response({-0.01 * w, w});
                }),
          sweep("10 assumed modes, diagonalised, on the axis",
                [modal](double w) { return modal->at_frequency(w); }),
          sweep("10 assumed modes, diagonalised, in the plane",
                [modal](double w) {
                  return modal->response({-0.01 * w, w});
                }),
          sweep("80 assumed modes, diagonalised, on the axis",
                [eighty](double w) { return eighty->at_frequency(w); }),
          sweep("10 finite elements, dense, on the axis",
                [elements](double w) { return elements->at_frequency(w); })};
}

int bench(int argc, char** argv) {
  chapters::begin_speed(argc, argv);
  const std::vector<Work> all = all_work();
  for (const Work& w : all) {
    if (!w.run()) throw Failure(w.name + " fails");
  }
  // A microsecond a frequency to compare with, so that this promise is a ratio as the others.
  std::vector<scene::BenchSeries> series = chapters::measure_speed(all);
  series.push_back({"one microsecond a frequency", "us a run", std::vector<double>(11, frequencies)});
  const std::string axis = "exact, on the axis", plane = "exact, in the plane";
  const std::vector<scene::SpeedClaim> claims = {
      {"theta/u and y/u at most a microsecond a frequency, on the axis", axis, "one microsecond a frequency",
       1},
      {"theta/u and y/u at most a microsecond a frequency, in the plane", plane,
       "one microsecond a frequency", 1},
      {"exact against ten assumed modes dense, on the axis", axis, "10 assumed modes, dense, on the axis", 5},
      {"exact against ten assumed modes dense, in the plane", plane, "10 assumed modes, dense, in the plane",
       5},
      // The diagonalised form is a sum of ten fractions: faster than the exact one, with its truncation
      // error.
      {"exact against ten assumed modes diagonalised, on the axis", axis,
       "10 assumed modes, diagonalised, on the axis", 0.02},
      {"exact against ten assumed modes diagonalised, in the plane", plane,
       "10 assumed modes, diagonalised, in the plane", 0.2}};
  return chapters::judge_speed("gss_control", claims, series);
}

}  // namespace

int main(int argc, char** argv) {
  return nlmech::chapters::speed_main("gss_control_bench", &bench, argc, argv);
}
