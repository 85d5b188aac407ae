#include "outrider/world/solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::inside;
using testing::random_point;

constexpr double inf = std::numeric_limits<double>::infinity();

Vec3 random_vec(Rng& rng, double half_side) {
  return {rng.uniform(-half_side, half_side), rng.uniform(-half_side, half_side),
          rng.uniform(-half_side, half_side)};
}

/// Any rotation, or one of those by quarter turns, whose sines and cosines are nearly 0 and 1.
Rotation random_rotation(Rng& rng) {
  const auto angle = [&, quarters = rng.below(3) == 0] {
    return quarters ? static_cast<double>(rng.below(4)) * pi / 2 : rng.uniform(-pi, pi);
  };
  const double roll = angle();
  const double pitch = angle();
  return Rotation::from_rpy(roll, pitch, angle());
}

Pose3 random_pose(Rng& rng) { return {random_vec(rng, 1.0), random_rotation(rng)}; }

Solid random_box(Rng& rng) {
  return {"box", random_pose(rng), BoxShape{random_vec(rng, 0.4) + Vec3{0.5, 0.5, 0.5}}};
}
Solid random_cylinder(Rng& rng) {
  return {"cylinder", random_pose(rng), CylinderShape{rng.uniform(0.1, 1.0), rng.uniform(0.1, 1.0)}};
}
Solid random_sphere(Rng& rng) { return {"sphere", random_pose(rng), SphereShape{rng.uniform(0.1, 1.0)}}; }
Solid random_half_space(Rng& rng) { return {"ground", random_pose(rng), HalfSpaceShape{}}; }
Solid random_triangle(Rng& rng) {
  return {"triangle", random_pose(rng),
          MeshShape{{{random_vec(rng, 1.0), random_vec(rng, 1.0), random_vec(rng, 1.0)}}}};
}

// ---- Independent knowledge of the shapes, in their own frames ----------------------------------

/// How far p is from satisfying the inequalities that define the shape; at most 0 inside.
double violation(Vec3 p, const Shape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    return std::max({std::abs(p.x) - box->half_size.x, std::abs(p.y) - box->half_size.y,
                     std::abs(p.z) - box->half_size.z});
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    return std::max(std::hypot(p.x, p.y) - cylinder->radius_m, std::abs(p.z) - cylinder->half_length_m);
  }
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) return norm(p) - sphere->radius_m;
  if (std::holds_alternative<HalfSpaceShape>(shape)) return p.z;
  const auto& t = std::get<MeshShape>(shape).triangles.front();
  const Vec3 ab = t[1] - t[0];
  const Vec3 ac = t[2] - t[0];
  const Vec3 n = cross(ab, ac);
  const double area2 = squared_norm(n);
  const double v = dot(cross(p - t[0], ac), n) / area2;  // barycentric coordinates
  const double w = dot(cross(ab, p - t[0]), n) / area2;
  return std::max({std::abs(dot(p - t[0], n)) / std::sqrt(area2), -v, -w, v + w - 1.0});
}

/// Support function: the largest dot(n, q) of the points q of the shape.
double support(Vec3 n, const Shape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    return std::abs(n.x) * box->half_size.x + std::abs(n.y) * box->half_size.y +
           std::abs(n.z) * box->half_size.z;
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    return cylinder->radius_m * std::hypot(n.x, n.y) + cylinder->half_length_m * std::abs(n.z);
  }
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) return sphere->radius_m;
  if (std::holds_alternative<HalfSpaceShape>(shape))
    return std::hypot(n.x, n.y) < 1e-6 && n.z > 0 ? 0.0 : inf;
  const auto& t = std::get<MeshShape>(shape).triangles.front();
  return std::max({dot(n, t[0]), dot(n, t[1]), dot(n, t[2])});
}

/// Shows that distance(p, solid) is right by a witness and a separating plane: the point q at that
/// distance against the gradient lies in the shape, and no point of the shape lies beyond the plane
/// through q across the gradient.
void expect_distance_is_certain(Vec3 p, const Solid& solid) {
  const double d = distance(p, solid);
  const Vec3 local = solid.world_T_solid.to_local(p);
  if (d < 1e-3) {
    EXPECT_LE(violation(local, solid.shape), 2e-3);
    return;
  }
  const auto at = [&](Vec3 q) { return distance(solid.world_T_solid * q, solid); };
  constexpr double h = 1e-6;
  Vec3 n{at(local + Vec3{h, 0, 0}) - at(local - Vec3{h, 0, 0}),
         at(local + Vec3{0, h, 0}) - at(local - Vec3{0, h, 0}),
         at(local + Vec3{0, 0, h}) - at(local - Vec3{0, 0, h})};
  n = 1.0 / norm(n) * n;
  if (std::holds_alternative<HalfSpaceShape>(solid.shape)) {
    EXPECT_NEAR(norm(n - Vec3{0, 0, 1}), 0.0, 1e-6);
    n = {0, 0, 1};
  }
  const Vec3 q = local - d * n;
  EXPECT_LE(violation(q, solid.shape), 1e-5) << solid.name << ": nothing of it is that near";
  EXPECT_NEAR(dot(n, q), support(n, solid.shape), 1e-5) << solid.name << ": some of it is nearer";
}

