#include "chapters/rbf_ivp/readings/traces.hpp"

#include <cmath>
#include <memory>

#include "nlmech/problems/reference_trajectory.hpp"
#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

/// Fifteen times as fast as the elliptic functions.
Case duffing_by_series() {
  using Trajectory = problems::ReferenceTrajectory<Extended, problems::TextProblem>;
  const auto trajectory = std::make_shared<const Trajectory>(
      problems::TextProblem("duffing"), ivp::LongState{1, 0}, Extended(0), Extended(505));
  Case c = free_duffing_case();
  c.reference = [trajectory](double t) { return (*trajectory)(t); };
  return c;
}

Trace trace_of(const Case& c, const Procedure& procedure) {
  const Record kept = record(c, c.t1, procedure);
  Trace trace{{}, c.amplitude[0]};
  trace.values.reserve(kept.values.size());
  for (const auto& v : kept.values)
    trace.values.push_back({v.t, v.end, {v.error.data(), v.error.data() + v.error.size()}});
  return trace;
}

}  // namespace

double Trace::rms(double until, Points points, std::size_t i, bool begin) const {
  std::vector<double> errors(begin && points == Points::ends ? 1 : 0, 0.0);
  const double reach = until * (1 + 1e-12);
  for (const Value& v : values) {
    if (v.t <= reach && (v.end || points == Points::all)) errors.push_back(v.errors.at(i));
  }
  return root_mean_square(errors);
}

double Trace::rms_of_norm(double until) const {
  double sum = 0;
  for (std::size_t i = 0; i < values.front().errors.size(); ++i) {
    const double part = rms(until, Points::ends, i);
    sum += part * part;
  }
  return std::sqrt(sum);
}

double inferred_end(const std::string& table) {
  if (table == "table-4.2") return free_duffing_case().inferred_end;
  return table == "table-4.4" ? impact_case().inferred_end : three_mass_case().inferred_end;
}

std::vector<Setting> implicit_settings(double P) {
  return {{"table-4.2", "(P/10)", P / 10},       {"table-4.2", "(P/500)", P / 500},
          {"table-4.4", "(0.1; 0.5)", 0.1, 0.5}, {"table-4.4", "(0.05; 0.03)", 0.05, 0.03},
          {"table-4.6", "(0.625)", 0.625},       {"table-4.6", "(0.0625)", 0.0625}};
}

Trace trace_of_duffing(const Procedure& procedure) {
  static const Case c = duffing_by_series();
  return trace_of(c, procedure);
}

Trace trace_of_impact(const Procedure& procedure) { return trace_of(impact_case(), procedure); }

Trace trace_of_chain(const Procedure& procedure) { return trace_of(three_mass_case(), procedure); }

}  // namespace nlmech::chapters::rbf_ivp
