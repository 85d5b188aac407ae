// StateTable: numbers for the keys that a search meets, in the order in which it meets them.
//
// A table of open addressing whose entries carry the number of the search that wrote them, so begin() clears
// it without touching it. O(1); the table doubles when it is half full.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "outrider/search/labels.hpp"

namespace outrider {

class StateTable {
 public:
  static constexpr State none = std::numeric_limits<State>::max();

  void begin() {
    count_ = 0;
    if (slots_.empty()) slots_.resize(std::size_t{1} << 14U);
    if (++search_ != 0) return;
    slots_.assign(slots_.size(), {});
    search_ = 1;
  }
  /// Returns the number of a key, or `none`.
  [[nodiscard]] State find(std::uint64_t key) const {
    const Slot& slot = slots_[place_of(key)];
    return slot.search == search_ ? slot.state : none;
  }
  /// Adds a key that has no number yet.
  void add(std::uint64_t key, State state) {
    if (2 * ++count_ > slots_.size()) grow();
    slots_[place_of(key)] = {key, state, search_};
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    State state = 0;
    std::uint32_t search = 0;
  };

  /// Returns the slot of the key, or the free one where it belongs.
  [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
    std::uint64_t mixed = key * 0x9e3779b97f4a7c15U;  // Fibonacci hashing
    mixed ^= mixed >> 32U;
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = static_cast<std::size_t>(mixed) & mask;
    while (slots_[place].search == search_ && slots_[place].key != key) place = (place + 1) & mask;
    return place;
  }
  void grow() {
    const std::vector<Slot> old = std::move(slots_);
    slots_.assign(2 * old.size(), {});
    for (const Slot& slot : old) {
      if (slot.search == search_) slots_[place_of(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
  std::uint32_t search_ = 0;
};

/// The state at which a search of robots that steer begins, before it has a pose.
inline constexpr State start_state = 0;

/// Adds a state: its key, its node and its label. `memory` has the members `states`, `nodes` and `search`.
/// Returns `none` and adds nothing if there are `most` states already.
template <class Memory, class Node>
State add_state(Memory& memory, std::uint64_t key, const Node& node, std::int64_t most) {
  if (memory.nodes.size() >= static_cast<std::size_t>(most)) return StateTable::none;
  const auto state = static_cast<State>(memory.nodes.size());
  memory.states.add(key, state);
  memory.nodes.push_back(node);
  memory.search.labels.grow(memory.nodes.size());
  return state;
}

}  // namespace outrider
