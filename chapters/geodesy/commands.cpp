#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "nlmech/geodesy/perturbation.hpp"
#include "nlmech/geodesy/reverse_transform.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"
#include "nlmech/support/sentences.hpp"

namespace nlmech::chapters::geodesy {
namespace {

using nlmech::geodesy::Cartesian;
using nlmech::geodesy::Ellipsoid;
using nlmech::geodesy::Geodetic;

/// Columns of a file of points in Cartesian or geodetic coordinates.
struct Coordinates {
  std::vector<std::string> read;   ///< input columns with their alternative names
  std::vector<std::string> write;  ///< output columns
};
const Coordinates cartesian = {{"x", "y", "z"}, {"x", "y", "z"}};
Coordinates geodetic(bool in_metres) {
  return {{"latitude_deg|latitude|lat", "longitude_deg|longitude|lon", "height_m|height|h"},
          {"latitude_deg", "longitude_deg", in_metres ? "height_m" : "height"}};
}

/// Options of the commands.
struct Request {
  std::string file = "-", ellipsoid = "wgs84", method = "fast", height;
  std::optional<int> order;
};

/// The ellipsoid, and whether its unit is the metre.
struct Shape {
  Ellipsoid ellipsoid = Ellipsoid::wgs84();
  bool in_metres = true;
};

std::string names_of_ellipsoids() {
  std::string all = "wgs84";
  for (const auto& named : nlmech::geodesy::named_ellipsoids) all.append(", ").append(named.name);
  return all;
}

void declare_common(scene::Options& options, Request& request, const char* columns) {
  options.add(
      "--ellipsoid", request.ellipsoid,
      fmt::format("{} (in any case), or equatorial radius and flattening, A,F or A,1/N, in the unit of "
                  "the coordinates",
                  names_of_ellipsoids()));
  options.add("file", request.file,
              fmt::format("CSV file with the columns {}, in any order and case, or with these alone and no "
                          "header; other columns are passed through; - is standard input",
                          columns));
}

void declare_forward(scene::Options& options, Request& request) {
  declare_common(options, request,
                 "latitude_deg (or latitude, lat), longitude_deg (longitude, lon), height_m "
                 "(height, h)");
  options.footer(
      "At a pole x = y = 0, so the longitude is lost. If a point is so deep that another point of the "
      "ellipsoid is nearer (in the Earth below -6335 km), reverse returns the coordinates that belong to the "
      "nearest point.");
}

void declare_reverse(scene::Options& options, Request& request) {
  options.add("--method", request.method, "full precision, or the series").one_of({"fast", "series"});
  options.add("--order", request.order, "order of the series (default 4)")
      .range(1, nlmech::geodesy::highest_order);
  options.add("--height", request.height, "height from the series (default) or by projection on the normal")
      .one_of({"series", "projection"});
  declare_common(options, request, "x, y, z");
  options.footer(
      "Latitude and longitude are those of the nearest point of the ellipsoid, and the height is the "
      "distance from it, negative inside. On the equatorial disc about the centre of an oblate ellipsoid "
      "(42.7 km in the Earth) two points are nearest: z = 0 gives the northern one, z = -0 the southern; the "
      "centre itself has the latitude 90. On the axis the longitude is 0, or 180 for x = -0.");
}

/// The name in lower case without blanks, hyphens and underscores: "WGS 84" is wgs84.
std::string plain_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    if (c >= 'A' && c <= 'Z')
      name += static_cast<char>(c - 'A' + 'a');
    else if (c != ' ' && c != '-' && c != '_')
      name += c;
  }
  return name;
}

