#include "outrider/ballistics/air.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/bisect.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double first_step_s = 0.01;
constexpr double longest_step_s = 10.0;
constexpr std::size_t pieces_a_block = 6;
constexpr int halvings = 60;

bool overlap(const Box3& a, const Box3& b) {
  return a.ground().overlaps(b.ground()) && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// A step of the velocity u through the air: the cubic with the values and the slopes at both ends.
struct Step {
  double length_s;
  Vec3 u0, a0, u1, a1;

  /// The slope is a quadratic; this is its middle control point, so it stays in the hull of a0, this and a1.
  [[nodiscard]] Vec3 middle_slope() const { return 3.0 / length_s * (u1 - u0) - a0 - a1; }
  [[nodiscard]] Vec3 jerk() const { return 2.0 / length_s * (middle_slope() - a0); }
  [[nodiscard]] Vec3 snap() const { return 2.0 / (length_s * length_s) * (a0 - 2.0 * middle_slope() + a1); }
  [[nodiscard]] double most_slope() const { return std::max({norm(a0), norm(middle_slope()), norm(a1)}); }
};

Step step_from(const Air& air, double gravity, Vec3 u, Vec3 a, double h) {
  const auto f = [&](Vec3 at) { return air.acceleration(at, gravity); };
  const Vec3 k2 = f(u + 0.5 * h * a);
  const Vec3 k3 = f(u + 0.5 * h * k2);
  const Vec3 k4 = f(u + h * k3);
  const Vec3 u1 = u + h / 6.0 * (a + 2.0 * k2 + 2.0 * k3 + k4);  // Runge and Kutta's
  return {h, u, a, u1, f(u1)};
}

/// Returns an upper bound of |u' - f(u)| in the step. With the law N(u) = -c |u| u, |DN| <= 2 c |u|, |D^2 N|
/// <= 2 c and |D^3 N| <= 3 c / |u|. At both ends u' is exact. The quadratic that is also exact in the middle
/// differs from u' by the difference observed there, and from f(u) by at most h^3 sqrt(3) / 216 |f(u)'''|, or
/// h^2 / 4 |f(u)''| if the ball may stand still in the air.
double defect_bound(const Air& air, double gravity, const Step& step) {
  const double h = step.length_s;
  const double slope = step.most_slope();
  const double jerk =
      2.0 / h * std::max(norm(step.middle_slope() - step.a0), norm(step.a1 - step.middle_slope()));
  const double most = std::max(
      {norm(step.u0), norm(step.u0 + h / 3.0 * step.a0), norm(step.u1 - h / 3.0 * step.a1), norm(step.u1)});
  const Vec3 middle = 0.5 * (step.u0 + step.u1) + h / 8.0 * (step.a0 - step.a1);
  const Vec3 middle_slope = 0.25 * (step.a0 + 2.0 * step.middle_slope() + step.a1);
  const double seen = norm(middle_slope - air.acceleration(middle, gravity));

  const double c = air.drag_per_m;
  double between = 0.25 * h * h * c * (2.0 * slope * slope + 2.0 * most * jerk);
  const double least = norm(middle) - 0.5 * h * slope;
  if (least > 0.0) {
    const double third =
        c * (3.0 * slope * slope * slope / least + 6.0 * slope * jerk + 2.0 * most * norm(step.snap()));
    between = std::min(between, std::sqrt(3.0) / 216.0 * h * h * h * third);
  }
  return seen + between;
}

}  // namespace

Vec3 Air::wind() const {
  const Vec2 wind = wind_mps * direction(wind_towards_rad);
  return {wind.x, wind.y, 0.0};
}

Vec3 Air::acceleration(Vec3 u, double gravity_mps2) const {
  const double k = -drag_per_m * norm(u);
  return {k * u.x, k * u.y, k * u.z - gravity_mps2};
}

std::vector<Option> describe(Air& air) {
  return {
      {"drag", "1/m", 0.0, 1.0,
       "deceleration of the ball over the square of its speed through the air; 0: no air", &air.drag_per_m},
      {"wind", "m/s", 0.0, 1e3, "speed of the wind, below the muzzle speed", &air.wind_mps},
      {"wind_towards", "deg", -360.0, 360.0, "where the wind blows to, counter-clockwise from +x",
       &air.wind_towards_rad},
  };
}

