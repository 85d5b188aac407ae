// Navigator: whatever it observes and is ordered, it goes on, and every command is one that a robot can
// follow.
//
// The first byte of an input chooses the rule of motion and the localiser. Periods follow: a byte for the
// time, one for the odometry, one for the scan, one for bumper and order, and the numbers that they ask for.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "fuzz_entry.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/world/occupancy.hpp"

namespace {

using namespace outrider;

constexpr int most_periods = 40;
constexpr std::size_t most_beams = 200;

/// Reads numbers from bytes; zeros after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  [[nodiscard]] bool empty() const { return size_ == 0; }
  std::uint8_t byte() {
    if (empty()) return 0;
    --size_;
    return *data_++;
  }
  /// Returns any double.
  double any() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  double small() { return (byte() - 128.0) / 32.0; }  // from -4 to 4
  double number(bool is_any) { return is_any ? any() : small(); }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

KnownMap room() {
  KnownMap map{Grid<std::uint8_t>(GridFrame{{-4.0, -3.0}, 0.1, 80, 60}, free_cell)};
  for (std::size_t i = 0; i < map.occupancy.cells.size(); ++i) {
    const Cell cell = map.occupancy.frame.cell(i);
    const bool wall = cell.x < 2 || cell.y < 2 || cell.x > 77 || cell.y > 57 || (cell.x == 50 && cell.y > 30);
    if (wall) map.occupancy.cells[i] = occupied_cell;
  }
  return map;
}

LaserScan scan_from(Bytes& bytes, std::uint8_t kind, double time_s) {
  LaserScan scan{time_s, 0.0, 0.1, 0.1, 6.0, {}};
  if ((kind & 2) != 0) scan.time_s = bytes.number((kind & 4) != 0);
  if ((kind & 8) != 0) {
    scan.first_rad = bytes.number((kind & 16) != 0);
    scan.step_rad = bytes.number((kind & 16) != 0);
    scan.least_m = bytes.number((kind & 16) != 0);
    scan.most_m = bytes.number((kind & 16) != 0);
  }
  scan.ranges_m.resize(std::min<std::size_t>(bytes.byte(), most_beams));
  const bool same = (kind & 32) != 0;
  const double range_m = bytes.number((kind & 64) != 0);
  for (float& range : scan.ranges_m)
    range = static_cast<float>(std::clamp(same ? range_m : bytes.small(), -1e30, 1e30));
  if ((kind & 128) != 0) {
    for (std::size_t i = 0; i < scan.ranges_m.size(); i += 3)
      scan.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return scan;
}

Order order_from(Bytes& bytes, std::uint8_t kind) {
  if (kind == 0) return Hold{};
  const bool is_any = (kind & 2) != 0;
  GoTo order{{bytes.number(is_any), bytes.number(is_any)}, is_any ? bytes.any() : 0.2};
  if ((kind & 4) != 0) order.heading_rad = bytes.number(is_any);
  return order;
}

void check(const Command& command, const RobotModel& robot) {
  const auto* const drive = std::get_if<DriveTwist>(&command);
  if (drive == nullptr || !std::isfinite(drive->until_s)) std::abort();
  const Twist2& twist = drive->twist;
  // Comparisons with what is no number are false.
  if (!(std::abs(twist.ahead_mps) <= robot.speed_mps + 1e-9) || twist.left_mps != 0.0 ||
      !(std::abs(twist.turn_radps) <= robot.turn_rate_radps + 1e-9))
    std::abort();
}

}  // namespace

extern "C" int FUZZ_ENTRY(navigator)(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t choice = bytes.byte();
  NavigatorSetup setup;
  setup.map.reach_m = 3.0;
  setup.motion.samples = 16;
  setup.motion.rule = local_motions()[choice % local_motions().size()].name;
  setup.options.localiser = robot_localisers()[choice / 8 % robot_localisers().size()].name;
  if (setup.options.localiser == "laser_on_map") setup.known = room();
  const bool told = (choice & 128) == 0 || !setup.known;
  auto navigator = Navigator::make(setup, told ? std::optional(Pose2{}) : std::nullopt);
  if (!navigator) std::abort();
  Observation seen;
  Order order = GoTo{{2.0, 1.0}, 0.2};
  for (int period = 0; period < most_periods && !bytes.empty(); ++period) {
    const std::uint8_t times = bytes.byte(), moves = bytes.byte(), looks = bytes.byte(), rest = bytes.byte();
    seen.time_s = (times & 1) != 0 ? bytes.number((times & 2) != 0) : seen.time_s + setup.options.period_s;
    if ((moves & 1) != 0)
      seen.odometry = {{bytes.number((moves & 2) != 0), bytes.number((moves & 2) != 0)},
                       bytes.number((moves & 2) != 0)};
    seen.scan.reset();
    if ((looks & 1) != 0) seen.scan = scan_from(bytes, looks, seen.time_s);
    seen.touching = (rest & 1) != 0;
    seen.touch_rad.reset();
    if ((rest & 2) != 0) seen.touch_rad = bytes.number((rest & 4) != 0);
    if ((rest & 8) != 0) order = order_from(bytes, rest >> 4);
    const Situation now = navigator->perceive(seen);
    if (!finite(now.pose)) std::abort();
    if (now.progress.state == Progress::State::blocked && now.progress.why.empty()) std::abort();
    check(navigator->act(order), setup.robot);
  }
  return 0;
}
