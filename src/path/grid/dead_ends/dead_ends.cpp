#include "dead_ends.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace outrider {
namespace {

/// Sets of numbers that are joined.
class Sets {
 public:
  Sets() = default;
  explicit Sets(std::uint32_t size) : parents_(size) { std::iota(parents_.begin(), parents_.end(), 0U); }
  std::uint32_t add() {
    parents_.push_back(static_cast<std::uint32_t>(parents_.size()));
    return parents_.back();
  }
  std::uint32_t find(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }
  [[nodiscard]] std::size_t size() const { return parents_.size(); }

 private:
  std::vector<std::uint32_t> parents_;
};

struct Gate {
  std::uint32_t first = 0;  // index of its lowest cell
  std::uint32_t length = 0;
  std::uint32_t along = 0;  // from one cell to the next: 1 in a row, a line of the map in a column
};

/// Cells are indices of the map. The border around the grid is blocked, so each free cell has neighbours.
class Builder {
 public:
  explicit Builder(const GridMap& ground)
      : ground_(ground),
        stride_(ground.stride),
        size_(static_cast<std::uint32_t>(ground.marks.size())),
        in_gate_(size_),
        runs_(size_, [this](std::uint32_t i) { return blocked(i) != blocked(i - 1); }),
        walls_(runs_.count()) {}

  DeadEnds build() {
    join_walls();
    choose_gates();
    cut_runs();
    join_areas();
    make_trees();
    return finish();
  }

 private:
  static constexpr std::uint32_t gate_bit = 1U << 31U;  // of a label: it is the number of a gate

  [[nodiscard]] bool blocked(std::uint32_t i) const { return (ground_.marks[i] & GridMap::blocked_bit) != 0; }

  /// Joins runs of blocked cells that touch. The border is one, also where it ends a row and begins the next.
  void join_walls() {
    RunCursor here(runs_), below(runs_);
    for (std::uint32_t i = 0; i < stride_; ++i) here.step(i);
    for (std::uint32_t i = stride_; i < size_; ++i) {
      here.step(i);
      below.step(i - stride_);
      if (blocked(i)) join_below(i, here.run(), below.run());
    }
  }

  /// Joins the run of a blocked cell with those that it touches in the row below.
  void join_below(std::uint32_t i, std::uint32_t run, std::uint32_t run_below) {
    const std::uint32_t below = i - stride_;
    const bool begins = runs_.begins(i);
    if (blocked(below)) {
      if (begins) walls_.join(run, run_below);
      return;  // the cell after it is of the same run, or free
    }
    if (begins && blocked(below - 1)) walls_.join(run, run_below - 1);
    if (blocked(below + 1)) walls_.join(run, run_below + 1);
  }

  /// Adds the runs along rows or columns that are gates and end a stretch of equal ones.
  void add_candidates(std::uint32_t along, std::uint32_t across, std::vector<Gate>& gates) {
    const std::uint32_t lines = along == 1 ? size_ / stride_ : stride_, length = size_ / lines;
    for (std::uint32_t line = across; line < (lines - 1) * across; line += across) {
      const std::uint32_t end = line + (length - 1) * along;
      for (std::uint32_t i = line + along; i < end; i += along) {
        if (blocked(i)) continue;
        const std::uint32_t begin = i;
        while (!blocked(i)) i += along;
        const Gate gate{begin, (i - begin) / along, along};
        if (gate.length <= DeadEnds::Area::most_length &&
            walls_.find(runs_.at(begin - along)) == walls_.find(runs_.at(i)) && ends_stretch(gate, across)) {
          gates.push_back(gate);
        }
      }
    }
  }

