#include "outrider/path/mesh/polyanya.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "grid/grid_follow.hpp"
#include "mesh_blocks.hpp"
#include "mesh_change.hpp"
#include "outrider/path/mesh/mesh.hpp"
#include "outrider/search/labels.hpp"
#include "polyanya_frontier.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t none = NavigationMesh::none, no_turn = NavigationMesh::no_turn;
using Side = NavigationMesh::Side;

using polyanya_search::Arrow;
using polyanya_search::Frontier;
using polyanya_search::MeshNode;
using polyanya_search::turned;

/// Number of sides whose blocks are found in the time of one expansion (measured).
constexpr std::size_t sides_an_expansion = 16;

struct Memory {
  std::shared_ptr<const GridMap> ground;  ///< ground of the mesh
  NavigationMesh mesh;
  std::size_t most_sides = 0;         ///< number of sides above which a changed mesh is rebuilt
  std::size_t spent = 0;              ///< expansions since the mesh has had its core
  Labels<double> roots;               ///< by turn; the start last
  std::vector<std::uint32_t> active;  ///< by block: the last query that crossed it
  std::vector<std::uint32_t> around_start, around_goal;
  std::uint32_t query = 0;
  Frontier frontier;

  void renew(const std::shared_ptr<const GridMap>& now) {
    const auto make = [&] {
      mesh = navigation_mesh(*now);
      most_sides = mesh.sides.size() + mesh.sides.size() / 2 + 64;
      active.clear();
      spent = 0;
    };
    follow(ground, now, make, [&](const std::vector<Cell>& changed) {
      if (!change_mesh(mesh, *now, changed, most_sides)) make();
    });
    begin_query();
  }

  /// Called at each expansion on a mesh with a core. Recomputes the blocks once the expansions have taken as
  /// long as that.
  bool found_blocks() {
    if (mesh.core.empty() || ++spent <= mesh.sides.size() / sides_an_expansion) return false;
    find_blocks(mesh);
    active.clear();
    spent = 0;
    begin_query();
    return true;
  }

 private:
  void begin_query() {
    if (++query == none) active.clear();
    if (active.empty()) query = 1;
    active.resize(mesh.top.size(), 0);
  }
};

double length(double x, double y) { return std::sqrt(x * x + y * y); }

class Search {
 public:
  Search(Memory& memory, const GridQuery& query, Trace* trace)
      : mesh_(memory.mesh),
        memory_(memory),
        roots_(memory.roots),
        frontier_(memory.frontier),
        ground_(query.ground),
        start_(query.start),
        goal_(query.goal),
        first_(static_cast<std::uint32_t>(mesh_.turns.size())),
        trace_(trace) {
    roots_.begin(mesh_.turns.size() + 1);
    frontier_.begin();
  }

  /// Returns the turns of the shortest path, including both ends.
  Outcome<std::vector<Cell>> run(BudgetMeter& meter) {
    if (join_ends()) {
      if (trace_ != nullptr) open(start_);
      roots_.open(first_, first_, 0.0);
      add({0.0, start_, {}, {}, first_, none, none}, length(goal_.x - start_.x, goal_.y - start_.y));
    }
    MeshNode node;
    for (double f = 0.0; frontier_.pop(node, f);) {
      if (roots_.g(node.root) < node.g) continue;
      if (!meter.spend()) return meter.refusal();
      if (memory_.found_blocks() && !join_ends()) break;
      if (trace_ != nullptr) {
        trace_->record(
            {ground_.index(node.at), ground_.index(at(roots_.parent(node.root))), f, node.g, f - node.g});
      }
      if (sees_goal(node)) return way_to(node.root);
      expand(node);
    }
    return fault(FaultCode::no_path, "nothing joins the start and the goal");
  }

  std::uint64_t generated = 0;

 private:
  [[nodiscard]] Cell at(std::uint32_t root) const { return root == first_ ? start_ : mesh_.turns[root].at; }

