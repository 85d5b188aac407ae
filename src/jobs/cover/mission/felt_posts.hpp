// FeltPosts: what stands in the way of the robot and is not on its map, by what its bumper feels.
//
// Each thing is taken for round. After one contact its radius is a guess; the disk that touches the robot at
// the first contact and passes through a later one has the radius
//     d^2 / (2 d n),  d from the first contact to the later one, n the direction of the first.
// Two contacts are therefore enough for a round post. A contact that lies on no such disk belongs to another
// thing.
#pragma once

#include <memory>
#include <vector>

#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider::cover {

struct FeltPost {
  Vec2 contact;  ///< first contact
  Vec2 towards;  ///< unit vector from the robot to the post there
  double radius_m;
  double margin_m;  ///< that the robot keeps from it
  bool stands;      ///< it was felt again after a while

  [[nodiscard]] Vec2 centre() const { return contact + radius_m * towards; }
};

class FeltPosts {
 public:
  /// The robot is a disk of that radius and keeps `margin_m` from what it has felt.
  FeltPosts(double robot_radius_m, double margin_m) : robot_m_(robot_radius_m), margin_m_(margin_m) {}

  /// Takes in a contact. A post that is felt again stands there for good; if that is no news about its size,
  /// the robot keeps twice as far from it. Returns it.
  FeltPost& touch(Vec2 contact, Vec2 towards);
  void forget() { posts_.clear(); }

  [[nodiscard]] const std::vector<FeltPost>& all() const { return posts_; }
  /// Returns the distance that the robot's centre keeps from that of the post.
  [[nodiscard]] double keep_m(const FeltPost& post) const;
  /// Returns the ground without what stands there. Fault: that of PolygonGround.
  [[nodiscard]] Outcome<std::shared_ptr<const PolygonGround>> without_posts(
      std::shared_ptr<const PolygonGround> ground) const;

 private:
  double robot_m_;
  double margin_m_;
  std::vector<FeltPost> posts_;
};

}  // namespace outrider::cover
