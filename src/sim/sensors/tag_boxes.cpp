#include <algorithm>
#include <cmath>
#include <optional>

#include "sensors/tag_rays.hpp"

namespace outrider {
namespace {

constexpr double wall_share = 0.175;  // of the tag's side, around its paper
constexpr double least_margin_px = 8.0;

/// The box around the tag's paper in the image; nothing when it shows its back, is not wholly within the
/// image, is too small to be read, or is hidden by one block, which then hides all of it: both are convex.
std::optional<Box2> outline(const Camera& camera, const Pose3& world_T_camera, const Tag& tag,
                            const std::vector<Block>& blocks, double least_px) {
  const Vec3 into_wall = tag.world_T_tag.rotation.axes[2];
  if (dot(into_wall, tag.world_T_tag.position - world_T_camera.position) <= 0.0) return std::nullopt;
  std::array<Vec3, 4> corners = tag_corners(tag.size_m);
  for (Vec3& corner : corners) corner = tag.world_T_tag * corner;
  std::array<Vec2, 4> seen;
  Box2 box;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto p = project(camera, world_T_camera.to_local(corners[i]));
    if (!p || p->x < 0.0 || p->y < 0.0 || p->x > camera.width_px || p->y > camera.height_px) {
      return std::nullopt;
    }
    seen[i] = *p;
    box.include(*p);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (distance(seen[i], seen[(i + 1) % 4]) < least_px) return std::nullopt;
  }
  const bool hidden = std::ranges::any_of(blocks, [&](const Block& block) {
    return std::ranges::all_of(corners, [&](Vec3 p) { return hides(block, world_T_camera.position, p); });
  });
  if (hidden) return std::nullopt;
  return box;
}

PixelBox around(const Box2& box, const Camera& camera, const TagLayout& family) {
  const double share = wall_share + 0.5 * (family.paper_per_size() - 1.0);
  const double margin = std::max(least_margin_px, share * std::max(box.size().x, box.size().y));
  const auto pixel = [](double at, int most) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, static_cast<double>(most)));
  };
  const Box2 grown = box.grown(margin);
  return {pixel(grown.low.x, camera.width_px), pixel(grown.low.y, camera.height_px),
          pixel(grown.high.x + 1.0, camera.width_px), pixel(grown.high.y + 1.0, camera.height_px)};
}

bool overlap(const PixelBox& a, const PixelBox& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// Adds a box to those that do not overlap, as one with all that it touches.
void add(std::vector<PixelBox>& boxes, PixelBox box) {
  for (std::size_t i = 0; i < boxes.size();) {
    if (!overlap(boxes[i], box)) {
      ++i;
      continue;
    }
    box = {std::min(box.left, boxes[i].left), std::min(box.top, boxes[i].top),
           std::max(box.right, boxes[i].right), std::max(box.bottom, boxes[i].bottom)};
    boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;  // it has grown
  }
  boxes.push_back(box);
}

}  // namespace

std::vector<PixelBox> tag_boxes(const Camera& camera, const TagScene& scene, const Pose3& world_T_opening,
                                const Pose3& world_T_closing, const TagCameraOptions& options) {
  const std::vector<Block> blocks = blocks_of(scene.world);
  std::vector<PixelBox> boxes;
  for (const Tag& tag : scene.tags.tags) {
    auto box = outline(camera, world_T_opening, tag, blocks, options.least_tag_px);
    if (const auto later = outline(camera, world_T_closing, tag, blocks, options.least_tag_px)) {
      if (!box) box = later;
      box->include(later->low);
      box->include(later->high);
    }
    if (!box) continue;
    const PixelBox pixels = around(*box, camera, layout(scene.tags.family));
    if (!pixels.empty()) add(boxes, pixels);
  }
  return boxes;
}

}  // namespace outrider