  std::vector<Cell> way_to(std::uint32_t root) const {
    std::vector<Cell> way{goal_};
    if (goal_ == start_) return way;
    for (; root != first_; root = roots_.parent(root)) way.push_back(at(root));
    way.push_back(start_);
    std::reverse(way.begin(), way.end());
    return way;
  }

  /// Finds the polygons around a corner, and returns one of each connected set: two at a pinch.
  std::array<std::uint32_t, 2> polygons_around(Cell v, std::vector<std::uint32_t>& found) const {
    found.clear();
    std::array<std::uint32_t, 2> sets{none, none};
    for (unsigned q = 0; q < 4 && sets[ground_.pinch(v) ? 1 : 0] == none; ++q) {
      const Cell c{v.x - ((q & 1U) != 0 ? 0 : 1), v.y - ((q & 2U) != 0 ? 0 : 1)};
      if (ground_.blocked(c)) continue;
      const std::size_t before = found.size();
      mesh_.polygons_at(v, c, ground_.frame, found);
      sets[sets[0] == none ? 0 : 1] = found[before];
    }
    return sets;
  }

  /// Activates the block towards the root and moves there, except at the root or into the core.
  bool climb(std::uint32_t& polygon) {
    const std::uint32_t block = mesh_.up[polygon];
    if (block == none || mesh_.top[block] == none) return false;
    memory_.active[block] = memory_.query;
    polygon = mesh_.top[block];
    return true;
  }
  /// Activates the blocks between two polygons; returns false if nothing joins them. (Two polygons in the
  /// core may be unconnected.)
  bool join(std::uint32_t a, std::uint32_t b) {
    while (a != b && climb(mesh_.depth[a] >= mesh_.depth[b] ? a : b)) {
    }
    if (a == b) return true;
    while (climb(a) || climb(b)) {
    }
    if (mesh_.up[a] == none || mesh_.up[b] == none) return false;
    for (const std::uint32_t block : mesh_.core) memory_.active[block] = memory_.query;
    return true;
  }

  bool join_ends() {
    bool joined = false;
    const auto from = polygons_around(start_, memory_.around_start);
    const auto to = polygons_around(goal_, memory_.around_goal);
    for (const std::uint32_t a : from) {
      for (const std::uint32_t b : to) joined = (a != none && b != none && join(a, b)) || joined;
    }
    return joined;
  }

  /// Reports a node to the trace, which identifies it by its root.
  void open(Cell root) {
    if (opened_.insert(ground_.index(root)).second) trace_->open(ground_.index(root));
  }
  void add(const MeshNode& node, double f) {
    ++generated;
    frontier_.add(node, f);
  }

  /// Returns true if the goal lies in the polygon that the root looks into, and in the cone.
  [[nodiscard]] bool sees_goal(const MeshNode& node) const {
    if (node.side != none && !holds_goal(node.polygon)) return false;
    const bool everywhere = node.side == none && node.root == first_;
    const Arrow goal = arrow(node, goal_);
    if (!everywhere && !within(node, goal)) return false;
    if (node.side != none) return true;
    if (everywhere) {
      return std::any_of(memory_.around_start.begin(), memory_.around_start.end(),
                         [this](std::uint32_t p) { return holds_goal(p); });
    }
    const auto [first, last] = around(node.root);
    return std::any_of(first, last,
                       [this](const NavigationMesh::Wedge& wedge) { return holds_goal(wedge.polygon); });
  }
  [[nodiscard]] bool holds_goal(std::uint32_t polygon) const {
    for (const std::uint32_t p : memory_.around_goal) {
      if (p == polygon) return true;
    }
    return false;
  }
  static Arrow arrow(const MeshNode& node, Cell v) { return {v.x - node.at.x, v.y - node.at.y}; }
  static bool within(const MeshNode& node, Arrow v) {
    return turned(node.right, v) >= 0 && turned(v, node.left) >= 0;
  }

