#include "outrider/slam/landmark/landmark_slam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

#include "dense.hpp"
#include "outrider/slam/graph/pose_graph.hpp"
#include "support/costly_cases.hpp"
#include "support/random_cases.hpp"
#include "tag_course.hpp"

namespace outrider {
namespace {

const std::vector<std::string> engines = {"kalman", "ekf", "graph"};

/// With the headings of odometry the problem is linear: its posterior is one dense solve over all positions.
TEST(LandmarkSlam, TheLinearFilterIsTheExactPosterior) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(10); ++round) {
    LandmarkLog log;
    constexpr std::size_t steps = 6, tags = 3;
    for (std::size_t i = 0; i < steps; ++i) {
      LogStep step{0.0, {testing::random_point(rng, 1.0), rng.uniform(-1.0, 1.0)}, {}, {}};
      step.covariance = Eigen::Vector3d(0.1, 0.2, 0.1).asDiagonal();
      for (std::size_t k = 0; k < tags; ++k) {
        if (i > 0 && i + 1 < steps && rng.below(2) == 0) continue;
        step.sightings.push_back({static_cast<std::int64_t>(k), testing::random_point(rng, 3.0),
                                  Eigen::Matrix2d{{0.3, 0.1}, {0.1, 0.2}}});
      }
      log.steps.push_back(step);
    }
    LandmarkSlamOptions options;
    options.engine = "kalman";
    options.gate = 1.0;
    options.patience = 1;
    const LandmarkSlam slam = after(options, log);

    const std::size_t n = 2 * (steps + tags);  // positions after each step, then tags
    testing::Dense information = testing::zeros(n, n), pull = testing::zeros(n, 1);
    double heading_rad = 0.0, squares = 0.0;
    const auto add = [&](std::size_t to, std::optional<std::size_t> from, Vec2 v,
                         const Eigen::Matrix2d& local) {
      const Eigen::Matrix2d turn = Eigen::Rotation2Dd(heading_rad).toRotationMatrix();
      const Eigen::Matrix2d weight = (turn * local * turn.transpose()).inverse();
      const Eigen::Vector2d pulled = weight * Eigen::Vector2d(v.x, v.y);
      squares += pulled.dot(Eigen::Vector2d(v.x, v.y));
      for (std::size_t i = 0; i < 2; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        pull[to + i][0] += pulled[row];
        if (from) pull[*from + i][0] -= pulled[row];
        for (std::size_t j = 0; j < 2; ++j) {
          const double w = weight(row, static_cast<Eigen::Index>(j));
          information[to + i][to + j] += w;
          if (!from) continue;
          information[*from + i][*from + j] += w;
          information[to + i][*from + j] -= w;
          information[*from + i][to + j] -= w;
        }
      }
    };
    for (std::size_t i = 0; i < steps; ++i) {
      const LogStep& step = log.steps[i];
      const auto before = i == 0 ? std::nullopt : std::optional<std::size_t>(2 * (i - 1));
      add(2 * i, before, rotated(heading_rad, step.odometry.position),
          Eigen::Matrix2d{{0.1, 0.0}, {0.0, 0.2}});
      heading_rad += step.odometry.heading_rad;
      for (const LandmarkSighting& s : step.sightings) {
        add(2 * (steps + static_cast<std::size_t>(*s.id)), 2 * i, rotated(heading_rad, s.position),
            s.covariance);
      }
    }
    const testing::Dense covariance = testing::inverse(information);
    const testing::Dense mean = testing::product(covariance, pull);
    const auto same = [&](std::size_t at, Vec2 position, const auto& block) {
      EXPECT_NEAR(position.x, mean[at][0], 1e-9);
      EXPECT_NEAR(position.y, mean[at + 1][0], 1e-9);
      for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
          EXPECT_NEAR(block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                      covariance[at + i][at + j], 1e-9);
        }
      }
    };
    same(2 * (steps - 1), slam.pose().position, slam.pose_covariance());
    double least = squares;  // of all sums of squares: that of the mean
    std::int64_t seen = 0;
    for (std::size_t i = 0; i < n; ++i) least -= pull[i][0] * mean[i][0];
    for (const LogStep& step : log.steps) seen += static_cast<std::int64_t>(step.sightings.size());
    EXPECT_NEAR(slam.cost(), least, 1e-6 * squares);
    EXPECT_EQ(slam.degrees_of_freedom(), 2 * (seen - static_cast<std::int64_t>(tags)));
    const LandmarkMap map = slam.landmarks();
    ASSERT_EQ(map.size(), tags);
    for (const LandmarkEstimate& tag : map) {
      same(2 * (steps + static_cast<std::size_t>(tag.id)), tag.position, tag.covariance);
    }
  }
}

