#include "outrider/estimate/tag_detector.hpp"

#include <algorithm>
#include <tuple>

#include "tag_library.hpp"

namespace outrider {
namespace {

using Finder = std::unique_ptr<apriltag_detector_t, decltype(&apriltag_detector_destroy)>;
using Findings = std::unique_ptr<zarray_t, decltype(&apriltag_detections_destroy)>;

constexpr int least_side_px = 16;  // a tag has at least 8 cells on each side

bool within(Vec2 p, const CameraImage& image) {
  return p.x >= 0.0 && p.y >= 0.0 && p.x <= image.width && p.y <= image.height;
}

PixelBox clipped(const PixelBox& box, const CameraImage& image) {
  return {std::max(box.left, 0), std::max(box.top, 0), std::min(box.right, image.width),
          std::min(box.bottom, image.height)};
}

/// Returns the pixels of a box.
CameraImage cut(const CameraImage& image, const PixelBox& box) {
  CameraImage part{box.right - box.left, box.bottom - box.top, {}};
  part.values.reserve(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
  for (int y = box.top; y < box.bottom; ++y) {
    const auto row = image.values.begin() + static_cast<std::ptrdiff_t>(image.index(box.left, y));
    part.values.insert(part.values.end(), row, row + part.width);
  }
  return part;
}

/// Returns the image with twice as many pixels along each side, interpolated linearly.
CameraImage enlarged(const CameraImage& image) {
  CameraImage twice{2 * image.width, 2 * image.height, {}};
  twice.values.reserve(4 * image.values.size());
  for (int y = 0; y < twice.height; ++y) {
    const int near_y = y / 2, far_y = std::clamp(near_y + (y % 2 == 0 ? -1 : 1), 0, image.height - 1);
    for (int x = 0; x < twice.width; ++x) {
      const int near_x = x / 2, far_x = std::clamp(near_x + (x % 2 == 0 ? -1 : 1), 0, image.width - 1);
      const int sum = 9 * image.at(near_x, near_y) + 3 * image.at(far_x, near_y) +
                      3 * image.at(near_x, far_y) + image.at(far_x, far_y);
      twice.values.push_back(static_cast<std::uint8_t>((sum + 8) / 16));
    }
  }
  return twice;
}

double side_px(const TagSighting& tag) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) sum += 0.25 * distance(tag.corners_px[i], tag.corners_px[(i + 1) % 4]);
  return sum;
}

Vec2 centre_px(const TagSighting& tag) {
  Vec2 sum;
  for (const Vec2 corner : tag.corners_px) sum = sum + 0.25 * corner;
  return sum;
}

bool is_one_square(const TagSighting& a, const TagSighting& b) {
  const double small = std::min(side_px(a), side_px(b)), large = std::max(side_px(a), side_px(b));
  return large < 1.25 * small && distance(centre_px(a), centre_px(b)) < 0.25 * small;
}

double chance(const TagSighting& tag) {
  return chance_of_random_bits(layout(tag.family), tag.corrected_bits);
}

/// Adds a tag, or has it replace one at the same place that random bits are more likely to be.
void add(std::vector<TagSighting>& sightings, TagSighting tag) {
  const auto there =
      std::ranges::find_if(sightings, [&](const TagSighting& other) { return is_one_square(tag, other); });
  if (there == sightings.end()) {
    sightings.push_back(std::move(tag));
  } else if ((there->id != tag.id || there->family != tag.family) && chance(tag) < chance(*there)) {
    *there = std::move(tag);
  }
}

}  // namespace

/// The detector of libapriltag with its families.
struct TagDetector::Library {
  std::vector<std::pair<TagFamily, TagLibraryFamily>> families;
  Finder finder{apriltag_detector_create(), &apriltag_detector_destroy};

  /// Reads the tags of an image of which each pixel is `scale` of a pixel of the whole image, and which
  /// begins at `origin` there.
  void read(const CameraImage& image, Vec2 origin, double scale, std::vector<TagSighting>& found) {
    // The library takes a non-const image, but does not change it.
    auto* pixels = const_cast<std::uint8_t*>(image.values.data());
    image_u8_t picture{image.width, image.height, image.width, pixels};
    const Findings findings{apriltag_detector_detect(finder.get(), &picture), &apriltag_detections_destroy};
    for (int i = 0; i < zarray_size(findings.get()); ++i) {
      apriltag_detection_t* tag = nullptr;
      zarray_get(findings.get(), i, &tag);
      const auto family = std::ranges::find_if(
          families, [&](const auto& owned) { return owned.second.get() == tag->family; });
      TagSighting sighting{tag->id, {},           tag->hamming, static_cast<double>(tag->decision_margin),
                           {},      family->first};
      for (std::size_t c = 0; c < 4; ++c)
        sighting.corners_px[c] = origin + scale * Vec2{tag->p[c][0], tag->p[c][1]};
      found.push_back(std::move(sighting));
    }
  }
};

std::vector<Option> describe(TagDetectorOptions& options) {
  return {
      {"decimation", "", 1, 8, "seek edges in an image this much coarser; 1 is most exact",
       &options.decimation},
      {"refine_edges", "", 0, 0, "snap edges to the strongest gradient; needed with decimation",
       &options.refine_edges},
      {"blur", "px", 0, 10, "standard deviation of a blur before the search, for noisy images",
       &options.blur_px},
      {"most_corrected_bits", "", 0, 2,
       "bits that may be mended in a tag; fewer where its family bears fewer", &options.most_corrected_bits},
      {"least_margin", "", 0, 255, "least contrast of a tag's bits, in grey levels", &options.least_margin},
      {"few", "", 0, 1000, "seek at other scales too if fewer tags are found; 0: never", &options.few}};
}

TagDetector::TagDetector(const TagDetectorOptions& options)
    : options_(options), library_(std::make_unique<Library>()) {
  apriltag_detector_t& finder = *library_->finder;
  for (const TagFamily family : options.families) {
    const auto& owned = library_->families.emplace_back(family, make_family(family));
    const int bits =
        std::min(static_cast<int>(options.most_corrected_bits), most_corrected_bits(layout(family)));
    apriltag_detector_add_family_bits(&finder, owned.second.get(), bits);
  }
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
  const auto search = [&](bool enlarge) {
    std::vector<TagSighting> found;
    for (const PixelBox& wanted : boxes) {
      const PixelBox box = clipped(wanted, image);
      if (box.right - box.left < least_side_px || box.bottom - box.top < least_side_px) continue;
      const CameraImage part = cut(image, box);
      const Vec2 origin{static_cast<double>(box.left), static_cast<double>(box.top)};
      library_->read(enlarge ? enlarged(part) : part, origin, enlarge ? 0.5 : 1.0, found);
    }
    for (TagSighting& tag : found) {
      const bool whole = std::ranges::all_of(tag.corners_px, [&](Vec2 p) { return within(p, image); });
      if (whole && tag.margin >= options_.least_margin) add(sightings, std::move(tag));
    }
  };
  search(false);
  if (static_cast<std::int64_t>(sightings.size()) < options_.few) {
    search(true);
    apriltag_detector_t& finder = *library_->finder;
    finder.quad_decimate = 2.0F * finder.quad_decimate;
    finder.refine_edges = true;
    search(false);
    finder.quad_decimate = static_cast<float>(options_.decimation);
    finder.refine_edges = options_.refine_edges;
  }
  std::ranges::sort(sightings, {}, [](const TagSighting& s) {
    return std::tuple(s.family, s.id, s.corners_px[0].x, s.corners_px[0].y);
  });
  return sightings;
}

}  // namespace outrider
