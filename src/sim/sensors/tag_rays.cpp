#include "sensors/tag_rays.hpp"

#include <algorithm>
#include <limits>

namespace outrider {
namespace {

constexpr double hanging_m = 2e-3;  // a paper this far within its wall is still seen
constexpr float far_grey = 150.0F;
constexpr float floor_grey = 105.0F;
constexpr std::array<float, 3> face_greys{135.0F, 120.0F, 165.0F};  // by the axis that the face looks along

/// True where all of the block lies behind the plane of the paper, so that it cannot hide it.
bool is_behind(const Block& block, const Paper& paper) {
  return std::ranges::all_of(
      corners_of(block), [&](Vec3 corner) { return paper.world_T_paper.to_local(corner).z > -hanging_m; });
}

/// The parameter at which a line enters a box around the origin, infinite if it does not, and the axis along
/// which it enters.
struct BoxEntry {
  double at = std::numeric_limits<double>::infinity();
  std::size_t axis = 0;
};

BoxEntry entry(Vec3 origin, Vec3 along, Vec3 half_size) {
  const std::array<double, 3> o{origin.x, origin.y, origin.z}, h{half_size.x, half_size.y, half_size.z},
      per{1.0 / along.x, 1.0 / along.y, 1.0 / along.z};
  BoxEntry in{0.0, 0};
  double out = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = (-h[k] - o[k]) * per[k], high = (h[k] - o[k]) * per[k];
    if (std::min(low, high) > in.at) in = {std::min(low, high), k};
    out = std::min(out, std::max(low, high));
  }
  return in.at > 0.0 && in.at < out ? in : BoxEntry{};
}

}  // namespace

std::array<Vec3, 8> corners_of(const Block& block) {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 h = block.half_size;
    corners[i] = block.world_T_block *
                 Vec3{(i & 1) != 0 ? h.x : -h.x, (i & 2) != 0 ? h.y : -h.y, (i & 4) != 0 ? h.z : -h.z};
  }
  return corners;
}

std::array<Vec3, 4> corners_of(const Paper& paper) {
  std::array<Vec3, 4> corners = tag_corners(paper.side_m);
  for (Vec3& corner : corners) corner = paper.world_T_paper * corner;
  return corners;
}

std::vector<Block> blocks_of(const World& world) {
  std::vector<Block> blocks;
  for (const Solid& solid : world.solids) {
    if (const auto* box = std::get_if<BoxShape>(&solid.shape)) {
      blocks.push_back({solid.world_T_solid, box->half_size});
      continue;
    }
    if (std::holds_alternative<HalfSpaceShape>(solid.shape) ||
        std::holds_alternative<HeightFieldShape>(solid.shape)) {
      continue;
    }
    const Box3 around = bounds(solid);
    blocks.push_back({{0.5 * (around.low + around.high), {}}, 0.5 * (around.high - around.low)});
  }
  return blocks;
}

std::vector<Paper> papers_of(const TagMap& tags, const TagCameraOptions& options) {
  std::vector<Paper> papers;
  for (const Tag& tag : tags.tags) {
    const auto pattern = tag_pattern(tag.id, tags.family);
    if (!pattern) continue;
    Paper paper{tag.world_T_tag, layout(tags.family).paper_per_size() * tag.size_m, pattern->cells, {}};
    for (const bool white : pattern->white)
      paper.greys.push_back(static_cast<float>(white ? options.white_grey : options.black_grey));
    papers.push_back(std::move(paper));
  }
  return papers;
}

bool hides(const Block& block, Vec3 eye, Vec3 point) {
  const Vec3 from = block.world_T_block.to_local(eye), to = block.world_T_block.to_local(point);
  const double share = hanging_m / norm(to - from);
  return entry(from, to - from, block.half_size).at < 1.0 - share;
}

RayView::Mapped RayView::mapped(const Pose3& world_T_camera, const Pose3& world_T_surface) {
  const auto turned = [&](std::size_t k) {
    return world_T_surface.rotation.unrotate(world_T_camera.rotation.axes[k]);
  };
  return {world_T_surface.to_local(world_T_camera.position), {{turned(0), turned(1), turned(2)}}};
}

RayView::RayView(const Pose3& world_T_camera, const std::vector<Block>& blocks,
                 const std::vector<Paper>& papers, double floor_z_m)
    : height_m_(world_T_camera.position.z - floor_z_m),
      rise_{world_T_camera.rotation.axes[0].z, world_T_camera.rotation.axes[1].z,
            world_T_camera.rotation.axes[2].z} {
  for (const Block& block : blocks) {
    blocks_.push_back({mapped(world_T_camera, block.world_T_block), block.half_size});
  }
  for (const Paper& paper : papers) {
    SeenPaper seen{mapped(world_T_camera, paper.world_T_paper),
                   0.5 * paper.side_m,
                   static_cast<double>(paper.cells) / paper.side_m,
                   paper.cells,
                   &paper.greys,
                   {}};
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (!is_behind(blocks[i], paper)) seen.hiders.push_back(i);
    }
    papers_.push_back(std::move(seen));
  }
}

RayView::OnPaper RayView::paper_met(Vec2 ray) const {
  OnPaper met;
  for (const SeenPaper& paper : papers_) {
    const Vec3 along = paper.map.along(ray);
    if (!(along.z > 0.0)) continue;
    const double at = -paper.map.origin.z / along.z;
    if (!(at > 0.0) || at >= met.at) continue;
    const double x = (paper.map.origin.x + at * along.x + paper.half_side_m) * paper.cells_per_m;
    const double y = (paper.map.origin.y + at * along.y + paper.half_side_m) * paper.cells_per_m;
    const auto cells = static_cast<double>(paper.cells);
    if (!(x >= 0.0 && y >= 0.0 && x < cells && y < cells)) continue;
    const auto cell = static_cast<std::size_t>(y) * paper.cells + static_cast<std::size_t>(x);
    met = {at, (*paper.greys)[cell], &paper};
  }
  return met;
}

float RayView::grey(Vec2 ray) const {
  const OnPaper met = paper_met(ray);
  const double paper_at = met.at - hanging_m;
  const auto enters = [&](const SeenBlock& b) { return entry(b.map.origin, b.map.along(ray), b.half_size); };
  if (met.paper != nullptr && std::ranges::none_of(met.paper->hiders, [&](std::size_t i) {
        return enters(blocks_[i]).at < paper_at;
      })) {
    return met.grey;
  }
  float grey = far_grey;
  double nearest = std::numeric_limits<double>::infinity();
  const double rise = ray.x * rise_.x + ray.y * rise_.y + rise_.z;
  if (rise * height_m_ < 0.0) {
    nearest = -height_m_ / rise;
    grey = floor_grey;
  }
  for (const SeenBlock& block : blocks_) {
    const BoxEntry in = enters(block);
    if (in.at >= nearest) continue;
    nearest = in.at;
    grey = face_greys[in.axis];
  }
  return grey;
}

}  // namespace outrider