/// Parses a name, or equatorial radius and flattening: "6378137,0.00335" or "6378137,1/298.25".
/// @throws InputError
Shape parse_ellipsoid(const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    return input_error("--ellipsoid {}: {}; give {}, or A,F as in 6378137,1/298.257223563",
                       quoted_input(text), why, names_of_ellipsoids());
  };
  const auto comma = text.find(',');
  if (comma == std::string::npos) {
    const std::string name = plain_name(text);
    if (name == "wgs84") return {};
    for (const auto& known : nlmech::geodesy::named_ellipsoids) {
      if (name == known.name)
        return {{known.a, known.inverse_flattening == 0 ? 0 : 1 / known.inverse_flattening}, true};
    }
    throw refuse("no such name, and no comma");
  }
  double a = 0, f = 0;
  if (!scene::parse_number(text.substr(0, comma), a)) throw refuse("A is not a number");
  std::string flattening = text.substr(comma + 1);
  flattening.erase(0, flattening.find_first_not_of(' '));
  const bool inverse = flattening.starts_with("1/");
  if (inverse) flattening.erase(0, 2);
  if (!scene::parse_number(flattening, f) || (inverse && f == 0)) throw refuse("F is not a number");
  if (!inverse && f >= 1)
    throw refuse(fmt::format("F = {} must be below 1 (the inverse of a flattening is written 1/{})", f, f));
  try {
    return {{a, inverse ? 1 / f : f}, false};
  } catch (const std::invalid_argument& error) {
    throw refuse(error.what());
  }
}

std::string name_of(const std::string& file) { return file == "-" ? "standard input" : file; }

/// The points of the input file by column, and the name of the file in messages.
struct Input {
  std::string name;
  scene::NumberColumns points;
};

Input read_input(const Request& request, const Coordinates& from, const Coordinates& to) {
  std::string name = name_of(request.file);
  scene::NumberColumns points =
      scene::parse_numbers(scene::read_whole(request.file), name, from.read, to.write);
  if (points.rows() == 0) scene::print_no_rows(name);
  return {std::move(name), std::move(points)};
}

