#include "polygon_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/guard_scenario.hpp"
#include "outrider/io/polygons.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/from_polygons.hpp"
#include "outrider/path/visibility_graph.hpp"
#include "polygon_picture.hpp"
#include "progress.hpp"

namespace outrider::cli {
namespace {

using Planners = std::vector<std::pair<PathPlanner, ConfiguredPlanner>>;
using Clock = std::chrono::steady_clock;

/// The ground in both forms; the grid only where a planner needs it.
struct Grounds {
  std::shared_ptr<const PolygonGround> polygons;
  Grid<std::uint8_t> blocked;
  std::shared_ptr<const GridGround> grid;
};

struct NumberedQuery {
  std::size_t number = 0;  ///< in the file, from 1; 0 when the flags gave it
  PointQuery points;
};

struct PolygonRow {
  PathPlanner planner;
  NumberedQuery query;
  Outcome<Plan> plan;
  double time_us = 0.0;
  double build_us = 0.0;  ///< of what was built beforehand
  double clearance_m = 0.0;
};

Outcome<Planners> chosen(const PolygonPlan& request) {
  Planners planners = request.planners;
  if (request.compare) {
    std::erase_if(planners,
                  [&](const auto& p) { return !p.first.polygons && !p.first.takes(request.model); });
    return planners;
  }
  auto named = find_path_planner(request.planner.empty() ? "visibility_graph_reduced" : request.planner);
  if (!named) {
    named.error().where = "--planner";
    return pass_on(named);
  }
  if (!named->polygons && !named->takes(request.model)) {
    return bad_input(fmt::format("{} takes neither polygons nor a grid of {}; 'outrider list' says what each "
                                 "planner takes",
                                 named->name, to_string(request.model)),
                     "--planner");
  }
  std::erase_if(planners, [&](const auto& p) { return p.first.name != named->name; });
  return planners;
}

Outcome<std::vector<NumberedQuery>> queries_of(const PolygonPlan& request, const PolygonMap& map) {
  if (!request.query.empty() && (!request.from.empty() || !request.to.empty())) {
    return bad_input("it stands beside --from or --to; give one or the other", "--query");
  }
  if (request.query.empty()) {
    const auto point = [](const std::string& text, const std::string& flag) -> Outcome<Vec2> {
      if (text.empty()) return bad_input("it is missing; give x,y in m, or --query all", flag);
      auto numbers = parse_numbers(text, 2, flag, "x,y in m, such as 1.5,-2");
      if (!numbers) return pass_on(numbers);
      return Vec2{(*numbers)[0], (*numbers)[1]};
    };
    auto from = point(request.from, "--from");
    if (!from) return pass_on(from);
    auto to = point(request.to, "--to");
    if (!to) return pass_on(to);
    return std::vector<NumberedQuery>{{0, {*from, *to}}};
  }
  std::vector<NumberedQuery> queries;
  for (std::size_t i = 0; i < map.queries.size(); ++i) queries.push_back({i + 1, map.queries[i]});
  if (request.query == "all" && !queries.empty()) return queries;
  std::size_t number = 0;
  const char* end = request.query.data() + request.query.size();
  const auto [stop, error] = std::from_chars(request.query.data(), end, number);
  if (error != std::errc{} || stop != end || number < 1 || number > queries.size()) {
    return bad_input(
        fmt::format("'{}' is no query of this map, which has {}; it takes all or a number from 1",
                    request.query, queries.size()),
        "--query");
  }
  return std::vector<NumberedQuery>{queries[number - 1]};
}

Outcome<Grounds> grounds_of(const PolygonPlan& request, PolygonMap map, const Planners& planners) {
  auto polygons = PolygonGround::of(std::move(map.boundary), std::move(map.obstacles), request.radius_m);
  if (!polygons) return pass_on(polygons);
  Grounds grounds;
  grounds.polygons = std::make_shared<const PolygonGround>(std::move(*polygons));
  if (std::all_of(planners.begin(), planners.end(), [](const auto& p) { return p.first.polygons; })) {
    return grounds;
  }
  auto blocked = blocked_for_disk(*grounds.polygons, {.resolution_m = request.resolution_m.value_or(0.05)});
  if (!blocked) return pass_on(blocked);
  auto grid = GridGround::of(*blocked, request.model);
  if (!grid) return pass_on(grid);
  grounds.blocked = std::move(*blocked);
  grounds.grid = std::make_shared<const GridGround>(std::move(*grid));
  return grounds;
}

/// Plans and has the plan judged, by the rules of its ground and by exact distances to the polygons.
PolygonRow solve(const std::pair<PathPlanner, ConfiguredPlanner>& planner, const Grounds& grounds,
                 const NumberedQuery& query, Workspace& workspace) {
  Problem problem{nullptr, query.points.start, query.points.goal};
  if (planner.first.polygons) problem.polygons = grounds.polygons;
  if (!planner.first.polygons) problem.grid = grounds.grid;
  const auto begin = Clock::now();
  auto plan = planner.second.plan(problem, {}, workspace);
  const std::chrono::duration<double, std::micro> time = Clock::now() - begin;
  PolygonRow row{planner.first, query, std::move(plan), time.count()};
  if (!row.plan) return row;
  row.clearance_m = clearance_m(*row.plan, *grounds.polygons);
  auto verdict = check(*row.plan, problem);
  const bool clear = row.clearance_m >= grounds.polygons->radius_m - 2.0 * contact_m;
  if (!verdict || !clear) {
    throw std::logic_error(fmt::format("{} on query {}: {}", planner.first.name, query.number,
                                       verdict ? "the disk touches an edge" : to_string(verdict.error())));
  }
  return row;
}

std::vector<PolygonRow> solve_all(const Planners& planners, const Grounds& grounds,
                                  const std::vector<NumberedQuery>& queries, Progress& progress) {
  std::vector<PolygonRow> rows;
  for (const auto& planner : planners) {
    progress.next(std::string(planner.first.name));
    Workspace workspace;
    double build_us = 0.0;
    if (planner.first.index && !queries.empty()) {
      const double first = solve(planner, grounds, queries.front(), workspace).time_us;
      build_us = std::max(0.0, first - solve(planner, grounds, queries.front(), workspace).time_us);
    }
    for (const NumberedQuery& query : queries) {
      rows.push_back(solve(planner, grounds, query, workspace));
      rows.back().build_us = build_us;
    }
  }
  std::vector<PolygonRow> by_query;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    for (std::size_t i = q; i < rows.size(); i += queries.size()) by_query.push_back(rows[i]);
  }
  return by_query;
}

/// Among what the path is promised to be shortest.
std::string_view guarantee_of(const Guarantee& guarantee) {
  if (guarantee.most_ratio != 1.0) return "none";
  switch (guarantee.among) {
    case PathClass::along_moves: return "grid_optimal";
    case PathClass::any_direction: return "any_angle_optimal";
    case PathClass::any_curve: return "disk_optimal";
  }
  return "none";
}

nlohmann::ordered_json row_json(const PolygonRow& row) {
  nlohmann::ordered_json object = {{"planner", row.planner.name}};
  object["query"] =
      row.query.number == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(row.query.number);
  if (!row.plan) {
    object.update(fault_json(row.plan.error()));
    object["time_us"] = row.time_us;
    object["guarantee"] = guarantee_of(row.planner.guarantee);
    return object;
  }
  const Plan& plan = *row.plan;
  auto waypoints = nlohmann::ordered_json::array();
  for (const Vec2 p : plan.waypoints) waypoints.push_back({p.x, p.y});
  auto pieces = nlohmann::ordered_json::array();
  for (const PathPiece& piece : plan.pieces) {
    nlohmann::ordered_json one = {{"from", {piece.from.x, piece.from.y}}, {"to", {piece.to.x, piece.to.y}}};
    if (piece.turn_rad != 0.0) one["centre"] = {piece.centre.x, piece.centre.y};
    if (piece.turn_rad != 0.0) one["turn_rad"] = piece.turn_rad;
    pieces.push_back(std::move(one));
  }
  object.update({{"status", "done"},
                 {"cost", plan.cost},
                 {"length_m", plan.cost},
                 {"lower_bound", plan.lower_bound},
                 {"optimal", row.planner.guarantee.most_ratio == 1.0 &&
                                 plan.cost <= plan.lower_bound * (1.0 + 1e-9) + 1e-12},
                 {"expansions", plan.counters.expansions},
                 {"time_us", row.time_us},
                 {"build_us", row.build_us},
                 {"clearance_m", row.clearance_m},
                 {"checked", true},
                 {"guarantee", guarantee_of(row.planner.guarantee)},
                 {"reached_within_m", plan.reached_within},
                 {"waypoint_error_m", plan.waypoint_error_m},
                 {"waypoints", std::move(waypoints)},
                 {"pieces", std::move(pieces)}});
  return object;
}

void print_table(const std::vector<PolygonRow>& rows) {
  fmt::print("  {:>5}  {:<26} {:>10} {:>10} {:>10} {:>10} {:>11}\n", "query", "planner", "length m",
             "bound m", "expansions", "us", "clearance m");
  for (const PolygonRow& row : rows) {
    if (!row.plan) {
      fmt::print("  {:>5}  {:<26} {}\n", row.query.number, row.planner.name, row.plan.error().sentence);
      continue;
    }
    fmt::print("  {:>5}  {:<26} {:>10.4f} {:>10.4f} {:>10} {:>10.1f} {:>11.4f}\n", row.query.number,
               row.planner.name, row.plan->cost, row.plan->lower_bound, row.plan->counters.expansions,
               row.time_us, row.clearance_m);
  }
}

struct File {
  std::string path;
  std::string content;
};

/// One picture for each query, with the ways of all planners; and one of all queries, each its best way.
std::vector<File> pictures(const std::string& folder, const Grounds& grounds,
                           const std::vector<PolygonRow>& rows) {
  PolygonPicture base{grounds.polygons,
                      grounds.grid ? &grounds.blocked : nullptr,
                      visibility_legs(*grounds.polygons, false),
                      {}};
  PolygonPicture best = base;
  std::vector<File> files;
  for (std::size_t i = 0; i < rows.size();) {
    PolygonPicture one = base;
    const std::size_t number = rows[i].query.number;
    const PolygonRow* shortest = nullptr;
    for (; i < rows.size() && rows[i].query.number == number; ++i) {
      if (!rows[i].plan) continue;
      one.ways.push_back({std::string(rows[i].planner.name), *rows[i].plan});
      // The bound of the whole class of ways first: a start moved to a cell may look shorter.
      const bool better = shortest == nullptr || (rows[i].planner.polygons && !shortest->planner.polygons) ||
                          (rows[i].planner.polygons == shortest->planner.polygons &&
                           rows[i].plan->cost < shortest->plan->cost - 1e-9);
      if (better) shortest = &rows[i];
    }
    if (shortest != nullptr) best.ways.push_back({fmt::format("query {}", number), *shortest->plan});
    files.push_back({fmt::format("{}/query_{}.svg", folder, number), polygon_picture(one)});
  }
  files.push_back({folder + "/plan.svg", polygon_picture(best)});
  return files;
}

Status write_all(const PolygonPlan& request, const Grounds& grounds, const std::vector<PolygonRow>& rows,
                 const nlohmann::ordered_json& report) {
  std::vector<File> files;
  if (!request.out.empty()) {
    files = pictures(request.out, grounds, rows);
    files.push_back({request.out + "/plan.json", report.dump(1) + "\n"});
    if (auto ok = make_folder(request.out); !ok) return ok;
  }
  if (!request.svg.empty()) files.push_back({request.svg, pictures("", grounds, rows).back().content});
  for (const File& file : files) {
    if (auto ok = write_file(file.path, file.content); !ok) return ok;
  }
  return {};
}

struct Answer {
  Grounds grounds;
  std::vector<PolygonRow> rows;
};

Outcome<Answer> answer(const PolygonPlan& request) {
  if (!request.out.empty()) {
    if (auto ok = check_folder(request.out); !ok) return pass_on(ok);
  }
  auto planners = chosen(request);
  if (!planners) return pass_on(planners);
  Progress progress(1 + static_cast<int>(planners->size()));
  progress.next("reading the map");
  auto map = load_polygon_map(request.map);
  if (!map) return pass_on(map);
  auto queries = queries_of(request, *map);
  if (!queries) return pass_on(queries);
  auto grounds = grounds_of(request, std::move(*map), *planners);
  if (!grounds) return pass_on(grounds);
  for (const NumberedQuery& query : *queries) {
    auto good = polygon_query({nullptr, query.points.start, query.points.goal, grounds->polygons});
    if (good) continue;
    if (query.number > 0) good.error().where = fmt::format("{}, query {}", request.map, query.number);
    return pass_on(good);
  }
  auto rows = solve_all(*planners, *grounds, *queries, progress);
  return Answer{std::move(*grounds), std::move(rows)};
}

}  // namespace

