#include "sweeps/backward_sweep.hpp"

#include <cmath>

namespace outrider {
namespace {

constexpr int seconds_at_once = 8;  // costs spread by one block in that time, or by two

template <class Cost>
constexpr int growth = (seconds_at_once + row_block<Cost> - 1) / row_block<Cost>;

/// Spends the units that are owed; returns false if the budget ended first.
bool pay(std::uint64_t& owed, BudgetMeter& meter) {
  for (; owed > 0; --owed) {
    if (!meter.spend()) return false;
  }
  return true;
}

/// Returns the distance of kept layers that takes the least memory: the kept layers, and the cells that are
/// computed again between two of them, a pyramid of 4/3 distance^3 cells.
int best_distance(const std::vector<CellBox>& boxes) {
  std::uint64_t cells = 0;
  for (const CellBox& box : boxes) cells += box.area();
  const double distance = std::sqrt(std::sqrt(static_cast<double>(cells) / 4.0));
  return seconds_at_once * (1 + static_cast<int>(distance) / seconds_at_once);
}

/// Blocks of a row from low to high; none if high is below low.
struct BlockSpan {
  int low = 0, high = -1;
  [[nodiscard]] bool empty() const { return high < low; }
};

BlockSpan around(BlockSpan a, BlockSpan b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Outside the spans every cost to go is no_catch. A group of eight seconds is swept with the same spans, as
/// much wider as costs spread in that time; then the ends of the spans that do not matter are cut off.
template <class Cost>
class FullSweep final : public BackwardSweep {
 public:
  FullSweep(const SweepMap<Cost>& map, std::vector<CellBox> boxes, const ForwardBound* bound)
      : map_(&map),
        boxes_(std::move(boxes)),
        bound_(bound),
        distance_(best_distance(boxes_)),
        last_(static_cast<int>(boxes_.size()) - 1),
        second_(last_),
        to_go_(map.costs.size(), no_catch<Cost>),
        windows_(seconds_at_once, RowWindow<Cost>(map.stride)),
        cut_(static_cast<std::size_t>(map.field->box().height()) + 2 * seconds_at_once),
        spans_(cut_.size()) {
    if (const auto goal = map.goal(last_)) set_goal(*goal, last_), include(*goal);
    keep();
  }

  bool advance(BudgetMeter& meter, std::uint64_t best) override {
    if (group_ == 0 || second_ - group_ < map_->field->start_s) prepare_group();
    if (!pay(owed_, meter)) return false;
    sweep_group();
    second_ -= group_;
    group_ = 0;
    cut_spans(best);
    if ((last_ - second_) % distance_ == 0) keep();
    return true;
  }
  [[nodiscard]] int second() const override { return second_; }
  [[nodiscard]] std::uint64_t to_go(CellIndex cell) const override {
    return map_->to_go(to_go_[map_->index(map_->field->cell(cell))], second_);
  }
  [[nodiscard]] TimedWay way_from(CellIndex cell) const override;
  [[nodiscard]] std::uint64_t way_work() const override {
    const auto d = static_cast<std::uint64_t>(distance_);
    return static_cast<std::uint64_t>(last_ - second_) * d * d * 4 / 3;
  }
  [[nodiscard]] std::uint64_t work() const override { return work_; }

 private:
  [[nodiscard]] const CellBox& box(int second) const { return boxes_[static_cast<std::size_t>(second)]; }
  /// Rows below and above the map have spans too, which are empty.
  [[nodiscard]] static std::size_t at(int y) { return static_cast<std::size_t>(y + seconds_at_once); }
  [[nodiscard]] Cost* block(int block, int y) {
    return to_go_.data() + map_->index({block * row_block<Cost>, y});
  }

  void set_goal(Cell goal, int second) { to_go_[map_->index(goal)] = static_cast<Cost>(map_->delay(second)); }

  /// Makes the spans include a cell.
  void include(Cell c) {
    const int block = c.x / row_block<Cost>;
    cut_[at(c.y)] = around(cut_[at(c.y)], {block, block});
    rows_ = outrider::around(rows_, {0, c.y});
  }

  void prepare_group();
  void sweep_group();
  void sweep_row(int level, int y);
  void cut_spans(std::uint64_t best);
  [[nodiscard]] bool matters(int block, int y, std::uint64_t best) const;
  void keep();

  const SweepMap<Cost>* map_;
  std::vector<CellBox> boxes_;
  const ForwardBound* bound_;
  int distance_;  // of kept layers
  int last_;      // second of the first layer kept
  int second_;
  int group_ = 0;           // seconds that are swept next
  std::uint64_t owed_ = 0;  // expansions to pay for them
  std::uint64_t work_ = 0;  // cells swept
  std::vector<Cost, AlignedAllocator<Cost>> to_go_;
  std::vector<RowWindow<Cost>> windows_;
  std::vector<BlockSpan> cut_;           // of the present layer
  std::vector<BlockSpan> spans_;         // of the group
  CellBox rows_;                         // from the lowest row with a span to the highest
  std::vector<StoredLayer<Cost>> kept_;  // of last_, last_ - distance_, ...
};

template <class Cost>
void FullSweep<Cost>::prepare_group() {
  group_ = 0;
  while (group_ < seconds_at_once && group_ < second_ - map_->field->start_s &&
         !box(second_ - group_ - 1).empty())
    ++group_;
  const CellBox map = map_->field->box();
  for (int s = second_ - group_; s < second_; ++s) {
    const auto goal = map_->goal(s);
    if (goal && box(s).has(*goal)) include(*goal);
  }
  const int low = std::max(0, rows_.low.y - group_), high = std::min(map.high.y, rows_.high.y + group_);
  for (int y = low; y <= high; ++y) {
    BlockSpan span;
    for (int k = y - group_; k <= y + group_; ++k) span = around(span, cut_[at(k)]);
    if (!span.empty())
      span = {std::max(0, span.low - growth<Cost>), std::min(map_->blocks - 1, span.high + growth<Cost>)};
    spans_[at(y)] = span;
    if (!span.empty()) owed_ += static_cast<std::uint64_t>(group_);
    work_ += static_cast<std::uint64_t>(span.high - span.low + 1) * row_block<Cost> *
             static_cast<std::uint64_t>(group_);
  }
  rows_.low.y = low;
  rows_.high.y = high;
}

/// In the order of rows: each row of the first second of the group, the row below it of the second, ...
template <class Cost>
void FullSweep<Cost>::sweep_group() {
  for (int y = rows_.low.y; y < rows_.high.y + group_; ++y) {
    for (int level = 0; level < group_; ++level) sweep_row(level, y - level);
  }
}

template <class Cost>
void FullSweep<Cost>::sweep_row(int level, int y) {
  if (y < rows_.low.y || y > rows_.high.y) return;
  const BlockSpan span = spans_[at(y)];
  if (span.empty()) return;
  RowWindow<Cost>& window = windows_[static_cast<std::size_t>(level)];
  const auto narrow = [&](int row) {
    const BlockSpan wide = around(around(spans_[at(row - 1)], spans_[at(row)]), spans_[at(row + 1)]);
    const int x = wide.low * row_block<Cost>;
    map_->kernel->narrow(block(wide.low, row), window.row(row) + x, (wide.high + 1) * row_block<Cost> - x);
  };
  if (spans_[at(y - 1)].empty()) narrow(y - 1), narrow(y);
  narrow(y + 1);
  const int x = span.low * row_block<Cost>, end = (span.high + 1) * row_block<Cost>;
  map_->kernel->settle(window.row(y - 1) + x, window.row(y) + x, window.row(y + 1) + x,
                       map_->costs.data() + map_->index({x, y}), block(span.low, y), end - x);
  const int second = second_ - 1 - level;
  if (const auto goal = map_->goal(second); goal && goal->y == y && box(second).has(*goal))
    set_goal(*goal, second);
}

/// Returns true if a catch of less than `best` may lead through a cell of the block.
template <class Cost>
bool FullSweep<Cost>::matters(int block, int y, std::uint64_t best) const {
  const CellBox& here = box(second_);
  const int first = std::max(here.low.x, block * row_block<Cost>);
  const int last = std::min(here.high.x, block * row_block<Cost> + row_block<Cost> - 1);
  if (y < here.low.y || y > here.high.y) return false;
  for (int x = first; x <= last; ++x) {
    const std::uint64_t to_go = map_->to_go(to_go_[map_->index({x, y})], second_);
    if (to_go == unreachable) continue;
    const std::uint64_t before = std::uint64_t{map_->field->cheapest} * static_cast<std::uint64_t>(second_);
    if (bound_ == nullptr ? to_go + before < best
                          : bound_->allows(map_->field->index({x, y}), second_, to_go, best))
      return true;
  }
  return false;
}

template <class Cost>
void FullSweep<Cost>::cut_spans(std::uint64_t best) {
  CellBox rows;
  const auto cut_off = [&](int which, int y) {
    std::fill_n(block(which, y), row_block<Cost>, no_catch<Cost>);
  };
  for (int y = rows_.low.y; y <= rows_.high.y; ++y) {
    BlockSpan span = spans_[at(y)];
    for (; !span.empty() && !matters(span.low, y, best); ++span.low) cut_off(span.low, y);
    for (; !span.empty() && !matters(span.high, y, best); --span.high) cut_off(span.high, y);
    cut_[at(y)] = span;
    spans_[at(y)] = {};
    if (!span.empty()) rows = outrider::around(rows, {0, y});
  }
  rows_ = rows;
}

/// Keeps the box around the spans.
template <class Cost>
void FullSweep<Cost>::keep() {
  CellBox box;
  for (int y = rows_.low.y; y <= rows_.high.y; ++y) {
    const BlockSpan span = cut_[at(y)];
    if (span.empty()) continue;
    box = outrider::around(outrider::around(box, {span.low * row_block<Cost>, y}),
                           {(span.high + 1) * row_block<Cost> - 1, y});
  }
  StoredLayer<Cost>& layer = kept_.emplace_back(box);
  for (int y = box.low.y; y <= box.high.y; ++y) {
    const Cost* row = to_go_.data() + map_->index({box.low.x, y});
    std::copy(row, row + box.width(), layer.row(y));
  }
}

template <class Cost>
TimedWay FullSweep<Cost>::way_from(CellIndex cell) const {
  TimedWay way{{cell}, 0};
  for (int s = second_;;) {
    const int kept = (last_ - s - 1) / distance_, until = last_ - kept * distance_;
    const Cell at = map_->field->cell(way.cells.back());
    std::vector<StoredLayer<Cost>> layers(static_cast<std::size_t>(until - s));
    layers.back() = kept_[static_cast<std::size_t>(kept)];
    for (int k = until - 1; k > s; --k) {
      const CellBox near = common(box(k), CellBox{at, at}.grown(k - s));
      auto* layer = &layers[static_cast<std::size_t>(k - s - 1)];
      *layer = layer_before(*map_, layer[1], near, k);
    }
    const bool caught = descend<Cost>(*map_, layers, s + 1, way.cells);
    if (caught || until == last_) break;
    s = until;
  }
  way.second = second_ + static_cast<int>(way.cells.size()) - 1;
  return way;
}

template <class Cost>
class StoredSweep final : public BackwardSweep {
 public:
  StoredSweep(const SweepMap<Cost>& map, std::vector<CellBox> boxes)
      : map_(&map),
        boxes_(std::move(boxes)),
        layers_(boxes_.size()),
        second_(static_cast<int>(boxes_.size())) {
    settle();
  }
  bool advance(BudgetMeter& meter, std::uint64_t) override {
    if (owed_ == 0)
      owed_ = static_cast<std::uint64_t>(boxes_[static_cast<std::size_t>(second_ - 1)].height());
    if (!pay(owed_, meter)) return false;
    settle();
    return true;
  }
  [[nodiscard]] int second() const override { return second_; }
  [[nodiscard]] std::uint64_t to_go(CellIndex cell) const override {
    return map_->to_go(layers_[static_cast<std::size_t>(second_)].at(map_->field->cell(cell)), second_);
  }
  [[nodiscard]] TimedWay way_from(CellIndex cell) const override {
    TimedWay way{{cell}, 0};
    const std::span<const StoredLayer<Cost>> layers(layers_);
    descend(*map_, layers.subspan(static_cast<std::size_t>(second_) + 1), second_ + 1, way.cells);
    way.second = second_ + static_cast<int>(way.cells.size()) - 1;
    return way;
  }
  [[nodiscard]] std::uint64_t way_work() const override { return static_cast<std::uint64_t>(boxes_.size()); }
  [[nodiscard]] std::uint64_t work() const override { return work_; }

 private:
  void settle() {
    const auto at = static_cast<std::size_t>(--second_);
    const StoredLayer<Cost> none;
    work_ += boxes_[at].area();
    layers_[at] = layer_before(*map_, at + 1 < layers_.size() ? layers_[at + 1] : none, boxes_[at], second_);
  }

  const SweepMap<Cost>* map_;
  std::vector<CellBox> boxes_;
  std::vector<StoredLayer<Cost>> layers_;
  int second_;
  std::uint64_t owed_ = 0;
  std::uint64_t work_ = 0;
};

}  // namespace

AnySweepMap sweep_map(const PursuitField& field, int earliest_catch, std::uint64_t best,
                      Processor processor) {
  const std::uint64_t anyhow = std::uint64_t{field.cheapest} * static_cast<std::uint64_t>(earliest_catch);
  const auto map = [&]<class Cost>(Cost) {
    return SweepMap<Cost>(field, earliest_catch, row_kernel<Cost>(processor));
  };
  if (best - anyhow <= no_catch<std::uint16_t>) return map(std::uint16_t{});
  if (best - anyhow <= static_cast<std::uint64_t>(no_catch<std::int32_t>)) return map(std::int32_t{});
  return map(std::int64_t{});
}

std::unique_ptr<BackwardSweep> full_sweep(const AnySweepMap& map, std::vector<CellBox> boxes,
                                          const ForwardBound* bound) {
  return std::visit(
      [&]<class Cost>(const SweepMap<Cost>& of) -> std::unique_ptr<BackwardSweep> {
        return std::make_unique<FullSweep<Cost>>(of, std::move(boxes), bound);
      },
      map);
}

std::unique_ptr<BackwardSweep> stored_sweep(const AnySweepMap& map, std::vector<CellBox> boxes) {
  return std::visit(
      [&]<class Cost>(const SweepMap<Cost>& of) -> std::unique_ptr<BackwardSweep> {
        return std::make_unique<StoredSweep<Cost>>(of, std::move(boxes));
      },
      map);
}

}  // namespace outrider
