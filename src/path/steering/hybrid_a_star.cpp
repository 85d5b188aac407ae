#include "outrider/path/steering/hybrid_a_star.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../placed_trace.hpp"
#include "corner_distances.hpp"
#include "free_lengths.hpp"
#include "outrider/search/best_first.hpp"
#include "state_table.hpp"
#include "steering/motions/analytic_end.hpp"
#include "steering/motions/hybrid_motions.hpp"
#include "steering/motions/turning_pieces.hpp"
#include "steering_plan.hpp"

namespace outrider {
namespace {

constexpr double most_cells_a_side = 67'108'864.0;  // of 26 bits
constexpr State goal_state = 1;

/// A pose of the search, in cells, and the motion that led to it.
struct HybridNode {
  Vec2 position;
  std::uint32_t heading = 0;
  TurningPiece motion = {};  ///< without a length for poses at the start
  [[nodiscard]] int direction() const { return motion.length_m == 0.0 ? 0 : motion.length_m < 0.0 ? -1 : 1; }
};

struct HybridMemory {
  SearchMemory<double> search;
  StateTable states;
  std::vector<HybridNode> nodes;
  OutlineRoom room;
  CornerDistances corners;
  FreeLengths free;
  HybridMotions motions;
};

struct HybridPolicy {
  using Cost = double;

  const SteeringQuery& query;
  const HybridAStarOptions& options;
  HybridMemory& memory;
  double cell;
  AnalyticEnd end = {};      ///< of the cheapest way to the goal
  std::uint64_t waited = 0;  ///< expansions since an end was tried
  std::uint64_t generated = 0;
  bool full = false;  ///< poses were left out as there were too many

  [[nodiscard]] std::size_t states() const { return memory.nodes.size(); }
  [[nodiscard]] static State start() { return start_state; }
  [[nodiscard]] static bool is_goal(State s) { return s == goal_state; }
  [[nodiscard]] static double value(double cost) { return cost; }
  [[nodiscard]] double priority(double g, double h) const { return g + options.weight * h; }
  static void settle(State /*s*/) {}

  [[nodiscard]] double estimate(State s) const {
    if (s == goal_state) return 0.0;
    if (s == start_state) return memory.corners.at(query.start);
    return estimate(memory.nodes[s]);
  }
  [[nodiscard]] double estimate(const HybridNode& node) const {
    const double point = memory.corners.at(node.position);
    if (!query.goal_heading_rad) return point;
    const Pose2 pose{node.position, memory.motions.heading_rad(node.heading)};
    Pose2 seen = relative_pose({query.goal, *query.goal_heading_rad}, pose);
    seen.position = (1.0 / query.radius) * seen.position;
    return std::max(point, query.radius * memory.free.at(seen, query.reverse));
  }

  [[nodiscard]] std::uint64_t key_of(const HybridNode& node) const {
    const auto column = static_cast<std::uint64_t>(node.position.x / cell);
    const auto row = static_cast<std::uint64_t>(node.position.y / cell);
    return (row << 36U) | (column << 10U) | node.heading;
  }
  [[nodiscard]] double known(State s) const {
    return memory.search.labels.known(s) ? memory.search.labels.g(s)
                                         : std::numeric_limits<double>::infinity();
  }

  template <class Relax>
  void expand(State s, Relax& relax) {
    if (s == start_state) {
      begin(relax);
      return;
    }
    const HybridNode node = memory.nodes[s];
    const double g = memory.search.labels.g(s);
    try_end(s, node, g, relax);
    for (const HybridMotion& motion : memory.motions.from(node.heading)) {
      const bool cusp = node.direction() * motion.piece.length_m < 0.0;
      reach({node.position + motion.shift, motion.heading, motion.piece}, s,
            g + motion.cost + (cusp ? query.cusp : 0.0), relax,
            [&] { return memory.motions.clear(motion, node.position); });
    }
  }

