#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

#include "outrider/core/units.hpp"
#include "scan/surface_map.hpp"

namespace outrider {
namespace {

/// Twice the cost of a deviation from the centre by one standard deviation. The scores of wrong poses are
/// lower by tenths.
constexpr double cost_of_deviation = 0.01;
constexpr std::size_t most_searched = 180;
constexpr double most_reach_cells = 1 << 29;

/// The poses of 2^level angles from `angle` on and of 2^level offsets from `offset` on, to each side.
struct Block {
  int angle = 0;
  Cell offset;
  double bound = 0.0;
};

/// The offsets of some angles, from the lowest block to the highest.
struct Range {
  int low = 0;
  int high = -1;
  [[nodiscard]] std::int64_t blocks(int side) const { return low > high ? 0 : (high - low) / side + 1; }
};

/// Orders blocks: the better first; ties by place.
bool better(const Block& a, const Block& b) {
  if (a.bound != b.bound) return a.bound > b.bound;
  return std::tuple(a.angle, a.offset.y, a.offset.x) < std::tuple(b.angle, b.offset.y, b.offset.x);
}

class Search {
 public:
  Search(const std::vector<Grid<std::uint8_t>>& levels, const Surface& surface, const MatchWindow& window,
         double least, const Pose2* except, const Separation& distinct)
      : levels_(levels), window_(window), except_(except), distinct_(distinct), best_{{}, least} {
    const GridFrame& frame = levels.front().frame;
    reach_ = static_cast<int>(std::min(std::ceil(window.reach_m / frame.resolution_m), most_reach_cells));
    double farthest_m = 1.0;
    for (const SurfacePoint& p : surface) farthest_m = std::max(farthest_m, norm(p.position));
    step_rad_ = frame.resolution_m / farthest_m;
    const double turn_rad = std::min(window.turn_rad, std::numbers::pi);
    turns_ = static_cast<int>(std::ceil(turn_rad / step_rad_));
    if (turns_ > 0) step_rad_ = turn_rad / turns_;
    for (int k = -turns_; k <= turns_; ++k) {
      const double heading = window.centre.heading_rad + k * step_rad_;
      auto& cells = cells_.emplace_back();
      cells.reserve(surface.size());
      const Vec2 along = direction(heading);
      for (const SurfacePoint& p : surface) {
        cells.push_back(frame.cell_at(window.centre.position + p.position.x * along +
                                      p.position.y * perpendicular(along)));
      }
    }
  }

  /// Runs the search; returns false if the window has too many poses.
  bool run() {
    if (cells_.front().empty()) return true;
    int level = 0;  // bounds are those of the level above
    while (level + 1 < static_cast<int>(levels_.size()) && (2 << level) <= 2 * reach_ + 1) ++level;
    const int side = 1 << level;
    std::vector<std::pair<Range, Range>> ranges;
    std::int64_t blocks = 0;
    for (int k = 0; k < static_cast<int>(cells_.size()); k += side) {
      const auto& [across, up] = ranges.emplace_back(meeting(k, level));
      blocks += across.blocks(side) * up.blocks(side);
    }
    if (blocks > window_.most_blocks) return false;
    std::vector<Block> roots;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const auto& [across, up] = ranges[i];
      for (int y = up.low; y <= up.high; y += 2 * side) {
        for (int x = across.low; x <= across.high; x += 2 * side)
          add_four(roots, static_cast<int>(i) * side, {x, y}, {across.high, up.high}, level);
      }
    }
    descend(roots, level);
    return tried_ <= window_.most_blocks;
  }

  [[nodiscard]] std::optional<FoundPose> best() const { return found_ ? std::optional(best_) : std::nullopt; }

 private:
  /// Returns by how many cells a point moves at most between the angle of cells_at() and another one of a
  /// block: each step moves it by one cell at most.
  [[nodiscard]] static int spread(int level) { return level == 0 ? 0 : 1 << (level - 1); }
  /// Returns the cells of the points at the angle in the middle of a block.
  [[nodiscard]] const std::vector<Cell>& cells_at(int angle, int level) const {
    return cells_[std::min(static_cast<std::size_t>(angle + spread(level)), cells_.size() - 1)];
  }

