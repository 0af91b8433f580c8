#include "nlmech/support/threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace nlmech {

std::size_t threads_for(int threads) {
  return threads > 0 ? static_cast<std::size_t>(threads) : std::max(1U, std::thread::hardware_concurrency());
}

void in_threads(std::size_t count, const std::function<void()>& work) {
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t k = 1; k < count; ++k) others.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

void share_out(std::size_t count, std::size_t portion, int threads,
               const std::function<void(std::size_t begin, std::size_t end)>& work) {
  std::atomic<std::size_t> next = 0;
  const std::size_t portions = (count + portion - 1) / portion;
  in_threads(std::min(threads_for(threads), portions), [&] {
    try {
      for (std::size_t i = next.fetch_add(portion); i < count; i = next.fetch_add(portion))
        work(i, std::min(count, i + portion));
    } catch (...) {
      next = count;
      throw;
    }
  });
}

}  // namespace nlmech
