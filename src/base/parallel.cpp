#include "base/parallel.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include <sched.h>

namespace lichtmc {

unsigned usable_processors() {
  cpu_set_t usable;
  if (::sched_getaffinity(0, sizeof usable, &usable) == 0)
    return static_cast<unsigned>(std::max(1, CPU_COUNT(&usable)));
  return std::max(1U, std::thread::hardware_concurrency());
}

void for_each_on_threads(unsigned threads, std::size_t count, const std::function<void(std::size_t)>& use) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t k = 0; k < count; ++k) use(k);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t failed = count;
  const auto work = [&] {
    for (std::size_t k = next++; k < count; k = next++) {
      try {
        use(k);
      } catch (...) {
        next = count;
        const std::lock_guard lock(mutex);
        if (k < failed) failure = std::current_exception();
        failed = std::min(failed, k);
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    try {
      for (std::size_t k = 1; k < std::min<std::size_t>(threads, count); ++k) helpers.emplace_back(work);
    } catch (const std::system_error&) {  // the others do the work
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lichtmc
