// RoomBehindTopics: a room as a saved map and as the world of a simulated robot.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "outrider/io/map/map_server.hpp"
#include "outrider/jobs/explore/scenario.hpp"
#include "outrider/nodes/missions/cover_mission_node.hpp"
#include "outrider/nodes/sim/sim_node.hpp"
#include "outrider/world/occupancy.hpp"
#include "support/data.hpp"
#include "support/node_bus.hpp"

namespace outrider::testing {

/// A room of 3 m x 2.5 m with a pillar.
class RoomBehindTopics : public ::testing::Test {
 protected:
  void SetUp() override { save(map_file(), {}); }

  [[nodiscard]] std::string map_file() const { return (folder.path / "map.yaml").string(); }

  /// Saves the room with another thing in it.
  void save(const std::string& file, const Box2& thing) const {
    MapServerMap map{Grid<std::uint8_t>({{-0.5, -0.5}, 0.05, 60, 50}, free_cell), 0.0};
    for (std::size_t i = 0; i < map.occupancy.frame.size(); ++i) {
      const Cell cell = map.occupancy.frame.cell(i);
      const Vec2 at = map.occupancy.frame.centre(cell);
      const bool wall = cell.x == 0 || cell.x == 59 || cell.y == 0 || cell.y == 49;
      const bool pillar = cell.x > 30 && cell.x < 36 && cell.y > 20 && cell.y < 26;
      const bool in_thing =
          thing.low.x < at.x && at.x < thing.high.x && thing.low.y < at.y && at.y < thing.high.y;
      map.occupancy.cells[i] = wall || pillar || in_thing ? occupied_cell : free_cell;
    }
    ASSERT_TRUE(save_map_server(file, map));
  }

  /// Puts a robot there whose disk is smaller than what it covers. `world` is what is truly there.
  void start_robot(NodeBus& bus, const std::string& world, bool localised = true) const {
    ExploreScenario explore;
    explore.world.world = world;
    auto setup = load_explore(explore);
    ASSERT_TRUE(setup) << to_string(setup.error());
    SimNodeOptions options;
    options.start = {{0.2, 0.3}, 0.7};
    options.robot = burger();
    options.sim = setup->sim;
    options.localised = localised;
    bus.start(std::make_unique<SimNode>(setup->world, options));
  }
  void start_robot(NodeBus& bus) const { start_robot(bus, map_file()); }

  test::Folder folder;
};

/// The room is to be covered.
class CoverOfTheRoom : public RoomBehindTopics {
 protected:
  void SetUp() override {
    RoomBehindTopics::SetUp();
    scenario.area = map_file();
    scenario.problem.width_m = 0.4;
    scenario.problem.pace.speed_mps = 0.3;
    scenario.problem.pace.pause_s = 0.1;
  }

  CoverScenario scenario;
};

}  // namespace outrider::testing