/// Writer of the output CSV; the other columns of the file are passed through.
class CsvWriter {
 public:
  CsvWriter(const Input& in, const Coordinates& to) : points_(in.points) {
    text_ = fmt::format("{}{}\n", fmt::join(to.write, ","), points_.rest_names);
  }
  void add(std::size_t row, double a, double b, double c) {
    fmt::format_to(std::back_inserter(text_), "{:.17g},{:.17g},{:.17g}{}\n", a, b, c, points_.rest[row]);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  const scene::NumberColumns& points_;
  std::string text_;
};

/// Reverse transformation by ReverseTransform. @throws Failure if the distance of a point from the centre
/// overflows
std::string reverse_fast(const Input& in, const Shape& shape) {
  const auto& [x, y, z] = std::tie(in.points.column[0], in.points.column[1], in.points.column[2]);
  std::vector<double> latitude(x.size()), longitude(x.size()), height(x.size());
  const auto report =
      nlmech::geodesy::ReverseTransform(shape.ellipsoid)(x, y, z, latitude, longitude, height);
  if (report.non_finite > 0) {
    throw Failure(failed_with(Outcome::non_finite,
                              "{}, line {}: the distance from the centre overflows; use smaller numbers",
                              in.name, in.points.line[report.first_non_finite]));
  }
  CsvWriter out(in, geodetic(shape.in_metres));
  for (std::size_t i = 0; i < x.size(); ++i)
    out.add(i, latitude[i] / degree, longitude[i] / degree, height[i]);
  return out.text();
}

/// Error of the series against ClosestPoint.
struct SeriesError {
  double latitude = 0, height = 0;  ///< rad; unit of the coordinates
  double total = 0;  ///< norm of latitude error (rad) and height error over max(a, b, |height|)
};

SeriesError error_of(const Geodetic& found, const Geodetic& nearest, const Ellipsoid& e) {
  const double latitude = std::abs(found.latitude - nearest.latitude);
  const double height = std::abs(found.height - nearest.height);
  return {latitude, height,
          std::hypot(latitude, height / std::max({e.a(), e.b(), std::abs(nearest.height)}))};
}

/// Smallest SeriesError::total that is reported; 0.6 m for the Earth.
constexpr double negligible_error = 1e-7;

std::string reverse_by_series(const Input& in, const Shape& shape, const Request& request) {
  using enum nlmech::geodesy::HeightFrom;
  const int order = request.order.value_or(4);
  const nlmech::geodesy::PerturbationSeries method{order,
                                                   request.height == "projection" ? projection : series};
  const nlmech::geodesy::ClosestPoint closest(shape.ellipsoid);
  CsvWriter out(in, geodetic(shape.in_metres));
  SeriesError largest;
  std::size_t largest_line = 0;
  for (std::size_t i = 0; i < in.points.rows(); ++i) {
    const Cartesian p{in.points.column[0][i], in.points.column[1][i], in.points.column[2][i]};
    const nlmech::geodesy::Reversed found = nlmech::geodesy::reverse(p, shape.ellipsoid, method);
    const SeriesError error = error_of(found.position, closest(p).position, shape.ellipsoid);
    if (found.outcome != Outcome::success || !(error.total <= nlmech::geodesy::largest_relative_miss)) {
      throw Failure(failed_with(found.outcome == Outcome::success ? Outcome::outside_validity : found.outcome,
                                "{}, line {}: the series of order {} is not valid at ({:g}, {:g}, {:g}); use "
                                "--method fast, which is valid everywhere",
                                in.name, in.points.line[i], order, p.x, p.y, p.z));
    }
    if (error.total > largest.total) {
      largest = error;
      largest_line = in.points.line[i];
    }
    out.add(i, found.position.latitude / degree, found.position.longitude / degree, found.position.height);
  }
  if (largest.total > negligible_error)
    scene::print_message(fmt::format(
        "geodesy: warning: at line {} the series of order {} is off by {:.2g} degrees of "
        "latitude and by {:.2g}{} of height; --method fast is exact to rounding",
        largest_line, order, largest.latitude / degree, largest.height, shape.in_metres ? " m" : ""));
  return out.text();
}

std::string reverse(const Request& request) {
  const std::string belongs = "belongs to the series; add --method series, or leave it out";
  if (request.method == "fast" && request.order) throw input_error("--order {}: {}", *request.order, belongs);
  if (request.method == "fast" && !request.height.empty())
    throw input_error("--height {}: {}", request.height, belongs);
  const Shape shape = parse_ellipsoid(request.ellipsoid);
  try {
    static_cast<void>(nlmech::geodesy::ClosestPoint(shape.ellipsoid));
  } catch (const std::invalid_argument& error) {
    throw input_error("--ellipsoid {}: {}", quoted_input(request.ellipsoid), error.what());
  }
  const Input in = read_input(request, cartesian, geodetic(shape.in_metres));
  return request.method == "fast" ? reverse_fast(in, shape) : reverse_by_series(in, shape, request);
}

/// Is another point of the ellipsoid nearer, because the point lies beyond the equatorial plane of an oblate
/// ellipsoid, or beyond the axis of a prolate one?
bool is_beyond(const SineCosine& latitude, double height, const Ellipsoid& e) {
  const double ratio = 1 - e.f();
  return height < -e.a() * std::min(1.0, ratio * ratio) / std::hypot(latitude.cosine, ratio * latitude.sine);
}

std::string forward(const Request& request) {
  const Shape shape = parse_ellipsoid(request.ellipsoid);
  const Input in = read_input(request, geodetic(shape.in_metres), cartesian);
  CsvWriter out(in, cartesian);
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < in.points.rows(); ++i) {
    const double latitude = in.points.column[0][i], height = in.points.column[2][i];
    if (std::abs(latitude) > 90)
      throw input_error("{}: line {}: latitude_deg = {} is not between -90 and 90", in.name,
                        in.points.line[i], latitude);
    const SineCosine lat = sine_cosine_of_degrees(latitude);
    const SineCosine lon = sine_cosine_of_degrees(in.points.column[1][i]);
    const Cartesian p =
        nlmech::geodesy::forward(lat.sine, lat.cosine, lon.sine, lon.cosine, height, shape.ellipsoid);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Failure(failed_with(Outcome::non_finite, "{}, line {}: the position overflows", in.name,
                                in.points.line[i]));
    if (beyond == 0 && is_beyond(lat, height, shape.ellipsoid)) beyond = in.points.line[i];
    out.add(i, p.x, p.y, p.z);
  }
  if (beyond > 0)
    scene::print_message(
        fmt::format("geodesy: note: the point of line {} is so deep that another point of the ellipsoid is "
                    "nearer; reverse returns the coordinates of the nearest point",
                    beyond));
  return out.text();
}

}  // namespace

void commands(scene::Commands& all) {
  all.add("reverse", "Convert x,y,z to latitude_deg,longitude_deg,height_m (height with an ellipsoid A,F)",
          declare_reverse, reverse);
  all.add("forward", "Convert latitude_deg,longitude_deg,height_m to x,y,z", declare_forward, forward);
}

}  // namespace nlmech::chapters::geodesy
