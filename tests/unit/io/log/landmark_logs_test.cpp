#include "outrider/io/log/landmark_logs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/io/files/files.hpp"
#include "outrider/io/log/pyfg.hpp"
#include "outrider/slam/map_error.hpp"
#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

template <class T>
std::string said(const Outcome<T>& outcome) {
  return outcome ? "taken" : to_string(outcome.error());
}

TEST(LandmarkLogs, FreiburgTurnsDrivesAndTurns) {
  const auto log = landmark_log_from_freiburg(
      {"ODOMETRY 1.5707963267948966 2 0.5\nSENSOR 3 2 0.5\nODOMETRY 0 0 0\n", "log"}, {"3 1 2\n", "map"}, {});
  ASSERT_TRUE(log) << to_string(log.error());
  ASSERT_EQ(log->steps.size(), 2U);
  EXPECT_NEAR(log->steps[0].odometry.position.y, 2.0, 1e-12);
  EXPECT_NEAR(log->steps[0].odometry.heading_rad, 0.5 * pi + 0.5, 1e-12);
  EXPECT_NEAR(log->steps[0].sightings[0].position.x, 2.0 * std::cos(0.5), 1e-12);
  EXPECT_EQ(log->true_landmarks.at(3), (Vec2{1.0, 2.0}));
  const auto refusal = [](const char* text, const char* map = "") {
    return said(landmark_log_from_freiburg({text, "log"}, {map, "map"}, {}));
  };
  EXPECT_EQ(
      refusal("ODOMETRY 1 x 1\n"),
      "log:1: 'x' is no number of use; a line is 'ODOMETRY turn distance turn' or 'SENSOR id range bearing'");
  EXPECT_EQ(refusal("ODOMETRY 1 1\n"),
            "log:1: 2 numbers where a line is 'ODOMETRY turn distance turn' or 'SENSOR id range bearing'");
  EXPECT_EQ(refusal("\nSENSOR 1.5 1 1\n"),
            "log:2: '1.5' is no id; a line is 'ODOMETRY turn distance turn' or 'SENSOR id range bearing'");
  EXPECT_EQ(refusal("SENSOR 1 nan 0\n"),
            "log:1: 'nan' is no number of use; a line is 'ODOMETRY turn distance turn' or 'SENSOR id range "
            "bearing'");
  EXPECT_EQ(refusal("SENSOR 1 1 0\n", "a 1 1\n"),
            "map:1: 'a' is no number of use; a line is 'id x y' with a whole number for id");
  EXPECT_EQ(refusal(""), "log: the log is empty; expected at least one line");
}

TEST(LandmarkLogs, MrclamDrivesBetweenSightings) {
  const MrclamTexts texts = {{"# time v w\n0 1 0\n2 0 1\n3 0 0\n", "odometry"},
                             {"1 72 2 0.1\n1 5 1 1\n3.5 27 1 0\n", "measurements"},
                             {"1 5\n6 72\n7 27\n", "barcodes"},
                             {"6 1 2 0 0\n", "landmarks"}};
  const auto log = landmark_log_from_mrclam(texts, {});
  ASSERT_TRUE(log) << to_string(log.error());
  ASSERT_EQ(log->steps.size(), 2U) << "robots are no landmarks";
  EXPECT_NEAR(log->steps[0].odometry.position.x, 1.0, 1e-12);
  EXPECT_EQ(log->steps[0].sightings.size(), 1U);
  EXPECT_EQ(log->steps[0].sightings[0].id, 6);
  EXPECT_NEAR(log->steps[1].odometry.position.x, 1.0, 1e-12);
  EXPECT_NEAR(log->steps[1].odometry.heading_rad, 1.0, 1e-12);
  MrclamTexts bad = texts;
  bad.odometry.text = "1 1 0\n0 1 0\n";
  EXPECT_EQ(said(landmark_log_from_mrclam(bad, {})), "odometry:2: the time 0 runs back; sort the lines");
  bad = texts;
  bad.measurements.text = "1 99 1 1\n";
  EXPECT_EQ(said(landmark_log_from_mrclam(bad, {})),
            "measurements: no line sights a landmark of the barcodes");
}

