#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "outrider/core/units.hpp"
#include "surface_map.hpp"

namespace outrider {
namespace {

/// Twice the cost of a deviation from the centre by one standard deviation. The scores of wrong poses are
/// lower by tenths.
constexpr double cost_of_deviation = 0.01;
constexpr std::size_t most_points = 180;
constexpr double most_reach_cells = 1 << 29;
constexpr std::int64_t most_blocks = 4'000'000;  // searched at most, from 180 cells each

/// All poses of equal heading whose cells lie from `offset` on, 2^level to each side.
struct Block {
  int angle = 0;
  Cell offset;
  double bound = 0.0;
};

/// The offsets of one angle, from the lowest block to the highest.
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
    int level = 0;
    while (level + 1 < static_cast<int>(levels_.size()) && (2 << level) <= 2 * reach_ + 1) ++level;
    const int side = 1 << level;
    std::vector<std::pair<Range, Range>> ranges;
    std::int64_t blocks = 0;
    for (const std::vector<Cell>& cells : cells_) {
      const auto& [across, up] = ranges.emplace_back(meeting(cells, side));
      blocks += across.blocks(side) * up.blocks(side);
    }
    if (blocks > most_blocks) return false;
    std::vector<Block> roots;
    for (int k = 0; k < static_cast<int>(cells_.size()); ++k) {
      const auto& [across, up] = ranges[static_cast<std::size_t>(k)];
      for (int y = up.low; y <= up.high; y += side) {
        for (int x = across.low; x <= across.high; x += side) add(roots, {k, {x, y}, 0.0}, level);
      }
    }
    descend(roots, level);
    return tried_ <= most_blocks;
  }

  [[nodiscard]] std::optional<FoundPose> best() const { return found_ ? std::optional(best_) : std::nullopt; }

 private:
  /// Returns the blocks of the window in which some of the cells lie within the field; elsewhere the score is
  /// zero.
  [[nodiscard]] std::pair<Range, Range> meeting(const std::vector<Cell>& cells, int side) const {
    const GridFrame& frame = levels_.front().frame;
    const auto [left, right] = std::ranges::minmax(cells, {}, &Cell::x);
    const auto [lowest, highest] = std::ranges::minmax(cells, {}, &Cell::y);
    const auto range = [&](int least, int most, int size) {
      const int skipped = std::max(0, reach_ - most) / side;
      return Range{-reach_ + skipped * side, std::min(reach_, size - 1 - least)};
    };
    return {range(left.x, right.x, frame.width), range(lowest.y, highest.y, frame.height)};
  }

  [[nodiscard]] double cost(const Block& block, int level) const {
    const auto gap = [&](int low) { return std::max({0, low, -(low + (1 << level) - 1)}); };
    const double x = gap(block.offset.x), y = gap(block.offset.y);
    const double side_m = levels_.front().frame.resolution_m;
    const double squared_m = (x * x + y * y) * side_m * side_m;
    const double turn = (block.angle - turns_) * step_rad_;
    return cost_of_deviation * (squared_m / (window_.position_sd_m * window_.position_sd_m) +
                                turn * turn / (window_.heading_sd_rad * window_.heading_sd_rad));
  }

  [[nodiscard]] double mean(const Block& block, int level) const {
    const Grid<std::uint8_t>& field = levels_[static_cast<std::size_t>(level)];
    const std::vector<Cell>& cells = cells_[static_cast<std::size_t>(block.angle)];
    const auto width = static_cast<unsigned>(field.frame.width);
    const auto height = static_cast<unsigned>(field.frame.height);
    int sum = 0;
    for (const Cell& cell : cells) {
      const auto x = static_cast<unsigned>((cell.x + block.offset.x) >> level);
      const auto y = static_cast<unsigned>((cell.y + block.offset.y) >> level);
      if (x < width && y < height) sum += field.cells[std::size_t{y} * width + x];
    }
    return sum / (255.0 * static_cast<double>(cells.size()));
  }

  void add(std::vector<Block>& blocks, Block block, int level) {
    const double most = 1.0 - cost(block, level);
    if (most <= best_.score || ++tried_ > most_blocks) return;
    block.bound = mean(block, level) - (1.0 - most);
    if (block.bound > best_.score) blocks.push_back(block);
  }

  void descend(std::vector<Block>& blocks, int level) {
    std::sort(blocks.begin(), blocks.end(), better);
    for (const Block& block : blocks) {
      if (block.bound <= best_.score || tried_ > most_blocks) return;
      if (level == 0) {
        take(block);
        continue;
      }
      std::vector<Block> parts;
      const int half = 1 << (level - 1);
      for (const auto& [dx, dy] :
           {std::pair(0, 0), std::pair(half, 0), std::pair(0, half), std::pair(half, half)}) {
        const Cell offset{block.offset.x + dx, block.offset.y + dy};
        if (offset.x <= reach_ && offset.y <= reach_) add(parts, {block.angle, offset, 0.0}, level - 1);
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
  Search search(levels_, thinned(surface, most_points), window, least, nullptr, {});
  return search.run() ? search.best() : std::nullopt;
}

bool SurfaceMap::may_be_elsewhere(const Surface& surface, const MatchWindow& window, double least,
                                  const Pose2& except, const Separation& distinct) const {
  Search search(levels_, thinned(surface, most_points), window, least, &except, distinct);
  return !search.run() || search.best();
}

}  // namespace outrider
