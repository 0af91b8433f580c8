/// @file
/// Exceptions that end a program of this suite: wrong input, and failures. Programming errors throw
/// std::invalid_argument or std::logic_error instead.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "nlmech/support/status.hpp"

namespace nlmech {

/// Wrong user input: the command line, or a cell of a file. Programs end with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A computation, or the writing of its results, failed. Programs end with exit code 1.
class Failure : public std::runtime_error {
 public:
  /// @param status not success
  explicit Failure(Status status) : std::runtime_error(status.text()), status_(std::move(status)) {}
  /// @param sentence what failed, and why
  explicit Failure(const std::string& sentence) : std::runtime_error(sentence) {}

  /// Status of the failed computation; success if the failure has another cause, such as a full disk.
  [[nodiscard]] const Status& status() const noexcept { return status_; }

 private:
  Status status_;
};

}  // namespace nlmech
