#include "outrider/jobs/explore/mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mission_parts.hpp"
#include "outrider/jobs/explore/catalog.hpp"
#include "outrider/jobs/explore/map_doubt.hpp"
#include "outrider/jobs/explore/view.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/slam/scan_contradiction.hpp"

namespace outrider {
namespace {

/// Returns true if the scan is usable.
bool usable(const LaserScan& scan) {
  return check(scan) &&
         std::ranges::any_of(scan.ranges_m, [&](float range) { return range >= scan.least_m; });
}

constexpr double remembered_s = 10.0;  ///< of odometry; scans that come later than that are taken for new

void remember_odometry(ExploreMission& mission) {
  mission.odometries.push_back({mission.time_s, mission.odometry});
  while (mission.odometries.front().time_s < mission.time_s - remembered_s) mission.odometries.pop_front();
}

/// Returns the odometry at a time, between the observations around it; the newest for a time that is not in
/// memory.
Pose2 odometry_at(const ExploreMission& mission, double time_s) {
  const auto& all = mission.odometries;
  const auto after = std::ranges::lower_bound(all, time_s, {}, &TimedOdometry::time_s);
  if (after == all.end() || (after == all.begin() && after->time_s > time_s)) return mission.odometry;
  if (after->time_s == time_s || after == all.begin()) return after->odometry;
  const TimedOdometry& before = *std::prev(after);
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  const Pose2 motion = wrap_heading(relative_pose(before.odometry, after->odometry));
  return compose(before.odometry, {part * motion.position, part * motion.heading_rad});
}

/// Returns the end points of the beams that hit something.
std::vector<Vec2> ends_of(const LaserScan& scan, const Pose2& frame_T_laser) {
  std::vector<Vec2> ends;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= scan.least_m && range_m <= std::min(scan.most_m, 2.0 * nearby_m))) continue;
    const double bearing =
        frame_T_laser.heading_rad + scan.first_rad + static_cast<double>(i) * scan.step_rad;
    ends.push_back(frame_T_laser.position + range_m * direction(bearing));
  }
  return ends;
}

/// Keeps what the frontiers have to be told.
void learn(ExploreMission& mission, MapUpdate update) {
  if (mission.looked) update = {true, {}};  // two scans at once: all is compared
  mission.changed = std::move(update);
  mission.looked = true;
}

/// Notes when the known ground grew by more than noise makes of it.
void note_new_ground(ExploreMission& mission) {
  constexpr double noise_m2 = 0.05;
  const TraversabilityGrid& ground = mission.frontiers.ground();
  const double known_m2 =
      static_cast<double>(ground.known_cells()) * ground.frame().resolution_m * ground.frame().resolution_m;
  if (mission.learned_s >= *mission.started_s && known_m2 <= mission.known_m2 + noise_m2) return;
  mission.known_m2 = std::max(mission.known_m2, known_m2);
  mission.learned_s = mission.time_s;
}

/// Tells the frontiers. A map of which much has changed is thought over with the next scan.
void update_frontiers(ExploreMission& mission) {
  const bool first = mission.decisions == 0;
  const bool keeps = mission.changed.redrawn && !first && !mission.forget_seen;
  mission.forget_seen = false;
  const bool much = keeps ? mission.frontiers.update(explored_map(mission), mission.changed)
                          : mission.frontiers.update(mission.slam.map().occupancy(), mission.changed);
  mark_ground(mission);
  note_new_ground(mission);
  if (!much || first) return;
  prepare(mission.frontiers, mission.task.explore);
  mission.looked = false;
}

/// Notes by how much a pose was corrected.
void note_correction(ExploreMission& mission, const Pose2& before, const Pose2& after) {
  const double most_m = 2.0 * mission.task.slam.map.resolution_m;
  if (distance(before.position, after.position) > most_m) mission.forget_seen = true;
}

void settle(ExploreMission& mission) {
  const Pose2 before = mission.slam.pose();
  mission.slam.settle();
  note_correction(mission, before, mission.slam.pose());
  mission.wants_settling = false;
  mission.settled_m = mission.driven_m;
  mission.marks_moved = true;
  learn(mission, {true, {}});
}