TEST(SolidDistance, IsCertainForEveryShape) {
  Rng rng(1);
  for (int i = 0; i < cases(500); ++i) {
    for (const Solid& solid : {random_box(rng), random_cylinder(rng), random_sphere(rng),
                               random_half_space(rng), random_triangle(rng)}) {
      expect_distance_is_certain(random_vec(rng, 4.0), solid);
    }
  }
}

TEST(SolidDistance, IsZeroExactlyInside) {
  Rng rng(2);
  int within = 0;
  for (int i = 0; i < cases(2000); ++i) {
    for (const Solid& solid :
         {random_box(rng), random_cylinder(rng), random_sphere(rng), random_half_space(rng)}) {
      const Vec3 p = random_vec(rng, 2.0);
      const double out = violation(solid.world_T_solid.to_local(p), solid.shape);
      within += out < 0.0 ? 1 : 0;
      EXPECT_EQ(distance(p, solid) == 0.0, out <= 0.0) << solid.name;
    }
  }
  EXPECT_GT(within, 500);
}

TEST(SolidDistance, OfAMeshIsTheLeastOfItsTriangles) {
  Rng rng(3);
  for (int i = 0; i < cases(100); ++i) {
    Solid all{"mesh", random_pose(rng), MeshShape{}};
    auto& triangles = std::get<MeshShape>(all.shape).triangles;
    for (int k = 0; k < 10; ++k)
      triangles.push_back({random_vec(rng, 1), random_vec(rng, 1), random_vec(rng, 1)});
    const Vec3 p = random_vec(rng, 3.0);
    double least = inf;
    for (const auto& t : triangles) {
      least = std::min(least, distance(p, Solid{"one", all.world_T_solid, MeshShape{{t}}}));
    }
    EXPECT_EQ(distance(p, all), least);
  }
}

TEST(SolidBounds, AreTheSupportInSixDirections) {
  Rng rng(4);
  for (int i = 0; i < cases(200); ++i) {
    for (const Solid& solid :
         {random_box(rng), random_cylinder(rng), random_sphere(rng), random_triangle(rng)}) {
      const Box3 box = bounds(solid);
      const auto extent = [&](Vec3 n) {
        return dot(n, solid.world_T_solid.position) +
               support(solid.world_T_solid.rotation.unrotate(n), solid.shape);
      };
      EXPECT_NEAR(box.high.x, extent({1, 0, 0}), 1e-9) << solid.name;
      EXPECT_NEAR(box.high.y, extent({0, 1, 0}), 1e-9) << solid.name;
      EXPECT_NEAR(box.high.z, extent({0, 0, 1}), 1e-9) << solid.name;
      EXPECT_NEAR(box.low.x, -extent({-1, 0, 0}), 1e-9) << solid.name;
      EXPECT_NEAR(box.low.y, -extent({0, -1, 0}), 1e-9) << solid.name;
      EXPECT_NEAR(box.low.z, -extent({0, 0, -1}), 1e-9) << solid.name;
    }
  }
}

TEST(SolidBounds, OfHalfSpaces) {
  const Box3 floor = bounds({"floor", {{0, 0, 2}, {}}, HalfSpaceShape{}});
  EXPECT_EQ(floor.high.z, 2.0);
  EXPECT_EQ(floor.low.z, -inf);
  const Box3 ceiling = bounds({"ceiling", {{0, 0, 2}, Rotation::from_rpy(pi, 0, 0)}, HalfSpaceShape{}});
  EXPECT_EQ(ceiling.low.z, 2.0);
  EXPECT_EQ(ceiling.high.z, inf);
}

// ---- Footprints and slices against membership ---------------------------------------------------

