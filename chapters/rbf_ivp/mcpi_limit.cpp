#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/collocation/integration.hpp"
#include "nlmech/ivp/picard.hpp"

namespace nlmech::chapters {
namespace {

using scene::Workshop;

constexpr std::array orders = {8, 16, 32, 100};
constexpr double standstill = 1e-12, overflow = 1e30;  // of a change: done; will not come back

/// The largest change of a state component, sweep by sweep.
using Changes = std::vector<double>;

/// Picard's iteration on the unit interval: nodes, and the matrix from right-hand sides to increments at the
/// nodes but the first.
struct Tables {
  Eigen::VectorXd nodes;
  Eigen::MatrixXd integral;
};

Tables chebyshev_tables(int order) {
  const ivp::PicardTables tables = ivp::picard_tables({.order = order});
  return {tables.nodes, tables.integral};
}

/// The same iteration with other nodes and another quadrature, to judge the first by.
Tables legendre_tables(int count) {
  const Eigen::VectorXd nodes = collocation::legendre_gauss_lobatto(count);
  return {(nodes.array() + 1) / 2, collocation::integration_matrix(nodes).bottomRows(count - 1) / 2};
}

/// Where the iteration starts.
enum class Start {
  constant,  ///< from the state at the begin of the step, as the method does
  solution   ///< from the solution, displaced by 1e-6
};

/// Iterates over a step of the free Duffing oscillator that begins at the time @p t0.
Changes sweep(const Tables& tables, double t0, double step, Start start) {
  const Case<2>& c = free_duffing_case();
  const Eigen::Index count = tables.nodes.size();
  const ivp::State<2> x0 = c.reference(t0).cast<double>();
  std::vector<double> times;
  ivp::Nodes<2> x(2, count), next(2, count), g(2, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    times.push_back(t0 + step * tables.nodes[k]);
    x.col(k) = x0;
    if (start == Start::solution && k > 0) x.col(k) = c.reference(times.back()).cast<double>().array() + 1e-6;
  }
  next.col(0) = x0;
  Changes changes;
  while (changes.size() < 1000) {
    c.system.rhs(times, x, g);
    next.rightCols(count - 1).noalias() = (step * g) * tables.integral.transpose();
    next.rightCols(count - 1).colwise() += x0;
    changes.push_back((next - x).cwiseAbs().maxCoeff());
    x.swap(next);
    if (!(changes.back() > standstill && changes.back() < overflow)) break;
  }
  return changes;
}

bool converged(const Changes& changes) { return changes.back() <= standstill; }

/// The mean ratio of successive changes on the way from the largest of them to the end.
std::optional<double> contraction(const Changes& changes) {
  if (!converged(changes)) return std::nullopt;
  const auto largest = std::max_element(changes.begin(), changes.end());
  const auto sweeps = static_cast<double>(changes.end() - largest - 1);
  return std::pow(changes.back() / *largest, 1 / sweeps);
}

/// The largest multiple of @p unit up to which every one from @p first times it on converges.
template <class Converges>
double largest_step(double unit, std::int64_t first, Converges&& converges) {
  std::int64_t k = first;
  while (converges(static_cast<double>(k) * unit)) ++k;
  return static_cast<double>(k - 1) * unit;
}

/// Largest converging steps by the phase at which they begin, in periods. The equation is odd, so that half
/// a period of phases tells all.
struct PhaseLimits {
  std::vector<double> phase, limit;

