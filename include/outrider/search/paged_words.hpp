// PagedWords: an array of 32-bit words that are zero, cleared between searches at the cost of what was
// written.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "outrider/search/zeroed_array.hpp"

namespace outrider {

/// Takes memory only in the pages of the system that were reached. `page_size`: words that are cleared
/// together.
template <std::uint32_t page_size>
class PagedWords {
 public:
  /// Sets all words to zero, and makes room for so many. O(pages between the lowest and the highest touched
  /// one), and page_size for each touched one.
  void begin(std::size_t size) {
    if (size > words_.size()) {
      words_ = {};
      words_.grow(size);
      touched_ = {};
      touched_.grow(size / page_size + 1);
    } else {
      clear();
    }
    lowest_ = std::numeric_limits<std::uint32_t>::max();
    highest_ = 0;
  }
  [[nodiscard]] const std::uint32_t& operator[](std::size_t i) const { return words_[i]; }
  std::uint32_t& operator[](std::size_t i) { return words_[i]; }

  /// Has to be called before a word that is zero is written. Returns true if no word of its page was.
  bool touch(std::uint32_t i) {
    const std::uint32_t page = i / page_size;
    if (touched_[page] != 0) return false;
    touched_[page] = 1;
    lowest_ = std::min(lowest_, page);
    highest_ = std::max(highest_, page);
    return true;
  }

 private:
  void clear() {
    for (std::size_t page = lowest_; page <= highest_; ++page) {
      if (touched_[page] == 0) continue;
      touched_[page] = 0;
      const std::size_t first = page * page_size;
      std::fill_n(&words_[first], std::min<std::size_t>(page_size, words_.size() - first), 0U);
    }
  }

  ZeroedArray<std::uint32_t> words_;
  ZeroedArray<std::uint8_t> touched_;  // by page, 1 if a word may be written there
  std::uint32_t lowest_ = std::numeric_limits<std::uint32_t>::max(), highest_ = 0;
};

}  // namespace outrider