  /// Returns true if both sides of the gate hold free cells, and one of them is not an equal run.
  [[nodiscard]] bool ends_stretch(const Gate& gate, std::uint32_t across) const {
    const std::uint32_t before = gate.first - gate.along, after = gate.first + gate.length * gate.along;
    std::uint32_t lower = 0, higher = 0;
    for (std::uint32_t i = gate.first; i != after; i += gate.along) {
      lower += blocked(i - across) ? 0 : 1;
      higher += blocked(i + across) ? 0 : 1;
    }
    const bool equal_lower = lower == gate.length && blocked(before - across) && blocked(after - across);
    const bool equal_higher = higher == gate.length && blocked(before + across) && blocked(after + across);
    return lower > 0 && higher > 0 && !(equal_lower && equal_higher);
  }

  /// Takes the shortest gates that do not cross, and marks their cells.
  void choose_gates() {
    std::vector<Gate> candidates;
    add_candidates(1, stride_, candidates);
    add_candidates(stride_, 1, candidates);
    walls_ = {};
    std::sort(candidates.begin(), candidates.end(), [](const Gate& a, const Gate& b) {
      return std::tie(a.length, a.along, a.first) < std::tie(b.length, b.along, b.first);
    });
    for (const Gate& gate : candidates) {
      const std::uint32_t after = gate.first + gate.length * gate.along;
      std::uint32_t i = gate.first;
      while (i != after && !in_gate_[i]) i += gate.along;
      if (i != after) continue;
      for (i = gate.first; i != after; i += gate.along) in_gate_[i] = true;
      gates_.push_back(gate);
    }
  }

  /// Cuts the runs at the gates, and labels those of the gates.
  void cut_runs() {
    for (const auto& [first, length, along] : gates_) {  // one along a row is a whole run
      for (std::uint32_t i = first; along != 1 && i != first + length * along; i += along) {
        runs_.begin_at(i);
        runs_.begin_at(i + 1);
      }
    }
    runs_.number();
    labels_.assign(runs_.count(), DeadEnds::none);
    for (std::size_t number = 0; number < gates_.size(); ++number) {
      const auto& [first, length, along] = gates_[number];
      for (std::uint32_t i = first; i != first + length * along; i += along) {
        labels_[runs_.at(i)] = gate_bit + static_cast<std::uint32_t>(number);
        if (along == 1) break;
      }
    }
  }

  /// Returns the side of a gate as a member of areas_.
  static std::uint32_t lower_side(std::uint32_t gate) { return 2 * gate; }
  static std::uint32_t higher_side(std::uint32_t gate) { return 2 * gate + 1; }

  /// Joins the runs of free cells that no gate parts, and with them the sides of the gates that they touch.
  void join_areas() {
    for (std::size_t i = 0; i < 2 * gates_.size(); ++i) areas_.add();
    RunCursor here(runs_), below(runs_);
    for (std::uint32_t i = 0; i < stride_; ++i) here.step(i);
    for (std::uint32_t i = stride_; i < size_; ++i) {
      here.step(i);
      below.step(i - stride_);
      if (blocked(i)) continue;
      in_gate_[i] ? join_side_of_gate(i, here.run(), below.run()) : join_area(i, here.run(), below.run());
    }
  }
  void join_side_of_gate(std::uint32_t i, std::uint32_t run, std::uint32_t run_below) {
    const std::uint32_t gate = labels_[run] - gate_bit;
    const bool in_row = gates_[gate].along == 1;
    if (!blocked(i - (in_row ? stride_ : 1))) {
      areas_.join(lower_side(gate), area_towards_higher(in_row ? run_below : run - 1));
    }
  }
  void join_area(std::uint32_t i, std::uint32_t run, std::uint32_t run_below) {
    const bool begins = runs_.begins(i), opens = begins || blocked(i - stride_ - 1);
    if (begins) labels_[run] = areas_.add();
    if (begins && !blocked(i - 1)) areas_.join(labels_[run], area_towards_higher(run - 1));
    const std::uint32_t below = i - stride_;
    if (!blocked(below) && (opens || in_gate_[below] || in_gate_[below - 1])) {
      areas_.join(labels_[run], area_towards_higher(run_below));
    }
  }
  [[nodiscard]] static bool of_gate(std::uint32_t label) { return label >= gate_bit; }
  /// Returns the area of a run of free cells, as seen from the next higher cell.
  [[nodiscard]] std::uint32_t area_towards_higher(std::uint32_t run) const {
    return of_gate(labels_[run]) ? higher_side(labels_[run] - gate_bit) : labels_[run];
  }

