#include "outrider/world/height_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/geometry/triangle.hpp"

namespace outrider {
namespace {

constexpr double farthest_m = 1e6;

}  // namespace

Status HeightField::check_size(double columns, double rows) {
  if (columns >= 2.0 && rows >= 2.0 && columns * rows <= static_cast<double>(most_posts)) return {};
  return bad_input(fmt::format("a height field of {:g} x {:g} posts is not read; expected 2 x 2 to {} in all",
                               columns, rows, most_posts));
}

Outcome<HeightField> HeightField::make(Vec2 origin, Vec2 spacing_m, int columns, int rows,
                                       std::vector<double> heights_m) {
  if (auto size = check_size(columns, rows); !size) return pass_on(size);
  const auto posts = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  if (heights_m.size() != posts) {
    return bad_input(
        fmt::format("{} x {} posts take {} heights, {} are given", columns, rows, posts, heights_m.size()));
  }
  const Vec2 far = origin + Vec2{spacing_m.x * (columns - 1), spacing_m.y * (rows - 1)};
  const auto near = [](double v) { return std::abs(v) <= farthest_m; };  // false for NaN too
  if (!(spacing_m.x > 0.0) || !(spacing_m.y > 0.0) || !near(origin.x) || !near(origin.y) || !near(far.x) ||
      !near(far.y)) {
    return bad_input(
        fmt::format("a spacing of {:g} x {:g} m from ({:g}, {:g}) is not valid; it is above 0 and "
                    "stays within 1e6 m",
                    spacing_m.x, spacing_m.y, origin.x, origin.y));
  }
  if (const auto bad = std::ranges::find_if_not(heights_m, near); bad != heights_m.end()) {
    const auto i = bad - heights_m.begin();
    return bad_input(fmt::format("the height of post {}, {} is {:g} m; expected a number from -1e6 to 1e6",
                                 i % columns, i / columns, *bad));
  }
  HeightField field;
  field.origin_ = origin;
  field.spacing_m_ = spacing_m;
  field.columns_ = columns;
  field.rows_ = rows;
  field.heights_m_ = std::move(heights_m);
  const auto [low, high] = std::ranges::minmax(field.heights_m_);
  field.lowest_m_ = low;
  field.highest_m_ = high;
  for (int y = 0; y + 1 < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x)
      field.steepest_ = std::max(field.steepest_, field.steepest_in({x, y}));
  }
  field.build_pyramid();
  return field;
}

void HeightField::build_pyramid() {
  Layer cells{columns_ - 1, rows_ - 1, {}};
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.columns; ++x) {
      cells.highest_m.push_back(std::max({at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)}));
    }
  }
  pyramid_.push_back(std::move(cells));
  while (pyramid_.back().highest_m.size() > 1) {
    const Layer& fine = pyramid_.back();
    Layer coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
    coarse.highest_m.assign(static_cast<std::size_t>(coarse.columns) * static_cast<std::size_t>(coarse.rows),
                            lowest_m_);
    for (int y = 0; y < fine.rows; ++y) {
      for (int x = 0; x < fine.columns; ++x) {
        double& highest = coarse.highest_m[static_cast<std::size_t>(y / 2 * coarse.columns + x / 2)];
        highest = std::max(highest, fine.highest_m[static_cast<std::size_t>(y * fine.columns + x)]);
      }
    }
    pyramid_.push_back(std::move(coarse));
  }
}

Box2 HeightField::bounds() const { return {xy(post(0, 0)), xy(post(columns_ - 1, rows_ - 1))}; }

Vec3 HeightField::post(int column, int row) const {
  return {origin_.x + column * spacing_m_.x, origin_.y + row * spacing_m_.y, at(column, row)};
}

HeightField::Place HeightField::place(Vec2 p) const {
  const double u = std::clamp((p.x - origin_.x) / spacing_m_.x, 0.0, static_cast<double>(columns_ - 1));
  const double v = std::clamp((p.y - origin_.y) / spacing_m_.y, 0.0, static_cast<double>(rows_ - 1));
  const Cell cell{std::min(static_cast<int>(u), columns_ - 2), std::min(static_cast<int>(v), rows_ - 2)};
  return {cell, {u - cell.x, v - cell.y}};
}

double HeightField::height(Vec2 p) const {
  const auto [c, in] = place(p);
  const double low = at(c.x, c.y);
  const double high = at(c.x + 1, c.y + 1);
  const double side = in.x >= in.y ? at(c.x + 1, c.y) : at(c.x, c.y + 1);
  return in.x >= in.y ? low + in.x * (side - low) + in.y * (high - side)
                      : low + in.y * (side - low) + in.x * (high - side);
}

Vec2 HeightField::gradient(Vec2 p) const {
  const auto [c, in] = place(p);
  const double low = at(c.x, c.y);
  const double high = at(c.x + 1, c.y + 1);
  const double side = in.x >= in.y ? at(c.x + 1, c.y) : at(c.x, c.y + 1);
  return in.x >= in.y ? Vec2{(side - low) / spacing_m_.x, (high - side) / spacing_m_.y}
                      : Vec2{(high - side) / spacing_m_.x, (side - low) / spacing_m_.y};
}

Vec3 HeightField::normal(Vec2 p) const {
  const Vec2 slope = gradient(p);
  const double scale = 1.0 / std::sqrt(1.0 + squared_norm(slope));
  return {-scale * slope.x, -scale * slope.y, scale};
}

