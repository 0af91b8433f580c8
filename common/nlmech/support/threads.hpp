/// @file
/// Distribution of work among threads.
#pragma once

#include <cstddef>
#include <functional>

namespace nlmech {

/// Number of threads to use. @param threads requested number; 0: one per processor @return 1 or more
[[nodiscard]] std::size_t threads_for(int threads);

/// Runs @p work in @p count threads, including the calling one; starts none for a count of 0 or 1. Rethrows
/// the first exception after all threads have ended.
void in_threads(std::size_t count, const std::function<void()>& work);

/// Calls @p work for portions of the indices 0 to @p count - 1, each index once, in unspecified threads.
/// After an exception no further portions are started; the exception is rethrown at the end.
/// @param portion number of indices per call, 1 or more
/// @param threads as for threads_for()
void share_out(std::size_t count, std::size_t portion, int threads,
               const std::function<void(std::size_t begin, std::size_t end)>& work);

}  // namespace nlmech