  using Wedges = std::pair<const NavigationMesh::Wedge*, const NavigationMesh::Wedge*>;
  [[nodiscard]] Wedges around(std::uint32_t root) const {
    const NavigationMesh::Wedge* const all = mesh_.around.data();
    const NavigationMesh::Turn& turn = mesh_.turns[root];
    return {all + turn.around, all + turn.around + turn.polygons};
  }

  void expand(const MeshNode& node) {
    if (node.side != none) {
      const std::uint32_t end = mesh_.first[node.polygon + 1];
      const std::uint32_t next = node.side + 1 == end ? mesh_.first[node.polygon] : node.side + 1;
      look_over(node, node.right, node.left, node.polygon, next, node.side);
    } else if (node.root == first_) {
      for (const std::uint32_t p : memory_.around_start) look_everywhere(node, p);
    } else {
      const auto [first, last] = around(node.root);
      for (const NavigationMesh::Wedge* wedge = first; wedge != last; ++wedge) look_into(node, *wedge);
    }
  }

  /// Expands over the sides of a polygon from `first` up to `last`, which follow each other to the left as
  /// seen from the root, as far as they lie in the cone.
  void look_over(const MeshNode& node, Arrow right, Arrow left, std::uint32_t polygon, std::uint32_t first,
                 std::uint32_t last) {
    const std::uint32_t begin = mesh_.first[polygon], end = mesh_.first[polygon + 1];
    Arrow from = arrow(node, mesh_.sides[first].at);
    std::int64_t from_right = turned(right, from);
    for (std::uint32_t s = first; s != last;) {
      const Side& side = mesh_.sides[s];
      s = s + 1 == end ? begin : s + 1;
      const Side& next = mesh_.sides[s];
      const Arrow to = arrow(node, next.at);
      const std::int64_t to_right = turned(right, to);
      if (to_right >= 0) {
        const std::int64_t from_left = turned(from, left);
        if (from_left < 0) return;
        if (active(side)) {
          const std::int64_t to_left = turned(to, left);
          if (side.turn != no_turn && from_right >= 0) turn(node, side, from);
          if (next.turn != no_turn && to_left >= 0) turn(node, next, to);
          // An end may lie opposite to the far edge of the cone; then the other edge decides.
          if ((from_left > 0 || from_right < 0) && (to_right > 0 || to_left < 0)) {
            go_through(node, side, from, to, from_right >= 0 ? from : right, to_left >= 0 ? to : left);
          }
        }
      }
      from = to;
      from_right = to_right;
    }
  }

  /// Expands from a corner into a polygon at it, as far as it lies in the cone.
  void look_into(const MeshNode& node, const NavigationMesh::Wedge& wedge) {
    const std::uint32_t begin = mesh_.first[wedge.polygon], end = mesh_.first[wedge.polygon + 1];
    const std::uint32_t next = wedge.side + 1 == end ? begin : wedge.side + 1;
    const std::uint32_t last = wedge.side == begin ? end - 1 : wedge.side - 1;
    const Arrow from = arrow(node, mesh_.sides[next].at), to = arrow(node, mesh_.sides[last].at);
    const bool from_inside = turned(node.right, from) >= 0 && turned(from, node.left) > 0;
    const bool right_inside = turned(from, node.right) >= 0 && turned(node.right, to) > 0;
    if (!from_inside && !right_inside) return;
    const bool to_inside = within(node, to);
    if (from_inside && mesh_.sides[next].turn != no_turn && active(mesh_.sides[wedge.side])) {
      turn(node, mesh_.sides[next], from);
    }
    if (to_inside && mesh_.sides[last].turn != no_turn && active(mesh_.sides[last])) {
      turn(node, mesh_.sides[last], to);
    }
    look_over(node, from_inside ? from : node.right, to_inside ? to : node.left, wedge.polygon, next, last);
  }

