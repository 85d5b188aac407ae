#include "outrider/jobs/explore/choose/decide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "map/reach.hpp"
#include "outrider/geometry/polyline.hpp"
#include "outrider/jobs/explore/choose/catalog.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/grid/line_of_sight.hpp"

namespace outrider {
namespace {

/// The vertices of a path without those that a straight leg between others makes needless.
std::vector<Cell> pulled(const GridMap& ground, const std::vector<Cell>& vertices) {
  std::vector<Cell> all;  // cell by cell, so that a leg may end between turns
  for (const Cell& turn : vertices) {
    while (!all.empty() && !(all.back() == turn)) {
      const Cell last = all.back();
      all.push_back(
          {last.x + (turn.x > last.x) - (turn.x < last.x), last.y + (turn.y > last.y) - (turn.y < last.y)});
    }
    if (all.empty()) all.push_back(turn);
  }
  std::vector<Cell> kept{all.front()};
  for (std::size_t i = 0; i + 1 < all.size();) {
    // The farthest in sight: doubled steps, then halved ones.
    std::size_t next = i + 1;
    for (std::size_t step = all.size(); step > 0; step /= 2) {
      while (next + step < all.size() && visible(ground, all[i], all[next + step])) next += step;
    }
    kept.push_back(all[next]);
    i = next;
  }
  return kept;
}

Outcome<std::vector<Vec2>> way_between(const std::shared_ptr<const GridMap>& ground, Vec2 from, Vec2 to,
                                       const std::string& planner, const Budget& budget,
                                       Workspace& workspace) {
  const auto is_free = [&](Cell c) { return ground->place(c); };
  const auto start = nearest_cell(ground->frame, from, snap_m, is_free);
  const auto goal = nearest_cell(ground->frame, to, snap_m, is_free);
  if (!start) return fault(FaultCode::start_blocked, "the robot stands on no known free ground");
  if (!goal) return fault(FaultCode::goal_blocked, "the goal is on no known free ground");
  auto row = find_path_planner(planner);
  if (!row) return pass_on(row);
  const Problem problem{ground, ground->point(*start), ground->point(*goal)};
  auto plan = row->configure().plan(problem, budget, workspace);
  if (!plan) return pass_on(plan);
  std::vector<Vec2> way{from};
  for (const Cell cell : pulled(*ground, plan->vertices)) way.push_back(ground->point(cell));
  if (way.size() > 2 && *start == ground->frame.cell_at(from)) way.erase(way.begin() + 1);
  return way;
}

/// Returns true for a fault that does not mean that no way leads there.
bool says_nothing(FaultCode code) {
  return code == FaultCode::bad_input || code == FaultCode::budget_exhausted;
}

std::optional<Decision> leaked(const ExploreState& state, const ExploreOptions& options) {
  const TraversabilityGrid& ground = state.map.ground();
  const double width = (ground.highest().x - ground.lowest().x + 1) * ground.frame().resolution_m;
  const double height = (ground.highest().y - ground.lowest().y + 1) * ground.frame().resolution_m;
  if (std::max(width, height) <= options.most_extent_m) return std::nullopt;
  Decision decision;
  decision.kind = DecisionKind::leak;
  decision.goal = state.home;
  decision.sentence = fmt::format(
      "the map is {:.1f} m x {:.1f} m and still open, more than the {:g} m of most_extent: the "
      "world leaks",
      width, height, options.most_extent_m);
  return decision;
}

int switches(const ExploreState& state, std::uint32_t chosen) {
  if (chosen == state.before.frontier) return state.before.switches;
  return state.map.frontiers().contains(state.before.frontier) ? state.before.switches + 1 : 0;
}

/// The views by their values, the best first, those without one last; of equal ones the first.
std::vector<std::size_t> best_first(const std::vector<double>& values, bool most_is_best) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto loss = [&](std::size_t i) {
    if (std::isnan(values[i])) return inf;
    return most_is_best ? -values[i] : values[i];
  };
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, loss);
  return order;
}

std::vector<ViewCandidate> candidates_of(const std::vector<View>& views, const std::vector<double>& values,
                                         const std::vector<std::size_t>& order) {
  std::vector<ViewCandidate> candidates;
  for (const std::size_t i : order) {
    const View& view = views[i];
    candidates.push_back(
        {view.pose.position, view.turn_s + view.reach_s, view.gain_m2, values[i], i == order.front()});
  }
  return candidates;
}

}  // namespace

