#include "landmark.hpp"

#include <limits>
#include <queue>
#include <tuple>

namespace outrider::polyanya_search {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// A departure that waits to be expanded.
struct Reached {
  double length;
  Departure departure;
  Arrow came;
  bool operator>(const Reached& other) const {
    return std::make_tuple(length, departure.number()) >
           std::make_tuple(other.length, other.departure.number());
  }
};

/// Returns the distance of two gates, which do not cross.
double gap(const Gate& p, const Gate& q) {
  return std::min(std::min(p.distance(q.a), p.distance(q.b)), std::min(q.distance(p.a), q.distance(p.b)));
}

}  // namespace

void Landmark::find(const NavigationMesh& mesh) {
  distances_.assign(mesh.turns.size(), unknown);
  std::vector<std::uint32_t> gates(mesh.top.size(), NavigationMesh::none),
      count(mesh.top.size(), 0);  // sides by block
  for (std::uint32_t polygon = 0; polygon < mesh.polygons();
       ++polygon) {  // roots come before what hangs on them
    if (mesh.is_gone(polygon)) continue;
    for (std::uint32_t s = mesh.first[polygon]; s < mesh.first[polygon + 1]; ++s) {
      const NavigationMesh::Side& side = mesh.sides[s];
      if (side.turn != NavigationMesh::no_turn && distances_[side.turn] == unknown) search(mesh, side.turn);
      if (side.polygon == NavigationMesh::none || s > side.behind) continue;
      gates[side.block] = s;
      ++count[side.block];
    }
  }
  gates_.assign(mesh.top.size(), {});
  for (std::size_t block = 0; block < gates_.size(); ++block) {
    if (count[block] == 1) gates_[block] = gate_at(mesh, gates[block]);
  }
}

Gate Landmark::gate_at(const NavigationMesh& mesh, std::uint32_t s) const {
  const std::uint32_t behind = mesh.sides[s].polygon, polygon = mesh.sides[mesh.sides[s].behind].polygon;
  Gate gate{mesh.sides[s].at, mesh.sides[mesh.sides[s].behind].at};
  const auto most = [&](Cell end) {
    return std::min(most_to(mesh, polygon, end), most_to(mesh, behind, end));
  };
  gate.most = 0.5 * (most(gate.a) + most(gate.b) + length(gate.a, gate.b));
  return gate;
}

/// Returns at least the length from the landmark to a corner of a polygon: over one of the turns there.
double Landmark::most_to(const NavigationMesh& mesh, std::uint32_t polygon, Cell corner) const {
  double most = unknown;
  for (std::uint32_t s = mesh.first[polygon]; s < mesh.first[polygon + 1]; ++s) {
    const NavigationMesh::Side& side = mesh.sides[s];
    if (side.turn != NavigationMesh::no_turn)
      most = std::min(most, distances_[side.turn] + length(side.at, corner));
  }
  return most;
}

double Landmark::least_to(const NavigationMesh& mesh, const std::vector<std::uint32_t>& polygons,
                          Cell corner) const {
  double least = 0.0;
  for (const std::uint32_t polygon : polygons) {
    for (std::uint32_t s = mesh.first[polygon]; s < mesh.first[polygon + 1]; ++s) {
      const NavigationMesh::Side& side = mesh.sides[s];
      if (side.turn != NavigationMesh::no_turn)
        least = std::max(least, distances_[side.turn] - length(side.at, corner));
    }
  }
  return least;
}

/// Dijkstra's algorithm along taut legs.
void Landmark::search(const NavigationMesh& mesh, std::uint32_t landmark) {
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  const auto reach = [&](double length_before) {
    for (const auto& [departure, taut, block, way] : sweep_.seen()) {
      const double now = length_before + length(way.x, way.y);
      double& known = distances_[departure.turn()];
      if (!(now < known)) continue;
      known = now;
      if (taut) open.push({now, departure, way});
    }
  };
  const auto& [at, around, polygons] = mesh.turns[landmark];
  distances_[landmark] = 0.0;
  for (std::uint32_t i = around; i < around + polygons; ++i) {
    sweep_.from_polygon(mesh, at, mesh.around[i].polygon);
    reach(0.0);
  }
  while (!open.empty()) {
    const Reached next = open.top();
    open.pop();
    if (distances_[next.departure.turn()] < next.length) continue;
    sweep_.from_turn(mesh, next.departure.turn(), next.departure.cone(next.came));
    reach(next.length);
  }
}

/// Bounds what follows the last gate of the climb.
void LandmarkBounds::pass_last_gate(const Gate& gate, std::uint32_t exit, Cell goal) {
  double rest = std::max(gate.distance(goal), goal_ - gate.most);
  if (exit != no_exit) {
    const Gate& next = landmark_->gate(exit);
    rest = std::max(rest, gap(gate, next) + std::max(next.distance(goal), goal_ - next.most));
  }
  beyond_gate_ = rest - gate.most - rounding * (gate.most + rest);
}

}  // namespace outrider::polyanya_search
