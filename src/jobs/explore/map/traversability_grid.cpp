#include "outrider/jobs/explore/map/traversability_grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace outrider {
namespace {

constexpr int tile_cells = 16;
constexpr int least_border = 32;  // cells between the map and the edge of a new frame

int tiles(int cells) { return (cells + tile_cells - 1) / tile_cells; }

/// The cell of `to` that is cell (0, 0) of `from`, when both lie on one lattice.
std::optional<Cell> shift_between(const GridFrame& from, const GridFrame& to) {
  if (from.resolution_m != to.resolution_m) return std::nullopt;
  const Vec2 cells = 1.0 / to.resolution_m * (from.origin - to.origin);
  const Vec2 whole{std::round(cells.x), std::round(cells.y)};
  if (!(norm(cells - whole) < 1e-3)) return std::nullopt;
  return Cell{static_cast<int>(whole.x), static_cast<int>(whole.y)};
}

Cell sum(Cell a, Cell b) { return {a.x + b.x, a.y + b.y}; }

/// A frame on the lattice of `map` that reaches beyond it on all sides, of even width and height.
GridFrame around(const GridFrame& map) {
  const int wider = std::max(least_border, map.width / 4), higher = std::max(least_border, map.height / 4);
  GridFrame frame = map;
  frame.origin = map.corner({-wider, -higher});
  frame.width = (map.width + 2 * wider + 1) / 2 * 2;
  frame.height = (map.height + 2 * higher + 1) / 2 * 2;
  return frame;
}

/// The square of twice the distance from the centre of a cell to the square of the cell at the offset.
int squared_halves(Cell offset) {
  const int x = std::max(0, 2 * std::abs(offset.x) - 1), y = std::max(0, 2 * std::abs(offset.y) - 1);
  return x * x + y * y;
}

/// Offsets of the cells whose squares are within so many cells of a centre, nearest first.
std::vector<Cell> disk_of(double radius) {
  std::vector<Cell> disk;
  const int reach = static_cast<int>(radius + 0.5);
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (squared_halves({x, y}) <= 4.0 * radius * radius) disk.push_back({x, y});
    }
  }
  std::sort(disk.begin(), disk.end(), [](Cell a, Cell b) {
    return std::tuple(squared_halves(a), a.y, a.x) < std::tuple(squared_halves(b), b.y, b.x);
  });
  return disk;
}

}  // namespace

std::vector<Option> describe(KnownGroundOptions& options) {
  return {{"margin", "m", 0.0, 10.0,
           "distance kept from occupied cells beyond the radius of the robot, at most half a cell",
           &options.margin_m},
          {"near", "m", 0.0, 10.0, "width of the belt beyond the margin in which driving costs more",
           &options.near_m}};
}

TraversabilityGrid::TraversabilityGrid(const KnownGroundOptions& options, double radius_m)
    : radius_m_(radius_m), options_(options) {}

TraversabilityGrid::Change TraversabilityGrid::update(const Grid<std::uint8_t>& occupancy,
                                                      const MapUpdate& update) {
  Change change;
  ++clock_;
  const auto place = shift_between(occupancy.frame, known_.frame);
  const Cell far{occupancy.frame.width + 1, occupancy.frame.height + 1};
  const bool fits = place && place->x >= 2 && place->y >= 2 && known_.contains(sum(*place, far));
  if (!fits) {
    const GridFrame frame = around(occupancy.frame);
    const auto shift = shift_between(known_.frame, frame);
    if (!shift) {
      known_ = {};
      known_cells_ = 0;
    }
    change.reframed = true;
    change.new_lattice = !shift;
    change.shift = shift.value_or(Cell{});
    reframe(frame, change.shift);
  }
  const Cell offset = *shift_between(occupancy.frame, known_.frame);
  const std::size_t settled = stale_.size();
  const auto take = [&](Cell cell, std::uint8_t value) {
    const auto index = static_cast<std::uint32_t>(known_.frame.index(cell));
    if (known_.cells[index] == value) return;
    change.cells.push_back(index);
    set(index, value);
  };
  if (update.redrawn || !fits) {
    for (int y = 0; y < known_.frame.height; ++y) {
      for (int x = 0; x < known_.frame.width; ++x) {
        const Cell there{x - offset.x, y - offset.y};
        take({x, y}, occupancy.contains(there) ? occupancy[there] : static_cast<std::uint8_t>(unknown_cell));
      }
    }
  } else {
    for (const std::size_t cell : update.cells) {
      take(sum(occupancy.frame.cell(cell), offset), occupancy.cells[cell]);
    }
  }
  settle(settled);
  return change;
}

void TraversabilityGrid::reframe(const GridFrame& frame, Cell shift) {
  const GridFrame before = known_.frame;
  const double per_cell = 1.0 / frame.resolution_m;
  const double touch = per_cell * radius_m_ + std::min(0.5, per_cell * options_.margin_m) + 1e-9;
  disk_ = disk_of(touch + per_cell * options_.near_m);
  touch_ = disk_of(touch).size();
  known_.cells = moved_cells(known_.cells, before, frame, shift, static_cast<std::uint8_t>(unknown_cell));
  touching_ = moved_cells(touching_, before, frame, shift, std::uint16_t{0});
  near_ = moved_cells(near_, before, frame, shift, std::uint16_t{0});
  marks_ = moved_cells(marks_, before, frame, shift, std::uint8_t{0});
  if (before.size() == 0) {
    lowest_ = {0, 0};
    highest_ = {-1, -1};
  } else {
    lowest_ = sum(lowest_, shift);
    highest_ = sum(highest_, shift);
  }
  known_.frame = frame;
  GridFrame halved = frame;
  halved.resolution_m *= 2.0;
  halved.width /= 2;
  halved.height /= 2;
  blocks_ = Grid<std::uint8_t>(halved, no_block);
  tiles_.assign(std::size_t(tiles(frame.width)) * std::size_t(tiles(frame.height)), clock_);
  grid_.reset();
  stale_.clear();
  for (std::uint32_t cell = 0; cell < frame.size(); ++cell) {
    if (!blocked(cell)) stale_.push_back(cell);
  }
  settle(0);
}

