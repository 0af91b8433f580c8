/// @file
/// Rows of Tables 4.2, 4.4 and 4.6: a method with its settings, the results behind it, and which of their
/// values the printed error is held against.
#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "chapters/rbf_ivp/examples/runs.hpp"
#include "nlmech/scene/scene.hpp"
#include "nlmech/support/stopwatch.hpp"

namespace nlmech::chapters::rbf_ivp {

/// Where an error should lie, from numbers that were found without this library.
struct Expected {
  double low = 0;           ///< least value
  double high = 0;          ///< greatest value
  const char* reason = "";  ///< where the range comes from
  double recorded_low = 0;  ///< of rounding noise: the range as recorded, not widened
  double recorded_high = 0;

  /// Checks it.
  void check(const std::string& name, double value, scene::Show& show) const {
    show.between(name, value, low, high, reason);
  }
};

/// Four digits of tools/oracles/rbf_ivp_methods.py, or as many as are given.
[[nodiscard]] Expected about(double value, double relative, const char* reason);
/// A recorded range of results when nodes are moved by roundings, widened.
[[nodiscard]] Expected scattered(double low, double high);

/// How a row is to be read.
struct Reading {
  std::string row;      ///< of `tables/published/elgohary.csv`: "RK4-1 (P/10)"; empty: no error is printed
  std::string method;   ///< in tables: "RK4-1"
  std::string setting;  ///< step, tolerance, order, nodes, in words without commas: "P/10"
  Points points = Points::ends;      ///< at which the error is taken
  int inferred_component = 0;        ///< whose error the printed one seems to be; the text says the first
  std::optional<Expected> nominal;   ///< of the nominal error
  std::optional<Expected> inferred;  ///< of the inferred error
  std::string as_printed = {};       ///< settings as printed, in a figure that shows other ones too
  std::string as_inferred = {};      ///< those other ones
};

/// A row with its results.
struct Row {
  Reading reading;
  scene::Result<Record> nominal;   ///< settings as printed
  scene::Result<Record> inferred;  ///< the same, unless the inferred reading has other settings
  scene::Result<double> time;      ///< of the nominal run, ms; only the table shows it
  Procedure procedure;             ///< of the nominal run

  /// RMS error to the printed end.
  [[nodiscard]] double nominal_error(const Record& record) const {
    return rms_error(record, 0, reading.points);
  }
  /// RMS error to the end @p until under the inferred reading.
  [[nodiscard]] double inferred_error(const Record& record, double until) const {
    return rms_error(record, reading.inferred_component, reading.points, until);
  }
};

/// An example with its rows.
struct Example {
  const Case& (*made)();       ///< free_duffing_case and its like; called only when a result is computed
  std::string name;            ///< begins the names of its results: "duffing"
  std::string title;           ///< in headings: "Free Duffing"
  std::string table;           ///< "table-4.2"
  std::string quantity;        ///< as in `elgohary.csv`: "position RMS error"
  Keeping keeping;             ///< of its runs
  std::vector<Row> rows = {};  ///< in the order of the table

  /// Adds a row whose inferred reading has the settings as printed.
  /// @param run the result's name without the example's: "rk4-1"
  void add(Reading reading, const std::string& run, const std::string& how, const Procedure& procedure) {
    const auto result = recorded(run, how, procedure);
    rows.push_back({std::move(reading), result, result, timed(run, how, procedure), procedure});
  }
  /// Adds a row whose inferred reading has settings of its own.
  void add(Reading reading, const std::string& run, const std::string& how, const Procedure& as_printed,
           const std::string& how_inferred, const Procedure& inferred) {
    rows.push_back({std::move(reading), recorded(run, how, as_printed),
                    recorded(run + "-inferred", how_inferred, inferred), timed(run, how, as_printed),
                    as_printed});
  }
  /// The row of a method. @throws std::out_of_range if there is none
  [[nodiscard]] const Row& row(const std::string& method) const {
    const auto found =
        std::ranges::find(rows, method, [](const Row& r) -> const std::string& { return r.reading.method; });
    if (found == rows.end()) throw std::out_of_range("no row " + method);
    return *found;
  }

 private:
  [[nodiscard]] scene::Result<Record> recorded(const std::string& run, const std::string& how,
                                               const Procedure& procedure) const {
    return {name + "-" + run, how, [made = made, procedure, keeping = keeping] {
              return record(made(), made().t1, procedure, keeping);
            }};
  }
  [[nodiscard]] scene::Result<double> timed(const std::string& run, const std::string& how,
                                            const Procedure& procedure) const {
    return {name + "-" + run + "-time", how + "; one thread, median of nine, ms",
            [made = made, procedure](bool quick) {
              const Case& c = made();
              const auto once = [&] { static_cast<void>(procedure(c, c.t1, {})); };
              return 1e3 * time_repeats(once, quick ? 1 : 9).median;
            }};
  }
};

/// The rows of Table 4.2.
[[nodiscard]] Example free_duffing_rows();
/// The rows of Table 4.4.
[[nodiscard]] Example impact_rows();
/// The rows of Table 4.6.
[[nodiscard]] Example three_mass_rows();

/// The table as a scene, published beside ours, with what we get for each printed error.
[[nodiscard]] scene::Scene result_table(const Example& example);

}  // namespace nlmech::chapters::rbf_ivp
