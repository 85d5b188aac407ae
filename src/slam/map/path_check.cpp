#include "map/path_check.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "scan/surface_map.hpp"

namespace outrider {
namespace {

constexpr double most_odometry_chi2 = 16.27;  // of 3 degrees of freedom: exceeded once in a thousand steps
constexpr double least_shared = 1.0 / 3.0;    // share of the points
constexpr double near_step_m = 0.5, near_step_rad = 0.4;  // a shorter step leaves most of the surface in view
constexpr double pause_s = 60.0;           // in which a robot may have been carried or driven anywhere
constexpr double least_shared_sure = 0.5;  // of a short step, and of one after a pause
constexpr double guess_sd_m = 0.5;   // of a step by odometry alone, which may lead to one of several places
constexpr double unsure_sd_m = 0.3;  // of one that may, unless the map agrees with it within that

/// Returns the squared error of a step by the map in standard deviations of the odometry.
double chi2_of(const Pose2& by_map, const Keyframe& key) {
  const double off_m = distance(by_map.position, key.odometry.position);
  const double off_rad = wrap_angle(by_map.heading_rad - key.odometry.heading_rad);
  const double position = off_m / key.odometry_noise.position_m;
  const double heading = off_rad / key.odometry_noise.heading_rad;
  return position * position + heading * heading;
}

/// Returns true if a step is long and odometry too uncertain to tell places apart: several that look alike
/// may lie within its error, and the scans would fit each of them.
bool is_guess(const Pose2& by_map, const Keyframe& key, double shared) {
  const double sd_m = key.odometry_noise.position_m;
  const bool is_off = distance(by_map.position, key.odometry.position) > sd_m;
  return (sd_m > unsure_sd_m && is_off) || (sd_m > guess_sd_m && shared < least_shared_sure);
}

/// Returns true if the scans of two keyframes fit each other best at another pose than that of the map:
/// between what odometry and what the scans say, a map can be wrong although most surfaces still lie near
/// each other.
bool fits_elsewhere(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t a,
                    std::uint32_t b) {
  constexpr double off_m = 0.1, off_rad = 0.05;
  constexpr double held = 10.0;  // 1/m^2, 1/rad^2: holds the pose where the scans do not say
  const Pose2 by_map = relative_pose(graph.keyframes[a].pose, graph.keyframes[b].pose);
  const SurfaceMap::Part part{&surfaces.of(graph, a), {}};
  const SurfaceMap map({&part, 1}, 1);  // it is not searched, so it needs no pyramid
  const Fit fit = map.refine(surfaces.of(graph, b), by_map, {by_map, held * Eigen::Matrix3d::Identity()});
  return distance(fit.pose.position, by_map.position) > off_m ||
         std::abs(wrap_angle(fit.pose.heading_rad - by_map.heading_rad)) > off_rad;
}

}  // namespace

double share_on(const Surface& a, const Pose2& b_T_a, const Surface& b) {
  constexpr double close_m = 0.15;
  constexpr double least_cosine = 0.5;  // cosine between normals of one surface
  Surface sorted;
  std::ranges::copy_if(b, std::back_inserter(sorted),
                       [](const SurfacePoint& p) { return p.normal != Vec2{}; });
  const auto x_of = [](const SurfacePoint& p) { return p.position.x; };
  std::ranges::stable_sort(sorted, {}, x_of);
  std::size_t counted = 0, on = 0;
  for (const SurfacePoint& p : a) {
    if (p.normal == Vec2{}) continue;
    ++counted;
    const Vec2 place = b_T_a * p.position, normal = rotated(b_T_a.heading_rad, p.normal);
    const auto first = std::ranges::lower_bound(sorted, place.x - close_m, {}, x_of);
    const auto end = std::ranges::upper_bound(sorted, place.x + close_m, {}, x_of);
    const bool is_on = std::any_of(first, end, [&](const SurfacePoint& q) {
      return distance(q.position, place) <= close_m && dot(q.normal, normal) >= least_cosine;
    });
    on += is_on ? 1 : 0;
  }
  return counted == 0 ? 0.0 : static_cast<double>(on) / static_cast<double>(counted);
}

double shared_surface(const KeyframeGraph& graph, KeyframeSurfaces& surfaces, std::uint32_t a,
                      std::uint32_t b) {
  const Pose2 a_T_b = relative_pose(graph.keyframes[a].pose, graph.keyframes[b].pose);
  const Surface &of_a = surfaces.of(graph, a), &of_b = surfaces.of(graph, b);
  return std::max(share_on(of_b, a_T_b, of_a), share_on(of_a, relative_pose(a_T_b, {}), of_b));
}

std::vector<Jump> find_jumps(const KeyframeGraph& graph, KeyframeSurfaces& surfaces) {
  std::vector<Jump> jumps;
  for (std::uint32_t i = 1; i < graph.keyframes.size(); ++i) {
    const Keyframe &before = graph.keyframes[i - 1], &key = graph.keyframes[i];
    const Pose2 by_map = wrap_heading(relative_pose(before.pose, key.pose));
    const bool is_near = norm(by_map.position) < near_step_m && std::abs(by_map.heading_rad) < near_step_rad;
    const bool differs = key.shared_before < least_shared_sure;
    const bool is_after_pause = differs && key.pause_s >= pause_s;
    const bool odometry_differs = chi2_of(by_map, key) > most_odometry_chi2;
    const bool may_be_guess = key.odometry_noise.position_m > unsure_sd_m;
    if (!(is_near && differs) && !is_after_pause && !odometry_differs && !may_be_guess) continue;
    const bool is_measured = !(is_near && differs) && before.has_scan() && key.has_scan();
    const double shared = is_measured ? shared_surface(graph, surfaces, i - 1, i) : key.shared_before;
    const bool is_confirmed =
        shared >= least_shared && !(is_measured && fits_elsewhere(graph, surfaces, i - 1, i));
    const bool is_jump = (is_near && differs) || (odometry_differs && !is_confirmed);
    const bool is_unconfirmed = is_guess(by_map, key, shared);
    if (!is_jump && !is_after_pause && !is_unconfirmed) continue;
    jumps.push_back({i - 1, i, by_map, key.odometry, shared, is_jump || is_unconfirmed ? 0.0 : key.pause_s,
                     is_unconfirmed && !is_jump ? key.odometry_noise.position_m : 0.0});
  }
  return jumps;
}

}  // namespace outrider
