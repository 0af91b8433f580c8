/// Every reverse transformation against the forward transformation in extended precision: points from the
/// centre to the range of double, on ellipsoids from discs to needles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "nlmech/geodesy/closest_point.hpp"
#include "nlmech/geodesy/perturbation.hpp"
#include "nlmech/geodesy/reverse_transform.hpp"
#include "tests/geodesy/exact_reverse.hpp"
#include "tests/randomised/randomised.hpp"

namespace nlmech::geodesy::geodesy_test {
namespace {

using randomised::Case;
using randomised::Draw;
using Wide = long double;

constexpr Wide eps = std::numeric_limits<double>::epsilon();

double any_flattening(Draw& draw) {
  switch (draw.whole(0, 6)) {
    case 0: return Ellipsoid::wgs84().f();
    case 1: return 0;
    case 2: return draw.signed_log(1e-18, 0.3);
    case 3: return 1 - draw.log_uniform(1e-15, 1);
    case 4: return -draw.log_uniform(0.3, 1e90);
    case 5: return draw.uniform(0.003, 0.0036);
    default: return draw.uniform(-1, 0.99);
  }
}

Ellipsoid any_ellipsoid(Draw& draw) {
  const double a = draw.chance(0.6) ? 6378137 : draw.log_uniform(1e-150, 1e150);
  return {a, any_flattening(draw)};
}

/// Points of a meridian at any distance, near the surface, on the axes, and near the evolute.
Cartesian any_point(Draw& draw, const Ellipsoid& e) {
  double r = 0, z = 0;
  const double size = std::max(e.a(), e.b());
  const double angle = draw.uniform(-std::numbers::pi / 2, std::numbers::pi / 2);
  switch (draw.whole(0, 5)) {
    case 0: {
      const double R = size * draw.log_uniform(1e-20, 1e15);
      r = R * std::cos(angle), z = R * std::sin(angle);
      break;
    }
    case 1: {
      const Cartesian p = forward(Geodetic{angle, 0, size * draw.signed_log(1e-12, 1e3)}, e);
      r = std::abs(p.x), z = p.z;
      break;
    }
    case 2: r = size * draw.log_uniform(1e-15, 10), z = draw.one_of({0.0, -0.0, 5e-324, -1e-300}); break;
    case 3: z = size * draw.signed_log(1e-15, 10), r = draw.one_of({0.0, 5e-324, 1e-200}); break;
    case 4: {  // the astroid (evolute) that the normals touch
      const double gap = std::abs((e.a() - e.b()) * (1 + e.b() / e.a())), c = std::cos(angle),
                   s = std::sin(angle);
      const double near = 1 + draw.signed_log(1e-16, 0.1);
      r = gap * c * c * c * near, z = gap * (e.a() / e.b()) * s * s * s * near;
      break;
    }
    default: r = size * draw.uniform(0, 2), z = size * draw.uniform(-2, 2);
  }
  const double longitude = draw.uniform(-std::numbers::pi, std::numbers::pi);
  if (draw.chance(0.3)) return {draw.chance(0.5) ? r : -r, draw.one_of({0.0, -0.0}), z};
  return {r * std::cos(longitude), r * std::sin(longitude), z};
}

/// Compares a position with the given point, relative to the rounding errors of the point and of the
/// latitude; expects the closest foot: the only one in the quadrant of the point.
Case judged(const Cartesian& p, const Ellipsoid& e, const Geodetic& g, double bound,
            const std::string& what) {
  const std::string all =
      fmt::format("{}: a = {:.17g}, f = {:.17g}, ({:.17g}, {:.17g}, {:.17g}) -> {:.17g} {:.17g} {:.17g}",
                  what, e.a(), e.f(), p.x, p.y, p.z, g.latitude, g.longitude, g.height);
  if (!std::isfinite(g.latitude) || !std::isfinite(g.longitude) || !std::isfinite(g.height))
    return Case::wrong(all);
  if (std::signbit(g.latitude) != std::signbit(p.z) || std::abs(g.latitude) > std::numbers::pi / 2)
    return Case::wrong(all);
  if (std::abs(g.longitude - std::atan2(Wide(p.y), Wide(p.x))) > 4 * eps)
    return Case::wrong("longitude, " + all);
  const Wide a = e.a(), b = a * (1 - Wide(e.f())), r = std::hypot(Wide(p.x), Wide(p.y)), z = p.z;
  const Wide c = std::cos(Wide(g.latitude)), s = std::sin(Wide(g.latitude)), h = g.height;
  const Wide D = std::hypot(a * c, b * s), curvature = a / D * (b / D) * (a / D * b);  // M
  const Wide dr = r - (a / D * a * c + h * c), dz = z - (b / D * b * s + h * s), R = std::hypot(r, z);
  const Wide along = std::abs(dr * c + dz * s), across = std::abs(dz * c - dr * s);
  const Wide scale = R + std::abs(h), turn = scale + std::abs(curvature + h) * std::abs(Wide(g.latitude));
  Wide error = std::max(along / (eps * scale), across / (eps * turn));
  // On such a thin disc the rounding of a latitude near the pole moves the foot by more than the size of the
  // point: latitude and height are compared with those of 50 digits instead.
  if (a > b && curvature * eps > 1e-3L * scale) {
    const auto exact = reference::reverse(p, e);
    const double latitude = static_cast<double>(abs(abs(exact.latitude) - std::abs(g.latitude)));
    const double height = static_cast<double>(abs(exact.height - g.height));
    error = std::max(Wide(latitude) / (eps * std::abs(Wide(g.latitude))), Wide(height) / (eps * scale));
    return Case::judged(static_cast<double>(error), bound, "thin disc, " + all);
  }
  // On the equatorial plane and on the axis feet in other quadrants are equally close: closed forms.
  if (z == 0 || r == 0) {
    Wide height = z == 0 ? r - a : std::abs(z) - b;
    if (z == 0 && a > b && r < (a - b) * (1 + b / a)) {
      const Wide foot = r / (1 - b / a * (b / a));
      height = -std::hypot(foot - r, b * std::sqrt((1 - foot / a) * (1 + foot / a)));
    } else if (r == 0 && b > a && std::abs(z) < (b - a) * (1 + a / b)) {
      const Wide foot = std::abs(z) / (1 - a / b * (a / b));
      height = -std::hypot(foot - std::abs(z), a * std::sqrt((1 - foot / b) * (1 + foot / b)));
    }
    error = std::max(error, std::abs(height - h) / (eps * (R + std::abs(height))));
  }
  return Case::judged(static_cast<double>(error), bound, all);
}

/// Allowed error in rounding errors of |r| + |h|, and of the latitude times the radius of rotation of the
/// point.
constexpr double allowed = 16;

TEST(RandomisedGeodesy, ClosestPointIsTheClosest) {
  randomised::randomised_test({.quick = 2000, .full = 600'000}, [](Draw& draw) {
    const Ellipsoid e = any_ellipsoid(draw);
    const Cartesian p = any_point(draw, e);
    const GeodeticPoint found = ClosestPoint(e)(p);
    if (found.outcome != Outcome::success) return Case::refused();
    return judged(p, e, found.position, allowed, "closest point");
  });
}

TEST(RandomisedGeodesy, FastTransformationsOfAllInstructionSets) {
  randomised::randomised_test({.quick = 1000, .full = 400'000}, [](Draw& draw) {
    const Ellipsoid e = draw.chance(0.5) ? Ellipsoid::wgs84() : any_ellipsoid(draw);
    const auto set = draw.one_of({InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512});
    if (!available(set)) return Case::undecided();
    const ReverseTransform reverse(e, set);
    std::array<double, 11> x{}, y{}, z{}, latitude{}, longitude{}, height{};
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Cartesian p = any_point(draw, e);
      x[i] = p.x, y[i] = p.y, z[i] = p.z;
    }
    if (reverse(x, y, z, latitude, longitude, height).non_finite > 0) return Case::refused();
    Case worst = Case::judged(0, 1, "");
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Cartesian p{x[i], y[i], z[i]};
      const Geodetic one = reverse(p).position;
      if (one.latitude != latitude[i] || one.longitude != longitude[i] || one.height != height[i])
        return Case::wrong(
            fmt::format("batch and single point differ at ({:.17g}, {:.17g}, {:.17g})", p.x, p.y, p.z));
      Case c = judged(p, e, one, allowed, std::string(to_string(set)));
      if (c.verdict == Case::Verdict::wrong) return c;
      if (c.ratio > worst.ratio) worst = c;
    }
    return worst;
  });
}

