// Measures every pursuit planner on every map of a folder and checks each answer.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "outrider/io/map/pursuit_map.hpp"
#include "outrider/pursuit/anytime.hpp"
#include "outrider/pursuit/catalog.hpp"
#include "outrider/pursuit/check.hpp"
#include "pursuit_smooth.hpp"
#include "rows.hpp"
#include "stopwatch.hpp"
#include "support/layer_programme.hpp"

namespace outrider::bench {
namespace {

namespace fs = std::filesystem;

struct PursuitRow {
  std::string map;
  std::string planner;
  std::string status = "caught";  ///< otherwise the code of the fault
  std::optional<PursuitPlan> plan;
  std::optional<double> ratio;    ///< cost relative to the optimum
  std::optional<double> first_s;  ///< time to the first catch
  std::optional<double> proof_s;  ///< time to the proof that it is the cheapest
  double planning_s = 0.0;
  std::optional<double> programme_s;  ///< time of the plain programme over layers, beside `anytime`
  std::string mismatch;               ///< contradiction by the check or the optimum
};

Budget budget_of(const PursuitRequest& request, double used_s) {
  const std::chrono::duration<double> left(std::max(0.0, request.limit_s - used_s));
  Budget budget;
  budget.wall_time = std::chrono::duration_cast<std::chrono::nanoseconds>(left);
  return budget;
}

/// Runs the anytime search and measures the times of its first catch and of its proof.
PursuitRow measure_search(const PursuitRequest& request, const PursuitProblem& problem) {
  PursuitRow row;
  const Stopwatch watch;
  AnytimePursuit search(problem);
  while (!search.proven() && row.planning_s < request.limit_s) {
    const auto worked = search.improve(budget_of(request, row.planning_s));
    row.planning_s = watch.seconds();
    if (!worked) {
      row.status = to_string(worked.error().code);
      return row;
    }
    if (search.best() && !row.first_s) row.first_s = row.planning_s;
  }
  row.plan = search.best();
  if (search.proven()) row.proof_s = row.planning_s;
  if (!row.plan) row.status = "budget_exhausted";
  return row;
}

/// Measures the search and the programme three times in turn, and keeps the shorter times.
PursuitRow measure_beside_programme(const PursuitRequest& request, const PursuitProblem& problem) {
  PursuitRow best;
  double programme_s = std::numeric_limits<double>::infinity();
  std::optional<std::uint64_t> least;
  for (int turn = 0; turn < 3; ++turn) {
    const Stopwatch watch;
    testing::LayerProgramme programme(problem);
    least = programme.least_cost();
    programme_s = std::min(programme_s, watch.seconds());
    PursuitRow row = measure_search(request, problem);
    if (turn == 0 || row.planning_s < best.planning_s) best = std::move(row);
  }
  best.programme_s = programme_s;
  if (best.proof_s && best.plan->cost != least) best.mismatch = "the programme has another cost";
  return best;
}

PursuitRow measure_planner(const PursuitRequest& request, const PursuitPlanner& planner,
                           const PursuitProblem& problem) {
  PursuitRow row;
  Workspace workspace;
  const ConfiguredPursuitPlanner configured = planner.configure();
  const Stopwatch watch;
  auto plan = configured.plan(problem, budget_of(request, 0.0), workspace);
  row.planning_s = watch.seconds();
  if (!plan) {
    row.status = to_string(plan.error().code);
    return row;
  }
  row.first_s = row.planning_s;
  if (plan->optimal()) row.proof_s = row.planning_s;
  row.plan = std::move(*plan);
  return row;
}

void judge(PursuitRow& row, const PursuitProblem& problem, const std::optional<std::uint64_t>& optimum) {
  if (!row.plan) return;
  if (const auto good = check(*row.plan, problem); !good) row.mismatch = to_string(good.error());
  if (!optimum) return;
  if (row.plan->cost < *optimum) row.mismatch = fmt::format("{} is below the optimum", row.plan->cost);
  if (*optimum > 0) row.ratio = static_cast<double>(row.plan->cost) / static_cast<double>(*optimum);
}

Status measure_map(const PursuitRequest& request, const fs::path& path,
                   const std::vector<PursuitPlanner>& planners, const BenchObserver& observer,
                   std::vector<PursuitRow>& rows) {
  const auto problem = load_pursuit_map(path.string());
  if (!problem) return pass_on(problem);
  std::optional<std::uint64_t> optimum;
  const std::string map = path.filename().string().substr(0, path.filename().string().find('.'));
  for (const PursuitPlanner& planner : planners) {
    next_step(observer, fmt::format("{} on {}", planner.name, map));
    PursuitRow row = planner.name == "anytime" ? measure_beside_programme(request, *problem)
                                               : measure_planner(request, planner, *problem);
    row.map = map;
    row.planner = planner.name;
    if (row.plan && row.plan->optimal()) optimum = row.plan->cost;
    judge(row, *problem, optimum);
    rows.push_back(std::move(row));
  }
  return {};
}

/// Finds the maps in the folder, searched recursively, ordered by length of name, then by path.
Outcome<std::vector<fs::path>> find_maps(const PursuitRequest& request) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::recursive_directory_iterator it(request.data, error), end; !error && it != end;
       it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!name.ends_with(".txt") && !name.ends_with(".txt.gz")) continue;
    const std::string stem = name.substr(0, name.find('.'));
    const bool wanted = request.maps.empty() || std::ranges::find(request.maps, stem) != request.maps.end();
    if (wanted) paths.push_back(it->path());
  }
  if (error) return bad_input(fmt::format("it cannot be searched: {}", error.message()), request.data);
  if (paths.empty()) {
    return bad_input("there is no such pursuit map in it; they end in .txt or .txt.gz", request.data);
  }
  std::ranges::sort(paths, {},
                    [](const fs::path& p) { return std::pair(p.filename().string().size(), p.string()); });
  return paths;
}

