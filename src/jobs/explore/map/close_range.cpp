#include "outrider/jobs/explore/map/close_range.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "outrider/geometry/polyline.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_scans = 12;
constexpr std::size_t most_ends = 720;  ///< of a scan; more say no more about what is smoothed over near_m
constexpr double near_m = 0.025;        ///< neighbours of a point
constexpr double again_m = 0.02;        ///< when what was smoothed is smoothed again
constexpr double thin_m = 0.01;         ///< one point in a square of this side is kept
constexpr int least_neighbours = 4;
constexpr double step_m = 0.03;   ///< of the path
constexpr double aside_m = 0.12;  ///< by which a path is moved at most

using Bin = std::pair<int, int>;

Bin bin_of(Vec2 p, double side_m) {
  return {static_cast<int>(std::floor(p.x / side_m)), static_cast<int>(std::floor(p.y / side_m))};
}

/// Points sorted by squares of the side near_m.
class Binned {
 public:
  Binned(const std::vector<Vec2>& all, double within_m)
      : near_(all.size()), most_square_(within_m * within_m) {
    while (std::sqrt(most_square_) <= within_m) most_square_ = std::nextafter(most_square_, 1.0);
    while (std::sqrt(most_square_) > within_m) most_square_ = std::nextafter(most_square_, 0.0);
    std::vector<std::pair<Bin, Vec2>> sorted;
    sorted.reserve(all.size());
    for (const Vec2 p : all) sorted.emplace_back(bin_of(p, near_m), p);
    std::ranges::sort(sorted, [](const auto& a, const auto& b) {
      return std::tuple(a.first, a.second.x, a.second.y) < std::tuple(b.first, b.second.x, b.second.y);
    });
    for (const auto& [bin, p] : sorted) {
      bins_.push_back(bin);
      points_.push_back(p);
    }
  }

  /// Returns the offsets from p of the points within the distance of it.
  std::span<const Vec2> near(Vec2 p) {
    const Bin middle = bin_of(p, near_m);
    std::size_t count = 0;
    for (int x = middle.first - 1; x <= middle.first + 1; ++x) {
      const auto first = std::ranges::lower_bound(bins_, Bin{x, middle.second - 1});
      const auto last = std::upper_bound(first, bins_.end(), Bin{x, middle.second + 1});
      const std::span column(points_.data() + (first - bins_.begin()),
                             static_cast<std::size_t>(last - first));
      for (const Vec2 q : column) {
        const Vec2 offset = q - p;
        near_[count] = offset;
        if (squared_norm(offset) <= most_square_) ++count;
      }
    }
    return std::span(near_).first(count);
  }

 private:
  std::vector<Bin> bins_;     ///< of each point
  std::vector<Vec2> points_;  ///< sorted by bin
  std::vector<Vec2> near_;
  double most_square_;  ///< the largest number whose root is within the distance
};

/// The sums of points about a place.
struct Moments {
  int count = 0;
  Vec2 sum;
  double xx = 0.0, xy = 0.0, yy = 0.0;

  void add(Vec2 p) {
    ++count;
    sum = sum + p;
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
  }
};

/// A straight line fitted to points.
struct Line {
  Vec2 mean, along;
};

Line line_through(const Moments& m) {
  const double n = m.count;
  const Vec2 mean = 1.0 / n * m.sum;
  const double a = m.xx / n - mean.x * mean.x, b = m.xy / n - mean.x * mean.y, c = m.yy / n - mean.y * mean.y;
  return {mean, direction(0.5 * std::atan2(2.0 * b, a - c))};
}

/// The sums of a parabola that is fitted to heights over u.
struct Parabola {
  double count = 0.0, u1 = 0.0, u2 = 0.0, u3 = 0.0, u4 = 0.0;  // of the powers of u
  Eigen::Vector3d heights = Eigen::Vector3d::Zero();

  void add(double u, double height) {
    const double square = u * u;
    count += 1.0;
    u1 += u;
    u2 += square;
    u3 += u * square;
    u4 += square * square;
    heights.x() += height;
    heights.y() += height * u;
    heights.z() += height * square;
  }

  /// The height at 0 of the parabola that fits best. A straight line would round corners off by a centimetre,
  /// this does by a third of it.
  [[nodiscard]] double height_at_zero() const {
    constexpr double nothing = 1e-9;  // of the unit in which u is given, which is about the largest one
    Eigen::Matrix3d squares;
    squares << count + nothing, u1, u2, u1, u2 + nothing, u3, u2, u3, u4 + nothing;
    return squares.ldlt().solve(heights).x();
  }
};

/// Puts each point on the parabola through its neighbours, across the line through them; drops those that
/// have too few.
std::vector<Vec2> smoothed(const std::vector<Vec2>& points, double within_m) {
  Binned binned(points, within_m);
  std::vector<Vec2> smooth;
  for (const Vec2 p : points) {
    const std::span<const Vec2> near = binned.near(p);
    Moments moments;
    for (const Vec2 q : near) moments.add(q);
    if (moments.count < least_neighbours) continue;
    const Vec2 along = line_through(moments).along, across = perpendicular(along);
    Parabola parabola;
    for (const Vec2 q : near) parabola.add(dot(q, along) / within_m, dot(q, across));
    smooth.push_back(p + parabola.height_at_zero() * across);
  }
  return smooth;
}

