// Defines a new job: patrol, which visits points of a world for some rounds. Its row at the end of this file
// gives it flags, scenario keys, a schema, reports, the live view and Ctrl-C, like the jobs of Outrider:
//
//   example_10_own_job patrol --points "2,0 2,2 0,2" --rounds 2 --out out --html
//   example_10_own_job serve scenarios
#include <fmt/format.h>

#include <sstream>

#include "outrider/io/map/world_file.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/jobs/catalog.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/sim/simulated_robot.hpp"
#include "tool.hpp"

namespace outrider {

/// Visits one point after the other in straight lines.
struct PatrolMission {
  const std::vector<Vec2>& points;
  std::size_t visits = 0;  ///< number of visits to make
  std::size_t sent = 0;    ///< number of visits commanded so far

  std::optional<Command> step(const Observation& seen) {
    if (sent == visits) return std::nullopt;
    return FollowWaypoints{{seen.odometry.position, points[sent++ % points.size()]}};
  }
};

class PatrolJob final : public JobTask {
 public:
  PatrolJob() : JobTask("patrol") {}

  Outcome<Warnings> load() override {
    points_.clear();
    std::istringstream words(text_);
    for (std::string word; words >> word;) {
      auto point = parse_numbers(word, 2, "points", "x,y with blanks between the points");
      if (!point) return pass_on(point);
      points_.push_back({(*point)[0], (*point)[1]});
    }
    if (points_.empty()) return bad_input("there is no point; list at least one", "points");
    auto start = parse_pose(start_text_, "start");
    if (!start) return pass_on(start);
    start_ = {start->position, wrap_angle(start->heading_rad)};
    auto loaded = load_world(world_file_);
    if (!loaded) return pass_on(loaded);
    world_ = std::move(loaded->world);
    const CollisionMap ground = CollisionMap::of(world_, robot_.height_m);
    Vec2 from = start_.position;
    for (std::size_t i = 0; i <= points_.size(); ++i) {  // the last leg leads back to the first point
      const Vec2 to = points_[i % points_.size()];
      if (!ground.segment_free({from, to}, robot_.radius_m + errors_.position_m)) {
        return bad_input(fmt::format("the robot cannot drive straight from {:g},{:g} to {:g},{:g}; "
                                     "put a point between them, or elsewhere",
                                     from.x, from.y, to.x, to.y),
                         "points");
      }
      from = to;
    }
    return std::move(loaded->warnings);
  }

  Status run(Run& run, const RunWatch& watch) override {
    log_scene(run.log, run_info("patrol", static_cast<std::uint64_t>(seed_), world_, robot_.radius_m), world_,
              robot_.height_m);
    const CollisionMap ground = CollisionMap::of(world_, robot_.height_m);
    const ShotRules level;
    const Rng rng(static_cast<std::uint64_t>(seed_));
    SimulatedRobot robot(run.log,
                         WaypointBody(robot_, {ground, level}, start_, errors_, rng.child("arrival")));
    PatrolMission mission{points_, points_.size() * static_cast<std::size_t>(rounds_)};
    std::size_t made = 0;  // judged by where the robot really is, not by where it was sent
    std::size_t judged = 0;
    const bool ended = run_mission(mission, robot, watch.stop, [&](const Observation&, const Command* next) {
      const std::size_t arrived = next ? mission.sent - 1 : mission.sent;
      for (; judged < arrived; ++judged) {
        const Vec2 point = points_[judged % points_.size()];
        if (distance(robot.pose().position, point) <= errors_.position_m + 1e-9) ++made;
      }
      watch.part(static_cast<double>(arrived) / static_cast<double>(mission.visits));
    });
    Report& report = run.report;
    report.world_name = world_.name;
    report.status = made == mission.visits ? "done" : "not_done";
    if (made < mission.visits) report.reason = fmt::format("{} of {} visits were made", made, mission.visits);
    report.metrics = {{"visits", static_cast<double>(made)},
                      {"time_s", robot.time_s()},
                      {"driven_m", robot.record.driven_m}};
    if (!ended) mark_cancelled(report, run.log, robot.time_s());
    return {};
  }

 protected:
  std::vector<OptionGroup> describe() override {
    return {{"",
             "the patrol",
             {file_option("world", "file of the world", &world_file_),
              {"points", "", 0, 0, "x,y of the points, m, with blanks between", &text_},
              {"start", "", 0, 0, "x,y,heading of the robot at first, m, m and degrees", &start_text_},
              {"rounds", "", 1, 1000, "times that every point is visited", &rounds_},
              {"seed", "", 0, 1e15, "seed of every random number", &seed_}}},
            {"robot", "the robot", outrider::describe(robot_)}};
  }

 private:
  std::string world_file_, start_text_ = "0.5,0.5,0";
  std::string text_ = "2.5,0.5 2.5,2.5 0.5,2.5 0.5,0.5";
  std::int64_t rounds_ = 3, seed_ = 1;
  RobotModel robot_;
  ExecutionErrors errors_;
  std::vector<Vec2> points_;
  Pose2 start_;
  World world_;
};

/// Returns the catalogue entry of the job.
Job patrol_job() {
  return {.name = "patrol",
          .sentence = "Visit points of a world for some rounds.",
          .example = "patrol --points \"2.5,0.5 2.5,2.5\" --rounds 2 --out out",
          .blank = [] { return std::make_unique<PatrolJob>(); }};
}

}  // namespace outrider

int main(int argc, char** argv) {
  auto jobs = outrider::jobs();
  jobs.push_back(outrider::patrol_job());
  if (argc > 1) return outrider::cli::run_tool(jobs, argc, argv);
  outrider::PatrolJob task;
  if (!change(task, {{"world", "scenarios/arena/arena.sdf"}})) return 2;
  const auto run = outrider::run_task(jobs.back(), task);
  if (!run) return 2;
  fmt::print("{}: {} visits\n", run->report.status, metric(run->report, "visits"));
  return 0;
}

// Prints:
// done: 12 visits
