#include "scan/scan_match.hpp"

#include <algorithm>
#include <numbers>

namespace outrider {
namespace {

constexpr double recognised_share = 0.7;
constexpr double most_rival = 0.85;  // maximum score at another place, relative to the best
constexpr Separation distinct{0.8, 0.7};

constexpr std::size_t telling_points = 60;  // with fewer, a scan does not tell places apart
constexpr double least_share = 0.25, sure_share = 0.5, certain_share = 0.9, better_share = 0.1;
// of one scan whose pose the odometry does not suggest: two rooms are often alike in most of what it shows
constexpr double alone_share = 0.85, most_contradiction_alone = 0.05;
// share of the points that another scan looked through; where a pose is right, it is seldom more
constexpr double most_at_right_pose = 0.1;

Eigen::Matrix3d information_of(const MatchWindow& window) {
  const double p = 1.0 / (window.position_sd_m * window.position_sd_m);
  return Eigen::Vector3d(p, p, 1.0 / (window.heading_sd_rad * window.heading_sd_rad)).asDiagonal();
}

/// Returns the window, enlarged to at least this size.
MatchWindow widened(MatchWindow window, double reach_m, double turn_rad) {
  window.reach_m = std::max(window.reach_m, reach_m);
  window.turn_rad = std::max(window.turn_rad, turn_rad);
  return window;
}

/// Returns false if another scan looked through too many points. The fewer points match, the fewer may be.
bool believed(const Fit& fit, const std::function<double(const Pose2&)>& contradiction) {
  constexpr double most_if_sure = 0.25;
  return fit.share >= certain_share ||
         contradiction(fit.pose) <= (fit.share >= sure_share ? most_if_sure : most_at_right_pose);
}

}  // namespace

MatchWindow odometry_window(const Pose2& pose, const Driven& since_match, const LaserSlamOptions& options) {
  constexpr double sds = 3.0;
  constexpr MotionNoise least{0.05, 0.02};
  const MotionNoise noise = odometry_noise(since_match, options);
  return {pose, std::max(least.position_m, sds * noise.position_m),
          std::max(least.heading_rad, sds * noise.heading_rad), noise.position_m, noise.heading_rad};
}

std::optional<Fit> recognise_place(const SurfaceMap& map, const Surface& surface, const MatchWindow& window,
                                   double least_score) {
  const auto found = map.find(surface, window, least_score);
  if (!found) return std::nullopt;
  if (map.may_be_elsewhere(surface, window, most_rival * found->score, found->pose, distinct))
    return std::nullopt;
  constexpr double loose = 100.0;  // 1/m^2: a standard deviation of ten centimetres
  const Fit fit = map.refine(surface, found->pose, {found->pose, loose * Eigen::Matrix3d::Identity()});
  return fit.share >= recognised_share ? std::optional(fit) : std::nullopt;
}

std::optional<Fit> match_nearby(const SurfaceMap& map, const Surface& surface, const MatchWindow& window,
                                const std::function<double(const Pose2&)>& contradiction) {
  constexpr double narrow_score = 0.1, wide_score = 0.3;
  constexpr double wide_m = 0.6, wide_rad = 0.6;
  const bool telling = surface.size() >= telling_points;
  const Eigen::Matrix3d information = information_of(window);
  Fit best;
  const auto take = [&](const Fit& fit, double better) {
    if (fit.share > best.share + better && believed(fit, contradiction)) best = fit;
    return best.share >= sure_share || !telling;
  };
  const auto found = [&] { return best.share >= least_share ? std::optional(best) : std::nullopt; };
  if (const auto pose = map.find(surface, window, narrow_score)) {
    if (take(map.refine(surface, pose->pose, {window.centre, information}), 0.0)) return found();
  }
  if (!telling) return std::nullopt;
  if (const auto pose = map.find(surface, widened(window, wide_m, wide_rad), wide_score))
    take(map.refine(surface, pose->pose, {pose->pose, information}), better_share);
  return found();
}

std::optional<Fit> match_scan(const SurfaceMap& map, const Surface& surface, const MatchWindow& window,
                              const std::function<double(const Pose2&)>& contradiction, BackOff& wide) {
  constexpr double widest_m = 4.0;
  const bool is_wide = window.reach_m > most_correction_m;
  if (!is_wide) {
    if (auto fit = match_nearby(map, surface, window, contradiction)) return fit;
    if (contradiction(window.centre) <= most_at_right_pose) return std::nullopt;
  }
  if (surface.size() < telling_points || !wide.take_occasion()) return std::nullopt;
  const auto fit = recognise_place(map, surface,
                                   is_wide ? window : MatchWindow{window.centre, widest_m, std::numbers::pi});
  const bool found = fit && fit->share >= alone_share && contradiction(fit->pose) <= most_contradiction_alone;
  wide.note(found);
  return found ? fit : std::nullopt;
}

}  // namespace outrider
