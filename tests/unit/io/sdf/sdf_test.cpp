#include "outrider/io/sdf/sdf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "sdf_texts.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

// ---- Shapes and poses ----------------------------------------------------------------------------

TEST(Sdf, ShapesKeepTheirMeasures) {
  const auto [world, warnings] = load(world_of(
      ground + model("a", "1 2 0.5 0 0 0", "<box><size>1 2 3</size></box>") +
      model("b", "4 2 1 0 0 0", "<cylinder><radius>0.5</radius><length>2</length></cylinder>") +
      model("c", "-4 2 1 0 0 0", "<sphere><radius>0.25</radius></sphere>") + "<gravity>0 0 -3.7</gravity>"));
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(world.solids.size(), 4U);
  EXPECT_EQ(world.name, "w");
  EXPECT_EQ(world.gravity_mps2, 3.7);
  EXPECT_EQ(world.floor_z_m, 0.0);
  EXPECT_EQ(std::get<BoxShape>(solid(world, "a").shape).half_size, (Vec3{0.5, 1, 1.5}));
  EXPECT_EQ(std::get<CylinderShape>(solid(world, "b").shape).half_length_m, 1.0);
  EXPECT_EQ(std::get<SphereShape>(solid(world, "c").shape).radius_m, 0.25);
  EXPECT_TRUE(std::holds_alternative<HalfSpaceShape>(solid(world, "ground").shape));
  EXPECT_EQ(world.bounds.low, (Vec2{-4.25, 1}));
  EXPECT_EQ(world.bounds.high, (Vec2{4.5, 3}));
}

TEST(Sdf, GravityIsEarthsWhenTheFileIsSilentAndMayStandInOldPhysics) {
  EXPECT_EQ(load(world_of(ground)).world.gravity_mps2, 9.8);
  const std::string physics =
      "<physics type='ode'><gravity>0 0 -1.5</gravity><max_step_size>x</max_step_size></physics>";
  EXPECT_EQ(load(world_of(ground + physics, "1.5")).world.gravity_mps2, 1.5);
}

TEST(Sdf, PosesComposeThroughModelLinkAndCollision) {
  const double quarter = std::numbers::pi / 2;
  const auto [world, warnings] = load(world_of(
      ground +
      "<model name='m'><pose>10 0 0 0 0 1.5707963267948966</pose><model name='n'><pose>1 0 0 0 0 0</pose>"
      "<link name='l'><pose>0 1 0 0 0 1.5707963267948966</pose><collision name='c'><pose>0 0 2 0.1 0.2 "
      "0.3</pose>"
      "<geometry>" +
      unit_box + "</geometry></collision></link></model></model>"));
  const Pose3 expected = Pose3{{10, 0, 0}, Rotation::from_rpy(0, 0, quarter)} * Pose3{{1, 0, 0}, {}} *
                         Pose3{{0, 1, 0}, Rotation::from_rpy(0, 0, quarter)} *
                         Pose3{{0, 0, 2}, Rotation::from_rpy(0.1, 0.2, 0.3)};
  const Pose3 got = solid(world, "m/n").world_T_solid;
  expect_near(got.position, expected.position);
  for (std::size_t i = 0; i < 3; ++i) expect_near(got.rotation.axes[i], expected.rotation.axes[i]);
}

TEST(Sdf, FramesOfNewerVersionsAreResolved) {
  const auto [world, warnings] = load(
      world_of(ground +
                   "<frame name='f'><pose>5 0 0 0 0 1.5707963267948966</pose></frame>"
                   "<model name='m'><pose relative_to='f'>1 0 0.5 0 0 0</pose><link name='a'><pose>0 0 1 0 0 "
                   "0</pose></link>"
                   "<joint name='j' type='fixed'><parent>a</parent><child>b</child><pose relative_to='a'>0 0 "
                   "1 0 0 0</pose></joint>"
                   "<joint name='unused' type='revolute'><child>nothing</child></joint>"
                   "<link name='b'><pose relative_to='j'>0 0 1 0 0 0</pose><collision name='c'><geometry>" +
                   unit_box + "</geometry></collision></link></model>",
               "1.8"));
  expect_near(solid(world, "m").world_T_solid.position, {5, 1, 3.5});
}

