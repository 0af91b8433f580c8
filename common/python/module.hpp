/// @file
/// Parts shared by the sources of the Python module: arrays, and calls without its lock, which Ctrl-C ends.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <exception>
#include <string>
#include <utility>

#include "nlmech/support/status.hpp"

namespace nlmech::python {

namespace py = pybind11;

/// Rows of numbers as NumPy has them.
template <class Number = double, int columns = Eigen::Dynamic>
using Rows = Eigen::Matrix<Number, Eigen::Dynamic, columns, Eigen::RowMajor>;

/// Outcome, such as "success", and sentence.
using StatusText = std::pair<std::string, std::string>;
/// Both of a status.
[[nodiscard]] inline StatusText text_of(const Status& status) {
  return {std::string(to_string(status.outcome())), status.sentence()};
}

/// Guard of functions without objects of Python: they run without its lock.
using Unlocked = py::call_guard<py::gil_scoped_release>;

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

/// Calls `work(job)` without Python's lock. @param progress see Job
template <class Work>
void unlocked(const py::object& progress, const Work& work) {
  Job job(progress);
  try {
    const py::gil_scoped_release release;
    work(job);
  } catch (...) {
    job.raise();  // rather than the failure of a computation that was interrupted
    throw;
  }
  job.raise();
}

void add_ivp(py::module_& module);         ///< integrate, compare, choose
void add_bvp(py::module_& module);         ///< boundary value problems
void add_orbit(py::module_& module);       ///< propagation, Lambert's problem, pork-chop grids
void add_geodesy(py::module_& module);     ///< geodetic coordinates
void add_structures(py::module_& module);  ///< frames and spacecraft

}  // namespace nlmech::python
