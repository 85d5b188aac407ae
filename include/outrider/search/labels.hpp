// Labels: the cost and the parent of every state that a search has reached.
//
// Each label has a stamp with the number of the search that wrote it, so begin() clears all labels without
// touching them. The stamp also marks closed states. All operations are O(1). Labels take memory only in the
// pages that searches have reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "outrider/search/zeroed_array.hpp"

namespace outrider {

/// Index of a state.
using State = std::uint32_t;

template <class Cost>
struct SearchLabel {
  Cost g{};
  State parent = 0;
  std::uint32_t stamp = 0;
};

template <class Cost>
class Labels {
 public:
  /// Clears all labels. O(1), but O(states reached so far) if `states` is larger than ever before.
  void begin(std::size_t states) {
    if (open_ >= std::numeric_limits<std::uint32_t>::max() - 3) {
      const std::size_t size = labels_.size();
      labels_ = {};
      labels_.grow(size);
      open_ = 0;
    }
    labels_.grow(states);
    open_ += 2;
  }
  /// Makes room for more states during a search.
  void grow(std::size_t states) { labels_.grow(states); }
  [[nodiscard]] bool known(State s) const { return labels_[s].stamp >= open_; }
  [[nodiscard]] bool closed(State s) const { return labels_[s].stamp == open_ + 1; }
  [[nodiscard]] const Cost& g(State s) const { return labels_[s].g; }
  [[nodiscard]] State parent(State s) const { return labels_[s].parent; }
  /// Opens a state, or gives it a smaller cost; a closed one only if `reopen`. Calls met() if the search has
  /// not met it before. Returns false if nothing changes.
  template <bool reopen, class Met>
  bool offer(State s, State parent, const Cost& g, const Met& met) {
    const bool met_before = known(s);
    if (met_before && ((!reopen && closed(s)) || !(g < labels_[s].g))) return false;
    if (!met_before) met();
    open(s, parent, g);
    return true;
  }
  /// Writes the label of a state that is not closed.
  void open(State s, State parent, Cost g) { labels_[s] = {g, parent, open_}; }
  void close(State s) { labels_[s].stamp = open_ + 1; }

 private:
  ZeroedArray<SearchLabel<Cost>> labels_;
  std::uint32_t open_ = 0;  // stamp of open states in this search; one more when closed
};

}  // namespace outrider
