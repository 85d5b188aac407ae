#include "outrider/motion/fastest_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double most_length_m = 1e9, most_curvature_per_m = 1e12, most_turn_rad = 1e3;

bool stops_before(const CurvePiece& piece) { return piece.stop || piece.turn_rad != 0.0; }

/// Returns the square of the largest speed on the piece.
double most_square(const CurvePiece& piece, const DriveLimits& limits) {
  const double curvature = std::abs(piece.curvature_per_m);
  double square = limits.speed_mps * limits.speed_mps;
  if (curvature == 0.0) return square;
  const double turning = limits.turn_rate_radps / curvature;
  return std::min({square, turning * turning, limits.lateral_acceleration_mps2 / curvature});
}

Status check_pieces(const std::vector<CurvePiece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const CurvePiece& piece = pieces[i];
    const auto refused = [&](const char* name, double value, const char* expected) {
      return bad_input(fmt::format("its {} is {:g}; expected {}", name, value, expected),
                       fmt::format("piece {}", i));
    };
    if (!(piece.length_m >= 0.0 && piece.length_m <= most_length_m))
      return refused("length", piece.length_m, "0 to 1e9 m");
    if (!(std::abs(piece.curvature_per_m) <= most_curvature_per_m))
      return refused("curvature", piece.curvature_per_m, "-1e12 to 1e12 1/m");
    if (!(std::abs(piece.turn_rad) <= most_turn_rad))
      return refused("turn", piece.turn_rad, "-1000 to 1000 rad");
  }
  return {};
}

/// Returns the square of the speed at the beginning of each piece and at the end of the last.
std::vector<double> squares_between(const std::vector<CurvePiece>& pieces, const DriveLimits& limits) {
  std::vector<double> squares(pieces.size() + 1, 0.0);
  for (std::size_t i = pieces.size(); i-- > 1;) {
    if (stops_before(pieces[i])) continue;
    const double before = most_square(pieces[i - 1], limits), here = most_square(pieces[i], limits);
    const double brakes = squares[i + 1] + 2.0 * limits.deceleration_mps2 * pieces[i].length_m;
    squares[i] = std::min({before, here, brakes});
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double reached = squares[i] + 2.0 * limits.acceleration_mps2 * pieces[i].length_m;
    squares[i + 1] = std::min(squares[i + 1], reached);
  }
  return squares;
}

/// Appends a phase unless it takes no time.
void append(FastestDrive& drive, double duration_s, double along_m, double speed_mps,
            double acceleration_mps2, double turn_rad) {
  if (!(duration_s > 0.0)) return;
  drive.phases.push_back({drive.time_s, duration_s, along_m, speed_mps, acceleration_mps2, turn_rad});
  drive.time_s += duration_s;
}

/// Appends the phases of a piece between these squares of the speed: accelerates to the peak, keeps it,
/// brakes. Without a limit of the speed the peak is where both parabolas meet.
void append_piece(FastestDrive& drive, const CurvePiece& piece, double from, double to,
                  const DriveLimits& limits) {
  const double up = limits.acceleration_mps2, down = limits.deceleration_mps2, length = piece.length_m;
  const double meet = (2.0 * up * down * length + down * from + up * to) / (up + down);
  const double least = std::max(from, to), most = std::max(least, most_square(piece, limits));
  const double peak = std::clamp(meet, least, most), speed = std::sqrt(peak);
  const double rise_m = (peak - from) / (2.0 * up), fall_m = (peak - to) / (2.0 * down);
  const double begin_m = drive.driven_m, flat_m = meet > most ? std::max(0.0, length - rise_m - fall_m) : 0.0;
  append(drive, (speed - std::sqrt(from)) / up, begin_m, std::sqrt(from), up, 0.0);
  append(drive, flat_m > 0.0 ? flat_m / speed : 0.0, begin_m + rise_m, speed, 0.0, 0.0);
  append(drive, (speed - std::sqrt(to)) / down, begin_m + length - fall_m, speed, -down, 0.0);
  drive.driven_m += length;
}

}  // namespace

std::vector<Option> describe(DriveLimits& limits) {
  return {
      {"speed", "m/s", 1e-3, 100.0, "largest speed along a path", &limits.speed_mps},
      {"acceleration", "m/s2", 1e-3, 1e3, "largest acceleration along a path", &limits.acceleration_mps2},
      {"deceleration", "m/s2", 1e-3, 1e3, "largest deceleration along a path", &limits.deceleration_mps2},
      {"lateral_acceleration", "m/s2", 1e-3, 1e3, "largest acceleration across the path on its arcs",
       &limits.lateral_acceleration_mps2},
      {"turn_rate", "rad/s", 1e-3, 100.0, "largest turn rate, on arcs and in place", &limits.turn_rate_radps},
      {"turn_acceleration", "rad/s2", 1e-3, 1e4, "largest angular acceleration of turns in place",
       &limits.turn_acceleration_radps2},
  };
}

Status check(const DriveLimits& limits) {
  DriveLimits copy = limits;
  return check_ranges(describe(copy));
}

Outcome<FastestDrive> fastest_drive(const std::vector<CurvePiece>& pieces, const DriveLimits& limits) {
  if (auto ok = check(limits); !ok) return pass_on(ok);
  if (auto ok = check_pieces(pieces); !ok) return pass_on(ok);
  const std::vector<double> squares = squares_between(pieces, limits);
  FastestDrive drive;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double turn_rad = pieces[i].turn_rad;
    append(drive, duration(std::abs(turn_rad), limits.turning()), drive.driven_m, 0.0, 0.0, turn_rad);
    drive.turned_rad += std::abs(turn_rad);
    append_piece(drive, pieces[i], squares[i], squares[i + 1], limits);
  }
  return drive;
}

DriveState state_at(const FastestDrive& drive, double time_s) {
  if (!(time_s > 0.0) || drive.phases.empty()) return {};
  if (time_s >= drive.time_s) return {drive.driven_m, 0.0};
  const auto after = std::ranges::upper_bound(drive.phases, time_s, {}, &DrivePhase::start_s);
  const DrivePhase& phase = *(after - 1);
  const double t = std::min(time_s - phase.start_s, phase.duration_s);
  const double gained_mps = phase.acceleration_mps2 * t;
  return {phase.start_m + (phase.speed_mps + 0.5 * gained_mps) * t,
          std::max(0.0, phase.speed_mps + gained_mps)};
}

}  // namespace outrider
