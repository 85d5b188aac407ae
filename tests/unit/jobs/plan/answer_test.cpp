#include "outrider/jobs/plan/answer.hpp"

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/io/map/map_server.hpp"
#include "plan_case.hpp"

namespace outrider {
namespace {

using PlanAnswerTest = PlanCase;

/// Between a point and a segment.
double distance_to(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double length2 = dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return norm(p - (a + t * along));
}

/// Points along the pieces, arcs by their equation, close to each other.
std::vector<Vec2> sampled(const std::vector<TableArc>& pieces) {
  std::vector<Vec2> points;
  for (const TableArc& piece : pieces) {
    for (int i = 0; i <= 200; ++i) {
      const double t = i / 200.0;
      points.push_back(piece.turn_rad == 0.0
                           ? piece.from + t * (piece.to - piece.from)
                           : piece.centre + rotated(t * piece.turn_rad, piece.from - piece.centre));
    }
  }
  return points;
}

double sampled_length(const std::vector<Vec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  return length;
}

/// The least distance to the walls of the room by sampling.
double clearance_of(const std::vector<Vec2>& points) {
  const std::vector<std::vector<Vec2>> polygons = {{{0, 0}, {8, 0}, {8, 6}, {0, 6}},
                                                   {{3, 0}, {4, 0}, {4, 4}, {3, 4}}};
  double least = 1e9;
  for (const Vec2 p : points) {
    for (const auto& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        least = std::min(least, distance_to(p, polygon[i], polygon[(i + 1) % polygon.size()]));
      }
    }
  }
  return least;
}

TEST_F(PlanAnswerTest, RowsAgreeWithWhatSamplingSaysOfThePath) {
  const auto run =
      plan({{"map", write("a.txt", room)}, {"query", "all"}, {"compare", "true"}, {"radius", "0.5"}});
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  EXPECT_EQ(run->report.status, "done");
  ASSERT_GE(rows_of(*run), 12U);
  // Two tangents to the circles about (3, 4) and (4, 4), their arcs, and 1 m along the wall's end.
  double first = 1.0;
  for (const int aside : {2, 3}) {
    const double apart = std::hypot(aside, 3);
    first += std::sqrt(apart * apart - 0.25) + 0.5 * (std::atan2(3, aside) + std::asin(0.5 / apart));
  }
  int exact = 0;
  for (std::size_t i = 0; i < rows_of(*run); ++i) {
    SCOPED_TRACE(text_of(*run, i, "planner"));
    ASSERT_EQ(text_of(*run, i, "status"), "done");
    const auto pieces = value<std::vector<TableArc>>(*run, i, "pieces");
    const auto points = pieces.empty() ? waypoints_of(*run, i) : sampled(pieces);
    EXPECT_NEAR(number_of(*run, i, "length_m"), sampled_length(points), 1e-4);
    EXPECT_GE(clearance_of(points), 0.5 - 1e-6);
    if (!pieces.empty()) {
      EXPECT_NEAR(number_of(*run, i, "clearance_m"), clearance_of(points), 1e-3);
    }
    EXPECT_LE(number_of(*run, i, "lower_bound"), number_of(*run, i, "cost") + 1e-9);
    EXPECT_EQ(number_of(*run, i, "query"),
              1.0 + std::floor(2.0 * static_cast<double>(i) / static_cast<double>(rows_of(*run))));
    const bool shortest = text_of(*run, i, "guarantee") == "disk_optimal";
    if (!shortest) continue;
    ++exact;
    EXPECT_EQ(number_of(*run, i, "optimal"), 1.0);
    EXPECT_NEAR(number_of(*run, i, "cost"), number_of(*run, i, "query") == 1.0 ? first : 6.0, 1e-9);
  }
  EXPECT_EQ(exact, 6);
  EXPECT_NEAR(metric(run->report, "cost"), 6.0, 1e-9);
}

TEST_F(PlanAnswerTest, SeveralGoalsAreAsManySingleQuestions) {
  const std::vector<std::string> goals = {"5,0", "0,3", "5,3"};
  const std::string map = write("a.map", cells);
  for (const char* planner : {"dijkstra", "a_star", "jps_plus", "octile_labels"}) {
    const auto many = plan({{"map", map}, {"from", "0,0"}, {"to", "5,0 0, 3  5,3"}, {"planner", planner}});
    ASSERT_TRUE(many.has_value()) << to_string(many.error());
    ASSERT_EQ(rows_of(*many), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto one = plan({{"map", map}, {"from", "0,0"}, {"to", goals[i]}, {"planner", planner}});
      EXPECT_EQ(number_of(*many, i, "cost"), number_of(*one, 0, "cost"));
      EXPECT_EQ(waypoints_of(*many, i), waypoints_of(*one, 0));
      EXPECT_EQ(number_of(*many, i, "query"), static_cast<double>(i + 1));
    }
  }
  const auto partly = plan({{"map", map}, {"from", "0,0"}, {"to", "5,0 99,0"}});
  ASSERT_TRUE(partly.has_value()) << to_string(partly.error());
  EXPECT_EQ(partly->report.status, "not_done");
  EXPECT_EQ(text_of(*partly, 0, "status"), "done");
  EXPECT_EQ(text_of(*partly, 1, "status"), "outside_map");
  EXPECT_TRUE(partly->report.reason.starts_with("query 2: "));
}

TEST_F(PlanAnswerTest, OneBlockedQueryDoesNotStopTheOthers) {
  const std::string map = write("a.txt", room + "(2.9,1) (7,1)\n(1,1) (3.5,1)\n(1,1) (9,9)\n");
  const auto run = plan({{"map", map}, {"query", "all"}, {"compare", "true"}});
  ASSERT_TRUE(run.has_value()) << to_string(run.error());
  const char* expected[] = {"done", "done", "start_blocked", "goal_blocked", "outside_map"};
  for (std::size_t i = 0; i < rows_of(*run); ++i) {
    EXPECT_EQ(text_of(*run, i, "status"),
              expected[static_cast<std::size_t>(number_of(*run, i, "query")) - 1]);
  }
  EXPECT_TRUE(run->report.reason.starts_with("query 3: ")) << run->report.reason;
  const auto alone = plan({{"map", map}, {"query", "3"}});
  EXPECT_EQ(alone.error().code, FaultCode::start_blocked);
}

TEST_F(PlanAnswerTest, ATurnedMapIsAnsweredInTheWorld) {
  const std::string pgm =
      "P2\n6 4\n255\n254 254 254 0 254 254\n254 254 254 0 254 254\n254 254 254 0 254 254\n254 254 254 254 "
      "254 254\n";
  const auto yaml = [](double yaw) {
    return "image: m.pgm\nresolution: 0.5\norigin: [10, 20, " + std::to_string(yaw) +
           "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  };
  write("m.pgm", pgm);
  const auto straight = plan(
      {{"map", write("m.yaml", yaml(0))}, {"from", "10.25,21.75"}, {"to", "12.75,21.75"}, {"radius", "0"}});
  const Changes ask = {
      {"map", write("t.yaml", yaml(pi / 2))}, {"from", "8.25,20.25"}, {"to", "8.25,22.75"}, {"radius", "0"}};
  const auto turned = plan(ask);
  ASSERT_TRUE(straight.has_value()) << to_string(straight.error());
  ASSERT_TRUE(turned.has_value()) << to_string(turned.error());
  const auto a = waypoints_of(*straight, 0), b = waypoints_of(*turned, 0);
  ASSERT_EQ(a.size(), b.size());
  // A point (u, v) from the origin lies at (-v, u) when the map is turned by 90 degrees.
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(b[i].x, 10 - (a[i].y - 20), 1e-5);
    EXPECT_NEAR(b[i].y, 20 + (a[i].x - 10), 1e-5);
  }
  PlanJob job;
  ASSERT_TRUE(change(job, ask) && job.load());
  const auto question = question_of(*job.task);
  ASSERT_TRUE(question.has_value()) << to_string(question.error());
  EXPECT_NEAR(question->ground->bounds().low.x, 8.0, 1e-5);
  EXPECT_NEAR(question->ground->bounds().high.y, 23.0, 1e-5);
}

TEST_F(PlanAnswerTest, AWorldIsPolygonsToAPlannerThatTakesThose) {
  const std::string yard = std::string(OUTRIDER_SOURCE_DIR) + "/scenarios/yard/yard.sdf";
  const Changes ask = {{"map", yard}, {"from", "0,-6"}, {"to", "4,4"}, {"radius", "0.3"}};
  const auto with = [&](const char* planner) {
    Changes changes = ask;
    changes.emplace_back("planner", planner);
    return plan(changes);
  };
  const auto exact = with("visibility_graph"), grid = with("theta_star");
  ASSERT_TRUE(exact.has_value()) << to_string(exact.error());
  ASSERT_TRUE(grid.has_value()) << to_string(grid.error());
  EXPECT_EQ(text_of(*exact, 0, "guarantee"), "disk_optimal");
  EXPECT_GE(number_of(*exact, 0, "clearance_m"), 0.3 - 3e-9);
  EXPECT_LT(number_of(*exact, 0, "cost"), number_of(*grid, 0, "cost") + 0.15);
}

/// The least distance of sampled legs to one square wall, or to the rim of a map of 12 by 8 m.
double distance_to_wall(const std::vector<Vec2>& points) {
  double least = 1e9;
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (int k = 0; k <= 400; ++k) {
      const Vec2 p = points[i - 1] + (k / 400.0) * (points[i] - points[i - 1]);
      const Vec2 nearest{std::clamp(p.x, 5.0, 7.0), std::clamp(p.y, 3.0, 5.0)};
      least = std::min({least, norm(p - nearest), p.x, p.y, 12.0 - p.x, 8.0 - p.y});
    }
  }
  return least;
}