double HeightField::steepest_in(Cell cell) const {
  const Vec2 low = xy(post(cell.x, cell.y));
  return std::max(norm(gradient(low + Vec2{0.75 * spacing_m_.x, 0.25 * spacing_m_.y})),
                  norm(gradient(low + Vec2{0.25 * spacing_m_.x, 0.75 * spacing_m_.y})));
}

Interval HeightField::heights_over(const Box2& box) const {
  const Cell low = place(box.low).cell;
  const Cell high = place(box.high).cell;
  Interval heights{highest_m_, lowest_m_};
  for (int y = low.y; y <= high.y + 1; ++y) {
    for (int x = low.x; x <= high.x + 1; ++x) {
      heights.low = std::min(heights.low, at(x, y));
      heights.high = std::max(heights.high, at(x, y));
    }
  }
  return heights;
}

/// The search for the nearest point of the ground.
struct HeightField::Nearest {
  const HeightField& field;
  Vec3 p;
  double least;  ///< smallest distance found so far

  /// Returns a lower bound of the distance from p to the ground in a block of a layer.
  [[nodiscard]] double bound(std::size_t layer, Cell block) const {
    const double size = std::ldexp(1.0, static_cast<int>(layer));
    const Vec2 low =
        field.origin_ + Vec2{block.x * size * field.spacing_m_.x, block.y * size * field.spacing_m_.y};
    const Vec2 high = low + size * field.spacing_m_;
    const Layer& blocks = field.pyramid_[layer];
    const double top = blocks.highest_m[static_cast<std::size_t>(block.y * blocks.columns + block.x)];
    return norm(Vec3{std::max({low.x - p.x, p.x - high.x, 0.0}), std::max({low.y - p.y, p.y - high.y, 0.0}),
                     std::max(p.z - top, 0.0)});
  }

  void look_at(Cell c) {
    const Vec3 low = field.post(c.x, c.y);
    const Vec3 high = field.post(c.x + 1, c.y + 1);
    least = std::min({least, distance_to_triangle(p, {low, field.post(c.x + 1, c.y), high}),
                      distance_to_triangle(p, {low, high, field.post(c.x, c.y + 1)})});
  }

  void look_into(std::size_t layer, Cell block) {
    if (layer == 0) return look_at(block);
    const Layer& fine = field.pyramid_[layer - 1];
    std::array<std::pair<double, Cell>, 4> parts;
    std::size_t count = 0;
    for (int i = 0; i < 4; ++i) {
      const Cell cell{2 * block.x + i % 2, 2 * block.y + i / 2};
      if (cell.x >= fine.columns || cell.y >= fine.rows) continue;
      const std::pair part{bound(layer - 1, cell), cell};
      std::size_t k = count++;  // sorts by bound, the nearest first
      for (; k > 0 && parts[k - 1].first > part.first; --k) parts[k] = parts[k - 1];
      parts[k] = part;
    }
    for (std::size_t i = 0; i < count && parts[i].first < least; ++i) look_into(layer - 1, parts[i].second);
  }
};

double HeightField::distance(Vec3 p) const {
  const Box2 box = bounds();
  const Vec2 beside{std::clamp(p.x, box.low.x, box.high.x), std::clamp(p.y, box.low.y, box.high.y)};
  const double away = norm(xy(p) - beside);
  const double above = p.z - height(beside);
  if (above <= 0.0) return away;  // below the surface, or beside its edge
  Nearest nearest{*this, p, std::hypot(away, above)};
  nearest.look_into(pyramid_.size() - 1, {0, 0});
  return nearest.least;
}

std::vector<Vec3> HeightField::drape(Segment s) const {
  const Vec2 whole = s.b - s.a;
  const auto scaled = [this](Vec2 v) { return Vec2{v.x / spacing_m_.x, v.y / spacing_m_.y}; };
  const Vec2 from = scaled(s.a - origin_);
  const Vec2 by = scaled(whole);
  std::vector<double> parts{0.0, 1.0};
  // The sides of the triangles lie where x, y or x - y is an integer. There are no sides outside the lattice.
  const auto cross_sides = [&](double begin, double step, int low, int high) {
    if (step == 0.0) return;
    const double least = std::max(std::min(begin, begin + step), static_cast<double>(low));
    const double most = std::min(std::max(begin, begin + step), static_cast<double>(high));
    for (double side = std::ceil(least); side <= most; side += 1.0) {
      const double part = (side - begin) / step;
      if (part > 0.0 && part < 1.0) parts.push_back(part);
    }
  };
  cross_sides(from.x, by.x, 0, columns_ - 1);
  cross_sides(from.y, by.y, 0, rows_ - 1);
  cross_sides(from.x - from.y, by.x - by.y, 1 - rows_, columns_ - 1);
  std::ranges::sort(parts);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && parts[i] == parts[i - 1]) continue;
    const Vec2 p = parts[i] == 1.0 ? s.b : s.a + parts[i] * whole;
    points.push_back({p.x, p.y, height(p)});
  }
  return points;
}

double HeightField::length(Segment s) const {
  const auto points = drape(s);
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += norm(points[i] - points[i - 1]);
  return std::max(sum, outrider::distance(s.a, s.b));
}

Vec2 HeightField::walked(Segment s, double way_m) const {
  const auto points = drape(s);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double part = norm(points[i] - points[i - 1]);
    if (way_m < part) return xy(points[i - 1]) + way_m / part * (xy(points[i]) - xy(points[i - 1]));
    way_m -= part;
  }
  return s.b;
}

}  // namespace outrider
