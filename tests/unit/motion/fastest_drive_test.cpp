#include "outrider/motion/fastest_drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Steps of the brute force: all lengths and accelerations of random cases are multiples of what fits them.
constexpr double step_m = 0.01, step_square = 0.0025;

double whole(Rng& rng, int low, int high) { return std::floor(rng.uniform(low, high + 1.0)); }

DriveLimits random_limits(Rng& rng) {
  DriveLimits limits;
  limits.speed_mps = rng.uniform(0.3, 1.0);
  limits.acceleration_mps2 = whole(rng, 1, 8) * step_square / (2.0 * step_m);
  limits.deceleration_mps2 = whole(rng, 1, 8) * step_square / (2.0 * step_m);
  limits.lateral_acceleration_mps2 = rng.uniform(0.05, 2.0);
  limits.turn_rate_radps = rng.uniform(0.2, 3.0);
  limits.turn_acceleration_radps2 = rng.uniform(0.5, 10.0);
  return limits;
}

/// Straight legs and arcs, some of them a step long.
std::vector<CurvePiece> random_pieces(Rng& rng, bool stops) {
  std::vector<CurvePiece> pieces;
  for (double count = whole(rng, 1, 8); count > 0.0; --count) {
    CurvePiece piece;
    piece.length_m = step_m * whole(rng, 1, rng.uniform(0.0, 1.0) < 0.3 ? 5 : 100);
    if (rng.uniform(0.0, 1.0) < 0.6) piece.curvature_per_m = rng.uniform(-10.0, 10.0);
    if (stops && rng.uniform(0.0, 1.0) < 0.2) piece.turn_rad = rng.uniform(-pi, pi);
    if (stops && rng.uniform(0.0, 1.0) < 0.1) piece.stop = true;
    pieces.push_back(piece);
  }
  return pieces;
}

double length_of(const std::vector<CurvePiece>& pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), 0.0,
                         [](double sum, const CurvePiece& piece) { return sum + piece.length_m; });
}

bool allowed(double speed, const CurvePiece& piece, const DriveLimits& limits) {
  const double curvature = std::abs(piece.curvature_per_m), most = 1.0 + 1e-9;
  return speed <= most * limits.speed_mps && curvature * speed <= most * limits.turn_rate_radps &&
         curvature * speed * speed <= most * limits.lateral_acceleration_mps2;
}

/// The piece at a place, the one that allows more where two meet within rounding.
bool allowed_at(double along_m, double speed, const std::vector<CurvePiece>& pieces,
                const DriveLimits& limits) {
  double begin_m = 0.0;
  for (const CurvePiece& piece : pieces) {
    const double end_m = begin_m + piece.length_m;
    if (along_m >= begin_m - 1e-9 && along_m <= end_m + 1e-9 && allowed(speed, piece, limits)) return true;
    begin_m = end_m;
  }
  return false;
}

double time_of(const std::vector<CurvePiece>& pieces, const DriveLimits& limits) {
  const auto drive = fastest_drive(pieces, limits);
  EXPECT_TRUE(drive.has_value());
  return drive ? drive->time_s : infinite;
}

TEST(FastestDrive, KeepsTheLimitsAtEachMoment) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(100); ++round) {
    const DriveLimits limits = random_limits(rng);
    const auto pieces = random_pieces(rng, true);
    const auto drive = fastest_drive(pieces, limits);
    ASSERT_TRUE(drive.has_value());
    EXPECT_NEAR(drive->driven_m, length_of(pieces), 1e-12);
    const int steps = 20'000;
    const double step_s = drive->time_s / steps, slack = 1e-6;
    double sum_m = 0.0;
    for (int i = 1; i <= steps; ++i) {
      const DriveState before = state_at(*drive, (i - 1) * step_s), now = state_at(*drive, i * step_s);
      const double change = now.speed_mps - before.speed_mps;
      ASSERT_LE(change, limits.acceleration_mps2 * step_s + slack * step_s) << round << ' ' << i;
      ASSERT_GE(change, -limits.deceleration_mps2 * step_s - slack * step_s) << round << ' ' << i;
      ASSERT_GE(now.along_m, before.along_m - 1e-12);
      ASSERT_TRUE(allowed_at(now.along_m, now.speed_mps, pieces, limits)) << round << ' ' << now.along_m;
      sum_m += 0.5 * (before.speed_mps + now.speed_mps) * step_s;
    }
    EXPECT_NEAR(sum_m, drive->driven_m, 1e-4 * (1.0 + drive->driven_m)) << "the speed is that of the places";
    EXPECT_NEAR(state_at(*drive, drive->time_s * (1.0 - 1e-9)).along_m, drive->driven_m, 1e-6);
  }
}

