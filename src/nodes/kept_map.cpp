#include "outrider/nodes/kept_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/log/scan_mount.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/log/mcap/mcap_sink.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/read_log.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/slam/map/map_fit.hpp"
#include "outrider/world/clearance.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr std::size_t least_beams = 20;
constexpr std::size_t most_scans = 100'000;
constexpr double least_share = 0.7, most_contradiction = 0.1;

std::string state_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".state").string();
}

std::string scans_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".mcap").string();
}

/// Returns the scans as a log with their poses.
Outcome<std::string> scans_log(const std::vector<KeptScan>& scans) {
  std::string bytes;
  auto writer = McapWriter::begin(make_string_sink(bytes));
  if (!writer) return pass_on(writer);
  McapSink sink(std::move(*writer));
  Log log;
  log.add_sink(sink);
  for (const KeptScan& kept : scans) {
    log.append(topic::pose, kept.scan.time_s, stamped(kept.scan.time_s, kept.map_T_robot));
    log.append(topic::scan, kept.scan.time_s, scan_message(kept.scan, kept.scan.time_s));
  }
  log.remove_sink(sink);
  if (auto ok = sink.finish(); !ok) return pass_on(ok);
  return bytes;
}

/// Reads what scans_log() returned.
Outcome<std::vector<KeptScan>> read_scans(const std::string& path) {
  auto stored = read_log(path);
  if (!stored) return pass_on(stored);
  const auto& poses = stored->log.messages<geometry_msgs::PoseStamped>(topic::pose);
  const auto& messages = stored->log.messages<sensor_msgs::LaserScan>(topic::scan);
  if (poses.size() != messages.size() || poses.size() > most_scans) {
    return bad_input(fmt::format("it has {} scans and {} poses; it has to have as many of both, and at most "
                                 "{}; delete it to go on without scans",
                                 messages.size(), poses.size(), most_scans),
                     path);
  }
  std::vector<KeptScan> scans;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    KeptScan kept{pose_of(poses[i].message.pose), scan_of(messages[i].message, false, messages[i].time_s())};
    if (auto ok = check(kept.scan); !ok || !finite(kept.map_T_robot))
      return bad_input(
          fmt::format("scan {} or its pose is none; delete the file to go on without scans", i + 1), path);
    scans.push_back(std::move(kept));
  }
  return scans;
}

std::string state_text(const KeptMap& map) {
  return fmt::format("begun {}\nmap_T_odom {} {} {}\n", map.begun_s, map.map_T_odom.position.x,
                     map.map_T_odom.position.y, map.map_T_odom.heading_rad);
}

/// Reads what state_text() wrote.
Status read_state(std::string_view text, const std::string& name, KeptMap& map) {
  const auto parts = words(text);
  std::vector<double> numbers;
  for (const std::string_view part : parts) {
    if (const auto value = number<double>(part); value && std::isfinite(*value)) numbers.push_back(*value);
  }
  if (parts.size() != 6 || numbers.size() != 4 || parts[0] != "begun" || parts[2] != "map_T_odom") {
    return bad_input("it has to say 'begun TIME' and 'map_T_odom X Y HEADING'; delete it to begin a new map",
                     name);
  }
  map.begun_s = numbers[0];
  map.map_T_odom = {{numbers[1], numbers[2]}, numbers[3]};
  return {};
}

/// Returns where beams end, in the frame of the robot.
std::vector<Vec2> ends_of(const LaserScan& scan, const LaserSlamOptions& options) {
  std::vector<Vec2> ends;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= scan.least_m && range_m <= std::min(scan.most_m, options.reach_m))) continue;
    const double bearing_rad = scan.first_rad + static_cast<double>(i) * scan.step_rad;
    ends.push_back(options.robot_T_laser * (range_m * direction(bearing_rad)));
  }
  return ends;
}

/// Returns how well beams end at walls: 1 for each that does, less the farther it ends from one.
double score(const Pose2& map_T_robot, const Grid<std::uint32_t>& away, const std::vector<Vec2>& ends) {
  double sum = 0.0;
  for (const Vec2 end : ends) {
    const Cell cell = away.frame.cell_at(map_T_robot * end);
    if (away.contains(cell)) sum += std::exp(-0.5 * static_cast<double>(away[cell]));
  }
  return sum;
}

