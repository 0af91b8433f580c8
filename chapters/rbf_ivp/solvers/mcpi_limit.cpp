#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "chapters/rbf_ivp/examples/cases.hpp"
#include "chapters/rbf_ivp/scenes.hpp"
#include "nlmech/collocation/integration.hpp"
#include "nlmech/ivp/picard.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using scene::Workshop;

constexpr std::array orders = {8, 16, 32, 100, 500};
constexpr double standstill = 1e-12, overflow = 1e30;  // of a change: done; will not come back

/// The largest change of a state component, sweep by sweep.
using Changes = std::vector<double>;

/// Picard's iteration on the unit interval: nodes, and the matrix from right-hand sides to increments at the
/// nodes but the first.
struct Tables {
  Eigen::VectorXd nodes;
  Eigen::MatrixXd integral;
};

/// In closed form: Chebyshev coefficients are sums of cosines, and the integral of T_k is
/// T_{k+1} / (2 (k + 1)) - T_{k-1} / (2 (k - 1)).
Tables tables_of_cosines(int order) {
  const double pi = std::numbers::pi, N = order;
  Eigen::MatrixXd coefficients(order, order + 1), integrals(order + 1, order);
  for (int j = 0; j <= order; ++j) {
    const double angle = pi - j * pi / N, half = j % order == 0 ? 0.5 : 1;
    for (int k = 0; k < order; ++k) {
      const auto integral = [k](double a) {
        if (k < 2) return std::pow(std::cos(a), k + 1) / (k + 1);
        return std::cos((k + 1) * a) / (2 * (k + 1)) - std::cos((k - 1) * a) / (2 * (k - 1));
      };
      coefficients(k, j) = (k == 0 ? 1 : 2) / N * half * std::cos(k * angle);
      integrals(j, k) = integral(angle) - integral(pi);
    }
  }
  const Eigen::VectorXd turns = Eigen::VectorXd::LinSpaced(order + 1, 0, pi);
  return {(1 - turns.array().cos()) / 2, (integrals * coefficients).bottomRows(order) / 2};
}

/// The library's, as far as it has them.
Tables chebyshev_tables(int order) {
  if (order >= collocation::max_nodes) return tables_of_cosines(order);
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

/// @param first hundredths of a period, from which every step fails that is longer than one that fails
PhaseLimits limits_by_phase(const Tables& tables, int phases, std::int64_t first = 30) {
  const double P = duffing_period();
  PhaseLimits limits;
  for (int i = 0; i <= phases; ++i) {
    limits.phase.push_back(0.5 * i / phases);
    limits.limit.push_back(largest_step(0.01, first, [&](double periods) {
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

/// Steps of the free oscillator from rest, each from the exact state, before one diverges; all to the end if
/// none does.
double converging_steps(double periods, int order) {
  const Tables tables = chebyshev_tables(order);
  const double step = periods * duffing_period(), all = std::floor(free_duffing_case().t1 / step);
  double k = 0;
  while (k < all && converged(sweep(tables, k * step, step, Start::constant))) ++k;
  return k;
}

/// The same by the method itself, each step from the end of the last; nothing if none diverges.
std::optional<std::int64_t> steps_until_divergence(double periods, int order) {
  const Case<2>& c = free_duffing_case();
  const ivp::Mcpi method = {.step = periods * duffing_period(), .order = order};
  const auto solution = ivp::integrate(c.system, c.x0, c.t0, c.t1, method);
  if (solution.status.ok()) return std::nullopt;
  return solution.statistics.steps;
}

struct Limits {
  std::vector<PhaseLimits> duffing;                         ///< by order
  PhaseLimits by_legendre;                                  ///< with 120 Legendre nodes
  std::vector<std::optional<double>> impact, three_masses;  ///< by order, where the method has it

  [[nodiscard]] const PhaseLimits& of(int order) const {
    return duffing.at(
        static_cast<std::size_t>(std::find(orders.begin(), orders.end(), order) - orders.begin()));
  }
};

Limits find_limits(bool quick) {
  const int phases = quick ? 3 : 25;
  const std::int64_t first = quick ? 4 : 1;
  Limits limits{{}, limits_by_phase(legendre_tables(120), phases), {}, {}};
  for (const int order : orders) {
    const bool in_method = order < collocation::max_nodes;
    // A sweep of 500 nodes is dear, and those of 100 show that all shorter steps converge.
    limits.duffing.push_back(limits_by_phase(chebyshev_tables(order), phases, in_method ? 30 : 40));
    limits.impact.emplace_back();
    limits.three_masses.emplace_back();
    if (!in_method) continue;
    limits.impact.back() = limit_over_time(impact_case(), order, first);
    limits.three_masses.back() = limit_over_time(three_mass_case(), order, first);
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
               scene::to_cell(limits.impact[i]), scene::to_cell(limits.three_masses[i])});
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
    const bool dear = orders[i] >= collocation::max_nodes;
    for (int k = 1; !dear && k <= (quick ? 20 : 80); ++k) {
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
  const double least = limits.of(100).least();
  const auto first = steps_until_divergence(0.53, 100);
  const char* passes_all =
      "by Legendre nodes the worst phase has 0.47 P; phases repeat after P/2, and steps from rest meet all "
      "of them "
      "by then";
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
      scene::near("largest step that converges from every phase, order 500", "P", limits.of(500).least(),
                  limits.by_legendre.least(), 0.03,
                  "the same iteration by 120 Legendre nodes and Gauss quadrature; the grid is 0.01 P"),
      scene::near("steps of P/2 from the maximum that converge, order 500", "1", converging_steps(0.5, 500),
                  std::floor(1000 / duffing_period()), 0,
                  "all to t = 500: each begins at rest, as the first does"),
      scene::at_most("steps of 0.51 P from the maximum before one diverges, order 500", "1",
                     converging_steps(0.51, 500), 50, passes_all),
      scene::at_most("steps of 0.53 P from the maximum before one diverges, order 500", "1",
                     converging_steps(0.53, 500), 17, passes_all),
      scene::at_most("steps of 0.48 P from the maximum before one diverges, order 500", "1",
                     converging_steps(0.48, 500), 25, passes_all),
      scene::at_most("difference of the tables in closed form from the method's, order 100", "1",
                     (tables_of_cosines(100).integral - chebyshev_tables(100).integral).cwiseAbs().maxCoeff(),
                     1e-14, "both are right to 1e-15 times a few roundings"),
      scene::near("largest step, impact, order 100", "s", limits.impact[3].value_or(NAN), 3, 0.01,
                  "recorded: 3 s converges, 4 s does not"),
      scene::near("largest step, three masses, order 100", "s", limits.three_masses[3].value_or(NAN), 5.25,
                  0.05, "recorded: 5 s converges, 6 s does not"),
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
                 return scene::Measured{w.result(limits).of(100).least(), std::nullopt};
               }});
}

}  // namespace nlmech::chapters::rbf_ivp
