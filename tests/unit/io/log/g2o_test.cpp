#include "outrider/io/log/g2o.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/io/files/files.hpp"
#include "outrider/slam/bounds/pose_graph_bound.hpp"
#include "support/costly_cases.hpp"
#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr const char* small =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 7 1 0 0.5\n# a landmark\nVERTEX_XY 9 2 1\nFIX 0\n"
    "EDGE_SE2 0 7 1 0 0.4 10 1 0 10 0 40\nEDGE_SE2_XY 7 9 1.5 0.5 4 0 4\n";

TEST(G2o, ReadsAndWritesTheSameGraph) {
  const auto graph = pose_graph_from_g2o(small, "small.g2o");
  ASSERT_TRUE(graph) << to_string(graph.error());
  ASSERT_EQ(graph->nodes.size(), 3U);
  EXPECT_EQ(graph->nodes[1], (GraphNode{"7", {{1.0, 0.0}, 0.5}, false}));
  EXPECT_EQ(graph->edges[0].information(0, 1), 1.0);
  EXPECT_EQ(graph->edges[0].information(1, 0), 1.0);
  EXPECT_EQ(graph->edges[1].kind, EdgeKind::point);
  std::vector<Pose2> poses;
  for (const GraphNode& node : graph->nodes) poses.push_back(node.pose);
  const auto text = to_g2o(*graph, poses);
  ASSERT_TRUE(text);
  const auto again = pose_graph_from_g2o(*text, "again.g2o");
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *graph);
}

TEST(G2o, EdgesPlaceTheVerticesThatAreMissing) {
  const auto graph = pose_graph_from_g2o(
      "EDGE_SE2 1 2 1 0 1.5707963267948966 1 0 0 1 0 1\n"
      "EDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\n",
      "edges.g2o");
  ASSERT_TRUE(graph);
  EXPECT_NEAR(graph->nodes[2].pose.position.x, 1.0, 1e-12);
  EXPECT_NEAR(graph->nodes[2].pose.position.y, 1.0, 1e-12);
}

TEST(G2o, RefusesInASentence) {
  const auto sentence = [](const std::string& text) {
    const auto graph = pose_graph_from_g2o(text, "bad.g2o");
    return graph ? std::string("taken") : to_string(graph.error());
  };
  const std::string edge = "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";
  EXPECT_EQ(sentence(edge), "taken");
  EXPECT_EQ(sentence(edge + "EDGE_SE2 1 2 nan 0 0 1 0 0 1 0 1\n"),
            "bad.g2o:2: 'EDGE_SE2 1 2 nan 0 0 1 0 0 1 0 1' is not valid; expected EDGE_SE2 from to x y "
            "heading and 6 "
            "numbers of the information's upper triangle");
  EXPECT_EQ(sentence(edge + "EDGE_SE2 1 2 1 0 0 1 0 0 1 0 -1\n"),
            "bad.g2o:2: its information is not positive definite; correct it, or read only its diagonal");
  EXPECT_EQ(sentence(edge + "EDGE_SE2 1 1 1 0 0 1 0 0 1 0 1\n"),
            "bad.g2o:2: it joins 1 to itself; take it out");
  EXPECT_EQ(sentence("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 0 1 0 0\n"),
            "bad.g2o:2: 0 is placed twice; keep one line");
  EXPECT_EQ(sentence("VERTEX_SE2 5 0 0 0\n" + edge),
            "bad.g2o: the edges do not say where node 0 stands; give it a place or an edge");
  EXPECT_EQ(sentence("VERTEX_SE2 5 0 0 0\nVERTEX_SE2 0 0 0 0\n" + edge),
            "bad.g2o: the graph falls apart: no chain of edges joins node 0 to node 5; add one");
  EXPECT_EQ(sentence("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"),
            "bad.g2o:1: 'VERTEX_SE3:QUAT' is no line of a graph of the plane; expected one of VERTEX_SE2, "
            "VERTEX_XY, EDGE_SE2, EDGE_SE2_XY, FIX, VERTEX2, EDGE2");
  EXPECT_EQ(sentence(edge + "FIX 1\n"), "bad.g2o:2: only the first vertex can be fixed; take the line out");
  EXPECT_EQ(sentence("VERTEX_XY 0 1 1\n" + edge),
            "bad.g2o:2: 0 is a point elsewhere in the file; give them different names");
  EXPECT_EQ(sentence(""), "bad.g2o: the graph has no poses; expected at least one");
  EXPECT_EQ(sentence("VERTEX_SE2 0 1e300 0 0\n"),
            "bad.g2o:1: 'VERTEX_SE2 0 1e300 0 0' is not valid; expected VERTEX_SE2 id x y heading");
}

