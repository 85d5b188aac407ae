#include "outrider/io/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "support/data.hpp"
#include "support/replaced.hpp"

namespace outrider {
namespace {

const std::string text_stl =
    "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2e0 0\nendloop\nendfacet\n"
    "endsolid t\n";
const std::string square_obj =
    "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1/1/1 2//1 3/2 -1\n";
const std::string dae =
    "<?xml version=\"1.0\"?><COLLADA><asset><unit meter=\"0.01\"/><up_axis>Y_UP</up_axis></asset>"
    "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"12\">"
    "0 0 0  100 0 0  100 100 0  0 100 0</float_array><technique_common><accessor "
    "stride=\"3\"/></technique_common>"
    "</source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
    "<triangles count=\"1\"><input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/>"
    "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 9 1 9 2 9</p></triangles>"
    "<polylist count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>4</vcount><p>0 1 2 "
    "3</p>"
    "</polylist></mesh></geometry></library_geometries>"
    "<library_visual_scenes><visual_scene id=\"s\"><node><translate>0 0 500</translate>"
    "<rotate>0 0 1 90</rotate><node><matrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1</matrix>"
    "<instance_geometry url=\"#g\"/></node></node></visual_scene></library_visual_scenes>"
    "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";

std::string binary_stl(const std::vector<Triangle>& triangles, const std::string& comment) {
  std::string bytes = comment;
  bytes.resize(80);
  const auto put = [&](std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
  };
  put(static_cast<std::uint32_t>(triangles.size()), 4);
  for (const Triangle& triangle : triangles) {
    bytes.append(12, '\0');
    for (const Vec3 p : triangle) {
      for (const double c : {p.x, p.y, p.z}) put(std::bit_cast<std::uint32_t>(static_cast<float>(c)), 4);
    }
    put(0, 2);
  }
  return bytes;
}

void expect_near(Vec3 a, Vec3 b) { EXPECT_NEAR(norm(a - b), 0.0, 1e-12) << a.x << ' ' << a.y << ' ' << a.z; }

TEST(Mesh, BothFormsOfStl) {
  const std::vector<Triangle> expected = {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 2, 0}}};
  EXPECT_EQ(*mesh_from_bytes(text_stl, "a.stl"), expected);
  EXPECT_EQ(*mesh_from_bytes(binary_stl(expected, "binary"), "A.STL"), expected);
  EXPECT_EQ(*mesh_from_bytes(binary_stl(expected, "solid but binary"), "a.stl"), expected);
}

TEST(Mesh, ObjPolygonsBecomeFans) {
  const auto mesh = mesh_from_bytes(square_obj, "a.obj");
  ASSERT_TRUE(mesh) << to_string(mesh.error());
  EXPECT_EQ(*mesh, (std::vector<Triangle>{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}},
                                          {Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}}));
}

TEST(Mesh, ColladaNodesAreComposedAndScaledByTheUnit) {
  const auto mesh = mesh_from_bytes(dae, "a.dae");
  ASSERT_TRUE(mesh) << to_string(mesh.error());
  ASSERT_EQ(mesh->size(), 3U);
  // (100, 0, 0) doubled, turned by 90 degrees, raised by 500, all in cm.
  expect_near(mesh->front()[0], {0, 0, 5});
  expect_near(mesh->front()[1], {0, 2, 5});
  expect_near(mesh->front()[2], {-2, 2, 5});
  expect_near(mesh->back()[2], {-2, 0, 5});
}

TEST(Mesh, ColladaNodesWithoutAMeshMayBeAnything) {
  const std::string camera =
      "<node><lookat>1 2 3 4 5 6 7 8 9</lookat><instance_camera url=\"#c\"/></node>"
      "<node><matrix>NaN NaN NaN</matrix></node>";
  const auto mesh =
      mesh_from_bytes(test::replaced(dae, "<node><matrix>", camera + "<node><matrix>"), "a.dae");
  ASSERT_TRUE(mesh) << to_string(mesh.error());
  EXPECT_EQ(*mesh, *mesh_from_bytes(dae, "a.dae"));
}

TEST(Mesh, ColladaWithoutASceneIsTakenAsItIs) {
  const auto mesh =
      mesh_from_bytes(dae.substr(0, dae.find("<library_visual_scenes>")) + "</COLLADA>", "a.dae");
  ASSERT_TRUE(mesh) << to_string(mesh.error());
  expect_near(mesh->front()[2], {1, 1, 0});
}

