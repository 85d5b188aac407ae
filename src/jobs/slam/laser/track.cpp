#include "laser/track.hpp"

#include <fmt/format.h>

#include <iterator>

#include "outrider/io/log/trajectory.hpp"
#include "outrider/slam/map_error.hpp"

namespace outrider {
namespace {

std::string track_csv(std::span<const TrackedPose> track) {
  constexpr std::size_t most_line_bytes = 130;  // pages that are not written take no memory
  std::string text = "step,time,x,y,heading\n";
  text.reserve(most_line_bytes * (track.size() + 1));
  for (const auto& [step, time_s, pose] : track) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", step, time_s, pose.position.x,
                   pose.position.y, pose.heading_rad);
  }
  return text;
}

}  // namespace

std::vector<NamedContent> track_files(std::span<const TrackedPose> track) {
  const auto pose_at = [&](std::size_t i) { return stamped_pose(track[i].time_s, track[i].pose); };
  std::vector<NamedContent> files;  // a list of initial values would be copied
  files.push_back({"track.csv", track_csv(track)});
  files.push_back({"trajectory.tum", tum_text_of(track.size(), pose_at)});
  return files;
}

PathError path_error(const std::vector<Vec2>& path, const std::vector<Vec2>& reference) {
  if (path.empty()) return {};
  const Pose2 motion = rigid_alignment(reference, path);
  PathError error;
  double sum_m = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    error.reference.push_back(motion * reference[i]);
    sum_m += distance(error.reference.back(), path[i]);
  }
  error.mean_m = sum_m / static_cast<double>(path.size());
  error.rms_m = rms_distance(reference, path, motion);
  return error;
}

}  // namespace outrider
