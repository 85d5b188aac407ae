#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

#include "sensors/tag_rays.hpp"

namespace outrider {
namespace {

constexpr std::uint8_t unrendered_grey = 128;
constexpr double least_cell_px = 2.0;  // smaller cells could hide between the corners of a pixel

Vec3 between(Vec3 a, Vec3 b, double share) { return (1.0 - share) * a + share * b; }

/// The camera's pose part of the way. The axes are blended: exposures turn by a few degrees at most.
Pose3 between(const Pose3& a, const Pose3& b, double share) {
  const auto unit = [](Vec3 v) { return (1.0 / norm(v)) * v; };
  const Vec3 z = unit(between(a.rotation.axes[2], b.rotation.axes[2], share));
  const Vec3 blended = between(a.rotation.axes[0], b.rotation.axes[0], share);
  const Vec3 x = unit(blended - dot(blended, z) * z);
  return {between(a.position, b.position, share), {{x, cross(z, x), z}}};
}

/// Mean 0, variance 1 and the kurtosis 2.7: four uniform numbers out of one draw.
double nearly_normal(Rng& rng) {
  const std::uint64_t bits = rng.bits();
  std::uint64_t sum = 0;
  for (int i = 0; i < 4; ++i) sum += bits >> (16 * i) & 0xFFFF;
  constexpr double mean = 2.0 * 0xFFFF;
  constexpr double per_sigma = 1.7320508075688772 / 0x10000;  // each has variance 2^32 / 12
  return (static_cast<double>(sum) - mean) * per_sigma;
}

/// The rays through the corners of one row of pixels and of the next.
class CornerRays {
 public:
  CornerRays(const Camera& camera, const PixelBox& box) : camera_(camera), box_(box) { row(box.top, lower_); }
  void enter(int y) {
    upper_.swap(lower_);
    row(y + 1, lower_);
  }
  /// Returns the ray through (u, v) of the unit square that is pixel x of this row.
  [[nodiscard]] Vec2 at(std::size_t x, double u, double v) const {
    const Vec2 above = upper_[x] + u * (upper_[x + 1] - upper_[x]);
    const Vec2 below = lower_[x] + u * (lower_[x + 1] - lower_[x]);
    return above + v * (below - above);
  }
  [[nodiscard]] const std::vector<Vec2>& lower() const { return lower_; }

 private:
  void row(int y, std::vector<Vec2>& rays) const {
    rays.clear();
    for (int x = box_.left; x <= box_.right; ++x) {
      rays.push_back(ray_through(camera_, {static_cast<double>(x), static_cast<double>(y)}));
    }
  }

  const Camera& camera_;
  PixelBox box_;
  std::vector<Vec2> upper_, lower_;
};

/// Renders one box. A pixel whose corners all show one grey, when the shutter opens and when it closes, has
/// that grey; any other is the mean of samples, each at a time of its own.
class BoxRenderer {
 public:
  BoxRenderer(const Camera& camera, std::vector<RayView> views, std::size_t samples, bool everywhere)
      : camera_(camera), views_(std::move(views)), samples_(samples), everywhere_(everywhere) {}

  void render(const PixelBox& box, double noise_grey, Rng& rng, CameraImage& image) {
    CornerRays rays(camera_, box);
    std::vector<float> opening_above, opening, closing_above, closing;
    greys(rays, views_.front(), opening);
    greys(rays, views_.back(), closing);
    for (int y = box.top; y < box.bottom; ++y) {
      rays.enter(y);
      opening_above.swap(opening);
      closing_above.swap(closing);
      greys(rays, views_.front(), opening);
      greys(rays, views_.back(), closing);
      for (std::size_t x = 0; x + 1 < opening.size(); ++x) {
        const float first = opening[x];
        const bool plain = !everywhere_ && first == opening[x + 1] && first == opening_above[x] &&
                           first == opening_above[x + 1] && first == closing[x] && first == closing[x + 1] &&
                           first == closing_above[x] && first == closing_above[x + 1];
        const double grey =
            (plain ? static_cast<double>(first) : mean(rays, x)) + noise_grey * nearly_normal(rng);
        image.at(box.left + static_cast<int>(x), y) =
            static_cast<std::uint8_t>(std::clamp(std::floor(grey + 0.5), 0.0, 255.0));
      }
    }
  }

