/// @file
/// Scenes and chapters, and the runs whose results scenes show.
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/program/machine.hpp"
#include "nlmech/scene/show.hpp"
#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

class Results;

/// Base of all runs: name, reading, and the runs that this one depends on.
class AnyRun {
 public:
  /// Dependencies.
  using List = std::vector<std::shared_ptr<const AnyRun>>;
  /// See the accessors of the same names.
  AnyRun(std::string name, std::string reading, List needs);
  AnyRun(const AnyRun&) = delete;
  AnyRun& operator=(const AnyRun&) = delete;
  virtual ~AnyRun();

  [[nodiscard]] const std::string& name() const { return name_; }        ///< "series-order-4"
  [[nodiscard]] const std::string& reading() const { return reading_; }  ///< interpretation of the source
  [[nodiscard]] const List& needs() const { return needs_; }             ///< runs that this one depends on

 private:
  std::string name_, reading_;
  List needs_;
};

/// One method on one problem with one setting; its result has type @p T.
template <class T>
class Run : public AnyRun {
 public:
  /// Computes the result from the results of the needed runs.
  using Compute = std::function<T(Results&)>;
  /// Constructed by Result.
  Run(std::string name, std::string reading, List needs, Compute compute)
      : AnyRun(std::move(name), std::move(reading), std::move(needs)), compute_(std::move(compute)) {}

 private:
  friend class Results;
  Compute compute_;
};

/// Cache of the results of a process: each is computed at its first use.
class Results {
 public:
  /// @param quick fewer samples and shorter timings, but the same methods; timings do not wait until a
  /// processor is free
  explicit Results(bool quick) : quick_(quick) {
    if (!quick) machine_.emplace();
  }

  /// Fewer samples and shorter timings?
  [[nodiscard]] bool quick() const { return quick_; }

  /// Call before each scene: waits for a free processor (Machine), unless quick. With many scenes left the
  /// program keeps its processor, so that a long chapter does not finish last.
  void wait_for_processor(std::size_t scenes_left);

  /// The run's result. @throws std::logic_error if another run of the same name has another reading or type
  template <class T>
  const T& get(const Run<T>& run) {
    Computed& computed = computed_[run.name()];
    if (!computed.value)
      computed = {std::make_shared<const T>(run.compute_(*this)), &typeid(T), run.reading()};
    if (*computed.type != typeid(T) || computed.reading != run.reading())
      throw std::logic_error("two results are named " + run.name());
    return *static_cast<const T*>(computed.value.get());
  }

 private:
  struct Computed {
    std::shared_ptr<const void> value;
    const std::type_info* type = nullptr;
    std::string reading;
  };

  bool quick_;
  std::optional<Machine> machine_;
  std::optional<Machine::Processor> processor_;
  std::map<std::string, Computed> computed_;  // by name
};

/// A named result that is computed when a scene first needs it. Copies, and results with the same name and
/// reading, are the same result.
template <class T>
class Result {
 public:
  /// @param name name, unique in the chapter
  /// @param reading interpretation of the source
  /// @param compute function of the needed results, each a `const T&`, or a `std::vector<const T*>` for a
  /// vector of results; an optional last argument is `bool quick`
  template <class Compute, class... Needs>
  Result(std::string name, std::string reading, Compute compute, const Needs&... needs);

  /// The run that computes the result.
  [[nodiscard]] const std::shared_ptr<const Run<T>>& run() const { return run_; }

 private:
  std::shared_ptr<const Run<T>> run_;
};

/// @cond
namespace needed {
using Runs = AnyRun::List;
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
template <class T>
const T& get(Results& all, const Result<T>& result) {
  return all.get(*result.run());
}
template <class T>
std::vector<const T*> get(Results& all, const std::vector<Result<T>>& results) {
  std::vector<const T*> found;
  for (const auto& r : results) found.push_back(&all.get(*r.run()));
  return found;
}
template <class Need>
using Got = decltype(get(std::declval<Results&>(), std::declval<const Need&>()));
/// Calls @p compute with the results, and with `quick` if it takes a bool.
template <class Compute, class... Needs>
decltype(auto) call(const Compute& compute, Results& all, const Needs&... needs) {
  if constexpr (std::invocable<const Compute&, Got<Needs>..., bool>)
    return compute(get(all, needs)..., all.quick());
  else
    return compute(get(all, needs)...);
}
}  // namespace needed
/// @endcond

template <class T>
template <class Compute, class... Needs>
Result<T>::Result(std::string name, std::string reading, Compute compute, const Needs&... needs)
    : run_(std::make_shared<const Run<T>>(
          std::move(name), std::move(reading), needed::all(needs...),
          [compute, needs...](Results& all) -> T { return needed::call(compute, all, needs...); })) {}
/// Deduces the type of the result from the return type of the function.
template <class Compute, class... Needs>
Result(std::string, std::string, Compute, const Needs&...)
    -> Result<std::decay_t<decltype(needed::call(std::declval<const Compute&>(), std::declval<Results&>(),
                                                 std::declval<const Needs&>()...))>>;

/// Content of a scene: a function that puts results on a Show, and these results.
struct Content {
  Content() = default;
  /// @param put called with the results, each as in Result, and the Show
  template <class Put, class... Needs>
  explicit Content(Put put, const Needs&... results)
      : needs(needed::all(results...)), show(shown([put, results...](Results& all, Show& to_show) {
          put(needed::get(all, results)..., to_show);
        })) {}
  needed::Runs needs = {};                     ///< runs of the results
  std::function<Showing(Results&)> show = {};  ///< puts the results on a Show

 private:
  static std::function<Showing(Results&)> shown(std::function<void(Results&, Show&)> put);
};

/// One figure or one table, the unit that a user can run.
struct Scene {
  std::string name;               ///< "fig-2.27"
  std::string title;              ///< quantity and finding
  std::string place = "our own";  ///< place in the source: "Figure 2.27"
  Content content = {};           ///< content
};

/// A subject of the publications with its scenes in their order.
class Chapter {
 public:
  /// @param name name of the folder and of the program
  /// @param title subject of the chapter
  /// @param scenes groups of scenes in their order
  /// @throws std::invalid_argument if two scenes have the same name
  Chapter(std::string name, std::string title, const std::vector<std::vector<Scene>>& scenes);

  /// The program's name.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The subject of the chapter.
  [[nodiscard]] const std::string& title() const { return title_; }
  /// All scenes in the given order.
  [[nodiscard]] const std::vector<Scene>& scenes() const { return scenes_; }
  /// The scene of that name. @throws InputError listing the scenes of the chapter for an unknown name
  [[nodiscard]] const Scene& scene(const std::string& name) const;

 private:
  std::string name_, title_;
  std::vector<Scene> scenes_;
};

/// Result of a scene and the runs behind it.
struct Performance {
  Showing showing;                  ///< figure, table and checks
  std::vector<const AnyRun*> runs;  ///< runs, sorted by name
};

/// Computes one scene. @throws std::logic_error if it has no figure and no table, an empty one, or no check
[[nodiscard]] Performance perform(const Scene& scene, Results& results);

}  // namespace nlmech::scene
