/// @file
/// Scenes and chapters: what a chapter can show, and what each showing needs.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nlmech/scene/published.hpp"
#include "nlmech/scene/run.hpp"
#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

/// A figure: the data, the template in `figures/templates` that draws them, and the template's variables.
struct Figure {
  Table data;                 ///< written to the folder results
  std::string template_name;  ///< "geodesy-error-map": figures/templates/geodesy-error-map.gp
  std::map<std::string, std::string> variables;  ///< texts for the template: heading, axis label
};

/// A number that a scene promises to lie in a range, with the reason for the range.
struct Quantity {
  std::string name;    ///< "max latitude error"
  std::string unit;    ///< "deg"; "1" if it has none
  double value = 0;    ///< what came out
  double low = 0;      ///< least value that keeps the promise
  double high = 0;     ///< greatest value that keeps the promise
  std::string reason;  ///< where the range comes from: an independent value and its accuracy

  /// Does the value lie in its range? Never, if it is NaN.
  [[nodiscard]] bool kept() const { return value >= low && value <= high; }
};

/// A quantity that should lie within a relative distance of a value known from elsewhere.
[[nodiscard]] Quantity near(std::string name, std::string unit, double value, double reference,
                            double relative, std::string reason);
/// A quantity that should not exceed a bound.
[[nodiscard]] Quantity at_most(std::string name, std::string unit, double value, double bound,
                               std::string reason);

/// What a scene gives back: a figure, a table, or both, and the quantities that it checks.
struct Showing {
  std::optional<Figure> figure;      ///< drawn by gnuplot
  std::optional<Table> table;        ///< written as Markdown and CSV
  std::vector<Quantity> quantities;  ///< at least one
};

/// One figure or one table: the smallest thing that a user asks for.
struct Scene {
  std::string name;                        ///< "fig-2.27"
  std::string title;                       ///< what there is to see
  std::string place;                       ///< "Figure 2.27", or "our own"
  std::vector<const AnyRun*> needs;        ///< the runs that it uses, and no others
  std::function<Showing(Workshop&)> show;  ///< computes it; no side effects
};

/// What we get for printed numbers: one measurement for each number that a chapter owns and that promises
/// something.
struct Measurement {
  std::string name;                            ///< as PublishedValue::name()
  std::vector<const AnyRun*> needs;            ///< runs, as for a scene
  std::function<Measured(Workshop&)> measure;  ///< our numbers
};

/// A subject of the publications: its runs, scenes and measurements, in the order in which they are told.
class Chapter {
 public:
  /// @param name the folder's and the program's
  /// @param title what the chapter is about
  Chapter(std::string name, std::string title);

  /// Declares a run; nothing is computed. The reference stays valid as long as the chapter.
  /// @throws std::invalid_argument if the chapter has a run of that name
  template <class Result>
  const Run<Result>& add_run(std::string name, std::string reading, std::vector<const AnyRun*> needs,
                             typename Run<Result>::Compute compute) {
    refuse_known_run(name);
    auto run = std::make_unique<Run<Result>>(std::move(name), std::move(reading), std::move(needs),
                                             std::move(compute));
    const Run<Result>& reference = *run;
    runs_.push_back(std::move(run));
    return reference;
  }
  /// @throws std::invalid_argument if the chapter has a scene of that name
  void add(Scene scene);
  /// @throws std::invalid_argument if the chapter has a measurement of that name
  void add(Measurement measurement);

  /// The program's name.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// What the chapter is about.
  [[nodiscard]] const std::string& title() const { return title_; }
  /// In the order in which they were added.
  [[nodiscard]] const std::vector<Scene>& scenes() const { return scenes_; }
  /// In the order in which they were added.
  [[nodiscard]] const std::vector<Measurement>& measurements() const { return measurements_; }
  /// @throws InputError naming the scenes there are
  [[nodiscard]] const Scene& scene(const std::string& name) const;

 private:
  void refuse_known_run(const std::string& name) const;

  std::string name_, title_;
  std::vector<std::unique_ptr<AnyRun>> runs_;
  std::vector<Scene> scenes_;
  std::vector<Measurement> measurements_;
};

/// A scene as it came out: what it shows, and the runs it rests on.
struct Performance {
  Showing showing;                  ///< the result
  std::vector<const AnyRun*> runs;  ///< sorted by name
};

/// Computes one scene. @throws std::logic_error if it shows nothing, checks nothing, or leaves a declared run
/// unused
[[nodiscard]] Performance perform(const Scene& scene, Workshop& workshop);

}  // namespace nlmech::scene
