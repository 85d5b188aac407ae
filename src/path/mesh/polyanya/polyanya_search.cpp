#include "polyanya_search.hpp"

#include <algorithm>
#include <array>

#include "grid/grid_follow.hpp"
#include "mesh/mesh_blocks.hpp"
#include "mesh/mesh_change.hpp"
#include "outrider/path/grid/line_of_sight.hpp"

namespace outrider::polyanya_search {
namespace {

/// Number of sides whose blocks are found in the time of one expansion (measured).
constexpr std::size_t sides_an_expansion = 16;
/// Number of blocks between start and goal from which on there are gates worth a bound.
constexpr std::size_t several_blocks = 4;
/// Returns the most memory for legs that are kept beyond one query, bytes.
std::size_t most_leg_bytes(const GridMap& ground) {
  return std::clamp(2 * ground.frame.size(), std::size_t{16} << 20U, std::size_t{64} << 20U);
}

}  // namespace

bool Memory::renew(const std::shared_ptr<const GridMap>& now, const std::stop_token& stop) {
  const auto make = [&] {
    mesh = navigation_mesh(*now, stop);
    most_sides_ = mesh.sides.size() + mesh.sides.size() / 2 + 64;
    forget();
    if (!stop.stop_requested()) forced.find(mesh, stop);
  };
  follow(ground, now, make, [&](const std::vector<Cell>& changed) {
    if (changed.empty()) return;
    change_mesh(mesh, *now, changed, most_sides_) ? forget_what_follows() : make();
  });
  if (stop.stop_requested()) {
    ground = nullptr;
    return false;
  }
  find_what_is_worth();
  begin_query();
  return true;
}

bool Memory::found_blocks() {
  ++spent_;
  if (up.size() + down.size() >= several_blocks) ++spent_between_gates_;
  if (mesh.core.empty() || spent_ <= mesh.sides.size() / sides_an_expansion) return false;
  find_blocks(mesh);
  forget();
  begin_query();
  return true;
}

/// Forgets what follows from the mesh.
void Memory::forget_what_follows() {
  forced.forget();
  legs.forget();
  landmark.forget();
}

/// Forgets what follows from a mesh of which all blocks are known now.
void Memory::forget() {
  forget_what_follows();
  marks.clear();
  spent_ = spent_between_gates_ = 0;
}

/// Finds what spares expansions once there have been so many that finding it takes no longer.
void Memory::find_what_is_worth() {
  if (!mesh.core.empty()) return;
  if (!forced.known() && spent_between_gates_ > mesh.sides.size() / 8) forced.find(mesh);
  if (!landmark.known() && spent_between_gates_ > mesh.sides.size()) landmark.find(mesh);
  if (legs.bytes() > most_leg_bytes(*ground)) legs.forget();
}

void Memory::begin_query() {
  if (++query == NavigationMesh::none) marks.clear();
  if (marks.empty()) query = 1;
  marks.resize(mesh.top.size());
  bounds.clear();
  keeps_legs = mesh.core.empty() && spent_ > mesh.sides.size();
}

Search::Search(Memory& memory, const GridQuery& query, Trace* trace)
    : mesh_(memory.mesh),
      memory_(memory),
      roots_(memory.roots),
      ground_(query.ground),
      start_(query.start),
      goal_(query.goal),
      first_(static_cast<std::uint32_t>(mesh_.turns.size())),
      trace_(trace) {
  roots_.begin(mesh_.turns.size() + 1);
  memory_.frontier.begin();
  memory_.before_start.clear();
  memory_.after_goal.clear();
}

Outcome<std::vector<Cell>> Search::run(BudgetMeter& meter) {
  if (join_ends(true)) {
    if (trace_ != nullptr) open(start_);
    roots_.open(first_, first_, 0.0);
    add({0.0, start_, {}, first_, 0, NavigationMesh::none}, length(start_, goal_));
  }
  while (memory_.frontier.pop(node_, least_)) {
    if (roots_.g(node_.root) < node_.g) continue;
    if (!meter.spend()) return meter.refusal();
    if (memory_.found_blocks() && !join_ends(false)) break;
    if (trace_ != nullptr) record();
    if (reaches_goal()) return way_to(node_.root);
  }
  return fault(FaultCode::no_path, "nothing joins the start and the goal");
}

std::vector<Cell> Search::way_to(std::uint32_t root) const {
  std::vector<Cell> way = memory_.after_goal;
  way.push_back(goal_);
  if (goal_ != start_) {
    for (; root != first_; root = roots_.parent(root)) way.push_back(at(root));
    way.push_back(start_);
  }
  way.insert(way.end(), memory_.before_start.rbegin(), memory_.before_start.rend());
  if (!reversed_) std::reverse(way.begin(), way.end());
  return way;
}

/// Finds the polygons around a corner, and returns one of each connected set: two at a pinch.
std::array<std::uint32_t, 2> Search::polygons_around(Cell v, std::vector<std::uint32_t>& found) const {
  found.clear();
  std::array<std::uint32_t, 2> sets{NavigationMesh::none, NavigationMesh::none};
  for (unsigned q = 0; q < 4 && sets[ground_.pinch(v) ? 1 : 0] == NavigationMesh::none; ++q) {
    const Cell c{v.x - ((q & 1U) != 0 ? 0 : 1), v.y - ((q & 2U) != 0 ? 0 : 1)};
    if (ground_.blocked(c)) continue;
    const std::size_t before = found.size();
    mesh_.polygons_at(v, c, ground_.frame, found);
    sets[sets[0] == NavigationMesh::none ? 0 : 1] = found[before];
  }
  return sets;
}

/// Marks the block towards the root and moves there, except at the root or into the core.
bool Search::climb(std::uint32_t& polygon, std::vector<std::uint32_t>& blocks) {
  const std::uint32_t block = mesh_.up[polygon];
  if (block == NavigationMesh::none || mesh_.top[block] == NavigationMesh::none) return false;
  memory_.marks[block] = {memory_.query, LandmarkBounds::no_exit};
  blocks.push_back(block);
  polygon = mesh_.top[block];
  return true;
}

/// Marks the blocks between two polygons; returns false if nothing joins them. (Two polygons in the core may
/// be unconnected.)
bool Search::join(std::uint32_t a, std::uint32_t b) {
  memory_.up.clear();
  memory_.down.clear();
  while (a != b && (mesh_.order[a] > mesh_.order[b] ? climb(a, memory_.up) : climb(b, memory_.down))) {
  }
  if (a == b) return true;
  while (climb(a, memory_.up) || climb(b, memory_.down)) {
  }
  if (mesh_.up[a] == NavigationMesh::none || mesh_.up[b] == NavigationMesh::none) return false;
  for (const std::uint32_t block : mesh_.core) memory_.marks[block].query = memory_.query;
  return true;
}

/// Moves an end of the search, which is no pinch, over the turns that are forced on the way to a polygon, and
/// returns a polygon at the new end.
std::uint32_t Search::advance(Cell& end, std::vector<std::uint32_t>& around, std::uint32_t other,
                              std::vector<Cell>& way) const {
  const std::uint32_t first =
      *std::min_element(around.begin(), around.end(),
                        [this](std::uint32_t a, std::uint32_t b) { return mesh_.order[a] < mesh_.order[b]; });
  ForcedTurn next = memory_.forced.from(mesh_, end, first);
  std::uint32_t turn = NavigationMesh::none;
  while (next.on_way_to(mesh_.order[other])) {
    way.push_back(end);
    turn = next.turn;
    end = mesh_.turns[turn].at;
    next = memory_.forced.after(turn);
  }
  if (turn == NavigationMesh::none) return around.front();
  around.clear();
  const auto begin = mesh_.around.begin() + mesh_.turns[turn].around;
  std::for_each(begin, begin + mesh_.turns[turn].polygons,
                [&](const NavigationMesh::Wedge& wedge) { around.push_back(wedge.polygon); });
  return around.front();
}

bool Search::join_ends(bool begins) {
  auto from = polygons_around(start_, memory_.around_start);
  auto to = polygons_around(goal_, memory_.around_goal);
  const Landmark& landmark = memory_.landmark;
  const bool simple = from[1] == NavigationMesh::none && to[1] == NavigationMesh::none;  // no end is a pinch
  const bool bounded = simple && landmark.known();
  if (simple && begins && memory_.forced.known()) {
    from[0] = advance(start_, memory_.around_start, to[0], memory_.before_start);
    to[0] = advance(goal_, memory_.around_goal, from[0], memory_.after_goal);
  }
  double goal_least = bounded ? landmark.least_to(mesh_, memory_.around_goal, goal_) : 0.0;
  if (const double start_least = bounded ? landmark.least_to(mesh_, memory_.around_start, start_) : 0.0;
      start_least < goal_least) {
    std::swap(start_, goal_);
    std::swap(memory_.around_start, memory_.around_goal);
    std::swap(memory_.before_start, memory_.after_goal);
    std::swap(from, to);
    goal_least = start_least;
    reversed_ = true;
  }
  bool joined = false;
  for (const std::uint32_t a : from) {
    for (const std::uint32_t b : to)
      joined = (a != NavigationMesh::none && b != NavigationMesh::none && join(a, b)) || joined;
  }
  if (joined && bounded) {
    memory_.bounds.begin(
        landmark, memory_.up, memory_.down, goal_, goal_least,
        [this](std::uint32_t block, std::uint32_t exit) { memory_.marks[block].exit = exit; });
  }
  return joined;
}

/// Reports a node to the trace, which identifies it by its root.
void Search::open(Cell root) {
  if (opened_.insert(ground_.index(root)).second) trace_->open(ground_.index(root));
}

/// Records the node that is expanded, with the lengths of the whole path.
void Search::record() {
  const auto beyond = [](const std::vector<Cell>& way, Cell end) {
    double sum = way.empty() ? 0.0 : length(way.back(), end);
    for (std::size_t i = 1; i < way.size(); ++i) sum += length(way[i - 1], way[i]);
    return sum;
  };
  const double before = beyond(memory_.before_start, start_), after = beyond(memory_.after_goal, goal_);
  const Cell parent = at(roots_.parent(node_.root));
  trace_->record({ground_.index(node_.at), ground_.index(parent), before + least_ + after, before + node_.g,
                  least_ - node_.g + after});
}

void Search::add(const MeshNode& node, double f) {
  ++generated;
  memory_.frontier.add(node, std::max(f, least_));
}

/// Expands the node unless the goal is in sight.
bool Search::reaches_goal() {
  const bool at_turn = node_.side == NavigationMesh::none && node_.root != first_;
  if (!at_turn || !memory_.keeps_legs || !memory_.legs.known(mesh_, Departure(node_.polygon))) {
    if (sees_goal()) return true;
    expand();
    return false;
  }
  if (node_.cone.holds(arrow(node_.at, goal_)) && visible(ground_, node_.at, goal_)) return true;
  const Departure departure(node_.polygon);
  memory_.legs.each(
      mesh_, departure, departure.to_left() ? node_.cone.right : node_.cone.left,
      [this](std::uint32_t block) { return enters(block); },
      [this](const TautLegs::Leg& leg, std::uint32_t block) { reach(leg.departure, leg.way, block); });
  return false;
}

/// Returns true if the goal lies in the polygon that the root looks into, and in the cone.
bool Search::sees_goal() const {
  if (node_.side != NavigationMesh::none)
    return holds_goal(node_.polygon) && node_.cone.holds(arrow(node_.at, goal_));
  if (node_.root == first_) {
    return std::any_of(memory_.around_start.begin(), memory_.around_start.end(),
                       [this](std::uint32_t p) { return holds_goal(p); });
  }
  if (!node_.cone.holds(arrow(node_.at, goal_))) return false;
  const NavigationMesh::Turn& turn = mesh_.turns[node_.root];
  const auto first = mesh_.around.begin() + turn.around;
  return std::any_of(first, first + turn.polygons,
                     [this](const NavigationMesh::Wedge& wedge) { return holds_goal(wedge.polygon); });
}

bool Search::holds_goal(std::uint32_t polygon) const {
  const auto& goal = memory_.around_goal;
  return std::find(goal.begin(), goal.end(), polygon) != goal.end();
}

void Search::expand() {
  if (node_.side != NavigationMesh::none) {
    look_through(mesh_, node_.at, node_.cone, node_.polygon, node_.side, *this);
  } else if (node_.root == first_) {
    for (const std::uint32_t p : memory_.around_start) look_everywhere(mesh_, node_.at, p, *this);
  } else {
    const NavigationMesh::Turn& turn = mesh_.turns[node_.root];
    for (std::uint32_t i = turn.around; i < turn.around + turn.polygons; ++i)
      look_into(mesh_, node_.at, node_.cone, mesh_.around[i], *this);
  }
}

void Search::see(const NavigationMesh::Side& turn, Arrow way, std::uint32_t block) {
  bool level = false;
  if (Departure::winds(turn, way, level)) reach(Departure(turn, level), way, block);
}

/// Turns the path of the root at a turn that it sees.
void Search::reach(Departure departure, Arrow way, std::uint32_t block) {
  const std::uint32_t turn = departure.turn();
  const double g = node_.g + length(way.x, way.y);
  if (roots_.known(turn) && !(g < roots_.g(turn))) return;
  const Cell at{node_.at.x + way.x, node_.at.y + way.y};
  if (trace_ != nullptr) open(at);
  roots_.open(turn, node_.root, g);
  const double rest =
      std::max(length(at, goal_), memory_.bounds.remaining(turn, at, memory_.marks[block].exit));
  add({g, at, departure.cone(way), turn, departure.number(), NavigationMesh::none}, g + rest);
}

void Search::pass(const NavigationMesh::Side& side, Arrow from, Arrow to, Arrow right, Arrow left) {
  add({node_.g, node_.at, {right, left}, node_.root, side.polygon, side.behind},
      node_.g + through(from, to, right, left));
}

/// Returns the least length from the root to the goal through the part of a side that lies in the cone; a
/// goal on the near side is mirrored in the side.
double Search::through(Arrow from, Arrow to, Arrow right, Arrow left) const {
  const double side_x = to.x - from.x, side_y = to.y - from.y;
  const auto beyond = [&](double x, double y) { return x * side_y - y * side_x; };  // the root: 0
  const double line = beyond(from.x, from.y);
  double x = goal_.x - node_.at.x, y = goal_.y - node_.at.y;
  if (const double missing = line - beyond(x, y); missing > 0.0) {
    const double scale = 2.0 * missing / (side_x * side_x + side_y * side_y);
    x += scale * side_y;
    y -= scale * side_x;
  }
  Arrow edge;
  if (right.x * y - right.y * x < 0.0) {
    edge = right;
  } else if (left.x * y - left.y * x > 0.0) {
    edge = left;
  } else {
    return length(x, y);
  }
  const double scale = line / beyond(edge.x, edge.y);
  const double bend_x = scale * edge.x, bend_y = scale * edge.y;
  return length(bend_x, bend_y) + length(x - bend_x, y - bend_y);
}

}  // namespace outrider::polyanya_search