/// The same log as one graph, for the solver that knows nothing of steps.
PoseGraph as_graph(const LandmarkLog& log) {
  PoseGraph graph;
  std::map<std::int64_t, std::uint32_t> points;
  graph.nodes.push_back({"start", log.start, false});
  std::uint32_t last = 0;
  for (const LogStep& step : log.steps) {
    const auto pose = static_cast<std::uint32_t>(graph.nodes.size());
    graph.nodes.push_back({std::to_string(pose), {}, false});
    graph.edges.push_back({EdgeKind::pose, last, pose, step.odometry, step.covariance.inverse()});
    last = pose;
    for (const LandmarkSighting& s : step.sightings) {
      if (!points.contains(*s.id)) {
        points[*s.id] = static_cast<std::uint32_t>(graph.nodes.size());
        graph.nodes.push_back({"tag " + std::to_string(*s.id), {}, true});
      }
      GraphEdge edge{EdgeKind::point, pose, points[*s.id], {s.position, 0.0}};
      edge.information.topLeftCorner<2, 2>() = s.covariance.inverse();
      graph.edges.push_back(edge);
    }
  }
  EXPECT_TRUE(place_from_edges(graph, std::vector<bool>(graph.nodes.size(), false)));
  for (GraphNode& node : graph.nodes) {
    const Vec2 turned = rotated(log.start.heading_rad, node.pose.position);
    node.pose = {log.start.position + turned,
                 node.is_point ? 0.0 : node.pose.heading_rad + log.start.heading_rad};
  }
  return graph;
}

TEST(LandmarkSlam, TheGraphSettlesWhereTheBatchSolverDoes) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(testing::cases(3)); ++seed) {
    const TagRun run = tag_run(seed, {4, 2});
    LandmarkSlamOptions options;
    options.patience = 1;
    options.gate = 1.0;
    options.reorder_every = 37;
    LandmarkSlam slam = after(options, run.log);
    const auto batch = optimise(as_graph(run.log), {}, {});
    ASSERT_TRUE(batch);
    EXPECT_GE(slam.cost(), batch->cost - 1e-6);
    std::int64_t seen = 0;
    for (const LogStep& step : run.log.steps) seen += static_cast<std::int64_t>(step.sightings.size());
    EXPECT_EQ(slam.degrees_of_freedom(), 2 * (seen - 8)) << "a step has as many values as its pose";
    slam.settle();
    EXPECT_NEAR(slam.cost(), batch->cost, 1e-6 * batch->cost);
    const auto marginals = marginal_covariances(as_graph(run.log), batch->poses);
    ASSERT_TRUE(marginals);
    const PoseGraph graph = as_graph(run.log);
    for (const LandmarkEstimate& tag : slam.landmarks()) {
      for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        if (graph.nodes[i].name != "tag " + std::to_string(tag.id)) continue;
        EXPECT_NEAR(distance(tag.position, batch->poses[i].position), 0.0, 1e-6);
        EXPECT_NEAR(tag.covariance(0, 0), (*marginals)[i](0, 0), 1e-8);
        EXPECT_NEAR(tag.covariance(0, 1), (*marginals)[i](0, 1), 1e-8);
      }
    }
  }
}

TEST(LandmarkSlam, StoppedAndContinuedItIsTheSameToTheByte) {
  const TagRun run = tag_run(5, {8, 2});
  for (const std::string& engine : engines) {
    LandmarkSlamOptions options;
    options.engine = engine;
    options.reorder_every = 30;
    options.kernel = "huber";
    LandmarkSlam whole = begun(options, run.log.start);
    LandmarkSlam stopped = begun(options, run.log.start);
    for (std::size_t i = 0; i < run.log.steps.size(); ++i) {
      ASSERT_TRUE(whole.advance(run.log.steps[i]));
      ASSERT_TRUE(stopped.advance(run.log.steps[i]));
      if (i % 17 != 3) continue;
      auto loaded = LandmarkSlam::load(stopped.state());
      ASSERT_TRUE(loaded) << engine;
      stopped = std::move(*loaded);
    }
    EXPECT_EQ(stopped.state(), whole.state()) << engine;
    EXPECT_EQ(stopped.landmarks(), whole.landmarks()) << engine;
  }
}

