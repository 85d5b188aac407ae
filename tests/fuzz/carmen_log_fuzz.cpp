// Laser logs: any bytes are a log or a refusal with a sentence, and the beginning of a log can be mapped.
#include <algorithm>
#include <cstdlib>

#include "fuzz_entry.hpp"
#include "outrider/io/log/carmen_log.hpp"
#include "outrider/slam/laser/laser_slam.hpp"

namespace {

// Matching a scan costs milliseconds, reading one microseconds: so a few short scans are mapped, with a laser
// that sees near.
constexpr std::size_t mapped_scans = 4;
constexpr std::size_t mapped_beams = 24;
constexpr double reach_m = 3.0;

void map_scans(const outrider::LaserLog& log) {
  outrider::LaserSlamOptions options;
  options.reach_m = reach_m;
  auto slam = outrider::LaserSlam::begin(options, {});
  for (std::size_t i = 0; i < std::min(log.steps.size(), mapped_scans); ++i) {
    outrider::LaserScan scan = log.steps[i].scan;
    if (scan.ranges_m.size() > mapped_beams) scan.ranges_m.resize(mapped_beams);
    static_cast<void>(slam->advance(log.steps[i].motion, scan));
  }
}

}  // namespace

extern "C" int FUZZ_ENTRY(carmen_log)(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(outrider::is_carmen_log(text));
  outrider::CarmenOptions options;
  options.most_m = reach_m;
  const auto log = outrider::laser_log_from_carmen({text, "log"}, options);
  if (log) {
    map_scans(*log);
  } else if (log.error().sentence.empty()) {
    std::abort();
  }
  return 0;
}
