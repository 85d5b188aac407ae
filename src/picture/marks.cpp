#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "draw.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/gun_messages.hpp"
#include "outrider/log/mapping_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider::picture {
namespace {

constexpr std::size_t most_names = 60;
constexpr std::string_view square = "m-7-7h14v14h-14z";

Vec2 place(const geometry_msgs::Point& point) { return {point.x, point.y}; }

/// Adds a short line from a place in a direction.
std::string tick(Sheet& sheet, Vec2 from, double heading_rad, double length_px) {
  const Vec2 at = sheet.at(from);
  return polyline({at, at + length_px * direction(-heading_rad)});
}

void draw_landmarks(Sheet& sheet, const Log& log) {
  const auto* map = log.latest<outrider_msgs::Landmarks>(topic::landmarks);
  if (map == nullptr) return;
  std::vector<Vec2> places, truths;
  std::string ellipses;
  for (const auto& one : map->landmarks) {
    places.push_back(vec2_of(one.position));
    truths.push_back(vec2_of(one.truth));
    if (map->landmarks.size() > 20 * most_names) continue;
    ellipses += sheet.ellipse(places.back(), one.sigma_x * one.sigma_x,
                              one.correlation * one.sigma_x * one.sigma_y, one.sigma_y * one.sigma_y);
    if (map->landmarks.size() <= most_names) sheet.name(places.back(), std::to_string(one.id));
  }
  sheet.put("landmark", ellipses, shape_at({15.0, 7.0}, small_disk), "landmark, 2\u03c3");
  sheet.marks("landmark dot", places, "m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0z",
              ellipses.empty() ? "landmark" : "");
  sheet.marks("true", truths, cross, "true place of a landmark");
}

void draw_stops(Sheet& sheet, const Log& log) {
  std::vector<Vec2> tags, reached, passed, missed;
  std::string facing, headings;
  if (const auto* all = log.latest<outrider_msgs::Tags>(topic::tags)) {
    for (const auto& tag : all->tags) {
      tags.push_back(place(tag.position));
      facing += tick(sheet, tags.back(), tag.facing, 11.0);
      sheet.name(tags.back(), fmt::format("tag {}", tag.id));
    }
  }
  sheet.put("tag", facing);
  sheet.marks("tag", tags, "m-4-4h8v8h-8z", "tag, and where it faces");
  if (const auto* all = log.latest<outrider_msgs::Waypoints>(topic::waypoints)) {
    for (std::size_t i = 0; i < all->waypoints.size(); ++i) {
      const auto& one = all->waypoints[i];
      const Vec2 at = vec2_of(one.position);
      (!one.stop ? passed : std::isfinite(one.reached) ? reached : missed).push_back(at);
      if (one.stop) headings += tick(sheet, at, one.heading, 13.0);
      if (all->waypoints.size() <= most_names) sheet.name(at, std::to_string(i + 1));
    }
  }
  sheet.put("waypoint", headings);
  sheet.marks("waypoint", passed, "m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0z", "waypoint to pass by");
  sheet.marks("waypoint", reached, small_disk, "waypoint, reached");
  sheet.marks("waypoint missing", missed, small_disk, "waypoint, not reached");
}

void draw_goals(Sheet& sheet, const Log& log) {
  std::vector<Vec2> goals, refusals, water, charge;
  for (const auto& goal : log.messages<geometry_msgs::PoseStamped>(topic::goal))
    goals.push_back(place(goal.message.pose.position));
  for (const auto& one : log.messages<outrider_msgs::Refusal>(topic::refusals))
    refusals.push_back(vec2_of(one.message.position));
  sheet.marks("goal", goals, small_disk,
              goals.size() == 1 ? "goal" : fmt::format("goals ({})", goals.size()));
  sheet.marks("refused", refusals, cross, "frontier left unexplored");
  const auto* supplies = log.latest<outrider_msgs::Supplies>(topic::supplies);
  if (supplies == nullptr) return;
  for (const auto& one : supplies->stations) {
    if (one.gives_water) water.push_back(vec2_of(one.position));
    if (one.gives_charge) charge.push_back(vec2_of(one.position));
    sheet.name(vec2_of(one.position), one.name);
  }
  sheet.marks("water", water, square, "water");
  sheet.marks("charge", charge, "m-3-5h6v10h-6z", "charge");
}

/// Draws flights as they look from above.
void draw_shots(Sheet& sheet, const Log& log) {
  std::array<std::vector<Vec2>, 2> ends;
  std::array<std::string, 2> flights;
  for (const auto& [time_ns, shot] : log.messages<outrider_msgs::Shot>(topic::shots)) {
    const std::size_t hit = shot.hit ? 1 : 0;
    std::vector<Vec2> flight{place(shot.muzzle)};
    for (const auto& point : shot.path) flight.push_back(place(point));
    flight.push_back(place(shot.contact_point));
    ends[hit].push_back(flight.back());
    if (ends[hit].size() < 2000) flights[hit] += sheet.line(flight);
  }
  sheet.put("shot", flights[1], line_sample, fmt::format("shot that hit ({})", ends[1].size()));
  sheet.put("shot miss", flights[0], line_sample, fmt::format("shot that missed ({})", ends[0].size()));
  sheet.marks("shot miss", ends[0], cross, "where it came down");
}

/// The sign of a status: its outline, and a stroke inside it. The shape says the same as the colour.
struct Sign {
  std::string_view outline = "m-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0z", stroke = "m0 0";
};

Sign sign_of(const std::string& status) {
  if (status == "reached") return {"m-6 0a6 6 0 1 0 12 0a6 6 0 1 0-12 0z", "m-2.7 .1l2.1 2.2 3.5-4.5"};
  if (status == "failed") return {"m0-7.7l7.7 7.7-7.7 7.7-7.7-7.7z", "m-2.3-2.3l4.6 4.6m0-4.6l-4.6 4.6"};
  if (status == "unreachable") return {"m-5.7-5.7h11.4v11.4h-11.4z", "m-3 0h6"};
  return {};
}

/// Draws each target where it was last, with its way there.
void draw_targets(Sheet& sheet, const Log& log) {
  std::map<std::string, outrider_msgs::Target> targets;
  std::map<std::string, std::vector<Vec2>> ways, by_status;
  for (const auto& one : log.messages<outrider_msgs::Target>(topic::targets))
    targets[one.message.name] = one.message;
  for (const auto& at : log.messages<outrider_msgs::TargetPosition>(topic::target_positions)) {
    ways[at.message.name].push_back(place(at.message.centre));
  }
  std::string boxes, walks;
  for (const auto& [name, target] : targets) {
    if (ways[name].empty()) continue;
    const Vec2 at = ways[name].back(), ahead = direction(target.yaw);
    const Vec2 x = 0.5 * target.size.x * ahead, y = 0.5 * target.size.y * perpendicular(ahead);
    boxes += sheet.area({at - x - y, at + x - y, at + x + y, at - x + y});
    walks += sheet.line(ways[name]);
    by_status[target.status].push_back(at);
    if (targets.size() <= most_names) sheet.name(at, name);
  }
  sheet.put("walk", walks, line_sample, "way of a target");
  sheet.put("box", boxes);
  for (const auto& [status, places] : by_status) {
    const Sign sign = sign_of(status);
    sheet.marks(sign.stroke == Sign{}.stroke ? "waiting" : "sign " + status, places, sign.outline,
                fmt::format("target {} ({})", status, places.size()));
    sheet.marks("check", places, sign.stroke, "");
  }
}

}  // namespace

void draw_marks(Sheet& sheet, const Log& log) {
  draw_landmarks(sheet, log);
  draw_goals(sheet, log);
  draw_stops(sheet, log);
  draw_shots(sheet, log);
  draw_targets(sheet, log);
}

}  // namespace outrider::picture
