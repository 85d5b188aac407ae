// PriceSearch: finds the price of a second with the best lower bound of a pursuit.
//
// The bound is a concave, piecewise linear function of the price. It is evaluated by relaxations
// (relaxation.hpp), at the price where the line of the latest path in time and that of the latest late path
// meet, until neither improves. Paths in time are catches.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bounds/relaxation.hpp"

namespace outrider {

class PriceSearch {
 public:
  /// `catches` are the seconds of possible catches; `dearest` is the largest price, in parts, that is no more
  /// than the cost of any reached cell. `known` is a way in time. The field and `reached` must outlive it.
  PriceSearch(const PursuitField& field, const CellSet& reached, std::span<const int> catches,
              std::int64_t dearest, const TimedWay& known);

  /// Runs one relaxation. Returns false if the budget ended first.
  bool run(BudgetMeter& meter);

  /// Returns true if no price has a better bound.
  [[nodiscard]] bool finished() const { return !running_; }
  /// Returns the number of relaxations that have run.
  [[nodiscard]] std::size_t count() const { return relaxations_.size(); }
  /// Returns the lower bound by the latest relaxation of the cost from the start on, in parts.
  [[nodiscard]] std::int64_t bound() const { return bound_; }
  /// Returns the way of the latest relaxation, if it is in time.
  std::optional<TimedWay> take_way() { return std::exchange(way_, std::nullopt); }

  /// Ends the search. Keeps the relaxation that is exact if time does not matter, and those with the best
  /// bounds, up to that number.
  void keep_best(std::size_t most);
  [[nodiscard]] Relaxations relaxations() const { return relaxations_; }
  /// Returns the relaxation with the best bound so far.
  [[nodiscard]] const Relaxation& best() const;

 private:
  /// The relaxed cost of a path as a linear function of the price of a second that it has left (or lacks).
  struct Line {
    std::int64_t cost = 0;
    std::int64_t slack_s = 0;
    [[nodiscard]] std::int64_t at(std::int64_t price) const { return cost + price * slack_s; }
  };
  [[nodiscard]] Line line_of(const TimedWay& way) const;
  [[nodiscard]] static std::int64_t crossing(const Line& rising, const Line& falling);
  void relax_at(std::int64_t price);

  const PursuitField* field_;
  const CellSet* reached_;
  std::vector<int> catches_;
  std::int64_t dearest_;
  Line in_time_, too_late_;  // the latest relaxed ways of either kind
  std::unique_ptr<Relaxation> running_;
  std::vector<std::unique_ptr<Relaxation>> relaxations_;
  std::int64_t bound_ = 0;
  std::optional<TimedWay> way_;
};

}  // namespace outrider
