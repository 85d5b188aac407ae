// Costly searches that find nothing become rarer, so that a log in which nothing fits any more does not cost
// a search for each of its scans: of n occasions that all fail about the root of 8 n are searched, the first
// four of them. A search that finds something halves the wait.
#pragma once

#include <cstddef>

namespace outrider {

class BackOff {
 public:
  /// Counts an occasion to search. Returns true if the search is to be made, and its result to be noted.
  [[nodiscard]] bool take_occasion() { return ++passed_ > failures_ / occasions_per_failure; }
  void note(bool found) {
    failures_ = found ? failures_ / 2 : failures_ + 1;
    passed_ = 0;
  }

 private:
  static constexpr std::size_t occasions_per_failure = 4;
  std::size_t failures_ = 0;  ///< in a row, halved by each success
  std::size_t passed_ = 0;    ///< occasions since the last search
};

}  // namespace outrider
