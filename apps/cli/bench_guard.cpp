// bench guard: every guard planner in every yard, the same missions simulated.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench_arrivals.hpp"
#include "bench_words.hpp"
#include "clocks.hpp"
#include "commands.hpp"
#include "output.hpp"
#include "outrider/io/scenario.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/jobs/guard/guard_run.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "progress.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct BenchCommand {
  std::vector<std::string> scenarios = {"scenarios/yard/yard.yaml"};
  std::string data;
  std::vector<std::string> planners;
  std::string arrivals;
  std::int64_t seeds = 3;
  bool json = false;
};

/// What the time of a mission goes by with, s.
struct Shares {
  double drive = 0.0;
  double turn = 0.0;
  double aim = 0.0;
  double flight = 0.0;
};

struct Row {
  std::string yard;
  std::string planner;
  std::uint64_t seed = 1;
  double reached = 0.0;
  double failed = 0.0;
  double unreachable = 0.0;
  double shots = 0.0;
  double planning_s = 0.0;  ///< of survey and plan, the same for all seeds
  double planned_s = 0.0;
  double lower_bound_s = 0.0;
  double mission_s = 0.0;
  Shares shares;
  std::optional<double> ratio;  ///< of the mission to that of the first planner of the catalogue
};

/// By what changes from one instant of the track to the next.
Shares shares_of(const Report& report) {
  Shares shares;
  for (std::size_t i = 1; i < report.track.size(); ++i) {
    const TrackSample& a = report.track[i - 1];
    const TrackSample& b = report.track[i];
    const bool moved = a.pose.position != b.pose.position;
    const bool turned = a.pose.heading_rad != b.pose.heading_rad;
    const bool aimed = a.gun_yaw_rad != b.gun_yaw_rad || a.gun_pitch_rad != b.gun_pitch_rad;
    double& share = moved ? shares.drive : turned ? shares.turn : aimed ? shares.aim : shares.flight;
    share += b.time_s - a.time_s;
  }
  return shares;
}

/// The scenarios that were named, then the two worlds of the reference report in the data.
Outcome<std::vector<GuardScenario>> load_yards(const BenchCommand& command) {
  std::vector<GuardScenario> yards;
  for (const std::string& path : command.scenarios) {
    GuardScenario& yard = yards.emplace_back();
    if (auto ok = load_scenario(path, describe(yard)); !ok) return pass_on(ok);
    resolve_paths(yard, path);
  }
  if (!command.data.empty()) {
    for (const char* world : {"by_small", "by_small2"}) {
      GuardScenario& yard = yards.emplace_back();
      yard.world = fmt::format("{}/worlds/{}.sdf", command.data, world);
      yard.targets = command.data + "/goals_params.txt";
    }
  }
  for (GuardScenario& yard : yards) {
    if (auto ok = load_problem(yard); !ok) return pass_on(ok);
  }
  return yards;
}

Outcome<std::vector<GuardPlanner>> chosen_planners(const BenchCommand& command) {
  if (command.planners.empty()) return guard_planners();
  std::vector<GuardPlanner> planners;
  for (const std::string& name : command.planners) {
    auto planner = find_guard_planner(name);
    if (!planner) return bad_input(planner.error().sentence, "--planners");
    planners.push_back(*planner);
  }
  return planners;
}

Row row_of(const GuardScenario& yard, const GuardPlanner& planner, const Report& report, double planning_s) {
  return {std::filesystem::path(yard.world).stem().string(),
          std::string(planner.name),
          report.seed,
          metric(report, "reached"),
          metric(report, "failed"),
          metric(report, "unreachable"),
          metric(report, "shots"),
          planning_s,
          metric(report, "planned_s"),
          metric(report, "lower_bound_s"),
          metric(report, "mission_s"),
          shares_of(report),
          {}};
}

