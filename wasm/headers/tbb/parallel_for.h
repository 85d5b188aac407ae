// tbb::parallel_for where there are no threads.
#pragma once

namespace tbb {

template <class Index, class Body>
void parallel_for(Index first, Index end, const Body& body) {
  for (Index i = first; i < end; ++i) body(i);
}

}  // namespace tbb
