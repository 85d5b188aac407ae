// tbb::this_task_arena::isolate() where there are no threads.
#pragma once

namespace tbb::this_task_arena {

template <class Body>
void isolate(const Body& body) {
  body();
}

}  // namespace tbb::this_task_arena
