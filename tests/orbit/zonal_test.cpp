/// Zonal harmonics: the acceleration is the gradient of the potential, energy is conserved, and orbits of a
/// day agree with extrapolation of the midpoint rule.
#include <gtest/gtest.h>

#include <span>
#include <stdexcept>
#include <vector>

#include "nlmech/orbit/continuation.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/expansion.hpp"
#include "nlmech/program/dual.hpp"
#include "nlmech/support/extended_real.hpp"
#include "tests/orbit/oracle.hpp"

namespace nlmech::orbit::zonal_test {
namespace {

using namespace oracle;
using Quad = ExtendedReal<34>;

// 2 r_2 is the acceleration; its components are the derivatives of the potential by dual numbers.
RC_GTEST_PROP(Zonal, AccelerationIsTheGradient, ()) {
  const State s = random_state(*between(1.01, 4), 1, 1, *between(0, 3));
  const int degree = *rc::gen::inRange(2, 7);
  Gravity g{.mu = 1.3, .radius = 1};
  for (int k = 2; k <= degree; ++k) g.zonal[static_cast<std::size_t>(k - 2)] = *between(-0.1, 0.1);
  Expansion<double> series(g, 4);
  series.expand(s, 4);
  using D = Dual<double, 3>;
  BasicState<D> x{variables<double, 3>(s.position), Vector3<D>::Zero()};
  const D minus_potential = energy(x, g.as<D>());
  for (std::size_t i = 0; i < 3; ++i) {
    // Some thirty terms of size mu/r^2 with J up to 0.1 and Legendre slopes up to 21.
    RC_ASSERT(std::abs(2 * series.coefficient(2)[static_cast<int>(i)] + minus_potential.partial[i]) <=
              500 * eps * 1.3 / s.position.squaredNorm());
  }
}

/// A day in the field of the Earth.
struct Day {
  const char* start[6];  ///< metres and metres per second, as exact decimals
  const char* end[6];    ///< to 20 digits
};

template <class T>
BasicState<T> state_from(const char* const (&digits)[6]) {
  BasicState<T> s;
  for (int i = 0; i < 3; ++i) {
    s.position[i] = static_cast<T>(Quad(digits[i]));
    s.velocity[i] = static_cast<T>(Quad(digits[3 + i]));
  }
  return s;
}

// J_2 alone, 20 digits. oracle: two_body_series_orbits day of *
const Day days[] = {
    {{"1702547.136867679", "6353992.417071098", "0", "-7886.014053829254", "2113.051097224035", "0"},
     {"4716214.3704235458298", "4749998.9519703381918", "0", "-5997.5458577857867381",
      "5346.8532333571407564", "0"}},
    {{"1702547.136867679", "6353992.417071098", "0", "-3943.007026914627", "1056.5255486120175",
      "7070.406775"},
     {"3544510.0483122083031", "4581007.8506592658063", "-3355191.8038390635496", "-1887.9190659227612934",
      "5135.8435966509096777", "5879.8284577273064914"}},
    {{"7000000", "0", "0", "0", "4700", "5900"},
     {"4532841.9627156031062", "-3542172.7947567830238", "-3979637.2144251580166", "5734.8996777060516273",
      "2776.6232497172643882", "4041.2475851671119507"}}};
constexpr double day = 86400;

TEST(Zonal, DayInExtendedPrecision) {
  for (const Day& d : days) {
    const auto end = continue_analytically<Quad>(state_from<Quad>(d.start), Quad(day), earth(2).as<Quad>(),
                                                 30, Quad(1e-21));
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(abs(Quad(end.position[i] - Quad(d.end[i]))), Quad(1e-9)) << d.end[i];
      EXPECT_LT(abs(Quad(end.velocity[i] - Quad(d.end[3 + i]))), Quad(1e-12)) << d.end[3 + i];
    }
  }
}

// Single orbits and several in SIMD lanes.
TEST(Zonal, DayInDoublePrecision) {
  std::vector<PropagationRequest> flights;
  for (const Day& d : days) flights.push_back({state_from<double>(d.start), day, earth(2)});
  std::vector<Solution> ends = propagate_all(flights);
  for (const PropagationRequest& flight : flights)
    ends.push_back(propagate(flight.start, 0, day, flight.gravity, AnalyticContinuation{}));
  for (std::size_t k = 0; k < ends.size(); ++k) {
    ASSERT_TRUE(ends[k].status.ok()) << ends[k].status.text();
    const Day& d = days[k % flights.size()];
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(ends[k].x.position[i], std::stod(d.end[i]), 1e-5);
      EXPECT_NEAR(ends[k].x.velocity[i], std::stod(d.end[3 + i]), 1e-8);
    }
  }
}

// All harmonics: double against quadruple precision, and conservation of energy.
TEST(Zonal, AllHarmonics) {
  const Gravity g = earth(6);
  const State start = state_from<double>(days[1].start);
  const auto exact =
      continue_analytically<Quad>(as<Quad>(start), Quad(day / 4), g.as<Quad>(), 26, Quad(1e-18));
  const Solution c = propagate(start, 0, day / 4, g);
  ASSERT_TRUE(c.status.ok());
  const Vector3<Quad> d = c.x.position.cast<Quad>() - exact.position;
  EXPECT_LT(length(d), Quad(1e-5));
  const PropagationRequest flight{start, day / 4, g};
  const Vector3<Quad> in_lanes =
      propagate_all(std::span(&flight, 1))[0].x.position.cast<Quad>() - exact.position;
  EXPECT_LT(length(in_lanes), Quad(1e-5));
  const Quad before = energy(as<Quad>(start), g.as<Quad>()), after = energy(exact, g.as<Quad>());
  EXPECT_LT(abs(Quad(after / before - 1)), Quad(1e-17));
  // A quarter of a day takes some forty steps; each has a rounding error of the state.
  EXPECT_NEAR(energy(c.x, g) / energy(start, g), 1, 40 * eps);
}

// Terms with J_k = 0 are skipped; a field without terms is the point mass of the kernels.
TEST(Zonal, TermsThatAreZeroCostNothingAndChangeNothing) {
  EXPECT_EQ(earth().degree(), 0);
  EXPECT_EQ(earth(3).degree(), 3);
  Gravity odd = earth(4);
  odd.zonal[2] = 0;
  EXPECT_EQ(odd.degree(), 3);
  const Solution a = propagate(low_orbit, 0, 6000, odd), b = propagate(low_orbit, 0, 6000, earth(3));
  EXPECT_EQ(a.x.position, b.x.position);
}

TEST(Zonal, FieldsThatCannotBeMeantAreRefused) {
  EXPECT_THROW((void)earth(7), std::invalid_argument);
  EXPECT_THROW((void)earth(-1), std::invalid_argument);
  Gravity g = earth(2);
  g.radius = 0;
  EXPECT_THROW((void)propagate(low_orbit, 0, 1, g), std::invalid_argument);
  g.radius = 1;
  g.zonal[3] = NAN;
  EXPECT_THROW((void)propagate(low_orbit, 0, 1, g), std::invalid_argument);
}

}  // namespace
}  // namespace nlmech::orbit::zonal_test
