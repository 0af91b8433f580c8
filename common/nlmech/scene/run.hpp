/// @file
/// Runs: computed once a process, however many scenes use them, and only if one does.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "nlmech/scene/program/machine.hpp"

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

}  // namespace nlmech::scene
