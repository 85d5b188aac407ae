#include "outrider/path/steering/state_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../placed_trace.hpp"
#include "corner_distances.hpp"
#include "outrider/core/units.hpp"
#include "outrider/motion/turning_path.hpp"
#include "outrider/search/best_first.hpp"
#include "state_table.hpp"
#include "steering/motions/lattice_motions.hpp"
#include "steering_plan.hpp"

namespace outrider {
namespace {

constexpr double near_radii = 6.0;  // turning paths are asked for so near to the goal

/// A state of the search. `direction` is that of the last motion where cusps have a price, else 0.
struct LatticeNode {
  Cell cell;
  std::uint16_t heading = 0;
  std::int8_t direction = 0;
  const LatticeMotion* motion = nullptr;  ///< that led to it; null at the start
  double estimate = 0.0;
};

struct LatticeMemory {
  SearchMemory<double> search;
  StateTable states;
  std::vector<LatticeNode> nodes;
  OutlineRoom room;
  CornerDistances corners;
  LatticeMotions motions;
};

struct LatticePolicy {
  using Cost = double;
  static constexpr bool reopens = true;

  const SteeringQuery& query;
  const StateLatticeOptions& options;
  LatticeMemory& memory;
  Cell first;
  Cell last;
  std::optional<std::uint32_t> first_heading;
  std::optional<std::uint32_t> last_heading;
  std::uint64_t generated = 0;
  bool full = false;  ///< states were left out as there were too many

  [[nodiscard]] std::size_t states() const { return memory.nodes.size(); }
  [[nodiscard]] static State start() { return start_state; }
  [[nodiscard]] bool is_goal(State s) const {
    const LatticeNode& node = memory.nodes[s];
    return s != start_state && node.cell == last && (!last_heading || node.heading == *last_heading);
  }
  [[nodiscard]] static double value(double cost) { return cost; }
  [[nodiscard]] double priority(double g, double h) const { return g + options.weight * h; }
  static void settle(State /*s*/) {}
  [[nodiscard]] double estimate(State s) const { return memory.nodes[s].estimate; }

  [[nodiscard]] static Vec2 centre_of(Cell c) { return {c.x + 0.5, c.y + 0.5}; }

  /// Returns a lower bound of the cost from there to the goal.
  [[nodiscard]] double bound_from(Cell cell, std::uint32_t heading) const {
    const double point = memory.corners.lower_bound(centre_of(cell));
    const bool near =
        std::max(std::abs(cell.x - last.x), std::abs(cell.y - last.y)) < near_radii * query.radius;
    if (!near || !last_heading) return point;
    return std::max(point,
                    shortest_turning_length({centre_of(cell), memory.motions.heading_rad(heading)},
                                            {centre_of(last), memory.motions.heading_rad(*last_heading)},
                                            query.radius, query.reverse));
  }

  template <class Relax>
  void expand(State s, Relax& relax) {
    if (s == start_state) {
      for (std::uint32_t heading = 0; heading < memory.motions.headings(); ++heading) {
        if (!first_heading || heading == *first_heading) reach({first, heading16(heading)}, s, 0.0, relax);
      }
      return;
    }
    const LatticeNode node = memory.nodes[s];
    const double g = memory.search.labels.g(s);
    for (const LatticeMotion& motion : memory.motions.from(node.heading)) {
      const int direction = motion.backward ? -1 : 1;
      const bool cusp = node.direction == -direction;
      const Cell cell{node.cell.x + motion.shift.x, node.cell.y + motion.shift.y};
      reach({cell, heading16(motion.heading), static_cast<std::int8_t>(query.cusp > 0.0 ? direction : 0),
             &motion},
            s, g + motion.cost + (cusp ? query.cusp : 0.0), relax);
    }
  }

  static std::uint16_t heading16(std::uint32_t heading) { return static_cast<std::uint16_t>(heading); }

  [[nodiscard]] std::uint64_t key_of(const LatticeNode& node) const {
    const auto cell = static_cast<std::uint64_t>(query.ground->index(node.cell));
    return (cell * memory.motions.headings() + node.heading) * 3 +
           static_cast<std::uint64_t>(node.direction + 1);
  }

  /// Relaxes a state if nothing is in the way to it.
  template <class Relax>
  void reach(LatticeNode node, State parent, double g, Relax& relax) {
    ++generated;
    if (!query.ground->frame.contains(node.cell)) return;
    const std::uint64_t key = key_of(node);
    State s = memory.states.find(key);
    if (s != StateTable::none && !(g < memory.search.labels.g(s))) return;
    const LatticeNode& before = memory.nodes[parent];
    if (node.motion != nullptr ? !clear(*node.motion, before.cell) : !stands(node)) return;
    if (s == StateTable::none) {
      node.estimate = bound_from(node.cell, node.heading);
      if (std::isinf(node.estimate)) return;
      s = add_state(memory, key, node, options.most_states);
      if (s == StateTable::none) {
        full = true;
        return;
      }
    } else {
      memory.nodes[s].motion = node.motion;
    }
    relax(s, parent, g, memory.nodes[s].estimate);
  }

