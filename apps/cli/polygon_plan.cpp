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
#include "outrider/io/polygons.hpp"
#include "outrider/io/sdf.hpp"
#include "outrider/io/values.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/path/check.hpp"
#include "outrider/path/from_polygons.hpp"
#include "outrider/path/safety.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"
#include "outrider/path/visibility/visibility_graph.hpp"
#include "polygon_picture.hpp"
#include "progress.hpp"
#include "terminal.hpp"

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
  std::size_t number = 0;  ///< in the file or among several goals, from 1; 0 for one that the flags gave
  PointQuery points;
};

/// What the file holds.
struct Ask {
  std::vector<std::string> warnings;
  std::shared_ptr<const PolygonGround> polygons;
  std::vector<NumberedQuery> queries;
};

struct PolygonRow {
  PathPlanner planner;
  NumberedQuery query;
  Outcome<Plan> plan;
  double time_us = 0.0;
  double build_us = 0.0;  ///< of what was built beforehand
  double clearance_m = 0.0;
  double exposure = 0.0;
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

Outcome<Vec2> point(const std::string& text, const std::string& flag) {
  if (text.empty()) return bad_input("it is missing; give x,y in m, or --query all", flag);
  auto numbers = parse_numbers(text, 2, flag, "x,y in m, such as 1.5,-2");
  if (!numbers) return pass_on(numbers);
  return Vec2{(*numbers)[0], (*numbers)[1]};
}

/// From --from to each --to.
Outcome<std::vector<NumberedQuery>> queries_of_flags(const PolygonPlan& request) {
  auto from = point(request.from, "--from");
  if (!from) return pass_on(from);
  std::vector<NumberedQuery> queries;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, request.to.size()); ++i) {
    auto to = point(request.to.empty() ? "" : request.to[i], "--to");
    if (!to) return pass_on(to);
    queries.push_back({request.to.size() > 1 ? i + 1 : 0, {*from, *to}});
  }
  return queries;
}

