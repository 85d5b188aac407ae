// Models that are included and merged, names, and the bounds of what is read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "sdf_texts.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

std::string link(const std::string& name, const std::string& pose, const std::string& attribute = "") {
  return "<link name='" + name + "'><pose " + attribute + ">" + pose +
         "</pose><collision name='c'><geometry>" + unit_box + "</geometry></collision></link>";
}

TEST(SdfScan, AMergedModelBecomesPartOfItsParent) {
  const test::Folder folder;  // the arm's frame "grip" is 1 m ahead of its link "upper", 2 m above the arm
  folder.write("arm.sdf", "<sdf version='1.9'><model name='arm'><pose>9 9 9 0 0 0</pose>" +
                              link("upper", "0 0 2 0 0 0") +
                              "<frame name='grip' attached_to='upper'><pose>1 0 0 0 0 0</pose></frame>" +
                              link("hand", "0 1 0 0 0 0", "relative_to='__model__'") + "</model></sdf>");
  const auto robot = [&](const std::string& include) {
    const auto loaded = load_sdf(folder.write(
        "w.sdf",
        world_of(ground + "<model name='robot'><pose>10 0 0 0 0 1.5707963267948966</pose>" +
                     link("base", "0 0 1 0 0 0") + "<include merge='true'><uri>arm.sdf</uri>" + include +
                     "</include>" + link("ball", "0 0 1 0 0 0", "relative_to='grip'") + "</model>",
                 "1.9")));
    EXPECT_TRUE(loaded) << to_string(loaded.error());
    return loaded ? loaded->world : World{};
  };
  const World plain = robot("<pose relative_to='base'>1 0 0 0 0 0</pose>");
  expect_near(solid(plain, "robot/upper").world_T_solid.position, {10, 1, 3});
  expect_near(solid(plain, "robot/hand").world_T_solid.position, {9, 1, 1});
  expect_near(solid(plain, "robot/ball").world_T_solid.position, {10, 2, 4});
  const World placed = robot("<placement_frame>grip</placement_frame><pose>0 0 5 0 0 0</pose>");
  expect_near(solid(placed, "robot/upper").world_T_solid.position, {10, -1, 5});
  expect_near(solid(placed, "robot/ball").world_T_solid.position, {10, 0, 6});
  const World own = robot("");
  expect_near(solid(own, "robot/upper").world_T_solid.position, {1, 9, 11});
}

TEST(SdfScan, FramesOfOldAndNewFilesMayBeMixed) {
  const test::Folder folder;
  folder.write("old.sdf", "<sdf version='1.6'><model name='old'>" + link("a", "0 0 1 0 0 0") +
                              link("b", "0 0 1 0 0 0", "frame='a'") + "</model></sdf>");
  const auto loaded = load_sdf(folder.write(
      "w.sdf",
      world_of(
          ground + "<model name='post'>" + link("top", "1 2 3 0 0 0") +
              "</model><include><uri>old.sdf</uri><pose relative_to='post::top'>1 0 0 0 0 0</pose></include>",
          "1.9")));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  expect_near(solid(loaded->world, "old/b").world_T_solid.position, {2, 2, 5});
}

