#include "outrider/nodes/planner_node.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/core/text.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "outrider/world/nearest_cell.hpp"

namespace outrider {
namespace {

constexpr double shifted_m = 0.5;  // at most, a start or a goal
constexpr std::uint64_t most_expansions_of_path = 20'000'000;

}  // namespace

PlannerNodeOptions::PlannerNodeOptions() : radius_m(burger().radius_m) {}

std::vector<OptionGroup> describe(PlannerNodeOptions& options) {
  return {{"",
           "the plans",
           {choice_option("planner", "path planner, one that takes cells", &options.planner,
                          names_of_planners_in_place(GridModel::cells)),
            {"radius", "m", 0.01, 10.0, "of a disk that contains the robot", &options.radius_m},
            {"period", "s", 0.05, 1e6, "a plan is made again so often", &options.period_s}}},
          {"ground", "where the robot may be", describe(options.ground)},
          {"frame", "names of the frames", describe(options.frames)}};
}

PlannerNode::PlannerNode(PlannerNodeOptions options)
    : Node("planner", 0.05),
      options_(std::move(options)),
      frames_(options_.frames),
      ground_(options_.ground, options_.radius_m) {
  listen<nav_msgs::OccupancyGrid>("map", Delivery::latched,
                                  [this](const auto& map) { return take_map(map); });
  listen<geometry_msgs::PoseStamped>("goal_pose", Delivery::reliable,
                                     [this](const auto& goal) { return take_goal(goal); });
  listen_to_transforms(frames_);
  plan_output_ = add_output<nav_msgs::Path>("plan", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", "no goal has come yet");
}

Status PlannerNode::take_map(const nav_msgs::OccupancyGrid& map) {
  if (auto time_s = maps_.take(map.header.stamp); !time_s) return pass_on(time_s);
  const auto grid = checked_map(map);
  if (!grid) return pass_on(grid);
  if (beginning_.is_another(map)) {
    goal_.reset();
    ground_ = TraversabilityGrid(options_.ground, options_.radius_m);
    nav_msgs::Path nothing;
    nothing.header = header_of(now_s(), options_.frames.map);
    send(plan_output_, nothing);
    set_status(NodeLevel::warning, "waiting", "the map was begun anew, so the goal holds no more");
  }
  if (has_map_ && !grown_from(grid->frame, frame_))
    ground_ = TraversabilityGrid(options_.ground, options_.radius_m);
  frame_ = grid->frame;
  ground_.update(*grid, {true, {}});
  has_map_ = true;
  return {};
}

Status PlannerNode::take_goal(const geometry_msgs::PoseStamped& goal) {
  if (goal.header.frame_id != options_.frames.map && !goal.header.frame_id.empty()) {
    return bad_input(fmt::format("the goal is given in the frame '{}'; give it in '{}'",
                                 excerpt(goal.header.frame_id), options_.frames.map));
  }
  const auto pose = plane_pose(goal.pose);
  if (!pose) return pass_on(pose);
  if (goal_ == *pose) return {};  // it was sent again
  goal_ = *pose;
  planned_s_ = -1e9;
  return {};
}

Outcome<Plan> PlannerNode::plan(const Pose2& pose) {
  const auto grid = ground_.grid();
  const auto is_free = [&](Cell cell) { return grid->place(cell); };
  const auto start = nearest_cell(grid->frame, pose.position, shifted_m, is_free);
  if (!start) {
    return fault(FaultCode::start_blocked,
                 fmt::format("the robot at {:.2f}, {:.2f} is not within {:g} m of known free ground",
                             pose.position.x, pose.position.y, shifted_m));
  }
  const auto goal = nearest_cell(grid->frame, goal_->position, shifted_m, is_free);
  if (!goal) {
    return fault(FaultCode::goal_blocked,
                 fmt::format("the goal {:.2f}, {:.2f} is not within {:g} m of known free ground",
                             goal_->position.x, goal_->position.y, shifted_m));
  }
  auto planner = find_path_planner(options_.planner);
  if (!planner) return pass_on(planner);
  const Problem problem{grid, grid->point(*start), grid->point(*goal)};
  Budget budget;
  budget.expansions = most_expansions_of_path;
  auto plan = planner->configure().plan(problem, budget, workspace_);
  if (!plan) return plan;
  if (auto ok = check(*plan, problem); !ok) {
    ok.error().sentence = "the plan was refused by its check: " + ok.error().sentence;
    return pass_on(ok);
  }
  return plan;
}

void PlannerNode::send_plan(const Plan& plan) {
  std::vector<Vec2> points = plan.waypoints;
  nav_msgs::Path path = path_of(now_s(), points, options_.frames.map);
  path.poses.back().pose.orientation = quaternion_of(goal_->heading_rad);
  send(plan_output_, path);
}

void PlannerNode::act() {
  if (!goal_ || now_s() - planned_s_ < options_.period_s) return;
  if (!has_map_) return set_status(NodeLevel::warning, "waiting", "a goal has come, and no map");
  const auto pose = frames_.map_T_robot();
  if (!pose) {
    return set_status(
        NodeLevel::warning, "waiting",
        fmt::format("no transform says where '{}' is on '{}'", options_.frames.base, options_.frames.map));
  }
  planned_s_ = now_s();
  const auto made = plan(*pose);
  if (!made) {
    return set_status(NodeLevel::error, std::string(to_string(made.error().code)), made.error().sentence);
  }
  send_plan(*made);
  set_status(NodeLevel::info, "planned",
             fmt::format("a path to {:.2f}, {:.2f} was sent", goal_->position.x, goal_->position.y));
}

}  // namespace outrider
