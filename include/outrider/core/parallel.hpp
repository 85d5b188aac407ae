// parallel_for: the one door to threads for algorithms whose steps do not depend on one another.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

namespace outrider {

/// Calls body(i) once for each i < count, on as many threads as oneTBB has been given, and returns when all
/// are done; an exception of a body is passed on. Each body writes to places of its own, by index, so the
/// result is the same for any number of threads.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// The same until the token is raised: the bodies that have not begun by then are left out. False when there
/// may be such.
bool parallel_for(std::size_t count, const std::stop_token& stop,
                  const std::function<void(std::size_t)>& body);

}  // namespace outrider
