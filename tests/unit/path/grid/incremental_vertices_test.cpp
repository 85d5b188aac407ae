#include "grid/incremental_vertices.hpp"

#include <gtest/gtest.h>

#include <map>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

int drawn_below(Rng& rng, int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); }

Octile some_cost(Rng& rng, int most) {
  if (rng.below(8) == 0) return IncrementalVertex::unreached;
  return {drawn_below(rng, most), drawn_below(rng, most)};
}

/// Random vertices: consistent ones near and far from others, inconsistent ones, and ones without a cost.
TEST(IncrementalVertices, AreReadAsTheyWereWritten) {
  Rng rng = Rng(41).child("vertices");
  IncrementalVertices vertices;
  for (int round = 0; round < 100; ++round) {
    const int size = 1 + drawn_below(rng, 5000), most = round % 2 == 0 ? 3000 : 1 << 27U;
    vertices.begin(static_cast<std::size_t>(size));
    std::map<State, IncrementalVertex> twin;
    for (int i = 0; i < 1000; ++i) {
      const auto s = static_cast<State>(drawn_below(rng, size));
      IncrementalVertex vertex{some_cost(rng, most), some_cost(rng, most),
                               static_cast<unsigned>(rng.below(9))};
      if (rng.below(3) != 0) vertex.g = vertex.rhs;
      if (vertex.g == IncrementalVertex::unreached && vertex.rhs == IncrementalVertex::unreached &&
          !twin.contains(s))
        continue;
      vertices.set(s, vertex);
      twin[s] = vertex;
      const auto other = static_cast<State>(drawn_below(rng, size));
      ASSERT_EQ(vertices.reached(other), twin.contains(other));
      const IncrementalVertex read = vertices[other],
                              wanted = twin.contains(other) ? twin[other] : IncrementalVertex{};
      ASSERT_TRUE(read.g == wanted.g && read.rhs == wanted.rhs && read.to_parent == wanted.to_parent);
    }
  }
}

}  // namespace
}  // namespace outrider
