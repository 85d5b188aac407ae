#include "outrider/io/carmen_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>

#include "log_lines.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr std::string_view scan_form =
    "'FLASER n r1 .. rn x y heading x y heading time host time' with as many ranges as n says";
constexpr std::string_view odometry_form = "'ODOM x y heading ..'";
constexpr std::uint64_t most_beams = 100'000;
constexpr double least_range_m = 0.02;

using Words = std::span<const std::string_view>;

Outcome<Pose2> pose_of(Words words, std::string_view form) {
  const auto v = line_numbers(words, 3, form);
  if (!v) return bad_input(v.error().sentence);
  return Pose2{{(*v)[0], (*v)[1]}, (*v)[2]};
}

/// Returns true for the notations of invalid readings: nan, -nan, inf, Infinity.
bool is_no_number(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

struct ScanLine {
  LaserScan scan;
  Pose2 pose;
};

Outcome<ScanLine> scan_of(Words words, double most_m) {
  const auto count = words.size() > 1 ? number<std::uint64_t>(words[1]) : std::nullopt;
  if (!count || *count > most_beams) {
    return bad_input(fmt::format("'{}' is no number of beams from 0 to {}; a line is {}",
                                 words.size() > 1 ? excerpt(words[1]) : "", most_beams, scan_form));
  }
  const auto n = static_cast<std::size_t>(*count);
  if (words.size() < n + 9) {
    return bad_input(fmt::format("{} words after FLASER {}, where {} are expected; a line is {}",
                                 words.size() - 2, n, n + 7, scan_form));
  }
  ScanLine line;
  const auto times = line_numbers(words.subspan(n + 8, 1), 1, scan_form);
  auto pose = pose_of(words.subspan(n + 2, 3), scan_form);
  if (!times || !pose) return bad_input(times ? pose.error().sentence : times.error().sentence);
  line.pose = *pose;
  const double parts = static_cast<double>(std::max<std::size_t>(1, n % 2 == 0 ? n : n - 1));
  line.scan = {times->front(), -0.5 * pi, pi / parts, least_range_m, most_m, {}};
  line.scan.ranges_m.reserve(n);
  for (const std::string_view word : words.subspan(2, n)) {
    const auto range_m = number<double>(word);
    if (!range_m && !is_no_number(word)) {
      return bad_input(fmt::format("'{}' is no range; a line is {}", excerpt(word), scan_form));
    }
    const bool reads = range_m && *range_m < most_m;
    line.scan.ranges_m.push_back(reads ? static_cast<float>(*range_m)
                                       : std::numeric_limits<float>::quiet_NaN());
  }
  return line;
}

}  // namespace

std::vector<Option> describe(CarmenOptions& options) {
  return {
      {"most", "m", 0.1, 1e4, "range from which a reading of a CARMEN log says nothing", &options.most_m}};
}

bool is_carmen_log(std::string_view text) {
  constexpr int lines_looked_at = 1000;
  for (int i = 0; i < lines_looked_at && !text.empty(); ++i) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word == "FLASER" || word == "ODOM" || word == "PARAM") return true;
    if (!word.empty() && !word.starts_with('#')) return false;
  }
  return false;
}

Outcome<LaserLog> laser_log_from_carmen(const NamedText& log, const CarmenOptions& options) {
  LaserLog result;
  std::optional<Pose2> odometry;  // the last one since the previous scan
  bool has_odometry = false;
  auto ok = for_each_line(log, [&](Words words) -> Status {
    if (words[0] == "ODOM") {
      const auto pose = pose_of(words.subspan(1, std::min<std::size_t>(3, words.size() - 1)), odometry_form);
      if (!pose) return bad_input(pose.error().sentence);
      odometry = *pose;
      has_odometry = true;
    }
    if (words[0] != "FLASER") return {};
    auto line = scan_of(words, options.most_m);
    if (!line) return bad_input(line.error().sentence);
    Pose2 motion;
    if (!result.reference.empty() && odometry)
      motion = wrap_heading(relative_pose(result.reference.back(), *odometry));
    odometry.reset();
    result.steps.push_back({motion, std::move(line->scan)});
    result.reference.push_back(line->pose);
    return {};
  });
  if (!ok) return pass_on(ok);
  if (result.steps.empty())
    return bad_input("the log has no scan; expected at least one FLASER line", log.name);
  if (!has_odometry) {
    for (std::size_t i = 1; i < result.steps.size(); ++i) {
      result.steps[i].motion = wrap_heading(relative_pose(result.reference[i - 1], result.reference[i]));
    }
    result.reference.clear();
  }
  return result;
}

}  // namespace outrider
