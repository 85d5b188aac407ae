// parallel_for: runs independent iterations on several threads. Algorithms use threads only through it.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace outrider {

/// Calls body(i) once for each i < count, on as many threads as oneTBB is configured to use, and returns when
/// all calls are done. An exception of a body is rethrown. Each call must write only to its own elements;
/// then the result is the same for any number of threads.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Like parallel_for above, but after a stop request no more calls begin. Returns false if calls may have
/// been skipped.
bool parallel_for(std::size_t count, const std::stop_token& stop,
                  const std::function<void(std::size_t)>& body);

/// Calls body(). While it waits for a parallel_for of its own, the thread takes up no work from outside:
/// bodies of an outer parallel_for that are themselves large do not pile up on one stack.
void isolated(const std::function<void()>& body);

}  // namespace outrider
