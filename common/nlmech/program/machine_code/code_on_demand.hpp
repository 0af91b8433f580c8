/// @file
/// Machine code that is made once there is enough work for it, and shared by all runs of a problem.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "nlmech/program/machine_code/machine_code.hpp"
#include "nlmech/program/tape.hpp"

namespace nlmech::machine_code {

/// A function in machine code that is made when it has been asked for often enough. Threads may share an
/// object.
template <class Function>
class CodeOnDemand {
 public:
  /// @param repays_after requests, 1 or more, after which the code is made: as many as repay the making
  explicit CodeOnDemand(int repays_after) : left_(repays_after) {}

  /// The code; null as long as the interpreter is to be used.
  /// @param make returns the code, or null if there is none; it is called once
  template <class Make>
  [[nodiscard]] Function* operator()(const Make& make) const {
    if (Function* const made = ready_.load(std::memory_order_acquire)) return made;
    // Threads may lose counts, which delays the code.
    const int left = left_.load(std::memory_order_relaxed);
    if (left == 0) return nullptr;
    left_.store(left - 1, std::memory_order_relaxed);
    if (left > 1) return nullptr;
    std::call_once(once_, [&] {
      owner_ = make();
      ready_.store(owner_.get(), std::memory_order_release);
    });
    return owner_.get();
  }

 private:
  mutable std::atomic<int> left_;
  mutable std::atomic<Function*> ready_ = nullptr;
  mutable std::shared_ptr<Function> owner_;
  mutable std::once_flag once_;
};

/// Code for one tape at one order.
using SeriesCode = CodeOnDemand<Coefficients>;

/// The code for the tapes of one problem: of its modes and segments, at several orders. Threads may share an
/// object.
class SeriesCodes {
 public:
  /// The code for @p tape; the same object for the same arguments. Only the latest are known: others start
  /// anew.
  /// @param lanes number of solutions in parallel, which tells the instruction set
  /// @param repays_after expansions, for a new object
  [[nodiscard]] std::shared_ptr<const SeriesCode> of(const Tape& tape, int order, int lanes,
                                                     int repays_after);

 private:
  struct Known {
    Tape tape;
    int order, lanes;
    std::shared_ptr<const SeriesCode> code;
  };
  // Equations that jump at many times have a tape for each segment.
  static constexpr std::size_t most_known = 32;

  std::mutex mutex_;
  std::vector<Known> known_;
};

}  // namespace nlmech::machine_code
