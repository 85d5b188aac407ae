#include "turning_strokes.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/jobs/cover/coverage.hpp"

namespace outrider::cover {
namespace {

constexpr int most_trims = 16;          // of an end of a lane
constexpr double trim_part = 0.25;      // of the turning radius, in one of them
constexpr double least_gain = 0.15;     // of the area of its strip, that a stroke adds
constexpr double least_rest = 1e-4;     // of the reach, worth a stroke
constexpr std::size_t most_exits = 16;  // of the headland, tried from the end of a lane
constexpr double strip_step_rad = radians(2.0);

Pose2 begin_of(const std::vector<PathPiece>& pieces) {
  return {pieces.front().from, heading_in(pieces.front())};
}

/// Where lanes may lead to: poses along the headland that lead to each other.
class Exits {
 public:
  Exits(const std::vector<Stroke>& laps, const CoverProblem& problem, const FreeRoom& room,
        const std::stop_token& stop)
      : problem_(problem), room_(room) {
    TurningTransit transit(problem, room);
    const auto nodes = add_strokes(transit, laps);
    transit.connect(nodes, nodes, stop);
    for (std::size_t base = 0; base < std::min<std::size_t>(2, nodes.size()); ++base) {
      const auto there = transit.ways_from(nodes[base]), back = transit.ways_to(nodes[base]);
      std::vector<Pose2> joined;
      for (const std::size_t node : nodes) {
        if (std::isfinite(there.times_s[node]) && std::isfinite(back.times_s[node]))
          joined.push_back(transit.pose(node));
      }
      if (joined.size() > poses_.size()) poses_ = std::move(joined);
    }
  }

  [[nodiscard]] bool lead_on(const Pose2& from) const {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t i = 0; i < poses_.size(); ++i)
      near.emplace_back(distance(from.position, poses_[i].position), i);
    const auto kept = static_cast<std::ptrdiff_t>(std::min(near.size(), most_exits));
    std::partial_sort(near.begin(), near.begin() + kept, near.end());
    return std::any_of(near.begin(), near.begin() + kept, [&](const auto& one) {
      return free_turning_path(from, poses_[one.second], problem_, room_).has_value();
    });
  }
  [[nodiscard]] bool none() const { return poses_.empty(); }

 private:
  const CoverProblem& problem_;
  const FreeRoom& room_;
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
    const auto points = points_along(pieces.front().from, pieces, strip_step_rad);
    return coverage_of(points, problem_.sure_radius_m(), field_.area, stop_).covered;
  }

  const CoverProblem& problem_;
  const CoverField& field_;
  const std::stop_token& stop_;
  Region rest_;
};

void add_lanes(Collection& all, const Region& core, const CoverProblem& problem,
               const std::vector<double>& headings, const Exits& exits, bool whole,
               const std::stop_token& stop) {
  for (const auto& choice : cells_of(core, problem, headings, stop)) {
    for (const Segment& lane : choice.front().lanes) {
      const auto kept = trimmed(lane, problem, exits, 0.1 * problem.stride_m());
      if (!kept) continue;
      if (whole) {
        all.add({{{kept->a, kept->b, {}, 0.0}}, PieceRole::lane, false});
      } else {
        all.add_if_worth(*kept, PieceRole::lane);
      }
    }
  }
}

/// The straight sides of the exact laps, where the rounded ones left enough of them.
Status add_sides(Collection& all, const CoverProblem& problem, const CoverField& field, double arc_m,
                 int laps, const Exits& exits) {
  for (int k = 0; k < laps; ++k) {
    auto ground = PolygonGround::of(field.ground->boundary, field.ground->obstacles,
                                    problem.radius_m() + k * problem.stride_m());
    if (!ground) return pass_on(ground);
    for (const Lap& lap : laps_within(*ground, field.standing, arc_m)) {
      for (const PathPiece& piece : lap) {
        if (piece.turn_rad != 0.0) continue;
        const auto kept = trimmed({piece.from, piece.to}, problem, exits, problem.stride_m());
        if (kept) all.add_if_worth(*kept, PieceRole::lane);
      }
    }
  }
  return {};
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
  const Exits exits(all.strokes, problem, room, stop);
  const Strides strides(problem);
  std::vector<double> headings = sweep_headings(field, directions);
  if (laps != all_laps) {
    const double depth = (laps - 1) * problem.stride_m() + 0.5 * strides.slab_m;
    add_lanes(all, core_of(problem, field, depth), problem, headings, exits, true, stop);
  }
  if (auto good = add_sides(all, problem, field, arc_m, std::max(1, std::min(laps, made + 1)), exits); !good)
    return pass_on(good);
  const Region inside = core_of(problem, field, problem.sure_radius_m() - 2.0 * strides.slack_m);
  const std::size_t along = headings.size();
  for (std::size_t i = 0; i < along; ++i) headings.push_back(headings[i] + 0.25 * pi);
  add_lanes(all, common(inside, all.rest()), problem, headings, exits, false, stop);
  if (stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it planned lanes");
  return std::move(all.strokes);
}

}  // namespace outrider::cover
