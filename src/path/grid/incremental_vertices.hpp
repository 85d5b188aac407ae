// The vertices of an incremental search, in four bytes each.
//
// Most vertices are consistent: g and rhs are the same. Such a vertex is packed into one word: the straight
// and the diagonal moves of g as differences from those of the first vertex that was reached in its piece of
// the row, and the move to its parent. A vertex whose two costs differ, or whose difference from the first
// one is too large, lies in a slot of 20 bytes instead. The former wait in the queue of the search; the
// latter are rare, since a piece is short.
#pragma once

#include <cstdint>
#include <vector>

#include "octile.hpp"
#include "outrider/search/labels.hpp"
#include "outrider/search/paged_words.hpp"

namespace outrider {

struct IncrementalVertex {
  /// The cost of what was not reached: more than any path, and two of them still fit.
  static constexpr Octile unreached{1 << 29, 0};
  static constexpr std::uint32_t no_parent = 8;

  Octile g = unreached, rhs = unreached;
  std::uint32_t to_parent = no_parent;  ///< move to the neighbour over which rhs leads

  [[nodiscard]] bool consistent() const { return g == rhs; }
};

class IncrementalVertices {
 public:
  /// Forgets all vertices, and makes room for so many.
  void begin(std::size_t vertices) {
    words_.begin(vertices);
    bases_.grow(vertices / piece + 1);
    ++search_;
    slots_.clear();
    free_.clear();
  }
  [[nodiscard]] bool reached(State s) const { return words_[s] != 0; }

  /// Returns a vertex; one that was not reached has no costs.
  [[nodiscard]] IncrementalVertex operator[](State s) const {
    const std::uint32_t w = words_[s];
    switch (w >> kind_shift) {
      case packed: {
        const Octile g = bases_[s / piece].g + Octile{moves(w >> 17U), moves(w >> 4U)};
        return {g, g, w & 15U};
      }
      case in_slot: return slots_[w & number];
      default: return {};
    }
  }

  /// Writes a vertex, which is reached from then on.
  void set(State s, const IncrementalVertex& vertex) {
    std::uint32_t& w = words_[s];
    const bool had_slot = w >> kind_shift == in_slot;
    if (words_.touch(s) && bases_[s / piece].search != search_)
      bases_[s / piece] = {vertex.rhs == IncrementalVertex::unreached ? vertex.g : vertex.rhs, search_};
    const std::uint32_t word = vertex.consistent() ? packed_word(s, vertex) : 0;
    if (word != 0) {
      if (had_slot) free_.push_back(w & number);
      w = word;
      return;
    }
    if (!had_slot) w = in_slot << kind_shift | take_slot();
    slots_[w & number] = vertex;
  }

 private:
  static constexpr std::uint32_t piece = 1024;  // vertices that share a base
  static constexpr std::uint32_t kind_shift = 30;
  static constexpr std::uint32_t packed = 1, in_slot = 2, without_cost = 3;  // kinds of words; 0: not reached
  static constexpr std::uint32_t number = (1U << kind_shift) - 1;
  static constexpr std::int32_t most_moves = 1 << 12;  // 13 bits from -most_moves on

  struct Base {
    Octile g;
    std::uint32_t search = 0;  // that wrote it
  };

  static std::int32_t moves(std::uint32_t bits) {
    return static_cast<std::int32_t>(bits & (2 * most_moves - 1)) - most_moves;
  }

  /// Returns 0 if the vertex does not fit into a word.
  [[nodiscard]] std::uint32_t packed_word(State s, const IncrementalVertex& vertex) const {
    if (vertex.g == IncrementalVertex::unreached) {
      return vertex.to_parent == IncrementalVertex::no_parent ? without_cost << kind_shift : 0;
    }
    const Octile base = bases_[s / piece].g;
    const auto straight = static_cast<std::uint32_t>(vertex.g.straight - base.straight + most_moves);
    const auto diagonal = static_cast<std::uint32_t>(vertex.g.diagonal - base.diagonal + most_moves);
    if (straight >= 2 * most_moves || diagonal >= 2 * most_moves) return 0;
    return packed << kind_shift | straight << 17U | diagonal << 4U | vertex.to_parent;
  }

  std::uint32_t take_slot() {
    if (free_.empty()) {
      slots_.emplace_back();
      return static_cast<std::uint32_t>(slots_.size() - 1);
    }
    const std::uint32_t slot = free_.back();
    free_.pop_back();
    return slot;
  }

  PagedWords<256> words_;
  ZeroedArray<Base> bases_;  // by piece
  std::uint32_t search_ = 0;
  std::vector<IncrementalVertex> slots_;
  std::vector<std::uint32_t> free_;  // slots
};

}  // namespace outrider
