/// Work distributed over threads: each number once for any portions, and exceptions.
#include "nlmech/support/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace nlmech {
namespace {

TEST(Threads, AsManyAsAskedFor) {
  EXPECT_EQ(threads_for(3), 3U);
  EXPECT_GE(threads_for(0), 1U);
  for (const std::size_t count : {0U, 1U, 4U}) {
    std::atomic<std::size_t> ran = 0;
    in_threads(count, [&] { ++ran; });
    EXPECT_EQ(ran, count == 0 ? 1U : count);
  }
}

TEST(Threads, EachNumberOnce) {
  for (const std::size_t count : {0U, 1U, 7U, 100U}) {
    for (const std::size_t portion : {1U, 3U, 200U}) {
      std::vector<std::atomic<int>> seen(count);
      share_out(count, portion, 3, [&](std::size_t begin, std::size_t end) {
        EXPECT_LE(end - begin, portion);
        for (std::size_t i = begin; i < end; ++i) ++seen[i];
      });
      for (const auto& times : seen) EXPECT_EQ(times, 1);
    }
  }
}

TEST(Threads, AnExceptionEndsIt) {
  std::atomic<int> portions = 0;
  EXPECT_THROW(share_out(100'000, 1, 2,
                         [&](std::size_t begin, std::size_t) {
                           ++portions;
                           if (begin == 0) throw std::runtime_error("the first");
                         }),
               std::runtime_error);
  EXPECT_LT(portions, 100'000);
  EXPECT_THROW(in_threads(3, [] { throw std::runtime_error("each"); }), std::runtime_error);
}

}  // namespace
}  // namespace nlmech
