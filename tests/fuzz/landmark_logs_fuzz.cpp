// Landmark logs and states: what loads can be mapped, step by step, and the state of the map loads again.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/log/landmark_logs.hpp"
#include "outrider/slam/landmark/landmark_slam.hpp"

namespace {

void map_landmarks(const outrider::Outcome<outrider::LandmarkLog>& log, const char* engine) {
  if (!log) return;
  outrider::LandmarkSlamOptions options;
  options.engine = engine;
  auto slam = outrider::LandmarkSlam::begin(options, log->start);
  for (const outrider::LogStep& step : log->steps) {
    if (!slam->advance(step)) return;
  }
}

}  // namespace

extern "C" int FUZZ_ENTRY(landmark_logs)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  for (const char* engine : {"kalman", "ekf", "graph"}) {
    map_landmarks(outrider::landmark_log_from_freiburg({input, "log"}, {"", "map"}, {}), engine);
    map_landmarks(outrider::landmark_log_from_chain({input, "log"}), engine);
  }
  map_landmarks(
      outrider::landmark_log_from_mrclam({{input, "o"}, {"1 72 1 0\n", "m"}, {"6 72\n", "b"}, {"", "l"}}, {}),
      "ekf");
  if (const auto slam = outrider::LandmarkSlam::load(input)) {
    if (!std::isfinite(slam->pose().position.x)) std::abort();
    if (!outrider::LandmarkSlam::load(slam->state())) std::abort();
  }
  return 0;
}