/// Returns the named planners in their order, or else the catalogue, which begins with the optimal one, so
/// that the ratios of the others are known.
Outcome<std::vector<PursuitPlanner>> chosen_planners(const PursuitRequest& request) {
  if (request.planners.empty()) return pursuit_planners();
  std::vector<PursuitPlanner> planners;
  for (const std::string& name : request.planners) {
    auto planner = find_pursuit_planner(name);
    if (!planner) return bad_input(planner.error().sentence, "--planners");
    planners.push_back(std::move(*planner));
  }
  return planners;
}

nlohmann::ordered_json row_json(const PursuitRow& row) {
  const auto known = [](const auto& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json object = {{"map", row.map}, {"planner", row.planner}, {"status", row.status}};
  object["cost"] = row.plan ? nlohmann::ordered_json(row.plan->cost) : nullptr;
  object["catch_time_s"] = row.plan ? nlohmann::ordered_json(row.plan->catch_time_s) : nullptr;
  object["optimal"] = row.plan && row.plan->optimal();
  object["ratio_to_optimum"] = known(row.ratio);
  object["first_feasible_s"] = known(row.first_s);
  object["proof_s"] = known(row.proof_s);
  object["planning_s"] = row.planning_s;
  object["programme_s"] = known(row.programme_s);
  object["expansions"] = row.plan ? nlohmann::ordered_json(row.plan->counters.expansions) : nullptr;
  object["mismatch"] = row.mismatch;
  return object;
}

std::string table_text(const std::vector<PursuitRow>& rows) {
  std::string text =
      fmt::format("  {:<8} {:<18} {:>10} {:>8} {:>8} {:>10} {:>10} {:>12} {:>12}\n", "map", "planner", "cost",
                  "catch s", "ratio", "first ms", "proof ms", "programme ms", "expansions");
  for (const PursuitRow& row : rows) {
    const auto ms = [](const std::optional<double>& s) {
      return s ? fmt::format("{:.2f}", 1e3 * *s) : std::string("-");
    };
    if (!row.plan) {
      text += fmt::format("  {:<8} {:<18} {} after {:.2f} ms\n", row.map, row.planner, row.status,
                          1e3 * row.planning_s);
      continue;
    }
    text += fmt::format("  {:<8} {:<18} {:>10} {:>8} {:>8} {:>10} {:>10} {:>12} {:>12}\n", row.map,
                        row.planner, row.plan->cost, row.plan->catch_time_s,
                        row.ratio ? fmt::format("{:.4f}", *row.ratio) : std::string("-"), ms(row.first_s),
                        ms(row.proof_s), ms(row.programme_s), row.plan->counters.expansions);
  }
  return text;
}

}  // namespace

Outcome<BenchResult> measure_pursuit(const PursuitRequest& request, const BenchObserver& observer) {
  if (request.smooth) return measure_smooth_pursuit(observer);
  if (request.data.empty())
    return bad_input("missing; give a folder with pursuit maps, or --smooth", "--data");
  auto maps = find_maps(request);
  if (!maps) return pass_on(maps);
  auto planners = chosen_planners(request);
  if (!planners) return pass_on(planners);
  begin_steps(observer, maps->size() * planners->size());
  std::vector<PursuitRow> rows;
  for (const auto& path : *maps) {
    if (auto ok = measure_map(request, path, *planners, observer, rows); !ok) return pass_on(ok);
  }
  BenchResult result = result_of(rows);
  for (const PursuitRow& row : rows) {
    if (row.mismatch.empty()) continue;
    result.right = false;
    result.complaints.push_back(fmt::format("{} on {}: {}", row.planner, row.map, row.mismatch));
  }
  return result;
}

}  // namespace outrider::bench
