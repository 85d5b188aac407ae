#include "outrider/jobs/guard/scenario.hpp"

#include <gtest/gtest.h>

#include "support/cart.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

/// A plane with one box of 1 m about (0, 0).
const std::string one_box =
    "<sdf version='1.7'><world name='w'><model name='ground'><link name='l'><collision "
    "name='c'><geometry><plane/>"
    "</geometry></collision></link></model><model name='box'><pose>0 0 0.5 0 0 0</pose><link "
    "name='l'><collision "
    "name='c'><geometry><box><size>1 1 1</size></box></geometry></collision></link></model></world></sdf>";

Box2 bounds_of(const std::string& targets, const std::string& start, const std::string& bounds = "") {
  const test::Folder folder;
  GuardScenario scenario;
  scenario.world = folder.write("w.sdf", one_box);
  scenario.targets = folder.write("t.txt", targets);
  scenario.start = start;
  scenario.bounds = bounds;
  const auto loaded = load_problem(scenario);
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return scenario.problem.world.bounds;
}

TEST(GuardScenario, LeavesRoomAroundAStartAndTargetsOutsideOfWhatStands) {
  const Box2 far = bounds_of("type=1 x=3 y=0\n", "-1,0,0");
  EXPECT_EQ(far.low, (Vec2{-3, -2}));
  EXPECT_EQ(far.high, (Vec2{5, 2}));
  const Box2 on_top = bounds_of("type=1 x=0 y=0 z=1\n", "0,0.4,0");  // the disk does not fit into the box
  EXPECT_EQ(on_top.low, (Vec2{-2, -1.6}));
  EXPECT_EQ(on_top.high, (Vec2{2, 2.4}));
}

TEST(GuardScenario, TheSizeOfTheRobotMayComeFromItsFile) {
  const test::Folder folder;
  GuardScenario scenario;
  scenario.world = folder.write("w.sdf", one_box);
  scenario.targets = folder.write("t.txt", "type=1 x=3 y=0\n");
  scenario.start = "-2,0,0";
  scenario.robot_file.file = folder.write("cart.urdf", test::cart_urdf);
  const auto loaded = load_problem(scenario);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->empty());
  EXPECT_NEAR(scenario.problem.robot.radius_m, 0.3, 1e-9);
  EXPECT_NEAR(scenario.problem.robot.height_m, 0.4, 1e-9);
  scenario.robot_file.file = "none.urdf";
  EXPECT_EQ(load_problem(scenario).error().where, "none.urdf");
}

TEST(GuardScenario, LeavesWhatIsFarAwayOutside) {
  const Box2 bounds = bounds_of("type=1 x=0 y=0 z=1\n", "50,0,0");
  EXPECT_EQ(bounds.low, (Vec2{-0.5, -0.5}));
  EXPECT_EQ(bounds.high, (Vec2{0.5, 0.5}));
}

TEST(GuardScenario, TakesThePartOfALargeYardThatIsNearAndSaysSo) {
  const test::Folder folder;
  const std::string ocean =
      "<sdf version='1.7'><world name='w'><model name='ocean'><link name='l'><collision "
      "name='c'><geometry><plane><size>"
      "2000 2000</size></plane></geometry></collision></link></model></world></sdf>";
  GuardScenario scenario;
  scenario.world = folder.write("w.sdf", ocean);
  scenario.targets = folder.write("t.txt", "type=1 x=30 y=950\ntype=1 x=5000 y=0\n");
  scenario.start = "20,940,0";
  const auto loaded = load_problem(scenario);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(scenario.problem.world.bounds.low, (Vec2{-80, 840}));
  EXPECT_EQ(scenario.problem.world.bounds.high, (Vec2{130, 1000}));
  ASSERT_EQ(loaded->size(), 1U);
  EXPECT_NE((*loaded)[0].find("210 m by 160 m"), std::string::npos) << (*loaded)[0];
  scenario.bounds = "-1000,-1000,1000,1000";
  const auto whole = load_problem(scenario);
  ASSERT_TRUE(whole) << to_string(whole.error());
  EXPECT_EQ(scenario.problem.world.bounds.size(), (Vec2{2000, 2000}));
}

TEST(GuardScenario, KeepsBoundsThatAreGiven) {
  const Box2 given = bounds_of("type=1 x=3 y=0\n", "-1,0,0", "-2,-2,2,2");
  EXPECT_EQ(given.low, (Vec2{-2, -2}));
  EXPECT_EQ(given.high, (Vec2{2, 2}));
}

}  // namespace
}  // namespace outrider
