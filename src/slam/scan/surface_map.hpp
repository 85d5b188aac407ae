// SurfaceMap: a local map of the surfaces in a few scans, used to match another scan.
//
// It has two representations. The likelihood field is a grid of the closeness to the nearest surface, 255 on
// a surface and 0 from 15 cm on, with a pyramid of maxima that provides the bounds of the search. The lines
// are for the refinement: the surface around a point is the weighted mean of the lines through the map points
// nearby that face the same way.
//
// find() is branch and bound over place and heading. It is complete within its window at a resolution of one
// cell, and of the rotation that moves the farthest point by one cell. It gives up on a window in
// which it would visit too many blocks of poses. refine() is Gauss-Newton on the distances to the lines,
// with a robust weight. Thread rule: const members may be called concurrently.
// Sources: Olson, M3RSM: many-to-many multi-resolution scan matching, ICRA 2015, 5815-5821 (the pyramid);
// Hess, Kohler, Rapp and Andor, Real-time loop closure in 2D LIDAR SLAM, ICRA 2016, 1271-1278 (the search);
// Censi, An ICP variant using a point-to-line metric, ICRA 2008, 19-25; Kolluri, Provably good moving least
// squares, ACM Trans. Algorithms 4 (2008) 18 (the surface).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "outrider/geometry/pose.hpp"
#include "outrider/world/grid.hpp"
#include "scan/surface.hpp"

namespace outrider {

/// A normal prior of a pose in the world.
struct PosePrior {
  Pose2 mean;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< information of x, y, heading; zero: no prior
};

/// The poses to search: a square of half side `reach_m` about the centre, rotated by up to `turn_rad`.
struct MatchWindow {
  Pose2 centre;
  double reach_m = 0.0;
  double turn_rad = 0.0;
  double position_sd_m = 1e9;  ///< of the prior: poses away from the centre score less
  double heading_sd_rad = 1e9;
  std::int64_t most_blocks = 4'000'000;  ///< of poses to be visited; about a second of work
};

/// Two poses are distinct if they differ by more than one of these.
struct Separation {
  double position_m = 0.0;
  double heading_rad = 0.0;
};

struct FoundPose {
  Pose2 pose;
  double score = 0.0;  ///< mean of the field, 0 to 1, less the cost
};

struct Fit {
  Pose2 pose;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< information of the points without the prior
  double share = 0.0;                                     ///< fraction of the points that lie on a surface
  double rms_m = 0.0;                                     ///< root mean square distance of these points

  /// Returns the factor that makes the information, which has the same noise for every scan, that of the
  /// noise of this one: three times rms_m, because neighbouring points err together, from 3.5 to 9 cm.
  [[nodiscard]] double certainty() const;
};

/// The gradient of the robust sum of squares that refine() minimises, at a pose and for fixed lines, and the
/// Gauss-Newton approximation of its second derivative.
struct MatchEquations {
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double cost = 0.0;
  std::size_t on_surface = 0;
  double squares = 0.0;
};

class SurfaceMap {
 public:
  struct Part {
    const Surface* surface = nullptr;
    Pose2 pose;     ///< world_T_surface
    int group = 0;  ///< refine() can be restricted to one group
  };
  static constexpr int all_groups = -1;

  static constexpr int few_levels = 5;

  /// `levels` is the height of the pyramid: a map that is searched whole needs more of them.
  explicit SurfaceMap(std::span<const Part> parts, int levels = few_levels);

  /// Returns the pose with the highest score above `least`; nothing if there is none, or if the window has
  /// too many poses to search.
  [[nodiscard]] std::optional<FoundPose> find(const Surface& surface, const MatchWindow& window,
                                              double least) const;
  /// Returns true if some pose distinct from `except` scores above `least`, or if the window has too many
  /// poses to decide.
  [[nodiscard]] bool may_be_elsewhere(const Surface& surface, const MatchWindow& window, double least,
                                      const Pose2& except, const Separation& distinct) const;
  [[nodiscard]] Fit refine(const Surface& surface, const Pose2& start, const PosePrior& prior,
                           int group = all_groups) const;
  [[nodiscard]] MatchEquations equations(const Surface& surface, const Pose2& pose,
                                         int group = all_groups) const;

 private:
  struct Element {
    Vec2 position;
    Vec2 normal;
    double count = 0.0;  ///< of the points that it was made of; 8 at most once the map is built
    int group = 0;
    std::int32_t next = -1;  ///< in its bucket, while the map is built
  };
  struct Line {
    Vec2 normal;
    double distance_m = 0.0;
  };

  void add(const SurfacePoint& point, int group);
  void splat(Vec2 position);
  void build_pyramid(int levels);
  void sort_elements();
  [[nodiscard]] std::optional<Line> line_at(Vec2 position, Vec2 normal, int group) const;

  std::vector<Grid<std::uint8_t>> levels_;  ///< of the pyramid of the field; see build_pyramid()
  GridFrame bucket_frame_;
  std::vector<std::int32_t> first_;  ///< element, by bucket; of the last bucket also the end
  std::vector<Element> elements_;    ///< bucket by bucket
};

}  // namespace outrider
