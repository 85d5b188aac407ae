// RowRuns: numbers the runs of equal cells along the rows of a map, in their order.
//
// A bit for each cell says whether a run begins there, and each word of bits has the number of runs before
// it: a quarter of a byte a cell.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace outrider {

class RowRuns {
 public:
  RowRuns() = default;
  /// `begins(i)` returns true if a run begins at the cell with that index; one does at the first cell.
  /// O(size).
  template <class Begins>
  RowRuns(std::uint32_t size, const Begins& begins) : words_((size + 31) / 32) {
    if (size > 0) words_[0].begins = 1;
    for (std::uint32_t i = 1; i < size; ++i) words_[i / 32].begins |= (begins(i) ? 1U : 0U) << (i % 32);
    number();
  }
  /// Lets a run begin at a cell; number() has to follow.
  void begin_at(std::uint32_t i) { words_[i / 32].begins |= 1U << (i % 32); }
  /// Joins runs with those before them, except the first one and those of which keeps(first cell) is true.
  template <class Keeps>
  void join(const Keeps& keeps) {
    for (std::uint32_t w = 0; w < words_.size(); ++w) {
      for (std::uint32_t left = words_[w].begins; left != 0; left &= left - 1) {
        const std::uint32_t i = 32 * w + static_cast<std::uint32_t>(std::countr_zero(left));
        if (i > 0 && !keeps(i)) words_[w].begins &= ~(1U << (i % 32));
      }
    }
    number();
  }
  /// Numbers the runs.
  void number() {
    count_ = 0;
    for (Word& word : words_) {
      word.before = count_;
      count_ += ones(word.begins);
    }
  }
  [[nodiscard]] std::uint32_t count() const { return count_; }
  [[nodiscard]] bool begins(std::uint32_t i) const { return (words_[i / 32].begins >> (i % 32) & 1U) != 0; }
  /// Returns the number of the run of a cell. O(1).
  [[nodiscard]] std::uint32_t at(std::uint32_t i) const {
    const Word& word = words_[i / 32];
    return word.before + ones(word.begins << (31 - i % 32)) - 1;
  }

 private:
  struct Word {
    std::uint32_t begins = 0;
    std::uint32_t before = 0;
  };

  /// Counts bits in parallel, since not every processor has an instruction for it.
  static std::uint32_t ones(std::uint32_t bits) {
    bits -= bits >> 1U & 0x55555555U;
    bits = (bits & 0x33333333U) + (bits >> 2U & 0x33333333U);
    return ((bits + (bits >> 4U)) & 0x0F0F0F0FU) * 0x01010101U >> 24U;
  }

  std::vector<Word> words_;
  std::uint32_t count_ = 0;
};

/// Goes through the cells of a map in order, and knows the run of the present one.
class RunCursor {
 public:
  explicit RunCursor(const RowRuns& runs) : runs_(runs) {}
  /// Goes to the next cell, whose index is i.
  void step(std::uint32_t i) { run_ += runs_.begins(i) ? 1 : 0; }
  [[nodiscard]] std::uint32_t run() const { return run_ - 1; }

 private:
  const RowRuns& runs_;
  std::uint32_t run_ = 0;  // number of runs that have begun
};

}  // namespace outrider
