#include "outrider/sim/sensors/range_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double least_tile_m = 1.0;
constexpr int most_tiles = 256;   // a side
constexpr double touch = 1e-9;    // beyond the ends of an edge that still count, relative
constexpr double touch_m = 1e-9;  // from an outline that is contact

int tile_at(double t, int count) {
  return static_cast<int>(std::clamp(std::floor(t), 0.0, static_cast<double>(count - 1)));
}

/// Returns the t >= 0 at which the ray from + t * along meets the edge, or infinity. A ray that runs along
/// the edge does not count, because it meets the edges or circles beside it first.
double meets(Vec2 from, Vec2 along, const Segment& edge) {
  const Vec2 d = edge.b - edge.a;
  const Vec2 to_a = edge.a - from;
  const double slant = cross(along, d);
  if (slant == 0.0) return inf;
  const double u = cross(to_a, along) / slant;
  if (u < -touch || u > 1.0 + touch) return inf;
  const double t = cross(to_a, d) / slant;
  return t >= 0.0 ? t : inf;
}

/// The same for a circle and a unit vector: the nearest t >= 0, from inside that of leaving it.
double meets(Vec2 from, Vec2 along, Vec2 centre, double radius) {
  const Vec2 to_centre = centre - from;
  const double aside = cross(along, to_centre);
  const double half2 = radius * radius - aside * aside;
  if (half2 < 0.0) return inf;
  const double middle = dot(along, to_centre);
  const double half = std::sqrt(half2);
  if (middle - half >= 0.0) return middle - half;
  return middle + half >= 0.0 ? middle + half : inf;
}

/// The beams that may meet an outline: `count` of them from number `first` on, modulo all.
struct Beams {
  std::int64_t first = 0;
  std::int64_t count = 0;
};

/// Returns the beams from a bearing on through an angle, with one to spare on either side.
Beams beams_between(double low_rad, double through_rad, double step_rad, std::int64_t all) {
  const auto first = static_cast<std::int64_t>(std::ceil(low_rad / step_rad)) - 1;
  const auto last = static_cast<std::int64_t>(std::floor((low_rad + through_rad) / step_rad)) + 1;
  return {first, std::min(all, last - first + 1)};
}

/// Returns the value that a message of single precision holds. It is not inlined because g++ 12 leaves out
/// both conversions where it vectorises two of these side by side.
[[gnu::noinline]] double in_single_precision(double value) {
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace

std::vector<RoundedPolygon> cut_at(const World& world, double height_m) {
  const double z_m = world.floor_z_m + height_m;
  std::vector<RoundedPolygon> pieces;
  for (const Solid& solid : world.solids) {
    for (RoundedPolygon& piece : footprint(solid, z_m, z_m)) pieces.push_back(std::move(piece));
  }
  return pieces;
}

RangeFinder::RangeFinder(const std::vector<RoundedPolygon>& pieces, const RangeFinderModel& model)
    : model_(model) {
  for (const RoundedPolygon& piece : pieces) add(piece);
  sort_into_tiles();
}

void RangeFinder::add(const RoundedPolygon& piece) {
  const std::vector<Vec2>& core = piece.core;
  const std::size_t edges = core.size() == 2 && piece.radius_m == 0.0 ? 1 : core.size();
  for (std::size_t i = 0; i < edges; ++i) {
    const Vec2 a = core[i];
    const Vec2 b = core[(i + 1) % core.size()];
    if (a != b) {
      const Vec2 out = piece.radius_m / distance(a, b) * -perpendicular(b - a);
      outlines_.push_back({{a + out, b + out}, 0.0, core.size() > 2});
    }
    if (piece.radius_m > 0.0) outlines_.push_back({{a, a}, piece.radius_m, false});
  }
}

RangeFinder::Tiles RangeFinder::tiles_of(const Box2& box) const {
  return {tile_at((box.low.x - bounds_.low.x) / tile_m_, columns_),
          tile_at((box.high.x - bounds_.low.x) / tile_m_, columns_),
          tile_at((box.low.y - bounds_.low.y) / tile_m_, rows_),
          tile_at((box.high.y - bounds_.low.y) / tile_m_, rows_)};
}

void RangeFinder::sort_into_tiles() {
  std::vector<Box2> boxes;
  for (const Outline& outline : outlines_) {
    Box2 box;
    box.include(outline.edge.a);
    box.include(outline.edge.b);
    boxes.push_back(box.grown(outline.radius_m));
    bounds_.include(boxes.back().low);
    bounds_.include(boxes.back().high);
  }
  if (bounds_.empty()) {
    first_.assign(2, 0);
    return;
  }
  tile_m_ = std::max(least_tile_m, std::max(bounds_.size().x, bounds_.size().y) / most_tiles);
  columns_ = static_cast<int>(std::max(1.0, std::ceil(bounds_.size().x / tile_m_)));
  rows_ = static_cast<int>(std::max(1.0, std::ceil(bounds_.size().y / tile_m_)));
  for (const Box2& box : boxes) tiles_.push_back(tiles_of(box));
  const auto for_each_tile = [&](const Tiles& r, auto visit) {
    for (int y = r.y0; y <= r.y1; ++y) {
      for (int x = r.x0; x <= r.x1; ++x) visit(static_cast<std::size_t>(y * columns_ + x));
    }
  };
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Tiles& tiles : tiles_) for_each_tile(tiles, [&](std::size_t t) { ++first_[t + 1]; });
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  items_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < tiles_.size(); ++i) {
    for_each_tile(tiles_[i], [&](std::size_t t) { items_[next[t]++] = i; });
  }
}