  /// Returns the blocks of the window in which some of the cells lie within the field; elsewhere the score is
  /// zero.
  [[nodiscard]] std::pair<Range, Range> meeting(int angle, int level) const {
    const std::vector<Cell>& cells = cells_at(angle, level);
    const GridFrame& frame = levels_.front().frame;
    const auto [left, right] = std::ranges::minmax(cells, {}, &Cell::x);
    const auto [lowest, highest] = std::ranges::minmax(cells, {}, &Cell::y);
    const auto range = [&](int least, int most, int size) {
      const int side = 1 << level;
      const int skipped = std::max(0, reach_ - most - spread(level)) / side;
      return Range{-reach_ + skipped * side, std::min(reach_, size - 1 - least + spread(level))};
    };
    return {range(left.x, right.x, frame.width), range(lowest.y, highest.y, frame.height)};
  }

  [[nodiscard]] double cost(const Block& block, int level) const {
    const auto gap = [&](int low) { return std::max({0, low, -(low + (1 << level) - 1)}); };
    const double x = gap(block.offset.x), y = gap(block.offset.y);
    const double side_m = levels_.front().frame.resolution_m;
    const double squared_m = (x * x + y * y) * side_m * side_m;
    const double turn = gap(block.angle - turns_) * step_rad_;
    return cost_of_deviation * (squared_m / (window_.position_sd_m * window_.position_sd_m) +
                                turn * turn / (window_.heading_sd_rad * window_.heading_sd_rad));
  }

  /// Adds up to each of four sums, `apart` cells of the field apart in x and y, the values of the field at
  /// the cells of some points; beyond the field they are 0.
  static void add_values(const Grid<std::uint8_t>& field, std::span<const Cell> cells, Cell low, int shift,
                         unsigned apart, std::array<int, 4>& sums) {
    const auto width = static_cast<unsigned>(field.frame.width);
    const auto height = static_cast<unsigned>(field.frame.height);
    const auto value = [&](unsigned x, unsigned y) {
      return x < width && y < height ? int{field.cells[std::size_t{y} * width + x]} : 0;
    };
    auto [a, b, c, d] = sums;
    for (const Cell& cell : cells) {
      const auto x = static_cast<unsigned>((cell.x + low.x) >> shift);
      const auto y = static_cast<unsigned>((cell.y + low.y) >> shift);
      if (x < width - apart && y < height - apart) [[likely]] {
        const std::uint8_t* const lower = &field.cells[std::size_t{y} * width + x];
        const std::uint8_t* const upper = lower + std::size_t{apart} * width;
        a += lower[0];
        b += lower[apart];
        c += upper[0];
        d += upper[apart];
      } else {
        a += value(x, y);
        b += value(x + apart, y);
        c += value(x, y + apart);
        d += value(x + apart, y + apart);
      }
    }
    sums = {a, b, c, d};
  }

  /// Returns bounds of the mean of the field over the points in four neighbouring blocks, exact on level 0; 0
  /// where it is not above `least`. The cell of a point at all poses of a block lies within a square of side
  /// 2^(level + 1).
  [[nodiscard]] std::array<double, 4> means(int angle, Cell offset, int level,
                                            const std::array<double, 4>& least) const {
    constexpr std::size_t checked = 32;  // points between two checks
    const std::vector<Cell>& cells = cells_at(angle, level);
    const Cell low{offset.x - spread(level), offset.y - spread(level)};
    const double full = 255.0 * static_cast<double>(cells.size());
    std::array<int, 4> sums{};
    const auto may_exceed = [&](std::size_t i, std::size_t seen) {  // if all other points are on a surface
      return 255.0 * static_cast<double>(seen) - sums[i] < (1.0 - least[i]) * full;
    };
    for (std::size_t begin = 0; begin < cells.size(); begin += checked) {
      const std::size_t end = std::min(begin + checked, cells.size());
      add_values(levels_[static_cast<std::size_t>(level)], std::span(cells).subspan(begin, end - begin), low,
                 std::max(0, level - 1), level == 0 ? 1 : 2, sums);
      if (!may_exceed(0, end) && !may_exceed(1, end) && !may_exceed(2, end) && !may_exceed(3, end)) return {};
    }
    std::array<double, 4> result{};
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = may_exceed(i, cells.size()) ? sums[i] / full : 0.0;
    return result;
  }

