/// @file
/// Scenes and chapters: what a chapter can show, and what each showing needs.
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

/// What all runs have in common: a name, the reading behind it, and the runs that it builds on.
class AnyRun {
 public:
  /// Runs that something needs.
  using List = std::vector<std::shared_ptr<const AnyRun>>;
  /// See the accessors of the same names.
  AnyRun(std::string name, std::string reading, List needs);
  AnyRun(const AnyRun&) = delete;
  AnyRun& operator=(const AnyRun&) = delete;
  virtual ~AnyRun();

  [[nodiscard]] const std::string& name() const { return name_; }        ///< "series-order-4"
  [[nodiscard]] const std::string& reading() const { return reading_; }  ///< how the text was understood
  [[nodiscard]] const List& needs() const { return needs_; }             ///< runs that are computed before

 private:
  std::string name_, reading_;
  List needs_;
};

/// One method on one problem with one setting, with a result of type @p T.
template <class T>
class Run : public AnyRun {
 public:
  /// Computes the result; takes those of the runs that it needs.
  using Compute = std::function<T(Results&)>;
  /// Made by Result.
  Run(std::string name, std::string reading, List needs, Compute compute)
      : AnyRun(std::move(name), std::move(reading), std::move(needs)), compute_(std::move(compute)) {}

 private:
  friend class Results;
  Compute compute_;
};

/// The results of a process: each computed at the first call, and kept.
class Results {
 public:
  /// @param quick fewer samples and shorter timings, never other methods; times are taken as they come,
  /// however many programs compute
  explicit Results(bool quick) : quick_(quick) {
    if (!quick) machine_.emplace();
  }

  /// Is less work asked for?
  [[nodiscard]] bool quick() const { return quick_; }

  /// To be called before each scene: waits for this program's turn to compute, unless quick. With many scenes
  /// left it keeps its turn, so that a long chapter is not the last and alone.
  void take_turn(std::size_t scenes_left);

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
/// With the effort, if the function wants to know it.
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
/// The type is that of what is computed.
template <class Compute, class... Needs>
Result(std::string, std::string, Compute, const Needs&...)
    -> Result<std::decay_t<decltype(needed::call(std::declval<const Compute&>(), std::declval<Results&>(),
                                                 std::declval<const Needs&>()...))>>;

/// What a scene shows: a function that puts results on a Show, and the results.
struct Content {
  Content() = default;
  /// @param put called with the results, each as in Result, and the Show
  template <class Put, class... Needs>
  explicit Content(Put put, const Needs&... results)
      : needs(needed::all(results...)), show(shown([put, results...](Results& all, Show& to_show) {
          put(needed::get(all, results)..., to_show);
        })) {}
  needed::Runs needs = {};                     ///< computed before
  std::function<Showing(Results&)> show = {};  ///< called with them

 private:
  static std::function<Showing(Results&)> shown(std::function<void(Results&, Show&)> put);
};

/// One figure or one table: the smallest thing that a user asks for.
struct Scene {
  std::string name;               ///< "fig-2.27"
  std::string title;              ///< what there is to see
  std::string place = "our own";  ///< "Figure 2.27"
  Content content = {};           ///< what it shows
};

/// A subject of the publications: its scenes, in the order in which they are told.
class Chapter {
 public:
  /// @param name the folder's and the program's
  /// @param title what the chapter is about
  /// @param scenes in the order in which they are told
  /// @throws std::invalid_argument if two scenes have the same name
  Chapter(std::string name, std::string title, const std::vector<std::vector<Scene>>& scenes);

  /// The program's name.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// What the chapter is about.
  [[nodiscard]] const std::string& title() const { return title_; }
  /// In the order in which they were given.
  [[nodiscard]] const std::vector<Scene>& scenes() const { return scenes_; }
  /// @throws InputError naming the scenes there are
  [[nodiscard]] const Scene& scene(const std::string& name) const;

 private:
  std::string name_, title_;
  std::vector<Scene> scenes_;
};

/// A scene as it came out: what it shows, and the runs it rests on.
struct Performance {
  Showing showing;                  ///< what it shows
  std::vector<const AnyRun*> runs;  ///< sorted by name
};

/// Computes one scene. @throws std::logic_error if it shows nothing, has an empty figure or table, or checks
/// nothing
[[nodiscard]] Performance perform(const Scene& scene, Results& results);

}  // namespace nlmech::scene
