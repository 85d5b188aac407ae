#include "scan/surface_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "algebra/small_cholesky.hpp"
#include "graph/graph_edges.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double cell_m = 0.05;
constexpr int splat_cells = 3;
constexpr double splat_sd_m = 0.08;
constexpr int high_margin = splat_cells + 1;

constexpr double bucket_m = 0.15;    // also the distance within which a point searches its surface
constexpr double merged_m = 0.04;    // elements nearer than this become one
constexpr double most_count = 8.0;   // of points in an element that count
constexpr double same_side = 0.5;    // cosine between normals of one surface
constexpr double robust_m = 0.05;    // distance from which the weight decreases (Cauchy)
constexpr double point_sd_m = 0.06;  // of a distance, including the correlation of neighbours
constexpr std::size_t most_refined = 240;

using Kernel = std::array<std::uint8_t, (2 * splat_cells + 1) * (2 * splat_cells + 1)>;
const Kernel& kernel() {
  static const Kernel values = [] {
    Kernel k{};
    for (int y = -splat_cells, i = 0; y <= splat_cells; ++y) {
      for (int x = -splat_cells; x <= splat_cells; ++x, ++i) {
        const double squared = (x * x + y * y) * cell_m * cell_m / (splat_sd_m * splat_sd_m);
        k[static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * squared)));
      }
    }
    return k;
  }();
  return values;
}

/// Returns a frame whose cells lie on the lattice of the world.
GridFrame frame_about(const Box2& box, double side_m, int low, int high) {
  const auto cell = [&](double x) { return static_cast<int>(std::floor(x / side_m)); };
  const int x = cell(box.low.x) - low, y = cell(box.low.y) - low;
  return {{x * side_m, y * side_m}, side_m, cell(box.high.x) + 1 + high - x, cell(box.high.y) + 1 + high - y};
}

/// Returns the maxima over squares of 2 by 2 cells.
Grid<std::uint8_t> halved(const Grid<std::uint8_t>& field) {
  const auto smaller = [](int n) { return (n + 1) / 2; };
  GridFrame frame = field.frame;
  frame.resolution_m *= 2.0;
  frame.width = smaller(frame.width);
  frame.height = smaller(frame.height);
  Grid<std::uint8_t> half(frame);
  for (int y = 0; y < field.frame.height; ++y) {
    const std::uint8_t* from = &field[{0, y}];
    std::uint8_t* to = &half[{0, y / 2}];
    for (int x = 0; x + 1 < field.frame.width; x += 2) {
      const std::uint8_t both = std::max(from[x], from[x + 1]);
      to[x / 2] = std::max(to[x / 2], both);
    }
    if (const int x = field.frame.width - 1; x % 2 == 0) to[x / 2] = std::max(to[x / 2], from[x]);
  }
  return half;
}

/// Returns in each cell the maximum over so many cells to the right and up, itself included.
Grid<std::uint8_t> widened(const Grid<std::uint8_t>& field, int cells) {
  const int width = field.frame.width, height = field.frame.height;
  Grid<std::uint8_t> right = field;
  for (int y = 0; y < height; ++y) {
    std::uint8_t* to = &right[{0, y}];
    for (int off = 1; off < cells; ++off) {
      const std::uint8_t* from = &field[{0, y}] + off;
      for (int x = 0; x + off < width; ++x) to[x] = std::max(to[x], from[x]);
    }
  }
  Grid<std::uint8_t> wide = right;
  for (int y = 0; y < height; ++y) {
    std::uint8_t* to = &wide[{0, y}];
    for (int up = y + 1; up < std::min(y + cells, height); ++up) {
      const std::uint8_t* from = &right[{0, up}];
      for (int x = 0; x < width; ++x) to[x] = std::max(to[x], from[x]);
    }
  }
  return wide;
}

}  // namespace

