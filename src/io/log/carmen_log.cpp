#include "outrider/io/log/carmen_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "log/log_lines.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr std::string_view scan_form =
    "'FLASER n r1 .. rn x y heading x y heading time host time' with as many ranges as n says";
constexpr std::string_view robot_scan_form =
    "'ROBOTLASER1 type start field step most accuracy remissions n r1 .. rn m v1 .. vm x y heading x y "
    "heading "
    "speed turn safety safety axis time host time'";
constexpr std::string_view odometry_form = "'ODOM x y heading ..'";
constexpr std::uint64_t most_beams = 100'000;
constexpr double least_range_m = 0.02;

using Words = std::span<const std::string_view>;

Outcome<Pose2> pose_of_words(Words words, std::string_view form) {
  const auto v = line_numbers(words, 3, form);
  if (!v) return bad_input(v.error().sentence);
  return Pose2{{(*v)[0], (*v)[1]}, (*v)[2]};
}

/// Returns true for the notations of invalid readings: nan, -nan, inf, Infinity.
bool is_no_number(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  const std::string name = lower(word);
  return name == "nan" || name == "inf" || name == "infinity";
}

struct ScanLine {
  LaserScan scan;
  Pose2 pose;  ///< of the robot
  std::optional<Pose2> robot_T_laser;
};

/// Reads the ranges of a line. A range that is no number or not below `most_m` is no reading.
Status read_ranges(Words words, double most_m, std::string_view form, std::vector<float>& ranges_m) {
  ranges_m.reserve(words.size());
  for (const std::string_view word : words) {
    const auto range_m = number<double>(word);
    if (!range_m && !is_no_number(word)) {
      return bad_input(fmt::format("'{}' is no range; a line is {}", excerpt(word), form));
    }
    const bool reads = range_m && *range_m < most_m;
    ranges_m.push_back(reads ? static_cast<float>(*range_m) : std::numeric_limits<float>::quiet_NaN());
  }
  return {};
}

/// Returns the number of values that a line says to have at a word.
Outcome<std::size_t> count_at(Words words, std::size_t index, std::string_view form) {
  const auto count = index < words.size() ? number<std::uint64_t>(words[index]) : std::nullopt;
  if (count && *count <= most_beams) return static_cast<std::size_t>(*count);
  return bad_input(fmt::format("'{}' is no number of beams from 0 to {}; a line is {}",
                               index < words.size() ? excerpt(words[index]) : "", most_beams, form));
}

Outcome<ScanLine> scan_line_of(Words words, double most_m) {
  auto count = count_at(words, 1, scan_form);
  if (!count) return pass_on(count);
  const std::size_t n = *count;
  if (words.size() < n + 9) {
    return bad_input(fmt::format("{} words after FLASER {}, where {} are expected; a line is {}",
                                 words.size() - 2, n, n + 7, scan_form));
  }
  ScanLine line;
  const auto times = line_numbers(words.subspan(n + 8, 1), 1, scan_form);
  auto pose = pose_of_words(words.subspan(n + 2, 3), scan_form);
  if (!times || !pose) return bad_input(times ? pose.error().sentence : times.error().sentence);
  line.pose = *pose;
  const double parts = static_cast<double>(std::max<std::size_t>(1, n % 2 == 0 ? n : n - 1));
  line.scan = {times->front(), -0.5 * pi, pi / parts, least_range_m, most_m, {}};
  if (auto ok = read_ranges(words.subspan(2, n), most_m, scan_form, line.scan.ranges_m); !ok)
    return pass_on(ok);
  return line;
}

/// Reads the newer form of a scan, which says how the laser measures and where it stands on the robot.
Outcome<ScanLine> robot_scan_of(Words words, double most_m) {
  if (words.size() < 9)
    return bad_input(fmt::format("{} words; a line is {}", words.size(), robot_scan_form));
  const auto settings = line_numbers(words.subspan(2, 4), 4, robot_scan_form);
  if (!settings) return bad_input(settings.error().sentence);
  auto count = count_at(words, 8, robot_scan_form);
  if (!count) return pass_on(count);
  const std::size_t n = *count;
  auto remissions = count_at(words, n + 9, robot_scan_form);
  if (!remissions) return pass_on(remissions);
  const std::size_t rest = n + 10 + *remissions;
  if (words.size() < rest + 12) {
    return bad_input(fmt::format("{} words, where {} are expected; a line is {}", words.size(), rest + 12,
                                 robot_scan_form));
  }
  const auto laser = pose_of_words(words.subspan(rest, 3), robot_scan_form);
  const auto robot = pose_of_words(words.subspan(rest + 3, 3), robot_scan_form);
  const auto time = line_numbers(words.subspan(rest + 11, 1), 1, robot_scan_form);
  for (const auto* part : {&laser, &robot}) {
    if (!*part) return bad_input(part->error().sentence);
  }
  if (!time) return bad_input(time.error().sentence);
  const double field_rad = (*settings)[1], step_rad = (*settings)[2], laser_m = (*settings)[3];
  ScanLine line;
  line.pose = *robot;
  line.robot_T_laser = wrap_heading(relative_pose(*robot, *laser));
  line.scan = {time->front(),
               (*settings)[0],
               step_rad > 0.0 || n < 2 ? step_rad : field_rad / static_cast<double>(n - 1),
               least_range_m,
               laser_m > least_range_m ? std::min(laser_m, most_m) : most_m,
               {}};
  if (auto ok = read_ranges(words.subspan(9, n), line.scan.most_m, robot_scan_form, line.scan.ranges_m); !ok)
    return pass_on(ok);
  return line;
}

