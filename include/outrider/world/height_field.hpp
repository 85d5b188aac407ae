// HeightField: ground that is not flat, as heights on a lattice of posts.
//
// Between four posts lie two triangles, joined along the diagonal from the lowest x and y to the highest:
// the surface that physics engines collide with. On it every question has an exact answer. The ground is
// everything below the surface, over the bounds of the lattice; beyond them there is none, but heights and
// slopes are those of the nearest point of the edge.
// Units: metres in the world's frame. Thread rule: const queries may run concurrently.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/vec.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

class HeightField {
 public:
  static constexpr std::size_t most_posts = std::size_t{1} << 22;

  /// Heights row by row from the lowest y. Refused (bad_input): fewer than 2 posts a side or more than
  /// `most_posts`, a spacing that is not above 0, heights that are too few, too many, not finite or beyond
  /// 1e6 m. O(posts).
  static Outcome<HeightField> make(Vec2 origin, Vec2 spacing_m, int columns, int rows,
                                   std::vector<double> heights_m);
  /// What make() says of the numbers of posts: for readers, before they allocate.
  static Status check_size(double columns, double rows);

  [[nodiscard]] Vec2 spacing_m() const { return spacing_m_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] Box2 bounds() const;
  [[nodiscard]] Vec3 post(int column, int row) const;

  [[nodiscard]] double lowest_m() const { return lowest_m_; }
  [[nodiscard]] double highest_m() const { return highest_m_; }
  /// Tangent of the steepest slope of any triangle.
  [[nodiscard]] double steepest() const { return steepest_; }
  /// The steeper slope of the two triangles of a cell.
  [[nodiscard]] double steepest_in(Cell cell) const;
  /// Lowest and highest point over a box; of the nearest edge where it lies beyond. O(cells in the box).
  [[nodiscard]] Interval heights_over(const Box2& box) const;

  /// The cell that holds p, or the nearest one. O(1).
  [[nodiscard]] Cell cell_at(Vec2 p) const { return place(p).cell; }
  [[nodiscard]] double height(Vec2 p) const;  ///< O(1)
  [[nodiscard]] Vec2 gradient(Vec2 p) const;  ///< of the triangle at p; O(1)
  [[nodiscard]] Vec3 normal(Vec2 p) const;    ///< of the triangle at p, upwards, of length 1; O(1)
  /// Distance from p to the ground; 0 on it or below it. Exact: branch and bound over a pyramid of highest
  /// points. About O(log posts) near the ground.
  [[nodiscard]] double distance(Vec3 p) const;
  /// A straight segment of the plane laid on the surface: its ends and every point where it passes from one
  /// triangle to another, in order. O(cells that it crosses).
  [[nodiscard]] std::vector<Vec3> drape(Segment s) const;
  /// The length of that. Never less than the segment's own.
  [[nodiscard]] double length(Segment s) const;
  /// The point of the segment that is that far from its first end along the surface; the last end at most.
  [[nodiscard]] Vec2 walked(Segment s, double way_m) const;

 private:
  struct Layer {  ///< highest points of square blocks of cells
    int columns = 0;
    int rows = 0;
    std::vector<double> highest_m;
  };
  struct Place {  ///< in a cell, from 0 to 1 along both of its sides
    Cell cell;
    Vec2 in;
  };
  struct Nearest;

  HeightField() = default;
  void build_pyramid();
  [[nodiscard]] Place place(Vec2 p) const;
  [[nodiscard]] double at(int column, int row) const {
    return heights_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column)];
  }

  Vec2 origin_;
  Vec2 spacing_m_{1.0, 1.0};
  int columns_ = 0;
  int rows_ = 0;
  std::vector<double> heights_m_;
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
  double steepest_ = 0.0;
  std::vector<Layer> pyramid_;  // of 1, 2, 4, ... cells a side, the last of one block
};

}  // namespace outrider
