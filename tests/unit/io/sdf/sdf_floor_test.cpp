// The floor of a world, and the bounds of its yard.
#include <gtest/gtest.h>

#include "sdf_texts.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

TEST(SdfFloor, FloorIsTheHighestUprightHalfSpaceOrASlab) {
  const auto at = [](const std::string& z) { return model("p" + z, "0 0 " + z + " 0 0 0", "<plane/>"); };
  EXPECT_EQ(load(world_of(at("0") + at("0.25") + at("-2"))).world.floor_z_m, 0.25);
  const std::string slab = model("slab", "0 0 -0.05 0 0 0", "<box><size>10 10 0.1</size></box>");
  const std::string lawn = model("lawn", "0 0 0.05 0 0 0", "<box><size>10 10 0.1</size></box>");
  const std::string roof = model("roof", "0 0 3 0 0 0", "<box><size>10 10 0.1</size></box>");
  const std::string table = model("table", "0 0 1 0 0 0", "<box><size>2 2 0.1</size></box>");
  EXPECT_DOUBLE_EQ(load(world_of(slab + table)).world.floor_z_m, 0.0);
  EXPECT_DOUBLE_EQ(load(world_of(slab + table + lawn)).world.floor_z_m, 0.1);
  EXPECT_DOUBLE_EQ(load(world_of(slab + table + roof)).world.floor_z_m, 0.0);
  EXPECT_NE(sdf_fault(world_of(model("leg", "0 0 0.5 0 0 0", unit_box) + table)).find("no floor"),
            std::string::npos);
  EXPECT_EQ(sdf_fault(world_of(model("a", "0 0 1 0 0 0", unit_box))),
            "w.sdf: the world has no floor; add a model with a <plane> collision, or a box or a mesh that "
            "lies level "
            "under half of everything");
}

TEST(SdfFloor, AFloorMayLieOnTheGround) {
  const auto asphalt = [](const std::string& size) {
    return model("asphalt", "0 0 0 0 0 0", "<box><size>" + size + " 0.1</size></box>");
  };
  const std::string house = model("house", "9 0 1 0 0 0", "<box><size>2 2 2</size></box>");
  EXPECT_DOUBLE_EQ(load(world_of(ground + house + asphalt("20 20"))).world.floor_z_m, 0.05);
  EXPECT_DOUBLE_EQ(load(world_of(ground + house + asphalt("10 20"))).world.floor_z_m, 0.0);
  const std::string stage = model("stage", "0 0 0.5 0 0 0", "<box><size>20 20 1</size></box>");
  EXPECT_DOUBLE_EQ(load(world_of(ground + house + stage)).world.floor_z_m, 0.0);
  EXPECT_DOUBLE_EQ(load(world_of(ground + house + asphalt("3 3"))).world.floor_z_m, 0.0);
}

TEST(SdfFloor, AFloorMayBeTurned) {
  const std::string mats = model("mats", "0 0 0 0 0 0.7", "<box><size>10 10 0.04</size></box>");
  const std::string wall = model("wall", "0 2 0.5 0 0 0.7", "<box><size>4 0.1 1</size></box>");
  EXPECT_DOUBLE_EQ(load(world_of(ground + mats + wall)).world.floor_z_m, 0.02);
}

TEST(SdfFloor, TheFloorMayBeTheMeshOfAHouse) {
  const test::Folder folder;  // the ground floor lies 0.2 m thick at z = 1, the ceiling at 3.5
  folder.write("house.obj",
               "v 0 0 0.8\nv 6 0 0.8\nv 6 4 0.8\nv 0 4 0.8\nv 0 0 1\nv 6 0 1\nv 6 4 1\nv 0 4 1\n"
               "v 0 0 3.5\nv 6 0 3.5\nv 6 4 3.5\nv 0 4 3.5\n"
               "f 1 2 3 4\nf 8 7 6 5\nf 9 10 11 12\nf 5 6 10 9\nf 8 7 11 12\n");
  const auto loaded = load_sdf(
      folder.write("w.sdf", world_of(model("house", "0 0 0 0 0 0", "<mesh><uri>house.obj</uri></mesh>"))));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_DOUBLE_EQ(loaded->world.floor_z_m, 1.0);
  EXPECT_EQ(loaded->world.bounds.high, (Vec2{6, 4}));
}

}  // namespace
}  // namespace outrider