TEST(Sdf, PlanesOfAnyDirectionAreHalfSpaces) {
  const auto [world, warnings] =
      load(world_of(ground + model("wall", "3 0 0 0 0 0", "<plane><normal>-1 0 0</normal></plane>") +
                    model("ramp", "0 0 -1 0 0.2 0", "<plane/>")));
  EXPECT_EQ(world.floor_z_m, 0.0);
  EXPECT_EQ(distance({2, 5, 1}, solid(world, "wall")), 1.0);
  EXPECT_EQ(distance({4, 5, 1}, solid(world, "wall")), 0.0);
  expect_near(solid(world, "ramp").world_T_solid.rotation.axes[2], {std::sin(0.2), 0, std::cos(0.2)});
}

TEST(Sdf, CapsulesAndEllipsoidsAreCovered) {
  const auto [world, warnings] = load(world_of(
      ground + model("pill", "0 0 1 0 0 0", "<capsule><radius>0.2</radius><length>1</length></capsule>") +
          model("egg", "5 0 1 0 0 0.4", "<ellipsoid><radii>0.6 0.3 0.9</radii></ellipsoid>"),
      "1.9"));
  const auto pill = [&](Vec3 p) {
    return std::min({distance(p, solid(world, "pill")), distance(p, solid(world, "pill_top")),
                     distance(p, solid(world, "pill_bottom"))});
  };
  EXPECT_NEAR(pill({0, 0, 2}), 0.3, 1e-12);
  EXPECT_NEAR(pill({1, 0, 1}), 0.8, 1e-12);
  const auto& mesh = std::get<MeshShape>(solid(world, "egg").shape);
  for (const auto& triangle : mesh.triangles) {  // no face cuts into it, no corner stands 1 % outside
    const auto unit = [](Vec3 p) { return Vec3{p.x / 0.6, p.y / 0.3, p.z / 0.9}; };
    const Vec3 a = unit(triangle[0]);
    const Vec3 normal = cross(unit(triangle[1]) - a, unit(triangle[2]) - a);
    EXPECT_GE(std::abs(dot(normal, a)) / norm(normal), 1.0 - 1e-12);
    for (const Vec3 p : triangle) EXPECT_LE(norm(unit(p)), 1.01);
  }
}

TEST(Sdf, MeshesAreFoundScaledAndMissedByName) {
  const test::Folder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("worlds/meshes/a.obj", triangle);
  folder.write("models/tree/b.obj", triangle);
  folder.write("far/rock/c.obj", triangle);
  const auto mesh = [](const std::string& uri) {
    return "<mesh><uri>" + uri + "</uri><scale>2 3 4</scale></mesh>";
  };
  const std::string path = folder.write(
      "worlds/w.sdf", world_of(ground + model("plain", "0 0 1 0 0 0", mesh("meshes/a.obj")) +
                               model("absolute", "0 0 1 0 0 0",
                                     mesh("file://" + (folder.path / "worlds/meshes/a.obj").string())) +
                               model("tree", "0 0 1 0 0 0", mesh("model://tree/b.obj")) +
                               model("rock", "0 0 1 0 0 0", mesh("model://rock/c.obj")) +
                               model("lost", "0 0 1 0 0 0", mesh("model://lost/d.dae"))));
  const auto loaded =
      load_sdf(path, {(folder.path / "worlds").string() + ":" + (folder.path / "far").string()});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_EQ(loaded->world.solids.size(), 5U);
  for (const char* name : {"plain", "absolute", "tree", "rock"}) {
    const auto& triangles = std::get<MeshShape>(solid(loaded->world, name).shape).triangles;
    ASSERT_EQ(triangles.size(), 1U);
    EXPECT_EQ(triangles[0][2], (Vec3{0, 3, 0}));
  }
  ASSERT_EQ(loaded->warnings.size(), 1U);
  EXPECT_EQ(loaded->warnings[0],
            path +
                ":8: the mesh 'model://lost/d.dae' of collision 'lost/link/c' was not found, "
                "so the collision was left out");
  folder.write("worlds/meshes/a.obj", "v 0 0 nan\n");
  const auto broken = load_sdf(path);
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().sentence.find("collision 'plain': "), std::string::npos)
      << broken.error().sentence;
}

// ---- Includes ------------------------------------------------------------------------------------

