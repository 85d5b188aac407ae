#include "outrider/estimate/localise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

const RobotCamera mount{Camera{}, looking_ahead({0.05, 0.0, 0.15})};
const Camera& camera = mount.camera;
const TagMap arena{{upright_tag(1, {2.0, 1.0, 0.25}, pi), upright_tag(2, {1.0, 2.5, 0.2}, -pi / 2),
                    upright_tag(3, {0.0, 2.0, 0.3}, -pi / 4), upright_tag(4, {2.0, 0.2, 0.2}, pi)}};

Pose3 in_space(const Pose2& pose) {
  return {{pose.position.x, pose.position.y, 0.0}, Rotation::from_rpy(0, 0, pose.heading_rad)};
}

/// Returns what the robot sees of the tag, with noise on its corners; nothing when it is not in the picture.
std::optional<TagSighting> sight(const Pose2& robot, const Tag& tag, double sigma_px, Rng& rng) {
  const Pose3 world_T_camera = in_space(robot) * mount.robot_T_camera;
  TagSighting sighting{tag.id, {}, 0, 100.0, {}};
  const auto corners = tag_corners(tag.size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto p = project(camera, world_T_camera.to_local(tag.world_T_tag * corners[i]));
    if (!p || p->x < 0 || p->y < 0 || p->x > camera.width_px || p->y > camera.height_px) return std::nullopt;
    sighting.corners_px[i] = *p + sigma_px * Vec2{rng.normal(), rng.normal()};
  }
  sighting.poses = planar_pnp(camera, tag.size_m, sighting.corners_px, {0.3, 10.0});
  if (sighting.poses.empty()) return std::nullopt;
  return sighting;
}

std::vector<TagSighting> sight_all(const Pose2& robot, const TagMap& map, double sigma_px, Rng& rng) {
  std::vector<TagSighting> all;
  for (const Tag& tag : map.tags) {
    if (auto sighting = sight(robot, tag, sigma_px, rng)) all.push_back(*sighting);
  }
  return all;
}

Pose2 random_robot(Rng& rng) {
  return {{rng.uniform(-0.2, 1.2), rng.uniform(-0.4, 1.2)}, rng.uniform(0.0, pi / 2)};
}

Eigen::Matrix3d round(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

/// The rule of the report on waypoints, for comparison: the first solution of each known tag, weighed by the
/// inverse of the distance to the tag. Nothing when no tag is known.
std::optional<Pose2> average_by_inverse_distance(std::span<const TagSighting> sightings, const TagMap& map,
                                                 const RobotCamera& robot_camera) {
  Vec2 position, heading;
  double weights = 0.0;
  for (const TagSighting& sighting : sightings) {
    const Tag* tag = map.find(sighting.id);
    if (tag == nullptr || sighting.poses.empty()) continue;
    const Pose3 robot_T_tag = robot_camera.robot_T_camera * sighting.poses.front().camera_T_tag;
    const auto to_world = [&](Vec3 v) {
      return tag->world_T_tag.rotation * robot_T_tag.rotation.unrotate(v);
    };
    const double weight = 1.0 / norm(sighting.poses.front().camera_T_tag.position);
    const Vec2 ahead = xy(to_world({1, 0, 0}));
    position = position + weight * xy(tag->world_T_tag.position - to_world(robot_T_tag.position));
    heading = heading + (weight / norm(ahead)) * ahead;
    weights += weight;
  }
  if (weights == 0.0) return std::nullopt;
  return Pose2{(1.0 / weights) * position, heading_of(heading)};
}

/// Gauss by hand, for a distance that shares nothing with the library.
double squared_distance(const Pose2& truth, const PoseBelief& belief) {
  std::array<std::array<double, 3>, 3> a{};
  for (int i = 0; i < 9; ++i)
    a[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)] = belief.covariance(i / 3, i % 3);
  const Pose2& mean = belief.world_T_robot;
  std::array<double, 3> d{truth.position.x - mean.position.x, truth.position.y - mean.position.y,
                          wrap_angle(truth.heading_rad - mean.heading_rad)};
  const std::array<double, 3> e = d;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t r = k + 1; r < 3; ++r) {
      const double f = a[r][k] / a[k][k];
      for (std::size_t c = k; c < 3; ++c) a[r][c] -= f * a[k][c];
      d[r] -= f * d[k];
    }
  }
  double sum = 0.0;
  std::array<double, 3> x{};
  for (std::size_t k = 3; k-- > 0;) {
    x[k] = d[k];
    for (std::size_t c = k + 1; c < 3; ++c) x[k] -= a[k][c] * x[c];
    x[k] /= a[k][k];
    sum += x[k] * e[k];
  }
  return sum;
}