  /// Numbers the areas of each tree from its root on.
  void make_trees() {
    const auto sides = static_cast<std::uint32_t>(2 * gates_.size());
    first_.assign(areas_.size() + 1, 0);
    for (std::uint32_t side = 0; side < sides; ++side) ++first_[areas_.find(side) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    beside_.resize(sides);
    std::vector<std::uint32_t> next(first_);
    for (std::uint32_t side = 0; side < sides; ++side) beside_[next[areas_.find(side)]++] = side;

    numbers_.assign(areas_.size(), DeadEnds::none);
    behind_.assign(gates_.size(), DeadEnds::none);
    for (std::uint32_t set = 0; set < areas_.size(); ++set) {
      if (areas_.find(set) == set && numbers_[set] == DeadEnds::none) make_tree(set);
    }
  }

  void make_tree(std::uint32_t root) {
    auto number = static_cast<std::uint32_t>(found_.areas.size());
    numbers_[root] = number;
    found_.areas.emplace_back();
    for (std::vector<std::uint32_t> sets = {root}; number < found_.areas.size(); ++number) {
      const std::uint32_t set = sets[number - numbers_[root]];
      for (std::uint32_t k = first_[set]; k < first_[set + 1]; ++k) {
        const std::uint32_t gate = beside_[k] / 2, other = areas_.find(beside_[k] ^ 1U);
        if (numbers_[other] != DeadEnds::none) continue;
        numbers_[other] = behind_[gate] = static_cast<std::uint32_t>(found_.areas.size());
        const auto& [first, length, along] = gates_[gate];
        found_.areas.emplace_back(number, first, length, along == 1);
        sets.push_back(other);
      }
    }
  }
  /// Keeps the labels of the runs of free cells.
  DeadEnds finish() {
    found_.labels.emplace_back();  // of the first run, which is blocked
    for (std::uint32_t label : labels_) {
      if (label == DeadEnds::none) continue;
      label = of_gate(label) ? 2 * behind_[label - gate_bit] + 1 : 2 * numbers_[areas_.find(label)];
      const auto byte = [label](unsigned i) { return static_cast<std::uint8_t>(label >> (8 * i) & 255U); };
      found_.labels.push_back({byte(0), byte(1), byte(2)});
    }
    found_.labels.shrink_to_fit();
    found_.areas.shrink_to_fit();
    runs_.join([this](std::uint32_t i) { return !blocked(i); });
    found_.runs = std::move(runs_);
    found_.stride = stride_;
    return std::move(found_);
  }

  const GridMap& ground_;
  std::uint32_t stride_;
  std::uint32_t size_;
  std::vector<bool> in_gate_;          // by cell
  RowRuns runs_;                       // of blocked and free cells, later cut at gates
  std::vector<std::uint32_t> labels_;  // by run: gates and members of areas_, in the end as in DeadEnds
  Sets walls_;                         // of runs that are not cut
  Sets areas_;                         // of the two sides of each gate and runs of free cells
  std::vector<Gate> gates_;
  std::vector<std::uint32_t> first_, beside_;  // the sides of gates in each set of areas_
  std::vector<std::uint32_t> numbers_;         // of the areas, by set
  std::vector<std::uint32_t> behind_;          // the area behind each gate
  DeadEnds found_;
};

}  // namespace

DeadEnds dead_ends_of(const GridMap& ground) { return Builder(ground).build(); }

}  // namespace outrider
