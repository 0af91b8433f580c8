#include "chapters/two_body_series/ensemble/propagate_all.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

#include "chapters/two_body_series/orbits/orbits.hpp"
#include "chapters/two_body_series/series/accuracy.hpp"
#include "nlmech/orbit/elements.hpp"
#include "nlmech/orbit/ensemble.hpp"
#include "nlmech/orbit/kepler.hpp"
#include "nlmech/scene/catalogue/catalogue.hpp"
#include "nlmech/scene/program/this_process.hpp"
#include "nlmech/scene/program/typed.hpp"
#include "nlmech/support/degrees.hpp"
#include "nlmech/support/sentences.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::two_body_series {
namespace {

enum Column : std::size_t { x, y, z, vx, vy, vz, mu, until };

/// Output lines per portion, at least; see scene::portion_for().
constexpr double lines_at_a_time = 16384;

orbit::State start_of(const std::vector<double>& row) {
  return {{row[x], row[y], row[z]}, {row[vx], row[vy], row[vz]}};
}

/// Error message for the state and mu of a row; empty if they are valid. @param given mu for all rows
std::string complaint_of_state(const std::vector<double>& row, const std::optional<double>& given) {
  if (row[x] == 0 && row[y] == 0 && row[z] == 0) return "x,y,z = 0,0,0 is the centre of attraction";
  if (row[mu] <= 0) return fmt::format("mu = {:.17g}: must be positive", row[mu]);
  if (!given && std::isnan(row[mu])) {
    const std::string why = inside_the_earth(start_of(row));
    if (!why.empty()) return fmt::format("x,y,z = {},{},{}: {}", row[x], row[y], row[z], why);
  }
  return {};
}

void refuse_doubled(const scene::Catalogue& catalogue, const char* column,
                    const std::optional<double>& option) {
  if (option && catalogue.has(column))
    throw input_error("--{} {}: {} has a column {}; leave out one of the two", column, *option,
                      catalogue.name(), column);
}

class OrbitCatalogue {
 public:
  explicit OrbitCatalogue(const CatalogueRequest& request)
      : request_(request),
        catalogue_(request.file, {"x", "y", "z", "vx", "vy", "vz"}, {"mu", "until"},
                   [this](const std::vector<double>& row) { return complaint(row); }) {
    refuse_doubled(catalogue_, "until", request.until);
    refuse_doubled(catalogue_, "mu", request.mu);
    if (!request.until && !catalogue_.has("until"))
      throw input_error("{}: has no column until; add the column, or give --until T for all rows",
                        catalogue_.name());
  }

  [[nodiscard]] int print() {
    catalogue_.set_row_weight([this](const std::vector<double>& row) { return 1 + lines_between(row); });
    scene::print_catalogue(catalogue_,
                           {.header = fmt::format("row,t,x,y,z,vx,vy,vz{}{},status", request_.columns.names(),
                                                  catalogue_.columns().rest_names(own_names())),
                            .portion = scene::portion_for(lines_at_a_time, request_.threads),
                            .work = [this](const scene::CatalogueRows& rows) {
                              const bool together = request_.method == "series" && !request_.columns.any();
                              return together ? by_series(rows) : orbit_by_orbit(rows);
                            }});
    if (low_ > 0)
      scene::print_message(
          fmt::format("two_body_series: {} of the orbits have rows with the status {}; the first is row "
                      "{}: {}",
                      low_, low_accuracy, first_low_, first_low_sentence_));
    if (failed_ == 0) return 0;
    scene::print_message(fmt::format("two_body_series: {} of the orbits failed; the first is row {}: {}",
                                     failed_, first_failed_, first_sentence_));
    return 1;
  }

 private:
  /// Names of output columns that a column of the file may have too.
  [[nodiscard]] std::vector<std::string> own_names() const {
    std::vector<std::string> own = {"row", "t", "status"};
    if (!request_.columns.any()) return own;
    std::istringstream names(request_.columns.names().substr(1));
    for (std::string name; std::getline(names, name, ',');) own.push_back(name);
    return own;
  }

  [[nodiscard]] double lines_between(const std::vector<double>& row) const {
    return request_.every ? std::abs(request_.until.value_or(row[until])) / *request_.every : 0;
  }