TEST(FastestDrive, RestsAtStopsForAsLongAsTheTurnTakes) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(200); ++round) {
    const DriveLimits limits = random_limits(rng);
    const auto pieces = random_pieces(rng, true);
    double sum_s = 0.0, turned_rad = 0.0;
    std::vector<CurvePiece> section;
    for (CurvePiece piece : pieces) {
      if (piece.stop || piece.turn_rad != 0.0) {
        sum_s += time_of(section, limits);
        section.clear();
      }
      const double turn = std::abs(piece.turn_rad), rate = limits.turn_rate_radps;
      const double up = limits.turn_acceleration_radps2;
      sum_s += turn >= rate * rate / up ? turn / rate + rate / up : 2.0 * std::sqrt(turn / up);
      turned_rad += turn;
      piece.stop = false;
      piece.turn_rad = 0.0;
      section.push_back(piece);
    }
    sum_s += time_of(section, limits);
    const auto drive = fastest_drive(pieces, limits);
    EXPECT_NEAR(drive->time_s, sum_s, 1e-9 * sum_s);
    EXPECT_NEAR(drive->turned_rad, turned_rad, 1e-12);
  }
}

/// The least time by dynamic programming over a grid of the phase plane: at each step of the path the speeds
/// whose squares are on the grid, all pairs of them between steps. It knows nothing of passes or switching
/// points, and can drive only what it finds, so it is never faster than the fastest drive.
double least_time_on_grid(const std::vector<CurvePiece>& pieces, const DriveLimits& limits) {
  const int up = static_cast<int>(std::lround(2.0 * step_m * limits.acceleration_mps2 / step_square));
  const int down = static_cast<int>(std::lround(2.0 * step_m * limits.deceleration_mps2 / step_square));
  const int most = static_cast<int>(limits.speed_mps * limits.speed_mps / step_square);
  const auto speed = [](int k) { return std::sqrt(k * step_square); };
  std::vector<double> here(static_cast<std::size_t>(most) + 1, infinite);
  here[0] = 0.0;
  for (const CurvePiece& piece : pieces) {
    for (long step = std::lround(piece.length_m / step_m); step > 0; --step) {
      std::vector<double> next(here.size(), infinite);
      for (int k = 0; k <= most; ++k) {
        const double begin_s = here[static_cast<std::size_t>(k)];
        if (std::isinf(begin_s) || !allowed(speed(k), piece, limits)) continue;
        for (int j = std::max(0, k - down); j <= std::min(most, k + up); ++j) {
          if (j + k == 0 || !allowed(speed(j), piece, limits)) continue;
          double& end_s = next[static_cast<std::size_t>(j)];
          end_s = std::min(end_s, begin_s + 2.0 * step_m / (speed(j) + speed(k)));
        }
      }
      here = std::move(next);
    }
  }
  return here[0];
}

TEST(FastestDrive, IsAsFastAsABruteForceOverThePhasePlane) {
  Rng rng(3);
  double ratios = 0.0;
  int judged = 0;
  for (int round = 0; round < testing::cases(40); ++round) {
    const DriveLimits limits = random_limits(rng);
    const auto pieces = random_pieces(rng, false);
    const double time_s = time_of(pieces, limits), grid_s = least_time_on_grid(pieces, limits);
    if (std::isinf(grid_s)) continue;  // a bend so tight that the grid has no speed for it
    EXPECT_LE(time_s, grid_s * (1.0 + 1e-9)) << round;
    ratios += grid_s / time_s;
    ++judged;
  }
  EXPECT_GE(judged, 20);
  EXPECT_LE(ratios / judged, 1.05) << "the grid comes near";
}

/// Two pieces whose limits all are on the grid: what is left is the place of the switching points.
TEST(FastestDrive, IsThatOfTheBruteForceWhereTheGridHasItsSpeeds) {
  DriveLimits limits{1.0, 0.5, 0.25, 0.25, 100.0, 6.0};
  const std::vector<CurvePiece> pieces = {{2.0, 0.0}, {0.5, 1.0}, {0.04, 4.0}, {0.8, 0.0}, {0.3, -1.0}};
  const double time_s = time_of(pieces, limits), grid_s = least_time_on_grid(pieces, limits);
  EXPECT_LE(time_s, grid_s * (1.0 + 1e-12));
  EXPECT_LE(grid_s, time_s * 1.001);
}