void take_scan(ExploreMission& mission, const LaserScan& scan) {
  if (mission.wants_settling) settle(mission);
  const Pose2 then = odometry_at(mission, scan.time_s);
  const Pose2 believed_then = compose(mission.slam.pose(), relative_pose(mission.odometry_of_slam, then));
  auto step = mission.slam.advance(wrap_heading(relative_pose(mission.odometry_of_slam, then)), scan);
  if (!step) return end(mission, "lost", step.error().sentence);
  if (step->update.redrawn) note_correction(mission, believed_then, step->pose);
  mission.odometry_of_slam = then;
  mission.pose = compose(step->pose, wrap_heading(relative_pose(then, mission.odometry)));
  mission.marks_moved = mission.marks_moved || step->update.redrawn;
  ++mission.scans;
  if (!usable(scan) || mission.repeated.repeats(scan, mission.odometry_of_slam)) {
    ++mission.bad_scans;
  } else {
    mission.scan_s = std::min(scan.time_s, mission.time_s);
    mission.range_m = scan.most_m;
    mission.last_scan = scan;
    mission.last_step = static_cast<std::size_t>(mission.scans);
    if (!mission.first_scan) {
      mission.first_scan = scan;
      mission.first_step = mission.last_step;
    }
    const std::vector<Vec2> ends = ends_of(scan, mission.task.slam.robot_T_laser);
    mission.beam_ends.clear();
    for (const Vec2 point : ends) mission.beam_ends.push_back(step->pose * point);
    mission.close_range.add(then, ends);
  }
  learn(mission, std::move(step->update));
  if (step->closed_loop) {
    ++mission.loops;
    mission.path.reset();
    moved_on(mission);
    add_event(
        mission, "loop",
        step->undid_loop
            ? "a loop that was closed before contradicts the scans: it is undone, and the map was redrawn"
            : "a place was recognised, and the map was redrawn");
  }
  const Eigen::Matrix3d p = mission.slam.pose_covariance();
  const double sigma_m = std::sqrt(std::max(p(0, 0), p(1, 1)));
  if (sigma_m > mission.task.rules.lost_m) {
    end(mission, "lost",
        fmt::format("it is lost: its position has a standard deviation of {:.2f} m", sigma_m));
  }
}

std::string why_blind(const ExploreMission& mission, double blind_s) {
  if (blind_s > 10.0 * mission.task.rules.blind_s || mission.scans == mission.bad_scans)
    return fmt::format("no scan that could be used came for {:.1f} s", blind_s);
  return fmt::format("its scans come too late to drive by: the newest is {:.1f} s old", blind_s);
}

}  // namespace

void add_event(ExploreMission& mission, std::string kind, std::string text) {
  mission.events.push_back({mission.time_s, std::move(kind), std::move(text)});
}

ExploreState state_of(ExploreMission& mission) {
  return {mission.frontiers,
          mission.blacklist,
          mission.task.robot,
          mission.range_m,
          mission.pose,
          mission.task.start,
          mission.time_s,
          mission.decision.choice,
          mission.outage.budget(mission.time_s)};
}

/// Returns the reason not to believe that the robot is home; empty if it is not there, or sees there what it
/// saw first.
std::string home_doubt(ExploreMission& mission) {
  constexpr double most_contradicted = 0.1;  // people who stand there make some
  if (!mission.home || !mission.first_scan || !mission.last_scan) return {};
  const std::vector<Pose2> came = mission.slam.trajectory();
  const auto laser_at = [&](std::size_t step) {
    return compose(came[std::min(step, came.size() - 1)], mission.task.slam.robot_T_laser);
  };
  mission.home_contradiction = contradiction(*mission.first_scan, laser_at(mission.first_step),
                                             *mission.last_scan, laser_at(mission.last_step));
  if (mission.home_contradiction <= most_contradicted) return {};
  return fmt::format(
      "it should be home, but {:.0f} % of what it sees there contradicts what it saw there first; was "
      "it moved?",
      100.0 * mission.home_contradiction);
}

/// Judges what is left over on the map as it is in the end.
void judge_what_is_left(ExploreMission& mission) {
  if (mission.frontiers.frame().size() == 0) return;
  const ExploreOptions& options = mission.task.explore;
  const ExploreState state = state_of(mission);
  const auto decision = decide(state, options, mission.workspace);
  if (decision) mission.decision.refused = decision->refused;
  mission.left = left_over(state, options, mission.decision.refused, true, mission.narrow);
  const bool explored = mission.stop_reason == "complete" || mission.stop_reason == "left_over";
  if (!explored) return;
  std::string doubt = map_doubt(mission.slam);
  if (doubt.empty()) doubt = home_doubt(mission);
  if (!doubt.empty()) {
    mission.stop_reason = "lost";
    mission.reason = "lost: " + doubt;
    return;
  }
  const bool complete = mission.left.places.empty();
  mission.stop_reason = complete ? "complete" : "left_over";
  if (!complete)
    mission.reason = mission.left.sentence(wanted_width_m(mission.task.robot, mission.task.explore));
}

void end(ExploreMission& mission, std::string stop_reason, std::string reason) {
  mission.stage = ExploreStage::over;
  mission.path.reset();
  mission.stop_reason = std::move(stop_reason);
  mission.reason = std::move(reason);
  judge_what_is_left(mission);
  add_event(mission, "end", mission.reason);
}

