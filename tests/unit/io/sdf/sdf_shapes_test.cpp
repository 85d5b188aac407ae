// Cones, polylines and parts of meshes in SDF worlds, against the formulas of their shapes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"
#include "sdf_texts.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

TEST(SdfShapes, ConesAreCovered) {
  const auto [world, warnings] = load(world_of(
      ground + model("tip", "0 0 1 0 0 0", "<cone><radius>0.5</radius><length>2</length></cone>"), "1.11"));
  EXPECT_TRUE(warnings.empty());
  const auto& mesh = std::get<MeshShape>(solid(world, "tip").shape);
  for (const auto& triangle : mesh.triangles) {
    for (const Vec3 p : triangle) {  // no corner stands more than 1 % outside, none inside
      EXPECT_LE(norm(xy(p)), 1.01 * 0.25 * (1.0 - p.z) + 1e-12);
      EXPECT_TRUE(norm(xy(p)) >= 0.25 * (1.0 - p.z) || norm(xy(p)) == 0.0);
    }
  }
  for (int i = 0; i < 360; ++i) {  // what is outside of the mesh is outside of the cone
    const Vec2 around = direction(radians(i));
    EXPECT_LE(distance({0.5 * around.x, 0.5 * around.y, 0.001}, solid(world, "tip")), 0.01);
  }
  EXPECT_EQ(distance({0, 0, 3}, solid(world, "tip")), 1.0);
}

/// The length of a vertical line through a point within a closed surface, by how often it goes in and out.
double depth_at(const MeshShape& mesh, Vec2 at) {
  double depth = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec2 p = xy(a) - at;
    const Vec2 q = xy(b) - at;
    const Vec2 r = xy(c) - at;
    const double area = cross(q - p, r - p);
    const double u = cross(q, r) / area;
    const double v = cross(r, p) / area;
    if (area == 0.0 || u < 0.0 || v < 0.0 || u + v > 1.0) continue;
    const double z = u * a.z + v * b.z + (1.0 - u - v) * c.z;
    depth += z > 0.5 ? z : -z;
  }
  return depth;
}

TEST(SdfShapes, PolylinesAreExtrudedWithTheirHoles) {
  const auto line = [](const std::vector<Vec2>& corners) {
    std::string text = "<polyline><height>1.5</height>";
    for (const Vec2 p : corners) text += fmt::format("<point>{} {}</point>", p.x, p.y);
    return text + "</polyline>";
  };
  const std::string arrow =
      line({{0, 0}, {4, 0}, {4, 4}, {2, 1.5}, {0, 4}});  // the notch reaches down to y = 1.5
  const std::string hole = line({{1, 0.25}, {3, 0.5}, {2, 1.25}});
  const auto [world, warnings] = load(world_of(ground + model("a", "0 0 0 0 0 0", arrow + hole)));
  EXPECT_TRUE(warnings.empty());
  const auto& mesh = std::get<MeshShape>(solid(world, "a").shape);
  Rng rng(3);
  int filled = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 p{rng.uniform(-0.5, 4.5), rng.uniform(-0.5, 4.5)};
    const bool in_square = p.x > 0 && p.x < 4 && p.y > 0;
    const bool below_notch = p.y < 1.5 + 1.25 * std::abs(p.x - 2);
    const bool in_hole = cross(Vec2{2, 0.25}, p - Vec2{1, 0.25}) > 0 &&
                         cross(Vec2{-1, 0.75}, p - Vec2{3, 0.5}) > 0 &&
                         cross(Vec2{-1, -1}, p - Vec2{2, 1.25}) > 0;
    const bool inside = in_square && below_notch && !in_hole;
    EXPECT_NEAR(depth_at(mesh, p), inside ? 1.5 : 0.0, 1e-9) << p.x << ' ' << p.y;
    filled += inside;
  }
  EXPECT_GT(filled, 500);
}

TEST(SdfShapes, APartOfAMeshIsTakenByItsName) {
  const test::Folder folder;
  folder.write(
      "two.obj",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 6 2 0\nv 8 2 0\nv 6 4 2\no low\nf 1 2 3\no high\nf 4 5 6\nf 6 5 4\n");
  const std::string source =
      "<source id='s'><float_array>0 0 0 1 0 0 0 1 0</float_array></source>"
      "<vertices id='v'><input semantic='POSITION' source='#s'/></vertices><triangles><input "
      "semantic='VERTEX' "
      "source='#v' offset='0'/><p>0 1 2</p></triangles>";
  folder.write("two.dae",
               "<COLLADA><library_geometries><geometry id='g'><mesh>" + source +
                   "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='x'>"
                   "<node name='left'><instance_geometry url='#g'/></node><node name='right'><translate>5 "
                   "0 0</translate><instance_geometry url='#g'/></node></visual_scene>"
                   "</library_visual_scenes><scene><instance_visual_scene url='#x'/></scene></COLLADA>");
  const auto mesh = [](const std::string& file, const std::string& part) {
    return "<mesh><uri>" + file + "</uri><submesh>" + part + "</submesh></mesh>";
  };
  const std::string path = folder.write(
      "w.sdf", world_of(ground + model("a", "0 0 0 0 0 0", mesh("two.obj", "<name>high</name>")) +
                        model("b", "0 0 0 0 0 0", mesh("two.obj", "<name>high</name><center>true</center>")) +
                        model("c", "0 0 0 0 0 0", mesh("two.dae", "<name>right</name>")) +
                        model("d", "0 0 0 0 0 0", mesh("two.dae", "<name>none</name>"))));
  const auto loaded = load_sdf(path);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const auto triangles = [&](const char* name) {
    return std::get<MeshShape>(solid(loaded->world, name).shape).triangles;
  };
  ASSERT_EQ(triangles("a").size(), 2U);
  EXPECT_EQ(triangles("a")[0][0], (Vec3{6, 2, 0}));
  EXPECT_EQ(triangles("b")[0][0], (Vec3{-1, -1, -1}));
  ASSERT_EQ(triangles("c").size(), 1U);
  EXPECT_EQ(triangles("c")[0][0], (Vec3{5, 0, 0}));
  EXPECT_EQ(triangles("d").size(), 2U);
  ASSERT_EQ(loaded->warnings.size(), 1U);
  EXPECT_NE(loaded->warnings[0].find("two.dae' has no part 'none'; the whole mesh was taken"),
            std::string::npos)
      << loaded->warnings[0];
}

}  // namespace
}  // namespace outrider