// Accuracy on the Earth as stated in the header: 4e-16 rad, and 2.5e-9 m below 100 km or 2.2e-8 m up to 35000
// km. The reference latitude is one Newton step in extended precision from the result.
TEST(RandomisedGeodesy, TheEarthToTheStatedAccuracy) {
  randomised::randomised_test({.quick = 2000, .full = 1'000'000}, [](Draw& draw) {
    const Ellipsoid e = Ellipsoid::wgs84();
    const double h = draw.uniform(-1e4, draw.chance(0.5) ? 1e5 : 3.5e7);
    const Cartesian p = forward(Geodetic{draw.uniform(-std::numbers::pi / 2, std::numbers::pi / 2),
                                         draw.uniform(-std::numbers::pi, std::numbers::pi), h},
                                e);
    const Geodetic g = ReverseTransform(e)(p).position;
    const Wide a = e.a(), b = a * (1 - Wide(e.f())), r = std::hypot(Wide(p.x), Wide(p.y)), z = p.z;
    const Wide c = std::cos(Wide(g.latitude)), s = std::sin(Wide(g.latitude)), D = std::hypot(a * c, b * s);
    const Wide dr = r - a * (a / D) * c, dz = z - b * (b / D) * s;
    const Wide latitude = std::abs((dz * c - dr * s) / (a * b / D * (a * b / D) / D + dr * c + dz * s));
    const Wide height = std::abs(dr * c + dz * s - g.height);
    const double error = std::max(static_cast<double>(latitude) / 4e-16,
                                  static_cast<double>(height) / (h < 1e5 ? 2.5e-9 : 2.2e-8));
    return Case::judged(error, 1, fmt::format("({:.17g}, {:.17g}, {:.17g}), h = {:.6g}", p.x, p.y, p.z, h));
  });
}