TEST(LandmarkSlam, RefusesADamagedState) {
  const TagRun run = tag_run(6);
  for (const std::string& engine : engines) {
    LandmarkSlamOptions options;
    options.engine = engine;
    const std::string state = after(options, run.log).state();
    ASSERT_TRUE(LandmarkSlam::load(state));
    Rng rng(7);
    for (int i = 0; i < testing::cases(50); ++i) {
      EXPECT_FALSE(LandmarkSlam::load(state.substr(0, state.size() - 2 - rng.below(state.size() - 2))));
      std::string changed = state;
      changed[rng.below(changed.size())] = static_cast<char>('0' + rng.below(75));
      const auto loaded = LandmarkSlam::load(changed);
      EXPECT_TRUE(!loaded || std::isfinite(loaded->pose().position.x));
    }
    EXPECT_FALSE(LandmarkSlam::load(state + "1"));
  }
  EXPECT_EQ(LandmarkSlam::load("what").error().sentence,
            "this is no state of landmark SLAM, or a damaged one; save it again");
}

TEST(LandmarkSlam, AGhostIsRefused) {
  for (const std::string& engine : engines) {
    TagRun run = tag_run(8, {4, 1});
    const Eigen::Matrix2d covariance = 1e-4 * Eigen::Matrix2d::Identity();
    run.log.steps[20].sightings.push_back({77, {1.0, 0.2}, covariance});
    run.log.steps[50].sightings.push_back({77, {0.5, -0.2}, covariance});
    LandmarkSlamOptions options;
    options.engine = engine;
    options.patience_distance_m = 0.3;
    for (const LandmarkEstimate& tag : after(options, run.log).landmarks()) EXPECT_NE(tag.id, 77) << engine;
  }
}

TEST(LandmarkSlam, ALandmarkThatMovedComesOutAndComesBack) {
  for (const std::string engine : {"ekf", "graph"}) {
    TagRun run = tag_run(9, {4, 3});
    const std::size_t third = run.log.steps.size() / 3;
    const Vec2 shift = {-0.4, 0.3};
    for (std::size_t i = third; i < run.log.steps.size(); ++i) {
      for (LandmarkSighting& s : run.log.steps[i].sightings) {
        if (s.id == 2) s.position = s.position + unrotated(run.poses[i].heading_rad, shift);
      }
    }
    LandmarkSlamOptions options;
    options.engine = engine;
    LandmarkSlam slam = begun(options, run.log.start);
    int removed = 0;
    for (const LogStep& step : run.log.steps) removed += static_cast<int>(slam.advance(step)->removed.size());
    EXPECT_EQ(removed, 1) << engine;
    bool found = false;
    for (const LandmarkEstimate& tag : slam.landmarks()) {
      const Vec2 truth = run.log.true_landmarks.at(tag.id) + (tag.id == 2 ? shift : Vec2{});
      EXPECT_LT(distance(tag.position, truth), 0.1) << engine << " " << tag.id;
      found = found || tag.id == 2;
    }
    EXPECT_TRUE(found) << engine;
  }
}

TEST(LandmarkSlam, ALandmarkThatIsMissedIsTakenOut) {
  for (const std::string engine : {"ekf", "graph"}) {
    TagRun run = tag_run(10, {4, 3});
    for (std::size_t i = run.log.steps.size() / 3; i < run.log.steps.size(); ++i) {
      std::erase_if(run.log.steps[i].sightings, [](const LandmarkSighting& s) { return s.id == 2; });
    }
    LandmarkSlamOptions options;
    options.engine = engine;
    options.sensor_range_m = 2.5;
    options.field_of_view_rad = radians(90.0);
    options.misses = 10;
    const LandmarkMap map = after(options, run.log).landmarks();
    EXPECT_EQ(map.size(), 7U) << engine;
    for (const LandmarkEstimate& tag : map) EXPECT_NE(tag.id, 2) << engine;
  }
}

TEST(LandmarkSlam, ARobotThatWasCarriedAwaySaysThatItIsLost) {
  for (const std::string engine : {"ekf", "graph"}) {
    TagRun run = tag_run(11, {4, 2});
    LandmarkSlamOptions options;
    options.engine = engine;
    options.lost_after = 5;
    LandmarkSlam slam = begun(options, run.log.start);
    const std::size_t half = run.log.steps.size() / 2;
    bool lost = false;
    for (std::size_t i = 0; i < run.log.steps.size(); ++i) {
      LogStep step = run.log.steps[i];
      if (i > half) {
        for (LandmarkSighting& s : step.sightings) s.position = s.position + Vec2{3.0, -2.0};
      }
      const auto outcome = slam.advance(step);
      ASSERT_TRUE(outcome);
      EXPECT_TRUE(i > half || !outcome->lost);
      lost = lost || outcome->lost;
    }
    EXPECT_TRUE(lost) << engine;
  }
}

