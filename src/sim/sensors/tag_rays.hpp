// Finds what a camera's rays meet: the papers of tags, the boxes of the world, its floor.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "outrider/sim/sensors/tag_camera.hpp"

namespace outrider {

/// A box of the world, exact; or the box around another solid.
struct Block {
  Pose3 world_T_block;
  Vec3 half_size;
};

/// The paper of a tag with the greys of its cells.
struct Paper {
  Pose3 world_T_paper;
  double side_m = 0.0;
  std::size_t cells = 0;     ///< along a side
  std::vector<float> greys;  ///< of the cells, row by row from the top
};

std::array<Vec3, 8> corners_of(const Block& block);
std::array<Vec3, 4> corners_of(const Paper& paper);

std::vector<Block> blocks_of(const World& world);
std::vector<Paper> papers_of(const TagMap& tags, const TagCameraOptions& options);

/// True where the block stands between `eye` and `point`.
bool hides(const Block& block, Vec3 eye, Vec3 point);

/// Surfaces in the frame of a camera at one place: each maps a ray (x, y, 1) to itself by a matrix. The
/// papers must outlive the view.
class RayView {
 public:
  RayView(const Pose3& world_T_camera, const std::vector<Block>& blocks, const std::vector<Paper>& papers,
          double floor_z_m);
  /// The grey of what the ray meets first; a paper lies before its wall. O(surfaces).
  [[nodiscard]] float grey(Vec2 ray) const;

 private:
  struct Mapped {
    Vec3 origin;    ///< of the rays, in the frame of the surface
    Rotation turn;  ///< from the camera's axes to those of the surface

    [[nodiscard]] Vec3 along(Vec2 ray) const {
      return ray.x * turn.axes[0] + ray.y * turn.axes[1] + turn.axes[2];
    }
  };
  struct SeenBlock {
    Mapped map;
    Vec3 half_size;
  };
  struct SeenPaper {
    Mapped map;
    double half_side_m = 0.0;
    double cells_per_m = 0.0;
    std::size_t cells = 0;
    const std::vector<float>* greys = nullptr;
    std::vector<std::size_t> hiders;  ///< blocks that are not wholly behind it
  };
  struct OnPaper {
    double at = std::numeric_limits<double>::infinity();
    float grey = 0.0F;
    const SeenPaper* paper = nullptr;
  };
  [[nodiscard]] OnPaper paper_met(Vec2 ray) const;
  static Mapped mapped(const Pose3& world_T_camera, const Pose3& world_T_surface);

  std::vector<SeenBlock> blocks_;
  std::vector<SeenPaper> papers_;
  double height_m_ = 0.0;  // of the camera above the floor
  Vec3 rise_;              // of the camera's axes
};

}  // namespace outrider
