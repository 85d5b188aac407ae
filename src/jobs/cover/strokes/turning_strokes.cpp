#include "strokes/turning_strokes.hpp"

#include <algorithm>
#include <cmath>

#include "ground/tool_coverage.hpp"
#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

constexpr int most_trims = 16;       // of an end of a lane
constexpr double trim_part = 0.25;   // of the turning radius, in one of them
constexpr double least_lane = 0.1;   // strides
constexpr double least_gain = 0.15;  // of the area of its strip, that a stroke adds
constexpr double least_rest = 1e-4;  // of the reach, worth a stroke
constexpr double dot_part = 0.5;     // of the turning radius, between places of a lane that others lead to
constexpr double most_dots = 300.0;
constexpr std::size_t most_probes = 8;  // from which exits are looked for
constexpr std::size_t most_exits = 16;  // of the headland, tried from the end of a lane

Pose2 begin_of(const std::vector<PathPiece>& pieces) {
  return {pieces.front().from, heading_in(pieces.front())};
}

/// The exits of lanes: poses along the headland that can be reached from each other.
class Exits {
 public:
  Exits(const std::vector<Stroke>& laps, const CoverProblem& problem, const FreeRoom& room,
        const std::stop_token& stop)
      : problem_(problem), room_(room), stop_(stop) {
    TurningTransit transit(problem, room);
    const auto nodes = add_strokes(transit, laps);
    transit.connect(nodes, nodes, stop);
    for (std::size_t k = 0; k < most_probes && k < nodes.size() && !stop.stop_requested(); ++k) {
      const std::size_t base = k * nodes.size() / std::min(most_probes, nodes.size());
      const auto there = transit.ways_from(nodes[base]), back = transit.ways_to(nodes[base]);
      std::vector<Pose2> joined;
      for (const std::size_t node : nodes) {
        if (std::isfinite(there.times_s[node]) && std::isfinite(back.times_s[node]))
          joined.push_back(transit.pose(node));
      }
      if (joined.size() > poses_.size()) poses_ = std::move(joined);
    }
  }

  /// Returns true if a way leads from there to one of the nearest exits; after a stop request as well.
  [[nodiscard]] bool lead_on(const Pose2& from) const {
    if (stop_.stop_requested()) return true;
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t i = 0; i < poses_.size(); ++i)
      near.emplace_back(distance(from.position, poses_[i].position), i);
    const auto kept = static_cast<std::ptrdiff_t>(std::min(near.size(), most_exits));
    std::partial_sort(near.begin(), near.begin() + kept, near.end());
    return std::any_of(near.begin(), near.begin() + kept, [&](const auto& one) {
      // A way from a place to the end of a lane is one from there, turned about, to the place.
      const Pose2& to = poses_[one.second];
      return free_turning_path(from, to, problem_, room_) ||
             free_turning_path(from, {to.position, to.heading_rad + pi}, problem_, room_);
    });
  }
  [[nodiscard]] bool none() const { return poses_.empty(); }

 private:
  const CoverProblem& problem_;
  const FreeRoom& room_;
  const std::stop_token& stop_;
  std::vector<Pose2> poses_;
};

/// The lane with both ends moved inwards until they lead on; nothing where too little is left.
std::optional<Segment> trimmed(Segment lane, const CoverProblem& problem, const Exits& exits,
                               double least_m) {
  if (exits.none()) return lane;
  for (const bool at_end : {true, false}) {
    int trims = 0;
    for (;; ++trims) {
      const double length = distance(lane.a, lane.b);
      if (length < least_m || trims > most_trims) return std::nullopt;
      const double heading = heading_of(at_end ? lane.b - lane.a : lane.a - lane.b);
      Vec2& end = at_end ? lane.b : lane.a;
      if (exits.lead_on({end, heading})) break;
      const double step = trim_part * problem.turning_radius_m;
      if (length <= step) return std::nullopt;
      end = end - step * direction(heading);
    }
  }
  return lane;
}

