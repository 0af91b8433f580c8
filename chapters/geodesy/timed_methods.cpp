#include "chapters/geodesy/timed_methods.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "nlmech/geodesy/perturbation.hpp"
#include "nlmech/geodesy/reverse_transform.hpp"
#include "nlmech/peers/geodesy/geographiclib.hpp"
#include "nlmech/peers/geodesy/scalar_methods.hpp"
#include "nlmech/peers/geodesy/simd_peers.hpp"

namespace nlmech::chapters::geodesy {
namespace {

using nlmech::geodesy::Cartesian;
using nlmech::geodesy::Ellipsoid;
using nlmech::geodesy::Geodetic;
namespace peers = nlmech::peers::geodesy;

template <class Method>
TimedMethod one_by_one(const std::string& name, const Method& method) {
  return {.method = name, .batch = {}, .pass = [method](Points& p) {
            for (std::size_t i = 0; i < p.x.size(); ++i) p.set(i, method(p.at(i)));
          }};
}

void add_published(std::vector<TimedMethod>& all, const Ellipsoid& e) {
  all.push_back(one_by_one("Bowring 1976, 1 iteration", peers::Bowring1976<1>(e)));
  all.push_back(one_by_one("Bowring 1976, 2 iterations", peers::Bowring1976<2>(e)));
  all.push_back(one_by_one("Bowring 1985, 1 iteration", peers::Bowring1985<1>(e)));
  all.push_back(one_by_one("Bowring 1985, 2 iterations", peers::Bowring1985<2>(e)));
  all.push_back(one_by_one("Fukushima 2006, 1 iteration", peers::Fukushima2006<1>(e)));
  all.push_back(one_by_one("Fukushima 2006, 2 iterations", peers::Fukushima2006<2>(e)));
  all.push_back(one_by_one("Vermeille 2002", peers::Vermeille2002(e)));
  all.push_back(one_by_one("Vermeille 2011", peers::Vermeille2011(e)));
  all.push_back(one_by_one("Olson 1996", peers::Olson1996(e)));
  all.push_back(one_by_one("Heikkinen 1982", peers::Heikkinen1982(e)));
  all.push_back(one_by_one("Lin-Wang 1995, 1 iteration", peers::LinWang1995<1>(e)));
  all.push_back(one_by_one("Lin-Wang 1995, 2 iterations", peers::LinWang1995<2>(e)));
  all.push_back(one_by_one("Lin-Wang 1995, 3 iterations", peers::LinWang1995<3>(e)));
}

void add_geographiclib(std::vector<TimedMethod>& all, const Ellipsoid& e) {
  if (!peers::geographiclib_available()) return;
  all.push_back({.method = "GeographicLib", .batch = {}, .in_degrees = true, .pass = [e](Points& p) {
                   peers::geographiclib_reverse_degrees(e, p.x, p.y, p.z, p.latitude, p.longitude, p.height);
                 }});
}

void add_batches(std::vector<TimedMethod>& all, const Ellipsoid& e, InstructionSet set) {
  const nlmech::geodesy::ReverseTransform reverse(e, set);
  all.push_back({.method = "fast", .batch = set, .pass = [reverse](Points& p) {
                   static_cast<void>(reverse(p.x, p.y, p.z, p.latitude, p.longitude, p.height));
                 }});
  for (std::size_t m = 0; m < peers::simd_method_count; ++m) {
    const auto method = static_cast<peers::SimdMethod>(m);
    all.push_back({.method = std::string(to_string(method)),
                   .batch = set,
                   .answers = method != peers::SimdMethod::two_arctangents,
                   .pass = [e, method, set](Points& p) {
                     peers::run(method, set, e, p.x, p.y, p.z, p.latitude, p.longitude, p.height);
                   }});
  }
}

}  // namespace

std::string TimedMethod::name() const {
  return method + (batch ? ", batch " + std::string(to_string(*batch)) : std::string(", one point"));
}

std::vector<TimedMethod> timed_methods(const Ellipsoid& e) {
  std::vector<TimedMethod> all;
  const nlmech::geodesy::ReverseTransform fast(e), portable(e, InstructionSet::baseline);
  all.push_back(one_by_one("fast", [fast](const Cartesian& p) { return fast(p).position; }));
  all.push_back(
      one_by_one("fast, baseline only", [portable](const Cartesian& p) { return portable(p).position; }));
  all.push_back(one_by_one("series, order 4",
                           [e](const Cartesian& p) { return nlmech::geodesy::reverse(p, e, {}).position; }));
  add_geographiclib(all, e);
  add_published(all, e);
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (available(set)) add_batches(all, e, set);
  }
  return all;
}

std::vector<OnePointMethod> range_methods(const Ellipsoid& e) {
  const auto by_series = [e](int order) {
    return [e, order](const Cartesian& p) -> std::optional<Geodetic> {
      const nlmech::geodesy::Reversed found =
          nlmech::geodesy::reverse(p, e, {order, nlmech::geodesy::HeightFrom::projection});
      return found.outcome == Outcome::success ? std::optional(found.position) : std::nullopt;
    };
  };
  std::vector<OnePointMethod> methods = {
      {"series, order 4", by_series(4)},
      {"series, order 6", by_series(6)},
      {"Bowring 1976, 2 iterations", peers::Bowring1976<2>(e)},
      {"Vermeille 2011", peers::Vermeille2011(e)},
  };
  if (peers::geographiclib_available()) {
    methods.push_back(
        {"GeographicLib", [e](const Cartesian& p) { return peers::geographiclib_reverse(e, p); }});
  }
  const nlmech::geodesy::ReverseTransform fast(e);
  methods.push_back(
      {"fast", [fast](const Cartesian& p) -> std::optional<Geodetic> { return fast(p).position; }});
  return methods;
}

Points sample_points(std::size_t n, const Ellipsoid& ellipsoid) {
  // The standard defines mt19937_64 bit for bit, but not the distributions.
  std::mt19937_64 engine(1);
  const auto unit = [&engine] { return static_cast<double>(engine() >> 11U) * 0x1p-53; };
  Points points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double latitude = std::asin(2 * unit() - 1), longitude = (2 * unit() - 1) * std::numbers::pi;
    const double height = unit() < 0.5 ? -5e3 + 105e3 * unit() : 35e6 * unit();
    const Cartesian p = nlmech::geodesy::forward(Geodetic{latitude, longitude, height}, ellipsoid);
    const auto offset = [&unit] { return 1e-3 * (2 * unit() - 1); };
    points.x[i] = p.x + offset();
    points.y[i] = p.y + offset();
    points.z[i] = p.z + offset();
  }
  return points;
}

}  // namespace nlmech::chapters::geodesy
