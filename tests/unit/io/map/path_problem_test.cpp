#include "outrider/io/map/path_problem.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "outrider/io/files/files.hpp"
#include "outrider/path/catalog.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

std::string written(const std::string& name, const std::string& text) {
  const std::string path = (std::filesystem::path(::testing::TempDir()) / name).string();
  EXPECT_TRUE(write_file(path, text).has_value());
  return path;
}

TEST(PathProblem, AnyMapFileIsPlannedOn) {
  const std::string room = written("room.txt", "(0,0) (8,0) (8,6) (0,6)\n---\n(3,0) (4,0) (4,2) (3,2)\n");
  const auto grid = load_path_problem(test::scenarios + "maps/gallery.map", {3.5, 13.5}, {28.5, 2.5});
  const auto world = load_path_problem(test::scenarios + "yard/yard.sdf", {0, -6}, {4, 4});
  const auto polygons = load_path_problem(room, {1, 1}, {7, 1});
  for (const auto* problem : {&grid, &world, &polygons}) {
    ASSERT_TRUE(problem->has_value()) << to_string(problem->error());
    const auto plan = plan_path(**problem, (*problem)->polygons ? "visibility_graph" : "theta_star");
    ASSERT_TRUE(plan.has_value()) << to_string(plan.error());
    EXPECT_GT(plan->cost, 0.0);
  }
  EXPECT_EQ((*grid).grid->frame.width, 32);
  EXPECT_EQ((*polygons).polygons->radius_m, 0.18);
  EXPECT_EQ((*load_path_problem(room, {}, {}, {.radius_m = 0.5})).polygons->radius_m, 0.5);
}

TEST(PathProblem, WhatIsNoGoodIsSaidInASentence) {
  const std::string image = written("m.pgm", "P2\n2 1\n255\n254 254\n");
  const std::string rest = "resolution: 0.5\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  const std::string straight = written("m.yaml", "image: m.pgm\norigin: [0, 0, 0]\n" + rest);
  const std::string turned = written("t.yaml", "image: m.pgm\norigin: [0, 0, 0.5]\n" + rest);
  EXPECT_TRUE(load_path_problem(straight, {}, {}).has_value());
  EXPECT_NE(load_path_problem(turned, {}, {}).error().sentence.find("load_map_server()"), std::string::npos);
  EXPECT_EQ(load_path_problem("map.doc", {}, {}).error().where, "map.doc");
  EXPECT_EQ(load_path_problem("none.map.gz", {}, {}).error().code, FaultCode::bad_input);
  const auto problem = load_path_problem(straight, {}, {});
  EXPECT_NE(plan_path(*problem, "thetastar").error().sentence.find("theta_star"), std::string::npos);
}

}  // namespace
}  // namespace outrider
