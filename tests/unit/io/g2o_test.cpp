#include "outrider/io/g2o.hpp"

#include <gtest/gtest.h>

#include "outrider/io/files.hpp"
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
            "bad.g2o:2: its information is not positive definite; correct it");
  EXPECT_EQ(sentence(edge + "EDGE_SE2 1 1 1 0 0 1 0 0 1 0 1\n"),
            "bad.g2o:2: it joins 1 to itself; take it out");
  EXPECT_EQ(sentence("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 0 1 0 0\n"),
            "bad.g2o:2: 0 is placed twice; keep one line");
  EXPECT_EQ(sentence("VERTEX_SE2 5 0 0 0\n" + edge),
            "bad.g2o: the edges do not say where node 0 stands; give it a place or an edge");
  EXPECT_EQ(sentence("VERTEX_SE2 5 0 0 0\nVERTEX_SE2 0 0 0 0\n" + edge),
            "bad.g2o: the graph falls apart: no chain of edges joins node 0 to node 5; add one");
  EXPECT_EQ(
      sentence("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"),
      "bad.g2o:1: 'VERTEX_SE3:QUAT' is no line of a graph of the plane; expected VERTEX_SE2, VERTEX_XY, "
      "EDGE_SE2, EDGE_SE2_XY or FIX");
  EXPECT_EQ(sentence(edge + "FIX 1\n"), "bad.g2o:2: only the first vertex can be fixed; take the line out");
  EXPECT_EQ(sentence("VERTEX_XY 0 1 1\n" + edge),
            "bad.g2o:2: 0 is a point elsewhere in the file; give them different names");
  EXPECT_EQ(sentence(""), "bad.g2o: the graph has no poses; expected at least one");
  EXPECT_EQ(sentence("VERTEX_SE2 0 1e300 0 0\n"),
            "bad.g2o:1: 'VERTEX_SE2 0 1e300 0 0' is not valid; expected VERTEX_SE2 id x y heading");
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
      {"manhattan", 3533.4585, 3549.0368}, {"city10000", 511.98516, 511.98516}};
  const std::size_t most = testing::cases(1) > 1 ? all.size() : 5;
  for (std::size_t i = 0; i < most; ++i) {
    const auto path = test::data_folder() / "slam" / "posegraph" / (std::string(all[i].file) + ".g2o.gz");
    OUTRIDER_NEEDS_DATA(path);
    const auto text = read_file(path.string());
    ASSERT_TRUE(text) << to_string(text.error());
    const auto graph = pose_graph_from_g2o(*text, path.string());
    ASSERT_TRUE(graph) << to_string(graph.error());
    const auto solution = optimise(*graph, {}, {});
    ASSERT_TRUE(solution) << to_string(solution.error());
    EXPECT_NEAR(solution->cost, all[i].least, 1e-4 * all[i].least) << all[i].file;
    const auto turned = optimise(in_measured_frame(*graph), {}, {});
    ASSERT_TRUE(turned);
    EXPECT_NEAR(turned->cost, all[i].least_measured_frame, 1e-4 * turned->cost) << all[i].file;
  }
}

}  // namespace
}  // namespace outrider
