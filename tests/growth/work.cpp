#include "work.hpp"

#include <malloc.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> blocks_run{0};
std::atomic<std::int64_t> allocations_made{0};
std::atomic<std::int64_t> bytes_held{0};
std::atomic<std::int64_t> most_bytes_held{0};
std::atomic<std::int64_t> stop_at{-1};  // in blocks_run
std::stop_source* to_stop = nullptr;

void took(void* place) {
  if (place == nullptr) return;
  ++allocations_made;
  bytes_held += static_cast<std::int64_t>(malloc_usable_size(place));
  most_bytes_held = std::max(most_bytes_held.load(), bytes_held.load());
}

void gives(void* place) {
  if (place != nullptr) bytes_held -= static_cast<std::int64_t>(malloc_usable_size(place));
}

}  // namespace

// The names below are the compiler's and the linker's: what -fsanitize-coverage=trace-pc calls in each block,
// and what --wrap=malloc makes of malloc().
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
void __sanitizer_cov_trace_pc();
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* place, std::size_t size);
void __real_free(void* place);
void* __wrap_malloc(std::size_t size);
void* __wrap_calloc(std::size_t count, std::size_t size);
void* __wrap_realloc(void* place, std::size_t size);
void __wrap_free(void* place);

void __sanitizer_cov_trace_pc() {
  // Not fetch_add(), which takes longer: only one thread counts.
  const std::int64_t run = blocks_run.load(std::memory_order_relaxed) + 1;
  blocks_run.store(run, std::memory_order_relaxed);
  if (run == stop_at.load(std::memory_order_relaxed)) to_stop->request_stop();
}

void* __wrap_malloc(std::size_t size) {
  void* place = __real_malloc(size);
  took(place);
  return place;
}

void* __wrap_calloc(std::size_t count, std::size_t size) {
  void* place = __real_calloc(count, size);
  took(place);
  return place;
}

void* __wrap_realloc(void* place, std::size_t size) {
  gives(place);
  void* moved = __real_realloc(place, size);
  took(moved);
  return moved;
}

void __wrap_free(void* place) {
  gives(place);
  __real_free(place);
}
}
// NOLINTEND(bugprone-reserved-identifier)

void* operator new(std::size_t size) {
  void* place = __wrap_malloc(std::max<std::size_t>(size, 1));
  if (place == nullptr) throw std::bad_alloc();
  return place;
}
void operator delete(void* place) noexcept { __wrap_free(place); }
void operator delete(void* place, std::size_t) noexcept { __wrap_free(place); }

namespace outrider::growth {

Work work_of(const std::function<void()>& call) {
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  const std::int64_t held_before = bytes_held;
  most_bytes_held = held_before;
  const std::int64_t allocations_before = allocations_made;
  const std::int64_t blocks_before = blocks_run;
  call();
  return {static_cast<double>(blocks_run - blocks_before),
          static_cast<double>(allocations_made - allocations_before),
          static_cast<double>(most_bytes_held - held_before)};
}

double blocks_when_stopped(double at, const std::function<void(const std::stop_token&)>& call) {
  std::stop_source source;
  to_stop = &source;
  stop_at = blocks_run + static_cast<std::int64_t>(at);
  const Work work = work_of([&] { call(source.get_token()); });
  stop_at = -1;
  return work.blocks;
}

}  // namespace outrider::growth
