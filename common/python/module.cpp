#include "common/python/module.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "nlmech/support/errors.hpp"

namespace nlmech::python {
namespace {

/// Arguments that are not named as the options are.
using Renamed = std::pair<std::string_view, std::string_view>;
constexpr std::array<Renamed, 6> renamed = {{{"from", "start"},
                                             {"event", "events"},
                                             {"set-at", "changes"},
                                             {"no-verify", "verify=False"},
                                             {"plane", "normal"},
                                             {"final-angle", "angle"}}};

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const Failure& failure) {
    try {
      raise(
          failure.status().ok() ? Status::failure(Outcome::not_converged, failure.what()) : failure.status(),
          py::none());
    } catch (py::error_already_set& raised) {
      raised.restore();
    }
  } catch (const InputError& error) {
    PyErr_SetString(PyExc_ValueError, in_python(error.what()).c_str());
  } catch (const std::invalid_argument& error) {
    PyErr_SetString(PyExc_ValueError, in_python(error.what()).c_str());
  }
}

}  // namespace

std::string in_python(std::string_view message) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  std::string text;
  while (!message.empty()) {
    if (!message.starts_with("--") || message.size() < 3 || !is_letter(message[2])) {
      text += message.front();
      message.remove_prefix(1);
      continue;
    }
    message.remove_prefix(2);
    const auto end =
        std::ranges::find_if_not(message, [&](char c) { return c == '-' || is_letter(c); }) - message.begin();
    const std::string_view option = message.substr(0, static_cast<std::size_t>(end));
    message.remove_prefix(option.size());
    const auto* known = std::ranges::find(renamed, option, &Renamed::first);
    std::string name(known == renamed.end() ? option : known->second);
    std::ranges::replace(name, '-', '_');
    text += name;
  }
  return text;
}

void raise(const Status& status, const py::object& partial) {
  const py::object kind = py::module_::import("nlmech").attr("Failure");
  const py::object failure =
      kind(in_python(status.sentence()), std::string(to_string(status.outcome())), partial);
  PyErr_SetObject(kind.ptr(), failure.ptr());
  throw py::error_already_set();
}

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