SurfaceMap::SurfaceMap(std::span<const Part> parts, int levels) {
  std::vector<std::pair<SurfacePoint, int>> points;
  Box2 box{{1e18, 1e18}, {-1e18, -1e18}};
  for (const Part& part : parts) {
    const Vec2 x = direction(part.pose.heading_rad), y = perpendicular(x);
    for (const SurfacePoint& p : *part.surface) {
      const Vec2 place = part.pose.position + p.position.x * x + p.position.y * y;
      points.push_back({{place, p.normal.x * x + p.normal.y * y}, part.group});
      box = {{std::min(box.low.x, place.x), std::min(box.low.y, place.y)},
             {std::max(box.high.x, place.x), std::max(box.high.y, place.y)}};
    }
  }
  if (points.empty()) box = {{0.0, 0.0}, {0.0, 0.0}};
  const int low_margin = (1 << levels) + splat_cells + 1;  // a window of the top level is empty there
  levels_.emplace_back(frame_about(box, cell_m, low_margin, high_margin));
  bucket_frame_ = frame_about(box, bucket_m, 1, 1);
  first_.assign(bucket_frame_.size(), -1);
  for (const auto& [point, group] : points) {
    splat(point.position);
    add(point, group);
  }
  build_pyramid(levels);
  sort_elements();
}

/// Puts the elements of each bucket next to each other, and makes their normals unit vectors.
void SurfaceMap::sort_elements() {
  std::vector<Element> sorted;
  sorted.reserve(elements_.size());
  for (std::int32_t& first : first_) {
    std::int32_t i = first;
    first = static_cast<std::int32_t>(sorted.size());
    while (i >= 0) {
      sorted.push_back(elements_[static_cast<std::size_t>(i)]);
      Element& e = sorted.back();
      i = e.next;
      const double length = norm(e.normal);
      e.normal = length > 0.0 ? (1.0 / length) * e.normal : Vec2{};
      e.count = std::min(e.count, most_count);
    }
  }
  first_.push_back(static_cast<std::int32_t>(sorted.size()));
  elements_ = std::move(sorted);
}

void SurfaceMap::splat(Vec2 position) {
  Grid<std::uint8_t>& field = levels_.front();
  const Cell centre = field.frame.cell_at(position);
  constexpr std::uint8_t full = 255;
  if (field[centre] == full) return;
  auto value = kernel().begin();
  for (int y = -splat_cells; y <= splat_cells; ++y) {
    std::uint8_t* row = &field[{centre.x - splat_cells, centre.y + y}];
    for (int x = 0; x <= 2 * splat_cells; ++x, ++row, ++value) *row = std::max(*row, *value);
  }
}

/// Level 0 is the field. The cell x, y of a higher one holds the maximum over the squares of side 2^(level +
/// 1) that begin in the square of side 2^(level - 1) at x, y: over 4 such squares in each direction on level
/// 1, over 5 above it.
void SurfaceMap::build_pyramid(int levels) {
  Grid<std::uint8_t> pooled = levels_.front();  // by squares of side 2^(level - 1)
  for (int level = 1; level < levels; ++level) {
    if (level > 1) pooled = halved(pooled);
    levels_.push_back(widened(pooled, level == 1 ? 4 : 5));
  }
}

/// Merges the point with an element on the same surface, or makes a new element.
void SurfaceMap::add(const SurfacePoint& point, int group) {
  std::int32_t& head = first_[bucket_frame_.index(bucket_frame_.cell_at(point.position))];
  for (std::int32_t i = head; i >= 0; i = elements_[static_cast<std::size_t>(i)].next) {
    Element& e = elements_[static_cast<std::size_t>(i)];
    const double facing = dot(e.normal, point.normal);
    if (e.group != group || facing < same_side * norm(e.normal) * norm(point.normal)) continue;
    if (squared_norm(e.position - point.position) > merged_m * merged_m) continue;
    e.count += 1.0;
    e.position = e.position + (1.0 / e.count) * (point.position - e.position);
    e.normal = e.normal + point.normal;
    return;
  }
  elements_.push_back({point.position, point.normal, 1.0, group, head});
  head = static_cast<std::int32_t>(elements_.size() - 1);
}

