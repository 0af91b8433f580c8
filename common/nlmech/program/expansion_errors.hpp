/// @file
/// What is said to a problem that cannot be expanded in a power series.
#pragma once

namespace nlmech {

/// A right-hand side has asked for the number inside a series, to branch on it.
/// @param timed does the number depend on the time alone, so that the problem can announce the branch?
/// @throws std::invalid_argument always, with what to change
[[noreturn]] void throw_unannounced_branch(bool timed);

}  // namespace nlmech