 private:
  static void greys(const CornerRays& rays, const RayView& view, std::vector<float>& row) {
    row.clear();
    for (const Vec2 ray : rays.lower()) row.push_back(view.grey(ray));
  }
  [[nodiscard]] double mean(const CornerRays& rays, std::size_t x) const {
    double sum = 0.0;
    const double step = 1.0 / static_cast<double>(samples_);
    for (std::size_t i = 0; i < samples_ * samples_; ++i) {
      // Row a, column b, and a time that no other sample of the row, the column or the pixel has.
      const std::size_t a = i / samples_, b = i % samples_;
      const std::size_t time = ((a + b) % samples_) * samples_ + a;
      const double u = (static_cast<double>(b) + 0.5) * step, v = (static_cast<double>(a) + 0.5) * step;
      sum += static_cast<double>(views_[time].grey(rays.at(x, u, v)));
    }
    return sum / static_cast<double>(samples_ * samples_);
  }

  const Camera& camera_;
  std::vector<RayView> views_;  // by time
  std::size_t samples_;
  bool everywhere_;
};

/// Returns the pixels at which the corners of the paper appear; nothing if one is not in front of the camera.
std::optional<std::array<Vec2, 4>> outline(const Camera& camera, const Pose3& world_T_camera,
                                           const Paper& paper) {
  std::array<Vec2, 4> corners;
  const auto points = tag_corners(paper.side_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto seen = project(camera, world_T_camera.to_local(paper.world_T_paper * points[i]));
    if (!seen) return std::nullopt;
    corners[i] = *seen;
  }
  return corners;
}

/// True where a cell of the paper could come and go between the corners of a pixel: it appears too small, or
/// moves by more than itself while the shutter is open.
bool is_fine(const Camera& camera, const Pose3& opening, const Pose3& closing, const Paper& paper) {
  const auto first = outline(camera, opening, paper), last = outline(camera, closing, paper);
  if (!first || !last) return true;
  double side_px = std::numeric_limits<double>::infinity(), moved_px = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    side_px = std::min(side_px, distance((*first)[i], (*first)[(i + 1) % 4]));
    moved_px = std::max(moved_px, distance((*first)[i], (*last)[i]));
  }
  return side_px < (least_cell_px + moved_px) * static_cast<double>(paper.cells);
}

/// True where all of a convex hull lies beyond one side of the box of pixels, or behind the camera.
bool is_outside(std::span<const Vec3> hull, const Pose3& world_T_camera, const Camera& camera,
                const PixelBox& box) {
  const auto edge = [](int pixel) { return static_cast<double>(pixel); };
  const std::array<Vec2, 4> rays{ray_through(camera, {edge(box.left), edge(box.top)}),
                                 ray_through(camera, {edge(box.right), edge(box.top)}),
                                 ray_through(camera, {edge(box.right), edge(box.bottom)}),
                                 ray_through(camera, {edge(box.left), edge(box.bottom)})};
  const auto all = [&](const auto& beyond) {
    return std::ranges::all_of(hull, [&](Vec3 p) { return beyond(world_T_camera.to_local(p)); });
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = rays[i], b = rays[(i + 1) % 4];
    const Vec3 inward = cross(Vec3{a.x, a.y, 1}, Vec3{b.x, b.y, 1});
    if (all([&](Vec3 p) { return dot(inward, p) < 0.0; })) return true;
  }
  return all([](Vec3 p) { return p.z <= 0.0; });
}

}  // namespace

RenderedImage render_tags(const Camera& camera, const TagScene& scene, const Pose3& world_T_opening,
                          const Pose3& world_T_closing, const std::vector<PixelBox>& boxes,
                          const TagCameraOptions& options, Rng noise) {
  const std::vector<Block> blocks = blocks_of(scene.world);
  const std::vector<Paper> papers = papers_of(scene.tags, options);
  RenderedImage result;
  result.image.width = camera.width_px;
  result.image.height = camera.height_px;
  result.image.values.assign(
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px),
      unrendered_grey);
  result.boxes = boxes;
  const auto samples = static_cast<std::size_t>(options.samples);
  for (const PixelBox& box : boxes) {
    const auto in_box = [&](const auto& surface) {
      const auto hull = corners_of(surface);
      return !is_outside(hull, world_T_opening, camera, box) ||
             !is_outside(hull, world_T_closing, camera, box);
    };
    std::vector<Block> near_blocks;
    std::vector<Paper> near_papers;
    std::ranges::copy_if(blocks, std::back_inserter(near_blocks), in_box);
    std::ranges::copy_if(papers, std::back_inserter(near_papers), in_box);
    const bool fine = std::ranges::any_of(
        near_papers, [&](const Paper& p) { return is_fine(camera, world_T_opening, world_T_closing, p); });
    std::vector<RayView> views;
    for (std::size_t i = 0; i < samples * samples; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(samples * samples);
      views.emplace_back(between(world_T_opening, world_T_closing, share), near_blocks, near_papers,
                         scene.world.floor_z_m);
    }
    BoxRenderer(camera, std::move(views), samples, fine).render(box, options.noise_grey, noise, result.image);
  }
  return result;
}

}  // namespace outrider
