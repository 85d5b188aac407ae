// The output of 'outrider detect'.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "outrider/estimate/camera_image.hpp"
#include "outrider/estimate/tag.hpp"
#include "outrider/estimate/tag_detector.hpp"

namespace outrider::cli {

nlohmann::ordered_json tags_json(const std::vector<TagSighting>& sightings);

/// Prints a line for each tag and one for each of its poses.
void print_table(const std::vector<TagSighting>& sightings, const std::vector<TagFamily>& families);

struct FamilyCount {
  TagFamily family;
  int tags = 0;
};

/// Counts the tags of the families that the options leave out, each without a corrected bit.
std::vector<FamilyCount> count_others(const CameraImage& image, const TagDetectorOptions& options);

/// Returns what to say where no tag is found: which families were sought, and which ones are there or known.
std::string none_found(const std::vector<TagFamily>& families, const std::vector<FamilyCount>& others);

}  // namespace outrider::cli