/// The pose at which a scan was taken, and the odometry around it.
struct OdometryOfScan {
  Pose2 pose;                   ///< of the line with the scan
  std::optional<Pose2> before;  ///< the last ODOM since the scan before
  std::optional<Pose2> step;    ///< its motion since the ODOM before that
  std::optional<Pose2> after;   ///< the first ODOM before the next scan
};

bool is_near_pose(const Pose2& a, const Pose2& b, double most_m, double most_rad) {
  return distance(a.position, b.position) <= most_m &&
         std::abs(wrap_angle(a.heading_rad - b.heading_rad)) <= most_rad;
}

/// Returns true if the pose lies on the way between two others, and not at its ends, where small corrections
/// of a good odometry lie too.
bool is_between(const Pose2& from, const Pose2& to, const Pose2& pose) {
  constexpr double end = 0.05, off_m = 0.002, off_rad = 0.005;
  const Vec2 way = to.position - from.position;
  const double part = dot(way, pose.position - from.position) / dot(way, way);
  if (!(part >= end && part <= 1.0 - end)) return false;
  const Pose2 there{from.position + part * way,
                    from.heading_rad + part * wrap_angle(to.heading_rad - from.heading_rad)};
  return is_near_pose(there, pose, off_m, off_rad);
}

/// Returns true if the pose of the scan is one of the odometry: equal to the ODOM before, between it and the
/// one after, or as far from the one before as that from its predecessor.
bool is_on_odometry(const OdometryOfScan& scan) {
  constexpr double rounding = 1e-4, same_m = 0.002;
  const Vec2 here = scan.pose.position;
  if (is_near_pose(*scan.before, scan.pose, rounding, rounding)) return true;
  const bool is_based_on_it = scan.after && distance(scan.after->position, here) <= 1e-9;
  if (scan.after && !is_based_on_it) return is_between(*scan.before, *scan.after, scan.pose);
  if (!scan.step) return false;
  const Vec2 expected = compose(*scan.before, *scan.step).position;
  return distance(expected, here) <= 0.5 * norm(scan.step->position) + same_m;
}

/// Returns true if the poses of the scans are those of a finished map, and not of the odometry. Scans at
/// which the robot stood still say nothing.
bool is_corrected(const std::vector<OdometryOfScan>& scans) {
  constexpr double moved_m = 0.02;
  std::size_t moved = 0, off = 0;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    if (!scans[i].before || distance(scans[i].pose.position, scans[i - 1].pose.position) < moved_m) continue;
    ++moved;
    off += is_on_odometry(scans[i]) ? 0 : 1;
  }
  return 2 * off > moved;
}

}  // namespace

std::vector<Option> describe(CarmenOptions& options) {
  return {
      {"most", "m", 0.1, 1e4, "range from which a reading of a CARMEN log says nothing", &options.most_m}};
}

bool is_carmen_log(std::string_view text) {
  constexpr std::array<std::string_view, 4> beginnings = {"FLASER", "ROBOTLASER1", "ODOM", "PARAM"};
  TextLines lines{text, {}};
  return lines.next_filled() && std::ranges::count(beginnings, words(lines.line, 1).front()) > 0;
}

Outcome<LaserLog> laser_log_from_carmen(const NamedText& log, const CarmenOptions& options) {
  LaserLog result;
  std::vector<OdometryOfScan> scans;
  std::optional<Pose2> odometry, step;  // the last one since the previous scan, and its motion
  std::string kind;                     // of the lines with scans
  bool has_odometry = false;
  auto ok = for_each_line(log, [&](Words words) -> Status {
    if (words[0] == "ODOM") {
      const auto pose =
          pose_of_words(words.subspan(1, std::min<std::size_t>(3, words.size() - 1)), odometry_form);
      if (!pose) return bad_input(pose.error().sentence);
      if (!odometry && !scans.empty()) scans.back().after = *pose;
      step = odometry ? std::optional(wrap_heading(relative_pose(*odometry, *pose))) : std::nullopt;
      odometry = *pose;
      has_odometry = true;
    }
    if (words[0] != "FLASER" && words[0] != "ROBOTLASER1") return {};
    if (kind.empty()) kind = words[0];
    if (words[0] != kind) return {};  // the same scan in the other form
    auto line = kind == "FLASER" ? scan_line_of(words, options.most_m) : robot_scan_of(words, options.most_m);
    if (!line) return bad_input(line.error().sentence);
    Pose2 motion;
    if (!scans.empty() && odometry) motion = wrap_heading(relative_pose(scans.back().pose, *odometry));
    if (!result.robot_T_laser) result.robot_T_laser = line->robot_T_laser;
    scans.push_back({line->pose, std::exchange(odometry, {}), std::exchange(step, {}), {}});
    result.steps.push_back({motion, std::move(line->scan)});
    return {};
  });
  if (!ok) return pass_on(ok);
  if (result.steps.empty())
    return bad_input("the log has no scan; expected at least one FLASER or ROBOTLASER1 line", log.name);
  if (has_odometry && is_corrected(scans)) {
    for (const OdometryOfScan& scan : scans) result.reference.push_back(scan.pose);
    return result;
  }
  for (std::size_t i = 1; i < scans.size(); ++i)
    result.steps[i].motion = wrap_heading(relative_pose(scans[i - 1].pose, scans[i].pose));
  return result;
}

}  // namespace outrider
