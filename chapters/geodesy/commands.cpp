#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "nlmech/geodesy/perturbation.hpp"
#include "nlmech/geodesy/reverse_transform.hpp"
#include "nlmech/scene/program/csv.hpp"
#include "nlmech/scene/program/files.hpp"
#include "nlmech/scene/program/options.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/support/errors.hpp"

namespace nlmech::chapters::geodesy {
namespace {

using nlmech::geodesy::Cartesian;
using nlmech::geodesy::Ellipsoid;
using nlmech::geodesy::Geodetic;

constexpr double degree = std::numbers::pi / 180;
const std::vector<std::string> cartesian_names = {"x", "y", "z"};
const std::vector<std::string> geodetic_names = {"latitude_deg", "longitude_deg", "height_m"};

/// What was typed.
struct Request {
  std::string file = "-", ellipsoid = "wgs84", method = "fast", height;
  std::optional<int> order;
};

void declare_forward(scene::Options& options, Request& request) {
  options.add("--ellipsoid", request.ellipsoid, "wgs84, or equatorial radius in metres and flattening: A,F");
  options.add("file", request.file, "CSV file; - is standard input");
}

void declare_reverse(scene::Options& options, Request& request) {
  options.add("--method", request.method, "full precision, or the series").one_of({"fast", "series"});
  options.add("--order", request.order, "order of the series, 4 without it")
      .range(1, nlmech::geodesy::highest_order);
  options
      .add("--height", request.height,
           "height from the series, as without it, or by projection on the normal")
      .one_of({"series", "projection"});
  declare_forward(options, request);
}

/// "wgs84", or equatorial radius and flattening: "6378137,0.00335" or "6378137,1/298.25".
Ellipsoid parse_ellipsoid(const std::string& text) {
  if (text == "wgs84") return Ellipsoid::wgs84();
  const auto refuse = [&](const std::string& why) {
    return InputError(
        fmt::format("--ellipsoid {}: {}; say wgs84, or A,F as in 6378137,1/298.257223563", text, why));
  };
  const auto comma = text.find(',');
  if (comma == std::string::npos) throw refuse("no comma");
  double a = 0, f = 0;
  if (!scene::parse_number(text.substr(0, comma), a)) throw refuse("A is not a number");
  std::string flattening = text.substr(comma + 1);
  const bool inverse = flattening.starts_with("1/");
  if (inverse) flattening.erase(0, 2);
  if (!scene::parse_number(flattening, f) || (inverse && f == 0)) throw refuse("F is not a number");
  try {
    return {a, inverse ? 1 / f : f};
  } catch (const std::invalid_argument& error) {
    throw refuse(error.what());
  }
}

std::string name_of(const std::string& file) { return file == "-" ? "standard input" : file; }

class CsvWriter {
 public:
  explicit CsvWriter(const std::vector<std::string>& names) {
    text_ = fmt::format("{}\n", fmt::join(names, ","));
  }
  void add(double a, double b, double c) {
    fmt::format_to(std::back_inserter(text_), "{:.17g},{:.17g},{:.17g}\n", a, b, c);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A result that misses its point by more than a metre is worth a word.
void warn_of_miss(double miss, std::size_t line, int order) {
  if (miss <= 1) return;
  scene::tell(
      fmt::format("geodesy: warning: the series of order {} misses the point of line {} by {:.2g} m; a "
                  "higher order misses "
                  "by less",
                  order, line, miss));
}

/// The points of the user's file by column, and what to call the file.
struct Input {
  std::string name;
  scene::NumberColumns points;
};

Input read_input(const Request& request, const std::vector<std::string>& names) {
  std::string name = name_of(request.file);
  scene::NumberColumns points = scene::parse_numbers(scene::read_whole(request.file), name, names);
  return {std::move(name), std::move(points)};
}

/// Full precision for every point. A finite point fails only where its distance from the centre overflows.
std::string reverse_fast(const Input& in, const Ellipsoid& ellipsoid) {
  const auto& [x, y, z] = std::tie(in.points.column[0], in.points.column[1], in.points.column[2]);
  std::vector<double> latitude(x.size()), longitude(x.size()), height(x.size());
  const auto report = nlmech::geodesy::ReverseTransform(ellipsoid)(x, y, z, latitude, longitude, height);
  if (report.non_finite > 0) {
    throw Failure(Status::failure(
        Outcome::non_finite,
        fmt::format("{}, line {}: the distance from the centre overflows; use smaller numbers", in.name,
                    in.points.line[report.first_non_finite])));
  }
  CsvWriter out(geodetic_names);
  for (std::size_t i = 0; i < x.size(); ++i) out.add(latitude[i] / degree, longitude[i] / degree, height[i]);
  return out.text();
}

std::string reverse_by_series(const Input& in, const Ellipsoid& ellipsoid, const Request& request) {
  using enum nlmech::geodesy::HeightFrom;
  const int order = request.order.value_or(4);
  const nlmech::geodesy::PerturbationSeries method{order,
                                                   request.height == "projection" ? projection : series};
  CsvWriter out(geodetic_names);
  double largest_miss = 0;
  std::size_t largest_line = 0;
  for (std::size_t i = 0; i < in.points.rows(); ++i) {
    const Cartesian p{in.points.column[0][i], in.points.column[1][i], in.points.column[2][i]};
    const nlmech::geodesy::Reversed found = nlmech::geodesy::reverse(p, ellipsoid, method);
    if (found.outcome != Outcome::success) {
      throw Failure(Status::failure(
          found.outcome,
          fmt::format("{}, line {}: the series of order {} does not hold at ({:g}, {:g}, {:g}) m; use "
                      "--method fast, which holds everywhere",
                      in.name, in.points.line[i], order, p.x, p.y, p.z)));
    }
    if (found.miss > largest_miss) {
      largest_miss = found.miss;
      largest_line = in.points.line[i];
    }
    out.add(found.position.latitude / degree, found.position.longitude / degree, found.position.height);
  }
  warn_of_miss(largest_miss, largest_line, order);
  return out.text();
}

std::string reverse(const Request& request) {
  const std::string belongs = "belongs to the series; add --method series, or leave it out";
  if (request.method == "fast" && request.order)
    throw InputError(fmt::format("--order {}: {}", *request.order, belongs));
  if (request.method == "fast" && !request.height.empty())
    throw InputError(fmt::format("--height {}: {}", request.height, belongs));
  const Ellipsoid ellipsoid = parse_ellipsoid(request.ellipsoid);
  try {
    static_cast<void>(nlmech::geodesy::ClosestPoint(ellipsoid));
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("--ellipsoid {}: {}", request.ellipsoid, error.what()));
  }
  const Input in = read_input(request, cartesian_names);
  return request.method == "fast" ? reverse_fast(in, ellipsoid) : reverse_by_series(in, ellipsoid, request);
}

std::string forward(const Request& request) {
  const Ellipsoid ellipsoid = parse_ellipsoid(request.ellipsoid);
  const auto [name, points] = read_input(request, geodetic_names);
  CsvWriter out(cartesian_names);
  for (std::size_t i = 0; i < points.rows(); ++i) {
    const double latitude = points.column[0][i];
    if (std::abs(latitude) > 90) {
      throw InputError(fmt::format("{}: line {}, column 1 (latitude_deg): {:g} is not between -90 and 90",
                                   name, points.line[i], latitude));
    }
    const Cartesian p = nlmech::geodesy::forward(
        Geodetic{latitude * degree, points.column[1][i] * degree, points.column[2][i]}, ellipsoid);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw Failure(Status::failure(
          Outcome::non_finite, fmt::format("{}, line {}: the position overflows", name, points.line[i])));
    }
    out.add(p.x, p.y, p.z);
  }
  return out.text();
}

}  // namespace

void commands(scene::Commands& all) {
  all.add("reverse", "x,y,z in metres to latitude_deg,longitude_deg,height_m", declare_reverse, reverse);
  all.add("forward", "latitude_deg,longitude_deg,height_m to x,y,z in metres", declare_forward, forward);
}

}  // namespace nlmech::chapters::geodesy
