#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/python/module.hpp"
#include "nlmech/geodesy/reverse_transform.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::python {
namespace {

using geodesy::Ellipsoid;
using geodesy::ReverseTransform;

/// Points for one call of the library: six arrays of this length stay in the nearest cache.
constexpr std::size_t block = 512;
/// Points between two looks at Job::stop.
constexpr std::size_t portion = 1 << 18;

/// Runs `work(begin, end)` over portions of @p count points: in this thread if they are few.
template <class Work>
void in_portions(std::size_t count, const Work& work) {
  if (count <= 4096) return work(0, count);
  interruptible(py::none(), [&](Job& job) {
    for (std::size_t begin = 0; begin < count && !job.stop; begin += portion)
      work(begin, std::min(begin + portion, count));
  });
}

/// Degrees of latitude and longitude, and height, for rows x, y, z.
py::array_t<double> reverse(const Doubles& points, const Ellipsoid& ellipsoid) {
  const ReverseTransform transform(ellipsoid);
  py::array_t<double> result({points.shape(0), py::ssize_t{3}});
  const double* const from = points.data();
  double* const to = result.mutable_data();
  const auto count = static_cast<std::size_t>(points.shape(0));
  std::size_t lost = 0, first = 0;
  in_portions(count, [&](std::size_t begin, std::size_t end) {
    std::array<double, block> x, y, z;
    for (std::size_t i = begin; i < end; i += block) {
      const std::size_t n = std::min(block, end - i);
      for (std::size_t k = 0; k < n; ++k) {
        const double* const p = from + 3 * (i + k);
        x[k] = p[0];
        y[k] = p[1];
        z[k] = p[2];
      }
      const std::span<double> xs(x.data(), n), ys(y.data(), n), zs(z.data(), n);
      const auto report = transform(xs, ys, zs, xs, ys, zs);
      if (report.non_finite > 0 && lost == 0) first = i + report.first_non_finite;
      lost += report.non_finite;
      for (std::size_t k = 0; k < n; ++k) {
        double* const p = to + 3 * (i + k);
        p[0] = x[k] / degree;
        p[1] = y[k] / degree;
        p[2] = z[k];
      }
    }
  });
  if (lost > 0)
    raise(
        failed_with(
            Outcome::non_finite,
            "geodesy.reverse: {} of {} points have no finite result, the first at index {}: a coordinate is "
            "NaN or infinite, or the distance from the centre overflows",
            lost, count, first),
        result);
  return result;
}

/// x, y, z for rows of degrees of latitude and longitude, and height.
py::array_t<double> forward(const Doubles& points, const Ellipsoid& ellipsoid) {
  py::array_t<double> result({points.shape(0), py::ssize_t{3}});
  const double* const from = points.data();
  double* const to = result.mutable_data();
  const auto count = static_cast<std::size_t>(points.shape(0));
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(from[3 * i]) > 90)
      throw invalid_argument("geodesy.forward: the latitude {} at index {} is not between -90 and 90",
                             from[3 * i], i);
  }
  std::size_t lost = 0, first = 0;
  in_portions(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double* const p = from + 3 * i;
      const SineCosine lat = sine_cosine_of_degrees(p[0]), lon = sine_cosine_of_degrees(p[1]);
      const auto r = geodesy::forward(lat.sine, lat.cosine, lon.sine, lon.cosine, p[2], ellipsoid);
      if (!(std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.z)) && lost++ == 0) first = i;
      to[3 * i] = r.x;
      to[3 * i + 1] = r.y;
      to[3 * i + 2] = r.z;
    }
  });
  if (lost > 0)
    raise(failed_with(Outcome::non_finite,
                      "geodesy.forward: {} of {} positions are not finite, the first at index {}", lost,
                      count, first),
          result);
  return result;
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
