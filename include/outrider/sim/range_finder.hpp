// RangeFinder: what a laser sees of a world in the plane at its height.
//
// The plane cuts the solids in rounded polygons, and each of them is its outline: straight edges and, where
// it is round, circles about the corners of its core. A beam ends at the first outline that it meets, which
// is exact up to rounding, from wherever no piece is; ends of edges count, so nothing is seen through a
// joint. A scan treats each edge near the laser once, with the beams between its ends: O(edges within range +
// beams that they take). Thread rule: const queries may run concurrently.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/sim/explorer_sim_params.hpp"
#include "outrider/slam/laser_scan.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// What a horizontal plane so far above the floor cuts of the solids.
std::vector<RoundedPolygon> cut_at(const World& world, double height_m);

class RangeFinder {
 public:
  RangeFinder(const World& world, const RangeFinderModel& model)
      : RangeFinder(cut_at(world, model.height_m), model) {}
  RangeFinder(const std::vector<RoundedPolygon>& pieces, const RangeFinderModel& model);

  /// Exact distance along each of so many beams, the first ahead, counter-clockwise, m; infinite where
  /// nothing stands within the laser's range.
  [[nodiscard]] std::vector<double> ranges(const Pose2& world_T_laser, std::int64_t beams) const;
  /// The same as the laser measures it: with noise, its least and most range, and no reading from some beams.
  LaserScan look(const Pose2& world_T_laser, double time_s, Rng& rng) const;

  /// Whether the segment keeps more than 1e-9 m from every outline.
  [[nodiscard]] bool sees(Vec2 from, Vec2 to) const;
  /// Distance to the nearest outline, m; `most_m` when none is nearer.
  [[nodiscard]] double surface_distance(Vec2 p, double most_m) const;
  /// The box around all outlines; empty without one.
  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  [[nodiscard]] const RangeFinderModel& model() const { return model_; }

 private:
  /// An edge, or a circle where radius > 0.
  struct Outline {
    Segment edge;
    double radius_m = 0.0;
    bool solid_left = false;  ///< so beams from there do not end at it
  };
  struct Tiles {
    int x0, x1, y0, y1;
  };

  void add(const RoundedPolygon& piece);
  void sort_into_tiles();
  [[nodiscard]] Tiles tiles_of(const Box2& box) const;
  template <class Visit>
  void visit_near(const Box2& box, Visit visit) const;

  RangeFinderModel model_;
  Box2 bounds_;
  std::vector<Outline> outlines_;
  std::vector<Tiles> tiles_;  // of the outlines, by index
  double tile_m_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;  // tile -> first entry in items_, one more at the end
  std::vector<std::uint32_t> items_;  // numbers of outlines, tile by tile
};

}  // namespace outrider
