// Navigator: gets a robot where a mission wants it, around what no map has.
//
//   auto navigator = Navigator::make(setup, start);
//   for (;;) {
//     const Situation now = navigator->perceive(robot.sense());
//     robot.act(navigator->act(GoTo{goal}));
//   }
//
// perceive() localises the robot, brings the live map up to date (live_map.hpp) and judges the progress. On a
// known map a robot need not know where it starts: it looks around until it recognises the place, and again
// after it was carried away.
// act() plans anew when the map has changed (goal_field.hpp), finds the next motion (local_motion.hpp) and
// recovers when nothing goes on: it forgets what it has not seen lately, turns to where the way leads, backs
// off, and after all of that several times in vain gives up with a reason. A robot that steers like a car
// drives a curved way (curved_way.hpp), which is planned again when something stands on it, and arcs to get
// out. Every answer is a DriveTwist for one period. It never commands a motion from which the robot could not
// brake before what is marked, nor one into a keep-out zone (zones.hpp); a robot that was carried into one
// drives straight out of it, and does nothing else.
//
// Deterministic: a pure function of the observations and orders so far. Thread rule: one at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "outrider/core/units.hpp"
#include "outrider/navigate/allowed_ground.hpp"
#include "outrider/navigate/local_motion.hpp"
#include "outrider/navigate/map_field.hpp"
#include "outrider/navigate/place_search.hpp"
#include "outrider/navigate/recent_odometry.hpp"
#include "outrider/navigate/robot_localiser.hpp"
#include "outrider/navigate/track_follower.hpp"
#include "outrider/navigate/zones.hpp"
#include "outrider/robot/command.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// Drive to a place, by any way that is safe and fast. Without a heading, to pass by there; with one, to
/// stand there with it, or with any if `within_rad` is pi.
struct GoTo {
  Vec2 place;
  double within_m = 0.1;
  std::optional<double> heading_rad = {};
  double within_rad = radians(5.0);
  friend bool operator==(const GoTo&, const GoTo&) = default;
};
/// Drive this track, and leave it only around what stands on it. What was left out is told at the end.
struct Follow {
  std::shared_ptr<const TrackPieces> track;  ///< at least one piece; another object is another order
  double beside_m = 0.05;                    ///< a robot so far beside it drives back to it
  double margin_m = 1.0;                     ///< room beside the footprint, at most that of the motion
  double most_mps = 1e3;                     ///< it drives no faster
};
/// Stand where it is.
struct Hold {};
using Order = std::variant<GoTo, Follow, Hold>;

/// How far an order is.
struct Progress {
  enum class State { underway, arrived, blocked, lost };
  State state = State::underway;
  std::optional<double> left_s = {};  ///< to the goal, as planned last; nothing if no way is known
  std::string why = {};               ///< one sentence if it is blocked or lost
};

/// The present situation, for a mission.
struct Situation {
  double time_s = 0.0;
  Pose2 pose;                                            ///< world_T_robot, as believed
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< covariance of x, y and heading in the world
  Twist2 twist;                                          ///< present
  Progress progress;
};

/// Options of the navigator besides those of its parts.
struct NavigatorOptions {
  std::string localiser = "auto";  ///< row of robot_localisers(); auto: by laser, on the map if there is one
  double period_s = 0.05;          ///< time between two commands
  double plan_again_s = 0.2;       ///< least time between two plans
  double patience_s = 3.0;         ///< time without progress after which it recovers
  double blind_s = 0.5;  ///< time without a scan after which it stands; after 20 times that it is lost
  std::int64_t most_recoveries = 12;  ///< number of recoveries in a row after which it gives up
  double most_search_m = 60.0;  ///< way after which a robot that does not recognise where it is gives up
};
std::vector<Option> describe(NavigatorOptions& options);