  /// Error message for an input row; empty if it is valid. Also called by the constructor of catalogue_, when
  /// only the members declared before catalogue_ exist.
  [[nodiscard]] std::string complaint(const std::vector<double>& row) const {
    if (std::string why = complaint_of_state(row, request_.mu); !why.empty()) return why;
    if (lines_between(row) > 1e7)
      return fmt::format("until = {:.17g}: more than 10 million rows at --every {}",
                         request_.until.value_or(row[until]), *request_.every);
    return {};
  }

  [[nodiscard]] orbit::PropagationRequest flight(const std::vector<double>& row) const {
    orbit::PropagationRequest f{start_of(row), 0, request_.field};
    f.until = request_.until ? *request_.until : row[until];
    f.gravity.mu = catalogue_.has("mu") ? row[mu] : request_.mu.value_or(earth_mu);
    return f;
  }

  /// Adds an output line; t + 0 avoids a time of -0.
  static void add_line(std::string& lines, std::int64_t row, double t, const orbit::State& s,
                       const std::string& rest, std::string_view status) {
    fmt::format_to(std::back_inserter(lines), "{},", row);
    append_state(lines, t + 0., s);
    fmt::format_to(std::back_inserter(lines), "{},{}\n", rest, status);
  }

  /// Adds the line of a computed state and its accuracy to that of the orbit.
  void add_computed(std::string& lines, std::int64_t row, double t, const orbit::State& s,
                    const std::string& rest, const orbit::PropagationRequest& f, OrbitAccuracy& ended) const {
    const ComputedBy by = computed_by(request_.method, request_.tolerance);
    add_line(lines, row, t, s, rest, ended.add(accuracy_of(s, f.start, t, f.gravity, by)));
  }

  void note(std::int64_t row, const OrbitAccuracy& ended) {
    if (!ended.status.ok() && failed_++ == 0) {
      first_failed_ = row;
      first_sentence_ = ended.status.text();
    }
    if (ended.status.ok() && ended.worst.off > 0 && low_++ == 0) {
      first_low_ = row;
      first_low_sentence_ = ended.worst.sentence;
    }
  }

  [[nodiscard]] std::string by_series(const scene::CatalogueRows& rows) {
    std::vector<orbit::PropagationRequest> flights;
    for (const auto& row : rows.numbers) flights.push_back(flight(row));
    const auto row_of = [&rows](std::size_t i) { return rows.first + static_cast<std::int64_t>(i); };
    std::vector<std::string> between(request_.every ? flights.size() : 0);
    std::vector<OrbitAccuracy> ended(flights.size());
    orbit::InnerRows inner;
    if (request_.every) {
      inner.every = *request_.every;
      inner.sink = [&](std::size_t i, double t, const orbit::State& s) {
        add_computed(between[i], row_of(i), t, s, rows.rest[i], flights[i], ended[i]);
      };
    }
    const auto ends =
        orbit::propagate_all(flights, {.tolerance = request_.tolerance, .threads = request_.threads}, inner,
                             {.seconds = std::max(0.0, request_.seconds - watch_.seconds())});
    std::string text =
        scene::lines_in_threads(ends.size(), request_.threads, [&](std::size_t i, std::string& lines) {
          if (request_.every) {
            if (flights[i].until != 0)
              add_line(lines, row_of(i), 0, flights[i].start, rows.rest[i], to_string(Outcome::success));
            lines += std::exchange(between[i], {});
          }
          if (ends[i].status.ok()) {
            add_computed(lines, row_of(i), ends[i].t, ends[i].x, rows.rest[i], flights[i], ended[i]);
          } else {
            ended[i].status = ends[i].status;
            add_line(lines, row_of(i), ends[i].t, ends[i].x, rows.rest[i],
                     to_string(ends[i].status.outcome()));
          }
        });
    for (std::size_t i = 0; i < ended.size(); ++i) note(row_of(i), ended[i]);
    return text;
  }