  [[nodiscard]] bool clear(const LatticeMotion& motion, Cell from) const {
    return query.room->is_wide(centre_of(from), motion.cost) ||
           LatticeMotions::clear(*query.ground, motion, from);
  }
  [[nodiscard]] bool stands(const LatticeNode& node) const {
    const Vec2 p = centre_of(node.cell);
    return clear_of_cells(query, {p, p, {}, 0.0}, memory.motions.heading_rad(node.heading));
  }
};

/// Returns the pieces along the path, m. Of straight ones that continue each other it makes one.
std::vector<PathPiece> pieces_of(const LatticePolicy& search, State goal, const GridFrame& frame) {
  std::vector<PathPiece> pieces;
  Cell at = search.first;
  for (const State s : path_to(goal, search.memory.search.labels)) {
    const LatticeNode& node = search.memory.nodes[s];
    if (node.motion == nullptr) continue;
    for (PathPiece piece : node.motion->pieces) {
      for (Vec2* p : {&piece.from, &piece.to, &piece.centre}) *p = frame.corner(at) + frame.resolution_m * *p;
      if (piece.turn_rad == 0.0) piece.centre = {};
      const bool goes_on = !pieces.empty() && piece.turn_rad == 0.0 && pieces.back().turn_rad == 0.0 &&
                           pieces.back().backward == piece.backward;
      if (goes_on) {
        pieces.back().to = piece.to;
      } else {
        pieces.push_back(piece);
      }
    }
    at = node.cell;
  }
  return pieces;
}

Status check(const StateLatticeOptions& options) {
  StateLatticeOptions copy = options;
  if (auto ok = check_ranges(describe(copy)); !ok) return ok;
  if (options.headings == 8 || options.headings == 16 || options.headings == 32) return {};
  return bad_input(fmt::format("{} is not valid; expected 8, 16 or 32", options.headings), "headings");
}

Status check_radius(const SteeringQuery& query) {
  if (query.radius <= LatticeMotions::most_radius) return {};
  return bad_input(
      fmt::format("it is {:.4g} cells, more than the {:g} for which motions are made; take a coarser grid",
                  query.radius, LatticeMotions::most_radius),
      "turning_radius");
}

tl::unexpected<Fault> nothing_found(const LatticePolicy& search) {
  if (search.full) {
    return fault(FaultCode::budget_exhausted,
                 fmt::format("the search holds {} states, as many as it may; take a larger most_states or a "
                             "coarser grid",
                             search.options.most_states));
  }
  return fault(
      FaultCode::budget_exhausted,
      fmt::format("no path of the lattice with {} headings leads there, which proves nothing of others, as a "
                  "point gets to the goal; take a finer grid, more headings or more turns",
                  search.options.headings));
}

/// Returns half of the largest angle between neighbouring headings.
double half_gap_rad(const LatticeMotions& motions) {
  double gap = 0.0;
  for (std::uint32_t i = 0; i < motions.headings(); ++i) {
    gap = std::max(gap, std::abs(wrap_angle(motions.heading_rad((i + 1) % motions.headings()) -
                                            motions.heading_rad(i))));
  }
  return 0.5 * gap;
}

}  // namespace

std::vector<Option> describe(StateLatticeOptions& options) {
  std::vector<Option> all = describe(options.steering);
  all.push_back({"headings", "", 8, 32, "headings of the lattice: 8, 16 or 32", &options.headings});
  all.push_back(
      {"turns", "", 1, 16, "motions from a heading to each other one, the shortest first", &options.turns});
  all.push_back({"weight", "", 1.0, 100.0,
                 "weight of the estimate; above 1 the search is faster and the path costs at most so many "
                 "times as much",
                 &options.weight});
  all.push_back({"most_states", "", 100, 50e6, "states that the search may hold, 100 bytes each",
                 &options.most_states});
  return all;
}

Outcome<Plan> state_lattice(const Problem& asked, const StateLatticeOptions& options, const Budget& budget,
                            Workspace& workspace) {
  auto with = with_headings(asked, options.steering);
  if (!with) return pass_on(with);
  const Problem& problem = *with;
  Problem snapped = problem;
  if (const auto vertices = grid_query(problem)) {
    snapped.start = vertices->ground.point(vertices->start);
    snapped.goal = vertices->ground.point(vertices->goal);
  }
  snapped.start_heading_rad = snapped.goal_heading_rad = std::nullopt;  // judged once they are of the lattice
  if (auto ok = check(options); !ok) return pass_on(ok);
  LatticeMemory& memory = workspace.get<LatticeMemory>();
  auto query = steering_query(snapped, options.steering, "state_lattice", memory.room, budget.stop);
  if (!query) return pass_on(query);
  if (auto ok = check_radius(*query); !ok) return pass_on(ok);
  memory.motions.make({static_cast<std::uint32_t>(options.headings),
                       static_cast<std::uint32_t>(options.turns), query->radius, query->reverse,
                       query->backward, query->outline, query->ground->stride});
  const GridFrame& frame = problem.grid->frame;
  LatticePolicy search{*query, options, memory, frame.cell_at(snapped.start), frame.cell_at(snapped.goal),
                       {},     {}};
  if (problem.start_heading_rad)
    search.first_heading = memory.motions.nearest_heading(*problem.start_heading_rad);
  if (problem.goal_heading_rad)
    search.last_heading = memory.motions.nearest_heading(*problem.goal_heading_rad);
  BudgetMeter meter(budget);
  if (auto ok = memory.corners.begin(memory.room.narrowed(), query->goal, query->start, budget.stop); !ok)
    return pass_on(ok);
  memory.states.begin();
  memory.nodes.assign(1, LatticeNode{search.first});
  memory.nodes[start_state].estimate = memory.corners.lower_bound(query->start);
  const PlacedTrace trace(workspace.trace);
  auto found = best_first(search, memory.search, meter, workspace.trace);
  trace.report([&](State s) { return frame.centre(memory.nodes[s].cell); });
  if (!found) {
    return found.error().code == FaultCode::no_path ? nothing_found(search) : pass_on(found);
  }
  const double bound = frame.resolution_m * memory.search.labels.g(*found) / options.weight;
  Plan plan = steering_plan(problem, options.steering, snapped.start, pieces_of(search, *found, frame), bound,
                            {meter.spent(), search.generated, 0});
  plan.steering->snap_rad = half_gap_rad(memory.motions);
  return plan;
}

}  // namespace outrider
