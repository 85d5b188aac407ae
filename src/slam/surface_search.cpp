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
    while (level + 2 < static_cast<int>(levels_.size()) && (2 << level) <= 2 * reach_ + 1) ++level;
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
      for (int y = up.low; y <= up.high; y += side) {
        for (int x = across.low; x <= across.high; x += side)
          add(roots, {static_cast<int>(i) * side, {x, y}, 0.0}, level);
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

  /// Returns a bound of the mean of the field over the points, exact on level 0; 0 if it is not above
  /// `least`. The cell of a point at all poses of the block lies within a square of side 2^(level + 1).
  [[nodiscard]] double mean(const Block& block, int level, double least) const {
    constexpr std::size_t checked = 32;  // points between two checks
    const int above = level == 0 ? 0 : level + 1;
    const Grid<std::uint8_t>& field = levels_[static_cast<std::size_t>(above)];
    const std::vector<Cell>& cells = cells_at(block.angle, level);
    const Cell low{block.offset.x - spread(level), block.offset.y - spread(level)};
    const auto width = static_cast<unsigned>(field.frame.width);
    const auto height = static_cast<unsigned>(field.frame.height);
    const double full = 255.0 * static_cast<double>(cells.size());
    const double missing = (1.0 - least) * full;  // what all points may lack together
    int lacking = 0;
    for (std::size_t i = 0; i < cells.size();) {
      for (const std::size_t end = std::min(i + checked, cells.size()); i < end; ++i) {
        const auto x = static_cast<unsigned>((cells[i].x + low.x) >> above);
        const auto y = static_cast<unsigned>((cells[i].y + low.y) >> above);
        lacking += 255 - (x < width && y < height ? field.cells[std::size_t{y} * width + x] : 0);
      }
      if (lacking >= missing) return 0.0;
    }
    return (full - lacking) / full;
  }

  void add(std::vector<Block>& blocks, Block block, int level) {
    const double most = 1.0 - cost(block, level);
    if (most <= best_.score || ++tried_ > window_.most_blocks) return;
    block.bound = mean(block, level, best_.score + (1.0 - most)) - (1.0 - most);
    if (block.bound > best_.score) blocks.push_back(block);
  }

  void descend(std::vector<Block>& blocks, int level) {
    std::sort(blocks.begin(), blocks.end(), better);
    for (const Block& block : blocks) {
      if (block.bound <= best_.score || tried_ > window_.most_blocks) return;
      if (level == 0) {
        take(block);
        continue;
      }
      std::vector<Block> parts;
      const int half = 1 << (level - 1);
      for (const int turn : {0, half}) {
        if (block.angle + turn >= static_cast<int>(cells_.size())) continue;
        for (const auto& [dx, dy] :
             {std::pair(0, 0), std::pair(half, 0), std::pair(0, half), std::pair(half, half)}) {
          const Cell offset{block.offset.x + dx, block.offset.y + dy};
          if (offset.x <= reach_ && offset.y <= reach_)
            add(parts, {block.angle + turn, offset, 0.0}, level - 1);
        }
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
