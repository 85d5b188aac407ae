// CoverageNode: plans a path that covers an area, proves what it covers, and sends it.
//
//   area  geometry_msgs/PolygonStamped    ->   plan             nav_msgs/Path
//   map   nav_msgs/OccupancyGrid               coverage/status  covered share, or the fault of the planner
//
// The area may also come from a file in metres of the map: polygons (io/map/cover_area.hpp) or a saved map
// (jobs/cover/ground/saved_map.hpp). With `from_map` it is the free space of the map on the topic, such as
// map_server sends; a map that has changed is planned anew. A track is sent only if
// prove() (jobs/cover/strokes/plan.hpp) accepts it, and again once in `period`, for who comes later. The
// proof holds for a robot that stays within `tracking_error` of the track; the path on the topic has the
// corners of the track, arcs as chords of 5 degrees.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/cover/scenario.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"

namespace outrider {

struct CoverageNodeOptions {
  FrameNames frames;
  double period_s = 5.0;
  bool from_map = false;  ///< the area is the free space of the map on the topic
  CoverScenario cover;    ///< its area may be empty: then it comes on the topic
};
std::vector<OptionGroup> describe(CoverageNodeOptions& options);

class CoverageNode final : public Node {
 public:
  /// Fault: those of load_task(), and bad_input for an area in degrees, which no map is in, and for an area
  /// and `from_map` together.
  static Outcome<CoverageNodeOptions> checked(CoverageNodeOptions options);
  explicit CoverageNode(CoverageNodeOptions options);

 private:
  Status take_area(const geometry_msgs::PolygonStamped& area);
  Status take_map(const nav_msgs::OccupancyGrid& message);
  void act() override;
  void plan();

  CoverageNodeOptions options_;
  std::optional<CoverTask> task_;
  bool new_task_ = false;
  Grid<std::uint8_t> map_;  ///< of which the task was made
  std::vector<Vec2> track_;
  double sent_s_ = -1e9;
  std::size_t plan_output_;
};

}  // namespace outrider