bool is_polygon_map(const std::string& path) { return path.ends_with(".txt") || path.ends_with(".txt.gz"); }

int plan_on_polygons(const PolygonPlan& request) {
  const auto found = answer(request);
  if (!found) return say(found.error(), request.json);
  const auto failed =
      std::find_if(found->rows.begin(), found->rows.end(), [](const PolygonRow& row) { return !row.plan; });
  const bool all = failed == found->rows.end();
  nlohmann::ordered_json report = {{"status", all ? "done" : "not_done"},
                                   {"job", "plan"},
                                   {"map", request.map},
                                   {"radius_m", request.radius_m}};
  report["resolution_m"] =
      found->grounds.grid ? nlohmann::ordered_json(found->grounds.blocked.frame.resolution_m) : nullptr;
  report["rows"] = nlohmann::ordered_json::array();
  for (const PolygonRow& row : found->rows) report["rows"].push_back(row_json(row));
  if (auto ok = write_all(request, found->grounds, found->rows, report); !ok)
    return say(ok.error(), request.json);
  if (request.json) {
    print(report);
  } else {
    print_table(found->rows);
    if (!request.out.empty()) fmt::print("\n  pictures {}/plan.svg, query_K.svg\n", request.out);
    if (!request.svg.empty()) fmt::print("\n  picture  {}\n", request.svg);
  }
  return all ? job_done : say(failed->plan.error(), false);
}

}  // namespace outrider::cli
