/// @file
/// Rows of Tables 4.2, 4.4 and 4.6: methods with settings, their runs, and the values compared with the
/// printed errors.
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

/// Expected range of an error.
struct Expected {
  double low = 0;           ///< least value
  double high = 0;          ///< largest value
  const char* reason = "";  ///< source of the range

  /// Checks that @p value is in the range.
  void check(const std::string& name, double value, scene::Show& show) const {
    show.between(name, value, low, high, reason);
  }
};

/// Range @p value (1 -+ @p relative), usually for four digits of tools/oracles/rbf_ivp_methods.py.
[[nodiscard]] Expected about(double value, double relative, const char* reason);
/// Recorded range of results under rounding changes of the nodes, widened by a factor of 3.
[[nodiscard]] Expected scattered(double low, double high);

/// A table row: its interpretation and its runs.
struct Row {
  std::string row;      ///< row of `tables/published/elgohary.csv`: "RK4-1 (P/10)"; empty: no printed error
  std::string method;   ///< name in tables, such as "RK4-1"
  std::string setting;  ///< step, tolerance, order, nodes as text, such as "P/10"
  Points points = Points::ends;      ///< points at which the error is taken
  int inferred_component = 0;        ///< component of the printed error, inferred; the text states the first
  std::optional<Expected> nominal;   ///< range of the nominal error
  std::optional<Expected> inferred;  ///< range of the inferred error
  std::optional<Expected> literal = {};     ///< range of the error with the printed period
  std::string as_printed = {};              ///< label of the printed settings in a figure with both
  std::string as_inferred = {};             ///< label of the inferred settings in such a figure
  const char* missing = "";                 ///< setting that the text does not state; empty if it states all
  std::optional<double> inferred_end = {};  ///< end time of the inferred reading, if not the example's

  std::string run = {};               ///< name of the result without that of the example: "rk4-1"
  std::string how = {};               ///< printed settings as text
  Procedure procedure = {};           ///< run with the printed settings
  std::string how_inferred = {};      ///< settings of the inferred reading as text
  Procedure inferred_procedure = {};  ///< run with the inferred settings; empty: `procedure`
  Procedure literal_procedure = {};   ///< run with the printed period; empty: `procedure`

  /// RMS error to the printed end.
  [[nodiscard]] double nominal_error(const Record& record) const { return rms_error(record, 0, points); }
  /// RMS error of the inferred reading to inferred_end, or to @p until if the row has none.
  [[nodiscard]] double inferred_error(const Record& record, double until) const {
    return rms_error(record, inferred_component, points, inferred_end.value_or(until));
  }
  /// Settings of the nominal and the inferred error as text: points, end times, component.
  [[nodiscard]] std::string setting_text(const Case& c) const;
};

/// An example with its rows.
struct Example {
  const Case& (*made)();       ///< free_duffing_case or similar; called only when a result is computed
  std::string name;            ///< prefix of the names of results, such as "duffing"
  std::string title;           ///< in headings, such as "Free Duffing"
  std::string table;           ///< table of the source, such as "table-4.2"
  std::string quantity;        ///< quantity in `elgohary.csv`, such as "position RMS error"
  double window;               ///< length of the final time interval in which figures compare solutions, s
  std::vector<Row> rows = {};  ///< in the order of the table

  std::string borrowed = {};  ///< data needed by all rows that are taken from another source

  /// Adds a row with its run, and the run of the inferred reading if that has other settings.
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
  /// The run with the printed settings, and with the printed period if the steps are fractions of it.
  [[nodiscard]] scene::Result<Record> literal(const Row& row) const {
    return row.literal_procedure ? recorded(row.run + "-printed-period", row.how, row.literal_procedure)
                                 : nominal(row);
  }
  /// The run with the printed settings; steps are fractions of the exact period.
  [[nodiscard]] scene::Result<Record> nominal(const Row& row) const {
    return recorded(row.run, row.how, row.procedure);
  }
  /// The run of the inferred reading; nominal() unless that has other settings.
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

/// Scene of the table with printed and computed errors.
[[nodiscard]] scene::Scene result_table(const Example& example);

}  // namespace nlmech::chapters::rbf_ivp