Outcome<std::vector<NumberedQuery>> queries_of(const PolygonPlan& request,
                                               const std::vector<PointQuery>& of_map) {
  if (!request.query.empty() && (!request.from.empty() || !request.to.empty())) {
    return bad_input("it stands beside --from or --to; give one or the other", "--query");
  }
  if (request.query.empty()) return queries_of_flags(request);
  std::vector<NumberedQuery> queries;
  for (std::size_t i = 0; i < of_map.size(); ++i) queries.push_back({i + 1, of_map[i]});
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

Outcome<Ask> ask_of(const PolygonPlan& request) {
  Ask ask;
  std::vector<PointQuery> of_map;
  Outcome<PolygonGround> polygons = bad_input("");
  if (is_polygon_map(request.map)) {
    auto map = load_polygon_map(request.map);
    if (!map) return pass_on(map);
    of_map = std::move(map->queries);
    polygons = PolygonGround::of(std::move(map->boundary), std::move(map->obstacles), request.radius_m);
  } else {
    auto loaded = load_sdf(request.map);
    if (!loaded) return pass_on(loaded);
    ask.warnings = std::move(loaded->warnings);
    polygons = polygons_from_world(Ground::of(loaded->world, request.height_m), request.radius_m);
  }
  auto queries = queries_of(request, of_map);
  if (!queries) return pass_on(queries);
  if (!polygons) return pass_on(polygons);
  ask.polygons = std::make_shared<const PolygonGround>(std::move(*polygons));
  ask.queries = std::move(*queries);
  return ask;
}

Outcome<Grounds> grounds_of(const PolygonPlan& request, const Ask& ask, const Planners& planners) {
  Grounds grounds;
  grounds.polygons = ask.polygons;
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

using Planner = std::pair<PathPlanner, ConfiguredPlanner>;

Problem problem_of(const Planner& planner, const Grounds& grounds, const PointQuery& points) {
  Problem problem{nullptr, points.start, points.goal};
  if (planner.first.polygons) problem.polygons = grounds.polygons;
  if (!planner.first.polygons) problem.grid = grounds.grid;
  return problem;
}

/// The plan judged by the rules of its ground and by exact distances to the polygons. A start or a goal that
/// the polygons do not allow is refused in their words, with the distance, also to a planner on the grid.
PolygonRow judged(const Planner& planner, const Grounds& grounds, const NumberedQuery& query,
                  Outcome<Plan> plan, double time_us) {
  PolygonRow row{planner.first, query, std::move(plan), time_us};
  auto stands = polygon_query({nullptr, query.points.start, query.points.goal, grounds.polygons});
  if (!stands) row.plan = pass_on(stands);
  if (!row.plan) return row;
  const Safety safety =
      safety_of(*row.plan, {nullptr, query.points.start, query.points.goal, grounds.polygons});
  row.clearance_m = safety.clearance_m;
  row.exposure = safety.exposure;
  auto verdict = check(*row.plan, problem_of(planner, grounds, query.points));
  const bool clear = row.clearance_m >= grounds.polygons->radius_m - 2.0 * contact_m;
  if (!verdict || !clear) {
    throw std::logic_error(fmt::format("{} on query {}: {}", planner.first.name, query.number,
                                       verdict ? "the disk touches an edge" : to_string(verdict.error())));
  }
  return row;
}

PolygonRow solve(const Planner& planner, const Grounds& grounds, const NumberedQuery& query,
                 Workspace& workspace) {
  const Problem problem = problem_of(planner, grounds, query.points);
  const auto begin = Clock::now();
  auto plan = planner.second.plan(problem, {}, workspace);
  const std::chrono::duration<double, std::micro> time = Clock::now() - begin;
  return judged(planner, grounds, query, std::move(plan), time.count());
}

/// All goals from one start, in one search where the planner has one; each has its share of the time.
std::vector<PolygonRow> solve_many(const Planner& planner, const Grounds& grounds,
                                   const std::vector<NumberedQuery>& queries, Workspace& workspace) {
  std::vector<Vec2> goals;
  for (const NumberedQuery& query : queries) goals.push_back(query.points.goal);
  const Problem problem = problem_of(planner, grounds, queries.front().points);
  const auto begin = Clock::now();
  auto plans = plan_each(planner.second, problem, goals, {}, workspace);
  const std::chrono::duration<double, std::micro> time = Clock::now() - begin;
  std::vector<PolygonRow> rows;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double share_us = time.count() / static_cast<double>(queries.size());
    rows.push_back(judged(planner, grounds, queries[i], std::move(plans[i]), share_us));
  }
  return rows;
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
    const bool one_start = std::all_of(queries.begin(), queries.end(), [&](const NumberedQuery& query) {
      return query.points.start == queries.front().points.start;
    });
    std::vector<PolygonRow> of_planner;
    if (one_start && queries.size() > 1) {
      of_planner = solve_many(planner, grounds, queries, workspace);
    } else {
      for (const NumberedQuery& query : queries) {
        of_planner.push_back(solve(planner, grounds, query, workspace));
      }
    }
    for (PolygonRow& row : of_planner) {
      row.build_us = build_us;
      rows.push_back(std::move(row));
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
  if (std::isinf(guarantee.most_ratio)) return "none";
  if (guarantee.most_ratio != 1.0) return "bounded";
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
  object["from"] = {row.query.points.start.x, row.query.points.start.y};
  object["to"] = {row.query.points.goal.x, row.query.points.goal.y};
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
                 {"cost_unit", unit_of(row.planner.guarantee.measure)},
                 {"length_m", length_of(plan)},
                 {"lower_bound", plan.lower_bound},
                 {"optimal", row.planner.guarantee.most_ratio == 1.0 &&
                                 plan.cost <= plan.lower_bound * (1.0 + 1e-9) + 1e-12},
                 {"expansions", plan.counters.expansions},
                 {"time_us", row.time_us},
                 {"build_us", row.build_us},
                 {"clearance_m", row.clearance_m},
                 {"exposure", row.exposure},
                 {"checked", true},
                 {"guarantee", guarantee_of(row.planner.guarantee)},
                 {"reached_within_m", plan.reached_within},
                 {"waypoint_error_m", plan.waypoint_error_m},
                 {"waypoints", std::move(waypoints)},
                 {"pieces", std::move(pieces)}});
  return object;
}

