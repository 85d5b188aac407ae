// Worlds that others have published, against what is known of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "outrider/io/sdf/sdf.hpp"
#include "sdf_solids.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

TEST(Sdf, LoadsTheSixPublishedYards) {
  const auto folder = test::data_folder() / "guard" / "worlds";
  OUTRIDER_NEEDS_DATA(folder);
  const std::map<std::string, std::size_t> solids = {{"by_small", 40},   {"by_small2", 42},
                                                     {"by_small_1", 45}, {"by_small_2", 49},
                                                     {"by_small_3", 51}, {"small_perimeter", 17}};
  for (const auto& [name, count] : solids) {
    const auto loaded = load_sdf((folder / (name + ".sdf")).string());
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    EXPECT_EQ(loaded->world.solids.size(), count) << name;
    EXPECT_FALSE(loaded->warnings.empty()) << name;
    EXPECT_NEAR(loaded->world.bounds.size().x, 20.15, 1e-3) << name;
    EXPECT_NEAR(loaded->world.bounds.size().y, 20.15, 1e-3) << name;
    EXPECT_EQ(loaded->world.floor_z_m, 0.0);
    EXPECT_EQ(loaded->world.gravity_mps2, 9.8);
  }
  const World yard = load_sdf((folder / "by_small.sdf").string())->world;
  EXPECT_EQ(std::get<CylinderShape>(solid(yard, "table_obs_0/leg_1").shape).half_length_m, 0.5);
}

/// One row of a published list of collisions.
struct Row {
  std::string path;  // model/link, or what the file calls it
  std::string shape;
  Vec3 position;
  Vec3 roll_pitch_yaw;
  Vec3 size;
};

std::vector<Row> rows_of(const std::filesystem::path& path) {
  std::vector<Row> rows;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    const auto at = [&](std::size_t i) {
      return Vec3{std::stod(cells[i]), std::stod(cells[i + 1]), std::stod(cells[i + 2])};
    };
    rows.push_back({cells[0] + "/" + cells[1], cells[2], at(3), at(6), at(9)});
  }
  return rows;
}

Vec3 size_of(const Solid& one) {
  if (const auto* box = std::get_if<BoxShape>(&one.shape)) return 2.0 * box->half_size;
  if (const auto* cylinder = std::get_if<CylinderShape>(&one.shape)) {
    return {2.0 * cylinder->radius_m, 2.0 * cylinder->radius_m, 2.0 * cylinder->half_length_m};
  }
  return {};
}

TEST(Sdf, ExplorationWorldsMatchThePublishedCollisions) {
  const auto folder = test::data_folder() / "exploration";
  OUTRIDER_NEEDS_DATA(folder);
  for (const std::string name : {"closed_maze", "house_closed", "willow_closed"}) {
    const auto loaded = load_sdf((folder / (name + ".world")).string());
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    std::vector<const Solid*> left;
    for (const Solid& one : loaded->world.solids) {
      if (!std::holds_alternative<HalfSpaceShape>(one.shape)) left.push_back(&one);
    }
    std::size_t meshes = 0;
    for (const Row& row : rows_of(folder / (name + "_collisions.csv"))) {
      if (row.shape == "mesh") {
        ++meshes;
        continue;
      }
      const Rotation rotation =
          Rotation::from_rpy(row.roll_pitch_yaw.x, row.roll_pitch_yaw.y, row.roll_pitch_yaw.z);
      const auto same = [&](const Solid* one) {  // the list is rounded to 1e-4
        double off = norm(one->world_T_solid.position - row.position) + norm(size_of(*one) - row.size);
        for (std::size_t i = 0; i < 3; ++i)
          off += norm(one->world_T_solid.rotation.axes[i] - rotation.axes[i]);
        return std::string(kind(one->shape)) == row.shape && off < 1e-3;
      };
      const auto found = std::ranges::find_if(left, same);
      ASSERT_NE(found, left.end()) << name << ": " << row.path << ' ' << row.position.x << ' '
                                   << row.position.y;
      left.erase(found);
    }
    EXPECT_TRUE(left.empty()) << name << ": " << left.front()->name;
    EXPECT_EQ(loaded->warnings.size(), meshes) << name;
  }
}
}  // namespace
}  // namespace outrider
