#include <cmath>

#include "chapters/two_body_series/zonal/zonal.hpp"
#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/extended.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/extended_real.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

using Quad = ExtendedReal<34>;

// Taylor series of orders 45 and 50 and RKN12(10) with the gradient in closed form agree to 1e-22 m.
constexpr ZonalDay days[] = {
    {"LEO",
     {"1702547.136867679", "6353992.417071098", "0", "-7886.014053829254", "2113.051097224035", "0"},
     {"4716214.3704235458298", "4749998.9519703381918", "0", "-5997.5458577857867381",
      "5346.8532333571407564", "0"}},
    {"LEO tilted",
     {"1702547.136867679", "6353992.417071098", "0", "-3943.007026914627", "1056.5255486120175",
      "7070.406775"},
     {"3544510.0483122083031", "4581007.8506592658063", "-3355191.8038390635496", "-1887.9190659227612934",
      "5135.8435966509096777", "5879.8284577273064914"}},
    {"CIRC",
     {"7000000", "0", "0", "0", "4700", "5900"},
     {"4532841.9627156031062", "-3542172.7947567830238", "-3979637.2144251580166", "5734.8996777060516273",
      "2776.6232497172643882", "4041.2475851671119507"}}};

orbit::BasicState<Quad> parsed(const std::array<const char*, 6>& digits) {
  orbit::BasicState<Quad> s;
  for (std::size_t i = 0; i < 3; ++i) {
    s.position[static_cast<int>(i)] = Quad(digits[i]);
    s.velocity[static_cast<int>(i)] = Quad(digits[3 + i]);
  }
  return s;
}

ZonalErrors errors(const orbit::BasicState<Quad>& end, const ZonalDay& d) {
  const orbit::BasicState<Quad> truth = parsed(d.end_j2);
  const auto length = [](const orbit::Vector3<Quad>& v) { return static_cast<double>(Quad(sqrt(v.dot(v)))); };
  const auto field = orbit::earth(2).as<Quad>();
  const Quad before = orbit::energy(parsed(d.start), field), after = orbit::energy(end, field);
  return {length(end.position - truth.position), length(end.velocity - truth.velocity),
          std::abs(static_cast<double>(Quad(after / before - 1)))};
}

}  // namespace

std::span<const ZonalDay> zonal_days() { return days; }

orbit::State start_of(const ZonalDay& d) {
  const auto s = parsed(d.start);
  return {s.position.cast<double>(), s.velocity.cast<double>()};
}

ZonalErrors day_in_double(const ZonalDay& d) {
  const auto end = orbit::propagate(start_of(d), 0, day, orbit::earth(2), orbit::AnalyticContinuation{});
  if (!end.status.ok()) throw Failure(end.status);
  return errors({end.x.position.cast<Quad>(), end.x.velocity.cast<Quad>()}, d);
}

ZonalErrors day_in_extended(const ZonalDay& d) {
  return errors(orbit::continue_analytically<Quad>(parsed(d.start), Quad(day), orbit::earth(2).as<Quad>(), 30,
                                                   Quad(1e-21)),
                d);
}

}  // namespace nlmech::chapters::two_body_series
