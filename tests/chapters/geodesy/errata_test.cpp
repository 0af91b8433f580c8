/// Every misprint of section 2.4: printed and corrected form against an independent oracle. The sizes of the
/// errors were computed with 50 digits; a test fails if the printed form has another error, or if the
/// corrected one has an error. The sources are scanned text: a misprint may be one of the scan.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "chapters/geodesy/printed.hpp"
#include "tests/errata/erratum.hpp"
#include "tests/geodesy/oracle.hpp"

namespace nlmech::chapters::geodesy::errata_test {
namespace {

using namespace nlmech::geodesy;
using oracle::Real;
using tests::expect_erratum;

constexpr double degree = std::numbers::pi / 180, eps = std::numeric_limits<double>::epsilon();
/// The first neglected term of order 5 on the whole range: 2.4e-11 degrees, 0.79 micrometres.
constexpr double order_4_deg = 2.5e-11, order_4_m = 8e-7;

struct Errors {
  double latitude_deg, height_m;
};

/// Errors of the series with a coefficient table at one point, in 50 digits: truncation and misprint only.
Errors errors_at(double latitude_deg, double height_m, int order, const SeriesTable& table) {
  const auto e = BasicEllipsoid<Real>::wgs84();
  const BasicGeodetic<Real> exact{Real(latitude_deg) * oracle::pi() / 180, 0, height_m};
  const auto found =
      reverse(forward(exact, e), e, PerturbationSeries{order, HeightFrom::series}, table).position;
  return {static_cast<double>(abs(found.latitude - exact.latitude) * 180 / oracle::pi()),
          static_cast<double>(abs(found.height - exact.height))};
}

const PrintedCoefficient& coefficient(const std::string& name) {
  for (const PrintedCoefficient& c : printed_coefficients()) {
    if (c.name == name) return c;
  }
  throw std::logic_error(name);
}

SeriesTable with(const std::string& name) { return with_printed(corrected_series(), coefficient(name)); }

/// Reports the error of a printed coefficient in latitude, degrees, with that of the corrected table.
void expect_latitude_error(std::string_view id, double latitude_deg, double height_m, int order,
                           const SeriesTable& printed) {
  expect_erratum(id, {.printed = errors_at(latitude_deg, height_m, order, printed).latitude_deg,
                      .corrected = errors_at(latitude_deg, height_m, order, corrected_series()).latitude_deg,
                      .oracle = 0,  // errors are against 50 digits already
                      .tolerance = order_4_deg});
}

/// Coefficient @p name with the number at h_0^i replaced: one reading of an impossible term.
SeriesTable with(const std::string& name, std::size_t i, int value) {
  PrintedCoefficient c = coefficient(name);
  c.by_height = row_of(c, corrected_series());
  c.by_height.at(i) = value;
  return with_printed(corrected_series(), c);
}

// (2.42) prints r - r_g = h n = 0, which would put every satellite on the ground; r - r_g - h n = 0 holds.
TEST(Errata, Equation2_42) {
  const BasicGeodetic<Real> g{0.7, 0, 1e6};
  const auto e = BasicEllipsoid<Real>::wgs84();
  const auto r = forward(g, e), ground = forward(BasicGeodetic<Real>{0.7, 0, 0}, e);
  const Real n_r = cos(g.latitude), n_z = sin(g.latitude);
  EXPECT_GT(abs(r.x - ground.x), Real(1e5));
  EXPECT_LT(abs(r.x - ground.x - g.height * n_r) + abs(r.z - ground.z - g.height * n_z), Real(1e-40));
  // The height by each form at that point: h n = 0, and r - r_g along n.
  const Real height = (r.x - ground.x) * n_r + (r.z - ground.z) * n_z;
  expect_erratum("geodesy-2.42", {.printed = 0,
                                  .corrected = static_cast<double>(height),
                                  .oracle = static_cast<double>(oracle::reverse(r, e).height),
                                  .tolerance = eps});
}

// (2.43) and the text call phi_c geocentric. The ground point (a cos phi_c, b sin phi_c) has that geocentric
// latitude only at the equator and the poles: phi_c is the parametric latitude.
TEST(Errata, Equation2_43_ParametricNotGeocentric) {
  const Ellipsoid e = Ellipsoid::wgs84();
  const double parametric = 45 * degree;
  const double geocentric = std::atan2(e.b() * std::sin(parametric), e.a() * std::cos(parametric));
  EXPECT_GT(std::abs(geocentric - parametric), 0.09 * degree);
  const double geodetic = std::atan2(e.a() * std::sin(parametric), e.b() * std::cos(parametric));
  const Cartesian ground = forward(Geodetic{geodetic, 0, 0}, e);
  EXPECT_NEAR(ground.x, e.a() * std::cos(parametric), 3e-9);  // three ulp of a
  EXPECT_NEAR(ground.z, e.b() * std::sin(parametric), 3e-9);
  // The ground point by Eq. 2.40 at its geodetic latitude, and by 2.43 at both latitudes.
  expect_erratum("geodesy-2.43", {.printed = e.a() * std::cos(geocentric),
                                  .corrected = e.a() * std::cos(parametric),
                                  .oracle = ground.x,
                                  .tolerance = 4 * eps});
}

// (2.45) prints p = 0.00314; WGS84 gives 0.0033640898. The printed value in the series, a/b exact in
// Eq. 2.53:
TEST(Errata, Equation2_45_SmallParameter) {
  const auto e = BasicEllipsoid<Real>::wgs84();
  EXPECT_NEAR(static_cast<double>(e.p()), 0.0033640898, 1e-10);
  const Real p("0.00314");
  const BasicEllipsoid<Real> assumed(e.b() * (1 + p), p / (1 + p));  // the same b
  double latitude = 0, height = 0;
  for (int i = -90; i <= 90; ++i) {
    const BasicGeodetic<Real> exact{Real(i) * oracle::pi() / 180, 0, 200e3};
    const auto point = forward(exact, e);
    const Real R = sqrt(point.x * point.x + point.z * point.z);
    const auto found = detail::sum_series(point.x, point.z, R, assumed, 4, corrected_series());
    const Real geodetic = atan2(e.a() * sin(found.latitude), e.b() * cos(found.latitude));
    latitude = std::max(latitude, static_cast<double>(abs(geodetic - exact.latitude) * 180 / oracle::pi()));
    height = std::max(height, static_cast<double>(abs(found.height - exact.height)));
  }
  EXPECT_NEAR(latitude, 6.0e-3, 0.05e-3);    // deg
  EXPECT_NEAR(height, 1424, 1);              // m
  const Real f = 1 / Real("298.257223563");  // a/b - 1 = f/(1 - f)
  expect_erratum("geodesy-2.45", {.printed = 0.00314,
                                  .corrected = 0.0033640898,
                                  .oracle = static_cast<double>(Real(f / (1 - f))),
                                  .tolerance = 0.5e-10,  // half a unit of the last digit given
                                  .scale = 1});
}

// (2.48) prints phi_0 = 2 atan((R - r)/z): an identity, but 0/0 on the equator, with cancellation near it.
TEST(Errata, Equation2_48_StartingLatitude) {
  const auto printed = [](double r, double z) { return 2 * std::atan(std::hypot(r, z) / z - r / z); };
  EXPECT_TRUE(std::isnan(printed(7e6, 0)));
  EXPECT_EQ(std::atan2(0.0, 7e6), 0);
  EXPECT_NEAR(printed(4e6, 3e6), std::atan2(3e6, 4e6), 1e-15);
  double worst = 0, at = 0;
  for (int i = 0; i < 460; ++i) {
    const double z = 0.01 * std::pow(1.01, i);  // to 1 m
    const auto exact = static_cast<double>(atan2(Real(z), Real(6.6e6)));
    const double error = std::abs(printed(6.6e6, z) - exact);
    if (error > worst) at = z;
    worst = std::max(worst, error);
    EXPECT_NEAR(std::atan2(z, 6.6e6), exact, 1e-16 * exact + 1e-24);
  }
  EXPECT_GT(worst, 1e-8);  // 0.07 m on the ground
  expect_erratum("geodesy-2.48", {.printed = printed(6.6e6, at),
                                  .corrected = std::atan2(at, 6.6e6),
                                  .oracle = static_cast<double>(atan2(Real(at), Real(6.6e6))),
                                  .tolerance = eps});
}

// (2.49) prints sin(2 phi_c), the unknown itself. With sin(2 phi_0) the error of order 1 decreases as p^2;
// with sin(2 phi_c) the first-order term is no constant of the expansion, and at the true phi_c the result
// changes by p^2.
TEST(Errata, Equation2_49_ArgumentOfTheSine) {
  const auto e = BasicEllipsoid<Real>::wgs84();
  const BasicGeodetic<Real> exact{Real(30) * degree, 0, 200e3};
  const auto point = forward(exact, e);
  const Real R = sqrt(point.x * point.x + point.z * point.z), h0 = R - e.b(), phi0 = atan2(point.z, point.x);
  const Real phi_c = atan(e.b() / e.a() * tan(exact.latitude));
  const Real factor = (e.b() - h0) / (2 * R);
  const Real printed = phi0 + e.p() * factor * sin(2 * phi_c),
             corrected = phi0 + e.p() * factor * sin(2 * phi0);
  EXPECT_GT(abs(printed - corrected), Real(1e-6));
  // second-order term of the series explains the rest for the corrected form only: the remainder is then of
  // order p^3
  const Real S = sin(2 * phi0);
  const Real phi2 = (h0 * h0 - 4 * e.b() * h0 + 3 * e.b() * e.b()) / (8 * R * R) * sin(4 * phi0) + S / 4;
  EXPECT_LT(abs(corrected + e.p() * e.p() * phi2 - phi_c), Real(5e-8));
  EXPECT_GT(abs(printed + e.p() * e.p() * phi2 - phi_c), Real(1e-6));
  expect_erratum("geodesy-2.49", {.printed = static_cast<double>(printed + e.p() * e.p() * phi2),
                                  .corrected = static_cast<double>(corrected + e.p() * e.p() * phi2),
                                  .oracle = static_cast<double>(phi_c),
                                  .tolerance = static_cast<double>(e.p() * e.p() * e.p()),
                                  .scale = 1});
}

TEST(Errata, Table2_6_C3) {
  EXPECT_NEAR(errors_at(45, 12700e3, 4, with("C3")).latitude_deg, 4.8e-7, 0.1e-7);
  EXPECT_NEAR(errors_at(45, 12700e3, 3, with("C3")).latitude_deg, 4.8e-7, 0.1e-7);
  expect_latitude_error("geodesy-c3", 45, 12700e3, 4, with("C3"));
}

TEST(Errata, Table2_6_C6) {
  EXPECT_NEAR(errors_at(45, 3200e3, 4, with("C6")).height_m, 1.508e-3,
              0.005e-3);  // the text's "millimetre accuracy"
  expect_erratum("geodesy-c6", {.printed = errors_at(45, 3200e3, 4, with("C6")).height_m,
                                .corrected = errors_at(45, 3200e3, 4, corrected_series()).height_m,
                                .oracle = 0,  // m
                                .tolerance = order_4_m});
}

// C8 prints "-155b^4 = 2h_0^4": the term dropped, and the term added, are both wrong; subtracted it is right.
TEST(Errata, Table2_6_C8_EqualsSign) {
  const auto worst = [](const SeriesTable& table) {
    double largest = 0;
    for (int i = 0; i <= 90; ++i) largest = std::max(largest, errors_at(i, 35000e3, 4, table).latitude_deg);
    return largest;
  };
  EXPECT_NEAR(worst(with("C8", 4, 0)), 9.8e-10, 0.3e-10);
  EXPECT_NEAR(worst(with("C8", 4, 2)), 2.0e-9, 0.1e-9);
  for (const int read : {0, 2}) {
    expect_erratum("geodesy-c8-sign", {.printed = worst(with("C8", 4, read)),
                                       .corrected = worst(corrected_series()),
                                       .oracle = 0,  // degrees
                                       .tolerance = order_4_deg});
  }
}

TEST(Errata, Table2_6_C8_431) {
  EXPECT_NEAR(errors_at(24, 2100e3, 4, with("C8", 1, 431)).latitude_deg, 1.0e-9, 0.1e-9);
  expect_latitude_error("geodesy-c8-431", 24, 2100e3, 4, with("C8", 1, 431));
}

// C9 prints 135 b^3 h_0^2 among terms of degree 4. Taken literally it depends on the unit of length: in
// metres the latitude is far less accurate than that of third order.
TEST(Errata, Table2_6_C9_Dimension) {
  const int literal = 135 * 6356752;  // 135 b^3 = (135 b) b^2, b in metres
  double printed = 0;
  for (int i = 0; i <= 90; ++i) {
    printed = std::max(printed, errors_at(i, 35000e3, 4, with("C9", 2, literal)).latitude_deg);
  }
  EXPECT_GT(printed, 1e-2);
  expect_latitude_error("geodesy-c9", 30, 35000e3, 4, with("C9", 2, literal));
}

// (2.53) prints atan(cos/((a/b) sin)): the angle from the pole, not from the equator.
TEST(Errata, Equation2_53_Conversion) {
  const Ellipsoid e = Ellipsoid::wgs84();
  const double geodetic = 30 * degree,
               parametric = std::atan2(e.b() * std::sin(geodetic), e.a() * std::cos(geodetic));
  const double printed = std::atan(std::cos(parametric) / (e.a() / e.b() * std::sin(parametric)));
  EXPECT_NEAR(printed, 60 * degree, 1e-15);
  EXPECT_NEAR(std::atan2(e.a() * std::sin(parametric), e.b() * std::cos(parametric)), geodetic, 1e-15);
  // The direction of the normal at the foot, in 50 digits by another method.
  const Cartesian point = forward(Geodetic{geodetic, 0, 1e6}, e);
  expect_erratum("geodesy-2.53",
                 {.printed = printed,
                  .corrected = std::atan2(e.a() * std::sin(parametric), e.b() * std::cos(parametric)),
                  .oracle = static_cast<double>(oracle::reverse(point, e).latitude),
                  .tolerance = 4 * eps});
}

/// Largest errors over all whole degrees of latitude at 200 km, where the errors of the series are largest,
/// in double.
Errors largest_errors(int order) {
  Errors largest{};
  const Ellipsoid e = Ellipsoid::wgs84();
  for (int i = 0; i <= 90; ++i) {
    const Cartesian point = forward(Geodetic{i * degree, 0, 200e3}, e);
    const BasicGeodetic<Real> exact = oracle::reverse(point, e);
    const Geodetic found = reverse(point, e, PerturbationSeries{order, HeightFrom::series}).position;
    largest.latitude_deg = std::max(largest.latitude_deg,
                                    std::abs(static_cast<double>(found.latitude - exact.latitude)) / degree);
    largest.height_m = std::max(largest.height_m, std::abs(static_cast<double>(found.height - exact.height)));
  }
  return largest;
}

// "In height, millimeter accuracy" is the error with C6 as printed; corrected, it is smaller. Oracle: the
// truncation error of order 4 by Cauchy's integrals of the exact solution instead of coefficients; doubles
// round a height by some 5e-9 m.
// oracle: geodesy_series order 4: height at whole degrees
TEST(Claims, HeightIsRightToAMicrometre) { EXPECT_NEAR(largest_errors(4).height_m, 7.859e-7, 5e-9); }

// "Higher order approximations are not needed as they will not provide additional useful information":
// decades of latitude that order 5 gains over order 4. The oracle as above. Doubles round a latitude by 1e-14
// degrees of 1.1e-13. oracle: geodesy_series order ?: latitude at whole degrees
TEST(Claims, TheFifthOrderIsWorthHaving) {
  expect_erratum("geodesy-2.4.2-orders",
                 {.printed = 0,
                  .corrected = std::log10(largest_errors(4).latitude_deg / largest_errors(5).latitude_deg),
                  .oracle = std::log10(2.414e-11 / 1.142e-13),
                  .tolerance = 0.05});
}

// The other coefficients are printed correctly, and so says the data of the table.
TEST(Errata, CoefficientsPrintedRight) {
  for (const std::string name : {"C1", "C2", "C4", "C5", "C7", "C10"}) {
    EXPECT_EQ(coefficient(name).by_height, row_of(coefficient(name), corrected_series())) << name;
  }
  for (const std::string name : {"C3", "C6", "C8"}) {
    EXPECT_NE(coefficient(name).by_height, row_of(coefficient(name), corrected_series())) << name;
  }
}

TEST(PolynomialText, ReadsLikeTheTable) {
  EXPECT_EQ(polynomial_text({37, -66, 33, -4}), "37b^3 - 66b^2h0 + 33bh0^2 - 4h0^3");
  EXPECT_EQ(polynomial_text({-1, 0, 1}), "-b^2 + h0^2");
  EXPECT_EQ(polynomial_text({0, 0}), "0");
}

}  // namespace
}  // namespace nlmech::chapters::geodesy::errata_test
