// TagDetector: detects AprilTags of chosen families in grey images, with libapriltag.
//
// Three tests reject false detections: at most `most_corrected_bits` bits are corrected, and no more than the
// family bears (most_corrected_bits() in tag_family.hpp); the contrast is at least `least_margin`; and the
// measured square is wholly within the image. A partly hidden tag is not detected. If an id appears several
// times, all detections are returned; if one square reads as tags of two families, that which random bits
// are less likely to be.
//
// An image with fewer than `few` tags is searched again, enlarged twice, where tags of half the size are
// found, and with edges sought at half the resolution, where tags are found in blur and noise.
//
// Thread rule: use each detector from one thread. The same image gives the same answer.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/estimate/camera_image.hpp"
#include "outrider/estimate/tag.hpp"
#include "outrider/estimate/tag_family.hpp"

namespace outrider {

struct TagDetectorOptions {
  std::vector<TagFamily> families{TagFamily::tag36h11};
  double decimation = 1.0;    ///< factor by which the image is reduced to find edges; 1: most accurate
  bool refine_edges = false;  ///< snap edges to the strongest gradient; needed with decimation
  double blur_px = 0.0;       ///< standard deviation of a blur before the search, for noisy images
  std::int64_t most_corrected_bits = 2;  ///< maximum number of corrected bits, 0 to 2
  double least_margin = 20.0;            ///< minimum contrast, grey levels
  std::int64_t few = 0;                  ///< search at other scales too if fewer tags are found; 0: never
};

std::vector<Option> describe(TagDetectorOptions& options);

class TagDetector {
 public:
  explicit TagDetector(const TagDetectorOptions& options = {});
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;
  ~TagDetector();

  /// Detects tags. Returns ids and corners, without poses, sorted by family, id and corner. O(pixels).
  [[nodiscard]] std::vector<TagSighting> detect(const CameraImage& image);
  /// Detects tags in boxes of the image only. The boxes should not overlap.
  [[nodiscard]] std::vector<TagSighting> detect(const CameraImage& image, std::span<const PixelBox> boxes);

 private:
  struct Library;
  TagDetectorOptions options_;
  std::unique_ptr<Library> library_;
};

}  // namespace outrider