/// The robot and the options of all parts.
struct NavigatorSetup {
  RobotModel robot;
  Footprint footprint = Footprint::disk(0.26);
  Pose2 robot_T_laser;
  NavigatorOptions options;
  LiveMapOptions map;
  LocalMotionOptions motion;
  std::optional<KnownMap> known = {};         ///< the map that the robot is given
  std::optional<AllowedGround> allowed = {};  ///< what it may not leave; none: nothing
  std::optional<TagsInSight> tags = {};       ///< the tags that it may see
  std::vector<Zone> zones = {};               ///< in the world of the localiser
  ZoneOptions keep = {};                      ///< how it keeps to them, and to a side of passages
};

class Navigator {
 public:
  /// Without a start the robot is anywhere on its map. Faults: bad_input if there is no such rule of motion
  /// or localiser; those of the localiser.
  static Outcome<Navigator> make(NavigatorSetup setup, const std::optional<Pose2>& start);
  /// The same with the localiser of a mission that makes a map itself.
  static Outcome<Navigator> make(NavigatorSetup setup, std::unique_ptr<RobotLocaliser> localiser);

  Situation perceive(const Observation& seen);
  Command act(const Order& order);
  /// Takes surfaces within `reach_m` of the robot that a mission knows better than the live map; they count
  /// until the next call.
  void look_close(std::vector<Vec2> surfaces, double reach_m) {
    map_.look_close(std::move(surfaces), pose().position, reach_m);
  }
  /// Notes points of what a mission knows that the robot has touched.
  void note_touched(const std::vector<Vec2>& places);

  [[nodiscard]] const LiveMap& map() const { return map_; }
  /// Returns the way that is planned from here to the place of a GoTo, at most about that long.
  [[nodiscard]] std::vector<Vec2> way(double most_m) const;
  /// Returns what moves around the robot.
  [[nodiscard]] const std::vector<MovingThing>& moving() const { return moving_; }
  /// Returns true if the robot knows where it is; until then its poses have no meaning.
  [[nodiscard]] bool is_located() const { return localiser_->is_located(); }
  [[nodiscard]] std::int64_t recoveries() const { return recoveries_; }
  /// Returns how the track of the order is followed; nothing without one.
  [[nodiscard]] const TrackFollower* track() const { return track_.follower ? &*track_.follower : nullptr; }

 private:
  Navigator(NavigatorSetup setup, std::unique_ptr<RobotLocaliser> localiser,
            std::unique_ptr<LocalMotion> motion);

  /// The ways out of a place where nothing goes on, in the order in which they are tried.
  enum class Recovery { none, forget, turn, back_off };

  [[nodiscard]] double now_s() const { return odometry_.time_s(); }
  [[nodiscard]] Pose2 pose() const { return compose(localiser_->world_T_odometry(), odometry_.newest()); }
  [[nodiscard]] std::optional<LaserScan> usable(const std::optional<LaserScan>& seen) const;
  void take(const LaserScan& scan);
  void see(const TagImage& image);
  void note_localised(const Pose2& before, bool was_located, bool corrected);
  void note_moving();
  void note_lost();
  void judge(const GoTo& order);
  void recover(const GoTo& order);
  void note_bumper(const Observation& seen);
  Twist2 back_from_touch();
  [[nodiscard]] Twist2 recovery_twist(const MotionState& state) const;
  [[nodiscard]] Twist2 turn_to(const Pose2& here, double heading_rad) const;
  Twist2 go(const GoTo& order);
  Twist2 look_for_itself();
  void look_around();
  // curves/navigator_curves.cpp
  Twist2 go_in_curves(const GoTo& order);
  [[nodiscard]] bool needs_curves(const MotionState& state) const;
  void plan_curves(const GoTo& order);
  [[nodiscard]] Twist2 along_curves(const MotionState& state);
  [[nodiscard]] Twist2 arc_away(const MotionState& state);
  // follow_track.cpp
  Twist2 follow(const Follow& order);
  TrackFollower& begin_track(const Follow& order);
  Twist2 along_track(const Follow& order, TrackFollower& follower);
  Twist2 back_to_track(const TrackPlace& place);
  void note_motion(const Pose2& here);
  void leave_track(double again_m);
  [[nodiscard]] GoTo order_to(const TrackPlace& place) const;
  [[nodiscard]] Progress progress() const;
  bool begin(const GoTo& order);
  void plan(const GoTo& order);
  void plan_window(const GoTo& order);
  bool plan_on_map(const GoTo& order, bool anew);
  [[nodiscard]] GoalQuery query_of(const GoTo& order) const;
  void note_progress(const GoTo& order);
  [[nodiscard]] bool is_blind();
  void follow_zones();
  [[nodiscard]] double room_of_zones_m() const;
  [[nodiscard]] const ZoneCells* zones_on_window();
  [[nodiscard]] Twist2 leave_zone(const MotionState& state);
  [[nodiscard]] std::optional<Vec2> way_out(Vec2 here) const;
  [[nodiscard]] MotionState state_of(const GoTo& order, const Surroundings& near) const;