/// The lanes as chains of short pieces, between which others may come and go.
std::vector<Stroke> dotted(const std::vector<Segment>& lanes, double turning_radius_m) {
  double length = 0.0;
  for (const Segment& lane : lanes) length += distance(lane.a, lane.b);
  const double step = std::max(dot_part * turning_radius_m, length / most_dots);
  std::vector<Stroke> strokes;
  for (const Segment& lane : lanes) {
    const int count = std::max(1, static_cast<int>(distance(lane.a, lane.b) / step));
    Stroke stroke{{}, PieceRole::lane, false};
    for (int i = 0; i < count; ++i) {
      const auto at = [&](int k) { return lane.a + (static_cast<double>(k) / count) * (lane.b - lane.a); };
      stroke.pieces.push_back({at(i), at(i + 1), {}, 0.0});
    }
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

/// Collects strokes and what they surely cover of a field.
class Collection {
 public:
  Collection(const CoverProblem& problem, const CoverField& field, double arc_m, const std::stop_token& stop)
      : problem_(problem), field_(field), stop_(stop) {
    rest_ = common(grown(field.standing, problem.sure_radius_m(), arc_m), field.area);
  }

  void add(Stroke stroke) {
    rest_ = without(rest_, strip_of(stroke.pieces));
    strokes.push_back(std::move(stroke));
  }
  /// Adds the lane if it covers enough that is not covered.
  void add_if_worth(Segment lane, PieceRole role) {
    const std::vector<PathPiece> pieces{{lane.a, lane.b, {}, 0.0}};
    const Region strip = strip_of(pieces);
    const double gain = area_of(common(rest_, strip));
    if (gain < least_gain * area_of(strip) && gain < least_rest * area_of(field_.reach)) return;
    if (gain < 0.1 * least_rest * area_of(field_.reach)) return;
    rest_ = without(rest_, strip);
    strokes.push_back({pieces, role, false});
  }
  [[nodiscard]] const Region& rest() const { return rest_; }

  std::vector<Stroke> strokes;

 private:
  [[nodiscard]] Region strip_of(const std::vector<PathPiece>& pieces) const {
    return coverage_along(begin_of(pieces), pieces, problem_, field_.area, true, stop_).covered;
  }

  const CoverProblem& problem_;
  const CoverField& field_;
  const std::stop_token& stop_;
  Region rest_;
};

/// The straight sides of the exact laps, which rounded ones may leave.
Outcome<std::vector<Segment>> sides_of(const CoverProblem& problem, const CoverField& field, double arc_m,
                                       int laps, const std::stop_token& stop) {
  std::vector<Segment> sides;
  for (int k = 0; k < laps && !stop.stop_requested(); ++k) {
    const double depth = problem.radius_m() + k * problem.stride_m();
    if (depth > most_polygon_radius_m) break;
    auto ground = PolygonGround::of(field.ground->boundary, field.ground->obstacles, depth);
    if (!ground) return pass_on(ground);
    for (const Lap& lap : laps_within(*ground, field.standing, arc_m)) {
      for (const PathPiece& piece : lap) {
        if (piece.turn_rad == 0.0 && length_of(piece) >= problem.stride_m())
          sides.push_back({piece.from, piece.to});
      }
    }
  }
  return sides;
}

std::vector<Segment> lanes_of(const CellChoices& cells) {
  std::vector<Segment> lanes;
  for (const auto& choice : cells)
    lanes.insert(lanes.end(), choice.front().lanes.begin(), choice.front().lanes.end());
  return lanes;
}

}  // namespace

std::vector<PathPiece> turned_round(const Stroke& stroke) { return turned_round(Lap(stroke.pieces)); }

std::vector<PathPiece> without_excursions(const std::vector<PathPiece>& pieces) {
  std::vector<PathPiece> plain;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool comes_back = i + 1 < pieces.size() && pieces[i + 1].to == pieces[i].from &&
                            pieces[i + 1].backward != pieces[i].backward;
    if (comes_back) {
      ++i;
    } else {
      plain.push_back(pieces[i]);
    }
  }
  return plain;
}

std::vector<std::size_t> add_strokes(TurningTransit& transit, const std::vector<Stroke>& strokes) {
  std::vector<std::size_t> nodes;
  for (const Stroke& stroke : strokes) {
    const Lap plain = without_excursions(stroke.pieces);
    if (plain.empty()) continue;
    for (const Lap& way : {plain, turned_round(plain)}) {
      const std::size_t first = transit.add(begin_of(way));
      nodes.push_back(first);
      std::size_t at = first;
      for (std::size_t i = 0; i < way.size(); ++i) {
        const bool closes = stroke.closed && i + 1 == way.size();
        const std::size_t next = closes ? first : transit.add({way[i].to, heading_out(way[i])});
        if (!closes) nodes.push_back(next);
        transit.join(at, next, {way[i]});
        at = next;
      }
    }
  }
  return nodes;
}

Outcome<std::vector<Stroke>> turning_strokes(const CoverProblem& problem, const CoverField& field,
                                             double arc_m, std::int64_t directions, int laps,
                                             const FreeRoom& room, const std::stop_token& stop) {
  Collection all(problem, field, arc_m, stop);
  int made = 0;
  for (; made < laps && !stop.stop_requested(); ++made) {
    auto strokes = headland_lap(problem, field, made, arc_m, room);
    if (!strokes) return pass_on(strokes);
    if (strokes->empty()) break;
    for (Stroke& stroke : *strokes) all.add(std::move(stroke));
  }
  const Strides strides(problem);
  std::vector<double> headings = sweep_headings(field, directions);
  const auto lanes = [&](const Region& region) {
    return lanes_of(cells_of(region, problem, headings, stop));
  };
  const Region inside = core_of(problem, field, problem.sure_radius_m() - 2.0 * strides.slack_m);
  auto sides = sides_of(problem, field, arc_m, std::max(1, std::min(laps, made + 1)), stop);
  if (!sides) return pass_on(sides);
  std::vector<Stroke> chains = all.strokes;
  if (chains.empty()) {  // too narrow for any lap: lanes lead to lanes
    std::vector<Segment> segments = lanes(inside);
    segments.insert(segments.end(), sides->begin(), sides->end());
    chains = dotted(segments, problem.turning_radius_m);
  }
  const Exits exits(chains, problem, room, stop);
  if (laps != all_laps) {
    const double depth = (laps - 1) * problem.stride_m() + 0.5 * strides.slab_m;
    for (const Segment& lane : lanes(core_of(problem, field, depth))) {
      if (stop.stop_requested()) break;
      const auto kept = trimmed(lane, problem, exits, least_lane * problem.stride_m());
      if (kept) all.add({{{kept->a, kept->b, {}, 0.0}}, PieceRole::lane, false});
    }
  }
  const auto add_rest = [&](const std::vector<Segment>& segments) {
    for (const Segment& one : segments) {
      if (stop.stop_requested()) return;
      const auto kept = trimmed(one, problem, exits, least_lane * problem.stride_m());
      if (kept) all.add_if_worth(*kept, PieceRole::lane);
    }
  };
  add_rest(*sides);
  const std::size_t along = headings.size();
  for (std::size_t i = 0; i < along; ++i) headings.push_back(headings[i] + 0.25 * pi);
  add_rest(lanes(common(inside, all.rest())));
  if (stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it planned lanes");
  return std::move(all.strokes);
}

}  // namespace outrider::cover
