/// @file
/// Rows of Tables 4.2, 4.4 and 4.6: a method with its settings, the runs behind it, and which of their values
/// the printed error is held against.
#pragma once

#include <optional>
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

/// A row with its runs.
template <int n>
struct Row {
  Reading reading;
  const scene::Run<Record<n>>* nominal;   ///< settings as printed
  const scene::Run<Record<n>>* inferred;  ///< the same run, unless the inferred reading has other settings
  const scene::Run<double>* time;         ///< of the nominal run, ms; only the table shows it
  Procedure<n> procedure;                 ///< of the nominal run

  /// RMS error to the printed end.
  [[nodiscard]] double nominal_error(scene::Workshop& w) const {
    return rms_error(w.result(*nominal), 0, reading.points);
  }
  /// RMS error to the end @p until under the inferred reading.
  [[nodiscard]] double inferred_error(scene::Workshop& w, double until) const {
    return rms_error(w.result(*inferred), reading.inferred_component, reading.points, until);
  }
  /// One run or two.
  [[nodiscard]] std::vector<const scene::AnyRun*> needs() const {
    if (nominal == inferred) return {nominal};
    return {nominal, inferred};
  }
};

/// An example with its rows.
template <int n>
struct Example {
  const Case<n>& (*made)();       ///< free_duffing_case and its like; called only when a run is computed
  std::string name;               ///< begins the names of its runs: "duffing"
  std::string title;              ///< in headings: "Free Duffing"
  std::string table;              ///< "table-4.2"
  std::string quantity;           ///< as in `elgohary.csv`: "position RMS error"
  Keeping keeping;                ///< of its runs
  std::vector<Row<n>> rows = {};  ///< in the order of the table

  /// Adds a row whose inferred reading has the settings as printed.
  /// @param run the run's name without the example's: "rk4-1"
  void add(scene::Chapter& chapter, Reading reading, const std::string& run, const std::string& how,
           Procedure<n> procedure) {
    const auto& added = add_run(chapter, run, how, procedure);
    const auto& time = add_time(chapter, run, how, procedure);
    rows.push_back({std::move(reading), &added, &added, &time, std::move(procedure)});
  }
  /// Adds a row whose inferred reading has settings of its own.
  void add(scene::Chapter& chapter, Reading reading, const std::string& run, const std::string& how,
           Procedure<n> as_printed, const std::string& how_inferred, Procedure<n> inferred) {
    const auto& nominal = add_run(chapter, run, how, as_printed);
    const auto& other = add_run(chapter, run + "-inferred", how_inferred, std::move(inferred));
    const auto& time = add_time(chapter, run, how, as_printed);
    rows.push_back({std::move(reading), &nominal, &other, &time, std::move(as_printed)});
  }
  /// The row of a method. @throws std::out_of_range if there is none
  [[nodiscard]] const Row<n>& row(const std::string& method) const {
    for (const Row<n>& r : rows) {
      if (r.reading.method == method) return r;
    }
    throw std::out_of_range("no row " + method);
  }

 private:
  const scene::Run<Record<n>>& add_run(scene::Chapter& chapter, const std::string& run,
                                       const std::string& how, Procedure<n> procedure) const {
    return chapter.add_run<Record<n>>(
        name + "-" + run, how, {},
        [made = made, procedure = std::move(procedure), keeping = keeping](scene::Workshop&) {
          return record<n>(made(), made().t1, procedure, keeping);
        });
  }
  const scene::Run<double>& add_time(scene::Chapter& chapter, const std::string& run, const std::string& how,
                                     Procedure<n> procedure) const {
    return chapter.add_run<double>(name + "-" + run + "-time", how + "; one thread, median of nine, ms", {},
                                   [made = made, procedure = std::move(procedure)](scene::Workshop& w) {
                                     const Case<n>& c = made();
                                     const auto once = [&] { static_cast<void>(procedure(c, c.t1, {})); };
                                     return 1e3 * time_repeats(once, w.quick() ? 1 : 9).median;
                                   });
  }
};

/// Declares the rows of Table 4.2 with their runs.
[[nodiscard]] Example<2> free_duffing_rows(scene::Chapter& chapter);
/// Declares the rows of Table 4.4 with their runs.
[[nodiscard]] Example<2> impact_rows(scene::Chapter& chapter);
/// Declares the rows of Table 4.6 with their runs.
[[nodiscard]] Example<6> three_mass_rows(scene::Chapter& chapter);

/// The table as a scene, published beside ours, and a measurement for each printed error.
void add_result_table(scene::Chapter& chapter, const Example<2>& example);
/// The same for the three masses.
void add_result_table(scene::Chapter& chapter, const Example<6>& example);

}  // namespace nlmech::chapters::rbf_ivp
