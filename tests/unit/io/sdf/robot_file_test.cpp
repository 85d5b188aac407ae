// Robots from URDF and SDF: outline, height and mounts, against poses composed by hand.
#include "outrider/io/sdf/robot_file.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "outrider/geometry/convex.hpp"
#include "sdf_solids.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

/// A body of 0.4 x 0.2 x 0.1 m on two wheels, with a laser on a mast that is turned by 90 degrees.
const std::string urdf =
    "<?xml version='1.0'?>\n<robot name='cart'>\n"
    "<link name='base_footprint'/>\n"
    "<link name='base_link'><collision><origin xyz='0.05 0 0'/><geometry><box size='0.4 0.2 "
    "0.1'/></geometry></collision>"
    "<collision name='bumper'><origin xyz='0.25 0 0' rpy='0 0 0'/><geometry><sphere "
    "radius='0.03'/></geometry></collision></link>\n"
    "<link name='left'><collision><geometry><cylinder radius='0.06' "
    "length='0.04'/></geometry></collision></link>\n"
    "<link name='mast'/><link name='laser'/>\n"
    "<joint name='base' type='fixed'><parent link='base_footprint'/><child link='base_link'/><origin xyz='0 "
    "0 0.08'/></joint>\n"
    "<joint name='wheel' type='continuous'><parent link='base_link'/><child link='left'/><origin xyz='0 0.15 "
    "-0.02' rpy='-1.5707963267948966 0 0'/><axis xyz='0 0 1'/></joint>\n"
    "<joint name='mast' type='fixed'><parent link='base_link'/><child link='mast'/><origin xyz='-0.1 0 0.2' "
    "rpy='0 0 1.5707963267948966'/></joint>\n"
    "<joint name='laser' type='fixed'><parent link='mast'/><child link='laser'/><origin xyz='0.05 0 "
    "0.1'/></joint>\n"
    "<gazebo reference='laser'><sensor type='ray'/></gazebo><transmission/></robot>\n";

TEST(RobotFile, OutlineAndMountsOfUrdf) {
  const test::Folder folder;
  const auto robot = load_robot(folder.write("cart.urdf", urdf));
  ASSERT_TRUE(robot) << to_string(robot.error());
  for (const std::string& warning : robot->warnings) ADD_FAILURE() << warning;
  EXPECT_NEAR(robot->radius_m, 0.28, 1e-12);  // the bumper: 0.25 m ahead and 0.03 m thick
  EXPECT_NEAR(robot->height_m, 0.13, 1e-12);  // from the wheel's 0 m to the top of the body
  const auto laser = mount(*robot, "laser", "laser.link");
  ASSERT_TRUE(laser) << to_string(laser.error());
  expect_near(laser->position, {-0.1, 0.05, 0.38});
  expect_near(laser->rotation.axes[0], {0, 1, 0});
  EXPECT_GE(robot->outline.size(), 5U);
  const auto inside = [&](Vec2 p) {
    for (std::size_t i = 0; i < robot->outline.size(); ++i) {
      const Vec2 a = robot->outline[i];
      if (cross(robot->outline[(i + 1) % robot->outline.size()] - a, p - a) < -1e-9) return false;
    }
    return true;
  };
  for (const Vec2 p :
       {Vec2{0.25, 0.1}, Vec2{-0.15, -0.1}, Vec2{0.28, 0}, Vec2{0.06, 0.17}, Vec2{-0.06, 0.17}})
    EXPECT_TRUE(inside(p)) << p.x << ' ' << p.y;
  for (const Vec2 p : {Vec2{0.29, 0}, Vec2{0, 0.18}, Vec2{-0.16, 0}, Vec2{0, -0.11}})
    EXPECT_FALSE(inside(p)) << p.x << ' ' << p.y;
}

TEST(RobotFile, SdfRobotsAreReadAlike) {
  const test::Folder folder;
  const auto robot =
      load_robot(folder.write("cart.sdf",
                              "<sdf version='1.9'><model name='cart'><pose>7 7 7 0 0 1</pose><link "
                              "name='body'><pose>0 0 0.3 0 0 0</pose><collision "
                              "name='c'><geometry><cylinder><radius>0.2</radius><length>0.4</length></"
                              "cylinder></geometry></collision></link><frame name='eye' "
                              "attached_to='body'><pose>0.1 0 0.05 0 0 0</pose></frame></model></sdf>"));
  ASSERT_TRUE(robot) << to_string(robot.error());
  EXPECT_NEAR(robot->radius_m, 0.2, 1e-3);
  EXPECT_NEAR(robot->height_m, 0.4, 1e-12);
  expect_near(robot->robot_T_frame.at("eye").position, {0.1, 0, 0.25});
}

TEST(RobotFile, RefusesWhatIsWrong) {
  const test::Folder folder;
  const auto fault_of = [&](const std::string& text) {
    const auto robot = load_robot(folder.write("r.urdf", text));
    return robot ? "none"
                 : robot.error().where.substr(folder.path.string().size()) + ": " + robot.error().sentence;
  };
  EXPECT_EQ(fault_of("<robot name='r'><link name='a'/></robot>"),
            "/r.urdf: the robot has no collisions; give it an outline");
  EXPECT_EQ(fault_of("<robot name='r'>\n<link name='a'><collision><geometry><box size='1 "
                     "1'/></geometry></collision></link></robot>"),
            "/r.urdf:2: '1 1' in a <size> is not 3 finite numbers");
  EXPECT_EQ(fault_of("<robot name='r'>\n<link name='a'><collision><origin xyz='0 x 0'/><geometry><box "
                     "size='1 1 1'/></geometry></collision></link></robot>"),
            "/r.urdf:2: 'x' in a <pose> is no finite number");
  const std::string circle =
      "<link name='a'><collision><geometry><sphere radius='1'/></geometry></collision></link>\n<link "
      "name='b'/>"
      "<joint name='j'><parent link='a'/><child link='b'/></joint><joint name='k'><parent link='b'/><child "
      "link='a'/></joint>";
  EXPECT_NE(
      fault_of("<robot name='r'>" + circle + "</robot>").find("hangs in the air: it is relative to itself"),
      std::string::npos);
  EXPECT_NE(fault_of("<robot name='r'>" + circle.substr(0, circle.find("<joint name='k'")) +
                     "<joint name='k'><parent link='c'/><child link='a'/></joint></robot>")
                .find("there is no frame 'c'"),
            std::string::npos);
  const auto robot = load_robot(folder.write("cart.urdf", urdf));
  ASSERT_TRUE(robot);
  EXPECT_EQ(mount(*robot, "lasr", "laser.link").error().sentence,
            "there is no link or frame 'lasr'; did you mean 'laser'?");
}

TEST(RobotFile, WorldsMayIncludeUrdf) {
  const test::Folder folder;
  folder.write("cart.urdf", urdf);
  const auto loaded = load_sdf(
      folder.write("w.sdf",
                   "<sdf version='1.7'><world "
                   "name='w'><include><uri>model://ground_plane</uri></include><include><uri>cart.urdf</"
                   "uri><pose>1 2 0 0 0 0</pose></include></world></sdf>"));
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  expect_near(solid(loaded->world, "cart/left").world_T_solid.position, {1, 2.15, 0.06});
}

}  // namespace
}  // namespace outrider