TEST(LandmarkLogs, AChainGivesItsOwnCovariances) {
  const std::string step = "ODOMETRY 0 1 1 0 0.5 0.1 0 0 0.1 0 0.01\n";
  const auto log = landmark_log_from_chain({step + "LANDMARK 1 9 2 1 0.4 0.1 0.4\n", "chain"});
  ASSERT_TRUE(log) << to_string(log.error());
  EXPECT_TRUE(log->told_apart);
  EXPECT_EQ(log->steps[0].sightings[0],
            (LandmarkSighting{9, {2.0, 1.0}, Eigen::Matrix2d{{0.4, 0.1}, {0.1, 0.4}}}));
  const auto refusal = [&](const std::string& line) {
    return said(landmark_log_from_chain({step + line, "chain"}));
  };
  EXPECT_EQ(refusal("ODOMETRY 3 4 1 0 0 1 0 0 1 0 1\n"),
            "chain:2: it starts at pose 3, where pose 1 was reached; poses form a chain");
  EXPECT_EQ(refusal("LANDMARK 1 9 2 1 0.4 0.5 0.4\n"),
            "chain:2: the covariance of a sighting is not positive definite; correct it");
  EXPECT_EQ(
      refusal("LANDMARK 0 9 2 1 0.4 0 0.4\n"),
      "chain:2: it was seen from pose 0, but pose 1 was reached; put it after the line that leads there");
}

TEST(LandmarkLogs, PyfgStartsEachRobotAtItsTruth) {
  const std::string text =
      "VERTEX_SE2 0 A0 1 2 0\nVERTEX_SE2 1 A1 9 9 0\nVERTEX_SE2 0 B0 4 2 0\nVERTEX_XY L1 3 3\n"
      "EDGE_SE2 1 A0 A1 1 0 0 0.1 0 0 0.1 0 0.1\nEDGE_SE2_XY 1 A1 L1 1 1 0.1 0 0.1\n"
      "EDGE_SE2_XY 1 B0 L1 -1 1 0.1 0 0.1\nEDGE_RANGE 1 A1 B0 2 0.01\n";
  const auto graph = pose_graph_from_pyfg(text, "g.pyfg");
  ASSERT_TRUE(graph) << to_string(graph.error());
  EXPECT_EQ(graph->graph.nodes[1].pose.position, (Vec2{2.0, 2.0}));
  EXPECT_EQ(graph->graph.nodes[2].pose.position, (Vec2{4.0, 2.0}));
  EXPECT_EQ(graph->truth[1].position, (Vec2{9.0, 9.0}));
  EXPECT_NEAR(graph->graph.edges[3].information(0, 0), 100.0, 1e-9);
  EXPECT_EQ(said(pose_graph_from_pyfg(text + "EDGE_RANGE 1 A1 C0 2 0.01\n", "g.pyfg")),
            "g.pyfg:9: there is no vertex C0; put its line before");
  EXPECT_EQ(said(pose_graph_from_pyfg(text + "EDGE_RANGE 1 A1 B0 2 -1\n", "g.pyfg")),
            "g.pyfg:9: its covariance is not positive definite; correct it");
}

LandmarkMap mapped(LandmarkLog log, const std::string& engine, bool ids) {
  LandmarkSlamOptions options;
  options.engine = engine;
  options.unknown_ids = !ids;
  if (!ids) options.patience = 5;
  auto slam = LandmarkSlam::begin(options, log.start);
  EXPECT_TRUE(slam);
  for (LogStep& step : log.steps) {
    for (LandmarkSighting& sighting : step.sightings) {
      if (!ids) sighting.id.reset();
    }
    EXPECT_TRUE(slam->advance(step));
  }
  slam->settle();
  return slam->landmarks();
}