/// The tag's turn about the upright axis of the camera.
double yaw_of(const TagPose& pose) {
  const Vec3 into_tag = pose.camera_T_tag.rotation.axes[2];
  return std::atan2(into_tag.x, into_tag.z);
}

TEST(Localise, ExactCornersGiveTheExactPlace) {
  Rng rng(21);
  for (int i = 0; i < testing::cases(100); ++i) {
    const Pose2 truth = random_robot(rng);
    const auto sightings = sight_all(truth, arena, 0.0, rng);
    const TagFix fix = localise(sightings, arena, mount, PoseBelief{truth, round(0.05, 0.05)});
    ASSERT_EQ(fix.verdicts.size(), sightings.size());
    ASSERT_EQ(fix.belief.has_value(), !sightings.empty());
    if (!fix.belief) continue;
    EXPECT_LT(distance(fix.belief->world_T_robot.position, truth.position), 1e-6);
    EXPECT_NEAR(wrap_angle(fix.belief->world_T_robot.heading_rad - truth.heading_rad), 0.0, 1e-6);
    const auto average = average_by_inverse_distance(sightings, arena, mount);
    ASSERT_TRUE(average);
    EXPECT_LT(distance(average->position, truth.position), 1e-6);
  }
}

TEST(Localise, SaysHowSureItIs) {
  Rng rng(22);
  LocaliseOptions options;
  options.tag_sigma_m = 0.0;
  double sum = 0.0, error = 0.0, of_average = 0.0;
  int fixes = 0, far = 0;
  const int trials = testing::cases(1500);
  for (int i = 0; i < trials; ++i) {
    const Pose2 truth = random_robot(rng);
    const auto sightings = sight_all(truth, arena, 0.2, rng);
    const Pose2 guess{truth.position + Vec2{0.05 * rng.normal(), 0.05 * rng.normal()},
                      truth.heading_rad + 0.05 * rng.normal()};
    const TagFix fix = localise(sightings, arena, mount, PoseBelief{guess, round(0.05, 0.05)}, options);
    if (!fix.belief) continue;
    const double d = squared_distance(truth, *fix.belief);
    sum += std::min(d, 30.0);
    far += d > 16.27 ? 1 : 0;
    ++fixes;
    if (sightings.size() < 2) continue;
    error += squared_norm(fix.belief->world_T_robot.position - truth.position);
    of_average +=
        squared_norm(average_by_inverse_distance(sightings, arena, mount)->position - truth.position);
  }
  ASSERT_GT(fixes, trials * 9 / 10);
  EXPECT_GT(sum / fixes, 2.0);
  EXPECT_LT(sum / fixes, 4.0) << "three degrees of freedom";
  EXPECT_LT(far, fixes / 50);
  EXPECT_LT(error, of_average / 50.0) << "the rule of the report is seven times as far off";
}

TEST(Localise, GhostsAreToldApart) {
  Rng rng(23);
  const Pose2 truth{{-0.2, -0.1}, 0.8};
  auto sightings = sight_all(truth, arena, 0.2, rng);
  ASSERT_EQ(sightings.size(), 4U);
  TagSighting stranger = sightings[0];
  stranger.id = 99;
  sightings.push_back(stranger);
  TagSighting moved = sightings[1];  // a tag that was hung elsewhere, or a wrong id
  moved.id = sightings[3].id;
  sightings.push_back(moved);
  for (const bool told : {false, true}) {
    const auto prior =
        told ? std::optional(PoseBelief{{{-0.15, -0.15}, 0.75}, round(0.1, 0.1)}) : std::nullopt;
    const TagFix fix = localise(sightings, arena, mount, prior);
    ASSERT_TRUE(fix.belief);
    EXPECT_LT(distance(fix.belief->world_T_robot.position, truth.position), 0.02);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(fix.verdicts[i], TagVerdict::used);
    EXPECT_EQ(to_string(fix.verdicts[4]), "unknown_id");
    EXPECT_TRUE(fix.verdicts[5] != TagVerdict::used && fix.verdicts[5] != TagVerdict::unknown_id);
  }
}

