// RangeFinder: simulates a laser scanner in the horizontal plane at its height.
//
// The plane cuts the solids into rounded polygons. The outline of each polygon consists of straight edges
// and, if it is rounded, of circles about the corners of its core. A beam ends at the first outline that it
// meets. Ranges are exact up to rounding if the laser is outside all solids; edges include their end points,
// so no beam passes between two joined edges. A scan processes each edge near the laser once, with the beams
// between its ends: O(edges within range + beams that hit them). Thread rule: const queries may run
// concurrently.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/sim/faults/explorer_sim_params.hpp"
#include "outrider/slam/scan/laser_scan.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// Returns the sections of the solids in the horizontal plane `height_m` above the floor.
std::vector<RoundedPolygon> cut_at(const World& world, double height_m);

class RangeFinder {
 public:
  RangeFinder(const World& world, const RangeFinderModel& model)
      : RangeFinder(cut_at(world, model.height_m), model) {}
  RangeFinder(const std::vector<RoundedPolygon>& pieces, const RangeFinderModel& model);

  /// Returns the exact range of each beam, m; infinite if nothing is within the laser's range. The first beam
  /// points ahead; the order is counter-clockwise.
  [[nodiscard]] std::vector<double> ranges(const Pose2& world_T_laser, std::int64_t beams) const;
  /// Returns a scan as measured by the laser: with noise, minimum and maximum range, and missed readings. Its
  /// numbers are single precision, as sensor_msgs/LaserScan has them; infinite where there is no return.
  LaserScan look(const Pose2& world_T_laser, double time_s, Rng& rng) const {
    return measured(ranges(world_T_laser, model_.beams), time_s, rng);
  }
  /// Returns a scan that sees also what the other range finder sees, which has the same model.
  LaserScan look(const Pose2& world_T_laser, double time_s, Rng& rng, const RangeFinder& other) const;

  /// Returns true if there is a line of sight: the segment stays more than 1e-9 m away from every outline.
  [[nodiscard]] bool sees(Vec2 from, Vec2 to) const;
  /// Returns the distance to the nearest outline, m, cut off at `most_m`.
  [[nodiscard]] double surface_distance(Vec2 p, double most_m) const;
  /// Returns the bounding box of all outlines; empty if there are none.
  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  [[nodiscard]] const RangeFinderModel& model() const { return model_; }

 private:
  /// An edge, or a circle where radius > 0.
  struct Outline {
    Segment edge;
    double radius_m = 0.0;
    bool solid_left = false;  ///< the solid lies to the left; beams from that side pass through
  };
  struct Tiles {
    int x0, x1, y0, y1;
  };

  LaserScan measured(const std::vector<double>& ranges_m, double time_s, Rng& rng) const;
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