Vec3 AirTrack::Piece::position_after(double s) const {
  return position + s * (velocity + 0.5 * s * (acceleration + s / 3.0 * (jerk + 0.25 * s * snap)));
}

Vec3 AirTrack::Piece::velocity_after(double s) const {
  return velocity + s * (acceleration + 0.5 * s * (jerk + s / 3.0 * snap));
}

AirTrack::AirTrack(const Air& air, Vec3 muzzle, Vec3 velocity_mps, double gravity_mps2, double lowest_z_m,
                   double accuracy) {
  const Vec3 wind = air.wind();
  Vec3 u = velocity_mps - wind;
  Vec3 a = air.acceleration(u, gravity_mps2);
  defect_mps2_ = accuracy * (gravity_mps2 + air.drag_per_m * squared_norm(u));
  most_acceleration_ = norm(a);
  double time = 0.0;
  double h = first_step_s;
  Vec3 p = muzzle;
  while (p.z >= lowest_z_m || u.z > 0.0) {
    const Step step = step_from(air, gravity_mps2, u, a, h);
    const double bound = defect_bound(air, gravity_mps2, step);
    const double better = 0.9 * std::cbrt(defect_mps2_ / bound);  // of h, as the bound grows with h^3
    if (bound > defect_mps2_) {
      h *= std::clamp(better, 0.1, 0.8);
      continue;
    }
    pieces_.push_back({time, p, u + wind, a, step.jerk(), step.snap()});
    p = pieces_.back().position_after(h);
    time += h;
    most_acceleration_ = std::max(most_acceleration_, step.most_slope());
    u = step.u1;
    a = step.a1;
    h = std::min(longest_step_s, h * std::clamp(better, 0.5, 2.0));
  }
  pieces_.push_back({time, p, u + wind, {}, {}, {}});
  wrap();
}

/// Between two states h apart, a path differs from the chord by at most (most acceleration) h^2 / 8.
void AirTrack::wrap() {
  for (std::size_t first = 0; first + 1 < pieces_.size(); first += pieces_a_block) {
    const std::size_t last = std::min(first + pieces_a_block, pieces_.size() - 1);
    Block block{pieces_[last].start_s, {}};
    double longest = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
      block.box.include(pieces_[i].position);
      if (i > first) longest = std::max(longest, pieces_[i].start_s - pieces_[i - 1].start_s);
    }
    const double off = most_acceleration_ * longest * longest / 8.0;
    block.box = {block.box.low - Vec3{off, off, off}, block.box.high + Vec3{off, off, off}};
    blocks_.push_back(block);
  }
}

const AirTrack::Piece& AirTrack::at(double time_s) const {
  const auto next = std::upper_bound(pieces_.begin() + 1, pieces_.end(), time_s,
                                     [](double t, const Piece& piece) { return t < piece.start_s; });
  return *(next - 1);
}

Vec3 AirTrack::position(double time_s) const {
  const Piece& piece = at(time_s);
  return piece.position_after(time_s - piece.start_s);
}

Vec3 AirTrack::velocity(double time_s) const {
  const Piece& piece = at(time_s);
  return piece.velocity_after(time_s - piece.start_s);
}

double AirTrack::top_s() const {
  // If it rises at all, it does so before it falls: at the top it is accelerated downwards.
  return last_while(0.0, end_s(), halvings, [this](double t) { return velocity(t).z > 0.0; });
}

double AirTrack::fall_time(double height_m) const {
  const Piece& end = pieces_.back();
  const double top = top_s();
  if (position(top).z < height_m) return 0.0;
  if (end.position.z > height_m) return end.start_s + (end.position.z - height_m) / -end.velocity.z;
  return last_while(top, end.start_s, halvings, [&](double t) { return position(t).z >= height_m; });
}

std::optional<std::pair<double, double>> AirTrack::passage(const Box3& box, double from_s,
                                                           double until_s) const {
  std::optional<std::pair<double, double>> found;
  double start = 0.0;
  for (const Block& block : blocks_) {
    const double low = std::max(from_s, start);
    const double high = std::min(until_s, block.end_s);
    start = block.end_s;
    if (low > high || !overlap(block.box, box)) continue;
    found = {found ? found->first : low, high};
  }
  if (until_s > start) found = {found ? found->first : std::max(from_s, start), until_s};  // straight on
  return found;
}

}  // namespace outrider
