// Worlds in which things and people move, drawn from their numbers.
//
//   posts        a walled field with 5 to 15 round posts of 0.2 to 0.5 m radius, which move along polynomials
//                of order 1 to 4 through random points, at 0.2 to 2 m/s, whatever is in their way; there and
//                back. After Nair et al., DynaBARN: benchmarking metric ground navigation in dynamic
//                environments (SSRR 2022)
//   social       a hall of 18 m by 8 m with up to 4 pillars and 5 to 30 people, who keep away from each other
//                and from the robot (walk_ins.hpp), at 0.6 to 1.2 m/s
//   inattentive  the same, but they do not heed the robot
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/sim/faults/walk_ins.hpp"
#include "outrider/world/world.hpp"

namespace outrider::bench {

struct HallWorld {
  World world;
  Pose2 start;
  Vec2 goal;
  double speed_mps = 1.0;  ///< full speed of the robot
  WalkInOptions walkers;
};

/// A kind of worlds, with numbers from 1 on.
struct HallKind {
  std::string_view name;
  std::string_view sentence;
  std::int64_t worlds = 0;
  HallWorld (*draw)(std::int64_t number);
};
const std::vector<HallKind>& hall_kinds();

}  // namespace outrider::bench
