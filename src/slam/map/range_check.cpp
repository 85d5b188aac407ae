#include "outrider/slam/map/range_check.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "scan/scan_agreement.hpp"
#include "scan/surface.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_range_points = 180;
constexpr double most_off_m = 0.3;             // of two points of one wall
constexpr double least_facing = 0.97;          // product of their normals
constexpr double lone_off_m = 0.3;             // off both neighbours
constexpr std::size_t least_point_pairs = 30;  // of two scans
constexpr std::size_t least_votes = 10;        // of pairs of scans, before a bias is told

/// The equations of one pair of scans: the three unknowns of its pose, and the bias.
struct PairEquations {
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  std::size_t points = 0;
};

/// The vote of a pair for the bias, whatever the error of its pose is.
struct BiasVote {
  double information = 0.0;
  double bias_m = 0.0;
};

/// The nearest point of a wall that faces the same way.
const SurfacePoint* partner_of(const SurfacePoint& point, const Surface& surface) {
  const SurfacePoint* nearest = nullptr;
  double nearest_m = most_off_m;
  for (const SurfacePoint& other : surface) {
    const double away_m = distance(point.position, other.position);
    if (away_m >= nearest_m || dot(point.normal, other.normal) < least_facing) continue;
    nearest_m = away_m;
    nearest = &other;
  }
  return nearest;
}

/// Returns by how much a point moves along a normal when all ranges grow by 1 m. The point and the normal are
/// in one frame, in which the laser stands at `laser`.
double outward(Vec2 point, Vec2 normal, Vec2 laser) {
  const Vec2 beam = point - laser;
  return dot(beam, normal) / norm(beam);
}

PairEquations equations_of(const Surface& of, const Pose2& by_T_of, const Surface& by) {
  PairEquations sum;
  for (const SurfacePoint& there : of) {
    const SurfacePoint point{by_T_of * there.position, rotated(by_T_of.heading_rad, there.normal)};
    const SurfacePoint* const on = partner_of(point, by);
    if (on == nullptr) continue;
    const Vec2 n = on->normal;
    const double off_m = dot(point.position - on->position, n);
    const double grows =
        outward(point.position, n, by_T_of.position) - outward(on->position, n, Vec2{0.0, 0.0});
    const Eigen::Vector4d row(n.x, n.y, cross(point.position, n), grows);
    sum.hessian += row * row.transpose();
    sum.gradient += row * off_m;
    ++sum.points;
  }
  return sum;
}

/// Eliminates the pose (Schur complement).
std::optional<BiasVote> vote_of(const PairEquations& pair) {
  if (pair.points < least_point_pairs) return std::nullopt;
  const Eigen::Matrix3d pose = pair.hessian.topLeftCorner<3, 3>() + 1e-3 * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d joint = pair.hessian.topRightCorner<3, 1>();
  const Eigen::Vector3d by_pose = pose.ldlt().solve(joint);
  const double information = pair.hessian(3, 3) - joint.dot(by_pose);
  if (!(information > 1e-9)) return std::nullopt;
  return BiasVote{information, (pair.gradient(3) - by_pose.dot(pair.gradient.head<3>())) / information};
}

void settle_bias(const std::vector<BiasVote>& votes, RangeCheck& check) {
  double information = 0.0, sum = 0.0, squares = 0.0;
  for (const BiasVote& vote : votes) {
    information += vote.information;
    sum += vote.information * vote.bias_m;
  }
  if (votes.size() < least_votes) return;
  check.bias_m = sum / information;
  for (const BiasVote& vote : votes) squares += vote.information * std::pow(vote.bias_m - check.bias_m, 2);
  check.bias_sd_m = std::sqrt(squares / (information * static_cast<double>(votes.size() - 1)));
}