TEST_F(PlanAnswerTest, ClearanceIsThatOfTheMiddleOfTheRobotOnEveryGround) {
  std::string rows;
  for (int y = 0; y < 8; ++y) rows += y == 3 || y == 4 ? ".....@@.....\n" : "............\n";
  const std::string grid = write("wall.map", "type octile\nheight 8\nwidth 12\nmap\n" + rows);
  const std::string polygons =
      write("wall.txt", "(0,0) (12,0) (12,8) (0,8)\n---\n(5,3) (7,3) (7,5) (5,5)\n---\n");
  for (const std::string& map : {grid, polygons}) {
    for (const char* radius : {"0.05", "0.3", "0.8"}) {
      const auto run = plan({{"map", map},
                             {"from", "2.5,4.5"},
                             {"to", "9.5,3.5"},
                             {"radius", radius},
                             {"planner", "theta_star"}});
      ASSERT_TRUE(run.has_value()) << to_string(run.error());
      ASSERT_EQ(text_of(*run, 0, "status"), "done") << map << " " << radius;
      EXPECT_NEAR(number_of(*run, 0, "clearance_m"), distance_to_wall(waypoints_of(*run, 0)), 1e-3)
          << map << " " << radius;
      EXPECT_GE(number_of(*run, 0, "clearance_m"), std::stod(radius) - 1e-9);
    }
  }
}

