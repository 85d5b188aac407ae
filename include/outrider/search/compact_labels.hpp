// CompactLabels: labels of four bytes a state, for large maps.
//
// They serve searches that never open a closed state again, and ask for the cost of a state only while it is
// open, or of the last one that was closed. The label of a closed state is its parent. That of an open one is
// the number of a slot, which holds its cost and its parent; slots are used again, so there are as many as
// states were open at once. begin() clears only the pages of labels that the last search has written, and
// labels take memory only in the pages that searches have reached. All other operations are O(1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "outrider/search/labels.hpp"
#include "outrider/search/paged_words.hpp"
#include "outrider/search/queue.hpp"

namespace outrider {

/// The time at which the cost of a closed state is dropped: at once, or when it is released.
enum class ClosedCosts : std::uint8_t { dropped, kept };

/// For fewer than `most_states` states.
template <class Cost, ClosedCosts closed_costs = ClosedCosts::dropped>
class CompactLabels {
 public:
  static constexpr std::size_t most_states = std::size_t{1} << 30U;

  /// Clears all labels, at the cost of those that the last search has written.
  void begin(std::size_t states) {
    words_.begin(states);
    slots_.clear();
    free_ = none;
  }
  [[nodiscard]] bool known(State s) const { return word(s) != 0; }
  [[nodiscard]] bool closed(State s) const { return (word(s) & closed_bit) != 0; }
  /// Returns the cost of a state that is open, kept, or the last that was closed.
  [[nodiscard]] const Cost& g(State s) const {
    const std::uint32_t w = word(s);
    return (w & slot_bit) != 0 ? slots_[w & number].g : last_;
  }
  [[nodiscard]] State parent(State s) const {
    const std::uint32_t w = word(s);
    return (w & slot_bit) != 0 ? slots_[w & number].parent : w & number;
  }
  /// Opens a state, or gives it a smaller cost. Calls met() if the search has not met it before. Returns
  /// false if nothing changes.
  template <bool reopen = false, class Met>
    requires(!reopen)
  bool offer(State s, State parent, const Cost& g, const Met& met) {
    std::uint32_t& w = words_[s];
    if ((w & closed_bit) != 0 || (w != 0 && !(g < slots_[w & number].g))) return false;
    if (w == 0) met();
    open(s, parent, g);
    return true;
  }
  /// Writes the label of a state that is not closed.
  void open(State s, State parent, const Cost& g) {
    std::uint32_t& w = words_[s];
    if (w == 0) {
      w = slot_bit | take_slot();
      words_.touch(s);
    }
    Slot& slot = slots_[w & number];
    slot.g = g;
    slot.parent = parent;
  }
  void close(State s) {
    std::uint32_t& w = words_[s];
    if constexpr (closed_costs == ClosedCosts::kept) {
      w |= closed_bit;
    } else {
      last_ = slots_[w & number].g;
      drop(w);
    }
  }
  /// Keeps the cost of a closed state until so many of its neighbours have closed.
  void keep_until(State s, unsigned neighbours)
    requires(closed_costs == ClosedCosts::kept)
  {
    std::uint32_t& w = words_[s];
    slots_[w & number].waiting = neighbours;
    if (neighbours == 0) drop(w);
  }
  /// Tells a closed state that one of its neighbours has closed.
  void count_down(State s)
    requires(closed_costs == ClosedCosts::kept)
  {
    std::uint32_t& w = words_[s];
    if ((w & slot_bit) != 0 && --slots_[w & number].waiting == 0) drop(w);
  }

 private:
  static constexpr std::uint32_t closed_bit = 1U << 31U;
  static constexpr std::uint32_t slot_bit = 1U << 30U;  // the rest is the number of a slot, else the parent
  static constexpr std::uint32_t number = slot_bit - 1;
  static constexpr std::uint32_t none = slot_bit;

  struct Slot {
    Cost g{};
    State parent = 0;
    std::uint32_t waiting = 0;  // neighbours that are not closed yet
  };

  [[nodiscard]] std::uint32_t word(State s) const { return words_[s]; }

  std::uint32_t take_slot() {
    const std::uint32_t slot = free_;
    if (slot == none) {
      slots_.emplace_back();
      return static_cast<std::uint32_t>(slots_.size() - 1);
    }
    free_ = slots_[slot].parent;
    return slot;
  }
  /// Frees the slot of a closed state.
  void drop(std::uint32_t& w) {
    const std::uint32_t slot = w & number;
    w = closed_bit | slots_[slot].parent;
    slots_[slot].parent = std::exchange(free_, slot);
  }

  PagedWords<256> words_;  // by state
  std::vector<Slot> slots_;
  std::uint32_t free_ = none;  // the first free slot; its parent is the next one
  Cost last_{};                // of the last state that was closed
};

/// The memory of best_first() with compact labels.
template <class Cost, ClosedCosts closed_costs = ClosedCosts::dropped>
struct CompactMemory {
  CompactLabels<Cost, closed_costs> labels;
  BucketQueue queue;
};

}  // namespace outrider
