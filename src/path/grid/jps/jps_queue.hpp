// The open list of jump point search: a heap with four children per node, and the first entry outside of it.
//
// An expansion often finds the node that is expanded next; that node never enters the heap. Order: least f,
// then largest g (to 1/4096 cell), then the node discovered first.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>

#include "grid/quad_heap.hpp"

namespace outrider::jump {

struct QueueEntry {
  std::uint64_t f_bits = 0;  ///< bits of f >= 0 as a double; they have the order of f
  std::uint64_t tie = 0;     ///< 38 bits of g, complemented, over 26 bits of the node

  [[nodiscard]] double f() const { return std::bit_cast<double>(f_bits); }
  [[nodiscard]] std::uint32_t node() const { return static_cast<std::uint32_t>(tie & ((1U << 26U) - 1)); }
};

inline QueueEntry entry(double f, double g, std::uint32_t node) {
  constexpr std::uint64_t most = (std::uint64_t{1} << 38U) - 1;
  return {std::bit_cast<std::uint64_t>(f), ((most - static_cast<std::uint64_t>(g * 4096.0)) << 26U) | node};
}

/// Compares without a branch, because a processor could not predict it.
inline bool before(const QueueEntry& a, const QueueEntry& b) {
  return ((a.f_bits < b.f_bits) | ((a.f_bits == b.f_bits) & (a.tie < b.tie))) != 0;
}

class Queue {
 public:
  void clear() {
    heap_.clear();
    has_first_ = false;
  }
  void push(QueueEntry added) {
    if (has_first_) {
      if (before(added, first_)) std::swap(added, first_);
    } else if (heap_.empty() || before(added, heap_.front())) {
      first_ = added;
      has_first_ = true;
      return;
    }
    heap_.push(added);
  }
  /// Removes the first entry; returns false if there is none.
  bool pop(QueueEntry& first) {
    if (has_first_) {
      first = first_;
      has_first_ = false;
      return true;
    }
    if (heap_.empty()) return false;
    first = heap_.front();
    heap_.pop();
    return true;
  }

 private:
  QuadHeap<QueueEntry> heap_;
  QueueEntry first_;
  bool has_first_ = false;
};

}  // namespace outrider::jump
