// RadixQueue: a monotone priority queue of integers: no key may be below the last one removed.
//
// Bucket b > 0 holds the keys whose highest bit that differs from the last key removed is bit b - 1; bucket 0
// holds the keys equal to it. Each entry moves to a lower bucket at most 64 times; in practice, about as
// often as the range of the costs has bits. Among equal keys, the oldest or the newest entry is removed
// first.
// Source: Ahuja, Mehlhorn, Orlin and Tarjan, Faster algorithms for the shortest path problem (1990).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace outrider {

struct RadixEntry {
  std::uint64_t key = 0;
  std::uint32_t value = 0;
};

enum class Ties { oldest_first, newest_first };

template <Ties ties>
class RadixQueue {
 public:
  void push(std::uint64_t key, std::uint32_t value) {
    buckets_[bucket_of(key)].push_back({key, value});
    ++size_;
  }
  [[nodiscard]] bool empty() const { return size_ == 0; }

  /// Returns the least key; the queue must not be empty.
  std::uint64_t least() {
    refill();
    return last_;
  }
  /// Removes an entry with the least key; the queue must not be empty.
  RadixEntry pop() {
    refill();
    --size_;
    std::vector<RadixEntry>& equal = buckets_[0];
    if constexpr (ties == Ties::newest_first) {
      const RadixEntry newest = equal.back();
      equal.pop_back();
      return newest;
    } else {
      return equal[taken_++];
    }
  }

 private:
  [[nodiscard]] std::size_t bucket_of(std::uint64_t key) const {
    return static_cast<std::size_t>(std::bit_width(key ^ last_));
  }
  void refill() {
    if (taken_ < buckets_[0].size()) return;
    buckets_[0].clear();
    taken_ = 0;
    std::size_t b = 1;
    while (buckets_[b].empty()) ++b;
    last_ = buckets_[b].front().key;
    for (const RadixEntry& entry : buckets_[b]) last_ = entry.key < last_ ? entry.key : last_;
    for (const RadixEntry& entry : buckets_[b]) buckets_[bucket_of(entry.key)].push_back(entry);
    buckets_[b].clear();
  }

  std::array<std::vector<RadixEntry>, 65> buckets_;
  std::uint64_t last_ = 0;
  std::size_t taken_ = 0;  // entries of bucket 0 that have left, oldest first
  std::size_t size_ = 0;
};

}  // namespace outrider
