// GapMeasure: how wide a gap is before which a robot stands, finer than the cells of its map.
//
// Surfaces are those of jobs/explore/map/close_range.hpp. Each scan gives a width; the gap has their median,
// once there are enough. For gaps about as wide as the robot its error is up to about a centimetre.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/explore/choose/left_over.hpp"
#include "outrider/jobs/explore/map/close_range.hpp"
#include "outrider/nodes/robot_frames.hpp"
#include "outrider/nodes/scan_points.hpp"

namespace outrider {

class GapMeasure {
 public:
  /// Takes the newest scan of a robot whose frames these are. Nothing happens if it was taken before, or if
  /// the frames do not know where it was taken.
  void add(const ScanPoints& scan, const RobotFrames& frames);
  /// Looks at the way ahead of a robot that stands before a gap. Only the first look after a scan counts.
  void look(const NarrowWay& way, const Pose2& map_T_robot, double radius_m);
  /// Forgets what was measured; the surfaces stay.
  void begin_anew() { rooms_.clear(); }

  /// Returns the narrowest place of the way, with its width; nothing before enough scans were looked at.
  [[nodiscard]] std::optional<NarrowPlace> gap() const;

 private:
  CloseRange close_range_;
  double scan_s_ = -1.0,
         looked_s_ = -1.0;       ///< times of the newest scan, and of the newest that was looked at
  Pose2 odometry_;               ///< at the time of the newest scan
  std::vector<PathRoom> rooms_;  ///< by scan
};

}  // namespace outrider
