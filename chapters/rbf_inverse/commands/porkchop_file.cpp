#include "chapters/rbf_inverse/commands/porkchop_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "chapters/toml_file.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/errors.hpp"
#include "nlmech/support/quoted_input.hpp"

namespace nlmech::chapters::rbf_inverse {
namespace {

/// Table of the file with its path for messages: "from", or "" for the root table.
class Reader {
 public:
  Reader(const toml::table& table, std::string name, std::string path)
      : table_(table), name_(std::move(name)), path_(std::move(path)) {}

  [[noreturn]] void refuse(const toml::node* node, const std::string& text) const {
    const auto line = node != nullptr ? node->source().begin.line : table_.source().begin.line;
    throw InputError(fmt::format("{}, line {}: {}", name_, line, text));
  }
  [[nodiscard]] std::string full(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  }
  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
  [[nodiscard]] std::optional<double> number(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    return number_of(node, key);
  }
  [[nodiscard]] double required(std::string_view key) const {
    const auto value = number(key);
    if (!value) refuse(nullptr, fmt::format("{} is missing", full(key)));
    return *value;
  }
  [[nodiscard]] orbit::Vector3<double> vector(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) refuse(nullptr, fmt::format("{} is missing", full(key)));
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() != 3)
      refuse(node, fmt::format("{} must be three numbers", full(key)));
    return {number_of(list->get(0), key), number_of(list->get(1), key), number_of(list->get(2), key)};
  }
  [[nodiscard]] Reader table(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) refuse(nullptr, fmt::format("the table [{}] is missing", full(key)));
    if (node->as_table() == nullptr) refuse(node, fmt::format("{} must be a table", full(key)));
    return {*node->as_table(), name_, full(key)};
  }
  /// Rejects unknown keys.
  void only(std::initializer_list<std::string_view> known) const {
    for (const auto& [key, node] : table_) {
      if (std::find(known.begin(), known.end(), key.str()) == known.end())
        refuse(&node, fmt::format("{}: no such key; the keys are {}", full(quoted_input(key.str())),
                                  fmt::join(known, ", ")));
    }
  }
  [[nodiscard]] const toml::node* at(std::string_view key) const { return table_.get(key); }

 private:
  [[nodiscard]] double number_of(const toml::node* node, std::string_view key) const {
    return chapters::number_of(name_, *node, full(key));
  }

  const toml::table& table_;
  std::string name_, path_;
};

orbit::Conic shape_of(const Reader& r) {
  const double e = r.required("e");
  if (r.has("a") == r.has("p"))
    r.refuse(r.at("p"), fmt::format("give one of {} and {}", r.full("a"), r.full("p")));
  if (e < 0) r.refuse(r.at("e"), fmt::format("{} = {} must be 0 or more", r.full("e"), e));
  if (r.has("a")) {
    try {
      return {orbit::from_axis(r.required("a"), e).periapsis_distance, 1 - e};
    } catch (const std::invalid_argument& error) {
      r.refuse(r.at("a"), fmt::format("{} = {}: {}", r.full("a"), r.required("a"), error.what()));
    }
  }
  const double p = r.required("p");
  if (!(p > 0)) r.refuse(r.at("p"), fmt::format("{} = {} must be positive", r.full("p"), p));
  return {p / (1 + e), 1 - e};
}

/// Angle in degrees; 0 if the key is missing.
double angle_of(const Reader& r, std::string_view key, double least, double most) {
  const double value = r.number(key).value_or(0);
  if (!(value >= least && value <= most))
    r.refuse(r.at(key),
             fmt::format("{} = {} must be from {} to {} degrees", r.full(key), value, least, most));
  return value;
}

/// Range of lengths and mu in which the computation of a grid neither overflows nor underflows.
constexpr double least_size = 1e-100, largest_size = 1e100;

void check_size(const Reader& r, std::string_view key, double size) {
  if (!(size >= least_size && size <= largest_size))
    r.refuse(r.at(key),
             fmt::format("{} makes a size of {:.6g}; it must be from {:g} to {:g}, so choose other units",
                         r.full(key), size, least_size, largest_size));
}