TEST(SdfScan, NamesOfFlattenedModelsAreFoundByTheirFrames) {
  const auto [world, warnings] =
      load(world_of(ground + "<model name='m'>" + link("arm::base", "1 0 0 0 0 0") +
                        link("tip", "0 0 1 0 0 0", "relative_to='arm::base'") + "</model>",
                    "1.7"));
  expect_near(solid(world, "m/tip").world_T_solid.position, {1, 0, 1});
  solid(world, "m/arm_base");
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(SdfScan, PartsWithoutANameAreNamed) {
  const auto [world, warnings] = load("<sdf version='1.7'><world>\n<model>" + link("a", "0 0 0 0 0 0") +
                                      link("", "3 0 0 0 0 0") + "</model>" + ground + "</world></sdf>");
  EXPECT_EQ(world.name, "world_1");
  expect_near(solid(world, "model/link").world_T_solid.position, {3, 0, 0});
  ASSERT_EQ(warnings.size(), 4U);
  EXPECT_EQ(warnings[2], "w.sdf:2: a <model> without a name was called 'model'");
}

TEST(SdfScan, AStatedPoseMayBeInDegrees) {
  const auto [world, warnings] =
      load(world_of(ground + model("a", "0 0 0 0 0 0", unit_box) +
                        "<state><model name='a'><pose degrees='true'>1 2 3 0 0 90</pose></model></state>",
                    "1.9"));
  expect_near(solid(world, "a").world_T_solid.rotation.axes[0], {0, 1, 0});
}

// ---- Bounds --------------------------------------------------------------------------------------

std::string nested(int levels) {
  std::string text;
  for (int i = 0; i < levels; ++i) text += "<model name='m'>";
  text += link("l", "0 0 0 0 0 0");
  for (int i = 0; i < levels; ++i) text += "</model>";
  return text;
}

TEST(SdfScan, WhatIsBeyondItsBoundsIsRefused) {
  EXPECT_EQ(load(world_of(ground + nested(40))).world.solids.size(), 2U);
  EXPECT_EQ(sdf_fault(world_of(ground + nested(99))),
            "w.sdf:4: its elements nest more than 100 deep; correct or export it again");
  EXPECT_TRUE(sdf_fault(std::string(4'000'000, '<'))
                  .starts_with("w.sdf: it has 4000000 tags with what it includes, and at most 2000000 "));
  std::string frames;
  for (int i = 0; i < 200'000; ++i) frames += "<frame name='" + std::to_string(i) + "'/>\n";
  EXPECT_TRUE(sdf_fault(world_of(ground + frames))
                  .starts_with("w.sdf:200001: it has more than 200000 models, links, "));
  const std::string long_name(1'000'000, 'n');
  std::string links;
  for (int i = 0; i < 100; ++i) links += "<link name='" + std::to_string(i) + "'/>";
  EXPECT_TRUE(
      sdf_fault(world_of(ground + "<model name='" + long_name + "'>" + links + "</model>"))
          .starts_with(
              "w.sdf:4: the names of its parts, with those of the models around them, have more than "));
}

TEST(SdfScan, TrianglesOfRoundShapesAreCounted) {
  std::string eggs;
  for (int i = 0; i < 1000; ++i) eggs += "<collision name='c'><geometry><ellipsoid/></geometry></collision>";
  EXPECT_EQ(
      sdf_fault(world_of(ground + "<model name='m'><link name='l'>" + eggs + "</link></model>")),
      "w.sdf: collision 'm/c_906': the world's meshes have more than 2000000 triangles; use simpler ones");
}

TEST(SdfScan, IncludesThatMultiplyAreRefused) {
  const test::Folder folder;
  for (int i = 0; i < 7; ++i) {
    std::string includes;
    for (int k = 0; k < 100; ++k)
      includes += fmt::format("<include><uri>m{}.sdf</uri><name>{}</name></include>", i + 1, k);
    folder.write(fmt::format("m{}.sdf", i),
                 "<sdf version='1.7'><model name='m'>" + includes + "</model></sdf>");
  }
  folder.write("m7.sdf", "<sdf version='1.7'>" + model("m", "0 0 0 0 0 0", unit_box) + "</sdf>");
  const auto loaded = load_sdf((folder.path / "m0.sdf").string());
  ASSERT_FALSE(loaded);
  EXPECT_TRUE(loaded.error().sentence.starts_with("it has more than 20000 includes") ||
              loaded.error().sentence.starts_with("it has 2000"))
      << loaded.error().sentence;
}

TEST(SdfScan, AChainOfFramesIsAsLongAsItIs) {
  std::string frames = "<frame name='f0'><pose>0 0 1 0 0 0</pose></frame>";
  for (int i = 1; i < 50'000; ++i)
    frames +=
        fmt::format("<frame name='f{}'><pose relative_to='f{}'>0.001 0 0 0 0 0</pose></frame>", i, i - 1);
  const auto [world, warnings] = load(world_of(ground + "<model name='m'><pose relative_to='f49999'/>" +
                                               link("l", "0 0 0 0 0 0") + "</model>" + frames));
  expect_near(solid(world, "m").world_T_solid.position, {49.999, 0, 1}, 1e-9);
}

TEST(SdfScan, ThousandsOfEqualNamesAreNumberedQuickly) {
  std::string models;
  for (int i = 0; i < 6000; ++i) models += model("m", "0 0 0 0 0 0", unit_box);
  EXPECT_EQ(load(world_of(ground + models)).world.solids.back().name, "m_6000");
}

}  // namespace
}  // namespace outrider
