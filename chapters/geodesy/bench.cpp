/// @file
/// `geodesy_bench`: times of all timed_methods by Google Benchmark, and the claims about them. Exit code 1 if
/// a claim does not hold.
#include <memory>
#include <string>

#include "chapters/geodesy/timed_methods.hpp"
#include "chapters/speed.hpp"

namespace {

using namespace nlmech;

/// Adds all timed_methods on @p count points, and the claims about them.
void add_rows(chapters::Speed& all, std::size_t count) {
  const geodesy::Ellipsoid earth = geodesy::Ellipsoid::wgs84();
  const auto points =
      std::make_shared<chapters::geodesy::Points>(chapters::geodesy::sample_points(count, earth));
  const auto name_of = [count](const std::string& method) { return fmt::format("{} / {}", method, count); };
  for (const auto& method : chapters::geodesy::timed_methods(earth)) {
    chapters::Work work{name_of(method.name()),
                        chapters::keep_result([method, points] { method.pass(*points); })};
    work.points = static_cast<double>(count);
    all.add(work);
  }
  const auto claim = [&](const std::string& computed, const std::string& peer, double least) {
    all.claim(name_of(computed), name_of(peer), least,
              fmt::format("{} against {}, {} points", computed, peer, count));
  };
  const std::string peer = "GeographicLib, one point";
  claim("fast, one point", peer, 3);
  claim("fast, baseline only, one point", peer, 3);
  claim("fast, batch avx2", peer, 15);
  claim("fast, batch avx512", peer, 25);
  for (const std::string set : {"baseline", "avx2", "avx512"}) {
    for (const std::string method :
         {"Bowring 1976, 2 iterations", "Bowring 1985, 2 iterations", "Fukushima 2006, 2 iterations"}) {
      // Baseline: equally fast on one processor tested, a third faster on another.
      claim("fast, batch " + set, method + ", batch " + set, set == "baseline" ? 0.9 : 1);
    }
  }
}

void rows(chapters::Speed& all) {
  add_rows(all, 4096);     // fit into the second-level cache
  add_rows(all, 1000000);  // exceed the caches
}

}  // namespace

int main(int argc, char** argv) { return nlmech::chapters::speed_main("geodesy", &rows, argc, argv, "0.01"); }
