#include "voronoi_edges.hpp"

#include <algorithm>
#include <boost/polygon/voronoi_builder.hpp>
#include <boost/polygon/voronoi_diagram.hpp>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace outrider {
namespace {

constexpr double steps = 1 << 30;  // across the map
constexpr int most_rounds = 64;

struct Lattice {
  Vec2 low;
  double step_m = 1.0;

  struct Point {
    std::int32_t x = 0;
    std::int32_t y = 0;
    friend bool operator==(Point, Point) = default;
    friend auto operator<=>(Point, Point) = default;
  };

  [[nodiscard]] Point round(Vec2 p) const {
    const Vec2 at = (1.0 / step_m) * (p - low);
    return {static_cast<std::int32_t>(std::lround(at.x)), static_cast<std::int32_t>(std::lround(at.y))};
  }
  [[nodiscard]] Vec2 world(double x, double y) const { return low + step_m * Vec2{x, y}; }
  [[nodiscard]] Vec2 world(Point p) const { return world(p.x, p.y); }
};

using Point = Lattice::Point;
using Edge = std::pair<Point, Point>;  // the lesser end first

/// Returns twice the signed area of a, b, c: below 2^62, exact.
std::int64_t turn(Point a, Point b, Point c) {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
         (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

bool boxes_meet(const Edge& s, const Edge& t) {
  const auto [s_low, s_high] = std::minmax(s.first.y, s.second.y);
  const auto [t_low, t_high] = std::minmax(t.first.y, t.second.y);
  return s.first.x <= t.second.x && t.first.x <= s.second.x && s_low <= t_high && t_low <= s_high;
}

/// Finds the points at which the edges must be cut: an end of one that lies on the other, or their crossing.
void cut(const Edge& s, const Edge& t, std::vector<Point>& of_s, std::vector<Point>& of_t) {
  const std::int64_t t_first = turn(s.first, s.second, t.first), t_second = turn(s.first, s.second, t.second);
  const std::int64_t s_first = turn(t.first, t.second, s.first), s_second = turn(t.first, t.second, s.second);
  const auto at_end = [](const Edge& edge, Point p, std::int64_t side, std::vector<Point>& cuts) {
    if (side == 0 && p != edge.first && p != edge.second && boxes_meet(edge, {p, p})) cuts.push_back(p);
  };
  at_end(s, t.first, t_first, of_s);
  at_end(s, t.second, t_second, of_s);
  at_end(t, s.first, s_first, of_t);
  at_end(t, s.second, s_second, of_t);
  const auto apart = [](std::int64_t a, std::int64_t b) { return (a < 0 && b > 0) || (a > 0 && b < 0); };
  if (!apart(t_first, t_second) || !apart(s_first, s_second)) return;
  const double whole = static_cast<double>(s_first) - static_cast<double>(s_second);
  const double share = static_cast<double>(s_first) / whole;
  const auto between = [&](std::int32_t from, std::int32_t to) {
    return static_cast<std::int32_t>(std::lround(from + share * (static_cast<double>(to) - from)));
  };
  const Point p{between(s.first.x, s.second.x), between(s.first.y, s.second.y)};
  of_s.push_back(p);
  of_t.push_back(p);
}

/// Adds the parts of an edge between its cuts, in order from its lesser end.
void add_parts(const Edge& edge, std::vector<Point>& cuts, std::vector<Edge>& parts) {
  const auto along = [&](Point p) {
    return (static_cast<double>(p.x) - edge.first.x) * (static_cast<double>(edge.second.x) - edge.first.x) +
           (static_cast<double>(p.y) - edge.first.y) * (static_cast<double>(edge.second.y) - edge.first.y);
  };
  cuts.push_back(edge.first);
  cuts.push_back(edge.second);
  std::sort(cuts.begin(), cuts.end(),
            [&](Point p, Point q) { return std::pair(along(p), p) < std::pair(along(q), q); });
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i - 1] != cuts[i]) parts.push_back(std::minmax(cuts[i - 1], cuts[i]));
  }
}

void sort_once(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

/// Cuts edges at each other; returns false if there was nothing to cut.
bool cut_once(std::vector<Edge>& edges) {
  std::vector<std::vector<Point>> cuts(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && edges[j].first.x <= edges[i].second.x; ++j) {
      if (boxes_meet(edges[i], edges[j])) cut(edges[i], edges[j], cuts[i], cuts[j]);
    }
  }
  std::vector<Edge> parts;
  for (std::size_t i = 0; i < edges.size(); ++i) add_parts(edges[i], cuts[i], parts);
  sort_once(parts);
  if (parts == edges) return false;
  edges = std::move(parts);
  return true;
}

/// Returns all edges of the ground, cut so that they meet only at ends.
std::vector<Edge> edges_of(const PolygonGround& ground, const Lattice& lattice) {
  std::vector<Edge> edges;
  for (const Segment& s : ground.edges) {
    const Edge edge = std::minmax(lattice.round(s.a), lattice.round(s.b));
    if (edge.first != edge.second) edges.push_back(edge);
  }
  sort_once(edges);
  for (int round = 0; cut_once(edges); ++round) {
    if (round > most_rounds) throw std::logic_error("edges of polygons do not come apart on a lattice");
  }
  return edges;
}

using Diagram = boost::polygon::voronoi_diagram<double>;

/// Returns the corner or the edge to which a cell of the diagram belongs.
Feature feature_of(const Diagram::cell_type& cell, const std::vector<Edge>& edges, const Lattice& lattice) {
  const Edge& edge = edges[cell.source_index()];
  const Vec2 a = lattice.world(edge.first), b = lattice.world(edge.second);
  if (cell.contains_segment()) return {a, b};
  const bool first = cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT;
  return first ? Feature{a, a} : Feature{b, b};
}

/// Returns true if some part of it is free for the disk, or nearly so.
bool is_free(const VoronoiEdge& edge, const PolygonGround& ground) {
  const Bisector& b = edge.bisector;
  const bool wide = std::max(b.clearance(b.u0), b.clearance(b.u1)) >= 0.999 * ground.radius_m;
  return wide && !ground.solid(b.at(0.5 * (b.u0 + b.u1)));
}

}  // namespace

VoronoiEdges voronoi_edges(const PolygonGround& ground) {
  Box2 box = ground.bounds;
  for (const Segment& edge : ground.edges) box.include(edge.a);
  const Lattice lattice{box.low, std::max(box.size().x, box.size().y) / steps};
  const std::vector<Edge> edges = edges_of(ground, lattice);
  boost::polygon::default_voronoi_builder builder;
  for (const auto& [a, b] : edges) builder.insert_segment(a.x, a.y, b.x, b.y);
  Diagram diagram;
  builder.construct(&diagram);

  VoronoiEdges made;
  made.step_m = lattice.step_m;
  for (const auto& vertex : diagram.vertices()) made.nodes.push_back(lattice.world(vertex.x(), vertex.y()));
  const auto node = [&](const Diagram::vertex_type* vertex) {
    return static_cast<std::uint32_t>(vertex - diagram.vertices().data());
  };
  for (const auto& half : diagram.edges()) {
    if (&half > half.twin() || !half.is_primary() || !half.is_finite()) continue;
    VoronoiEdge edge{node(half.vertex0()), node(half.vertex1()), {}};
    edge.bisector = Bisector::between(feature_of(*half.cell(), edges, lattice),
                                      feature_of(*half.twin()->cell(), edges, lattice), made.nodes[edge.from],
                                      made.nodes[edge.to]);
    if (is_free(edge, ground)) made.edges.push_back(edge);
  }
  return made;
}

}  // namespace outrider
