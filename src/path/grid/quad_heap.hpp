// QuadHeap: a heap with four children per node, which is half as deep as a binary one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace outrider {

/// `before(a, b)` returns true if the entry a comes out before b; best without a branch, because a processor
/// could not predict it.
template <class Entry>
class QuadHeap {
 public:
  void clear() { entries_.clear(); }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] const Entry& front() const { return entries_.front(); }

  void push(const Entry& added) {
    std::size_t hole = entries_.size();
    entries_.push_back(added);
    while (hole > 0) {
      const std::size_t parent = (hole - 1) / children;
      if (!before(added, entries_[parent])) break;
      entries_[hole] = entries_[parent];
      hole = parent;
    }
    entries_[hole] = added;
  }
  /// Removes the first entry of a heap that is not empty.
  void pop() {
    const Entry last = entries_.back();
    entries_.pop_back();
    if (!entries_.empty()) sink(last);
  }

 private:
  static constexpr std::size_t children = 4;

  /// Replaces the first entry.
  void sink(const Entry& last) {
    std::size_t hole = 0;
    for (;;) {
      const std::size_t eldest = hole * children + 1;
      if (eldest >= entries_.size()) break;
      std::size_t least = eldest;
      for (std::size_t i = eldest + 1; i < std::min(eldest + children, entries_.size()); ++i) {
        least = before(entries_[i], entries_[least]) ? i : least;
      }
      if (!before(entries_[least], last)) break;
      entries_[hole] = entries_[least];
      hole = least;
    }
    entries_[hole] = last;
  }

  std::vector<Entry> entries_;
};

}  // namespace outrider