  /// Puts the poses at the start into the queue: one, or of a start without a heading many.
  template <class Relax>
  void begin(Relax& relax) {
    const bool there =
        query.start == query.goal && (!query.start_heading_rad || !query.goal_heading_rad ||
                                      wrap_angle(*query.start_heading_rad - *query.goal_heading_rad) == 0.0);
    if (there) {
      end = {};
      relax(goal_state, start_state, 0.0, 0.0);
      return;
    }
    const auto headings = static_cast<std::uint32_t>(query.start_heading_rad ? 1 : options.headings);
    for (std::uint32_t heading = 0; heading < headings; heading += memory.motions.turn()) {
      const double looks = memory.motions.heading_rad(heading);
      reach({query.start, heading}, start_state, 0.0, relax,
            [&] { return clear_of_cells(query, {query.start, query.start, {}, 0.0}, looks); });
    }
  }

  /// Relaxes a pose if nothing is in the way to it.
  template <class Relax, class Clear>
  void reach(const HybridNode& node, State parent, double g, Relax& relax, Clear clear) {
    ++generated;
    const bool inside = node.position.x > 0.0 && node.position.y > 0.0;
    if (!inside) return;
    const std::uint64_t key = key_of(node);
    State s = memory.states.find(key);
    if (s != StateTable::none && (memory.search.labels.closed(s) || !(g < known(s)))) return;
    if (!clear()) return;
    const double h = estimate(node);
    if (std::isinf(h)) return;
    if (s == StateTable::none) {
      s = add_state(memory, key, node, options.most_states);
      if (s == StateTable::none) {
        full = true;
        return;
      }
    } else {
      memory.nodes[s] = node;
    }
    relax(s, parent, g, h);
  }

