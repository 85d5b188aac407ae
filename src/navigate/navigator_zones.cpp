// The parts of the navigator that keep to zones.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/navigate/navigator.hpp"

namespace outrider {
namespace {

constexpr double leaving_mps = 0.2;
constexpr double aligned_rad = 0.15;   // within which it goes straight
constexpr double step_m = 0.05;        // along a way out
constexpr double nearer_m = 0.02;      // by which it has to come nearer to its way out
constexpr double patience_part = 5.0;  // of its patience, after which it gives up

}  // namespace

/// Returns the distance up to which zones matter to planners.
double Navigator::room_of_zones_m() const {
  return setup_.footprint.outer_m() + setup_.motion.margin_m + setup_.motion.wide_m;
}

/// Returns the zones in the window; null if there are none, or as long as the robot does not know where it
/// is.
const ZoneCells* Navigator::zones_on_window() {
  if (zones_.empty() || !localiser_->is_located()) return nullptr;
  if (zones_frame_ != map_.frame()) {
    zones_frame_ = map_.frame();
    zone_cells_ = zones_.cells(zones_frame_, room_of_zones_m());
  }
  return &zone_cells_;
}

/// Finds how fast the robot may be here, and whether it was carried into a keep-out zone.
void Navigator::follow_zones() {
  limits_ = setup_.robot;
  if (zones_.empty() || !localiser_->is_located()) return;
  const Pose2 here = pose();
  limits_.speed_mps =
      zones_.most_mps(here.position, setup_.footprint.outer_m(), setup_.robot, setup_.options.period_s);
  const bool was_in_zone = in_zone_;
  in_zone_ = zones_.overlap(setup_.footprint, here);
  if (in_zone_ == was_in_zone) return;
  exit_.reset();
  left_.nearer_s = now_s();
  left_.least_s = std::numeric_limits<double>::infinity();
  planned_.window_s.reset();
}

/// Returns the nearest place outside keep-out zones to which a straight way leads past what is marked.
std::optional<Vec2> Navigator::way_out(Vec2 here) const {
  const GridFrame& frame = zones_frame_;
  const double room_m = setup_.footprint.outer_m() + setup_.motion.margin_m;
  const double beside_m = setup_.footprint.inner_m() + setup_.motion.margin_m;
  const auto is_clear = [&](Vec2 to) {
    const double away_m = distance(here, to);
    for (double gone_m = 0.0; gone_m < away_m; gone_m += step_m) {
      if (near_.clearance(here + (gone_m / away_m) * (to - here)) < beside_m) return false;
    }
    return true;
  };
  std::vector<std::pair<double, std::size_t>> places;  // squared distance, cell
  for (std::size_t i = 0; i < zone_cells_.room_m.size(); ++i) {
    if (static_cast<double>(zone_cells_.room_m[i]) >= room_m)
      places.emplace_back(squared_norm(frame.centre(frame.cell(i)) - here), i);
  }
  std::ranges::sort(places);
  for (const auto& [away, cell] : places) {
    if (is_clear(frame.centre(frame.cell(cell)))) return frame.centre(frame.cell(cell));
  }
  return std::nullopt;
}

/// Returns the next twist straight out of a keep-out zone, ahead or backwards.
Twist2 Navigator::leave_zone(const MotionState& state) {
  const Vec2 here = state.pose.position;
  if (!exit_ && (exit_ = way_out(here))) left_.least_s = distance(here, *exit_);
  if (exit_ && distance(here, *exit_) < left_.least_s - nearer_m) {
    left_.least_s = distance(here, *exit_);
    left_.nearer_s = now_s();
  }
  if (now_s() - left_.nearer_s > patience_part * setup_.options.patience_s) {
    progress_ = {
        Progress::State::blocked,
        {},
        fmt::format("it stands in a keep-out zone at ({:.2f}, {:.2f}), with no way straight out of it",
                    here.x, here.y)};
  }
  if (!exit_ || progress_.state != Progress::State::underway) return {};
  double off_rad = wrap_angle(heading_of(*exit_ - here) - state.pose.heading_rad);
  const bool backwards = std::abs(off_rad) > 0.5 * pi;
  if (backwards) off_rad = wrap_angle(off_rad + pi);
  Twist2 twist{0.0, 0.0,
               std::clamp(2.0 * off_rad, -state.robot.turn_rate_radps, state.robot.turn_rate_radps)};
  if (std::abs(off_rad) < aligned_rad || state.robot.steers())
    twist.ahead_mps = (backwards ? -1.0 : 1.0) * std::min(leaving_mps, state.robot.speed_mps);
  twist = drivable(twist, state.robot);
  if (can_brake(state, twist, setup_.motion.margin_m)) return twist;
  exit_.reset();  // what stands there now is gone around
  return {};
}

}  // namespace outrider
