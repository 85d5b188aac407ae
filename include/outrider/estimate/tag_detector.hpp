// TagDetector: detects tags of the family tag36h11 in grey images, with libapriltag.
//
// Three tests reject false detections: at most `most_corrected_bits` of the 36 bits are corrected (any two
// codes differ in at least 11), the contrast is at least `least_margin`, and the black square is wholly
// within the image. A partly hidden tag is not detected. If an id appears several times, all detections are
// returned. Thread rule: use each detector from one thread. The same image gives the same answer.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/estimate/camera_image.hpp"
#include "outrider/estimate/tag.hpp"

namespace outrider {

struct TagDetectorOptions {
  double decimation = 1.0;    ///< factor by which the image is reduced to find edges; 1: most accurate
  bool refine_edges = false;  ///< snap edges to the strongest gradient; needed with decimation
  double blur_px = 0.0;       ///< standard deviation of a blur before the search, for noisy images
  std::int64_t most_corrected_bits = 2;  ///< maximum number of corrected bits, 0 to 2
  double least_margin = 20.0;            ///< minimum contrast, grey levels
};

std::vector<Option> describe(TagDetectorOptions& options);

class TagDetector {
 public:
  explicit TagDetector(const TagDetectorOptions& options = {});
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;
  ~TagDetector();

  /// Detects tags. Returns ids and corners, without poses, sorted by id and then by corner. O(pixels).
  [[nodiscard]] std::vector<TagSighting> detect(const CameraImage& image);
  /// Detects tags in boxes of the image only. The boxes should not overlap.
  [[nodiscard]] std::vector<TagSighting> detect(const CameraImage& image, std::span<const PixelBox> boxes);

 private:
  struct Library;
  TagDetectorOptions options_;
  std::unique_ptr<Library> library_;
};

inline constexpr std::size_t tag_cells = 10;  ///< number of cells along each side of the paper of a tag
/// Tells for each cell of the paper of a tag, row by row from the top, if it is white.
using TagPattern = std::array<bool, tag_cells * tag_cells>;

/// Returns the pattern of a tag. Fault: bad_input for an id outside the family.
Outcome<TagPattern> tag_pattern(int id);

}  // namespace outrider
