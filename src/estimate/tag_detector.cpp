#include "outrider/estimate/tag_detector.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace outrider {
namespace {

using Family = std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)>;
using Finder = std::unique_ptr<apriltag_detector_t, decltype(&apriltag_detector_destroy)>;
using Findings = std::unique_ptr<zarray_t, decltype(&apriltag_detections_destroy)>;

/// Frees an image of libapriltag, which does not export its own function for that.
struct FreePicture {
  void operator()(image_u8_t* picture) const {
    std::free(picture->buf);
    std::free(picture);
  }
};
using Picture = std::unique_ptr<image_u8_t, FreePicture>;

constexpr int least_side_px = 16;  // a tag has 10 cells on each side

bool within(Vec2 p, const CameraImage& image) {
  return p.x >= 0.0 && p.y >= 0.0 && p.x <= image.width && p.y <= image.height;
}

PixelBox clipped(const PixelBox& box, const CameraImage& image) {
  return {std::max(box.left, 0), std::max(box.top, 0), std::min(box.right, image.width),
          std::min(box.bottom, image.height)};
}

}  // namespace

struct TagDetector::Library {
  Family family{tag36h11_create(), &tag36h11_destroy};
  Finder finder{apriltag_detector_create(), &apriltag_detector_destroy};
};

std::vector<Option> describe(TagDetectorOptions& options) {
  return {
      {"decimation", "", 1, 8, "seek edges in an image this much coarser; 1 is most exact",
       &options.decimation},
      {"refine_edges", "", 0, 0, "snap edges to the strongest gradient; needed with decimation",
       &options.refine_edges},
      {"blur", "px", 0, 10, "standard deviation of a blur before the search, for noisy images",
       &options.blur_px},
      {"most_corrected_bits", "", 0, 2, "bits of 36 that may be mended in a tag",
       &options.most_corrected_bits},
      {"least_margin", "", 0, 255, "least contrast of a tag's bits, in grey levels", &options.least_margin}};
}

TagDetector::TagDetector(const TagDetectorOptions& options)
    : options_(options), library_(std::make_unique<Library>()) {
  apriltag_detector_t& finder = *library_->finder;
  apriltag_detector_add_family_bits(&finder, library_->family.get(),
                                    static_cast<int>(options.most_corrected_bits));
  finder.nthreads = 1;
  finder.quad_decimate = static_cast<float>(options.decimation);
  finder.quad_sigma = static_cast<float>(options.blur_px);
  finder.refine_edges = options.refine_edges;
}
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;
TagDetector::~TagDetector() = default;

std::vector<TagSighting> TagDetector::detect(const CameraImage& image) {
  const PixelBox all{0, 0, image.width, image.height};
  return detect(image, {&all, 1});
}

std::vector<TagSighting> TagDetector::detect(const CameraImage& image, std::span<const PixelBox> boxes) {
  std::vector<TagSighting> sightings;
  for (const PixelBox& wanted : boxes) {
    const PixelBox box = clipped(wanted, image);
    if (box.right - box.left < least_side_px || box.bottom - box.top < least_side_px) continue;
    // The library takes a non-const image, but does not change it.
    auto* pixels = const_cast<std::uint8_t*>(&image.values[image.index(box.left, box.top)]);
    image_u8_t part{box.right - box.left, box.bottom - box.top, image.width, pixels};
    const Findings findings{apriltag_detector_detect(library_->finder.get(), &part),
                            &apriltag_detections_destroy};
    for (int i = 0; i < zarray_size(findings.get()); ++i) {
      apriltag_detection_t* found = nullptr;
      zarray_get(findings.get(), i, &found);
      TagSighting sighting{found->id, {}, found->hamming, static_cast<double>(found->decision_margin), {}};
      for (std::size_t c = 0; c < 4; ++c) {
        sighting.corners_px[c] = Vec2{found->p[c][0], found->p[c][1]} +
                                 Vec2{static_cast<double>(box.left), static_cast<double>(box.top)};
      }
      const bool whole = std::ranges::all_of(sighting.corners_px, [&](Vec2 p) { return within(p, image); });
      if (whole && sighting.margin >= options_.least_margin) sightings.push_back(std::move(sighting));
    }
  }
  std::ranges::sort(sightings, {}, [](const TagSighting& s) {
    return std::tuple(s.id, s.corners_px[0].x, s.corners_px[0].y);
  });
  return sightings;
}

Outcome<TagPattern> tag_pattern(int id) {
  if (id < 0 || id >= tag_family_size) {
    return bad_input(
        fmt::format("there is no tag {} in tag36h11; ids go from 0 to {}", id, tag_family_size - 1));
  }
  const Family family{tag36h11_create(), &tag36h11_destroy};
  const Picture picture{apriltag_to_image(family.get(), id)};
  TagPattern pattern{};
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const auto x = static_cast<int>(i % tag_cells), y = static_cast<int>(i / tag_cells);
    pattern[i] = picture->buf[y * picture->stride + x] > 127;
  }
  return pattern;
}

}  // namespace outrider