  /// Rows by Kepler's solution, or with transition matrices or covariances.
  [[nodiscard]] std::string orbit_by_orbit(const scene::CatalogueRows& rows) {
    std::vector<OrbitAccuracy> ended(rows.numbers.size());
    std::string text = scene::lines_in_threads(
        rows.numbers.size(), request_.threads, [&](std::size_t i, std::string& lines) {
          const orbit::PropagationRequest f = flight(rows.numbers[i]);
          const std::int64_t row = rows.first + static_cast<std::int64_t>(i);
          const auto add = [&](double t, const orbit::State& s, const orbit::TransitionMatrix& phi) {
            add_computed(lines, row, t, s, request_.columns.cells(phi) + rows.rest[i], f, ended[i]);
            return ended[i].status.ok();
          };
          const OrbitRequest r{.start = f.start,
                               .time = f.until,
                               .every = request_.every,
                               .gravity = f.gravity,
                               .tolerance = request_.tolerance,
                               .seconds = request_.seconds,
                               .columns = request_.columns,
                               .watch = watch_};
          if (r.every && r.time != 0) (void)add(0, r.start, orbit::TransitionMatrix::Identity());
          const auto run = propagate_with_transition(r, request_.method, r.inner_times(), add);
          if (!ended[i].status.ok()) return;
          if (run.end.status.ok()) {
            (void)add(r.time, run.end.x, run.transition);
          } else {
            ended[i].status = run.end.status;
            add_line(lines, row, run.end.t, run.end.x, request_.columns.cells(run.transition) + rows.rest[i],
                     to_string(run.end.status.outcome()));
          }
        });
    for (std::size_t i = 0; i < ended.size(); ++i) note(rows.first + static_cast<std::int64_t>(i), ended[i]);
    return text;
  }

  const CatalogueRequest& request_;
  Stopwatch watch_;
  scene::Catalogue catalogue_;
  std::int64_t failed_ = 0, first_failed_ = 0, low_ = 0, first_low_ = 0;
  std::string first_sentence_, first_low_sentence_;
};

}  // namespace

int print_orbits(const CatalogueRequest& request) { return OrbitCatalogue(request).print(); }

std::string element_cells(const orbit::State& state, double gravity) {
  const orbit::Elements e = orbit::elements_of(state, gravity);
  const double period = e.period(gravity);
  if (e.semi_major_axis > 0 && std::isfinite(e.semi_major_axis) && !(period > 0 && std::isfinite(period)))
    throw invalid_argument("the period is beyond the range of doubles; choose other units");
  const std::array numbers = {e.semi_major_axis,
                              e.eccentricity,
                              e.inclination / degree,
                              e.ascending_node / degree,
                              e.periapsis_argument / degree,
                              e.true_anomaly / degree,
                              period,
                              e.semi_latus_rectum,
                              e.periapsis_distance,
                              e.eccentric_anomaly / degree,
                              e.mean_anomaly / degree,
                              e.time_since_periapsis};
  return fmt::format("{:.17g}", fmt::join(numbers, ","));
}

int print_elements(const std::string& file, const std::optional<double>& given) {
  scene::Catalogue catalogue(
      file, {"x", "y", "z", "vx", "vy", "vz"}, {"mu"},
      [&given](const std::vector<double>& row) { return complaint_of_state(row, given); });
  refuse_doubled(catalogue, "mu", given);
  std::int64_t failed = 0;
  std::string first;
  const auto lines = [&](const scene::CatalogueRows& rows) {
    std::vector<std::string> why(rows.numbers.size());
    std::string text = scene::lines_in_threads(why.size(), 0, [&](std::size_t i, std::string& all) {
      const std::vector<double>& row = rows.numbers[i];
      std::string cells;
      try {
        cells = element_cells(start_of(row), catalogue.has("mu") ? row[mu] : given.value_or(earth_mu));
      } catch (const std::invalid_argument& error) {
        why[i] = error.what();
        cells.assign(std::ranges::count(element_columns, ','), ',');
      }
      const Outcome outcome = why[i].empty() ? Outcome::success : Outcome::outside_validity;
      all += fmt::format("{},{}{},{}\n", rows.first + static_cast<std::int64_t>(i), cells, rows.rest[i],
                         to_string(outcome));
    });
    for (std::size_t i = 0; i < why.size(); ++i) {
      if (!why[i].empty() && failed++ == 0)
        first = fmt::format("row {}: {}", rows.first + static_cast<std::int64_t>(i), why[i]);
    }
    return text;
  };
  std::vector<std::string> own = scene::split(element_columns, ',');
  own.insert(own.end(), {"row", "status"});
  scene::print_catalogue(catalogue, {.header = fmt::format("row,{}{},status", element_columns,
                                                           catalogue.columns().rest_names(own)),
                                     .portion = scene::portion_for(lines_at_a_time, 0),
                                     .work = lines});
  if (failed == 0) return 0;
  scene::print_message(
      fmt::format("two_body_series: {} of the states have no elements; the first is {}", failed, first));
  return 1;
}

}  // namespace nlmech::chapters::two_body_series
