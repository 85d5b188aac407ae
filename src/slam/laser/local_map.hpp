// The surfaces around the robot, with which its next scans are matched: those of the last keyframes, and
// those of earlier visits whose pose relative to the last keyframe is well known.
//
// Memory is bounded by the area mapped: where many scans from nearly the same pose are held already, one of
// them is released. Half of those that stay are the first ones, which anchor the map, and half are the last
// ones, which show what has changed since. Source: Kretzschmar and Stachniss, Information-theoretic
// compression of pose graphs for laser-based SLAM, Int. J. Robotics Research 31 (2012) 1219-1230 (dropping
// scans that add nothing; here counted, not weighed).
#pragma once

#include <optional>

#include "laser/keyframe_surfaces.hpp"
#include "scan/surface_map.hpp"

namespace outrider {

class LocalMap {
 public:
  static constexpr int recent_group = 0;
  static constexpr int earlier_group = 1;

  LocalMap(const Pose2& robot_T_laser, double reach_m)
      : surfaces_(robot_T_laser, reach_m), reach_m_(reach_m) {}

  /// Builds the map about a pose after a change of the keyframes. Of the last keyframes it uses those from
  /// `part` on. Releases scans that others make redundant.
  void build(KeyframeGraph& graph, std::size_t part, const Pose2& about);

  /// Returns the surfaces; null before the first build().
  [[nodiscard]] const SurfaceMap* map() const { return map_ ? &*map_ : nullptr; }
  /// Returns the nearest keyframe of earlier visits in the map.
  [[nodiscard]] std::optional<std::uint32_t> anchor() const { return anchor_; }
  /// Returns two keyframes, from `part` on, that stand for all recent ones which the last keyframe was
  /// matched with, and their shares in the match: the older counts as far as it shows the same surface.
  [[nodiscard]] Matched matched(const KeyframeGraph& graph, std::size_t part);
  /// Returns true if the place of the last keyframe has been seen so often that a scan was released.
  [[nodiscard]] bool is_crowded() const { return is_crowded_; }
  [[nodiscard]] KeyframeSurfaces& surfaces() { return surfaces_; }

 private:
  KeyframeSurfaces surfaces_;
  double reach_m_;
  std::optional<SurfaceMap> map_;
  std::optional<std::uint32_t> anchor_;
  bool is_crowded_ = false;
};

}  // namespace outrider