/// The mean of the points in each square of the side thin_m.
std::vector<Vec2> thinned(const std::vector<Vec2>& points) {
  std::map<Bin, Moments> squares;
  for (const Vec2 p : points) squares[bin_of(p, thin_m)].add(p);
  std::vector<Vec2> thin;
  for (const auto& [bin, square] : squares) thin.push_back(1.0 / square.count * square.sum);
  return thin;
}

/// Returns the offset of a point along `aside`, m, with the most clearance; the smallest one that gives
/// `wanted_m`.
double best_offset(Vec2 point, Vec2 aside, const Nearby& surfaces, double wanted_m) {
  constexpr double dislike = 1e-3;  // of moving, so that it does not move for nothing
  double best = 0.0, most = -1.0;
  const auto try_at = [&](double offset) {
    const double room = std::min(surfaces.clearance(point + offset * aside), wanted_m);
    const double value = room - dislike * std::abs(offset);
    if (value <= most) return;
    most = value;
    best = offset;
  };
  for (int i = -12; i <= 12; ++i) try_at(aside_m / 12.0 * i);
  const double coarse = best;
  for (int i = -4; i <= 4; ++i) try_at(coarse + aside_m / 60.0 * i);
  return best;
}

/// Has the robot in the middle already a little before a narrow place: from there back, the offset is kept,
/// and taken back over `blend_m`.
void approach_straight(const std::vector<Vec2>& samples, std::vector<double>& offsets) {
  constexpr double blend_m = 0.4;
  double carried = 0.0;
  for (std::size_t i = samples.size(); i-- > 0;) {
    const double faded = std::max(0.0, std::abs(carried) - aside_m / blend_m * step_m);
    carried = std::copysign(faded, carried);
    if (offsets[i] == 0.0)
      offsets[i] = carried;
    else
      carried = offsets[i];
  }
}

}  // namespace

void CloseRange::add(const Pose2& odometry, std::vector<Vec2> ends) {
  std::erase_if(ends, [](Vec2 p) { return norm(p) > reach_m + 0.5; });
  if (const std::size_t every = (ends.size() + most_ends - 1) / most_ends; every > 1) {
    std::size_t number = 0;
    std::erase_if(ends, [&](Vec2) { return number++ % every != 0; });
  }
  scans_.push_back({odometry, std::move(ends)});
  if (scans_.size() > most_scans) scans_.pop_front();
}

std::vector<Vec2> CloseRange::surfaces(const Pose2& odometry, const Pose2& pose) const {
  std::vector<Vec2> points;
  for (const Ends& scan : scans_) {
    const Pose2 now_T_then = relative_pose(odometry, scan.odometry);
    for (const Vec2 end : scan.points) {
      const Vec2 here = now_T_then * end;
      if (norm(here) <= reach_m) points.push_back(pose * here);
    }
  }
  return thinned(smoothed(smoothed(points, near_m), again_m));
}

void GapLooks::add(const PathRoom& room) {
  constexpr double same_m = 0.5;
  constexpr int most_count = 8;
  if (count == 0 || distance(place, room.narrowest) > same_m) *this = {};
  ++count;
  place = room.narrowest;
  room_m += (room.least_m - room_m) / std::min(count, most_count);
}

std::vector<Vec2> points_ahead(const PathProgress& path, double ahead_m) {
  const double to_m = path.along_m + ahead_m;
  std::vector<Vec2> samples;
  double before = 0.0, next = path.along_m + step_m;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const double leg = distance(path.points[i - 1], path.points[i]);
    for (; next <= std::min(to_m, before + leg) && leg > 0.0; next += step_m)
      samples.push_back(path.points[i - 1] + ((next - before) / leg) * (path.points[i] - path.points[i - 1]));
    before += leg;
  }
  return samples;
}

PathRoom centre_path(PathProgress& path, Vec2 position, const Nearby& surfaces, double ahead_m,
                     double wanted_m) {
  const double to_m = std::min(path.along_m + ahead_m, length_of(path.points));
  const std::vector<Vec2> samples = points_ahead(path, ahead_m);
  std::vector<Vec2> aside;
  std::vector<double> offsets;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Vec2 along = samples[std::min(i + 1, samples.size() - 1)] - (i > 0 ? samples[i - 1] : position);
    aside.push_back(norm(along) > 0.0 ? 1.0 / norm(along) * Vec2{-along.y, along.x} : Vec2{});
    const bool roomy = surfaces.clearance(samples[i]) >= wanted_m;
    offsets.push_back(roomy ? 0.0 : best_offset(samples[i], aside[i], surfaces, wanted_m));
  }
  approach_straight(samples, offsets);
  constexpr double about_m = 0.005;
  PathRoom room{std::numeric_limits<double>::infinity(), position};
  std::vector<Vec2> points{position};
  double there_m = room.least_m;  // at room.narrowest
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double before = offsets[i > 0 ? i - 1 : i], after = offsets[std::min(i + 1, offsets.size() - 1)];
    points.push_back(samples[i] + (0.25 * before + 0.5 * offsets[i] + 0.25 * after) * aside[i]);
    const double here_m = surfaces.clearance(points.back());
    room.least_m = std::min(room.least_m, here_m);
    if (here_m >= there_m - about_m) continue;
    there_m = here_m;
    room.narrowest = points.back();
  }
  double before = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    before += distance(path.points[i - 1], path.points[i]);
    if (before > to_m) points.push_back(path.points[i]);
  }
  if (points.size() == 1) points.push_back(path.points.back());
  path = {std::move(points), 0.0};
  return room;
}

}  // namespace outrider