orbit::Ephemeris orbit_of(const Reader& r, double mu) {
  orbit::Ephemeris body;
  body.epoch = r.number("epoch").value_or(0);
  if (r.has("position") || r.has("velocity")) {
    r.only({"position", "velocity", "epoch"});
    body.state = {r.vector("position"), r.vector("velocity")};
    if (body.state.position.isZero(0)) r.refuse(r.at("position"), r.full("position") + " is the centre");
    check_size(r, "position", body.state.position.stableNorm());
    return body;
  }
  r.only({"a", "p", "e", "i", "raan", "argp", "nu", "epoch"});
  const orbit::Conic conic = shape_of(r);
  const orbit::Orientation orientation{sine_cosine_of_degrees(angle_of(r, "i", 0, 180)),
                                       sine_cosine_of_degrees(angle_of(r, "raan", -360, 360)),
                                       sine_cosine_of_degrees(angle_of(r, "argp", -360, 360))};
  const double nu = angle_of(r, "nu", -360, 360);
  try {
    body.state = orbit::state_at_true_anomaly(conic, orientation, sine_cosine_of_degrees(nu / 2), mu);
  } catch (const std::invalid_argument& error) {
    r.refuse(r.at("nu"), fmt::format("{}: {}", r.full("nu"), error.what()));  // past the asymptote
  }
  check_size(r, r.has("a") ? "a" : "p", body.state.position.stableNorm());
  return body;
}

orbit::Window window_of(const Reader& r) {
  r.only({"first", "last"});
  orbit::Window window{.first = r.required("first"), .last = r.required("last")};
  if (window.last < window.first)
    r.refuse(r.at("last"),
             fmt::format("{} = {} is before the first, {}", r.full("last"), window.last, window.first));
  return window;
}

}  // namespace

orbit::PorkchopProblem read_porkchop(const std::string& text, const std::string& name) {
  const toml::table table = parse_toml(text, name);
  const Reader whole(table, name, "");
  whole.only({"mu", "from", "to", "departures", "arrivals", "revolutions"});
  orbit::PorkchopProblem p;
  p.mu = whole.required("mu");
  if (!(p.mu > 0)) whole.refuse(whole.at("mu"), fmt::format("mu = {} must be positive", p.mu));
  check_size(whole, "mu", p.mu);
  p.from = orbit_of(whole.table("from"), p.mu);
  p.to = orbit_of(whole.table("to"), p.mu);
  p.departures = window_of(whole.table("departures"));
  p.arrivals = window_of(whole.table("arrivals"));
  if (p.arrivals.last <= p.departures.first)
    whole.refuse(whole.at("arrivals"), fmt::format("arrivals.last = {} is not after departures.first = {}: "
                                                   "there is no time for a transfer",
                                                   p.arrivals.last, p.departures.first));
  const double revolutions = whole.number("revolutions").value_or(0);
  if (!(revolutions >= 0 && revolutions <= 1000 && revolutions == std::floor(revolutions)))
    whole.refuse(whole.at("revolutions"),
                 fmt::format("revolutions = {} must be a whole number from 0 to 1000", revolutions));
  p.most_revolutions = static_cast<int>(revolutions);
  return p;
}

std::string porkchop_keys() {
  return R"(Keys of the TOML file, in any consistent units:
  mu                    gravitational parameter of the centre, positive; required
  revolutions           largest number of complete revolutions, 0 to 1000 (default 0)
  [from], [to]          orbit of departure and orbit of arrival
    a or p              semi-major axis (negative for hyperbolas) or semi-latus rectum
    e                   eccentricity, 0 or more
    i                   inclination, 0 to 180 degrees (default 0)
    raan, argp, nu      ascending node, argument of periapsis, true anomaly at the epoch, -360 to 360 degrees (default 0)
    position, velocity  [x, y, z] in place of the elements
    epoch               time of the anomaly or of the state (default 0)
  [departures]          first, last: range of departure times
  [arrivals]            first, last: range of arrival times
Example: chapters/rbf_inverse/earth-mars.toml.)";
}

std::string porkchop_csv(const orbit::Porkchop& grid) {
  std::string text = "departure,arrival,v_departure,v_arrival,revolutions\n";
  for (std::size_t i = 0; i < grid.departures.size(); ++i) {
    for (std::size_t j = 0; j < grid.arrivals.size(); ++j) {
      const orbit::PorkchopCell& cell = grid.at(i, j);
      if (cell.exists())
        fmt::format_to(std::back_inserter(text), "{:.17g},{:.17g},{:.17g},{:.17g},{}\n", grid.departures[i],
                       grid.arrivals[j], cell.v_departure, cell.v_arrival, cell.revolutions);
    }
  }
  return text;
}

}  // namespace nlmech::chapters::rbf_inverse