/// The part of a line inside a shape, in the line's parameter, by the inequalities of the shape.
std::optional<Interval> line_inside(Vec3 from, Vec3 along, const Shape& shape) {
  Interval part{-inf, inf};
  const auto between = [&](double start, double rate, double half) {  // |start + t rate| <= half
    if (std::abs(rate) < 1e-15) {
      if (std::abs(start) > half) part = {inf, -inf};
      return;
    }
    const double a = (-half - start) / rate;
    const double b = (half - start) / rate;
    part = {std::max(part.low, std::min(a, b)), std::min(part.high, std::max(a, b))};
  };
  const auto round = [&](double a, double b, double c) {  // a t^2 + 2 b t + c <= 0
    if (a < 1e-15) {
      if (c > 0.0) part = {inf, -inf};
      return;
    }
    const double root2 = b * b - a * c;
    if (root2 < 0.0) {
      part = {inf, -inf};
      return;
    }
    part = {std::max(part.low, (-b - std::sqrt(root2)) / a),
            std::min(part.high, (-b + std::sqrt(root2)) / a)};
  };
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    between(from.x, along.x, box->half_size.x);
    between(from.y, along.y, box->half_size.y);
    between(from.z, along.z, box->half_size.z);
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    between(from.z, along.z, cylinder->half_length_m);
    round(squared_norm(xy(along)), dot(xy(from), xy(along)),
          squared_norm(xy(from)) - cylinder->radius_m * cylinder->radius_m);
  } else {
    const double radius = std::get<SphereShape>(shape).radius_m;
    round(squared_norm(along), dot(from, along), squared_norm(from) - radius * radius);
  }
  if (part.low > part.high) return std::nullopt;
  return part;
}

/// True when some point above p at a height in the range belongs to the solid.
bool stands_over(Vec2 p, const Solid& solid, double z_low, double z_high) {
  const Pose3& pose = solid.world_T_solid;
  const auto part =
      line_inside(pose.to_local({p.x, p.y, 0.0}), pose.rotation.unrotate({0, 0, 1}), solid.shape);
  return part && part->low <= z_high && part->high >= z_low;
}

double footprint_distance(Vec2 p, const std::vector<RoundedPolygon>& pieces) {
  double nearest = inf;
  for (const RoundedPolygon& piece : pieces) nearest = std::min(nearest, signed_distance(p, piece));
  return nearest;
}

/// `slack` is how far a footprint may stand outside what is covered, m.
void expect_footprint(const Solid& solid, double slack, Rng& rng) {
  const double z_low = rng.uniform(-2.0, 1.5);
  const double z_high = z_low + rng.uniform(0.01, 1.0);
  const auto pieces = footprint(solid, z_low, z_high);
  for (int k = 0; k < 50; ++k) {
    const Vec2 p = random_point(rng, 2.5);
    const double d = footprint_distance(p, pieces);
    if (d > 1e-7) {
      EXPECT_FALSE(stands_over(p, solid, z_low, z_high)) << solid.name << " " << d;
    }
    if (d < -slack - 1e-7) {
      EXPECT_TRUE(stands_over(p, solid, z_low, z_high)) << solid.name << " " << d;
    }
  }
}

TEST(Footprint, OfBoxesInAnyRotation) {
  Rng rng(5);
  for (int i = 0; i < cases(400); ++i) expect_footprint(random_box(rng), 0.0, rng);
}

TEST(Footprint, OfSpheres) {
  Rng rng(6);
  for (int i = 0; i < cases(400); ++i) expect_footprint(random_sphere(rng), 0.0, rng);
}

TEST(Footprint, OfUprightCylinders) {
  Rng rng(7);
  for (int i = 0; i < cases(400); ++i) {
    Solid cylinder = random_cylinder(rng);
    cylinder.world_T_solid.rotation = Rotation::from_rpy(rng.below(2) == 0 ? 0.0 : pi, 0.0, rng.normal());
    expect_footprint(cylinder, 0.0, rng);
  }
}

TEST(Footprint, OfTiltedCylindersStandsLittleOutside) {
  Rng rng(8);
  for (int i = 0; i < cases(400); ++i) {
    const Solid solid = random_cylinder(rng);
    expect_footprint(solid, 0.05 * std::get<CylinderShape>(solid.shape).radius_m, rng);
  }
}