// The series reports its residual; a success is within a hundredth of the distance, and the reported residual
// is correct.
TEST(RandomisedGeodesy, TheSeriesKnowsItsMiss) {
  randomised::randomised_test({.quick = 1000, .full = 300'000}, [](Draw& draw) {
    const Ellipsoid e = any_ellipsoid(draw);
    const Cartesian p = any_point(draw, e);
    const PerturbationSeries method{draw.whole(1, highest_order),
                                    draw.chance(0.5) ? HeightFrom::series : HeightFrom::projection};
    const Reversed found = reverse(p, e, method);
    if (found.outcome != Outcome::success) return Case::refused();
    const BasicEllipsoid<Wide> wide(e.a(), e.f());
    const auto back = forward(
        BasicGeodetic<Wide>{found.position.latitude, found.position.longitude, found.position.height}, wide);
    const Wide miss = std::hypot(back.x - p.x, back.y - p.y, back.z - p.z);
    const Wide R = std::hypot(Wide(p.x), Wide(p.y), Wide(p.z)), size = std::max(wide.a(), wide.b());
    const std::string what =
        fmt::format("order {}: a = {:.17g}, f = {:.17g}, ({:.17g}, {:.17g}, {:.17g}), miss {:.3g} {:.3g}",
                    method.order, e.a(), e.f(), p.x, p.y, p.z, found.miss, static_cast<double>(miss));
    if (!(miss <= largest_relative_miss * (1 + 8 * eps) * R)) return Case::wrong(what);
    return Case::judged(static_cast<double>(std::abs(miss - Wide(found.miss)) / (eps * (R + size))),
                        rounding_of_miss, what);
  });
}

// Forward transformation for all ellipsoids and heights, against the same equation in extended precision
// without cancellation.
TEST(RandomisedGeodesy, ForwardOnEveryEllipsoid) {
  randomised::randomised_test({.quick = 2000, .full = 500'000}, [](Draw& draw) {
    const Ellipsoid e = any_ellipsoid(draw);
    const Geodetic g{draw.chance(0.8) ? draw.uniform(-std::numbers::pi / 2, std::numbers::pi / 2)
                                      : draw.signed_log(1e-300, 1.5),
                     draw.uniform(-std::numbers::pi, std::numbers::pi), e.a() * draw.signed_log(1e-18, 1e18)};
    const Cartesian p = forward(g, e);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return std::max(e.a(), e.b()) < 1e300 && std::abs(g.height) < 1e300 ? Case::wrong("overflow")
                                                                          : Case::refused();
    }
    const Wide a = e.a(), b = a * (1 - Wide(e.f())), c = std::cos(Wide(g.latitude)),
               s = std::sin(Wide(g.latitude));
    const Wide D = std::hypot(a * c, b * s), r = a * (a / D) * c + Wide(g.height) * c,
               h = std::abs(Wide(g.height));
    const Wide z = b * (b / D) * s + Wide(g.height) * s;
    const Wide x = r * std::cos(Wide(g.longitude)), y = r * std::sin(Wide(g.longitude));
    const Wide foot = std::hypot(a * (a / D) * c, b * (b / D) * s);
    return Case::judged(static_cast<double>(std::hypot(p.x - x, p.y - y, p.z - z) / (eps * (foot + h))), 8,
                        fmt::format("a = {:.17g}, f = {:.17g}, {:.17g} {:.17g} {:.17g}", e.a(), e.f(),
                                    g.latitude, g.longitude, g.height));
  });
}

}  // namespace
}  // namespace nlmech::geodesy::geodesy_test
