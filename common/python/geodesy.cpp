#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>

#include "common/python/module.hpp"
#include "nlmech/geodesy/reverse_transform.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::python {
namespace {

using geodesy::Ellipsoid;
using geodesy::ReverseTransform;

/// Points for one call of the library, whose coordinates stay in the nearest cache, and for one thread at a
/// time.
constexpr std::size_t block = 512, portion = 16 * block;

/// Points without a finite result.
struct Lost {
  std::atomic<std::size_t> count = 0, first = std::numeric_limits<std::size_t>::max();
  void add(std::size_t some, std::size_t at) {
    if (some == 0) return;
    count += some;
    for (std::size_t now = first; at < now && !first.compare_exchange_weak(now, at);) {
    }
  }
};

/// Rows of three numbers by columns: NumPy takes a column as a vector without gaps.
using Columns = py::array_t<double, py::array::f_style>;

/// Runs `work(begin, end, to, lost)` for portions of the rows of @p points; @p to has the columns of the
/// result.
template <class Work>
Columns in_portions(const char* name, const Doubles& points, int threads, const Work& work) {
  const auto count = static_cast<std::size_t>(points.shape(0));
  Columns result({points.shape(0), py::ssize_t{3}});
  double* const data = result.mutable_data();
  const std::array<double*, 3> to = {data, data + count, data + 2 * count};
  Lost lost;
  unlocked([&] {
    share_out(count, portion, count > portion ? threads : 1,
              [&](std::size_t begin, std::size_t end) { work(begin, end, to, lost); });
    return true;
  });
  if (lost.count > 0)
    raise(failed_with(Outcome::non_finite,
                      "{}: {} of {} points have no finite result, the first at index {}: a number is NaN or "
                      "infinite, or the distance from the centre overflows",
                      name, lost.count.load(), count, lost.first.load()),
          result);
  return result;
}

/// Degrees of latitude and longitude, and height, for rows x, y, z.
Columns reverse(const Doubles& points, const Ellipsoid& ellipsoid, int threads) {
  const ReverseTransform transform(ellipsoid);
  const double* const from = points.data();
  return in_portions("geodesy.reverse", points, threads,
                     [&](std::size_t begin, std::size_t end, const auto& to, Lost& lost) {
                       std::array<double, block> x, y, z;
                       for (std::size_t i = begin; i < end; i += block) {
                         const std::size_t n = std::min(block, end - i);
                         for (std::size_t k = 0; k < n; ++k) {
                           const double* const p = from + 3 * (i + k);
                           x[k] = p[0];
                           y[k] = p[1];
                           z[k] = p[2];
                         }
                         const std::span latitude(to[0] + i, n), longitude(to[1] + i, n),
                             height(to[2] + i, n);
                         const auto report = transform({x.data(), n}, {y.data(), n}, {z.data(), n}, latitude,
                                                       longitude, height);
                         lost.add(report.non_finite, i + report.first_non_finite);
                         for (double& angle : latitude) angle /= degree;
                         for (double& angle : longitude) angle /= degree;
                       }
                     });
}

/// x, y, z for rows of degrees of latitude and longitude, and height.
Columns forward(const Doubles& points, const Ellipsoid& ellipsoid, int threads) {
  const double* const from = points.data();
  for (py::ssize_t i = 0; i < points.shape(0); ++i) {
    if (std::abs(from[3 * i]) > 90)
      throw invalid_argument("geodesy.forward: the latitude {} at index {} is not between -90 and 90",
                             from[3 * i], i);
  }
  return in_portions(
      "geodesy.forward", points, threads,
      [&](std::size_t begin, std::size_t end, const auto& to, Lost& lost) {
        for (std::size_t i = begin; i < end; ++i) {
          const double* const p = from + 3 * i;
          const SineCosine lat = sine_cosine_of_degrees(p[0]), lon = sine_cosine_of_degrees(p[1]);
          const auto r = geodesy::forward(lat.sine, lat.cosine, lon.sine, lon.cosine, p[2], ellipsoid);
          lost.add(std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.z) ? 0 : 1, i);
          to[0][i] = r.x;
          to[1][i] = r.y;
          to[2][i] = r.z;
        }
      });
}

}  // namespace

void add_geodesy(py::module_& module) {
  py::class_<Ellipsoid>(module, "Ellipsoid")
      .def(py::init<double, double>())
      .def_property_readonly("a", &Ellipsoid::a)
      .def_property_readonly("f", &Ellipsoid::f);
  py::dict named;
  named["wgs84"] = Ellipsoid::wgs84();
  for (const geodesy::NamedEllipsoid& e : geodesy::named_ellipsoids)
    named[py::str(std::string(e.name))] =
        Ellipsoid(e.a, e.inverse_flattening == 0 ? 0 : 1 / e.inverse_flattening);
  module.attr("ellipsoids") = named;
  module.def("reverse", &reverse);
  module.def("forward", &forward);
}

}  // namespace nlmech::python