TEST(Sdf, IncludesAreExpandedInPlace) {
  const test::Folder folder;
  const std::string tree =
      "<sdf version='1.6'><model name='tree'><pose>9 9 9 0 0 0</pose>"
      "<link name='trunk'><collision name='c'><pose>0 0 1</pose><geometry>" +
      unit_box + "</geometry></collision></link></model></sdf>";
  folder.write("models/tree/model.sdf", tree);
  folder.write("models/tree/model.config",
               "<model><name>Tree</name><sdf version='1.6'>model.sdf</sdf></model>");
  folder.write("bush.sdf", tree);
  const std::string path = folder.write(
      "w.sdf",
      world_of(ground + "<include><uri>model://tree</uri></include>\n"
                        "<include><uri>model://tree</uri><name>oak</name><pose>1 2 0 0 0 0</pose></include>\n"
                        "<include><uri>bush.sdf</uri><pose>-1 -2 0 0 0 0</pose></include>\n"
                        "<include><uri>model://sun</uri></include>\n"
                        "<include><uri>model://shed</uri></include>\n"));
  const auto loaded = load_sdf(path);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  expect_near(solid(loaded->world, "tree").world_T_solid.position, {9, 9, 10});
  expect_near(solid(loaded->world, "oak").world_T_solid.position, {1, 2, 1});
  expect_near(solid(loaded->world, "tree_2").world_T_solid.position, {-1, -2, 1});
  ASSERT_EQ(loaded->warnings.size(), 3U);
  EXPECT_NE(loaded->warnings[0].find("model.sdf:1: a <pose> of three numbers"), std::string::npos);
  EXPECT_NE(loaded->warnings[1].find("names its sibling has too"), std::string::npos);
  EXPECT_EQ(loaded->warnings[2],
            path +
                ":8: the include of 'model://shed' was not found and was left out; give the folder that has "
                "'shed' as model_path");
}

TEST(Sdf, IncludesInACircleAreRefused) {
  const test::Folder folder;
  const std::string path = folder.write(
      "a.sdf", "<sdf version='1.7'><model name='a'><include><uri>a.sdf</uri></include></model></sdf>");
  const auto loaded = load_sdf(path);
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().sentence.find("in a circle"), std::string::npos) << to_string(loaded.error());
}

// ---- Repairs -------------------------------------------------------------------------------------

TEST(Sdf, RepairsAreCountedAndNameTheirFirstLine) {
  const auto [world, warnings] = load(
      world_of("<state world_name='default'>\n<sim_time>0</sim_time><real_time>0</real_time>\n<wall_time>1 "
               "2</wall_time></state>\n" +
               ground + model("a", "1 2 3", "<mesh><uri>no.dae</uri></mesh>" + unit_box) +
               model("a", "4 5 6", unit_box) + model("x::y", "0 0 1 0 0 0", unit_box) +
               "<xacro:if value='1'/><population name='p'/><model name='empty'/>"
               "<light name='l' type='nonsense'><pose>broken</pose></light>"));
  EXPECT_EQ(
      warnings,
      (std::vector<std::string>{
          "w.sdf:4: a time in <state> is not seconds and nanoseconds and was left out (2 times, first here)",
          "w.sdf:7: a <pose> of three numbers was read as a place without a rotation (2 times, first here)",
          "w.sdf:7: a <geometry> has several shapes; its <box> was kept",
          "w.sdf:8: <model> names its sibling has too got a number",
          "w.sdf:9: '::' in a name was replaced by '_'", "w.sdf:10: a left-over <xacro:if> was left out",
          "w.sdf:10: a <population> was left out; place its models one by one"}));
  expect_near(solid(world, "a").world_T_solid.position, {1, 2, 3});
  expect_near(solid(world, "a_2").world_T_solid.position, {4, 5, 6});
  EXPECT_EQ(world.solids.size(), 4U);
}

TEST(Sdf, StateWinsOverModelPoses) {
  const auto [world, warnings] = load(world_of(
      ground + model("a", "1 0 0 0 0 0", unit_box) +
      "<model name='m'><model name='n'><link name='l'><collision name='c'><geometry>" + unit_box +
      "</geometry></collision></link></model></model>"
      "<state world_name='w'><sim_time>1 2</sim_time><model name='a'><pose>7 8 9 0 0 0</pose></model>"
      "<model name='m'><pose>1 1 1 0 0 0</pose><model name='n'><pose>2 2 2 0 0 0</pose>"
      "<link name='l'><pose>3 3 3 0 0 0</pose></link></model></model><model><pose>5 5 5 0 0 "
      "0</pose></model><model name='ghost'><pose>0 0 0 0 0 "
      "0</pose></model>"
      "</state>"));
  EXPECT_TRUE(warnings.empty());
  expect_near(solid(world, "a").world_T_solid.position, {7, 8, 9});
  expect_near(solid(world, "m/n").world_T_solid.position, {3, 3, 3});
}