TEST(Localise, ATagOffTheFloorIsLeftOut) {
  Rng rng(24);
  const Pose2 truth{{0.0, 0.5}, 0.4};
  TagMap wrong{{arena.tags[0]}};
  wrong.tags[0].world_T_tag.position.z += 0.3;
  const TagFix fix = localise(sight_all(truth, {{arena.tags[0]}}, 0.1, rng), wrong, mount);
  EXPECT_FALSE(fix.belief);
  EXPECT_EQ(fix.verdicts, std::vector{TagVerdict::off_floor});
}

TEST(Localise, ALoneFarTagSaysNothingUntilAPriorChooses) {
  Rng rng(25);
  // Level with the camera, where the floor does not tell the two solutions apart.
  const TagMap one{{upright_tag(7, {3.0, 0.0, 0.15}, pi - radians(20.0))}};
  const Pose2 truth{{0.0, 0.0}, 0.0};
  int silent = 0, wrong = 0, chosen = 0, flipped = 0;
  for (int i = 0; i < testing::cases(200); ++i) {
    const auto sightings = sight_all(truth, one, 0.2, rng);
    ASSERT_EQ(sightings.size(), 1U);
    if (sightings[0].poses.size() < 2) continue;
    const TagFix alone = localise(sightings, one, mount);
    silent += alone.verdicts[0] == TagVerdict::ambiguous ? 1 : 0;
    EXPECT_EQ(alone.belief.has_value(), alone.verdicts[0] == TagVerdict::used);
    wrong += alone.belief && std::abs(alone.belief->world_T_robot.heading_rad) > radians(20.0) ? 1 : 0;
    const TagFix told = localise(sightings, one, mount, PoseBelief{truth, round(0.1, 0.05)});
    if (!told.belief) continue;
    ++chosen;
    EXPECT_LT(std::abs(told.belief->world_T_robot.heading_rad), radians(12.0));
    flipped += std::abs(yaw_of(sightings[0].poses[0]) - radians(20.0)) > radians(20.0) ? 1 : 0;
  }
  EXPECT_GT(silent, testing::cases(200) / 10);
  EXPECT_LE(wrong, testing::cases(200) / 50);
  EXPECT_GT(chosen, testing::cases(200) * 8 / 10);
  EXPECT_GT(flipped, 0) << "the better solution was the wrong one at times, and the prior saw it";
}

TEST(Localise, BlindItSaysNothing) {
  EXPECT_FALSE(localise({}, arena, mount).belief);
  EXPECT_FALSE(average_by_inverse_distance({}, arena, mount));
}

TEST(Localise, FusedBeliefsAreThoseOfInformation) {
  const PoseBelief a{{{1.0, 0.0}, 3.1}, round(0.1, 0.2)}, b{{{2.0, 1.0}, -3.1}, round(0.2, 0.1)};
  const PoseBelief both = fuse(a, b);
  EXPECT_NEAR(both.world_T_robot.position.x, (1.0 * 4 + 2.0 * 1) / 5, 1e-12);
  EXPECT_NEAR(both.world_T_robot.position.y, (0.0 * 4 + 1.0 * 1) / 5, 1e-12);
  const double apart = 2 * pi - 6.2;  // the short way round
  EXPECT_NEAR(wrap_angle(both.world_T_robot.heading_rad - (3.1 + 0.8 * apart)), 0.0, 1e-12);
  EXPECT_NEAR(both.covariance(0, 0), 1.0 / (100.0 + 25.0), 1e-12);
  EXPECT_NEAR(both.covariance(2, 2), 1.0 / (100.0 + 25.0), 1e-12);
}

}  // namespace
}  // namespace outrider
