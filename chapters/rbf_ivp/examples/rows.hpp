/// @file
/// Rows of Tables 4.2, 4.4 and 4.6: a method with its settings, the results behind it, and which of their
/// values the printed error is compared with.
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

  /// Checks it.
  void check(const std::string& name, double value, scene::Show& show) const {
    show.between(name, value, low, high, reason);
  }
};

/// Four digits of tools/oracles/rbf_ivp_methods.py, or as many as are given.
[[nodiscard]] Expected about(double value, double relative, const char* reason);
/// A recorded range of results when nodes are moved by roundings, widened.
[[nodiscard]] Expected scattered(double low, double high);

/// A row of a table: how it is to be read, and the run behind it.
struct Row {
  std::string row;      ///< of `tables/published/elgohary.csv`: "RK4-1 (P/10)"; empty: no error is printed
  std::string method;   ///< in tables: "RK4-1"
  std::string setting;  ///< step, tolerance, order, nodes, in words without commas: "P/10"
  Points points = Points::ends;          ///< at which the error is taken
  int inferred_component = 0;            ///< whose error the printed one seems to be; the text says the first
  std::optional<Expected> nominal;       ///< of the nominal error
  std::optional<Expected> inferred;      ///< of the inferred error
  std::optional<Expected> literal = {};  ///< of the error with the period as printed
  std::string as_printed = {};           ///< settings as printed, in a figure that shows other ones too
  std::string as_inferred = {};          ///< those other ones
  const char* missing = "";              ///< what the text leaves out, so that it cannot be run; else empty
  std::optional<double> inferred_end = {};  ///< the end of the inferred reading, if not the example's

  std::string run = {};               ///< the name of its result without the example's: "rk4-1"
  std::string how = {};               ///< settings as printed, in words
  Procedure procedure = {};           ///< with them
  std::string how_inferred = {};      ///< settings of the inferred reading, in words
  Procedure inferred_procedure = {};  ///< with them; empty: those as printed
  Procedure literal_procedure = {};   ///< with the period as printed; empty: `procedure`

  /// RMS error to the printed end.
  [[nodiscard]] double nominal_error(const Record& record) const { return rms_error(record, 0, points); }
  /// RMS error under the inferred reading, to its end, which is @p until where the row has none of its own.
  [[nodiscard]] double inferred_error(const Record& record, double until) const {
    return rms_error(record, inferred_component, points, inferred_end.value_or(until));
  }
  /// The setting behind the printed number's two errors, in words: points, ends, component.
  [[nodiscard]] std::string setting_text(const Case& c) const;
};

/// An example with its rows.
struct Example {
  const Case& (*made)();       ///< free_duffing_case and its like; called only when a result is computed
  std::string name;            ///< begins the names of its results: "duffing"
  std::string title;           ///< in headings: "Free Duffing"
  std::string table;           ///< "table-4.2"
  std::string quantity;        ///< as in `elgohary.csv`: "position RMS error"
  double window;               ///< length of time before the end over which figures compare solutions, s
  std::vector<Row> rows = {};  ///< in the order of the table

  std::string borrowed = {};  ///< what no row of the table can do without, and where it is from

  /// Adds a row with its run, and with that of the inferred reading if it has other settings.
  void add(Row row, const std::string& run, const std::string& how, const Procedure& procedure,
           const std::string& how_inferred = {}, const Procedure& inferred = {}) {
    row.run = run;
    row.how = how;
    row.procedure = procedure;
    row.how_inferred = how_inferred;
    row.inferred_procedure = inferred;
    rows.push_back(std::move(row));
  }
  /// The row of a method. @throws std::out_of_range if there is none
  [[nodiscard]] const Row& row(const std::string& method) const {
    const auto found = std::ranges::find(rows, method, &Row::method);
    if (found == rows.end()) throw std::out_of_range("no row " + method);
    return *found;
  }
  /// The run with settings as printed, and the period as printed if the steps are fractions of it.
  [[nodiscard]] scene::Result<Record> literal(const Row& row) const {
    return row.literal_procedure ? recorded(row.run + "-printed-period", row.how, row.literal_procedure)
                                 : nominal(row);
  }
  /// The run with settings as printed; steps are fractions of the exact period.
  [[nodiscard]] scene::Result<Record> nominal(const Row& row) const {
    return recorded(row.run, row.how, row.procedure);
  }
  /// The same, unless the inferred reading has other settings.
  [[nodiscard]] scene::Result<Record> inferred(const Row& row) const {
    return row.inferred_procedure ? recorded(row.run + "-inferred", row.how_inferred, row.inferred_procedure)
                                  : nominal(row);
  }
  /// Time of the nominal run, ms.
  [[nodiscard]] scene::Result<double> time(const Row& row) const {
    return {name + "-" + row.run + "-time", row.how + "; one thread, median of nine, ms",
            [made = made, procedure = row.procedure](bool quick) {
              const Case& c = made();
              const auto once = [&] { static_cast<void>(procedure(c, c.t1, {})); };
              return 1e3 * time_repeats(once, quick ? 1 : 9).median;
            }};
  }

 private:
  [[nodiscard]] scene::Result<Record> recorded(const std::string& run, const std::string& how,
                                               const Procedure& procedure) const {
    return {name + "-" + run, how, [made = made, procedure, window = window] {
              return record(made(), made().t1, procedure, window);
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