  /// Tries to end here, the more often the nearer the goal is.
  template <class Relax>
  void try_end(State s, const HybridNode& node, double g, Relax& relax) {
    const double h = estimate(node);
    if (static_cast<double>(waited++) < h / (2.0 * query.radius)) return;
    const double most = known(goal_state) - g;
    if (!(h < most)) return;
    waited = 0;
    const Pose2 pose{node.position, memory.motions.heading_rad(node.heading)};
    const auto found =
        analytic_end(query, pose, node.direction(), {query.goal, query.goal_heading_rad}, most);
    if (!found || !(g + found->cost < known(goal_state))) return;  // as relax() decides, rounding included
    end = *found;
    relax(goal_state, s, g + found->cost, 0.0);
  }
};

Status check(const HybridAStarOptions& options) {
  HybridAStarOptions copy = options;
  return check_ranges(describe(copy));
}

/// Returns the motions along the path, lengths in m, and the heading at its beginning.
std::pair<std::vector<TurningPiece>, double> motions_along(const HybridPolicy& search, double resolution_m) {
  const HybridMemory& memory = search.memory;
  std::vector<TurningPiece> motions;
  double heading_rad = search.query.start_heading_rad.value_or(0.0);
  for (const State s : path_to(goal_state, memory.search.labels)) {
    if (s == start_state || s == goal_state) continue;
    const HybridNode& node = memory.nodes[s];
    if (node.direction() == 0) heading_rad = memory.motions.heading_rad(node.heading);
    motions.push_back(node.motion);
  }
  motions.insert(motions.end(), search.end.path.pieces.begin(),
                 search.end.path.pieces.begin() + static_cast<std::ptrdiff_t>(search.end.path.count));
  motions = joined(motions, search.query.radius);
  for (int pass = 0; pass < search.options.passes; ++pass) {
    motions = shortened(search.query, heading_rad, motions);
  }
  for (TurningPiece& motion : motions) motion.length_m *= resolution_m;
  return {std::move(motions), heading_rad};
}

double lower_bound(const Problem& problem, const SteeringQuery& query, CornerDistances& corners) {
  const double point = problem.grid->frame.resolution_m * corners.lower_bound(query.start);
  if (!problem.start_heading_rad || !problem.goal_heading_rad) return point;
  const double radius_m = query.radius * problem.grid->frame.resolution_m;
  return std::max(
      point, shortest_turning_length({problem.start, *problem.start_heading_rad},
                                     {problem.goal, *problem.goal_heading_rad}, radius_m, query.reverse));
}

tl::unexpected<Fault> nothing_found(const HybridPolicy& search) {
  if (search.full) {
    return fault(
        FaultCode::budget_exhausted,
        fmt::format("the search holds {} poses, as many as it may; take a larger most_states or a larger "
                    "cell",
                    search.options.most_states));
  }
  return fault(
      FaultCode::budget_exhausted,
      fmt::format("no path was found with cells of {:.4g} m and {} headings, which proves nothing, as a "
                  "point gets to the goal; take a smaller cell or more headings",
                  search.cell * search.query.ground->frame.resolution_m, search.options.headings));
}

}  // namespace

std::vector<Option> describe(HybridAStarOptions& options) {
  std::vector<Option> all = describe(options.steering);
  all.push_back({"cell", "m", 0.0, 1e4,
                 "side of the cells that keep one pose for each heading; 0: a fifth of the "
                 "turning radius",
                 &options.cell_m});
  all.push_back({"headings", "", 8, 1000, "number of headings of a cell", &options.headings});
  all.push_back({"weight", "", 1.0, 100.0,
                 "weight of the estimate; above 1 the search is faster and the path longer",
                 &options.weight});
  all.push_back({"passes", "", 0, 100, "how often turning paths are tried in place of parts of the path",
                 &options.passes});
  all.push_back(
      {"most_states", "", 100, 50e6, "poses that the search may hold, 100 bytes each", &options.most_states});
  return all;
}

Outcome<Plan> hybrid_a_star(const Problem& asked, const HybridAStarOptions& options, const Budget& budget,
                            Workspace& workspace) {
  auto with = with_headings(asked, options.steering);
  if (!with) return pass_on(with);
  const Problem& problem = *with;
  if (auto ok = check(options); !ok) return pass_on(ok);
  HybridMemory& memory = workspace.get<HybridMemory>();
  auto query = steering_query(problem, options.steering, "hybrid_a_star", memory.room, budget.stop);
  if (!query) return pass_on(query);
  BudgetMeter meter(budget);
  if (auto ok = memory.corners.begin(memory.room.narrowed(), query->goal, query->start, budget.stop); !ok)
    return pass_on(ok);
  const double resolution_m = problem.grid->frame.resolution_m;
  const double cell = options.cell_m > 0.0 ? options.cell_m / resolution_m : 0.2 * query->radius;
  const double cells = std::max(query->ground->frame.width, query->ground->frame.height) / cell;
  if (!(cells <= most_cells_a_side)) {
    return bad_input(fmt::format("{:.4g} m makes {:.3g} cells a side, more than {:.0f}; take a larger one",
                                 cell * resolution_m, cells, most_cells_a_side),
                     "cell");
  }
  memory.motions.begin(*query, query->start_heading_rad.value_or(query->goal_heading_rad.value_or(0.0)),
                       static_cast<std::uint32_t>(options.headings), std::numbers::sqrt2 * cell);
  memory.states.begin();
  memory.nodes.assign(2, HybridNode{query->start, 0});
  memory.nodes[goal_state].position = query->goal;
  HybridPolicy search{*query, options, memory, cell};
  const PlacedTrace trace(workspace.trace);
  auto found = best_first(search, memory.search, meter, workspace.trace);
  trace.report([&](State s) { return problem.grid->frame.origin + resolution_m * memory.nodes[s].position; });
  if (!found) {
    return found.error().code == FaultCode::no_path ? nothing_found(search) : pass_on(found);
  }
  const auto [motions, heading_rad] = motions_along(search, resolution_m);
  auto pieces = pieces_along({problem.start, heading_rad}, motions, options.steering.turning_radius_m);
  if (!pieces.empty()) pieces.back().to = problem.goal;
  return steering_plan(problem, options.steering, problem.start, pieces,
                       lower_bound(problem, *query, memory.corners), {meter.spent(), search.generated, 0});
}

}  // namespace outrider