/// Returns the best of the poses around one, at most 5 steps of 0.05 m and 0.03 rad off.
Pose2 best_around(const Pose2& middle, double step, const Grid<std::uint32_t>& away,
                  const std::vector<Vec2>& ends) {
  constexpr int steps = 5;
  Pose2 best = middle;
  double most = score(best, away, ends);
  for (int turn = -steps; turn <= steps; ++turn) {
    for (int y = -steps; y <= steps; ++y) {
      for (int x = -steps; x <= steps; ++x) {
        const Pose2 pose{middle.position + 0.05 * step * Vec2{static_cast<double>(x), static_cast<double>(y)},
                         middle.heading_rad + 0.03 * step * turn};
        const double here = score(pose, away, ends);
        if (here <= most) continue;
        most = here;
        best = pose;
      }
    }
  }
  return best;
}

}  // namespace

Status save(const std::string& path, const KeptMap& map) {
  const std::string image = std::filesystem::path(path).replace_extension(".pgm").string();
  auto text = map_server_text({map.occupancy, 0.0}, std::filesystem::path(image).filename().string());
  if (!text) return pass_on(text);
  auto scans = scans_log(map.scans);
  if (!scans) return pass_on(scans);
  return write_files({{image, std::move(text->image)},
                      {scans_path(path), std::move(*scans)},
                      {path, std::move(text->yaml)},
                      {state_path(path), state_text(map)}});
}

Outcome<std::optional<KeptMap>> load_kept_map(const std::string& path) {
  const std::string state = state_path(path);
  if (!std::filesystem::exists(state)) return std::nullopt;
  auto text = read_file(state);
  if (!text) return pass_on(text);
  KeptMap map;
  if (auto ok = read_state(*text, state, map); !ok) return pass_on(ok);
  auto saved = load_map_server(path);
  if (!saved) return pass_on(saved);
  map.occupancy = std::move(saved->occupancy);
  if (!std::filesystem::exists(scans_path(path))) return std::optional(std::move(map));
  auto scans = read_scans(scans_path(path));
  if (!scans) return pass_on(scans);
  map.scans = std::move(*scans);
  return std::optional(std::move(map));
}

std::optional<Pose2> place_on(const KeptMap& map, const Pose2& odom_T_robot, const LaserScan& scan,
                              const LaserSlamOptions& options) {
  const std::vector<Vec2> ends = ends_of(scan, options);
  Grid<std::uint8_t> walls(map.occupancy.frame);
  std::ranges::transform(map.occupancy.cells, walls.cells.begin(),
                         [](std::uint8_t cell) -> std::uint8_t { return cell == occupied_cell; });
  const Grid<std::uint32_t> away = squared_clearance(walls);
  Pose2 best = wrap_heading(compose(map.map_T_odom, odom_T_robot));
  for (const double step : {1.0, 0.2}) best = best_around(best, step, away, ends);
  const MapFit fit = map_fit(map.occupancy, compose(best, options.robot_T_laser), scan, options.reach_m);
  const bool good =
      fit.beams() >= least_beams && fit.share() >= least_share && fit.contradiction() <= most_contradiction;
  return good ? std::optional(best) : std::nullopt;
}

Grid<std::uint8_t> overlaid(const Grid<std::uint8_t>& older, const Grid<std::uint8_t>& newer) {
  const double cell_m = newer.frame.resolution_m;
  Box2 box = older.frame.bounds();
  box.include(newer.frame.bounds().low);
  box.include(newer.frame.bounds().high);
  const auto cells = [&](double length_m) { return static_cast<int>(std::llround(length_m / cell_m)); };
  const auto shift = [&](const GridFrame& from) {
    return Cell{cells(from.origin.x - box.low.x), cells(from.origin.y - box.low.y)};
  };
  const GridFrame frame{box.low, cell_m, cells(box.size().x), cells(box.size().y)};
  Grid<std::uint8_t> both(frame);
  both.cells = moved_cells<std::uint8_t>(older.cells, older.frame, frame, shift(older.frame), unknown_cell);
  const auto over =
      moved_cells<std::uint8_t>(newer.cells, newer.frame, frame, shift(newer.frame), unknown_cell);
  for (std::size_t i = 0; i < over.size(); ++i) {
    if (over[i] != unknown_cell) both.cells[i] = over[i];
  }
  return both;
}

}  // namespace outrider