/// Returns the surface around a point that faces the same way: the weighted mean of the lines nearby.
std::optional<SurfaceMap::Line> SurfaceMap::line_at(Vec2 position, Vec2 normal, int group) const {
  constexpr double squared_reach = bucket_m * bucket_m;
  const Cell bucket = bucket_frame_.cell_at(position);
  double weights = 0.0, distances = 0.0;
  Vec2 normals;
  const int left = std::max(0, bucket.x - 1), right = std::min(bucket_frame_.width - 1, bucket.x + 1);
  if (left > right) return std::nullopt;
  for (int y = std::max(0, bucket.y - 1); y <= std::min(bucket_frame_.height - 1, bucket.y + 1); ++y) {
    const auto end = static_cast<std::size_t>(first_[bucket_frame_.index({right, y}) + 1]);
    for (auto i = static_cast<std::size_t>(first_[bucket_frame_.index({left, y})]); i < end; ++i) {
      const Element& e = elements_[i];
      const Vec2 between = position - e.position;
      const double near = 1.0 - squared_norm(between) / squared_reach;
      if (near <= 0.0 || dot(e.normal, normal) < same_side || (group >= 0 && e.group != group)) continue;
      const double weight = near * near * e.count;
      weights += weight;
      distances += weight * dot(e.normal, between);
      normals = normals + weight * e.normal;
    }
  }
  if (!(weights > 0.0)) return std::nullopt;
  return Line{(1.0 / norm(normals)) * normals, distances / weights};
}

MatchEquations SurfaceMap::equations(const Surface& surface, const Pose2& pose, int group) const {
  MatchEquations sum;
  const Vec2 along = direction(pose.heading_rad), across = perpendicular(along);
  for (const SurfacePoint& p : surface) {
    if (p.normal == Vec2{}) continue;
    const Vec2 arm = p.position.x * along + p.position.y * across;
    const auto line = line_at(pose.position + arm, p.normal.x * along + p.normal.y * across, group);
    if (!line) continue;
    const double s = line->distance_m / robust_m;
    const double weight = 1.0 / ((1.0 + s * s) * point_sd_m * point_sd_m);
    const Eigen::Vector3d by(line->normal.x, line->normal.y, cross(arm, line->normal));
    sum.gradient += weight * by * line->distance_m;
    sum.hessian += weight * by * by.transpose();
    sum.cost += 0.5 * std::log1p(s * s) * robust_m * robust_m / (point_sd_m * point_sd_m);
    sum.squares += line->distance_m * line->distance_m;
    ++sum.on_surface;
  }
  return sum;
}

double Fit::certainty() const {
  constexpr double correlated = 3.0, least_sd_m = 0.035, most_sd_m = 0.09;
  const double sd_m = std::clamp(correlated * rms_m, least_sd_m, most_sd_m);
  return point_sd_m * point_sd_m / (sd_m * sd_m);
}

Fit SurfaceMap::refine(const Surface& surface, const Pose2& start, const PosePrior& prior, int group) const {
  constexpr int most_steps = 12;
  constexpr double enough = 1e-5;
  constexpr double held = 1e-3;
  const Surface few = thinned(surface, most_refined);
  Fit fit;
  fit.pose = start;
  MatchEquations sum;
  for (int step = 0; step < most_steps; ++step) {
    sum = equations(few, fit.pose, group);
    const Eigen::Vector3d off(fit.pose.position.x - prior.mean.position.x,
                              fit.pose.position.y - prior.mean.position.y,
                              wrap_angle(fit.pose.heading_rad - prior.mean.heading_rad));
    const SmallCholesky<3> factor(sum.hessian + prior.information + held * Eigen::Matrix3d::Identity());
    const Eigen::Vector3d move = factor.solve(sum.gradient + prior.information * off);
    if (!factor.is_positive() || !move.allFinite()) break;
    fit.pose = {fit.pose.position - Vec2{move[0], move[1]}, fit.pose.heading_rad - move[2]};
    if (move.lpNorm<Eigen::Infinity>() < enough) break;
  }
  sum = equations(few, fit.pose, group);
  fit.information = sum.hessian;
  const auto count = static_cast<double>(sum.on_surface);
  fit.share = few.empty() ? 0.0 : count / static_cast<double>(few.size());
  fit.rms_m = sum.on_surface > 0 ? std::sqrt(sum.squares / count) : 0.0;
  return fit;
}

}  // namespace outrider
