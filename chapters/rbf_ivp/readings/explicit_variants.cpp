#include "chapters/rbf_ivp/readings/explicit_variants.hpp"

#include <cmath>

#include "nlmech/problems/texts.hpp"

namespace nlmech::chapters::rbf_ivp {
namespace {

using Vector3 = Vector<double, 3>;

/// Velocity of ExplicitDamping::implicit by fixed-point iteration. The damping is weak: each of the 12
/// iterations gains four digits.
Vector3 implicit_velocity(const problems::TextProblem& p, double t, double h, const Vector3& q,
                          const Vector3& half_before) {
  Vector3 v = half_before, a;
  for (int turn = 0; turn < 12; ++turn) {
    p.acceleration(t, q, v, a);
    v = half_before + h / 2 * a;
  }
  return v;
}

}  // namespace

std::string_view to_string(ExplicitStart start) {
  switch (start) {
    case ExplicitStart::half_step: return "v0 - h/2 a0";
    case ExplicitStart::as_given: return "v0";
    case ExplicitStart::whole_step: return "v0 - h a0";
  }
  return "";
}

std::string_view to_string(ExplicitDamping damping) {
  switch (damping) {
    case ExplicitDamping::from_initial: return "v0 first";
    case ExplicitDamping::from_half: return "v(-h/2) first";
    case ExplicitDamping::lagged: return "lagged";
    case ExplicitDamping::implicit: return "implicit";
  }
  return "";
}

Record explicit_chain(double h, ExplicitStart start, ExplicitDamping damping) {
  const problems::TextProblem p("three-dof");
  const Case& c = three_mass_case();
  const Vector3 v0 = c.x0.tail<3>();
  Vector3 q = c.x0.head<3>(), a;
  p.acceleration(0.0, q, v0, a);
  const double back = start == ExplicitStart::half_step ? h / 2 : start == ExplicitStart::as_given ? 0 : h;
  Vector3 half = v0 - back * a, before = half;
  const auto steps = static_cast<int>(std::lround((c.t1 - c.t0) / h));
  Record record;
  record.values.reserve(static_cast<std::size_t>(steps));
  for (int k = 0; k < steps; ++k) {
    const double t = k * h;
    Vector3 v = half;
    if (damping == ExplicitDamping::implicit) v = implicit_velocity(p, t, h, q, half);
    if (damping == ExplicitDamping::from_initial && k == 0) v = v0;
    if (damping <= ExplicitDamping::from_half && k > 0) v = 1.5 * half - 0.5 * before;
    p.acceleration(t, q, v, a);
    before = half;
    half += h * a;
    q += h * half;
    const Vector<Extended, 6> reference = c.reference((k + 1) * h);
    record.values.push_back(
        {(k + 1) * h, true, q, (q.cast<Extended>() - reference.head<3>()).cast<double>()});
  }
  return record;
}

}  // namespace nlmech::chapters::rbf_ivp
