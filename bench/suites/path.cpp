// Measures every path planner on published grids and checks each answer.
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "grids.hpp"
#include "outrider/io/files/index_file.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "rows.hpp"
#include "stopwatch.hpp"

namespace outrider::bench {
namespace {

struct MapRow {
  std::string map;
  PathPlanner planner;
  GridModel model = GridModel::cells;
  std::vector<double> times_us;  ///< one per answered query
  std::vector<double> ratios;    ///< cost relative to the published optimum, if known
  std::uint64_t expansions = 0;
  std::size_t unanswered = 0;
  std::size_t mismatches = 0;  ///< answers contradicted by the check or a published length
  std::string first_mismatch;
  double build_s = 0.0;
  double memory_mib = 0.0;
};

/// Returns the model for which published lengths exist for the planner's class of paths; nothing if the
/// planner takes no grid.
std::optional<GridModel> model_for(const PathPlanner& planner) {
  if (planner.models.empty()) return std::nullopt;
  const bool corners = planner.guarantee.among == PathClass::any_direction;
  const GridModel wanted = corners ? GridModel::corners : GridModel::cells;
  return planner.takes(wanted) ? wanted : planner.models.front();
}

std::string guarantee_of(const PathPlanner& planner) {
  if (planner.guarantee.most_ratio != 1.0) return "none";
  return planner.guarantee.among == PathClass::any_direction ? "any_angle_optimal" : "grid_optimal";
}

/// Returns the problem of a row; with `corners`, it runs between the top left corners of the cells.
Problem problem_of(const std::shared_ptr<const GridMap>& ground, const GridQueryRow& row) {
  const int up = ground->model == GridModel::corners ? 1 : 0;
  return {ground, ground->point({row.start.x, row.start.y + up}),
          ground->point({row.goal.x, row.goal.y + up})};
}

struct Optimum {
  double length = 0.0;
  double tolerance = 0.0;  ///< relative
};
std::optional<Optimum> optimum_of(const MapRow& row, const PublishedGrid& grid, const GridQueryRow& query) {
  const bool any_direction = row.planner.guarantee.among == PathClass::any_direction;
  if (any_direction != (row.model == GridModel::corners)) return std::nullopt;
  if (!any_direction && std::isfinite(grid.octile_tolerance))
    return Optimum{query.octile_length, grid.octile_tolerance};
  if (any_direction && query.shortest_length) return Optimum{*query.shortest_length, 1e-6};
  return std::nullopt;
}

/// Returns why the answer is wrong; empty if nothing contradicts it.
std::string contradiction(const MapRow& row, const Outcome<Plan>& plan, const Problem& problem,
                          const std::optional<Optimum>& optimum) {
  if (!plan) return optimum ? plan.error().sentence : std::string();
  if (auto verdict = check(*plan, problem); !verdict) return to_string(verdict.error());
  if (!optimum) return {};
  const double slack = optimum->tolerance * std::max(1.0, optimum->length);
  const bool longer = row.planner.guarantee.most_ratio == 1.0 && plan->cost > optimum->length + slack;
  if (plan->cost >= optimum->length - slack && !longer) return {};
  return fmt::format("length {} where {} is published", plan->cost, optimum->length);
}

void judge(MapRow& row, const Outcome<Plan>& plan, const Problem& problem,
           const std::optional<Optimum>& optimum) {
  if (auto reason = contradiction(row, plan, problem, optimum); !reason.empty()) {
    if (row.mismatches++ == 0) {
      row.first_mismatch = fmt::format("from ({}, {}) to ({}, {}): {}", problem.start.x, problem.start.y,
                                       problem.goal.x, problem.goal.y, reason);
    }
  }
  if (!plan) {
    ++row.unanswered;
    return;
  }
  row.expansions += plan->counters.expansions;
  if (!optimum) return;
  row.ratios.push_back(optimum->length > 0.0 ? plan->cost / optimum->length : 1.0);
}

std::size_t allocated_bytes() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

struct Timed {
  Outcome<Plan> plan;
  double time_us = 0.0;
};
Timed timed(const ConfiguredPlanner& planner, const Problem& problem, Workspace& workspace) {
  const Stopwatch watch;
  auto plan = planner.plan(problem, {}, workspace);
  return {std::move(plan), 1e6 * watch.seconds()};
}

/// The file in which a planner keeps its index of a map; empty if it keeps none.
std::string index_file(const PathRequest& request, const MapRow& row, const ConfiguredPlanner& planner) {
  if (request.index.empty() || !planner.save_index) return {};
  return fmt::format("{}/{}.{}.index", request.index, row.map, row.planner.name);
}

Outcome<MapRow> measure(const PathRequest& request, const GridFiles& files, const PublishedGrid& grid,
                        const PathPlanner& planner, const std::shared_ptr<const GridMap>& ground) {
  MapRow row{files.name, planner, ground->model, {}, {}, 0, 0, 0, {}, 0.0, 0.0};
  row.times_us.reserve(grid.rows.size());
  row.ratios.reserve(grid.rows.size());
  std::vector<double> best_us(grid.rows.size(), std::numeric_limits<double>::infinity());
  const std::size_t before = allocated_bytes();
  Workspace workspace;
  const ConfiguredPlanner configured = planner.configure();
  const Problem first = problem_of(ground, grid.rows.front());
  const std::string kept = index_file(request, row, configured);
  const Stopwatch watch;
  Outcome<bool> loaded = true;
  if (!kept.empty()) loaded = load_index_file(kept, configured, {ground}, workspace);
  if (!loaded) return pass_on(loaded);
  const double load_us = 1e6 * watch.seconds();
  const double cold_us = load_us + timed(configured, first, workspace).time_us;
  row.build_s = 1e-6 * std::max(0.0, cold_us - timed(configured, first, workspace).time_us);
  for (int round = 0; round < request.repeat; ++round) {  // round by round, so no query is still cached
    for (std::size_t i = 0; i < grid.rows.size(); ++i) {
      const Problem problem = problem_of(ground, grid.rows[i]);
      const Timed answer = timed(configured, problem, workspace);
      best_us[i] = std::min(best_us[i], answer.time_us);
      if (round == 0) judge(row, answer.plan, problem, optimum_of(row, grid, grid.rows[i]));
      if (!answer.plan) best_us[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  const std::size_t after = allocated_bytes();
  row.memory_mib = after > before ? static_cast<double>(after - before) / (1 << 20) : 0.0;
  if (!*loaded) {
    if (auto saved = save_index_file(kept, configured, {ground}, {}, workspace); !saved)
      return pass_on(saved);
  }
  std::copy_if(best_us.begin(), best_us.end(), std::back_inserter(row.times_us),
               [](double time) { return !std::isnan(time); });
  std::sort(row.times_us.begin(), row.times_us.end());
  return row;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(1, values.size()));
}

nlohmann::ordered_json row_json(const MapRow& row) {
  const auto number = [](bool known, double value) {
    return known ? nlohmann::ordered_json(value) : nullptr;
  };
  const bool answered = !row.times_us.empty(), known = !row.ratios.empty();
  return {{"map", row.map},
          {"planner", row.planner.name},
          {"model", to_string(row.model)},
          {"guarantee", guarantee_of(row.planner)},
          {"index", row.planner.index},
          {"queries", row.times_us.size()},
          {"unanswered", row.unanswered},
          {"mismatches", row.mismatches},
          {"mean_us", number(answered, mean(row.times_us))},
          {"median_us", number(answered, answered ? row.times_us[row.times_us.size() / 2] : 0.0)},
          {"worst_us", number(answered, answered ? row.times_us.back() : 0.0)},
          {"expansions",
           number(answered, static_cast<double>(row.expansions) /
                                static_cast<double>(std::max<std::size_t>(1, row.times_us.size())))},
          {"ratio_to_optimum_mean", number(known, mean(row.ratios))},
          {"ratio_to_optimum_max",
           number(known, known ? *std::max_element(row.ratios.begin(), row.ratios.end()) : 0.0)},
          {"build_s", row.build_s},
          {"memory_mib", row.memory_mib}};
}

std::string table_text(const std::vector<MapRow>& rows) {
  std::string text = fmt::format(
      "  {:<16} {:<18} {:>7} {:>10} {:>10} {:>10} {:>10} {:>9} {:>9} {:>8} {:>8}\n", "map", "planner",
      "queries", "mean us", "median us", "worst us", "expansions", "ratio", "at most", "build s", "MiB");
  for (const MapRow& row : rows) {
    const auto object = row_json(row);
    const auto shown = [&](const char* key, int digits) {
      return object[key].is_null() ? std::string("-")
                                   : fmt::format("{:.{}f}", object[key].get<double>(), digits);
    };
    text +=
        fmt::format("  {:<16} {:<18} {:>7} {:>10} {:>10} {:>10} {:>10} {:>9} {:>9} {:>8} {:>8}\n", row.map,
                    row.planner.name, row.times_us.size(), shown("mean_us", 1), shown("median_us", 1),
                    shown("worst_us", 1), shown("expansions", 0), shown("ratio_to_optimum_mean", 6),
                    shown("ratio_to_optimum_max", 6), shown("build_s", 4), shown("memory_mib", 2));
  }
  return text;
}

Outcome<std::vector<GridFiles>> chosen_maps(const PathRequest& request) {
  auto all = find_grids(request.data);
  if (!all || request.maps.empty()) return all;
  std::vector<std::string> known;
  for (const GridFiles& files : *all) known.push_back(files.name);
  for (const std::string& name : request.maps) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string nearest = nearest_name(name, known);
    return bad_input(fmt::format("there is no map '{}' with queries{}", name,
                                 nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)),
                     "--maps");
  }
  std::erase_if(*all, [&](const GridFiles& files) {
    return std::find(request.maps.begin(), request.maps.end(), files.name) == request.maps.end();
  });
  return all;
}

Outcome<std::vector<PathPlanner>> chosen_planners(const PathRequest& request) {
  std::vector<PathPlanner> planners;
  for (const std::string& name : request.planners) {
    auto planner = find_path_planner(name);
    if (!planner) return bad_input(planner.error().sentence, "--planners");
    if (!model_for(*planner)) return bad_input(fmt::format("{} takes no grids", name), "--planners");
    if (planner->guarantee.measure != Measure::length)
      return bad_input(fmt::format("{} does not look for short paths, which these tables hold", name),
                       "--planners");
    planners.push_back(std::move(*planner));
  }
  if (!request.planners.empty()) return planners;
  std::copy_if(path_planners().begin(), path_planners().end(), std::back_inserter(planners),
               [](const PathPlanner& planner) {
                 return model_for(planner).has_value() && planner.guarantee.measure == Measure::length;
               });
  return planners;
}

/// Measures all planners on one map, with one ground of each model at a time.
Status measure_map(const PathRequest& request, const GridFiles& files,
                   const std::vector<PathPlanner>& planners, const BenchObserver& observer,
                   std::vector<MapRow>& rows) {
  auto grid = load_grid(files, request.queries, request.all_rows);
  if (!grid) return pass_on(grid);
  for (const GridModel model : {GridModel::cells, GridModel::corners}) {
    std::shared_ptr<const GridMap> ground;
    for (const PathPlanner& planner : planners) {
      if (model_for(planner) != model) continue;
      next_step(observer, fmt::format("{} on {}", planner.name, files.name));
      if (!ground) {
        auto made = GridMap::of(grid->blocked, model);
        if (!made) return bad_input(made.error().sentence, files.map);
        ground = std::make_shared<const GridMap>(std::move(*made));
      }
      if (grid->rows.empty()) continue;
      auto row = measure(request, files, *grid, planner, ground);
      if (!row) return pass_on(row);
      rows.push_back(std::move(*row));
    }
  }
  return {};
}

}  // namespace

Outcome<BenchResult> measure_path(const PathRequest& request, const BenchObserver& observer) {
  auto maps = chosen_maps(request);
  if (!maps) return pass_on(maps);
  auto planners = chosen_planners(request);
  if (!planners) return pass_on(planners);
  begin_steps(observer, maps->size() * planners->size());
  std::vector<MapRow> rows;
  for (const auto& files : *maps) {
    if (auto ok = measure_map(request, files, *planners, observer, rows); !ok) return pass_on(ok);
  }
  BenchResult result = result_of(rows);
  for (const MapRow& row : rows) {
    if (row.mismatches == 0) continue;
    result.right = false;
    result.complaints.push_back(fmt::format("{} on {}: {} of {} answers are wrong, the first {}",
                                            row.planner.name, row.map, row.mismatches,
                                            row.times_us.size() + row.unanswered, row.first_mismatch));
  }
  return result;
}

}  // namespace outrider::bench