TEST(Footprint, OfMeshesIsTheShadowOfTheirSurface) {
  Rng rng(9);
  for (int i = 0; i < cases(400); ++i) {
    const Solid solid = random_triangle(rng);
    const double z_low = rng.uniform(-2.0, 1.5);
    const double z_high = z_low + rng.uniform(0.01, 1.0);
    const auto pieces = footprint(solid, z_low, z_high);
    const auto& t = std::get<MeshShape>(solid.shape).triangles.front();
    for (int k = 0; k < 50; ++k) {  // points of the triangle cast their shadow; points beside cast none
      double v = rng.uniform();
      double w = rng.uniform();
      if (v + w > 1.0) {
        v = 1.0 - v;
        w = 1.0 - w;
      }
      const Vec3 q = solid.world_T_solid * (t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]));
      if (q.z >= z_low && q.z <= z_high) {
        EXPECT_LE(footprint_distance(xy(q), pieces), 1e-9);
      }
      const Vec2 p = random_point(rng, 2.0);
      if (footprint_distance(p, pieces) > -1e-6) continue;
      const Vec3 n =
          cross(solid.world_T_solid.rotation * (t[1] - t[0]), solid.world_T_solid.rotation * (t[2] - t[0]));
      const Vec3 corner = solid.world_T_solid * t[0];
      const double z = corner.z - dot(xy(n), p - xy(corner)) / n.z;
      EXPECT_LE(violation(solid.world_T_solid.to_local({p.x, p.y, z}), solid.shape), 1e-6);
      EXPECT_GE(z, z_low - 1e-6);
      EXPECT_LE(z, z_high + 1e-6);
    }
  }
}

TEST(Footprint, OfWhatIsNotThere) {
  const Solid box{"box", {{0, 0, 5}, {}}, BoxShape{{1, 1, 1}}};
  EXPECT_TRUE(footprint(box, 0.0, 1.0).empty());
  EXPECT_TRUE(footprint(box, 6.1, 9.0).empty());
  EXPECT_EQ(footprint(box, 4.5, 4.6).size(), 1U);
  EXPECT_TRUE(footprint({"floor", {}, HalfSpaceShape{}}, -1.0, 1.0).empty());
  EXPECT_TRUE(footprint({"mesh", {}, MeshShape{}}, -1.0, 1.0).empty());
}

/// `slack` is how far the outline may lie from the true one, m.
void expect_slice(const Solid& solid, double slack, Rng& rng) {
  const Vec2 origin = random_point(rng, 1.0);
  const Vec2 along = direction(rng.uniform(-pi, pi));
  const auto pieces = slice(solid, origin, along);
  for (int k = 0; k < 50; ++k) {
    const Vec2 in_plane = random_point(rng, 2.5);
    const Vec2 ground = origin + in_plane.x * along;
    const double out = violation(solid.world_T_solid.to_local({ground.x, ground.y, in_plane.y}), solid.shape);
    bool drawn = false;
    for (const auto& piece : pieces) drawn = drawn || inside(in_plane, piece);
    if (out > 1e-9) {
      EXPECT_FALSE(drawn && out > slack) << solid.name << " " << out;
    }
    if (out < -slack - 1e-9) {
      EXPECT_TRUE(drawn) << solid.name << " " << out;
    }
  }
}

TEST(Slice, IsTheCutOfEachSolid) {
  Rng rng(10);
  for (int i = 0; i < cases(300); ++i) {
    expect_slice(random_box(rng), 0.0, rng);
    expect_slice(random_half_space(rng), 0.0, rng);
    const Solid cylinder = random_cylinder(rng);
    expect_slice(cylinder, 0.0025 * std::get<CylinderShape>(cylinder.shape).radius_m, rng);
    const Solid sphere = random_sphere(rng);
    expect_slice(sphere, 0.0025 * std::get<SphereShape>(sphere.shape).radius_m, rng);
  }
}

TEST(Slice, OfATriangleIsASegmentOnIt) {
  Rng rng(11);
  int cut = 0;
  for (int i = 0; i < cases(300); ++i) {
    const Solid solid = random_triangle(rng);
    const Vec2 origin = random_point(rng, 1.0);
    const Vec2 along = direction(rng.uniform(-pi, pi));
    for (const auto& piece : slice(solid, origin, along)) {
      ++cut;
      ASSERT_EQ(piece.size(), 2U);
      for (const Vec2 end : piece) {
        const Vec2 ground = origin + end.x * along;
        EXPECT_LT(distance({ground.x, ground.y, end.y}, solid), 1e-9);
      }
    }
  }
  EXPECT_GT(cut, 50);
}

TEST(Solid, KindNamesTheShape) {
  EXPECT_EQ(kind(BoxShape{}), "box");
  EXPECT_EQ(kind(CylinderShape{}), "cylinder");
  EXPECT_EQ(kind(SphereShape{}), "sphere");
  EXPECT_EQ(kind(HalfSpaceShape{}), "half_space");
  EXPECT_EQ(kind(MeshShape{}), "mesh");
}

}  // namespace
}  // namespace outrider