TEST(Mesh, TrianglesThatAreFarAwayAsAWholeAreLeftOut) {
  const std::string far = "vertex 1e18 0 0\nvertex 1e18 5 0\nvertex 1e18 0 5\n";
  const auto mesh = mesh_from_bytes(text_stl + far, "a.stl");
  ASSERT_TRUE(mesh) << to_string(mesh.error());
  EXPECT_EQ(mesh->size(), 1U);
  const auto long_one =
      mesh_from_bytes(text_stl + "vertex 0 0 0\nvertex 1e18 5 0\nvertex 1e18 0 5\n", "a.stl");
  ASSERT_FALSE(long_one);
  EXPECT_NE(long_one.error().sentence.find("beyond 1e6"), std::string::npos);
}

TEST(Mesh, FlatTrianglesAreLeftOut) {
  const auto mesh = mesh_from_bytes(text_stl + "vertex 0 0 0\nvertex 1 1 1\nvertex 2 2 2\n", "a.stl");
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->size(), 1U);
}

TEST(Mesh, RefusesWhatIsWrong) {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<std::pair<std::string, std::string>> bad = {
      {text_stl, "a.ply"},
      {"", "a.stl"},
      {"", "a.obj"},
      {"", "a.dae"},
      {"solid\nendsolid\n", "a.stl"},
      {replaced(text_stl, "2e0", "nan"), "a.stl"},
      {replaced(text_stl, "2e0", "2e7"), "a.stl"},
      {text_stl + "vertex 1 1 1\n", "a.stl"},
      {binary_stl({{}, {}}, "").substr(0, 100), "a.stl"},
      {replaced(square_obj, "-1", "-5"), "a.obj"},
      {replaced(square_obj, "-1", "0"), "a.obj"},
      {replaced(square_obj, "3/2", "7"), "a.obj"},
      {replaced(square_obj, "v 1 1 0", "v 1 1"), "a.obj"},
      {"v 0 0 0\nf 1 1\n", "a.obj"},
      {replaced(dae, "0 9 1 9 2 9", "0 9 1 9 4 9"), "a.dae"},
      {replaced(dae, "0 9 1 9 2 9", "0 9 1 9"), "a.dae"},
      {replaced(dae, "0 1 2 3", "0 1 2"), "a.dae"},
      {replaced(dae, "0 1 2 3", "0 1 2 -3"), "a.dae"},
      {replaced(dae, "#p", "#q"), "a.dae"},
      {replaced(dae, "2 0 0 0 0 2", "2 0 0 0 0"), "a.dae"},
      {replaced(dae, "0 0 500", "0 0 inf"), "a.dae"},
      {replaced(dae, "offset=\"1\"", "offset=\"999999999\""), "a.dae"},
      {replaced(dae, "<instance_geometry url=\"#g\"/>", "<instance_node url=\"#s\"/>"), "a.dae"},
      {dae.substr(0, dae.size() / 2), "a.dae"},
  };
  for (const auto& [bytes, name] : bad) {
    const auto mesh = mesh_from_bytes(bytes, name);
    ASSERT_FALSE(mesh) << bytes;
    EXPECT_TRUE(mesh.error().where.starts_with(name)) << to_string(mesh.error());
  }
  EXPECT_EQ(mesh_from_bytes(replaced(square_obj, "3/2", "7"), "a.obj").error().where, "a.obj:7");
}

TEST(Mesh, SurvivesDamage) {
  Rng rng(8);
  const std::string binary = binary_stl(*mesh_from_bytes(square_obj, "a.obj"), "");
  for (int i = 0; i < 3000; ++i) {
    for (const auto& [bytes, name] : {std::pair(text_stl, "a.stl"), std::pair(binary, "a.stl"),
                                      std::pair(square_obj, "a.obj"), std::pair(dae, "a.dae")}) {
      const auto mesh = mesh_from_bytes(test::damaged(bytes, rng), name);
      if (!mesh) continue;
      for (const Triangle& triangle : *mesh)
        EXPECT_TRUE(std::isfinite(norm(triangle[0] + triangle[1] + triangle[2])));
    }
  }
}

}  // namespace
}  // namespace outrider