/// Visits each outline whose tiles meet those of the box, once: in the first tile that they share.
template <class Visit>
void RangeFinder::visit_near(const Box2& box, Visit visit) const {
  if (!bounds_.overlaps(box)) return;
  const Tiles near = tiles_of(box);
  for (int y = near.y0; y <= near.y1; ++y) {
    for (int x = near.x0; x <= near.x1; ++x) {
      const auto t = static_cast<std::size_t>(y * columns_ + x);
      for (std::uint32_t k = first_[t]; k < first_[t + 1]; ++k) {
        const Tiles& own = tiles_[items_[k]];
        if (x == std::max(near.x0, own.x0) && y == std::max(near.y0, own.y0)) visit(outlines_[items_[k]]);
      }
    }
  }
}

std::vector<double> RangeFinder::ranges(const Pose2& world_T_laser, std::int64_t beams) const {
  const double step_rad = 2.0 * pi / static_cast<double>(beams);
  const Vec2 from = world_T_laser.position;
  std::vector<double> nearest(static_cast<std::size_t>(beams), inf);
  std::vector<Vec2> along;
  for (std::int64_t i = 0; i < beams; ++i) {
    along.push_back(direction(world_T_laser.heading_rad + static_cast<double>(i) * step_rad));
  }
  visit_near(Box2{from, from}.grown(model_.most_m), [&](const Outline& outline) {
    const bool round = outline.radius_m > 0.0;
    if (outline.solid_left && cross(outline.edge.b - outline.edge.a, from - outline.edge.a) > 0.0) return;
    const Vec2 to_a = outline.edge.a - from;
    const Vec2 to_b = outline.edge.b - from;
    const double away = round ? norm(to_a) - outline.radius_m : distance(from, outline.edge);
    if (away > model_.most_m) return;
    double low = heading_of(to_a);
    double through = std::atan2(cross(to_a, to_b), dot(to_a, to_b));
    if (round) {
      const double half = away > 0.0 ? std::asin(outline.radius_m / norm(to_a)) : pi;
      low -= half;
      through = 2.0 * half;
    } else if (away < 1e-9) {
      through = 2.0 * pi;  // the laser stands on the edge
    } else if (through < 0.0) {
      low += through;
      through = -through;
    }
    const Beams taken = beams_between(low - world_T_laser.heading_rad, through, step_rad, beams);
    for (std::int64_t i = 0; i < taken.count; ++i) {
      const auto beam = static_cast<std::size_t>(((taken.first + i) % beams + beams) % beams);
      const double t = round ? meets(from, along[beam], outline.edge.a, outline.radius_m)
                             : meets(from, along[beam], outline.edge);
      nearest[beam] = std::min(nearest[beam], t);
    }
  });
  for (double& range : nearest) range = range <= model_.most_m ? range : inf;
  return nearest;
}

LaserScan RangeFinder::look(const Pose2& world_T_laser, double time_s, Rng& rng,
                            const RangeFinder& other) const {
  std::vector<double> nearest = ranges(world_T_laser, model_.beams);
  const std::vector<double> others = other.ranges(world_T_laser, model_.beams);
  for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = std::min(nearest[i], others[i]);
  return measured(nearest, time_s, rng);
}

LaserScan RangeFinder::measured(const std::vector<double>& ranges_m, double time_s, Rng& rng) const {
  LaserScan scan{time_s,
                 0.0,
                 in_single_precision(2.0 * pi / static_cast<double>(model_.beams)),
                 in_single_precision(model_.least_m),
                 in_single_precision(model_.most_m),
                 {}};
  scan.ranges_m.reserve(static_cast<std::size_t>(model_.beams));
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const double exact_step_rad = 2.0 * pi / static_cast<double>(ranges_m.size());
  for (std::size_t beam = 0; beam < ranges_m.size(); ++beam) {
    const double exact = ranges_m[beam];
    const double error_m = model_.noise_m * rng.normal();
    const auto from_ahead = static_cast<double>(std::min(beam, ranges_m.size() - beam));
    const bool out_of_view = from_ahead * exact_step_rad > 0.5 * model_.view_rad + touch;
    const bool missed = rng.uniform() < model_.missed || out_of_view;
    const double measured = missed || exact < model_.least_m ? 0.0 : std::max(0.0, exact + error_m);
    const auto range_m = static_cast<float>(measured);
    scan.ranges_m.push_back(static_cast<double>(range_m) > scan.most_m ? infinite : range_m);
  }
  return scan;
}

bool RangeFinder::sees(Vec2 from, Vec2 to) const {
  Box2 box;
  box.include(from);
  box.include(to);
  bool clear = true;
  visit_near(box, [&](const Outline& outline) {
    if (!clear) return;
    if (outline.radius_m == 0.0) {
      clear = distance(Segment{from, to}, outline.edge) > touch_m;
      return;
    }
    const Vec2 centre = outline.edge.a;
    const double outer = std::max(distance(from, centre), distance(to, centre));
    clear = distance(centre, {from, to}) > outline.radius_m + touch_m || outer < outline.radius_m;
  });
  return clear;
}

double RangeFinder::surface_distance(Vec2 p, double most_m) const {
  double nearest = most_m;
  visit_near(Box2{p, p}.grown(most_m), [&](const Outline& outline) {
    const double away = outline.radius_m > 0.0 ? std::abs(distance(p, outline.edge.a) - outline.radius_m)
                                               : distance(p, outline.edge);
    nearest = std::min(nearest, away);
  });
  return nearest;
}

}  // namespace outrider