TEST(Sdf, NewerVersionsAndBareModelsAreReadWithAWarning) {
  for (const char* version : {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9", "1.10", "1.11", "1.12"})
    EXPECT_TRUE(load(world_of(ground, version)).warnings.empty()) << version;
  EXPECT_EQ(load(world_of(ground, "1.13")).warnings,
            (std::vector<std::string>{"w.sdf:2: SDF version 1.13 was read as 1.12"}));
  EXPECT_EQ(
      load(world_of(ground, "new")).warnings,
      (std::vector<std::string>{"w.sdf:2: a missing or unreadable version of <sdf> was taken for 1.6"}));
  const auto [world, warnings] = load("<sdf version='1.7'>" + model("a", "0 0 1 0 0 0", unit_box) +
                                      model("b", "3 0 1 0 0 0", unit_box) + "</sdf>");
  ASSERT_EQ(world.solids.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<HalfSpaceShape>(solid(world, "floor").shape));
  EXPECT_EQ(warnings,
            (std::vector<std::string>{
                "w.sdf:1: there is no <world>; its models were put into one, on a floor at z = 0"}));
}

TEST(Sdf, UnmodelledShapesAreNamed) {
  const auto [world, warnings] =
      load(world_of(ground + model("line", "0 0 0 0 0 0", "<polyline><height>1</height></polyline>") +
                    model("picture", "0 0 0 0 0 0", "<image><uri>a.png</uri></image>")));
  EXPECT_EQ(world.solids.size(), 1U);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{
                "w.sdf:5: collision 'picture/link/c' is a <image>, which is not modelled; it was left out",
                "w.sdf:4: a polyline that encloses nothing was left out"}));
}

// ---- Names ------------------------------------------------------------------------

TEST(Sdf, ReservedNamesGetANumber) {
  const auto [world, warnings] =
      load("<sdf version='1.7'><world name='world'>\n" + ground + model("world", "0 0 1 0 0 0", unit_box) +
           model("__a__", "4 0 1 0 0 0", unit_box) + "</world></sdf>");
  EXPECT_EQ(world.name, "world_1");
  EXPECT_EQ(solid(world, "world_1").world_T_solid.position, (Vec3{0, 0, 1}));
  EXPECT_EQ(solid(world, "__a___1").world_T_solid.position, (Vec3{4, 0, 1}));
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0], "w.sdf:1: the name 'world' is reserved and became 'world_1' (2 times, first here)");
}

TEST(Sdf, BoundsOfAnEmptyYardAreTheFloors) {
  EXPECT_EQ(load(world_of(ground)).world.bounds.size(), (Vec2{30, 40}));
  EXPECT_EQ(
      load(world_of(model("p", "1 0 0 0 0 0", "<plane><normal>0 0 1</normal><size>0.1 0.1</size></plane>")))
          .world.bounds.low,
      (Vec2{-9, -10}));
}

TEST(Sdf, NamesSayWhatDistinguishesAndAreUnique) {
  const std::string g = "<geometry>" + unit_box + "</geometry></collision>";
  const auto [world, warnings] = load(world_of(
      ground + "<model name='table'><link name='link'><collision name='plate'>" + g +
      "<collision name='leg'>" + g +
      "</link></model><model name='yard'><link name='left'><collision name='left_1'>" + g +
      "<collision name='1'>" + g + "</link><link name='right'><collision name='c'>" + g + "</link></model>"));
  std::vector<std::string> names;
  for (const Solid& one : world.solids) names.push_back(one.name);
  EXPECT_EQ(names, (std::vector<std::string>{"ground", "table/plate", "table/leg", "yard/left/1",
                                             "yard/left/1_2", "yard/right"}));
}

// ---- Wrong files ---------------------------------------------------------------------------------

