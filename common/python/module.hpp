/// @file
/// Parts shared by the sources of the Python module: arrays, exceptions, and calls that Ctrl-C ends.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nlmech/support/status.hpp"

namespace nlmech::python {

namespace py = pybind11;

/// Argument of doubles in C order; other types and orders are converted.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A message of the library with arguments of Python in place of options: "--largest-step 1" becomes
/// "largest_step 1".
[[nodiscard]] std::string in_python(std::string_view message);

/// Raises nlmech.Failure. @param partial what was computed, or None
[[noreturn]] void raise(const Status& status, const py::object& partial);

/// Lets a computation without Python's lock report how far it is, and end after Ctrl-C. For one thread, the
/// one that Python called.
class Job {
 public:
  /// @param progress called with the share that is done, or None
  explicit Job(const py::object& progress) : progress_(progress) {}

  /// Every 50 ms looks for signals and calls `progress` with the share @p done, from 0 to 1. False after
  /// Ctrl-C or an exception of `progress`: the computation shall end.
  [[nodiscard]] bool reached(double done) {
    using namespace std::chrono_literals;
    const auto now = std::chrono::steady_clock::now();
    if (raised_ || now < next_) return !raised_;
    next_ = now + 50ms;
    const py::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress_.is_none()) progress_(done);
    } catch (...) {
      raised_ = std::current_exception();
    }
    return !raised_;
  }
  /// Raises the exception that ended the computation, if there is one.
  void raise() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  const py::object& progress_;
  std::exception_ptr raised_;
  std::chrono::steady_clock::time_point next_ =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
};

/// Result of `work(job)` without Python's lock. @param progress see Job
template <class Work>
auto unlocked(const py::object& progress, const Work& work) {
  Job job(progress);
  try {
    std::optional<decltype(work(job))> result;
    {
      const py::gil_scoped_release release;
      result.emplace(work(job));
    }
    job.raise();
    return std::move(*result);
  } catch (...) {
    job.raise();  // rather than the failure of a computation that was interrupted
    throw;
  }
}
/// The same for work that nothing interrupts.
template <class Work>
auto unlocked(const Work& work) {
  return unlocked(py::none(), [&work](Job& /*job*/) { return work(); });
}

void add_ivp(py::module_& module);         ///< integrate, compare, choose
void add_bvp(py::module_& module);         ///< boundary value problems
void add_orbit(py::module_& module);       ///< propagation, Lambert's problem, pork-chop grids
void add_geodesy(py::module_& module);     ///< geodetic coordinates
void add_structures(py::module_& module);  ///< frames and spacecraft

}  // namespace nlmech::python
