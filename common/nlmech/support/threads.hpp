/// @file
/// Work shared out among threads.
#pragma once

#include <cstddef>
#include <functional>

namespace nlmech {

/// How many threads there are to be. @param threads asked for; 0: one a processor @return 1 or more
[[nodiscard]] std::size_t threads_for(int threads);

/// Does @p work in @p count threads at once, this one among them; none is begun for a count of 0 or 1. The
/// first exception is thrown again once all have ended.
void in_threads(std::size_t count, const std::function<void()>& work);

/// Calls @p work with portions of the numbers from 0 up to @p count, each number in one portion; which thread
/// gets which is not said. After an exception no more are handed out, and it is thrown again at the end.
/// @param portion how many numbers at a time, 1 or more
/// @param threads as threads_for() takes them
void share_out(std::size_t count, std::size_t portion, int threads,
               const std::function<void(std::size_t begin, std::size_t end)>& work);

}  // namespace nlmech
