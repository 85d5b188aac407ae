// HeadingFields: least times over a yard for a robot that turns in place and drives straight
// (heading_bound.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "research/guard/heading_cone.hpp"

namespace outrider {

/// A time in units of HeadingFields::unit_s().
using Units = std::int16_t;
inline constexpr Units never_units = 15000;  // the sum of two fits

/// Some columns and rows of a grid.
struct GridWindow {
  Cell low;  ///< the first
  int columns = 0;
  int rows = 0;
  [[nodiscard]] bool empty() const { return columns <= 0 || rows <= 0; }
};

/// A field of values in a window for each cone; values outside are `never_units`.
class ConeFields {
 public:
  static constexpr int rim = 4;  // cells stored around the window, so that steps from it stay within

  ConeFields() = default;
  ConeFields(const GridWindow& window, std::size_t cones, Units value);

  /// The first value of a row of the window.
  [[nodiscard]] Units* row(std::size_t cone, int row) { return values_.data() + at(cone, row); }
  [[nodiscard]] const Units* row(std::size_t cone, int row) const { return values_.data() + at(cone, row); }
  /// From a value to that of the cell that far away; at most `rim` away from the window.
  [[nodiscard]] std::ptrdiff_t offset(Cell step) const { return stride_ * step.y + step.x; }
  [[nodiscard]] const GridWindow& window() const { return window_; }

 private:
  [[nodiscard]] std::size_t at(std::size_t cone, int row) const {
    const auto stored = static_cast<std::ptrdiff_t>(cone) * (window_.rows + 2 * rim) + rim + row;
    return static_cast<std::size_t>(stored * stride_ + rim);
  }

  GridWindow window_;
  std::ptrdiff_t stride_ = 0;
  std::vector<Units> values_;
};

/// The values for one set of targets.
struct HeadingValues {
  ConeFields moving;   // by tile, of a robot that drives with a heading of the cone
  ConeFields resting;  // by cell, of a robot whose next straight drive has a heading of the cone
};

class HeadingFields {
 public:
  /// Each cell of the firing map is divided into `fine` x `fine` cells.
  HeadingFields(const GuardProblem& problem, const FiringMap& firing_map, int fine);

  [[nodiscard]] double unit_s() const { return unit_s_; }
  /// True when a halt costs more than the way that the robot may be moved for nothing at it.
  [[nodiscard]] bool useful() const;
  /// The window of all tiles that some cells of the firing map share something with.
  [[nodiscard]] GridWindow around(const GridWindow& cells) const;
  /// Number of values in a window.
  [[nodiscard]] double size(const GridWindow& window) const;

  /// All values are the same.
  [[nodiscard]] HeadingValues constant(const GridWindow& window, Units value) const;
  /// Returns for each cell: 0 in the region, `never_units` outside.
  [[nodiscard]] std::vector<Units> mask(const FiringRegion& region) const;
  /// Lowers values to those `after` a target is hit, wherever it can be.
  void hit(const std::vector<Units>& mask, const HeadingValues& after, HeadingValues& values) const;
  /// Lowers values until none exceeds another by more than the time to get there.
  void settle(HeadingValues& values) const;
  /// The least value at the start, where the robot stands with its first heading.
  [[nodiscard]] Units at_start(const HeadingValues& values) const;

 private:
  class Settling;

  [[nodiscard]] Units units(double time_s) const;
  [[nodiscard]] std::vector<Units> crossing(const TileExit& exit) const;
  /// The first of a row of the window, in a field of the whole grid.
  [[nodiscard]] const Units* row(const std::vector<Units>& field, const GridWindow& window, int row) const {
    return field.data() + frame_.index({window.low.x, window.low.y + row});
  }
  void nearby(const ConeFields& resting, std::size_t cone, int row, std::vector<Units>& least) const;

  std::vector<HeadingCone> cones_;
  GridFrame coarse_;  // of the firing map
  GridFrame frame_;   // of the fine cells, with a margin
  int fine_ = 1;
  double unit_s_ = 0.0;
  Units halt_ = 0;                 // of a straight drive, to speed up and slow down
  Units shuffle_ = 0;              // to drive a cell far in short pieces
  std::vector<Units> wall_;        // by cell: 0 where the robot may be, else `never_units`
  std::vector<Units> turn_;        // by cone and cone
  std::vector<Units> first_turn_;  // by cone
  Cell start_;
  std::vector<std::vector<Units>> across_p_, across_q_;  // by cone and tile: the time to the next one
};

}  // namespace outrider