void TraversabilityGrid::set(std::uint32_t cell, std::uint8_t value) {
  const std::uint8_t before = known_.cells[cell];
  known_.cells[cell] = value;
  if (before == unknown_cell) ++known_cells_;
  if (value == unknown_cell) --known_cells_;
  stale_.push_back(cell);
  const Cell at = known_.frame.cell(cell);
  if (value != unknown_cell) {
    const bool first = highest_.x < lowest_.x;
    lowest_ = first ? at : Cell{std::min(lowest_.x, at.x), std::min(lowest_.y, at.y)};
    highest_ = first ? at : Cell{std::max(highest_.x, at.x), std::max(highest_.y, at.y)};
  }
  if (before == occupied_cell) count(at, -1);
  if (value == occupied_cell) count(at, 1);
}

/// One more occupied cell, or one less, for all that is near it.
void TraversabilityGrid::count(Cell around, int by) {
  for (std::size_t i = 0; i < disk_.size(); ++i) {
    const Cell at = sum(around, disk_[i]);
    if (!known_.contains(at)) continue;
    const std::size_t cell = known_.frame.index(at);
    const auto add = [by](std::uint16_t& number) {
      number = static_cast<std::uint16_t>(number + by);
      return number <= 1;  // it became, or ceased to be, nothing
    };
    bool turned = add(near_[cell]);
    if (i < touch_) turned = add(touching_[cell]) || turned;
    if (turned) stale_.push_back(static_cast<std::uint32_t>(cell));
  }
}

double TraversabilityGrid::clearance_m(Cell cell) const {
  for (const Cell offset : disk_) {
    const Cell at = sum(cell, offset);
    if (known_.contains(at) && known_[at] == occupied_cell)
      return 0.5 * known_.frame.resolution_m * std::sqrt(squared_halves(offset));
  }
  return radius_m_ + options_.margin_m + options_.near_m;
}

std::uint32_t TraversabilityGrid::block_of(std::uint32_t cell) const {
  const Cell c = known_.frame.cell(cell);
  return static_cast<std::uint32_t>(blocks_.frame.index({c.x / 2, c.y / 2}));
}

std::uint64_t& TraversabilityGrid::tile_of(Cell cell) {
  const int row = cell.y / tile_cells * tiles(known_.frame.width);
  return tiles_[static_cast<std::size_t>(row + cell.x / tile_cells)];
}

void TraversabilityGrid::note_change(std::uint32_t cell) { tile_of(known_.frame.cell(cell)) = ++clock_; }

std::uint64_t TraversabilityGrid::changed_within(Cell low, Cell high) const {
  const int across = tiles(known_.frame.width), up = tiles(known_.frame.height);
  std::uint64_t last = 0;
  for (int y = std::max(0, low.y / tile_cells); y <= std::min(up - 1, high.y / tile_cells); ++y) {
    for (int x = std::max(0, low.x / tile_cells); x <= std::min(across - 1, high.x / tile_cells); ++x)
      last = std::max(last, tiles_[static_cast<std::size_t>(y * across + x)]);
  }
  return last;
}

/// Brings the blocks and the tiles up to date with the stale cells from that one on.
void TraversabilityGrid::settle(std::size_t from) {
  for (std::size_t i = from; i < stale_.size(); ++i) {
    tile_of(known_.frame.cell(stale_[i])) = clock_;
    const std::uint32_t block = block_of(stale_[i]);
    const Cell at = blocks_.frame.cell(block);
    bool is_free = false, is_wide = false;
    for (int k = 0; k < 4; ++k) {
      const auto cell = static_cast<std::uint32_t>(known_.frame.index({2 * at.x + k % 2, 2 * at.y + k / 2}));
      is_free = is_free || !blocked(cell);
      is_wide = is_wide || (!blocked(cell) && !near_wall(cell));
    }
    blocks_.cells[block] = is_wide ? free_block : is_free ? near_block : no_block;
  }
}

std::shared_ptr<const GridMap> TraversabilityGrid::grid() {
  if (!grid_ || stale_.size() > known_.frame.size() / 8) {
    Grid<std::uint8_t> taken(known_.frame);
    for (std::uint32_t cell = 0; cell < taken.cells.size(); ++cell) taken.cells[cell] = blocked(cell) ? 1 : 0;
    grid_ = std::make_shared<const GridMap>(*GridMap::of(taken, GridModel::cells));
  } else if (!stale_.empty()) {
    std::vector<CellChange> changes;
    for (const std::uint32_t cell : stale_) {
      const Cell at = known_.frame.cell(cell);
      if (blocked(cell) != grid_->blocked(at)) changes.push_back({at, 1, 1, blocked(cell)});
    }
    if (!changes.empty()) grid_ = std::make_shared<const GridMap>(*grid_->with(changes));
  }
  stale_.clear();
  return grid_;
}

}  // namespace outrider
