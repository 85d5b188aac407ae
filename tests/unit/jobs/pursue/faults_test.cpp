// Pursuits with faults that the mission is not told: caught only if robot and target truly are in one cell.
#include <gtest/gtest.h>

#include <cmath>

#include "outrider/jobs/pursue/report.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct NoTime final : StopWatch {
  double lap_s() override { return 0.0; }
  void restart() override {}
};

/// A yard of 12 x 9 cells with a hedge, in which the target walks to and fro along the right edge.
PursuitProblem yard() {
  std::vector<std::string> rows(9, "111111111111");
  for (std::size_t y = 2; y < 7; ++y) rows[y][5] = '#';
  std::vector<Cell> target;
  for (int s = 0; s < 80; ++s) {
    const int phase = s % 16;
    target.push_back({10, phase < 8 ? phase : 16 - phase});
  }
  return testing::drawn_pursuit(rows, {0, 4}, target);
}

struct Done {
  PursuitRun run;
  Report report;
};

Done pursued(const TeamFaults& faults, int known_s, std::uint64_t seed = 1,
             const PursuitProblem& problem = yard()) {
  NoTime watch;
  PursuitRules rules;
  if (known_s >= 0) rules.known_s = known_s;
  auto run = pursue(problem, {problem.start}, rules, watch, {}, faults, seed);
  if (!run) throw std::runtime_error(to_string(run.error()));
  Done done{std::move(*run), {}};
  done.report = pursuit_report(problem, done.run, "yard");
  const PursuitState& state = done.run.state;
  const auto now_s = static_cast<std::size_t>(state.time_s);
  const bool truly = now_s > 0 && state.paths[0][now_s] == problem.target[now_s];
  EXPECT_EQ(done.report.status == "done", truly);
  EXPECT_EQ(done.report.reason.empty(), truly) << done.report.reason;
  for (const Cell cell : state.paths[0]) EXPECT_FALSE(problem.wall(cell));
  if (faults.any()) {
    EXPECT_EQ(metric(done.report, "false_catch"), 0.0);
    EXPECT_EQ(metric(done.report, "contacts"), 0.0);
  }
  return done;
}

TEST(PursueFaults, WithoutAnyNothingIsAdded) {
  const Done done = pursued({}, -1);
  EXPECT_EQ(done.report.status, "done");
  EXPECT_FALSE(done.run.faults);
  EXPECT_EQ(metric(done.report, "optimal"), 1.0);
  EXPECT_TRUE(std::isnan(metric(done.report, "false_catch")));
}

TEST(PursueFaults, FaultsThatDoNotHappenChangeNothing) {
  TeamFaults faults;
  faults.stuck_from_s = 1000.0;
  for (const int known_s : {-1, 0, 5}) {
    const Done with = pursued(faults, known_s), without = pursued({}, known_s);
    EXPECT_EQ(with.run.state.paths, without.run.state.paths) << known_s;
    EXPECT_EQ(with.run.lower_bound, without.run.lower_bound);
  }
}

TEST(PursueFaults, SightingsThatAreMissedLateOrWrongEndHonestly) {
  int caught = 0, runs = 0;
  for (int seed = 1; seed <= testing::cases(20); ++seed) {
    for (const int known_s : {0, 3}) {
      TeamFaults missed, late, wrong;
      missed.missed = 0.6;
      late.late_s = 5;
      wrong.wrong = 0.4;
      for (const TeamFaults& faults : {missed, late, wrong}) {
        const Done done = pursued(faults, known_s, static_cast<std::uint64_t>(seed));
        const TeamFaultCounts& counts = *done.run.faults;
        EXPECT_GT(counts.missing + counts.late + counts.wrong, 0);
        ++runs;
        caught += done.report.status == "done" ? 1 : 0;
      }
    }
  }
  EXPECT_GT(caught, runs / 2) << "most are caught all the same";
}

