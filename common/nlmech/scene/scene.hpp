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

#include "nlmech/scene/evidence/published.hpp"
#include "nlmech/scene/run.hpp"
#include "nlmech/scene/show.hpp"
#include "nlmech/scene/table.hpp"

namespace nlmech::scene {

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
