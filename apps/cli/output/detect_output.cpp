#include "output/detect_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/terminal.hpp"
#include "outrider/core/units.hpp"

namespace outrider::cli {
namespace {

/// Returns how likely a pose is the true one of its tag.
std::string odds_text(const TagSighting& sighting, const TagPose& pose) {
  if (sighting.poses.size() < 2) return "the only solution";
  return fmt::format("{:.{}f} % likely", 100.0 * pose.probability,
                     pose.probability > 0.01 && pose.probability < 0.99 ? 0 : 3);
}

/// Returns the yaw of the tag, counter-clockwise as seen from above an upright camera; 0 if the tag faces the
/// camera's plane.
double yaw_rad(const Pose3& camera_T_tag) {
  const Vec3 into_tag = camera_T_tag.rotation.axes[2];
  return -std::atan2(into_tag.x, into_tag.z);
}

nlohmann::ordered_json pose_json(const TagPose& pose) {
  const Vec3 t = pose.camera_T_tag.position;
  const auto& axes = pose.camera_T_tag.rotation.axes;
  const auto sigma = [&](int i) { return std::sqrt(pose.covariance(i, i)); };
  return {{"translation_m", {t.x, t.y, t.z}},
          {"rotation",
           {{axes[0].x, axes[1].x, axes[2].x},
            {axes[0].y, axes[1].y, axes[2].y},
            {axes[0].z, axes[1].z, axes[2].z}}},
          {"yaw_deg", degrees(yaw_rad(pose.camera_T_tag))},
          {"distance_m", norm(t)},
          {"probability", pose.probability},
          {"error_px", pose.error_px},
          {"sigma_m", {sigma(0), sigma(1), sigma(2)}},
          {"sigma_deg", {degrees(sigma(3)), degrees(sigma(4)), degrees(sigma(5))}}};
}

}  // namespace

nlohmann::ordered_json tags_json(const std::vector<TagSighting>& sightings) {
  auto tags = nlohmann::ordered_json::array();
  for (const TagSighting& sighting : sightings) {
    auto corners = nlohmann::ordered_json::array();
    for (const Vec2 corner : sighting.corners_px) corners.push_back({corner.x, corner.y});
    auto poses = nlohmann::ordered_json::array();
    for (const TagPose& pose : sighting.poses) poses.push_back(pose_json(pose));
    tags.push_back({{"family", layout(sighting.family).name},
                    {"id", sighting.id},
                    {"corners", std::move(corners)},
                    {"corrected_bits", sighting.corrected_bits},
                    {"margin", sighting.margin},
                    {"poses", std::move(poses)}});
  }
  return tags;
}

void print_table(const std::vector<TagSighting>& sightings, const std::vector<TagFamily>& families) {
  for (const TagSighting& sighting : sightings) {
    const std::string_view family = families.size() > 1 ? layout(sighting.family).name : "";
    show("  {}{}{:3}  corners", family, family.empty() ? "" : " ", sighting.id);
    for (const Vec2 corner : sighting.corners_px) show(" ({:.2f}, {:.2f})", corner.x, corner.y);
    show("\n");
    for (const TagPose& pose : sighting.poses) {
      const Vec3 t = pose.camera_T_tag.position;
      show("       at ({:.3f}, {:.3f}, {:.3f}) m, turned by {:.1f} deg; error {:.2f} px, {}\n", t.x, t.y, t.z,
           degrees(yaw_rad(pose.camera_T_tag)), pose.error_px, odds_text(sighting, pose));
    }
  }
}

std::vector<FamilyCount> count_others(const CameraImage& image, const TagDetectorOptions& options) {
  TagDetectorOptions others = options;
  others.families.clear();
  others.most_corrected_bits = 0;
  for (const TagLayout& family : tag_layouts()) {
    if (std::ranges::find(options.families, family.family) == options.families.end())
      others.families.push_back(family.family);
  }
  std::vector<FamilyCount> counts;
  if (others.families.empty()) return counts;
  for (const TagSighting& sighting : TagDetector(others).detect(image)) {
    if (counts.empty() || counts.back().family != sighting.family) counts.push_back({sighting.family, 0});
    ++counts.back().tags;
  }
  return counts;
}

std::string none_found(const std::vector<TagFamily>& families, const std::vector<FamilyCount>& others) {
  std::string seen, known;
  for (const FamilyCount& other : others) {
    const std::string_view name = layout(other.family).name;
    seen += fmt::format("{}{} of {}", seen.empty() ? "" : ", ", other.tags, name);
  }
  for (const TagLayout& family : tag_layouts()) {
    if (std::ranges::find(families, family.family) != families.end()) continue;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", family.name);
  }
  const std::string sought = tag_family_names(families);
  if (!seen.empty())
    return fmt::format("none of {}, but there {} {}; name the family with --family", sought,
                       others.front().tags == 1 && others.size() == 1 ? "is" : "are", seen);
  if (known.empty()) return fmt::format("none of {}", sought);
  return fmt::format("none of {}; --family takes {} too", sought, known);
}

}  // namespace outrider::cli
