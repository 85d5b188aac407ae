// BucketQueue: the open list of a best-first search, with the exact order of a binary heap.
//
// Entries are stored unsorted in buckets of similar priority; only the current bucket is a heap. An entry of
// an earlier bucket is pushed into that heap, and the last bucket takes all larger priorities, so the order
// is exact for any priorities. Push is O(1) into later buckets; pop is O(log of the bucket size). Memory is
// kept between searches. Source: two-level buckets, Cherkassky, Goldberg and Silverstein (1999).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "outrider/search/labels.hpp"

namespace outrider {

/// An entry of the open list.
struct QueueEntry {
  double f = 0.0;  ///< priority
  double g = 0.0;  ///< cost from the start
  State state = 0;
  std::uint32_t next = 0;  ///< internal: index of the next entry of the same bucket
};

/// Returns true if a is expanded before b: least f first, then largest g (nearest to the goal), then least
/// state.
inline bool before(const QueueEntry& a, const QueueEntry& b) {
  if (a.f != b.f) return a.f < b.f;
  if (a.g != b.g) return a.g > b.g;
  return a.state < b.state;
}

class BucketQueue {
 public:
  /// Empties the queue. The first bucket begins at `lowest_f`.
  void begin(double lowest_f) {
    heap_.clear();
    waiting_.clear();
    std::fill_n(first_.begin(), std::min(first_.size(), last_ + 1), none);
    lowest_f_ = lowest_f;
    current_ = last_ = 0;
    free_ = none;
  }

  void push(double f, double g, State state) {
    const std::size_t bucket = bucket_of(f);
    if (bucket <= current_) {
      heap_.push_back({f, g, state, none});
      std::push_heap(heap_.begin(), heap_.end(), After{});
      return;
    }
    if (bucket >= first_.size()) first_.resize(bucket + 1, none);
    first_[bucket] = wait({f, g, state, first_[bucket]});
    last_ = std::max(last_, bucket);
  }

  /// Removes the first entry and copies it to `first`. Returns false if the queue is empty.
  bool pop(QueueEntry& first) {
    if (heap_.empty() && !advance()) return false;
    std::pop_heap(heap_.begin(), heap_.end(), After{});
    first = heap_.back();
    heap_.pop_back();
    return true;
  }

 private:
  static constexpr double per_unit = 64.0;
  static constexpr std::size_t most_buckets = std::size_t{1} << 19U;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  struct After {
    bool operator()(const QueueEntry& a, const QueueEntry& b) const { return before(b, a); }
  };

  [[nodiscard]] std::size_t bucket_of(double f) const {
    const double i = (f - lowest_f_) * per_unit;
    if (!(i > 0.0)) return 0;
    return i < static_cast<double>(most_buckets) ? static_cast<std::size_t>(i) : most_buckets;
  }

  std::uint32_t wait(const QueueEntry& entry) {
    if (free_ == none) {
      waiting_.push_back(entry);
      return static_cast<std::uint32_t>(waiting_.size() - 1);
    }
    const std::uint32_t place = free_;
    free_ = waiting_[place].next;
    waiting_[place] = entry;
    return place;
  }

  /// Makes the next non-empty bucket the heap. Returns false if there is none.
  bool advance() {
    while (current_ < last_) {
      std::uint32_t place = first_[++current_];
      if (place == none) continue;
      first_[current_] = none;
      while (place != none) {
        heap_.push_back(waiting_[place]);
        const std::uint32_t next = waiting_[place].next;
        waiting_[place].next = free_;
        free_ = place;
        place = next;
      }
      std::make_heap(heap_.begin(), heap_.end(), After{});
      return true;
    }
    return false;
  }

  std::vector<QueueEntry> heap_;      // all entries of the buckets up to current_
  std::vector<QueueEntry> waiting_;   // entries of later buckets, and free slots
  std::vector<std::uint32_t> first_;  // head of each bucket's list in waiting_
  std::uint32_t free_ = none;         // head of the list of free slots in waiting_
  std::size_t current_ = 0;
  std::size_t last_ = 0;  // last bucket in use
  double lowest_f_ = 0.0;
};

}  // namespace outrider
