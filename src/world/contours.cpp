#include "outrider/world/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace outrider {
namespace {

/// A side of a triangle, given by the indices of the posts at its ends, the smaller first.
using Side = std::pair<std::size_t, std::size_t>;

/// The contours at one height: the graph of the triangle sides that they connect.
class Lines {
 public:
  Lines(const HeightField& field, double height_m) : field_(field), height_m_(height_m) {
    for (int y = 0; y + 1 < field.rows(); ++y) {
      for (int x = 0; x + 1 < field.columns(); ++x) {
        cross({post(x, y), post(x + 1, y), post(x + 1, y + 1)});
        cross({post(x, y), post(x + 1, y + 1), post(x, y + 1)});
      }
    }
  }

  /// Extracts the lines from the graph: first the open ones, then the closed ones.
  std::vector<Contour> take() {
    std::vector<Contour> all;
    for (const bool closed : {false, true}) {
      for (auto& [side, next] : next_) {
        if (next.empty() || (!closed && next.size() == 2)) continue;
        all.push_back({height_m_, follow(side)});
      }
    }
    return all;
  }

 private:
  [[nodiscard]] std::size_t post(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(field_.columns()) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] Vec3 at(std::size_t post) const {
    const auto columns = static_cast<std::size_t>(field_.columns());
    return field_.post(static_cast<int>(post % columns), static_cast<int>(post / columns));
  }
  [[nodiscard]] bool above(std::size_t post) const { return at(post).z >= height_m_; }

  void cross(const std::array<std::size_t, 3>& corners) {
    std::vector<Side> crossed;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(corners[i], corners[(i + 1) % 3]);
      if (above(a) != above(b)) crossed.emplace_back(a, b);
    }
    if (crossed.size() != 2) return;
    next_[crossed[0]].push_back(crossed[1]);
    next_[crossed[1]].push_back(crossed[0]);
  }

  [[nodiscard]] Vec2 point(const Side& side) const {
    const Vec3 a = at(side.first);
    const Vec3 b = at(side.second);
    return xy(a + (height_m_ - a.z) / (b.z - a.z) * (b - a));
  }

  std::vector<Vec2> follow(Side side) {
    std::vector<Vec2> points{point(side)};
    while (!next_[side].empty()) {
      const Side to = next_[side].front();
      next_[side].erase(next_[side].begin());
      std::erase(next_[to], side);
      points.push_back(point(to));
      side = to;
    }
    return points;
  }

  const HeightField& field_;
  double height_m_;
  std::map<Side, std::vector<Side>> next_;
};

}  // namespace

std::vector<Contour> contours(const HeightField& field, double step_m) {
  std::vector<Contour> all;
  for (double k = std::floor(field.lowest_m() / step_m) + 1.0; k * step_m < field.highest_m(); k += 1.0) {
    for (Contour& line : Lines(field, k * step_m).take()) all.push_back(std::move(line));
  }
  return all;
}

double contour_step(const HeightField& field) {
  const double least = std::max(field.highest_m() - field.lowest_m(), 1e-3) / 12.0;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace outrider
