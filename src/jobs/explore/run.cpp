#include "outrider/jobs/explore/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/job/clock.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/explore/mission/explore_log.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/robot/steady_time.hpp"

namespace outrider {
namespace {

constexpr double home_m = 0.3;
constexpr double outline_step_rad = radians(15.0);

std::vector<std::vector<Vec2>> outlines_of_pieces(const std::vector<RoundedPolygon>& pieces) {
  std::vector<std::vector<Vec2>> outlines;
  for (const RoundedPolygon& piece : pieces) {
    outlines.push_back(piece.radius_m > 0.0 ? inscribed(piece, outline_step_rad) : piece.core);
  }
  return outlines;
}

/// Logs what stands still: the world, unless a job that explores a part of the time has done it; the walls
/// that the laser can hit, where they are not the outlines of the solids; and where the laser is.
void log_start(Log& log, const World& world, const ExploreTask& task, const RangeFinderModel& laser,
               std::uint64_t seed) {
  const bool first = log.latest<outrider_msgs::RunInfo>(topic::run) == nullptr;
  if (first)
    log_scene(log, run_info("explore", seed, world, task.robot.radius_m), world, task.robot.height_m);
  const auto walls = outlines_of_pieces(cut_at(world, laser.height_m));
  if (walls != outlines_of_pieces(footprints_above_floor(world)))
    log.append(topic::walls, 0.0, outrider_msgs::Outlines{outlines_of(walls)});
  if (first) log_markers(log);
  log_mount(log, "laser", laser.robot_T_laser, laser.height_m);
}

double mapped_free_m2(const OccupancyMap& map) {
  const double cell_m = map.frame().resolution_m;
  return cell_m * cell_m * static_cast<double>(std::ranges::count(map.occupancy().cells, free_cell));
}

/// The task in a world that may have no end: there the robot turns back once its map is larger than all that
/// can be seen from within the box of what stands.
ExploreTask bounded(ExploreTask task, const ExplorationReference& truth, const RangeFinderModel& laser) {
  const Vec2 size = truth.standing.size();
  const double most_m = std::max(1.0, std::max(size.x, size.y) + 2.0 * laser.most_m);
  if (truth.leaks) task.explore.most_extent_m = std::min(task.explore.most_extent_m, most_m);
  return task;
}

/// The mission, with the longest processor times of its steps.
struct TimedMission {
  std::optional<Command> step(const Observation& shown) {
    const Observation seen = time.steady(shown);
    const std::int64_t decisions = mission.decisions();
    const double began_s = processor_s();
    mission.perceive(seen);
    const double perceived_s = processor_s();
    auto command = mission.respond();
    const double responded_s = processor_s();
    if (command && mission.decisions() > decisions)
      max_decision_s = std::max(max_decision_s, responded_s - perceived_s);
    max_step_s = std::max(max_step_s, responded_s - began_s);
    return command ? std::optional(time.on_clock(std::move(*command))) : std::nullopt;
  }

  ExploreMission mission;
  SteadyTime time = {};
  double max_decision_s = 0.0;
  double max_step_s = 0.0;
};

/// Counts the touches of what the laser could see: those that the robot has to answer for.
class ContactJudge {
 public:
  void note(const SimulatedRobot& robot) {
    constexpr double near_m = 0.02;
    const TwistBody& body = robot.body<TwistBody>();
    if (std::exchange(contacts_, body.contacts()) == body.contacts()) return;
    const double radius_m = body.ground().radius_m();
    const Vec2 rim = body.pose() * (radius_m * direction(body.touch_rad().value_or(0.0)));
    const auto& laser = robot.devices().laser;
    const bool seen = laser && laser->finder().surface_distance(rim, 2.0 * near_m) < near_m;
    if (seen || body.walk_ins().gap_m({rim, rim}, 0.0) < near_m) ++visible_;
  }
  [[nodiscard]] std::int64_t visible() const { return visible_; }

