// GapPassage: how a robot passes through places that its map calls too narrow.
//
// If nothing else is left to see, the robot opens the roomiest passage in which it may fit all the same. It
// looks at the gap from near (close_range.hpp), centres its path between the surfaces there, drives slowly,
// and notes the width of a gap in which it does not fit. The width is judged before the robot is in the gap:
// next to the rim, the noise of a corner narrows it. Until it is sure, the robot stands before the gap.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outrider/jobs/explore/choose/left_over.hpp"
#include "outrider/jobs/explore/mission/scan_localiser.hpp"
#include "outrider/jobs/explore/mission/task.hpp"

namespace outrider {

/// The purpose of the path that the robot follows.
enum class Driving { to_goal, home };

class GapPassage {
 public:
  /// Looks at narrow places ahead, once a scan, and centres the path there between what is seen and touched.
  /// Returns false where the gap ahead is too narrow; then the robot has to go elsewhere.
  bool look(const ExploreTask& task, const ScanLocaliser& where, TraversabilityGrid& ground,
            const std::vector<Vec2>& touched, PathProgress* path, Driving driving);
  /// The path is another one.
  void forget_path() { centred_scan_ = -1; }

  /// Opens the roomiest way that is worth a try, or of those that begin in sight of a place and within 2 m.
  /// Returns the sentence of the try, which is empty for a place that was tried before, or nothing if there
  /// is no such way.
  std::optional<std::string> open_way(const LeftOvers& left, std::optional<Vec2> beside,
                                      TraversabilityGrid& ground);
  /// Shuts the gaps that were measured and found too narrow, whatever the map shows there.
  void shut_gaps(TraversabilityGrid& ground) const;
  /// Notes that the robot got stuck at the narrowest place ahead. Returns true if that counts as too narrow.
  bool note_stuck(const ScanLocaliser& where, const TraversabilityGrid& ground);
  /// Returns the sentence about the gap that was last measured and found too narrow.
  [[nodiscard]] std::string sentence() const;

  [[nodiscard]] bool in_narrow() const { return room_.has_value(); }
  /// False while the robot has to stand before the gap.
  [[nodiscard]] bool may_pass() const { return fits_; }
  /// Returns the surfaces right around the robot; none while it is not in a narrow place.
  [[nodiscard]] std::vector<Vec2> surfaces() const { return in_narrow() ? surfaces_ : std::vector<Vec2>{}; }
  /// Returns the order to drive through the middle of the narrow places. Pre: in_narrow().
  [[nodiscard]] Follow order(const PathProgress& path, const RobotModel& robot) const;
  [[nodiscard]] const std::vector<NarrowPlace>& places() const { return places_; }

 private:
  NarrowPlace& at(Vec2 place);
  bool judge(const ExploreTask& task, const ScanLocaliser& where, const TraversabilityGrid& ground);
  bool note(const ScanLocaliser& where, const TraversabilityGrid& ground, bool measured);

  std::int64_t centred_scan_ =
      -1;                         ///< number of scans when the path was last centred; -1: it is another path
  std::optional<PathRoom> room_;  ///< set while the path leads through narrow places
  std::vector<Vec2> surfaces_;    ///< right around the robot, while `room_` is set
  bool fits_ = true;              ///< false: `room_` is surely too little, and the robot stands
  GapLooks looks_;                ///< at the narrowest place ahead, from a distance
  std::vector<NarrowPlace> places_;  ///< those that were found to be too narrow, or tried
  NarrowPlace newest_;               ///< the one that was noted last
};

}  // namespace outrider