/// The courses of the report: mean errors of each tag over 20 seeds, and whether the ellipses mean what they
/// say: the normalised squared error of the last pose lies within the 95 % band of its mean, that of a tag
/// within the 99.9 % band.
TEST(LandmarkSlam, TagsStandWithinFiveCentimetresAndTheirEllipsesAreHonest) {
  const int seeds = testing::part_of(20);
  std::vector<TagCourse> courses = {{4, 1}, {8, 1}};
  if (testing::cases(1) > 1) courses = {{4, 1}, {4, 2}, {8, 1}, {8, 2}};
  for (const TagCourse course : courses) {
    for (const std::string engine : {"ekf", "graph"}) {
      std::map<std::int64_t, Vec2> error;
      std::map<std::int64_t, double> tag_nees;
      double pose_nees = 0.0;
      for (int seed = 1; seed <= seeds; ++seed) {
        const TagRun run = tag_run(static_cast<std::uint64_t>(seed), course);
        LandmarkSlamOptions options;
        options.engine = engine;
        LandmarkSlam slam = after(options, run.log);
        slam.settle();
        const LandmarkMap map = slam.landmarks();
        EXPECT_EQ(map.size(), 8U) << engine << " " << course.sides;
        for (const LandmarkEstimate& tag : map) {
          const Vec2 off = tag.position - run.log.true_landmarks.at(tag.id);
          error[tag.id] = error[tag.id] + Vec2{std::abs(off.x), std::abs(off.y)};
          const Eigen::Vector2d tag_error(off.x, off.y);
          tag_nees[tag.id] += tag_error.dot(tag.covariance.inverse() * tag_error);
        }
        const Pose2 estimate = slam.pose(), truth = run.poses.back();
        const Vec2 off = estimate.position - truth.position;
        const Eigen::Vector3d pose_error(off.x, off.y, wrap_angle(estimate.heading_rad - truth.heading_rad));
        pose_nees += pose_error.dot(slam.pose_covariance().inverse() * pose_error);
      }
      if (!testing::in_full()) continue;
      for (const auto& [id, sum] : error) {
        EXPECT_LE(sum.x / seeds, 0.05) << engine << " " << course.sides << " x " << course.laps;
        EXPECT_LE(sum.y / seeds, 0.05) << engine << " " << course.sides << " x " << course.laps;
        EXPECT_GE(tag_nees[id], 16.91) << "chi squared of 40 at 0.05 %";
        EXPECT_LE(tag_nees[id], 76.10) << "chi squared of 40 at 99.95 %";
      }
      EXPECT_GE(pose_nees, 40.48) << "chi squared of 60 at 2.5 %: " << engine << " " << course.sides;
      EXPECT_LE(pose_nees, 83.30) << "chi squared of 60 at 97.5 %: " << engine << " " << course.sides;
    }
  }
}

TEST(LandmarkSlam, RefusesInASentence) {
  const auto refusal = [](LandmarkSlamOptions options) {
    const auto slam = LandmarkSlam::begin(options, {});
    return slam ? std::string("taken") : to_string(slam.error());
  };
  LandmarkSlamOptions options;
  EXPECT_EQ(refusal(options), "taken");
  options.engine = "fastslam";
  EXPECT_EQ(refusal(options), "engine: 'fastslam' is not valid; expected kalman, ekf or graph");
  options.engine = "graph";
  options.unknown_ids = true;
  EXPECT_EQ(refusal(options), "engine: the graph takes landmarks with ids only; take the engine ekf");
  LandmarkSlam slam = begun({}, {});
  const std::string before = slam.state();
  LogStep step;
  step.odometry.position.x = NAN;
  EXPECT_EQ(slam.advance(step).error().sentence, "its odometry is not finite; leave the step out");
  step = {};
  step.sightings.assign(1001, {3, {1.0, 0.0}, Eigen::Matrix2d::Identity()});
  EXPECT_EQ(slam.advance(step).error().sentence,
            "it has 1001 sightings; a step has at most 1000, so split it");
  step.sightings = {{3, {1.0, 0.0}, Eigen::Matrix2d::Zero()}};
  EXPECT_EQ(slam.advance(step).error().sentence,
            "the covariance of a sighting is not positive definite; correct it");
  step.sightings = {{std::nullopt, {1.0, 0.0}, Eigen::Matrix2d::Identity()}};
  EXPECT_EQ(slam.advance(step).error().sentence, "a sighting has no id; set unknown_ids");
  EXPECT_EQ(slam.state(), before);
}

}  // namespace
}  // namespace outrider