/// Returns the scan with those readings only that neither neighbour is near to.
LaserScan lone_readings(const LaserScan& scan) {
  LaserScan lone = scan;
  const std::size_t count = scan.ranges_m.size();
  const auto differs = [&](std::size_t a, std::size_t b) {
    return !(std::abs(scan.ranges_m[a] - scan.ranges_m[b]) <= lone_off_m);
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (!differs(i, (i + 1) % count) || !differs(i, (i + count - 1) % count))
      lone.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return lone;
}

/// Returns a scan of the places on a surface through which a single beam leads, though the beams to both of
/// its sides end there.
LaserScan passed_surfaces(const LaserScan& scan) {
  LaserScan passed = scan;
  std::ranges::fill(passed.ranges_m, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 1; i + 1 < scan.ranges_m.size(); ++i) {
    const float before_m = scan.ranges_m[i - 1], after_m = scan.ranges_m[i + 1];
    const bool is_surface = std::abs(before_m - after_m) <= lone_off_m;
    const bool is_passed =
        scan.ranges_m[i] <= scan.most_m && scan.ranges_m[i] > std::max(before_m, after_m) + lone_off_m;
    if (is_surface && is_passed) passed.ranges_m[i] = 0.5F * (before_m + after_m);
  }
  return passed;
}

/// Returns how many single beams end behind a surface that the other scan shows, at nothing that it shows.
std::size_t beams_too_long(const PlacedScan& of, const PlacedScan& by) {
  const LaserScan passed = passed_surfaces(*of.scan);
  LaserScan ends = *of.scan;
  for (std::size_t i = 0; i < ends.ranges_m.size(); ++i) {
    if (std::isnan(passed.ranges_m[i])) ends.ranges_m[i] = passed.ranges_m[i];
  }
  const auto shown = [&](const LaserScan& points) {
    return agreement(points, of.world_T_laser, *by.scan, by.world_T_laser).agreeing;
  };
  const std::size_t too_long = shown(passed);
  return too_long - std::min(too_long, shown(ends));
}

/// Asks the scan before and the one after about the readings of a scan.
void count_strays(std::span<const PlacedScan> scans, std::size_t i, RangeCheck& check) {
  const PlacedScan& of = scans[i];
  const LaserScan lone = lone_readings(*of.scan);
  for (const std::size_t k : {i - 1, i + 1}) {
    if (k >= scans.size()) continue;  // i - 1 of the first scan too
    const PlacedScan& by = scans[k];
    const std::size_t too_short = agreement(lone, of.world_T_laser, *by.scan, by.world_T_laser).seen_through;
    const std::size_t too_long = beams_too_long(of, by);
    check.readings += agreement(*of.scan, of.world_T_laser, *by.scan, by.world_T_laser).seen() + too_long;
    check.strays += too_short + too_long;
  }
}

}  // namespace

std::string why_not_believed(const RangeCheck& check) {
  constexpr double most_bias_m = 0.05, most_strays = 0.004;
  constexpr std::size_t least_readings = 1000;
  if (std::abs(check.bias_m) > most_bias_m + 3.0 * check.bias_sd_m) {
    return fmt::format(
        "walls differ by the place from which they are seen as if all ranges were {:.2f} m too {}",
        std::abs(check.bias_m), check.bias_m > 0.0 ? "long" : "short");
  }
  if (check.readings >= least_readings && check.stray_share() > most_strays) {
    return fmt::format("{:.1f} % of the readings stand alone, before or behind what other scans show",
                       100.0 * check.stray_share());
  }
  return {};
}

RangeCheck check_range_finder(std::span<const PlacedScan> scans, double reach_m) {
  std::vector<Surface> surfaces;
  for (const PlacedScan& placed : scans)
    surfaces.push_back(thinned(surface_of(*placed.scan, Pose2{}, reach_m), most_range_points));
  RangeCheck check;
  std::vector<BiasVote> votes;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (const std::size_t back : {1U, 4U}) {
      if (back > i) continue;
      const Pose2 by_T_of = relative_pose(scans[i - back].world_T_laser, scans[i].world_T_laser);
      if (const auto vote = vote_of(equations_of(surfaces[i], by_T_of, surfaces[i - back])))
        votes.push_back(*vote);
    }
  }
  for (std::size_t i = 0; i < scans.size(); ++i) count_strays(scans, i, check);
  settle_bias(votes, check);
  return check;
}

}  // namespace outrider
