/// @file
/// Error of a problem that cannot be expanded in a power series.
#pragma once

namespace nlmech {

/// Reports that a right-hand side branches on the value of a series.
/// @param timed does the value depend on time only, so that the problem can give its discontinuities?
/// @throws std::invalid_argument always, with a remedy
[[noreturn]] void throw_unannounced_branch(bool timed);

}  // namespace nlmech
