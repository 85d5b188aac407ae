// A bar at many poses of a drive, asked point by point: a twin of what a bar covers that shares nothing with
// the library.
#pragma once

#include <cmath>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/ground/coverage.hpp"

namespace outrider::testing {

/// The bar stands at many poses along the same motions, no
/// farther apart than a small step of its corners, and points are asked one by one.
class DenseBar {
 public:
  DenseBar(const std::vector<Pose2>& poses, const Bar& bar, double step_m) : bar_(bar) {
    const double reach = std::hypot(std::abs(bar.forward_m) + 0.5 * bar.length_m, 0.5 * bar.width_m);
    all_.push_back(poses.front());
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const Pose2 &a = poses[i - 1], &b = poses[i];
      const double turn = b.heading_rad - a.heading_rad, way = distance(a.position, b.position);
      const int steps = 1 + static_cast<int>((2.0 * way + std::abs(turn) * reach) / step_m);
      // The heading of a robot that drives a circle from a to b is off from the chord by half the turn.
      for (int k = 1; k <= steps; ++k) {
        const double part = static_cast<double>(k) / steps, angle = part * turn;
        Vec2 at = a.position + part * (b.position - a.position);
        if (std::abs(turn) > 1e-12 && way > 0.0) {
          const double radius = way / (2.0 * std::sin(0.5 * turn)),
                       chord = 2.0 * radius * std::sin(0.5 * angle);
          const double to = heading_of(b.position - a.position) - 0.5 * turn + 0.5 * angle;
          at = a.position + chord * direction(to);
        }
        all_.push_back({at, a.heading_rad + angle});
      }
    }
  }

  /// How often the bar, larger by `more_m` on all sides, comes over the point.
  [[nodiscard]] int passes_over(Vec2 p, double more_m = 0.0) const {
    int passes = 0;
    bool over = false;
    for (const Pose2& pose : all_) {
      const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
      const Vec2 d = p - pose.position;
      const double ahead = c * d.x + s * d.y - bar_.forward_m, aside = c * d.y - s * d.x;
      const bool now =
          std::abs(ahead) <= 0.5 * bar_.length_m + more_m && std::abs(aside) <= 0.5 * bar_.width_m + more_m;
      if (now && !over) ++passes;
      over = now;
    }
    return passes;
  }

  [[nodiscard]] const std::vector<Pose2>& poses() const { return all_; }

 private:
  Bar bar_;
  std::vector<Pose2> all_;
};

inline Bar random_bar(Rng& rng) {
  return {rng.uniform(0.2, 1.6), rng.uniform(0.05, 0.5), rng.uniform(-0.6, 0.6)};
}

}  // namespace outrider::testing
