/// @file
/// Scenes and chapters: what a chapter can show, and what each showing needs.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "nlmech/scene/published.hpp"
#include "nlmech/scene/run.hpp"
#include "nlmech/scene/show.hpp"
#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

/// A quantity that should lie within a relative distance of a value known from elsewhere.
[[nodiscard]] Quantity near(std::string name, std::string unit, double value, double reference,
                            double relative, std::string reason);
/// A quantity that should not exceed a bound.
[[nodiscard]] Quantity at_most(std::string name, std::string unit, double value, double bound,
                               std::string reason);

/// A result that scenes show: named, and computed when a scene first asks for it. A value: copies are the
/// same result, and so are results of one name and reading.
template <class T>
class Result {
 public:
  /// @param name among the chapter's results
  /// @param reading how the source's text was understood
  /// @param compute a function of the results needed, each a `const T&`, or a `std::vector<const T*>` where
  /// several of one type were given as a vector; and last, if it wants to know, of whether less work is asked
  /// for
  template <class Compute, class... Needs>
  Result(std::string name, std::string reading, Compute compute, const Needs&... needs);

  /// Without its type.
  [[nodiscard]] const std::shared_ptr<const Run<T>>& run() const { return run_; }

 private:
  std::shared_ptr<const Run<T>> run_;
};

/// @cond
namespace needed {
using Runs = std::vector<std::shared_ptr<const AnyRun>>;
template <class T>
void list(Runs& runs, const Result<T>& result) {
  runs.push_back(result.run());
}
template <class T>
void list(Runs& runs, const std::vector<Result<T>>& results) {
  for (const auto& r : results) runs.push_back(r.run());
}
template <class... Needs>
Runs all(const Needs&... needs) {
  Runs runs;
  (list(runs, needs), ...);
  return runs;
}
inline std::vector<const AnyRun*> pointers(const Runs& runs) {
  std::vector<const AnyRun*> all;
  for (const auto& r : runs) all.push_back(r.get());
  return all;
}
template <class T>
const T& get(Workshop& w, const Result<T>& result) {
  return w.result(*result.run());
}
template <class T>
std::vector<const T*> get(Workshop& w, const std::vector<Result<T>>& results) {
  std::vector<const T*> all;
  for (const auto& r : results) all.push_back(&w.result(*r.run()));
  return all;
}
template <class Need>
using Got = decltype(get(std::declval<Workshop&>(), std::declval<const Need&>()));
/// With the effort, if the function wants to know it.
template <class Compute, class... Needs>
decltype(auto) call(const Compute& compute, Workshop& w, const Needs&... needs) {
  if constexpr (std::invocable<const Compute&, Got<Needs>..., bool>)
    return compute(get(w, needs)..., w.quick());
  else
    return compute(get(w, needs)...);
}
}  // namespace needed
/// @endcond

template <class T>
template <class Compute, class... Needs>
Result<T>::Result(std::string name, std::string reading, Compute compute, const Needs&... needs)
    : run_(std::make_shared<const Run<T>>(
          std::move(name), std::move(reading), needed::pointers(needed::all(needs...)),
          [compute, needs...](Workshop& w) -> T { return needed::call(compute, w, needs...); })) {}
/// The type is that of what is computed.
template <class Compute, class... Needs>
Result(std::string, std::string, Compute, const Needs&...)
    -> Result<std::decay_t<decltype(needed::call(std::declval<const Compute&>(), std::declval<Workshop&>(),
                                                 std::declval<const Needs&>()...))>>;

/// What a scene shows: a function that puts results on a Show, and the results.
struct Content {
  Content() = default;
  /// @param put called with the results, each as in Result, and the Show
  template <class Put, class... Needs>
  explicit Content(Put put, const Needs&... results)
      : needs(needed::all(results...)), show([put, results...](Workshop& w) {
          Show to_show(w.quick());
          put(needed::get(w, results)..., to_show);
          return to_show.take();
        }) {}
  needed::Runs needs = {};                      ///< computed before
  std::function<Showing(Workshop&)> show = {};  ///< called with them
};

/// One figure or one table: the smallest thing that a user asks for.
struct Scene {
  std::string name;                             ///< "fig-2.27"
  std::string title;                            ///< what there is to see
  std::string place = "our own";                ///< "Figure 2.27"
  Content content = {};                         ///< what it shows
  std::vector<const AnyRun*> needs = {};        ///< the runs that it uses, and no others
  std::function<Showing(Workshop&)> show = {};  ///< computes it; no side effects
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
  /// @param scenes in the order in which they are told
  Chapter(std::string name, std::string title, std::vector<std::vector<Scene>> scenes);

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
