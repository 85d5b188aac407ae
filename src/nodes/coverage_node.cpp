#include "outrider/nodes/coverage_node.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

constexpr double chord_rad = radians(5.0);
constexpr std::size_t most_corners = 10'000;
constexpr std::uint64_t most_expansions_of_track = 20'000'000;

}  // namespace

std::vector<OptionGroup> describe(CoverageNodeOptions& options) {
  auto groups = describe(options.cover);
  groups.front().options.push_back({"period", "s", 0.1, 1e6, "the path is sent so often", &options.period_s});
  groups.front().options.push_back({"from_map", "", 0, 0,
                                    "the area is the free space of the map that comes on the topic map",
                                    &options.from_map});
  groups.push_back({"frame", "names of the frames", describe(options.frames)});
  return groups;
}

Outcome<CoverageNodeOptions> CoverageNode::checked(CoverageNodeOptions options) {
  if (options.from_map && !options.cover.area.empty())
    return bad_input("with from_map the area is the map on the topic; leave one of the two out", "area");
  if (options.cover.area.empty()) return options;
  auto task = load_task(options.cover);
  if (!task) return pass_on(task);
  if (task->problem.frame.degrees)
    return bad_input("the area is given in degrees; give it in metres of the map", options.cover.area);
  return options;
}

CoverageNode::CoverageNode(CoverageNodeOptions options)
    : Node("coverage", 0.1), options_(std::move(options)) {
  if (options_.from_map) {
    listen<nav_msgs::OccupancyGrid>("map", Delivery::latched,
                                    [this](const auto& map) { return take_map(map); });
  } else {
    listen<geometry_msgs::PolygonStamped>("area", Delivery::latched,
                                          [this](const auto& area) { return take_area(area); });
  }
  plan_output_ = add_output<nav_msgs::Path>("plan", Delivery::reliable);
  set_status(NodeLevel::info, "waiting", options_.from_map ? "no map has come yet" : "no area has come yet");
  if (options_.cover.area.empty()) return;
  if (auto task = load_task(options_.cover)) task_ = std::move(*task);
  new_task_ = task_.has_value();
}

Status CoverageNode::take_area(const geometry_msgs::PolygonStamped& area) {
  if (area.header.frame_id != options_.frames.map) {
    return bad_input(fmt::format("the area is given in the frame '{}'; give it in '{}'",
                                 excerpt(area.header.frame_id), options_.frames.map));
  }
  const std::size_t corners = area.polygon.points.size();
  if (corners < 3 || corners > most_corners)
    return bad_input(fmt::format("the area has {} corners; 3 to {} are taken", corners, most_corners));
  std::vector<Vec2> boundary;
  for (const geometry_msgs::Point32& point : area.polygon.points) {
    const Vec2 corner{static_cast<double>(point.x), static_cast<double>(point.y)};
    if (!finite(corner) || norm(corner) > 1e5)
      return bad_input(fmt::format("the area has a corner at {:g}, {:g}", corner.x, corner.y));
    boundary.push_back(corner);
  }
  auto method = find_cover_method(options_.cover.method);
  if (!method) return pass_on(method);
  if (task_ && task_->problem.boundary == boundary) return {};  // it was sent again
  CoverTask task{options_.cover.problem, *method, {}, {}};
  task.problem.boundary = std::move(boundary);
  task_ = std::move(task);
  new_task_ = true;
  return {};
}

Status CoverageNode::take_map(const nav_msgs::OccupancyGrid& message) {
  auto map = checked_map(message);
  if (!map) return pass_on(map);
  if (map->frame == map_.frame && map->cells == map_.cells) return {};  // it was sent again
  auto method = find_cover_method(options_.cover.method);
  if (!method) return pass_on(method);
  std::optional<Pose2> start;
  if (!options_.cover.start.empty()) {
    auto given = parse_pose(options_.cover.start, "start");
    if (!given) return pass_on(given);
    start = *given;
  }
  auto area = area_of_map({*map, 0.0}, "map", map_options(options_.cover, start));
  if (!area) return pass_on(area);
  if (!area->note.empty()) tell(NodeLevel::warning, area->note);
  map_ = std::move(*map);
  task_ = task_of(options_.cover, *method, std::move(*area), start);
  new_task_ = true;
  return {};
}

void CoverageNode::plan() {
  track_.clear();
  Budget budget;
  budget.expansions = most_expansions_of_track;
  auto made = task_->method.plan(task_->problem, options_.cover.options, budget);
  if (!made) {
    const Fault fault = placed(made.error(), *task_);
    return set_status(NodeLevel::error, std::string(to_string(fault.code)), to_string(fault));
  }
  const auto proof = prove(*made, task_->problem, budget);
  if (!proof)
    return set_status(NodeLevel::error, "refused",
                      "the track was refused by its proof: " + to_string(proof.error()));
  for (const Vec2 point : points_along(made->track.start.position, made->track.pieces, chord_rad))
    track_.push_back(task_->problem.frame.to_file(point));
  set_status(NodeLevel::info, "planned",
             fmt::format("a track of {:.1f} m was sent; it surely covers {:.2f} % of what the robot reaches",
                         made->sums.length_m, 100.0 * proof->sure_fraction));
}

void CoverageNode::act() {
  if (std::exchange(new_task_, false)) {
    plan();
    sent_s_ = -1e9;
  }
  if (track_.empty() || now_s() - sent_s_ < options_.period_s) return;
  sent_s_ = now_s();
  send(plan_output_, path_of(now_s(), track_, options_.frames.map));
}

}  // namespace outrider
