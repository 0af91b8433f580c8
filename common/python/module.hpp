/// @file
/// Parts shared by the sources of the Python module: arrays, exceptions, and calls that Ctrl-C ends.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <string>
#include <string_view>
#include <vector>

#include "nlmech/support/status.hpp"

namespace nlmech::python {

namespace py = pybind11;

/// Argument of doubles in C order; other types and orders are converted.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The numbers of an array, in C order.
[[nodiscard]] inline std::vector<double> numbers_of(const Doubles& a) {
  return {a.data(), a.data() + a.size()};
}

/// A message of the library with arguments of Python in place of options: "--largest-step 1" becomes
/// "largest_step 1".
[[nodiscard]] std::string in_python(std::string_view message);

/// Raises nlmech.Failure. @param partial what was computed, or None
[[noreturn]] void raise(const Status& status, const py::object& partial);

/// Shared by a computation and the thread that waits for it.
struct Job {
  std::atomic<bool> stop = false;  ///< the computation shall end
  std::atomic<double> done = 0;    ///< share that is done, from 0 to 1

  /// Notes the share @p part; false if the computation shall end.
  bool reached(double part) {
    done.store(part, std::memory_order_relaxed);
    return !stop.load(std::memory_order_relaxed);
  }
};

/// Runs `work(job)` in another thread, without Python's lock. Every 50 ms the calling thread looks for
/// signals and calls @p progress with Job::done; after Ctrl-C or an exception of @p progress it sets
/// Job::stop, waits for the end of the computation and raises that exception.
template <class Work>
auto interruptible(const py::object& progress, const Work& work) {
  using namespace std::chrono_literals;
  Job job;
  std::exception_ptr raised;
  const py::gil_scoped_release release;
  auto result = std::async(std::launch::async, [&] { return work(job); });
  while (!raised && result.wait_for(50ms) != std::future_status::ready) {
    const py::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!progress.is_none()) progress(job.done.load());
    } catch (...) {
      raised = std::current_exception();
      job.stop = true;
    }
  }
  result.wait();
  if (raised) std::rethrow_exception(raised);
  return result.get();
}

void add_ivp(py::module_& module);         ///< integrate, compare, choose
void add_bvp(py::module_& module);         ///< boundary value problems
void add_orbit(py::module_& module);       ///< propagation, Lambert's problem, pork-chop grids
void add_geodesy(py::module_& module);     ///< geodetic coordinates
void add_structures(py::module_& module);  ///< frames and spacecraft

}  // namespace nlmech::python
