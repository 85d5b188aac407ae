#include "sweeps/tube_search.hpp"

#include <utility>

namespace outrider {
namespace {

constexpr int first_radius = 4;      // cells
constexpr std::uint64_t much = 200;  // a gain of 1/200 of the cost is worth another tube of that radius
constexpr int row_overhead = 64;     // cells swept in the time that a row takes in addition
constexpr std::uint64_t most_cells = std::uint64_t{1} << 24U;  // in memory

}  // namespace

TubeSearch::TubeSearch(const AnySweepMap& map, const PursuitField& field, std::span<const CellBox> boxes,
                       std::uint64_t most_work)
    : map_(&map), field_(&field), boxes_(boxes), most_work_(most_work), radius_(first_radius) {}

/// Begins the sweep of a tube. Returns false if that is too much work.
bool TubeSearch::open(std::span<const Cell> path) {
  std::vector<CellBox> tube(static_cast<std::size_t>(field_->start_s));
  std::uint64_t cells = 0;
  for (std::size_t s = tube.size(); s < boxes_.size(); ++s) {
    const Cell axis = s < path.size() ? path[s] : field_->cell(field_->target[s]);
    const CellBox box = common(boxes_[s], CellBox{axis, axis}.grown(radius_));
    if (box.empty()) break;
    cells +=
        static_cast<std::uint64_t>(box.height()) * static_cast<std::uint64_t>(box.width() + row_overhead);
    tube.push_back(box);
  }
  if (cells > most_cells || cells > most_work_ || tube.size() < static_cast<std::size_t>(field_->start_s) + 2)
    return false;
  most_work_ -= cells;
  sweep_ = stored_sweep(*map_, std::move(tube));
  return true;
}

std::optional<TimedWay> TubeSearch::next_better(BudgetMeter& meter, std::span<const Cell> path,
                                                std::uint64_t cost) {
  while (!exhausted_) {
    if (!sweep_ && !open(path)) {
      exhausted_ = true;
      break;
    }
    while (sweep_->second() > field_->start_s) {
      if (!sweep_->advance(meter, cost)) return std::nullopt;
    }
    const auto swept = std::exchange(sweep_, nullptr);
    const std::uint64_t found = swept->to_go(field_->start);
    if (found >= cost || cost - found < cost / much) radius_ *= 2;
    if (found < cost) return swept->way_from(field_->start);
  }
  return std::nullopt;
}

}  // namespace outrider
