// TagDetector: tags of the family tag36h11 in grey images, by libapriltag.
//
// False detections are rejected by three tests: at most `most_corrected_bits` of 36 bits corrected (any two
// codes differ in 11), a contrast of at least `least_margin`, and a black square wholly within the image. A
// partly hidden tag is not detected. If an id appears several times, all detections are returned. Thread
// rule: one detector per thread; the same image gives the same answer.
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
  double decimation = 1.0;    ///< factor by which the image is reduced to find edges; 1 is most exact
  bool refine_edges = false;  ///< snaps edges to the strongest gradient; needed with decimation
  double blur_px = 0.0;       ///< standard deviation of a blur before the search, for noisy images
  std::int64_t most_corrected_bits = 2;  ///< 0 to 2
  double least_margin = 20.0;            ///< grey levels
};

std::vector<Option> describe(TagDetectorOptions& options);

class TagDetector {
 public:
  explicit TagDetector(const TagDetectorOptions& options = {});
  TagDetector(TagDetector&&) noexcept;
  TagDetector& operator=(TagDetector&&) noexcept;
  ~TagDetector();

  /// Returns ids and corners, without poses, sorted by id and then by corner. Linear in the pixels.
  [[nodiscard]] std::vector<TagSighting> detect(const CameraImage& image);
  /// The same, looking only into these boxes of the image, which should not overlap.
  [[nodiscard]] std::vector<TagSighting> detect(const CameraImage& image, std::span<const PixelBox> boxes);

 private:
  struct Library;
  TagDetectorOptions options_;
  std::unique_ptr<Library> library_;
};

inline constexpr std::size_t tag_cells = 10;  ///< along each side of a tag on its paper
/// The white cells on the paper of a tag, row by row from the top.
using TagPattern = std::array<bool, tag_cells * tag_cells>;

/// Refuses an id outside the family.
Outcome<TagPattern> tag_pattern(int id);

}  // namespace outrider
