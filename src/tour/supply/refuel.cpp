#include "supply/refuel.hpp"

namespace outrider::tour {
namespace {

struct RefuelLabel {
  Fuel fuel;
  std::uint32_t choice = none;
  std::uint32_t parent = none;
};

bool same_pose(const State& a, const State& b) {
  return a.stop == b.stop && a.heading == b.heading && a.yaw == b.yaw && a.pitch == b.pitch;
}

bool no_worse(const Fuel& a, const Fuel& b) {
  return a.time <= b.time && a.water >= b.water && a.charge >= b.charge && same_pose(a.state, b.state);
}

class Refuelling {
 public:
  Refuelling(const Supplied& supplied, const RefuelLimits& limits) : supplied_(supplied), limits_(limits) {
    labels_.push_back({full_at_start(supplied), none, none});
    layer_.push_back(0);
  }

  /// Serves the node from every label of the layer, directly and by depots; false when nothing can.
  bool go_on(std::uint32_t node) {
    next_.clear();
    for (const std::uint32_t label : layer_) extend(label, node, 0);
    if (next_.empty()) return false;
    thin_out();
    layer_ = next_;
    return true;
  }

  [[nodiscard]] Refuelled best() const {
    Refuelled result;
    std::uint32_t label = layer_.front();  // the soonest
    result.time = labels_[label].fuel.time;
    for (; labels_[label].choice != none; label = labels_[label].parent) {
      result.choices.push_back(labels_[label].choice);
    }
    std::ranges::reverse(result.choices);
    return result;
  }

 private:
  void extend(std::uint32_t label, std::uint32_t node, std::size_t depth) {
    Fuel served = labels_[label].fuel;
    if (serve(supplied_, served, supplied_.instance.nodes[node])) add({served, node, label});
    if (depth == limits_.chain) return;
    for (std::uint32_t d = 0; d < supplied_.depots.size(); ++d) {
      const FuelStation& depot = supplied_.depots[d];
      Fuel filled = labels_[label].fuel;
      const double level = depot.store == Store::water ? filled.water : filled.charge;
      const double full = depot.store == Store::water ? supplied_.water : supplied_.charge;
      if (level >= full || !fill(supplied_, filled, depot)) continue;
      const auto choice = static_cast<std::uint32_t>(supplied_.instance.nodes.size() + d);
      labels_.push_back({filled, choice, label});
      extend(static_cast<std::uint32_t>(labels_.size() - 1), node, depth + 1);
    }
  }
  void add(const RefuelLabel& label) {
    for (const std::uint32_t other : next_) {
      if (no_worse(labels_[other].fuel, label.fuel)) return;
    }
    std::erase_if(next_, [&](std::uint32_t other) { return no_worse(label.fuel, labels_[other].fuel); });
    next_.push_back(static_cast<std::uint32_t>(labels_.size()));
    labels_.push_back(label);
  }
  /// Soonest first; of more than the limit, the last place goes to the one with the most charge.
  void thin_out() {
    const auto sooner = [&](std::uint32_t i) { return std::pair(labels_[i].fuel.time, i); };
    std::ranges::sort(next_, {}, sooner);
    if (next_.size() <= limits_.labels) return;
    const auto most = std::ranges::max_element(
        next_.begin() + static_cast<std::ptrdiff_t>(limits_.labels) - 1, next_.end(), {},
        [&](std::uint32_t i) { return std::min(labels_[i].fuel.charge, 1e300); });
    next_[limits_.labels - 1] = *most;
    next_.resize(limits_.labels);
  }

  const Supplied& supplied_;
  RefuelLimits limits_;
  std::vector<RefuelLabel> labels_;
  std::vector<std::uint32_t> layer_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

Refuelled refuel(const Supplied& supplied, const std::vector<std::uint32_t>& nodes,
                 const RefuelLimits& limits) {
  Refuelling refuelling(supplied, limits);
  std::vector<std::uint32_t> dropped;
  for (const std::uint32_t node : nodes) {
    if (!refuelling.go_on(node)) dropped.push_back(supplied.instance.nodes[node].goal);
  }
  Refuelled result = refuelling.best();
  std::ranges::sort(dropped);
  result.dropped = std::move(dropped);
  return result;
}

}  // namespace outrider::tour