TEST(FastestDrive, KnownTimes) {
  DriveLimits limits{1.0, 0.5, 0.5, 0.25, 2.0, 6.0};
  for (const double length_m : {0.0, 0.1, 2.0, 30.0})
    EXPECT_NEAR(time_of({{length_m, 0.0}}, limits), duration(length_m, {1.0, 0.5}), 1e-12) << length_m;
  // 1 m up to 1 m/s at 0.5 m/s2, 0.5 m down at 1 m/s2, and what is left at full speed.
  limits.deceleration_mps2 = 1.0;
  EXPECT_NEAR(time_of({{4.0, 0.0}}, limits), 2.0 + 2.5 + 1.0, 1e-12);
  // A ring of radius 1 m: 0.5 m/s by the lateral acceleration, 0.25 m and 1 s up, 0.125 m and 0.5 s down.
  EXPECT_NEAR(time_of({{10.0, 1.0}}, limits), 1.0 + 0.5 + (10.0 - 0.375) / 0.5, 1e-12);
  limits.turn_rate_radps = 0.25;
  EXPECT_NEAR(time_of({{10.0, -1.0}}, limits), 0.5 + 0.25 + (10.0 - 0.0625 - 0.03125) / 0.25, 1e-12);
  EXPECT_EQ(time_of({}, limits), 0.0);
}

TEST(FastestDrive, WherePiecesAreCutMakesNoDifference) {
  Rng rng(4);
  for (int round = 0; round < testing::cases(100); ++round) {
    const DriveLimits limits = random_limits(rng);
    const auto pieces = random_pieces(rng, true);
    std::vector<CurvePiece> cut;
    for (const CurvePiece& piece : pieces) {
      const double part = rng.uniform(0.0, 1.0);
      cut.push_back({part * piece.length_m, piece.curvature_per_m, piece.stop, piece.turn_rad});
      cut.push_back({(1.0 - part) * piece.length_m, piece.curvature_per_m});
    }
    const double time_s = time_of(pieces, limits);
    EXPECT_NEAR(time_of(cut, limits), time_s, 1e-9 * time_s);
    DriveLimits mirrored = limits;
    std::swap(mirrored.acceleration_mps2, mirrored.deceleration_mps2);
    std::vector<CurvePiece> back;
    for (std::size_t i = pieces.size(); i-- > 0;) {
      const bool last = i + 1 == pieces.size();
      back.push_back({pieces[i].length_m, pieces[i].curvature_per_m, !last && pieces[i + 1].stop,
                      last ? 0.0 : pieces[i + 1].turn_rad});
    }
    std::vector<CurvePiece> ahead = pieces;
    ahead.front().turn_rad = 0.0;
    EXPECT_NEAR(time_of(back, mirrored), time_of(ahead, limits), 1e-9 * time_s) << "backwards in time";
  }
}

TEST(FastestDrive, RefusesWhatIsNoPathAndNoLimit) {
  const auto refusal = [](const std::vector<CurvePiece>& pieces, const DriveLimits& limits) {
    const auto drive = fastest_drive(pieces, limits);
    return drive ? std::string("taken") : to_string(drive.error());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal({{1.0, 0.0}, {-1.0, 0.0}}, {}), "piece 1: its length is -1; expected 0 to 1e9 m");
  EXPECT_NE(refusal({{nan, 0.0}}, {}).find("piece 0: its length"), std::string::npos);
  EXPECT_NE(refusal({{1.0, infinite}}, {}).find("its curvature"), std::string::npos);
  EXPECT_NE(refusal({{1.0, 0.0, false, nan}}, {}).find("its turn"), std::string::npos);
  for (double DriveLimits::* limit :
       {&DriveLimits::speed_mps, &DriveLimits::acceleration_mps2, &DriveLimits::deceleration_mps2,
        &DriveLimits::lateral_acceleration_mps2, &DriveLimits::turn_rate_radps,
        &DriveLimits::turn_acceleration_radps2}) {
    for (const double value : {0.0, -1.0, nan, infinite}) {
      DriveLimits limits;
      limits.*limit = value;
      EXPECT_NE(refusal({{1.0, 0.0}}, limits), "taken");
    }
  }
  DriveLimits slow;
  slow.deceleration_mps2 = 0.0;
  EXPECT_NE(refusal({}, slow).find("deceleration"), std::string::npos) << refusal({}, slow);
}

}  // namespace
}  // namespace outrider