  [[nodiscard]] double least() const { return *std::min_element(limit.begin(), limit.end()); }
  [[nodiscard]] double greatest() const { return *std::max_element(limit.begin(), limit.end()); }
};

PhaseLimits limits_by_phase(const Tables& tables, int phases) {
  const double P = duffing_period();
  PhaseLimits limits;
  for (int i = 0; i <= phases; ++i) {
    limits.phase.push_back(0.5 * i / phases);
    limits.limit.push_back(largest_step(0.01, 30, [&](double periods) {
      return converged(sweep(tables, limits.phase.back() * P, periods * P, Start::constant));
    }));
  }
  return limits;
}

/// Largest steps, in seconds, with which the method comes to the end of an interval.
/// @param first half seconds of the shortest step tried
template <int n>
double limit_over_time(const Case<n>& c, int order, std::int64_t first) {
  return largest_step(0.5, first, [&](double step) {
    const ivp::Mcpi method = {.step = step, .order = order};
    return ivp::integrate(c.system, c.x0, c.t0, c.t1, method).status.ok();
  });
}

/// Steps of the free oscillator that the method makes from its initial state before one diverges, if it does
/// before the end.
std::optional<std::int64_t> steps_until_divergence(double periods, int order) {
  const Case<2>& c = free_duffing_case();
  const ivp::Mcpi method = {.step = periods * duffing_period(), .order = order};
  const auto solution = ivp::integrate(c.system, c.x0, c.t0, c.t1, method);
  if (solution.status.ok()) return std::nullopt;
  return solution.statistics.steps;
}

struct Limits {
  std::vector<PhaseLimits> duffing;          ///< by order
  PhaseLimits by_legendre;                   ///< with 120 Legendre nodes
  std::vector<double> impact, three_masses;  ///< by order
};

Limits find_limits(bool quick) {
  const int phases = quick ? 3 : 25;
  const std::int64_t first = quick ? 4 : 1;
  Limits limits{{}, limits_by_phase(legendre_tables(120), phases), {}, {}};
  for (const int order : orders) {
    limits.duffing.push_back(limits_by_phase(chebyshev_tables(order), phases));
    limits.impact.push_back(limit_over_time(impact_case(), order, first));
    limits.three_masses.push_back(limit_over_time(three_mass_case(), order, first));
  }
  return limits;
}

scene::Table table_of(const Limits& limits) {
  scene::Table table({{"order N"},
                      {"free Duffing, worst phase (P)"},
                      {"best phase (P)"},
                      {"largest change on the way at P/2"},
                      {"contraction factor at P/2"},
                      {"impact (s)"},
                      {"three masses (s)"}});
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const Tables tables = chebyshev_tables(orders[i]);
    const Changes constant = sweep(tables, 0, duffing_period() / 2, Start::constant),
                  close = sweep(tables, 0, duffing_period() / 2, Start::solution);
    table.add({std::int64_t(orders[i]), limits.duffing[i].least(), limits.duffing[i].greatest(),
               *std::max_element(constant.begin(), constant.end()), scene::to_cell(contraction(close)),
               limits.impact[i], limits.three_masses[i]});
  }
  return table;
}

/// Panels: changes by sweep; contraction factor by step; largest step by phase.
scene::Table data_of(const Limits& limits, bool quick) {
  const double P = duffing_period();
  scene::Table data({{"panel"}, {"series", 3, true}, {"abscissa"}, {"ordinate"}});
  for (const double periods : {0.3, 0.5, 0.55, 0.57, 0.6}) {
    const Changes changes = sweep(chebyshev_tables(100), 0, periods * P, Start::constant);
    for (std::size_t k = 0; k < changes.size(); ++k)
      data.add({"sweeps", periods, static_cast<double>(k + 1), changes[k]});
  }
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const Tables tables = chebyshev_tables(orders[i]);
    for (int k = 1; k <= (quick ? 20 : 80); ++k) {
      const double periods = k * (quick ? 0.1 : 0.025);
      const auto factor = contraction(sweep(tables, 0, periods * P, Start::solution));
      data.add({"factor", std::int64_t(orders[i]), periods, scene::to_cell(factor)});
    }
    const PhaseLimits& by_phase = limits.duffing[i];
    for (std::size_t k = 0; k < by_phase.phase.size(); ++k)
      data.add({"phase", std::int64_t(orders[i]), by_phase.phase[k], by_phase.limit[k]});
  }
  return data;
}

scene::Showing show(const Limits& limits, bool quick) {
  scene::Showing showing;
  showing.table = table_of(limits);
  showing.figure = {data_of(limits, quick),
                    "rbf_ivp-mcpi-limit",
                    {{"heading", "Past P/2 the constant start diverges, although Picard would contract"},
                     {"height", "640"}}};
  const double least = limits.duffing.back().least();
  const auto first = steps_until_divergence(0.53, 100);
  showing.quantities = {
      scene::near("largest step that converges from every phase, order 100", "P", least,
                  limits.by_legendre.least(), 0.03,
                  "the same iteration by 120 Legendre nodes and Gauss quadrature; the grid is 0.01 P"),
      scene::near(
          "contraction factor at P/2 from the solution, order 100", "1",
          contraction(sweep(chebyshev_tables(100), 0, duffing_period() / 2, Start::solution)).value_or(NAN),
          contraction(sweep(legendre_tables(120), 0, duffing_period() / 2, Start::solution)).value_or(NAN),
          0.01, "the same iteration by 120 Legendre nodes and Gauss quadrature"),
      scene::at_most("steps of 0.53 P from the maximum before one diverges, order 100", "1",
                     first ? static_cast<double>(*first) : HUGE_VAL, 5, "recorded: 0.53 P diverges at once"),
      scene::near("largest step, impact, order 100", "s", limits.impact.back(), 3, 0.01,
                  "recorded: 3 s converges, 4 s does not"),
      scene::near("largest step, three masses, order 100", "s", limits.three_masses.back(), 5.25, 0.05,
                  "recorded: 5 s converges, 6 s does not"),
  };
  return showing;
}

}  // namespace

void add_mcpi_limit(scene::Chapter& chapter) {
  const auto& limits = chapter.add_run<Limits>(
      "mcpi-largest-steps",
      "free Duffing: one step from each of many phases of the orbit, by 0.01 P; the others: all steps of the "
      "interval, by 0.5 s; from the constant state, at most 1000 sweeps",
      {}, [](Workshop& w) { return find_limits(w.quick()); });
  chapter.add({.name = "mcpi-limit",
               .title = "Picard's contraction factor, and the largest step that converges",
               .place = "our own",
               .needs = {&limits},
               .show = [&limits](Workshop& w) { return show(w.result(limits), w.quick()); }});
  chapter.add({.name = "elgohary/claim-4.4.1/MCPI/largest step before divergence",
               .needs = {&limits},
               .measure = [&limits](Workshop& w) {
                 return scene::Measured{w.result(limits).duffing.back().least(), std::nullopt};
               }});
}

}  // namespace nlmech::chapters