TEST(Sdf, RefusesWhatIsWrong) {
  EXPECT_EQ(load_sdf("/no/such.sdf").error().where, "/no/such.sdf");
  EXPECT_TRUE(sdf_fault(world_of(ground + "<model name='a'>")).starts_with("w.sdf:")) << sdf_fault("<sdf");
  EXPECT_EQ(sdf_fault("<gazebo/>"), "w.sdf: its root element is <gazebo>, not <sdf>");
  EXPECT_EQ(sdf_fault(world_of(ground + model("a", "0 nan 0 0 0 0", unit_box))),
            "w.sdf:4: 'nan' in a <pose> is no finite number");
  EXPECT_EQ(sdf_fault(world_of(ground + model("a", "0 0 0 0", unit_box))),
            "w.sdf:4: a <pose> has 4 numbers; expected x y z roll pitch yaw");
  EXPECT_EQ(sdf_fault(world_of(ground + model("a", "0 2e6 0 0 0 0", unit_box))),
            "w.sdf: collision 'a' stands beyond 1e6 m, or nowhere; correct its <pose>");
  for (const char* size : {"1 1 0", "1 -1 1", "1 1 1e7"}) {
    EXPECT_EQ(sdf_fault(world_of(
                  ground + model("a", "0 0 1 0 0 0", "<box><size>" + std::string(size) + "</size></box>"))),
              "w.sdf: collision 'a': its size is not above 0 and at most 1e6 m; correct it");
  }
  for (const std::string& text :
       {world_of(""), world_of(ground + "<gravity>0 1 -9.8</gravity>"),
        world_of(ground + "<gravity>0 0 9.8</gravity>"), world_of(ground + "<gravity>0 0 nan</gravity>"),
        world_of(ground + "<gravity>0 0 0</gravity>"),
        world_of(ground + model("a", "0 0 1 0 0 0", "<box><size>a b c</size></box>")),
        world_of(ground + model("a", "0 0 1 0 0 0", "<box><size>1 1 inf</size></box>")),
        world_of(ground +
                 model("a", "0 0 1 0 0 0", "<cylinder><radius>-1</radius><length>1</length></cylinder>")),
        world_of(ground + model("a", "0 0 1 0 0 0", "<sphere><radius>nan</radius></sphere>")),
        world_of(ground + model("a", "0 0 1 0 0 0", "<plane><normal>0 0 0</normal></plane>")),
        world_of(ground +
                 "<model name='m'><pose relative_to='nothing'>0 0 0 0 0 0</pose><link name='l'><collision "
                 "name='c'><geometry>" +
                 unit_box + "</geometry></collision></link></model>"),
        std::string(), std::string("<sdf version='1.7'/>"),
        std::string("<sdf version='1.7'><world name='w'/></sdf>")}) {
    EXPECT_TRUE(sdf_fault(text).starts_with("w.sdf")) << text << " -> " << sdf_fault(text);
  }
}

TEST(Sdf, NothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  (void)sdf_fault(world_of(ground + model("a", "0 0 1 0 0 0", "<box><size>a b c</size></box>")));
  (void)sdf_fault("<sdf version='1.7'><model/></sdf>");
  (void)load(world_of(ground));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(Sdf, SurvivesDamage) {
  Rng rng(9);
  const std::string good =
      world_of(ground +
               "<model name='m'><pose>1 2 3</pose><link name='l'><pose>0 1 0 0 0 1</pose>"
               "<collision name='c'><pose>0 0 2 0.1 0.2 0.3</pose><geometry>" +
               unit_box +
               "</geometry></collision></link>"
               "</model><state world_name='w'><sim_time>0</sim_time><model name='m'><pose>1 0 0 0 0 "
               "0</pose></model></state>");
  ASSERT_EQ(sdf_fault(good), "none");
  int loaded_count = 0;
  for (int i = 0; i < 2000 && loaded_count < 12; ++i) {
    const auto loaded = sdf_from_text(test::damaged(good, rng), "w.sdf");
    if (!loaded) continue;
    ++loaded_count;
    for (const Solid& one : loaded->world.solids) EXPECT_LE(std::abs(one.world_T_solid.position.z), 1e6);
  }
  EXPECT_EQ(loaded_count, 12);
}

// ---- Published worlds ----------------------------------------------------------------------------

}  // namespace
}  // namespace outrider
