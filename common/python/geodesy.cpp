#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

#include "common/python/module.hpp"
#include "nlmech/geodesy/reverse_transform.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/threads.hpp"

namespace nlmech::python {
namespace {

using geodesy::Ellipsoid;
using geodesy::ReverseTransform;

/// Points of one call of the library, and of one thread at a time. The coordinates of 512 points would lie a
/// page apart, where loads wait for stores of the same offset.
constexpr std::size_t block = 128, portion = 64 * block;

/// Rows of three numbers in any order of memory.
using Points = py::array_t<double, py::array::forcecast>;
/// The same by columns: NumPy takes a column as a vector without gaps.
using Columns = py::array_t<double, py::array::f_style>;

/// Coordinates of the points of a block, each without gaps.
using Block = std::array<std::array<double, block>, 3>;

/// Result, and the number of points without a finite one.
using Transformed = std::pair<Columns, std::size_t>;

/// Runs `work(count, from, to)` for blocks of @p points: it reads @p from, writes columns of the result and
/// returns the number of points without a finite result.
template <class Work>
Transformed in_blocks(const Points& points, int threads, const Work& work) {
  const auto count = static_cast<std::size_t>(points.shape(0));
  const auto value = points.unchecked<2>();
  Columns result({points.shape(0), py::ssize_t{3}});
  double* const data = result.mutable_data();
  const std::array<double*, 3> columns = {data, data + count, data + 2 * count};
  std::atomic<std::size_t> lost = 0;
  {
    const py::gil_scoped_release release;
    share_out(count, portion, count > portion ? threads : 1, [&](std::size_t begin, std::size_t end) {
      Block from;
      for (std::size_t i = begin; i < end; i += block) {
        const std::size_t n = std::min(block, end - i);
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t c = 0; c < 3; ++c) from[c][k] = value(i + k, c);
        lost += work(n, from, std::array{columns[0] + i, columns[1] + i, columns[2] + i});
      }
    });
  }
  return {std::move(result), lost.load()};
}

/// Turns radians into degrees, with the same bits for each instruction set. By index: of a function with
/// clones clang 16 does not emit the iterators.
#if defined(__x86_64__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void to_degrees(std::span<double> angles) {
  for (std::size_t i = 0; i < angles.size(); ++i) angles[i] /= degree;
}

/// Degrees of latitude and longitude, and height, for rows x, y, z.
Transformed reverse(const Points& points, const Ellipsoid& ellipsoid, int threads) {
  const ReverseTransform transform(ellipsoid);
  return in_blocks(points, threads, [&](std::size_t n, const Block& from, const auto& to) {
    const std::span latitude(to[0], n), longitude(to[1], n);
    const auto report = transform({from[0].data(), n}, {from[1].data(), n}, {from[2].data(), n}, latitude,
                                  longitude, {to[2], n});
    to_degrees(latitude);
    to_degrees(longitude);
    return report.non_finite;
  });
}

/// x, y, z for rows of degrees of latitude and longitude, and height.
Transformed forward(const Points& points, const Ellipsoid& ellipsoid, int threads) {
  const auto value = points.unchecked<2>();
  for (py::ssize_t i = 0; i < value.shape(0); ++i) {
    if (std::abs(value(i, 0)) > 90)
      throw invalid_argument("geodesy.forward: the latitude {} at index {} is not between -90 and 90",
                             value(i, 0), i);
  }
  return in_blocks(points, threads, [&](std::size_t n, const Block& from, const auto& to) {
    std::size_t lost = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const SineCosine lat = sine_cosine_of_degrees(from[0][k]), lon = sine_cosine_of_degrees(from[1][k]);
      const auto r = geodesy::forward(lat.sine, lat.cosine, lon.sine, lon.cosine, from[2][k], ellipsoid);
      if (!(std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.z))) ++lost;
      to[0][k] = r.x;
      to[1][k] = r.y;
      to[2][k] = r.z;
    }
    return lost;
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