  static constexpr double instant_s = 1e-9;  // by which times are rounded
  static constexpr double moved_mps = 0.03;  // a robot that is slower stands

  /// When the way to the place was planned, and for what.
  struct Planned {
    std::optional<double> window_s = {}, far_s = {};  ///< in the window and on the known map
    Vec2 at = {};
    std::uint64_t changes = 0;  ///< changes of the live map until then
  };
  /// The time that is left on the way to the place.
  struct TimeLeft {
    std::optional<double> now_s = {};  ///< nothing if there is no way
    double least_s = 0.0;              ///< least since the last recovery
    double best_s = 0.0;               ///< least since the order began
    double nearer_s = 0.0;             ///< when it last became less, or a recovery began
  };
  /// The track of a Follow, and the way back to it.
  struct OnTrack {
    std::optional<TrackFollower> follower = {};
    std::optional<TrackPlace> comes_back = {};  ///< to that place of the track, by the present GoTo
    bool comes_in = false;                      ///< it was beside the track, and is steered to it
    double skip_m = 0.0;                        ///< length that is left out where no way leads back
    TrackPlace came_in = {};                    ///< where it came back to the track
    Pose2 stood = {};                           ///< on the track, until it moved from there
    double moved_s = 0.0;                       ///< when it last moved there
  };
  /// The curves of a robot that steers, to the place of the GoTo.
  struct Curves {
    std::optional<TrackFollower> way = {};
    std::string why_none = {};
    double planned_s = 0.0;
    std::uint64_t changes = 0;       ///< changes of the live map until then
    std::optional<Twist2> arc = {};  ///< away from where it stands, as a recovery
  };

  NavigatorSetup setup_;
  std::unique_ptr<RobotLocaliser> localiser_;
  std::unique_ptr<LocalMotion> rule_;
  LiveMap map_;
  MovingThings followed_;
  std::vector<MovingThing> moving_;  // now
  std::optional<double> met_s_;      // when something moved near it last
  bool looks_back_ = true;           // its laser does
  Zones zones_;
  GridFrame zones_frame_;
  ZoneCells zone_cells_;      // on that frame
  bool in_zone_ = false;      // it overlaps a keep-out zone, into which it was carried
  std::optional<Vec2> exit_;  // the place outside to which it goes then
  RobotModel limits_;         // of the robot now, in or before a slow zone
  Surroundings near_;
  Surroundings on_track_;  // the same without the edges of the allowed ground
  GoalField field_;
  std::optional<MapField> far_;  // on the known map
  Twist2 commanded_;

  RecentOdometry odometry_;
  std::optional<double> scan_s_;
  double image_s_ = -1.0;  // of the last image that was used

  std::optional<GoTo> order_;
  Planned planned_;
  TimeLeft left_;
  bool at_place_ = false;  // it stands there and turns to the heading
  Recovery recovery_ = Recovery::none;
  double recovers_until_s_ = 0.0;
  double back_until_s_ = 0.0;  // from what it touched
  double back_mps_ = 0.0;
  Vec2 begun_at_;                // with the order, or an earlier one
  std::int64_t recoveries_ = 0;  // in a row
  PlaceSearch search_;           // of a robot that does not know where it is
  OnTrack track_;
  Curves curves_;
  Workspace workspace_;
  Progress progress_;
};

}  // namespace outrider
