// HeightField: uneven ground, given by heights on a lattice of posts.
//
// Each square of four posts is divided into two triangles along the diagonal from the lowest x and y to the
// highest, which is the surface that physics engines use for collisions. All queries are exact on it. The
// ground is everything below the surface, within the bounds of the lattice. Outside the bounds there is no
// ground, but heights and slopes are those of the nearest point of the edge.
// Units: metres in the world frame. Thread rule: const queries may run concurrently.
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

  /// Makes a field from heights given row by row from the lowest y. Fault: bad_input for fewer than 2 posts
  /// on a side or more than `most_posts`, a spacing that is not above 0, a wrong number of heights, and
  /// heights or bounds that are not finite or beyond 1e6 m. O(posts).
  static Outcome<HeightField> make(Vec2 origin, Vec2 spacing_m, int columns, int rows,
                                   std::vector<double> heights_m);
  /// Checks the numbers of posts as make() does, so that readers can check them before they allocate memory.
  static Status check_size(double columns, double rows);

  [[nodiscard]] Vec2 spacing_m() const { return spacing_m_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] Box2 bounds() const;
  [[nodiscard]] Vec3 post(int column, int row) const;

  [[nodiscard]] double lowest_m() const { return lowest_m_; }
  [[nodiscard]] double highest_m() const { return highest_m_; }
  /// Returns the tangent of the steepest slope of all triangles.
  [[nodiscard]] double steepest() const { return steepest_; }
  /// Returns the tangent of the slope of the steeper triangle of a cell.
  [[nodiscard]] double steepest_in(Cell cell) const;
  /// Returns the lowest and the highest post of the cells that the box touches, which bound the heights over
  /// the box. Outside the lattice, the nearest cells count. O(cells in the box).
  [[nodiscard]] Interval heights_over(const Box2& box) const;

  /// Returns the cell that contains p, or the nearest one. O(1).
  [[nodiscard]] Cell cell_at(Vec2 p) const { return place(p).cell; }
  [[nodiscard]] double height(Vec2 p) const;  ///< O(1)
  [[nodiscard]] Vec2 gradient(Vec2 p) const;  ///< of the triangle at p; O(1)
  [[nodiscard]] Vec3 normal(Vec2 p) const;    ///< of the triangle at p, upwards, of length 1; O(1)
  /// Returns the distance from p to the ground; 0 on or below the surface. Exact: branch and bound over a
  /// pyramid of maximum heights. About O(log posts) near the ground.
  [[nodiscard]] double distance(Vec3 p) const;
  /// Projects a segment vertically onto the surface: returns its ends and all points where it passes from one
  /// triangle to another, in order. O(cells that it crosses).
  [[nodiscard]] std::vector<Vec3> drape(Segment s) const;
  /// Returns the length of a segment along the surface; it is at least the length of the segment.
  [[nodiscard]] double length(Segment s) const;
  /// Returns the point of the segment at the distance `way_m` from its first end along the surface, at most
  /// its last end.
  [[nodiscard]] Vec2 walked(Segment s, double way_m) const;

 private:
  struct Layer {  ///< maximum heights of square blocks of cells
    int columns = 0;
    int rows = 0;
    std::vector<double> highest_m;
  };
  struct Place {  ///< a cell and a position in it, from 0 to 1 along both sides
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
  std::vector<Layer> pyramid_;  // layers with blocks of 1, 2, 4, ... cells a side; the last has one block
};

}  // namespace outrider