std::string_view to_string(DecisionKind kind) {
  constexpr std::string_view names[] = {"go", "complete", "leak"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<std::string> planners_on_cells() { return names_of_planners_in_place(GridModel::cells); }

std::vector<Option> describe(ExploreOptions& options) {
  std::vector<Option> all = {
      choice_option("strategy", "how the next view is chosen: tour, information_gain or nearest",
                    &options.strategy, names_of(explore_strategies())),
      choice_option("planner", "path planner for the ways, one that takes cells", &options.planner,
                    planners_on_cells()),
      {"view", "m", 0.1, 1000.0, "largest distance from which the unknown is to be seen", &options.view_m},
      {"least_gain", "m2", 0.0, 100.0, "a frontier that hides less is refused", &options.least_gain_m2},
      {"momentum", "s", 0.0, 1000.0, "how much faster another choice must be to change the mind",
       &options.momentum_s},
      {"most_extent", "m", 1.0, 1e5, "a map wider or higher than this is a world that leaks",
       &options.most_extent_m},
      {"gap_margin", "m", 0.0, 1.0, "room to either side of the robot without which it enters no gap",
       &options.gap_margin_m},
      {"ban", "s", 0.0, 1e6, "for how long a goal is left alone after it failed", &options.ban_s},
      {"most_views", "", 1.0, 1000.0, "nearest frontiers that are weighed", &options.most_views}};
  for (Option& option : describe(options.frontier)) all.push_back(std::move(option));
  return all;
}

Outcome<std::vector<Vec2>> way_to(const ExploreState& state, Vec2 place, const ExploreOptions& options,
                                  Workspace& workspace) {
  return way_between(state.map.ground().grid(), state.pose.position, place, options.planner, state.budget,
                     workspace);
}

Outcome<Decision> decide(const ExploreState& state, const ExploreOptions& options, Workspace& workspace) {
  auto strategy = find_explore_strategy(options.strategy);
  if (!strategy) return pass_on(strategy);
  if (auto decision = leaked(state, options)) return *decision;
  if (!free_block_near(state.map.ground(), state.pose.position)) {
    return fault(FaultCode::start_blocked, "the robot stands on no known free ground; back off");
  }

  Decision decision;
  Views views = find_views(state, options, workspace);
  decision.refused = std::move(views.refused);
  while (!views.views.empty()) {
    const std::vector<double> values = strategy->values(views, state, options, workspace);
    const std::vector<std::size_t> order = best_first(values, strategy->most_is_best);
    const std::size_t chosen = order.front();
    const View& view = views.views[chosen];
    auto way = way_to(state, view.pose.position, options, workspace);
    if (!way && says_nothing(way.error().code)) return pass_on(way);
    if (way) {
      decision.kind = DecisionKind::go;
      decision.sentence =
          fmt::format("to see {:.2f} m2 in {:.1f} s", view.gain_m2, view.turn_s + view.reach_s);
      decision.choice = {view.frontier, view.pose.position, switches(state, view.frontier)};
      decision.goal = view.pose;
      decision.way_m = length_of(*way);
      decision.waypoints = std::move(*way);
      decision.gain_m2 = view.gain_m2;
      decision.candidates = candidates_of(views.views, values, order);
      if (decision.way_m < 2.0 * options.view_m) state.map.pursue(view.frontier);
      return decision;
    }
    const Frontier& frontier = state.map.frontiers().at(view.frontier);
    const auto after =
        std::ranges::upper_bound(decision.refused, view.frontier, {}, &RefusedFrontier::frontier);
    decision.refused.insert(after, {view.frontier, frontier.centroid, frontier.cells.size(), Refusal::no_way,
                                    way.error().sentence});
    views.views.erase(views.views.begin() + static_cast<std::ptrdiff_t>(chosen));
  }
  decision.goal = state.home;
  decision.sentence =
      fmt::format("no frontier is left that is worth going to; {} refused", decision.refused.size());
  if (auto way = way_to(state, state.home.position, options, workspace)) {
    decision.way_m = length_of(*way);
    decision.waypoints = std::move(*way);
  }
  return decision;
}

}  // namespace outrider