 private:
  std::int64_t contacts_ = 0;
  std::int64_t visible_ = 0;
};

Table left_over_table(const LeftOvers& left) {
  Table table{"left_over", {"x", "y", "because", "width_m", "area_m2", "reason"}, {}};
  for (const LeftOver& one : left.places) {
    table.rows.push_back({one.place.x, one.place.y, std::string(to_string(one.reason)), one.width_m,
                          one.area_m2, one.sentence});
  }
  return table;
}

/// Returns the reason why a map that is called complete differs from the world; empty if it does not. What
/// lies behind gaps does not count if the robot names them.
std::string why_wrong(const MapQuality& quality, bool names_gaps) {
  constexpr double least_part = 0.9, most_error_m = 0.1;
  if (quality.map_error_m > most_error_m)
    return fmt::format("its map is wrong: its walls are off by {:.2f} m on average", quality.map_error_m);
  const double part = names_gaps ? quality.explored_before_gaps : quality.explored_fraction;
  if (part < least_part) {
    return fmt::format("its map is wrong: it has {:.0f} % of what can be seen{}, and is called complete",
                       100.0 * part, names_gaps ? " before the gaps that it names" : "");
  }
  return {};
}

double count(const LeftOvers& left, LeftReason reason) {
  return static_cast<double>(std::ranges::count(left.places, reason, &LeftOver::reason));
}

/// Returns the room in a gap that the robot surely finds to be enough: it sees surfaces to 3 mm.
double sure_room_m(const ExploreTask& task) {
  constexpr double error_m = 0.003;
  return task.explore.gap_margin_m + error_m;
}

/// The reference for the world as it is at the end, and a range finder in that world.
struct Truth {
  ExplorationReference reference;
  RangeFinder finder;
};

/// Returns the truth at the end. A post that closes a door then hides what nobody can see any more.
Truth truth_at_end(const World& world, const ExplorationReference& before, const TwistBody& body,
                   const ExploreTask& task, const ExplorerSimParams& params) {
  const auto post = body.walk_ins().post();
  if (!post) return {before, RangeFinder(world, params.laser)};
  constexpr double height_m = 2.0;
  const Vec2 at = post->core.front();
  const World after =
      world.with({"post", {{at.x, at.y, 0.5 * height_m}, {}}, CylinderShape{post->radius_m, 0.5 * height_m}});
  Truth truth{before, RangeFinder(after, params.laser)};
  auto reference = exploration_reference(truth.finder, OpenGround(after, task.robot, params.wheels.climbs_m),
                                         task.start.position, sure_room_m(task));
  if (reference) truth.reference = std::move(*reference);
  return truth;
}

void close(ExploreRun& run, const TimedMission& timed, const SimulatedRobot& robot, const Truth& at_end,
           std::int64_t visible_contacts) {
  const ExplorationReference& truth = at_end.reference;
  const ExploreMission& mission = timed.mission;
  const TwistBody& body = robot.body<TwistBody>();
  Report& report = run.report;
  const bool home = distance(robot.pose().position, mission.task().start.position) <= home_m;
  const bool back = home || !mission.task().rules.return_home;
  const bool complete = mission.stop_reason() == "complete";
  const MapQuality quality = map_quality(truth, at_end.finder, run.map);
  const std::string wrong = why_wrong(quality, !mission.left().places.empty());
  const bool claims_done = complete && (mission.is_home() || !mission.task().rules.return_home);
  report.status = complete && back && visible_contacts == 0 && wrong.empty() ? "done" : "not_done";
  // Far outside nothing is in sight any more.
  if (truth.leaks && (mission.stop_reason() == "leak" || mission.stop_reason() == "blind")) {
    report.reason = fmt::format(
        "{}. The robot can leave the box of all that stands at about {:.2f},{:.2f}; close the gap on the way "
        "there, for instance with the key walls",
        mission.reason(), truth.leaks_at.x, truth.leaks_at.y);
  } else if (!complete) {
    report.reason = mission.reason();
  } else if (!back) {
    report.reason = "it is not home";
  } else if (visible_contacts > 0) {
    report.reason = "something was touched that the laser sees";
  } else {
    report.reason = wrong;
  }
  report.tables = {left_over_table(mission.left())};
  run.stop_reason = mission.stop_reason();
  const auto number = [](auto value) { return static_cast<double>(value); };
  report.metrics = {
      {"explored_fraction", quality.explored_fraction},
      {"explored_before_gaps", quality.explored_before_gaps},
      {"time_s", robot.time_s()},
      {"distance_m", body.driven_m()},
      {"turned_rad", body.turned_rad()},
      {"decisions", number(mission.decisions())},
      {"map_error_m", quality.map_error_m},
      {"mapped_free_m2", quality.mapped_free_m2},
      {"seeable_m2", truth.seeable_m2},
      {"reachable_m2", truth.reachable_m2},
      {"left_over_m2", mission.left().area_m2()},
      {"left_narrow", count(mission.left(), LeftReason::narrow)},
      {"left_touched", count(mission.left(), LeftReason::touched)},
      {"left_other", number(mission.left().places.size()) - count(mission.left(), LeftReason::narrow) -
                         count(mission.left(), LeftReason::touched)},
      {"contacts", number(body.contacts())},
      {"visible_contacts", number(visible_contacts)},
      {"returned_home", home ? 1.0 : 0.0},
      {"home_error_m", distance(robot.pose().position, mission.task().start.position)},
      {"false_complete", claims_done && !(back && wrong.empty()) ? 1.0 : 0.0},
      {"pose_error_m", distance(robot.pose().position, mission.where().pose().position)},
      {"stuck", number(mission.stuck())},
      {"bad_scans", number(mission.where().bad_scans())},
      {"loops", number(mission.loops())},
      {"home_contradiction", mission.home_contradiction()},
      {"blocked_s", body.walk_ins().blocked_s().value_or(-1.0)}};
  report.machine_times = {{"max_decision_s", timed.max_decision_s}, {"max_step_s", timed.max_step_s}};
}

}  // namespace

Outcome<ExploreRun> run_explore(const World& world, const ExploreTask& given, const ExplorerSimParams& params,
                                std::uint64_t seed, Log& log, const RunWatch& watch,
                                const ScanHook& scanned) {
  SimulatedRobot robot = simulated_explorer(world, given.start, given.robot, params, seed);
  const auto reference =
      exploration_reference(robot.devices().laser->finder(), robot.body<TwistBody>().ground(),
                            given.start.position, sure_room_m(given));
  if (!reference) return pass_on(reference);
  auto begun = begin(bounded(given, *reference, params.laser), params.faults.planner);
  if (!begun) return pass_on(begun);
  TimedMission timed{std::move(*begun)};
  const ExploreMission& mission = timed.mission;
  log_start(log, world, mission.task(), params.laser, seed);
  ExploreLog recorder(log, mission.task().start);
  ContactJudge contacts;
  const auto note = [&](const Observation& seen, const Command*) {
    if (seen.scan) {
      log_scan(log, mission.where().time_s(), *seen.scan);
      log_odometry(log, mission.where().time_s(), seen.odometry);
      recorder.note_map(mission);
    }
    recorder.note(mission, robot.pose());
    contacts.note(robot);
    if (seen.scan && scanned) scanned(seen, mission, robot);
    if (seen.scan && mission.where().scans() % 25 == 0)
      watch.part(std::min(1.0, mapped_free_m2(mission.where().slam().map()) / reference->seeable_m2));
  };
  const bool finished = run_mission(timed, robot, watch.stop, note);
  recorder.finish(mission);
  ExploreRun run;
  run.map = mission.explored_map();
  run.track = mission.where().slam().trajectory();
  run.pose = mission.where().pose();
  run.true_pose = robot.pose();
  run.report.world_name = world.name;
  close(run, timed, robot, truth_at_end(world, *reference, robot.body<TwistBody>(), mission.task(), params),
        contacts.visible());
  run.touched = mission.touched();
  if (!finished) mark_cancelled(run.report, log, robot.time_s());
  return run;
}

}  // namespace outrider
