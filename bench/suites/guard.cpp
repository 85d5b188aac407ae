// Measures every guard planner in every yard, in the same simulated missions.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "guard_arrivals.hpp"
#include "guard_strewn.hpp"
#include "guard_teams.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "rows.hpp"
#include "stopwatch.hpp"

namespace outrider::bench {
namespace {

/// Splits the time of a mission by activity, in s.
struct Shares {
  double drive = 0.0;
  double turn = 0.0;
  double aim = 0.0;
  double flight = 0.0;
};

struct GuardRow {
  std::string yard;
  std::string planner;
  std::uint64_t seed = 1;
  double reached = 0.0;
  double failed = 0.0;
  double unreachable = 0.0;
  double shots = 0.0;
  double planning_s = 0.0;  ///< time of firing map and plan, the same for all seeds
  double planned_s = 0.0;
  double lower_bound_s = 0.0;
  double gap = 0.0;           ///< to the bound of all plans with the stops offered
  double anywhere_gap = 0.0;  ///< to the bound of all plans
  double mission_s = 0.0;
  Shares shares;
  std::optional<double> ratio;  ///< mission time relative to the first planner of the catalogue
};

/// Splits the time by what changes between consecutive poses. A guard logs its gun with each pose.
Shares shares_of(const Log& log) {
  Shares shares;
  const auto& poses = log.messages<geometry_msgs::PoseStamped>(topic::pose);
  const auto& guns = log.messages<sensor_msgs::JointState>(topic::joints);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Pose2 a = pose_of(poses[i - 1].message.pose), b = pose_of(poses[i].message.pose);
    const bool moved = a.position != b.position;
    const bool turned = a.heading_rad != b.heading_rad;
    const bool aimed = guns.at(i).message.position != guns.at(i - 1).message.position;
    double& share = moved ? shares.drive : turned ? shares.turn : aimed ? shares.aim : shares.flight;
    share += poses[i].time_s() - poses[i - 1].time_s();
  }
  return shares;
}

/// Loads the named scenarios, then the two worlds of the reference report from the data folder; or makes a
/// yard.
Outcome<std::vector<GuardScenario>> load_yards(const GuardRequest& request) {
  std::vector<GuardScenario> yards;
  if (request.targets > 0) {
    yards.emplace_back().problem = strewn_yard(request.targets);
    return yards;
  }
  for (const std::string& path : request.scenarios) {
    GuardScenario& yard = yards.emplace_back();
    GuardJob job;
    if (auto ok = read_scenario(job, path); !ok) return pass_on(ok);
    yard = std::move(job.scenario);
  }
  if (!request.data.empty()) {
    for (const char* world : {"by_small", "by_small2"}) {
      GuardScenario& yard = yards.emplace_back();
      yard.world = fmt::format("{}/worlds/{}.sdf", request.data, world);
      yard.targets = request.data + "/goals_params.txt";
    }
  }
  for (GuardScenario& yard : yards) {
    if (auto ok = load_problem(yard); !ok) return pass_on(ok);
  }
  return yards;
}

Outcome<std::vector<GuardPlanner>> chosen_planners(const GuardRequest& request) {
  if (request.planners.empty()) return guard_planners();
  std::vector<GuardPlanner> planners;
  for (const std::string& name : request.planners) {
    auto planner = find_guard_planner(name);
    if (!planner) return bad_input(planner.error().sentence, "--planners");
    planners.push_back(*planner);
  }
  return planners;
}

GuardRow row_of(const GuardScenario& yard, const GuardPlanner& planner, const Report& report, const Log& log,
                std::uint64_t seed, double planning_s) {
  const std::string file = std::filesystem::path(yard.world).stem().string();
  return {file.empty() ? yard.problem.world.name : file,
          std::string(planner.name),
          seed,
          metric(report, "reached"),
          metric(report, "failed"),
          metric(report, "unreachable"),
          metric(report, "shots"),
          planning_s,
          metric(report, "planned_s"),
          metric(report, "lower_bound_s"),
          metric(report, "gap"),
          metric(report, "anywhere_gap"),
          metric(report, "mission_s"),
          shares_of(log),
          {}};
}

/// Measures all planners in one yard: one firing map, one plan each, the same seeds.
Status measure_yard(const GuardRequest& request, const GuardScenario& yard,
                    const std::vector<GuardPlanner>& planners, const BenchObserver& observer,
                    std::vector<GuardRow>& rows) {
  const Stopwatch watch;
  auto firing_map = build_firing_map(yard.problem, yard.options);
  if (!firing_map) return pass_on(firing_map);
  const double survey_s = watch.seconds();
  const std::size_t first = rows.size();
  PreparedGuard guard{yard};
  for (const GuardPlanner& planner : planners) {
    next_step(observer, fmt::format("{} in {}", planner.name, yard.problem.world.name));
    const Stopwatch planning;
    auto plan = planner.plan(yard.problem, *firing_map, yard.options, {});
    if (!plan) return pass_on(plan);
    const double planning_s = survey_s + planning.seconds();
    for (std::int64_t seed = 1; seed <= request.seeds; ++seed) {
      guard.scenario.seed = seed;
      guard.mission.emplace(yard.problem, *firing_map, *plan);
      Log log;
      const Report report = run_guard({guard}, log).value();
      rows.push_back(row_of(yard, planner, report, log, static_cast<std::uint64_t>(seed), planning_s));
    }
  }
  for (std::size_t i = first; i < rows.size(); ++i) {
    for (std::size_t j = first; j < rows.size(); ++j) {
      const bool base = rows[j].planner == guard_planners().front().name && rows[j].seed == rows[i].seed;
      if (base && rows[j].mission_s > 0.0) rows[i].ratio = rows[i].mission_s / rows[j].mission_s;
    }
  }
  return {};
}

nlohmann::ordered_json row_json(const GuardRow& row) {
  return {{"yard", row.yard},
          {"planner", row.planner},
          {"seed", row.seed},
          {"reached", static_cast<int>(row.reached)},
          {"failed", static_cast<int>(row.failed)},
          {"unreachable", static_cast<int>(row.unreachable)},
          {"shots", static_cast<int>(row.shots)},
          {"planning_s", row.planning_s},
          {"planned_s", row.planned_s},
          {"lower_bound_s", row.lower_bound_s},
          {"gap", row.gap},
          {"anywhere_gap", row.anywhere_gap},
          {"mission_s", row.mission_s},
          {"drive_s", row.shares.drive},
          {"turn_s", row.shares.turn},
          {"aim_s", row.shares.aim},
          {"flight_s", row.shares.flight},
          {"ratio_to_best_tour", row.ratio ? nlohmann::ordered_json(*row.ratio) : nullptr}};
}

std::string table_text(const std::vector<GuardRow>& rows) {
  constexpr std::string_view cells =
      "  {:<12} {:<20} {:>4} {:>7} {:>6} {:>11} {:>5} {:>10} {:>9} {:>5} {:>10} {:>9} {:>7} {:>6} {:>6} "
      "{:>8} {:>6}\n";
  std::string text = fmt::format(cells, "yard", "planner", "seed", "reached", "failed", "unreachable",
                                 "shots", "planning s", "planned s", "gap %", "anywhere %", "mission s",
                                 "drive s", "turn s", "aim s", "flight s", "ratio");
  const auto tenths = [](double value) { return fmt::format("{:.1f}", value); };
  for (const GuardRow& row : rows) {
    text += fmt::format(cells, row.yard, row.planner, row.seed, row.reached, row.failed, row.unreachable,
                        row.shots, fmt::format("{:.2f}", row.planning_s), tenths(row.planned_s),
                        tenths(100.0 * row.gap), tenths(100.0 * row.anywhere_gap), tenths(row.mission_s),
                        tenths(row.shares.drive), tenths(row.shares.turn), tenths(row.shares.aim),
                        tenths(row.shares.flight),
                        row.ratio ? fmt::format("{:.2f}", *row.ratio) : std::string("-"));
  }
  return text;
}

Outcome<BenchResult> measure_policies(const GuardRequest& request) {
  auto rows = measure_arrivals(request.arrivals, request.seeds);
  if (!rows) return pass_on(rows);
  return BenchResult{true, arrivals_json(*rows), arrivals_table(*rows), {}};
}

Outcome<BenchResult> compare_teams(const GuardRequest& request, const std::vector<GuardScenario>& yards,
                                   const BenchObserver& observer) {
  auto rows = measure_teams(yards, request.robots, request.seeds, observer);
  if (!rows) return pass_on(rows);
  return BenchResult{true, teams_json(*rows), teams_table(*rows), {}};
}

}  // namespace

Outcome<BenchResult> measure_guard(const GuardRequest& request, const BenchObserver& observer) {
  if (!request.arrivals.empty()) return measure_policies(request);
  auto planners = chosen_planners(request);
  if (!planners) return pass_on(planners);
  auto yards = load_yards(request);
  if (!yards) return pass_on(yards);
  if (request.robots > 1) return compare_teams(request, *yards, observer);
  begin_steps(observer, yards->size() * planners->size());
  std::vector<GuardRow> rows;
  for (const auto& yard : *yards) {
    if (auto ok = measure_yard(request, yard, *planners, observer, rows); !ok) return pass_on(ok);
  }
  return result_of(rows);
}

}  // namespace outrider::bench