  /// Adds those of the four blocks from an offset on that begin at `most` at the latest and may hold a better
  /// pose than the best one.
  void add_four(std::vector<Block>& blocks, int angle, Cell offset, Cell most, int level) {
    constexpr double never = 2.0;
    const int side = 1 << level;
    std::array<Block, 4> four;
    std::array<double, 4> highest{}, least{};
    for (std::size_t i = 0; i < four.size(); ++i) {
      four[i] = {angle, {offset.x + (i % 2 == 0 ? 0 : side), offset.y + (i < 2 ? 0 : side)}, 0.0};
      highest[i] = 1.0 - cost(four[i], level);
      const bool is_tried = four[i].offset.x <= most.x && four[i].offset.y <= most.y &&
                            highest[i] > best_.score && ++tried_ <= window_.most_blocks;
      least[i] = is_tried ? best_.score + (1.0 - highest[i]) : never;
    }
    if (std::ranges::count(least, never) == 4) return;
    const std::array<double, 4> mean = means(angle, offset, level, least);
    for (std::size_t i = 0; i < four.size(); ++i) {
      four[i].bound = mean[i] - (1.0 - highest[i]);
      if (least[i] < never && four[i].bound > best_.score) blocks.push_back(four[i]);
    }
  }

  /// Returns true if any pose was asked for, apart from `except_`, and one is found.
  [[nodiscard]] bool is_decided() const { return except_ != nullptr && found_; }

  void descend(std::vector<Block>& blocks, int level) {
    std::sort(blocks.begin(), blocks.end(), better);
    for (const Block& block : blocks) {
      if (is_decided() || block.bound <= best_.score || tried_ > window_.most_blocks) return;
      if (level == 0) {
        take(block);
        continue;
      }
      std::vector<Block> parts;
      const int half = 1 << (level - 1);
      for (const int turn : {0, half}) {
        if (block.angle + turn < static_cast<int>(cells_.size()))
          add_four(parts, block.angle + turn, block.offset, {reach_, reach_}, level - 1);
      }
      descend(parts, level - 1);
    }
  }

  void take(const Block& block) {
    const double side_m = levels_.front().frame.resolution_m;
    const Vec2 place =
        window_.centre.position + side_m * Vec2{double(block.offset.x), double(block.offset.y)};
    const Pose2 pose{place, window_.centre.heading_rad + (block.angle - turns_) * step_rad_};
    if (except_ != nullptr && distance(except_->position, place) <= distinct_.position_m &&
        std::abs(wrap_angle(except_->heading_rad - pose.heading_rad)) <= distinct_.heading_rad)
      return;
    best_ = {pose, block.bound};
    found_ = true;
  }

  const std::vector<Grid<std::uint8_t>>& levels_;
  const MatchWindow& window_;
  const Pose2* except_;
  Separation distinct_;
  FoundPose best_;
  bool found_ = false;
  std::int64_t tried_ = 0;
  int reach_ = 0;  ///< cells
  int turns_ = 0;  ///< steps to each side
  double step_rad_ = 0.0;
  std::vector<std::vector<Cell>> cells_;  ///< cells of the points for the pose at the centre, by angle
};

}  // namespace

std::optional<FoundPose> SurfaceMap::find(const Surface& surface, const MatchWindow& window,
                                          double least) const {
  Search search(levels_, thinned(surface, most_searched), window, least, nullptr, {});
  return search.run() ? search.best() : std::nullopt;
}

bool SurfaceMap::may_be_elsewhere(const Surface& surface, const MatchWindow& window, double least,
                                  const Pose2& except, const Separation& distinct) const {
  Search search(levels_, thinned(surface, most_searched), window, least, &except, distinct);
  return !search.run() || search.best();
}

}  // namespace outrider
