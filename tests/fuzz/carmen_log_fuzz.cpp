// Laser logs: any bytes are a log or a refusal with a sentence, and a log can be mapped.
#include "outrider/io/carmen_log.hpp"
#include "outrider/slam/laser_slam.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(outrider::is_carmen_log(text));
  const auto log = outrider::laser_log_from_carmen({text, "log"}, {});
  if (!log) return log.error().sentence.empty() ? 1 : 0;
  auto slam = outrider::LaserSlam::begin({}, {});
  for (const outrider::LaserLogStep& step : log->steps)
    static_cast<void>(slam->advance(step.motion, step.scan));
  return 0;
}
