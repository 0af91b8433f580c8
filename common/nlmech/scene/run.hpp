/// @file
/// Runs: computed once a process, however many scenes use them, and only if one does.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "nlmech/scene/machine.hpp"

namespace nlmech::scene {

class Workshop;

/// What all runs have in common: a name, the reading behind it, and the runs that it builds on.
class AnyRun {
 public:
  /// See the accessors of the same names.
  AnyRun(std::string name, std::string reading, std::vector<const AnyRun*> needs)
      : name_(std::move(name)), reading_(std::move(reading)), needs_(std::move(needs)) {}
  AnyRun(const AnyRun&) = delete;
  AnyRun& operator=(const AnyRun&) = delete;
  virtual ~AnyRun() = default;

  [[nodiscard]] const std::string& name() const { return name_; }  ///< "series-order-4"
  [[nodiscard]] const std::string& reading() const {
    return reading_;
  }  ///< how the source's text was understood
  /// Runs that this one asks for while it is computed.
  [[nodiscard]] const std::vector<const AnyRun*>& needs() const { return needs_; }

 private:
  std::string name_, reading_;
  std::vector<const AnyRun*> needs_;
};

/// One method on one problem with one setting, with a result of type @p Result.
template <class Result>
class Run : public AnyRun {
 public:
  /// Computes the result; asks the workshop for the runs that it needs.
  using Compute = std::function<Result(Workshop&)>;
  /// Made by Chapter::add_run().
  Run(std::string name, std::string reading, std::vector<const AnyRun*> needs, Compute compute)
      : AnyRun(std::move(name), std::move(reading), std::move(needs)), compute_(std::move(compute)) {}

 private:
  friend class Workshop;
  Compute compute_;
};

/// Where scenes get the results of runs. It lets through only what the scene has declared, and remembers what
/// was used.
class Workshop {
 public:
  /// @param quick fewer samples and shorter timings, never other methods; times are taken as they come,
  /// however many programs compute
  explicit Workshop(bool quick) : quick_(quick) {
    if (!quick) machine_.emplace();
  }

  /// Is less work asked for?
  [[nodiscard]] bool quick() const { return quick_; }

  /// To be called before each scene: waits for this program's turn to compute, unless quick. With many scenes
  /// left it keeps its turn, so that a long chapter is not the last and alone.
  void take_turn(std::size_t scenes_left);

  /// The run's result; computed at the first call.
  /// @throws std::logic_error if the scene at work, or the run at work, has not declared this run among its
  /// needs
  template <class T>
  const T& result(const Run<T>& run) {
    const AtWork at_work(*this, run);
    Kept& kept = kept_[run.name()];
    if (!kept.value) kept = {std::make_shared<const T>(run.compute_(*this)), &typeid(T), run.reading()};
    if (*kept.type != typeid(T) || kept.reading != run.reading())
      throw std::logic_error("two results are named " + run.name());
    return *static_cast<const T*>(kept.value.get());
  }

  /// Starts a scene: from here on only @p needs, and what they need in turn, is let through.
  void open(const std::string& scene, const std::vector<const AnyRun*>& needs);

  /// Names of the runs that the scene's result rests on, sorted: those asked for since open(), and what they
  /// need.
  [[nodiscard]] std::vector<std::string> used() const;

 private:
  struct Kept {
    std::shared_ptr<const void> value;
    const std::type_info* type = nullptr;
    std::string reading;
  };
  struct Desk {
    std::string name;
    std::vector<const AnyRun*> needs;
  };
  /// The run sits at the innermost desk until it is done, or has thrown.
  class AtWork {
   public:
    AtWork(Workshop& workshop, const AnyRun& run) : workshop_(workshop) { workshop_.begin(run); }
    AtWork(const AtWork&) = delete;
    AtWork& operator=(const AtWork&) = delete;
    ~AtWork() { workshop_.desks_.pop_back(); }

   private:
    Workshop& workshop_;
  };
  void begin(const AnyRun& run);
  void note(const AnyRun& run);

  bool quick_;
  std::optional<Machine> machine_;
  std::optional<Machine::Processor> processor_;
  std::vector<Desk> desks_;  // the scene, then the runs being computed, innermost last
  std::set<std::string> used_;
  std::map<std::string, Kept> kept_;  // results by name, computed at most once
};

}  // namespace nlmech::scene
