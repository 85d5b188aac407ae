#include "mission/felt_posts.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

constexpr double first_guess = 0.25;   // of the robot's radius: the radius of what it has touched once
constexpr double most_radii = 100.0;   // a larger disk is none
constexpr double same_contact = 0.05;  // of the robot's radius, between contacts that tell nothing new
constexpr int post_corners = 24;

/// Returns the radius of the disk through both contacts; 0 if there is none.
double radius_through(const FeltPost& post, Vec2 contact) {
  const Vec2 d = contact - post.contact;
  const double ahead_m = dot(d, post.towards);
  return ahead_m > 0.0 ? squared_norm(d) / (2.0 * ahead_m) : 0.0;
}

/// Returns the radius of the corners of a polygon around the disk.
double corner_radius_m(const FeltPost& post) {
  return (post.radius_m + post.margin_m) / std::cos(pi / post_corners);
}

}  // namespace

FeltPost& FeltPosts::touch(Vec2 contact, Vec2 towards) {
  for (FeltPost& post : posts_) {
    const double through_m = radius_through(post, contact);
    const bool same_place = distance(contact, post.contact) <= same_contact * robot_m_;
    const bool may_be_it = through_m > 0.0 && through_m <= most_radii * robot_m_;
    if (!same_place && !may_be_it) continue;
    if (post.stands && (same_place || through_m <= post.radius_m * 1.01)) post.margin_m *= 2.0;
    if (!same_place) post.radius_m = std::max(post.radius_m, through_m);
    post.stands = true;
    return post;
  }
  posts_.push_back({contact, towards, first_guess * robot_m_, margin_m_, false});
  return posts_.back();
}

double FeltPosts::keep_m(const FeltPost& post) const {
  constexpr double rounding_m = 1e-6;
  return robot_m_ + corner_radius_m(post) + rounding_m;
}

Outcome<std::shared_ptr<const PolygonGround>> FeltPosts::without_posts(
    std::shared_ptr<const PolygonGround> ground) const {
  for (const FeltPost& post : posts_) {
    if (!post.stands) continue;
    std::vector<Vec2> outline;
    outline.reserve(post_corners);
    for (int i = 0; i < post_corners; ++i)
      outline.push_back(post.centre() + corner_radius_m(post) * direction(2.0 * pi * i / post_corners));
    auto smaller = ground->with_obstacle(outline);
    if (!smaller) return pass_on(smaller);
    ground = std::make_shared<const PolygonGround>(std::move(*smaller));
  }
  return ground;
}

}  // namespace outrider::cover
