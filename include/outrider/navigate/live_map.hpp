// LiveMap: what stands around a robot by what its sensors show now, in a window that moves with the robot.
//
// A mark is a cell in which something was seen or touched, with the place where it was. Each reading that
// ends there adds to the weight of the mark, up to eight; each scan whose beams pass it takes one away, so
// what has gone is forgotten in a fraction of a second, and a reading that was wrong at once. What is out of
// sight stays until it is `forget_s` old. What was touched stays longer, since the laser may not see it.
// A reading with no other beside it, in its scan or in those before, may be wrong: nothing stands there until
// a second one says so. Nothing stands where the robot has driven, whatever noise does.
//
// Walls of a known map are marks as well, and stay however old. A reading beside one moves it to where it is
// seen; beams that pass it take it away until the window has left it, as a door that stands open.
//
// Frames: the world of the localiser. Small corrections of the pose smear marks; later beams clear them.
// Thread rule: one at a time. O(beams + marks in range) per scan.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/footprint.hpp"
#include "outrider/navigate/allowed_ground.hpp"
#include "outrider/slam/scan/laser_scan.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Options of the live map.
struct LiveMapOptions {
  double resolution_m = 0.05;  ///< side of a cell
  double reach_m = 10.0;       ///< half the side of the window
  double forget_s = 30.0;      ///< time after which a mark out of sight is forgotten
  double touch_s = 120.0;      ///< time after which what was touched is forgotten
  double remember_s = 300.0;   ///< time for which ways on a known map go around what was seen far from here
};
std::vector<Option> describe(LiveMapOptions& options);

/// Something that stands in a cell.
struct Mark {
  Vec2 place;             ///< mean of the newest readings
  double seen_s = 0.0;    ///< time of the newest reading
  double first_s = 0.0;   ///< time since which something has stood in the cell
  int weight = 0;         ///< 0: nothing stands there
  bool touched = false;   ///< the bumper found it
  bool mapped = false;    ///< it is a wall of the known map
  bool moving = false;    ///< it is part of something that moves
  bool lone = false;      ///< one reading says so and none beside it; it may be wrong
  bool sure = false;      ///< it was touched, or its weight was once that of three readings
  double looked_s = 0.0;  ///< time of the newest scan that said something in its direction

  /// Returns true if something stands there for sure.
  [[nodiscard]] bool stands() const { return !moving && !lone; }
};

class LiveMap {
 public:
  using Walls = std::shared_ptr<const std::vector<Vec2>>;

  /// Makes an empty map around a place.
  LiveMap(const LiveMapOptions& options, Vec2 middle);

  /// Takes the walls of a known map, or with nothing forgets them.
  void know(Walls walls);
  /// Nobody may leave that ground: its edges stand in the way, whatever beams say. What is seen at an edge,
  /// or beyond it, is the edge.
  void limit(const AllowedGround& ground);
  /// Moves the window, in whole cells, once the robot is a quarter of the reach from its middle.
  void follow(Vec2 robot);
  /// Moves all marks but walls because the pose was corrected: from where they were to `correction` times
  /// that.
  void correct(const Pose2& correction);
  /// Notes a scan that was taken from there. Readings that are no numbers or out of range say nothing.
  void note(const LaserScan& scan, const Pose2& world_T_laser);
  /// Notes that the robot touched something there.
  void note_touch(Vec2 place, double time_s);
  /// Nothing but what was touched later stands where the robot is, inside of its footprint.
  void keep_open(const Footprint& footprint, const Pose2& pose);
  /// Forgets marks that are too old at that time.
  void forget(double time_s);
  /// Forgets the marks that the laser looked at within the last `lately_s` and did not see; walls stay, and
  /// what is where it does not look.
  void forget_but(double time_s, double lately_s);

  [[nodiscard]] const GridFrame& frame() const { return cells_.frame; }
  [[nodiscard]] const LiveMapOptions& options() const { return options_; }
  [[nodiscard]] bool marked(Cell cell) const { return cells_.contains(cell) && cells_[cell] != 0; }
  /// Returns all marks, in the order in which they were made.
  [[nodiscard]] const std::vector<Mark>& marks() const { return marks_; }
  /// Marks that lie in one of these disks, and are newer than a second, are moving, the others not.
  void set_moving(const std::vector<RoundedPolygon>& disks);
  /// Takes points of surfaces that are known better than what was seen or touched within `reach_m` of a
  /// place; with nothing, forgets them.
  void look_close(std::vector<Vec2> surfaces, Vec2 from, double reach_m);
  /// Returns the places of what stands near a robot: marks, and better known surfaces.
  [[nodiscard]] std::vector<Vec2> close_places() const;
  /// Returns the points of the edges of the allowed ground.
  [[nodiscard]] const std::vector<Vec2>& edges() const { return edges_; }
  /// Returns the places of all marks that stand, and the edges of the allowed ground in the window.
  [[nodiscard]] std::vector<Vec2> places() const;
  /// Returns what was seen for sure and is now out of the window or forgotten in it, oldest first.
  [[nodiscard]] const std::vector<Mark>& behind() const { return behind_; }
  /// Counts changes: marks that came or went for sure.
  [[nodiscard]] std::uint64_t changes() const { return changes_; }

 private:
  void mark(Vec2 place, double time_s, int weight, bool touched);
  void mark_lone(Vec2 place, double time_s);
  void confirm(Mark& mark);
  template <class Visit>
  void for_each_beside(Cell cell, Visit visit);
  bool take_wall_beside(Cell cell);
  void move_window(Vec2 off);
  void mark_walls(const GridFrame* known);
  void leave_behind(const Mark& mark);
  template <class Gone>
  void erase_marks(Gone gone);
  void clear_seen_through(const LaserScan& scan, const Pose2& world_T_laser);

  LiveMapOptions options_;
  Grid<std::uint32_t> cells_;  // 0: no mark, else its index in marks_ plus one
  std::vector<Mark> marks_;
  std::uint64_t changes_ = 0;
  Walls walls_;
  std::vector<Mark> behind_;
  std::optional<AllowedGround> allowed_;
  std::vector<Vec2> edges_;
  std::vector<Vec2> surfaces_;  // known better than marks
  Vec2 looked_from_;
  double looked_m_ = 0.0;
};

}  // namespace outrider
