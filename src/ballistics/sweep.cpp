#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "outrider/ballistics/blocker.hpp"

namespace outrider {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

/// Half-planes a x + b y >= c that bound the cone of places behind a hull, seen from the target.
struct Cone {
  bool everywhere = false;
  std::array<std::array<double, 3>, 3> sides{};

  /// Returns the interval of x in which a row of height y is inside the cone.
  [[nodiscard]] Interval row(double y) const {
    Interval x{-inf, inf};
    if (everywhere) return x;
    for (const auto& [a, b, c] : sides) {
      const double rest = c - b * y;
      if (a > 0.0) {
        x.low = std::max(x.low, rest / a);
      } else if (a < 0.0) {
        x.high = std::min(x.high, rest / a);
      } else if (rest > 0.0) {
        return {inf, -inf};
      }
    }
    return x;
  }
};

Cone cone_behind(const std::vector<Vec2>& hull, Vec2 eye) {
  Cone cone;
  bool inside = true;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 a = hull[i];
    inside = inside && cross(hull[(i + 1) % hull.size()] - a, eye - a) >= -1e-9;
  }
  if (inside) {
    cone.everywhere = true;
    return cone;
  }
  Vec2 right = hull.front() - eye;
  Vec2 left = right;
  for (const Vec2 corner : hull) {
    const Vec2 ray = corner - eye;
    if (cross(right, ray) < 0.0) right = ray;
    if (cross(left, ray) > 0.0) left = ray;
  }
  const Vec2 axis = 1.0 / norm(right) * right + 1.0 / norm(left) * left;
  double nearest = inf;
  for (const Vec2 corner : hull) nearest = std::min(nearest, dot(axis, corner - eye));
  // cross(right, p - eye) >= 0, cross(p - eye, left) >= 0, dot(axis, p - eye) >= nearest
  cone.sides = {{{-right.y, right.x, cross(right, eye)},
                 {left.y, -left.x, cross(eye, left)},
                 {axis.x, axis.y, nearest + dot(axis, eye)}}};
  return cone;
}

/// The cells of one row, first to last, for which a blocker may matter.
struct Span {
  int first;
  int last;
  const Blocker* blocker;
};

/// Returns the fractional column whose centre is at x, clamped to just outside the grid.
double column(const GridFrame& frame, double x) {
  return std::clamp((x - frame.origin.x) / frame.resolution_m - 0.5, -1.0, static_cast<double>(frame.width));
}

/// Returns the spans of a row inside the cones, in cells of the grid, sorted by their first cell.
std::vector<Span> spans_of_row(const std::vector<Blocker>& all, const std::vector<Cone>& cones, double y,
                               const GridFrame& frame) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Interval x = cones[i].row(y);
    if (x.low > x.high) continue;
    // One cell more on each side, so that rounding never hides a blocker.
    spans.push_back({static_cast<int>(std::floor(column(frame, x.low))) - 1,
                     static_cast<int>(std::ceil(column(frame, x.high))) + 1, &all[i]});
  }
  std::stable_sort(spans.begin(), spans.end(),
                   [](const Span& a, const Span& b) { return a.first < b.first; });
  return spans;
}

/// Moves along a row from cell to cell and keeps the list of blockers whose span contains the present cell.
class RowSweep {
 public:
  explicit RowSweep(std::vector<Span> spans) : spans_(std::move(spans)) {}

  /// Returns the blockers at column x; x must increase from call to call.
  const std::vector<const Blocker*>& at(int x) {
    bool changed = std::erase_if(active_, [x](const Span& span) { return span.last < x; }) > 0;
    for (; next_ < spans_.size() && spans_[next_].first <= x; ++next_) {
      if (spans_[next_].last < x) continue;
      active_.push_back(spans_[next_]);
      changed = true;
    }
    if (changed) {
      near_.clear();
      for (const Span& span : active_) near_.push_back(span.blocker);
    }
    return near_;
  }

 private:
  std::vector<Span> spans_;
  std::size_t next_ = 0;
  std::vector<Span> active_;
  std::vector<const Blocker*> near_;
};

}  // namespace

void sweep(const std::vector<Blocker>& all, Vec2 centre, double reach_m, double spare_m,
           const GridFrame& frame, const std::vector<std::uint8_t>& standable,
           const std::function<bool(std::size_t, const std::vector<const Blocker*>&)>& visit) {
  std::vector<Cone> cones;
  for (const Blocker& blocker : all) {
    const auto& hull = blocker.hull;
    cones.push_back(hull.empty()     ? Cone{true, {}}
                    : spare_m == 0.0 ? cone_behind(hull, centre)
                                     : cone_behind(circumscribed({hull, spare_m}, radians(91.0)), centre));
  }
  for (int row = 0; row < frame.height; ++row) {
    const double y = frame.centre({0, row}).y;
    const double chord2 = reach_m * reach_m - (y - centre.y) * (y - centre.y);
    if (chord2 < 0.0) continue;
    const double chord = std::sqrt(chord2);
    RowSweep along(spans_of_row(all, cones, y, frame));
    const int last = std::min(frame.width - 1, static_cast<int>(std::floor(column(frame, centre.x + chord))));
    for (int x = std::max(0, static_cast<int>(std::ceil(column(frame, centre.x - chord)))); x <= last; ++x) {
      const auto& near = along.at(x);
      const std::size_t cell = frame.index({x, row});
      if (standable[cell] != 0 && !visit(cell, near)) return;
    }
  }
}

}  // namespace outrider