constexpr const char* unit_information = "1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1";

TEST(G2o, ReadsAndWritesAGraphInSpace) {
  const std::string text = fmt::format(
      "# a comment\nVERTEX_SE3:QUAT 0 1 2 3 0 0 0 1\nVERTEX_SE3:QUAT 4 1 2 4 0 0 0.6 0.8\nFIX 0\n"
      "EDGE_SE3:QUAT 0 4 0.5 0.25 1 0.6 0 0 -0.8 9 1 2 3 4 5 9 1 2 3 4 9 1 2 3 9 1 2 9 1 9\n"
      "EDGE_SE3:QUAT 4 5 1 0 0 0 0 0 1 {}\n",
      unit_information);
  EXPECT_TRUE(is_spatial_g2o(text));
  EXPECT_FALSE(is_spatial_g2o(small));
  const auto graph = pose_graph3_from_g2o(text, "space.g2o");
  ASSERT_TRUE(graph) << to_string(graph.error());
  ASSERT_EQ(graph->nodes.size(), 3U);
  const Pose3& turned = graph->nodes[1].pose;  // by 2 acos 0.8 about z
  EXPECT_NEAR(turned.rotation.axes[0].x, 0.28, 1e-12);
  EXPECT_NEAR(turned.rotation.axes[0].y, 0.96, 1e-12);
  const Vec3 placed = turned * Vec3{1.0, 0.0, 0.0};  // node 5 has no line of its own
  EXPECT_NEAR(norm(graph->nodes[2].pose.position - placed), 0.0, 1e-12);
  EXPECT_EQ(graph->edges[0].information(0, 5), 5.0);
  EXPECT_EQ(graph->edges[0].information(5, 0), 5.0);
  EXPECT_EQ(graph->edges[0].information(4, 5), 1.0);
  std::vector<Pose3> poses;
  for (const GraphNode3& node : graph->nodes) poses.push_back(node.pose);
  const auto written = to_g2o(*graph, poses);
  ASSERT_TRUE(written);
  const auto again = pose_graph3_from_g2o(*written, "again.g2o");
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_NEAR(cost(*again, poses), cost(*graph, poses), 1e-9 * cost(*graph, poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(norm(again->nodes[i].pose * Vec3{1, 2, 3} - poses[i] * Vec3{1, 2, 3}), 0.0, 1e-12);
  }
}

TEST(G2o, RefusesGraphsInSpaceInASentence) {
  const auto sentence = [](const std::string& text, InformationTerms terms = InformationTerms::all) {
    const auto graph = pose_graph3_from_g2o(text, "bad.g2o", terms);
    return graph ? std::string("taken") : to_string(graph.error());
  };
  const std::string edge = fmt::format("EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 {}\n", unit_information);
  EXPECT_EQ(sentence(edge), "taken");
  const std::string coupled =
      edge + "EDGE_SE3:QUAT 1 2 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 9 1 0 1\n";
  EXPECT_EQ(sentence(coupled),
            "bad.g2o:2: its information is not positive definite; correct it, or read only its diagonal");
  EXPECT_EQ(sentence(coupled, InformationTerms::diagonal), "taken");
  EXPECT_EQ(sentence(edge + "VERTEX_SE3:QUAT 7 1 0 0 0 0 0 0.5\n"),
            "bad.g2o:2: its quaternion has length 0.5; expected 1");
  EXPECT_EQ(
      sentence(edge + "VERTEX_SE3:QUAT 7 1 0 0 0 0 0\n"),
      "bad.g2o:2: 'VERTEX_SE3:QUAT 7 1 0 0 0 0 0' is not valid; expected VERTEX_SE3:QUAT id x y z and a "
      "quaternion qx qy qz qw");
  EXPECT_EQ(sentence(edge + "VERTEX_SE2 7 1 0 0\n"),
            "bad.g2o:2: 'VERTEX_SE2' is no line of a graph of space; expected one of VERTEX_SE3:QUAT, "
            "EDGE_SE3:QUAT, FIX");
}

TEST(G2o, IsotropicInformationIsTheInverseOfTheMeanVariance) {
  const auto plane =
      pose_graph_from_g2o("EDGE_SE2 0 1 1 0 0 4 0 1 16 0 9\n", "plane.g2o", InformationTerms::isotropic);
  ASSERT_TRUE(plane);
  EXPECT_TRUE(plane->edges[0].information.isApprox(
      Eigen::Matrix3d(Eigen::Vector3d(6.4, 6.4, 9.0).asDiagonal())));  // 2 / (1/4 + 1/16)
  const auto space =
      pose_graph3_from_g2o("EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 1 2 0 0 0 0 4 0 0 0 4 0 0 8 0 8\n",
                           "space.g2o", InformationTerms::isotropic);
  ASSERT_TRUE(space);
  Eigen::Matrix<double, 6, 1> expected;
  expected << 12.0 / 7.0, 12.0 / 7.0, 12.0 / 7.0, 6.0, 6.0, 6.0;
  EXPECT_TRUE(space->edges[0].information.isApprox(PoseMatrix<Pose3>(expected.asDiagonal())));
}

TEST(G2o, ReadsTheInformationOfToroInItsOrder) {
  const auto toro = pose_graph_from_g2o(
      "VERTEX2 0 0 0 0\nVERTEX2 1 1 0 0\nEDGE2 0 1 1 0 0.1 10 1 20 30 2 3\n", "toro.graph");
  const auto g2o = pose_graph_from_g2o(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0.1 10 1 2 20 3 30\n", "g2o.g2o");
  ASSERT_TRUE(toro && g2o);
  EXPECT_EQ(*toro, *g2o);
}

/// The least costs of graphs that others published, to a hundredth of a percent.
TEST(G2o, PublishedGraphsReachTheirLeastCost) {
  struct Published {
    const char* file;
    double least;
    double least_measured_frame;
  };
  const std::vector<Published> all = {
      {"intel", 44.417808, 45.004696},     {"CSAIL", 61.142973, 40.555129},
      {"MIT", 39.601294, 41.163269},       {"input_INTEL_poorinit", 214.17086, 215.83153},
      {"manhattan", 3533.4585, 3549.0368}, {"ais2klinik", 172.654243, 0.0},
      {"kitti_00", 98.262682, 0.0},        {"M3500a", 912.115012, 0.0},
      {"M3500c", 2554.732391, 0.0},        {"city10000", 511.98516, 511.98516}};
  const std::size_t most = !testing::in_full() ? 5 : testing::cases(1) > 1 ? all.size() : all.size() - 1;
  for (std::size_t i = 0; i < most; ++i) {
    const auto path = test::data_folder() / "slam" / "posegraph" / (std::string(all[i].file) + ".g2o.gz");
    OUTRIDER_NEEDS_DATA(path);
    const auto text = read_file(path.string());
    ASSERT_TRUE(text) << to_string(text.error());
    const auto graph = pose_graph_from_g2o(*text, path.string());
    ASSERT_TRUE(graph) << to_string(graph.error());
    const auto solution = optimise(*graph, {}, {});
    ASSERT_TRUE(solution) << to_string(solution.error());
    EXPECT_TRUE(solution->converged) << all[i].file;
    EXPECT_NEAR(solution->cost, all[i].least, 1e-6 * all[i].least) << all[i].file;
    if (all[i].least_measured_frame == 0.0) continue;
    const auto turned = optimise(in_measured_frame(*graph), {}, {});
    ASSERT_TRUE(turned);
    EXPECT_NEAR(turned->cost, all[i].least_measured_frame, 1e-4 * turned->cost) << all[i].file;
  }
}

/// With isotropic information the cost is the objective of SE-Sync, whose optima are published (Rosen et al.,
/// IJRR 38 (2019), table 1), and the bound proves them.
TEST(G2o, PublishedGraphsInSpaceReachTheirLeastCost) {
  const std::vector<std::pair<const char*, double>> all = {
      {"tinyGrid3D", 18.519366}, {"smallGrid3D", 1025.398}, {"parking-garage", 1.2625},
      {"sphere2500", 1687.006},  {"cubicle", 717.126},      {"torus3D", 24227.05}};
  const std::size_t most = testing::cases(1) > 1 ? all.size() : 3;
  for (std::size_t i = 0; i < most; ++i) {
    const auto path =
        test::data_folder() / "slam" / "posegraph" / "3d" / (std::string(all[i].first) + ".g2o.gz");
    OUTRIDER_NEEDS_DATA(path);
    const auto text = read_file(path.string());
    ASSERT_TRUE(text) << to_string(text.error());
    const auto graph = pose_graph3_from_g2o(*text, path.string(), InformationTerms::isotropic);
    ASSERT_TRUE(graph) << to_string(graph.error());
    const auto solution = optimise(*graph, {}, {});
    ASSERT_TRUE(solution) << to_string(solution.error());
    EXPECT_TRUE(solution->converged);
    EXPECT_NEAR(solution->cost, all[i].second, 2e-5 * all[i].second) << all[i].first;
    const auto bound = least_cost_bound(*graph, solution->poses);
    ASSERT_TRUE(bound);
    EXPECT_GT(*bound, solution->cost * (1.0 - 2e-4)) << all[i].first;
    EXPECT_LE(*bound, solution->cost * (1.0 + 1e-9)) << all[i].first;
  }
}

/// False edges between random poses of published graphs change nothing.
TEST(G2o, FalseEdgesInPublishedGraphsAreRefused) {
  Rng rng(1);
  for (const char* file : {"intel", "manhattan"}) {
    const auto path = test::data_folder() / "slam" / "posegraph" / (std::string(file) + ".g2o.gz");
    OUTRIDER_NEEDS_DATA(path);
    const auto text = read_file(path.string());
    ASSERT_TRUE(text) << to_string(text.error());
    const auto honest = pose_graph_from_g2o(*text, path.string());
    ASSERT_TRUE(honest) << to_string(honest.error());
    const auto truth = optimise(*honest, {}, {});
    ASSERT_TRUE(truth);
    for (const std::size_t count : {1U, 10U, 50U}) {
      if (!testing::in_full() && count > 1) continue;
      for (int seed = 0; seed < testing::cases(1); ++seed) {
        PoseGraph graph = *honest;
        for (std::size_t k = 0; k < count; ++k) {
          GraphEdge edge = honest->edges[rng.below(honest->edges.size())];
          edge.from = static_cast<std::uint32_t>(rng.below(graph.nodes.size() - 2));
          edge.to = edge.from + 2 + static_cast<std::uint32_t>(rng.below(graph.nodes.size() - edge.from - 2));
          edge.measured = {testing::random_point(rng, 10.0), rng.uniform(-3.0, 3.0)};
          graph.edges.push_back(edge);
        }
        const auto robust = optimise(graph, {.robust = "gnc"}, {});
        ASSERT_TRUE(robust);
        EXPECT_TRUE(robust->converged);
        double sum = 0.0;
        for (std::size_t i = 0; i < truth->poses.size(); ++i) {
          sum += distance(truth->poses[i].position, robust->poses[i].position);
        }
        EXPECT_LT(sum / static_cast<double>(truth->poses.size()), 0.25) << file << " " << count;
        const auto false_ones = std::count_if(robust->refused.begin(), robust->refused.end(),
                                              [&](std::uint32_t i) { return i >= honest->edges.size(); });
        EXPECT_EQ(false_ones, static_cast<std::ptrdiff_t>(count));
      }
    }
  }
}

}  // namespace
}  // namespace outrider
