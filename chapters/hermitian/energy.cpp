#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nlmech/ivp/hermitian/hermitian.hpp"
#include "nlmech/problems/duffing.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::hermitian::energy {
namespace {

constexpr double step = 0.2, end = 2000;
constexpr int windows = 400;

/// Energy errors of the free Duffing oscillator for one pair of operators.
struct Energy {
  std::string row;
  std::vector<double> worst;  ///< largest |E/E0 - 1| in each of `windows` equal time intervals
  double determinant;         ///< determinant of the Jacobian of one step, minus 1
};

// Jacobian of one step by central differences, accurate to some 1e-10.
double determinant_less_one(const ivp::System& system, const ivp::Hermitian& method) {
  constexpr double d = 1e-5;
  Eigen::Matrix2d map;
  for (int i = 0; i < 2; ++i) {
    ivp::State ahead{1, 0.3}, behind = ahead;
    ahead[i] += d;
    behind[i] -= d;
    map.col(i) = (ivp::integrate(system, ahead, 0, step, method).x -
                  ivp::integrate(system, behind, 0, step, method).x) /
                 (2 * d);
  }
  return map(0, 0) * map(1, 1) - map(0, 1) * map(1, 0) - 1;
}

Energy energy_of(const ivp::HermitianPair& pair) {
  const problems::Duffing problem;
  const ivp::System system(problem.text());
  const ivp::State x0{1, 0.3};
  const double at_first = problem.energy(x0);
  const ivp::Hermitian method{.operators = pair, .step = step};
  Energy e{std::string(pair.name), std::vector<double>(windows), determinant_less_one(system, method)};
  const auto look = [&](const ivp::Step& s) {
    const auto window = static_cast<std::size_t>(std::min(windows - 1.0, s.t1 / end * windows));
    e.worst[window] = std::max(e.worst[window], std::abs(problem.energy(s.x1) / at_first - 1));
    return true;
  };
  const auto run = ivp::integrate(system, x0, 0, end, method, look);
  if (!run.status.ok()) throw Failure(run.status);
  return e;
}

std::vector<Energy> energies() {
  return {energy_of(ivp::laier), energy_of(ivp::argyris), energy_of(ivp::newmark_pair)};
}

void draw(const std::vector<Energy>& all, scene::Show& show) {
  scene::Table data({{"t"}, {"laier"}, {"argyris"}, {"newmark"}});
  for (std::size_t i = 0; i < windows; ++i)
    data.add(
        {(static_cast<double>(i) + 0.5) * end / windows, all[0].worst[i], all[1].worst[i], all[2].worst[i]});
  show.plot("Energy error of symmetric operators: bounded to t = 2000", "time (s)",
            "greatest |{/:Italic E}/{/:Italic E}_0 − 1| in 5 s")
      .log_y(1e-5, 1)
      .columns("Newmark, Hoff, Bazzi", "t:newmark", {"lines dashtype 1", 3})
      .columns("Laier", "t:laier", scene::lines(1))
      .columns("Argyris", "t:argyris", scene::lines(5));
  show.figure().data(std::move(data));
}

void put(const std::vector<Energy>& all, scene::Show& show) {
  draw(all, show);
  show.table(all, {{"operators", &Energy::row},
                   {"greatest energy error", [](const Energy& e) { return std::ranges::max(e.worst); }},
                   {"determinant of a step - 1", &Energy::determinant, 2}});
  for (const Energy& e : all) {
    const auto middle = e.worst.begin() + windows / 2;
    show.near("energy error of " + e.row + ", second half over first",
              *std::max_element(middle, e.worst.end()) / *std::max_element(e.worst.begin(), middle), 1, 0.02,
              "a symmetric step on a reversible problem: no drift");
  }
  show.between("determinant of a step of Laier, minus 1", all[0].determinant, -1e-3, -1e-7,
               "not symplectic; the differences are good to 1e-9");
}

}  // namespace

std::vector<scene::Scene> scenes() {
  const scene::Result result("energies", "x'' + x + x^3 = 0 from (1, 0.3), step 0.2, to t = 2000", energies);
  return {{.name = "energy",
           .title = "Energy of a free Duffing oscillator over 2000 units of time",
           .content = scene::Content(put, result)}};
}

}  // namespace nlmech::chapters::hermitian::energy