TEST(LandmarkLogs, TheFreiburgLandmarksStandWhereTheyShould) {
  const auto folder = test::data_folder() / "slam" / "landmark" / "freiburg_ekf";
  OUTRIDER_NEEDS_DATA(folder);
  const auto text = read_file((folder / "sensor_data.dat").string());
  const auto map = read_file((folder / "world.dat").string());
  const auto log = landmark_log_from_freiburg({*text, "log"}, {*map, "map"}, {});
  ASSERT_TRUE(log) << to_string(log.error());
  EXPECT_LE(map_error(mapped(*log, "ekf", true), log->true_landmarks).aligned_rmse_m, 0.022);
  EXPECT_LE(map_error(mapped(*log, "graph", true), log->true_landmarks).aligned_rmse_m, 0.019);
}

TEST(LandmarkLogs, TheLandmarksOfMrclamStandWhereTheyShould) {
  const auto folder = test::data_folder() / "slam" / "landmark" / "mrclam_dataset1";
  OUTRIDER_NEEDS_DATA(folder);
  for (const auto& [robot, most_m] : {std::pair("Robot1", 0.087), std::pair("Robot3", 0.093)}) {
    const std::string path = (folder / robot).string();
    const auto odometry = read_file(path + "_Odometry.dat.gz");
    const auto measurements = read_file(path + "_Measurement.dat.gz");
    const auto barcodes = read_file((folder / "Barcodes.dat").string());
    const auto landmarks = read_file((folder / "Landmark_Groundtruth.dat").string());
    auto log = landmark_log_from_mrclam(
        {{*odometry, "o"}, {*measurements, "m"}, {*barcodes, "b"}, {*landmarks, "l"}}, {});
    ASSERT_TRUE(log) << to_string(log.error());
    const LandmarkMap ekf = mapped(*log, "ekf", true);
    const auto exchanged = exchanged_ids(ekf, log->true_landmarks);
    ASSERT_EQ(exchanged, std::pair(std::int64_t{11}, std::int64_t{17}));
    std::swap(log->true_landmarks[11], log->true_landmarks[17]);
    EXPECT_FALSE(exchanged_ids(ekf, log->true_landmarks));
    EXPECT_LE(map_error(ekf, log->true_landmarks).aligned_rmse_m, most_m) << robot;
    if (testing::cases(1) == 1) continue;
    EXPECT_LE(map_error(mapped(*log, "graph", true), log->true_landmarks).aligned_rmse_m, most_m) << robot;
    const MapError unknown = map_error_by_place(mapped(*log, "ekf", false), log->true_landmarks, 0.5);
    EXPECT_GE(unknown.landmarks, 12U) << robot;
  }
}

/// The cost of the batch optimum, reached step by step; a minute under the sanitizers, and so not every time.
TEST(LandmarkLogs, VictoriaParkReachesItsLeastCost) {
  const auto path = test::data_folder() / "slam" / "landmark" / "victoria_park" / "victoria_park.txt.gz";
  OUTRIDER_NEEDS_DATA(path);
  if (testing::cases(1) == 1) GTEST_SKIP() << "set OUTRIDER_CASES";
  const auto text = read_file(path.string());
  const auto log = landmark_log_from_chain({*text, "log"});
  ASSERT_TRUE(log) << to_string(log.error());
  LandmarkSlamOptions options;
  options.gate = 1.0;
  options.patience = 1;
  auto slam = LandmarkSlam::begin(options, log->start);
  ASSERT_TRUE(slam);
  for (const LogStep& step : log->steps) ASSERT_TRUE(slam->advance(step));
  EXPECT_NEAR(slam->cost(), 6183.9324, 1e-4 * 6183.9324);
  slam->settle();
  EXPECT_NEAR(slam->cost(), 6183.9324, 1e-3);
}

}  // namespace
}  // namespace outrider
