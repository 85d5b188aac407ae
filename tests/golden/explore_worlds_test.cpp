// The worlds to explore: those of the published data against what was derived from the same files by others,
// and our own.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "outrider/io/map/slices.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/explore/job.hpp"
#include "outrider/jobs/explore/map/reference.hpp"
#include "outrider/jobs/explore/mission/task.hpp"
#include "outrider/world/upright.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

std::string published(const std::string& name) {
  return (test::data_folder() / "exploration" / name).string();
}

World load(const ExploreWorldFiles& files) {
  auto loaded = load_explore_world(files);
  EXPECT_TRUE(loaded) << to_string(loaded.error());
  return loaded ? loaded->world : World{};
}

struct Named {
  std::string stem;
  std::size_t meshes;  ///< of the file, which are not there
  Vec2 start;
  double seeable_m2;  ///< as the published notes state them for a robot that is a point
};

const Named maze{"closed_maze", 0, {-1.0, 0.0}, 20.9};
const Named house{"house_closed", 4, {-3.0, 1.0}, 96.9};
const Named willow{"willow_closed", 1, {-3.0, 1.0}, 1988.0};

class Published : public ::testing::TestWithParam<Named> {};

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream rest(line + ',');
  for (std::string field; std::getline(rest, field, ',');) fields.push_back(field);
  return fields;
}

/// Each collision of the table, whose numbers have four digits, is one of the solids.
void expect_collisions(const World& world, const Named& named) {
  std::ifstream table(published(named.stem + "_collisions.csv"));
  std::string line;
  std::getline(table, line);
  std::size_t meshes = 0;
  std::size_t rows = 0;
  while (std::getline(table, line)) {
    const std::vector<std::string> f = fields_of(line);
    ASSERT_GE(f.size(), 13U) << line;
    const auto at = [&](std::size_t i) { return std::stod(f[i]); };
    ++rows;
    if (f[2] == "mesh") {
      ++meshes;
      continue;
    }
    const Vec3 place{at(3), at(4), at(5)};
    const Rotation turn = Rotation::from_rpy(at(6), at(7), at(8));
    const bool found = std::ranges::any_of(world.solids, [&](const Solid& solid) {
      if (kind(solid.shape) != f[2]) return false;
      Vec3 size{at(9), at(10), at(11)};
      if (const auto* box = std::get_if<BoxShape>(&solid.shape)) size = size - 2.0 * box->half_size;
      if (const auto* rod = std::get_if<CylinderShape>(&solid.shape)) {
        size = size - 2.0 * Vec3{rod->radius_m, rod->radius_m, rod->half_length_m};
      }
      double turned = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        turned = std::max(turned, norm(solid.world_T_solid.rotation.axes[i] - turn.axes[i]));
      }
      return norm(solid.world_T_solid.position - place) < 1e-4 && norm(size) < 1e-4 && turned < 1.5e-4;
    });
    EXPECT_TRUE(found) << line;
  }
  EXPECT_EQ(meshes, named.meshes);
  EXPECT_EQ(world.solids.size(), rows - meshes + 1) << "nothing else stands there but the floor";
}

/// The laser's plane cuts the same ground from the solids as the slices cover.
void expect_slices(const World& world, const Named& named) {
  const std::vector<RoundedPolygon> cuts = cut_at(world, 0.18);
  const auto slices = load_slices(published(named.stem + "_slice_z0.18.csv"));
  ASSERT_TRUE(slices);
  EXPECT_EQ(cuts.size(), slices->size());
  const auto gap = [](Vec2 p, const std::vector<RoundedPolygon>& pieces) {
    double nearest = 1e9;
    for (const RoundedPolygon& piece : pieces) nearest = std::min(nearest, signed_distance(p, piece));
    return nearest;
  };
  std::vector<RoundedPolygon> given;
  for (const WorldSlice& slice : *slices) given.push_back({slice.corners, 0.0});
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const RoundedPolygon& piece = given[rng.below(given.size())];
    const Box2 box = piece.bounds().grown(0.05);
    const Vec2 p{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
    const double expected = gap(p, given);
    if (std::abs(expected) < 4e-4) continue;
    EXPECT_EQ(gap(p, cuts) < 0.0, expected < 0.0) << p.x << ' ' << p.y;
  }
}

ExplorationReference truth_of(const World& world, Vec2 start) {
  auto truth = exploration_reference(RangeFinder(world, {}), OpenGround(world, burger()), start);
  EXPECT_TRUE(truth) << to_string(truth.error());
  return truth ? *truth : ExplorationReference{};
}

TEST_P(Published, IsAsTheNotesSay) {
  const Named& named = GetParam();
  OUTRIDER_NEEDS_DATA(std::filesystem::path(published(named.stem + ".world")));
  World world = load({.world = published(named.stem + ".world")});
  expect_collisions(world, named);
  expect_slices(world, named);
  if (named.stem == willow.stem) {
    const auto walls = load_slices(published("willow_closed_wall_segments_z0.18.csv"));
    ASSERT_TRUE(walls);
    for (const WorldSlice& wall : *walls) world.solids.push_back(upright(wall.corners, "wall", 0.0, 0.5));
    EXPECT_TRUE(truth_of(world, named.start).leaks) << "between the posts in the south-west";
    world = world.with(upright({{-21.6, -19.55}, {-16.9, -19.55}}, "seal", 0.0, 0.5));
  }
  const ExplorationReference truth = truth_of(world, named.start);
  EXPECT_NEAR(truth.seeable_m2 / named.seeable_m2, 1.0, 0.025);
  EXPECT_FALSE(truth.leaks);
}

INSTANTIATE_TEST_SUITE_P(Worlds, Published, ::testing::Values(maze, house, willow),
                         [](const auto& world) { return world.param.stem; });

TEST(ExploreWorlds, OursAreWhatTheyClaim) {
  const auto truth_in = [](const std::string& name) {
    const std::string path = OUTRIDER_SOURCE_DIR "/scenarios/explore/" + name;
    ExploreJob job;
    EXPECT_TRUE(read_scenario(job, path));
    const auto setup = load_explore(job.scenario);
    EXPECT_TRUE(setup) << to_string(setup.error());
    if (!setup) return ExplorationReference{};
    EXPECT_TRUE(setup->warnings.empty());
    return truth_of(setup->world, setup->task.start.position);
  };
  const ExplorationReference office = truth_in("office.yaml");
  EXPECT_FALSE(office.leaks);
  EXPECT_GT(office.reachable_m2, 30.0);
  const auto in_office = [&](Vec2 p) { return office.places[office.places.frame.cell_at(p)]; };
  for (const Vec2 room : {Vec2{1.8, 1.2}, Vec2{3.5, 1.6}, Vec2{7.0, 1.9}, Vec2{4.3, 4.5}, Vec2{7.7, 4.3}}) {
    EXPECT_EQ(in_office(room), reachable) << room.x << ' ' << room.y;
  }
  EXPECT_FALSE(truth_in("cave.yaml").leaks);
  EXPECT_TRUE(truth_in("leaking_yard.yaml").leaks);
}

}  // namespace
}  // namespace outrider