/// The robot waits where the target was seen last, and feels that it is not there.
TEST(PursueFaults, ATargetThatIsNotSeenAnyMoreMayEscape) {
  TeamFaults faults;
  faults.missing_from_s = 1.0;
  PursuitProblem problem = yard();
  for (std::size_t s = 8; s < problem.target.size(); ++s) problem.target[s] = {10, 8};
  EXPECT_EQ(pursued({}, 0, 1, problem).report.status, "done");
  const Done done = pursued(faults, 0, 1, problem);
  EXPECT_EQ(done.report.status, "not_done");
  EXPECT_NE(done.report.reason.find("sightings of it did not come"), std::string::npos) << done.report.reason;
}

TEST(PursueFaults, ARobotThatIsStuckForGoodIsNotDone) {
  TeamFaults faults;
  faults.stuck_from_s = 4.0;
  const Done done = pursued(faults, -1);
  EXPECT_EQ(done.report.status, "not_done");
  EXPECT_GT(done.run.faults->stuck_s, 0);
  EXPECT_NE(done.report.reason.find("did not move"), std::string::npos) << done.report.reason;
}

TEST(PursueFaults, ARobotThatIsStuckForAWhileGoesOn) {
  TeamFaults faults;
  faults.stuck_from_s = 4.0;
  faults.stuck_for_s = 6.0;
  const Done done = pursued(faults, -1);
  EXPECT_EQ(done.report.status, "done");
  EXPECT_GT(done.run.faults->stuck_s, 0);
  EXPECT_GE(metric(done.report, "cost"), metric(done.report, "lower_bound"));
}

/// A robot that was put nearer to the target claims no bound of the way from its start.
TEST(PursueFaults, ARobotThatIsPutElsewhereClaimsNoBound) {
  for (int seed = 1; seed <= testing::cases(20); ++seed) {
    TeamFaults faults;
    faults.kidnapped_at_s = 3.0;
    const Done done = pursued(faults, -1, static_cast<std::uint64_t>(seed));
    EXPECT_TRUE(done.run.faults->kidnapped);
    EXPECT_EQ(done.report.status, "done");
    EXPECT_EQ(done.run.lower_bound, 0U);
    EXPECT_EQ(metric(done.report, "optimal"), 0.0);
  }
}

TEST(PursueFaults, ClosedCellsAreGoneAround) {
  const std::vector<std::string> rows(9, "111111111111");
  const auto open = testing::drawn_pursuit(rows, {0, 4}, std::vector<Cell>(40, Cell{10, 4}));
  for (const double at_s : {0.0, 1.0}) {
    for (const double for_s : {5.0, 1e9}) {
      TeamFaults faults;
      faults.closed_at_s = at_s;
      faults.closed_for_s = for_s;
      faults.closed_ahead = 2;
      const Done done = pursued(faults, -1, 1, open);
      EXPECT_GT(done.run.faults->blocked, 0);
      EXPECT_EQ(done.report.status, "done") << done.report.reason;
      EXPECT_GE(metric(done.report, "cost"), metric(done.report, "lower_bound"));
    }
  }
}

TEST(PursueFaults, AWayThatClosesForGoodIsNotDone) {
  const auto corridor = testing::drawn_pursuit({"11111111"}, {0, 0}, std::vector<Cell>(30, Cell{7, 0}));
  TeamFaults faults;
  faults.closed_at_s = 1.0;
  const Done done = pursued(faults, -1, 1, corridor);
  EXPECT_EQ(done.report.status, "not_done");
  EXPECT_GT(done.run.faults->blocked, 1) << "it tries again";
  EXPECT_NE(done.report.reason.find("closed cells"), std::string::npos);
}

TEST(PursueFaults, SameSeedSameRun) {
  TeamFaults faults;
  faults.missed = 0.3;
  faults.wrong = 0.3;
  faults.kidnapped_at_s = 6.0;
  EXPECT_EQ(pursued(faults, 0, 7).run.state.paths, pursued(faults, 0, 7).run.state.paths);
  EXPECT_NE(pursued(faults, 0, 7).run.state.paths, pursued(faults, 0, 8).run.state.paths);
}

}  // namespace
}  // namespace outrider