  /// Expands from the start over all sides of a polygon that contains it.
  void look_everywhere(const MeshNode& node, std::uint32_t polygon) {
    const std::uint32_t begin = mesh_.first[polygon], end = mesh_.first[polygon + 1];
    for (std::uint32_t s = begin; s < end; ++s) {
      const Side& side = mesh_.sides[s];
      if (!active(side)) continue;
      const Side& next = mesh_.sides[s + 1 == end ? begin : s + 1];
      const Arrow from = arrow(node, side.at), to = arrow(node, next.at);
      if (side.turn != no_turn) turn(node, side, from);
      if (next.turn != no_turn) turn(node, next, to);
      if (turned(from, to) > 0) go_through(node, side, from, to, from, to);  // else the start lies on it
    }
  }
  [[nodiscard]] bool active(const Side& side) const {
    return side.polygon != none && memory_.active[side.block] == memory_.query;
  }

  void go_through(const MeshNode& node, const Side& side, Arrow from, Arrow to, Arrow right, Arrow left) {
    add({node.g, node.at, right, left, node.root, side.polygon, side.behind},
        node.g + through(node, from, to, right, left));
  }

  /// Returns the least length from the root to the goal through the part of a side that lies in the cone; a
  /// goal on the near side is mirrored in the side.
  [[nodiscard]] double through(const MeshNode& node, Arrow from, Arrow to, Arrow right, Arrow left) const {
    const double side_x = to.x - from.x, side_y = to.y - from.y;
    const auto beyond = [&](double x, double y) { return x * side_y - y * side_x; };  // the root: 0
    const double line = beyond(from.x, from.y);
    double x = goal_.x - node.at.x, y = goal_.y - node.at.y;
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

  /// Turns the path of the root at a corner that it sees, if the path can wind around the blocked cell there.
  /// It then continues between its own direction and the border of that cell.
  void turn(const MeshNode& node, const Side& side, Arrow came) {
    const std::int32_t sign_x = (side.blocked & 1U) != 0 ? 1 : -1, sign_y = (side.blocked & 2U) != 0 ? 1 : -1;
    const std::int32_t x = sign_x * came.x, y = sign_y * came.y;  // > 0 towards the blocked cell
    const bool along_y = x < 0 && y >= 0, along_x = x >= 0 && y < 0;
    if (!along_y && !along_x) return;
    const std::uint32_t id = side.turn;
    const double g = node.g + length(came.x, came.y);
    if (roots_.known(id) && !(g < roots_.g(id))) return;
    if (trace_ != nullptr) open(side.at);
    roots_.open(id, node.root, g);
    const Arrow border = along_y ? Arrow{0, sign_y} : Arrow{sign_x, 0};
    const bool to_left = turned(came, border) > 0;
    add({g, side.at, to_left ? came : border, to_left ? border : came, id, none, none},
        g + length(goal_.x - side.at.x, goal_.y - side.at.y));
  }

  const NavigationMesh& mesh_;
  Memory& memory_;
  Labels<double>& roots_;
  Frontier& frontier_;
  const GridMap& ground_;
  Cell start_, goal_;
  std::uint32_t first_;
  Trace* trace_;
  std::set<std::uint32_t> opened_;
};

}  // namespace

std::vector<Option> describe(PolyanyaOptions& /*options*/) { return {}; }

Outcome<Plan> polyanya(const Problem& problem, const PolyanyaOptions& /*options*/, const Budget& budget,
                       Workspace& workspace) {
  auto query = grid_query(problem);
  if (!query) return pass_on(query);
  if (query->ground.model != GridModel::corners) {
    return bad_input("polyanya takes grids of the model 'corners', not 'cells'; take theta_star instead",
                     "planner");
  }
  auto& memory = workspace.get<Memory>();
  memory.renew(problem.grid);
  Search search(memory, *query, workspace.trace);
  BudgetMeter meter(budget);
  auto way = search.run(meter);
  if (!way) return pass_on(way);

  double cost = 0.0;
  for (std::size_t i = 1; i < way->size(); ++i) {
    cost += length((*way)[i].x - (*way)[i - 1].x, (*way)[i].y - (*way)[i - 1].y);
  }
  cost *= query->ground.frame.resolution_m;
  return plan_along(problem, *way, cost, cost, {meter.spent(), search.generated, 0});
}

}  // namespace outrider
