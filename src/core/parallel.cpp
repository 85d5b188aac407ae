#include "outrider/core/parallel.hpp"

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <thread>
#else
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace outrider {

#ifdef __SANITIZE_THREAD__
// oneTBB is a library that is not instrumented for the thread sanitizer, which would report its
// synchronisation as races. Under the sanitizer, the same bodies therefore run on plain threads, so that
// their own races show.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) body(i);
  };
  std::thread other(work);
  work();
  other.join();
}

void isolated(const std::function<void()>& body) { body(); }
#else
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(std::size_t{0}, count, body);
}

void isolated(const std::function<void()>& body) { tbb::this_task_arena::isolate(body); }
#endif

bool parallel_for(std::size_t count, const std::stop_token& stop,
                  const std::function<void(std::size_t)>& body) {
  parallel_for(count, [&](std::size_t i) {
    if (!stop.stop_requested()) body(i);
  });
  return !stop.stop_requested();
}

}  // namespace outrider