TEST_F(PlanAnswerTest, AFootprintIsTheRobotOfOnesThatSteerAndADiskOfOthers) {
  const std::string parking = std::string(OUTRIDER_SOURCE_DIR) + "/scenarios/parking/parking.sdf";
  const Changes car = {{"map", parking},
                       {"from", "4,5.5,0"},
                       {"to", "11.9,1.2,0"},
                       {"footprint", "-0.8,-0.9 3.2,-0.9 3.2,0.9 -0.8,0.9"},
                       {"planner", "hybrid_a_star"},
                       {"hybrid_a_star.turning_radius", "4.5"}};
  const auto with = [&](Changes changes) {
    Changes all = car;
    all.insert(all.end(), changes.begin(), changes.end());
    return plan(all);
  };
  const auto snug = with({});
  ASSERT_TRUE(snug.has_value()) << to_string(snug.error());
  EXPECT_EQ(setting(*snug, "radius"), "0 m");
  EXPECT_EQ(text_of(*snug, 0, "status"), "done");
  EXPECT_GT(number_of(*snug, 0, "clearance_m"), 0.0);
  const auto room = with({{"radius", "0.05"}});
  ASSERT_TRUE(room.has_value());
  EXPECT_GE(number_of(*room, 0, "clearance_m"), 0.05 - 1e-9);
  const auto disk = with({{"planner", "theta_star"}, {"to", "11.9,5,0"}});
  ASSERT_TRUE(disk.has_value()) << to_string(disk.error());
  EXPECT_GE(number_of(*disk, 0, "clearance_m"), std::hypot(3.2, 0.9) - 1e-6) << "it may turn anywhere";
  for (const auto& [footprint, words] : {std::pair{"0.4", "it is a disk"},
                                         {"0,0 1,0 1,1", "outside its footprint"},
                                         {"0,0 1", "is no corner"}}) {
    const auto bad = with({{"footprint", footprint}});
    ASSERT_FALSE(bad.has_value()) << footprint;
    EXPECT_EQ(bad.error().where, "footprint");
    EXPECT_NE(bad.error().sentence.find(words), std::string::npos) << bad.error().sentence;
  }
}

TEST_F(PlanAnswerTest, AKeptWorkspaceAnswersTheSame) {
  PlanScenario scenario;
  scenario.map = write("a.txt", room);
  scenario.query = "all";
  const auto task = load_plan(scenario, {});
  ASSERT_TRUE(task.has_value()) << to_string(task.error());
  const auto question = question_of(*task);
  ASSERT_TRUE(question.has_value()) << to_string(question.error());
  Workspace workspace;
  const auto fresh = answer(*question);
  for (int i = 0; i < 2; ++i) {
    const auto kept = answer(*question, {.workspace = &workspace});
    ASSERT_EQ(kept->rows.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_EQ(kept->rows[k].plan->waypoints, fresh->rows[k].plan->waypoints);
  }
  std::stop_source source;
  source.request_stop();
  Budget stopped;
  stopped.stop = source.get_token();
  EXPECT_EQ(answer(*question, {}, stopped).error().code, FaultCode::cancelled);
}

}  // namespace
}  // namespace outrider