void print_table(const std::vector<PolygonRow>& rows) {
  show("  {:>5}  {:<26} {:>10} {:>12} {:>12} {:>10} {:>10} {:>11} {:>9}\n", "query", "planner", "length m",
       "cost", "bound", "expansions", "us", "clearance m", "exposure");
  for (const PolygonRow& row : rows) {
    if (!row.plan) {
      show("  {:>5}  {:<26} {}\n", row.query.number, row.planner.name, row.plan.error().sentence);
      continue;
    }
    const std::string_view unit = unit_of(row.planner.guarantee.measure);
    show("  {:>5}  {:<26} {:>10.4f} {:>10.4f} {} {:>10.4f} {} {:>10} {:>10.1f} {:>11.4f} {:>9.3f}\n",
         row.query.number, row.planner.name, length_of(*row.plan), row.plan->cost, unit,
         row.plan->lower_bound, unit, row.plan->counters.expansions, row.time_us, row.clearance_m,
         row.exposure);
  }
}

/// One picture for each query, with the ways of all planners; and one of all queries, each its best way.
std::vector<NamedContent> pictures(const std::string& folder, const Grounds& grounds,
                                   const std::vector<PolygonRow>& rows) {
  PolygonPicture base{grounds.polygons,
                      grounds.grid ? &grounds.blocked : nullptr,
                      visibility_legs(*grounds.polygons, false),
                      {}};
  PolygonPicture best = base;
  std::vector<NamedContent> files;
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
                           length_of(*rows[i].plan) < length_of(*shortest->plan) - 1e-9);
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
  std::vector<NamedContent> files;
  if (!request.svg.empty()) files.push_back({request.svg, pictures("", grounds, rows).back().content});
  if (!request.out.empty()) {
    if (auto ok = make_folder(request.out); !ok) return ok;
    for (NamedContent& picture : pictures(request.out, grounds, rows)) files.push_back(std::move(picture));
    files.push_back({request.out + "/plan.json", json_text(report, 1) + "\n"});
  }
  return outrider::write_files(files);
}

struct Answer {
  std::vector<std::string> warnings;
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
  auto ask = ask_of(request);
  if (!ask) return pass_on(ask);
  auto grounds = grounds_of(request, *ask, *planners);
  if (!grounds) return pass_on(grounds);
  if (ask->queries.size() == 1) {
    const NumberedQuery& query = ask->queries.front();
    auto good = polygon_query({nullptr, query.points.start, query.points.goal, grounds->polygons});
    if (!good && query.number > 0)
      good.error().where = fmt::format("{}, query {}", request.map, query.number);
    if (!good) return pass_on(good);
  }
  auto rows = solve_all(*planners, *grounds, ask->queries, progress);
  return Answer{std::move(ask->warnings), std::move(*grounds), std::move(rows)};
}

}  // namespace

bool is_polygon_map(const std::string& path) { return path.ends_with(".txt") || path.ends_with(".txt.gz"); }

int plan_on_polygons(const PolygonPlan& request) {
  const auto found = answer(request);
  if (!found) return say(found.error(), request.json);
  warn(found->warnings);
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
    if (!request.out.empty()) show("\n  pictures {}/plan.svg, query_K.svg\n", request.out);
    if (!request.svg.empty()) show("\n  picture  {}\n", request.svg);
  }
  if (all) return job_done;
  Fault first = failed->plan.error();
  if (failed->query.number > 0) first.where = fmt::format("{}, query {}", request.map, failed->query.number);
  const int status = say(first, false);
  return found->rows.size() > 1 ? job_not_done : status;
}

}  // namespace outrider::cli