/// All planners in one yard: one survey, one plan each, the same seeds.
Status measure_yard(const BenchCommand& command, const GuardScenario& yard,
                    const std::vector<GuardPlanner>& planners, Progress& progress, std::vector<Row>& rows) {
  const auto begin = Clock::now();
  auto site = survey(yard.problem, yard.options);
  if (!site) return pass_on(site);
  const double survey_s = seconds_since(begin);
  const std::size_t first = rows.size();
  for (const GuardPlanner& planner : planners) {
    progress.next(fmt::format("{} in {}", planner.name, yard.problem.world.name));
    const auto start = Clock::now();
    auto plan = planner.plan(yard.problem, *site, yard.options, {});
    if (!plan) return pass_on(plan);
    const double planning_s = survey_s + seconds_since(start);
    for (std::int64_t seed = 1; seed <= command.seeds; ++seed) {
      const Report report =
          run_guard(yard.problem, *site, *plan, yard.options, static_cast<std::uint64_t>(seed));
      rows.push_back(row_of(yard, planner, report, planning_s));
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

nlohmann::ordered_json row_json(const Row& row) {
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
          {"mission_s", row.mission_s},
          {"drive_s", row.shares.drive},
          {"turn_s", row.shares.turn},
          {"aim_s", row.shares.aim},
          {"flight_s", row.shares.flight},
          {"ratio_to_best_tour", row.ratio ? nlohmann::ordered_json(*row.ratio) : nullptr}};
}

void print_table(const std::vector<Row>& rows) {
  show("  {:<12} {:<20} {:>4} {:>7} {:>6} {:>11} {:>5} {:>10} {:>9} {:>7} {:>6} {:>6} {:>8} {:>6}\n", "yard",
       "planner", "seed", "reached", "failed", "unreachable", "shots", "planning s", "mission s", "drive s",
       "turn s", "aim s", "flight s", "ratio");
  for (const Row& row : rows) {
    show(
        "  {:<12} {:<20} {:>4} {:>7} {:>6} {:>11} {:>5} {:>10.2f} {:>9.1f} {:>7.1f} {:>6.1f} {:>6.1f} "
        "{:>8.1f} {:>6}\n",
        row.yard, row.planner, row.seed, row.reached, row.failed, row.unreachable, row.shots, row.planning_s,
        row.mission_s, row.shares.drive, row.shares.turn, row.shares.aim, row.shares.flight,
        row.ratio ? fmt::format("{:.2f}", *row.ratio) : std::string("-"));
  }
}

int execute_arrivals(const BenchCommand& command) {
  const auto rows = measure_arrivals(command.arrivals, command.seeds);
  if (!rows) return say(rows.error(), command.json);
  if (command.json) {
    print({{"status", "done"}, {"job", "bench guard"}, {"rows", arrivals_json(*rows)}});
  } else {
    show("{}", arrivals_table(*rows));
  }
  return job_done;
}

int execute(const BenchCommand& command) {
  if (!command.arrivals.empty()) return execute_arrivals(command);
  const auto planners = chosen_planners(command);
  if (!planners) return say(planners.error(), command.json);
  const auto yards = load_yards(command);
  if (!yards) return say(yards.error(), command.json);
  std::vector<Row> rows;
  Progress progress(static_cast<int>(yards->size() * planners->size()));
  for (const GuardScenario& yard : *yards) {
    if (auto ok = measure_yard(command, yard, *planners, progress, rows); !ok) {
      progress.end();
      return say(ok.error(), command.json);
    }
  }
  progress.end();
  return tell("bench guard", rows, true, command.json);
}

}  // namespace

void add_bench_guard(Command& bench) {
  Command& guard = bench.add("guard", "guard planners: missions simulated, and where their time goes");
  auto command = std::make_shared<BenchCommand>();
  add_scenarios(guard, command->scenarios, "scenario files of yards [scenarios/yard/yard.yaml]");
  guard
      .option("--data", &command->data,
              "folder with goals_params.txt and worlds/by_small.sdf, by_small2.sdf, for these yards too")
      .type("DIR");
  add_names(guard, "--planners", command->planners);
  add_seeds(guard, command->seeds, "missions of each plan, with seeds from 1 on [3]");
  guard
      .option("--arrivals", &command->arrivals,
              "a scenario in which intruders keep coming: compare the policies there instead")
      .type("FILE");
  add_json(guard, command->json);
  guard.does([command](const Command&) { return execute(*command); });
  guard.footer("\nExample: outrider bench guard --planners best_tour,shrinking_circles");
}

}  // namespace outrider::cli
