// The contract of localisers: the same answers again, finite whatever they are shown, and a sentence for a
// beginning that makes no sense.
#include "outrider/navigate/robot_localiser.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "outrider/core/rng.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/sim/sensors/simulated_tag_camera.hpp"
#include "support/building.hpp"

namespace outrider {
namespace {

const std::vector<std::string> one_room = {
    "############", "#          #", "#    ##    #", "#          #", "#  #       #", "############",
};
constexpr Pose2 start{{1.0, 1.0}, 0.3};

TagMap two_tags() {
  return {{upright_tag(1, {5.4, 1.5, 0.3}, pi), upright_tag(2, {3.0, 2.4, 0.3}, -0.5 * pi)}};
}

World hall_ground() {
  World world;
  world.bounds = {{0.0, 0.0}, {6.0, 3.0}};
  return world;
}

RobotCamera camera() { return {{}, looking_ahead({0.05, 0.0, 0.2})}; }

LocaliserStart beginning() {
  return {start, {}, test::building(one_room, 0.5, 5).map, TagsInSight{two_tags(), camera()}};
}

std::unique_ptr<RobotLocaliser> made(const std::string& name, LocaliserStart from = beginning()) {
  auto localiser = find_row(robot_localisers(), "localiser", name, "")->make(std::move(from));
  EXPECT_TRUE(localiser) << localiser.error().sentence;
  return std::move(*localiser);
}

/// A scan of a square room of 4 m about the robot.
LaserScan scan_at(double time_s) {
  LaserScan scan;
  scan.time_s = time_s;
  scan.first_rad = -pi;
  scan.step_rad = 2.0 * pi / 180.0;
  scan.least_m = 0.05;
  scan.most_m = 8.0;
  for (int i = 0; i < 180; ++i) {
    const Vec2 along = direction(-pi + i * scan.step_rad);
    scan.ranges_m.push_back(static_cast<float>(2.0 / std::max(std::abs(along.x), std::abs(along.y))));
  }
  return scan;
}

/// The sensors of a robot that goes ahead, some of which say nonsense.
Pose2 after_a_drive(RobotLocaliser& localiser, bool nonsense) {
  SimulatedTagCamera eye({hall_ground(), two_tags()}, camera(), {}, {}, false, Rng(4));
  Pose2 odometry;
  for (int i = 0; i < 30; ++i) {
    const double time_s = 0.1 * (i + 1);
    odometry = compose(odometry, {{0.03, 0.0}, 0.01});
    eye.take(compose(start, odometry), {0.3, 0.0, 0.1}, time_s);
    LaserScan scan = scan_at(time_s);
    TagImage image = eye.newest(time_s).value_or(TagImage{});
    if (nonsense && i % 3 == 1) {
      scan.ranges_m[7] = std::numeric_limits<float>::quiet_NaN();
      scan.ranges_m[8] = std::numeric_limits<float>::infinity();
      TagSighting strange;
      strange.id = 1000 + i;
      image.sightings.push_back(strange);
      strange.id = 1;  // without a pose
      image.sightings.push_back(strange);
    }
    localiser.take(scan, odometry);
    localiser.see(image, odometry);
    const Pose2 pose = compose(localiser.world_T_odometry(), odometry);
    EXPECT_TRUE(finite(pose));
    EXPECT_TRUE(localiser.covariance().allFinite());
  }
  return localiser.world_T_odometry();
}

class EachLocaliser : public ::testing::TestWithParam<std::string> {};

TEST_P(EachLocaliser, BeginsWhereItIsTold) {
  const auto localiser = made(GetParam());
  EXPECT_TRUE(localiser->is_located());
  EXPECT_TRUE(localiser->lost().empty());
  EXPECT_LT(distance(localiser->world_T_odometry().position, start.position), 1e-9);
}

TEST_P(EachLocaliser, GivesTheSameAnswersAgain) {
  for (const bool nonsense : {false, true}) {
    const auto one = made(GetParam()), other = made(GetParam());
    EXPECT_EQ(after_a_drive(*one, nonsense), after_a_drive(*other, nonsense));
  }
}

TEST_P(EachLocaliser, RefusesABeginningThatMakesNoSense) {
  const auto row = find_row(robot_localisers(), "localiser", GetParam(), "");
  LocaliserStart odd = beginning();
  odd.pose = Pose2{{std::nan(""), 0.0}, 0.0};
  const auto refused = row->make(odd);
  ASSERT_FALSE(refused);
  EXPECT_FALSE(refused.error().sentence.empty());
  const auto without = row->make({std::nullopt, {}, {}, {}});
  ASSERT_FALSE(without);
  EXPECT_FALSE(without.error().sentence.empty());
}

INSTANTIATE_TEST_SUITE_P(RobotLocalisers, EachLocaliser, ::testing::ValuesIn(names_of(robot_localisers())),
                         [](const auto& info) { return std::string(info.param); });

// ---- Tags ----------------------------------------------------------------------------------------

/// Drives in a circle through a hall with tags, by an odometry that counts 5 % too much; returns the largest
/// error of the position once it knows where it is.
double largest_error(RobotLocaliser& localiser, Pose2 truth, double carried_m = 0.0) {
  TagMap tags = two_tags();
  tags.tags.push_back(upright_tag(3, {0.1, 1.0, 0.3}, 0.0));
  tags.tags.push_back(upright_tag(4, {3.0, 0.1, 0.3}, 0.5 * pi));
  SimulatedTagCamera eye({hall_ground(), tags}, camera(), {}, {}, false, Rng(9));
  Pose2 odometry;
  double worst_m = 0.0, found_s = -1.0;
  for (double time_s = 0.1; time_s < 40.0; time_s += 0.1) {
    const Twist2 twist{0.2, 0.0, 0.4};
    truth = moved(truth, twist, 0.1);
    odometry = moved(odometry, {1.05 * 0.2, 0.0, 1.02 * 0.4}, 0.1);
    if (carried_m > 0.0 && std::abs(time_s - 20.0) < 0.05) truth.position.x += carried_m;
    eye.take(truth, twist, time_s);
    if (const auto& image = eye.newest(time_s)) localiser.see(*image, odometry);
    if (!localiser.is_located()) continue;
    if (found_s < 0.0) found_s = time_s;
    const bool settles = carried_m > 0.0 && time_s > 20.0 && time_s < 36.0;
    const double off_m = distance(compose(localiser.world_T_odometry(), odometry).position, truth.position);
    if (!settles) worst_m = std::max(worst_m, off_m);
  }
  EXPECT_GE(found_s, 0.0);
  return worst_m;
}

TagsInSight four_tags() {
  TagsInSight view{two_tags(), camera()};
  view.map.tags.push_back(upright_tag(3, {0.1, 1.0, 0.3}, 0.0));
  view.map.tags.push_back(upright_tag(4, {3.0, 0.1, 0.3}, 0.5 * pi));
  return view;
}

TEST(TagLocaliser, MakesUpForTheErrorsOfOdometry) {
  const auto told = made("tags", {start, {}, {}, four_tags()});
  EXPECT_LT(largest_error(*told, start), 0.1);
  const auto anywhere = made("tags", {std::nullopt, {}, {}, four_tags()});
  EXPECT_FALSE(anywhere->is_located());
  EXPECT_LT(largest_error(*anywhere, start), 0.1);
}

TEST(TagLocaliser, FindsARobotThatWasCarriedAway) {
  const auto localiser = made("tags", {start, {}, {}, four_tags()});
  EXPECT_LT(largest_error(*localiser, start, 0.6), 0.1);
}

TEST(TagLocaliser, SaysThatItIsLostWithoutTags) {
  const auto localiser = made("tags", {start, {}, {}, four_tags()});
  Pose2 odometry;
  for (int i = 0; i < 4000 && localiser->lost().empty(); ++i) {
    odometry.position.x += 0.1;
    localiser->see({0.1 * i, {}}, odometry);
  }
  EXPECT_NE(localiser->lost().find("no tag"), std::string::npos);
}

TEST(TagLocaliser, ANavigatorThatSeesNoTagSaysThatItIsLost) {
  NavigatorSetup setup;
  setup.options.localiser = "tags";
  setup.tags = four_tags();
  auto navigator = Navigator::make(setup, start);
  ASSERT_TRUE(navigator) << navigator.error().sentence;
  Observation seen;
  Progress progress;
  for (int i = 0; i < 4000 && progress.state == Progress::State::underway; ++i) {
    seen.time_s = 0.1 * i;
    seen.odometry.position.x = 0.02 * i;
    seen.image = TagImage{seen.time_s, {}};
    seen.scan = scan_at(seen.time_s);
    progress = navigator->perceive(seen).progress;
    navigator->act(GoTo{{5.0, 1.5}, 0.15});
  }
  EXPECT_EQ(progress.state, Progress::State::lost);
  EXPECT_NE(progress.why.find("no tag"), std::string::npos) << progress.why;
}

}  // namespace
}  // namespace outrider
