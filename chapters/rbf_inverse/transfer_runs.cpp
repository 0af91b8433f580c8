#include "chapters/rbf_inverse/transfer_runs.hpp"

#include <limits>

#include "nlmech/orbit/kepler.hpp"

namespace nlmech::chapters {

using scene::Workshop;

orbit::TransferProblem printed_transfer() {
  return {{2.87e6, 5.19e6, 2.85e6}, {2.09e6, 7.82e6, 0}, 4320, {.mu = 3.986e14}};
}

double velocity_error(const orbit::Vector3<double>& v1) {
  return (v1 - orbit::Vector3<double>(2774.8469906025419, 7217.0230343355381, 1625.9338905977957)).norm();
}

orbit::Vector3<double> miss_vector(const orbit::Vector3<double>& v1) {
  const orbit::TransferProblem p = printed_transfer();
  const auto end = orbit::propagate_kepler({p.from, v1}, p.time, p.gravity.mu);
  if (!end.status.ok()) return orbit::Vector3<double>::Constant(std::numeric_limits<double>::infinity());
  return end.state.position - p.to;
}

TransferRuns add_transfer_runs(scene::Chapter& chapter) {
  using orbit::CollocatedTransfer;
  using orbit::TransferBasis;
  orbit::TransferCollocation printed{.basis = TransferBasis::gaussian,
                                     .equations = orbit::TransferEquations::positions_and_velocities,
                                     .guess = orbit::TransferGuess::line,
                                     .length_unit = 1,
                                     .largest_miss = 0.01};
  TransferRuns runs{};
  const auto& first = chapter.add_run<CollocatedTransfer>(
      "lambert-printed",
      "47 LGL nodes, Gaussian functions with c = (N + 3)/(4 T), 6N equations, Newton's iteration from a "
      "straight line; in metres and seconds",
      {}, [printed](Workshop&) {
        orbit::TransferCollocation method = printed;
        method.time_unit = time_units.front();
        return orbit::collocate(printed_transfer(), method);
      });
  runs.as_printed = &first;
  runs.printed = &chapter.add_run<std::vector<CollocatedTransfer>>(
      "lambert-printed-units", "the same in twelve units of time, seconds first", {&first},
      [printed, &first](Workshop& w) {
        std::vector<CollocatedTransfer> all = {w.result(first)};
        for (std::size_t k = 1; k < time_units.size(); ++k) {
          orbit::TransferCollocation method = printed;
          method.time_unit = time_units[k];
          all.push_back(orbit::collocate(printed_transfer(), method));
        }
        return all;
      });
  const auto other = [&](const char* name, const char* reading, TransferBasis basis, double shape) {
    return &chapter.add_run<CollocatedTransfer>(name, reading, {}, [printed, basis, shape](Workshop&) {
      orbit::TransferCollocation method = printed;
      method.basis = basis;
      method.shape = shape;
      method.length_unit = 0;
      return orbit::collocate(printed_transfer(), method);
    });
  };
  runs.printed_shape = other("lambert-printed-shape", "the printed shape, D without cancellation",
                             TransferBasis::stable_gaussian, 0);
  runs.stable = other("lambert-stable", "Gaussian functions with c T = 3, D without cancellation",
                      TransferBasis::stable_gaussian, 3);
  runs.polynomial = other("lambert-polynomial", "polynomials, the limit c = 0", TransferBasis::polynomial, 0);
  runs.izzo = &chapter.add_run<orbit::Transfer>("lambert-izzo", "Izzo's method", {}, [](Workshop&) {
    return orbit::corrected_transfer(printed_transfer());
  });
  return runs;
}

}  // namespace nlmech::chapters
