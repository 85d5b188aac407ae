// LayerProgramme: the plain vectorised dynamic programme of a pursuit, as a yardstick of costs and times.
//
// It goes forward from second to second over all cells in the box that the robot can have reached and from
// which it can still reach a cell of the target. It knows no other bound and yields no path. The compiler
// vectorises its loops. It shares no code with the planners.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/pursuit/problem.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define OUTRIDER_VECTORISED __attribute__((target_clones("avx2", "default"), optimize("O3")))
#else
#define OUTRIDER_VECTORISED
#endif

namespace outrider::testing {

/// left[x] = min(most, paid[x] + cost[x]), then least[x] = min(left[x], left[x + 1], left[x + 2]).
OUTRIDER_VECTORISED inline void programme_row(const std::uint32_t* __restrict paid,
                                              const std::uint32_t* __restrict cost,
                                              std::uint32_t* __restrict left, std::uint32_t* __restrict least,
                                              int count, std::uint32_t most) {
  for (int x = 0; x < count + 2; ++x) {
    const std::uint32_t sum = paid[x] + cost[x];
    left[x] = sum < most ? sum : most;
  }
  for (int x = 0; x < count; ++x) {
    const std::uint32_t two = left[x] < left[x + 1] ? left[x] : left[x + 1];
    least[x] = two < left[x + 2] ? two : left[x + 2];
  }
}

OUTRIDER_VECTORISED inline void programme_least(const std::uint32_t* __restrict a,
                                                const std::uint32_t* __restrict b,
                                                const std::uint32_t* __restrict c,
                                                std::uint32_t* __restrict least, int count) {
  for (int x = 0; x < count; ++x) {
    const std::uint32_t two = a[x] < b[x] ? a[x] : b[x];
    least[x] = two < c[x] ? two : c[x];
  }
}

class LayerProgramme {
 public:
  explicit LayerProgramme(const PursuitProblem& problem)
      : problem_(problem),
        frame_(problem.costs->frame),
        stride_(static_cast<std::size_t>(frame_.width) + 2),
        cost_(stride_ * (static_cast<std::size_t>(frame_.height) + 2), most),
        paid_(cost_.size(), most),
        next_(cost_.size(), most),
        rows_(4 * stride_) {
    for (int y = 0; y < frame_.height; ++y) {
      for (int x = 0; x < frame_.width; ++x) {
        if (!problem.wall({x, y})) cost_[index({x, y})] = std::min(most, (*problem.costs)[{x, y}]);
      }
    }
    find_boxes();
  }

  /// Returns the least cost of a catch; nothing if there is none below 2^30.
  std::optional<std::uint64_t> least_cost() {
    std::optional<std::uint64_t> best;
    paid_[index(problem_.start)] = 0;
    for (std::size_t s = 1; s < boxes_.size(); ++s) {
      pass_second(boxes_[s]);
      paid_.swap(next_);
      const Cell target = target_at(s);
      if (problem_.wall(target) || !boxes_[s].has(target) || paid_[index(target)] >= most) continue;
      best = std::min<std::uint64_t>(best.value_or(most), paid_[index(target)]);
    }
    return best;
  }

 private:
  static constexpr std::uint32_t most = 1U << 30U;

  struct Box {
    int left = 0, low = 0, right = -1, high = -1;
    [[nodiscard]] bool has(Cell c) const { return c.x >= left && c.x <= right && c.y >= low && c.y <= high; }
  };

  [[nodiscard]] std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y + 1) * stride_ + static_cast<std::size_t>(c.x + 1);
  }
  [[nodiscard]] Cell target_at(std::size_t s) const {
    return problem_.target[static_cast<std::size_t>(problem_.start_s) + s];
  }

  void find_boxes() {
    boxes_.resize(problem_.target.size() - static_cast<std::size_t>(problem_.start_s));
    Box ahead{frame_.width, frame_.height, -1, -1};
    for (std::size_t s = boxes_.size(); s-- > 0;) {
      const Cell target = target_at(s), start = problem_.start;
      const int away = static_cast<int>(s);
      ahead = {std::max(0, ahead.left - 1), std::max(0, ahead.low - 1),
               std::min(frame_.width - 1, ahead.right + 1), std::min(frame_.height - 1, ahead.high + 1)};
      ahead = {std::min(ahead.left, target.x), std::min(ahead.low, target.y), std::max(ahead.right, target.x),
               std::max(ahead.high, target.y)};
      boxes_[s] = {std::max(ahead.left, start.x - away), std::max(ahead.low, start.y - away),
                   std::min(ahead.right, start.x + away), std::min(ahead.high, start.y + away)};
    }
  }

  /// Cells that the box has left keep what they had; nothing reads them again.
  void pass_second(const Box& box) {
    if (box.right < box.left || box.high < box.low) return;
    const int width = box.right - box.left + 1;
    const auto row = [&](int y) {
      return rows_.data() + static_cast<std::size_t>(1 + (y + 3) % 3) * stride_;
    };
    const auto take = [&](int y) {
      const std::size_t first = index({box.left - 1, y});
      programme_row(paid_.data() + first, cost_.data() + first, rows_.data(), row(y), width, most);
    };
    take(box.low - 1);
    take(box.low);
    for (int y = box.low; y <= box.high; ++y) {
      take(y + 1);
      programme_least(row(y - 1), row(y), row(y + 1), next_.data() + index({box.left, y}), width);
    }
  }

  const PursuitProblem& problem_;
  GridFrame frame_;
  std::size_t stride_;
  std::vector<std::uint32_t> cost_, paid_, next_, rows_;
  std::vector<Box> boxes_;
};

}  // namespace outrider::testing
