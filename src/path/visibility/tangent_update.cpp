#include "tangent_update.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "polygon_ground_free.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t none = TangentGraph::unknown;

auto key(const Segment& s) { return std::make_tuple(s.a.x, s.a.y, s.b.x, s.b.y); }
auto key(const FreeArc& a) { return std::make_tuple(a.centre.x, a.centre.y, a.from_rad, a.width_rad); }

/// Added or removed edges, and a disk that contains them.
struct ChangedEdges {
  std::vector<Segment> edges;
  Vec2 centre;
  double radius_m = 0.0;

  /// Takes the edges of `edges_in` that are not in `but_not`.
  ChangedEdges(std::vector<Segment> edges_in, std::vector<Segment> but_not) {
    const auto by_key = [](const Segment& s, const Segment& t) { return key(s) < key(t); };
    std::sort(edges_in.begin(), edges_in.end(), by_key);
    std::sort(but_not.begin(), but_not.end(), by_key);
    std::set_difference(edges_in.begin(), edges_in.end(), but_not.begin(), but_not.end(),
                        std::back_inserter(edges), by_key);
    if (edges.empty()) return;
    Box2 box;
    for (const Segment& edge : edges) {
      box.include(edge.a);
      box.include(edge.b);
    }
    centre = 0.5 * (box.low + box.high);
    radius_m = 0.5 * norm(box.size());
  }

  /// Returns true if one of the edges may obstruct a leg that stays within `beside_m` of a line.
  [[nodiscard]] bool near(const Segment& line, double beside_m) const {
    return !edges.empty() && distance(centre, line) <= radius_m + beside_m;
  }
  [[nodiscard]] bool hinder(const PolygonGround& ground, const Segment& leg) const {
    return near(leg, (1.0 + 1e-6) * ground.radius_m) &&
           std::any_of(edges.begin(), edges.end(),
                       [&](const Segment& edge) { return !clear_of(ground, edge, leg); });
  }
};

/// Returns for each arc of `now` the same arc of `before`, if there is one; both in ascending order.
std::vector<std::uint32_t> arcs_before(const PolygonGround& before, const PolygonGround& now) {
  std::vector<std::uint32_t> by_key(before.arcs.size());
  for (std::uint32_t i = 0; i < by_key.size(); ++i) by_key[i] = i;
  std::sort(by_key.begin(), by_key.end(),
            [&](auto i, auto j) { return key(before.arcs[i]) < key(before.arcs[j]); });
  std::vector<std::uint32_t> same(now.arcs.size(), none);
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < same.size(); ++i) {
    const auto found =
        std::lower_bound(by_key.begin(), by_key.end(), key(now.arcs[i]),
                         [&](std::uint32_t j, const auto& wanted) { return key(before.arcs[j]) < wanted; });
    if (found == by_key.end() || *found < next || key(before.arcs[*found]) != key(now.arcs[i])) continue;
    same[i] = *found;
    next = *found + 1;
  }
  return same;
}

class Update {
 public:
  Update(const TangentGraph& graph, const PolygonGround& now, ChangedEdges come, ChangedEdges gone)
      : graph_(graph),
        now_(now),
        come_(std::move(come)),
        gone_(std::move(gone)),
        before_(arcs_before(*graph.ground, now)),
        after_(graph.ground->arcs.size(), none) {
    for (std::uint32_t i = 0; i < before_.size(); ++i) {
      if (before_[i] != none) after_[before_[i]] = i;
    }
  }

  /// Returns the legs from a node to nodes not below `least`.
  [[nodiscard]] std::vector<Departure> legs_from(Node node, Node least) {
    std::vector<Departure> legs;
    const Place place = place_of(now_, node);
    if (before_[node / 2] == none) {
      departures_pairwise(now_, place, least, legs, tests_);
      return legs;
    }
    kept_.assign(2 * now_.arcs.size(), false);
    keep(node, place, least, legs);
    for (std::uint32_t arc = least / 2; arc < now_.arcs.size(); ++arc) {
      if (before_[arc] != none && !beside_gone(place.centre, now_.arcs[arc].centre)) continue;
      for (const Node to : {2 * arc, 2 * arc + 1}) {
        if (kept_[to]) continue;
        if (const auto leg = departure(now_, place, to, tests_)) legs.push_back(*leg);
      }
    }
    std::sort(legs.begin(), legs.end(), [](const auto& a, const auto& b) { return a.to < b.to; });
    return legs;
  }

 private:
  /// Keeps the old legs that are still free. A leg that is no longer free is not searched again.
  void keep(Node node, const Place& place, Node least, std::vector<Departure>& legs) {
    const Node was = 2 * before_[node / 2] + node % 2;
    const std::uint32_t end = graph_.first[was] + graph_.count[was];
    for (std::uint32_t i = graph_.first[was]; i < end; ++i) {
      Departure leg = graph_.legs[i];
      if (after_[leg.to / 2] == none) continue;
      leg.to = 2 * after_[leg.to / 2] + leg.to % 2;
      if (leg.to < least) continue;
      kept_[leg.to] = true;
      if (!hindered(place, leg.to)) legs.push_back(leg);
    }
  }
  [[nodiscard]] bool hindered(const Place& place, Node to) {
    const Place other = place_of(now_, to);
    if (!come_.near({place.centre, other.centre}, reach())) return false;
    const auto leg = tangent(place, other);
    return !leg || come_.hinder(now_, {leg->from, leg->to});
  }
  [[nodiscard]] bool beside_gone(Vec2 a, Vec2 b) const { return gone_.near({a, b}, reach()); }
  /// A leg stays within the radius of the line between the centres, and the disk within the radius of the
  /// leg.
  [[nodiscard]] double reach() const { return (2.0 + 1e-6) * now_.radius_m; }

  const TangentGraph& graph_;
  const PolygonGround& now_;
  ChangedEdges come_, gone_;
  std::vector<std::uint32_t> before_, after_;  // arcs, by arc of the other ground
  std::vector<bool> kept_;                     // by node: a leg led there before
  std::uint64_t tests_ = 0;
};

}  // namespace

Outcome<bool> update_legs(TangentGraph& graph, const std::shared_ptr<const PolygonGround>& now,
                          BudgetMeter& meter) {
  const PolygonGround& before = *graph.ground;
  if (before.radius_m != now->radius_m) return false;
  ChangedEdges come(now->edges, before.edges), gone(before.edges, now->edges);
  if (2 * (come.edges.size() + gone.edges.size()) > now->edges.size()) return false;
  Update update(graph, *now, std::move(come), std::move(gone));
  std::vector<std::vector<Departure>> rows(2 * now->arcs.size());
  for (Node node = 0; node < rows.size(); ++node) {
    if (!meter.spend()) return meter.refusal();
    for (const Departure& leg : update.legs_from(node, (node | 1U) + 1)) {
      rows[node].push_back(leg);
      rows[turned_round(leg.to)].push_back(way_back(*now, node, leg));
    }
  }
  graph.begin(now);
  graph.take(std::move(rows));
  return true;
}

Departure way_back(const PolygonGround& ground, Node node, const Departure& leg) {
  const Place place = place_of(ground, node);
  return {turned_round(node), ground.arcs[leg.to / 2].width_rad - leg.arrives,
          place.arc->width_rad - leg.leaves, leg.length, point_at(place, leg.leaves)};
}

}  // namespace outrider
