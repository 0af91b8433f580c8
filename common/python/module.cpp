#include "common/python/module.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "nlmech/support/errors.hpp"

namespace nlmech::python {
namespace {

void refuse(const std::exception& error) {
  const py::object message = py::module_::import("nlmech._failure").attr("in_python")(error.what());
  PyErr_SetObject(PyExc_ValueError, message.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const Failure& failure) {
    const Status& status = failure.status();
    const py::object raised = py::module_::import("nlmech").attr("Failure")(
        status.ok() ? failure.what() : status.sentence(),
        std::string(to_string(status.ok() ? Outcome::not_converged : status.outcome())));
    PyErr_SetObject(py::type::handle_of(raised).ptr(), raised.ptr());
  } catch (const InputError& error) {
    refuse(error);
  } catch (const std::invalid_argument& error) {
    refuse(error);
  }
}

}  // namespace
}  // namespace nlmech::python

PYBIND11_MODULE(_core, module) {
  using namespace nlmech::python;
  module.doc() = "Compiled part of the package nlmech.";
  py::register_exception_translator(&translate);
  add_ivp(module);
  add_bvp(module);
  add_orbit(module);
  add_geodesy(module);
  add_structures(module);
}