void moved_on(ExploreMission& mission) {
  mission.stood = mission.pose;
  mission.moved_on_s = mission.time_s;
}

void follow(ExploreMission& mission, std::vector<Vec2> points) {
  mission.path = PathProgress{std::move(points), 0.0};
  mission.centred_scan = -1;
}

ExploreMission::ExploreMission(LaserSlam mapping, ExploreTask given)
    : task(std::move(given)),
      slam(std::move(mapping)),
      frontiers(task.explore.frontier, task.robot.radius_m),
      pose(task.start) {
  blacklist.ban_s = task.explore.ban_s;
}

Outcome<ExploreMission> begin(const ExploreTask& task) {
  if (auto known = find_explore_strategy(task.explore.strategy); !known) return pass_on(known);
  const auto planners = names_of_planners_in_place(GridModel::cells);
  if (std::ranges::count(planners, task.explore.planner) == 0)
    return no_such_row("planner", task.explore.planner, planners, "planner");
  auto slam = LaserSlam::begin(task.slam, task.start);
  if (!slam) return pass_on(slam);
  return ExploreMission(std::move(*slam), task);
}

Grid<std::uint8_t> explored_map(const ExploreMission& mission) {
  Grid<std::uint8_t> map = mission.slam.map().occupancy();
  const Grid<std::uint8_t>& known = mission.frontiers.ground().known();
  if (known.cells.empty()) return map;
  const Cell offset = known.frame.cell_at(map.frame.centre({0, 0}));
  for (int y = 0; y < map.frame.height; ++y) {
    for (int x = 0; x < map.frame.width; ++x) {
      const Cell there{x + offset.x, y + offset.y};
      if (map[{x, y}] == unknown_cell && known.contains(there) && known[there] == free_cell)
        map[{x, y}] = free_cell;
    }
  }
  return map;
}

void perceive(ExploreMission& mission, const Observation& seen) {
  if (mission.stage == ExploreStage::over) return;
  const Pose2 now = finite(seen.odometry) ? seen.odometry : mission.odometry;
  if (!mission.started_s) {
    mission.started_s = mission.scan_s = mission.time_s = mission.moved_on_s = seen.time_s;
    mission.sighted_s = seen.time_s;
    mission.odometry = mission.odometry_of_slam = now;
  }
  const double passed_s = seen.time_s - mission.time_s;
  const Pose2 motion = wrap_heading(relative_pose(mission.odometry, now));
  if (passed_s > 0.0) mission.twist = twist_between({}, motion, passed_s);
  mission.time_s = seen.time_s;
  mission.driven_m += norm(motion.position);
  mission.odometry = now;
  remember_odometry(mission);
  mission.pose = compose(mission.slam.pose(), wrap_heading(relative_pose(mission.odometry_of_slam, now)));
  const bool touched = seen.touching && !mission.touching;
  mission.touching = seen.touching;
  if (seen.scan) take_scan(mission, *seen.scan);
  if (touched) note_touch(mission, seen);
}

/// Asks whether the range finder can be believed, less and less often. Ends the mission if it cannot.
bool believes_range_finder(ExploreMission& mission) {
  if (mission.scans < mission.range_finder_asked_at) return true;
  mission.range_finder_asked_at *= 2;
  const std::string doubt = range_finder_doubt(mission.slam);
  if (doubt.empty()) return true;
  end(mission, "lost", "lost: " + doubt);
  return false;
}

std::optional<Command> respond(ExploreMission& mission) {
  if (mission.stage == ExploreStage::over) return std::nullopt;
  const double until_s = mission.time_s + mission.task.rules.period_s;
  const double blind_s = mission.time_s - mission.scan_s;
  if (blind_s > mission.task.rules.blind_s || mission.scans == mission.bad_scans) {
    const double stood_s = mission.time_s - mission.sighted_s;
    if (std::max(blind_s, stood_s) <= 10.0 * mission.task.rules.blind_s) return DriveTwist{{}, until_s};
    end(mission, "blind", why_blind(mission, blind_s));
    return std::nullopt;
  }
  mission.sighted_s = mission.time_s;
  if (mission.looked) update_frontiers(mission);
  const Twist2 twist = believes_range_finder(mission) ? drive(mission) : Twist2{};
  mission.looked = false;
  if (mission.stage == ExploreStage::over) {
    mission.slam.settle();
    mission.pose =
        compose(mission.slam.pose(), wrap_heading(relative_pose(mission.odometry_of_slam, mission.odometry)));
    return std::nullopt;
  }
  return DriveTwist{twist, until_s};
}

std::optional<Command> ExploreMission::step(const Observation& seen) {
  perceive(*this, seen);
  return respond(*this);
}

}  // namespace outrider
