#include <fmt/format.h>

#include <algorithm>

#include "log/log_lines.hpp"

namespace outrider {
namespace {

constexpr double last_robot = 5;  // subjects 1 to 5 are robots

using Rows = std::vector<std::vector<double>>;

/// Reads the rows of a file of numbers. Fault: bad_input if they begin with a time and it decreases.
Outcome<Rows> rows(const NamedText& text, std::size_t count, std::string_view takes, bool timed) {
  Rows result;
  auto ok = for_each_line(text, [&](std::span<const std::string_view> words) -> Status {
    auto v = line_numbers(words, count, takes);
    if (!v) return pass_on(v);
    if (timed && !result.empty() && (*v)[0] < result.back()[0])
      return bad_input(fmt::format("the time {} runs back; sort the lines", words[0]));
    result.push_back(std::move(*v));
    return {};
  });
  if (!ok) return pass_on(ok);
  return result;
}

/// Adds the motion from `now_s` to `until_s`, at each time with the speeds of the latest row.
void drive(LogMotion& motion, double& now_s, double until_s, const Rows& odometry, std::size_t& row,
           const LogNoise& noise) {
  while (now_s < until_s) {
    while (row + 1 < odometry.size() && odometry[row + 1][0] <= now_s) ++row;
    const bool more = row + 1 < odometry.size();
    const double end_s = std::max(now_s, more ? std::min(until_s, odometry[row + 1][0]) : until_s);
    const double duration_s = end_s - now_s;
    const double half_turn = 0.5 * odometry[row][2] * duration_s;
    if (odometry[row][0] <= now_s) motion.add(half_turn, odometry[row][1] * duration_s, half_turn, noise);
    now_s = end_s;
    if (duration_s <= 0.0 && !more) return;
  }
}

}  // namespace

Outcome<LandmarkLog> landmark_log_from_mrclam(const MrclamTexts& texts, const LogNoise& noise) {
  auto odometry = rows(texts.odometry, 3, "'time forward-speed turning-speed'", true);
  if (!odometry) return pass_on(odometry);
  auto measurements = rows(texts.measurements, 4, "'time barcode range bearing'", true);
  if (!measurements) return pass_on(measurements);
  auto barcodes = rows(texts.barcodes, 2, "'subject barcode'", false);
  if (!barcodes) return pass_on(barcodes);
  auto landmarks = rows(texts.landmarks, 5, "'subject x y x-deviation y-deviation'", false);
  if (!landmarks) return pass_on(landmarks);
  if (odometry->empty()) return bad_input("it has no line of odometry", texts.odometry.name);
  std::map<double, std::int64_t> subject_of;
  for (const auto& row : *barcodes) subject_of[row[1]] = static_cast<std::int64_t>(row[0]);
  LandmarkLog log;
  log.timed = true;
  for (const auto& row : *landmarks) log.true_landmarks[static_cast<std::int64_t>(row[0])] = {row[1], row[2]};
  double now_s = odometry->front()[0];
  std::size_t row = 0;
  for (const auto& seen : *measurements) {
    const auto subject = subject_of.find(seen[1]);
    if (subject == subject_of.end() || static_cast<double>(subject->second) <= last_robot) continue;
    if (log.steps.empty() || seen[0] > log.steps.back().time_s) {
      LogMotion motion;
      drive(motion, now_s, seen[0], *odometry, row, noise);
      log.steps.push_back({seen[0], motion.pose, motion.covariance, {}});
    }
    log.steps.back().sightings.push_back(
        sighted(subject->second, seen[2], seen[3], noise.range_m, noise.bearing_rad));
  }
  if (log.steps.empty())
    return bad_input("no line sights a landmark of the barcodes", texts.measurements.name);
  return log;
}

}  // namespace outrider
