#include "routes_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "turn_time.hpp"

namespace outrider::routes {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

struct RouteLabel {
  double time_s = 0.0;
  double heading_rad = 0.0;
  std::uint32_t node = 0;
  std::uint32_t next_settled = no_label;  // next settled label of the same node
};

struct Best {
  double time_s = inf;
  double heading_rad = 0.0;
  double hopeless_s = inf;  // time_s plus a half turn: later labels are useless
};

struct WaitingLabel {
  double time_s;
  std::uint32_t label;

  friend bool operator<(const WaitingLabel& a, const WaitingLabel& b) {  // std heaps keep the largest on top
    return a.time_s != b.time_s ? a.time_s > b.time_s : a.label > b.label;
  }
};

class RouteTreeSearch {
 public:
  RouteTreeSearch(const RobotModel& robot, const SightLines& node_lines, const SightLines& target_lines,
                  const RouteQuery& query, RouteTree& tree)
      : turn_(robot.turning()),
        node_lines_(node_lines),
        target_lines_(target_lines),
        query_(query),
        tree_(tree),
        best_(node_lines.first.size() - 1),
        settled_(best_.size(), no_label) {}

  bool run(BudgetMeter& meter) {
    tree_.steps.clear();
    tree_.arrivals.assign(query_.targets, {});
    for (const SightLine& line : query_.direct) {
      arrive(line.to, line.drive_s, line.heading_rad, no_label);
    }
    for (const SightLine& line : query_.nodes) {
      push(line.to, line.drive_s, line.heading_rad, no_label);
    }
    for (std::size_t turn = 0; !queue_.empty(); ++turn) {
      if (turn % 64 == 0) look_ahead();
      std::pop_heap(queue_.begin(), queue_.end());
      const WaitingLabel next = queue_.back();
      queue_.pop_back();
      if (next.time_s >= horizon_s_) break;
      if (!settle(next.label)) continue;
      if (!meter.spend()) return false;
      expand(next.label);
    }
    note_departures();
    forget_unused_steps();
    return true;
  }

 private:
  void arrive(std::uint32_t target, double time_s, double heading_rad, std::uint32_t last) {
    Arrival& arrival = tree_.arrivals[target];
    if (time_s < arrival.drive.time_s) arrival = {{time_s, 0.0, heading_rad}, last};
  }

  void push(std::uint32_t node, double time_s, double heading_rad, std::uint32_t before) {
    Best& best = best_[node];
    if (time_s >= std::min(best.hopeless_s, horizon_s_)) return;
    if (time_s >= best.time_s + turn_(best.heading_rad, heading_rad)) return;
    if (time_s < best.time_s) best = {time_s, heading_rad, time_s + turn_.half_turn_s()};
    const auto label = static_cast<std::uint32_t>(labels_.size());
    labels_.push_back({time_s, heading_rad, node, no_label});
    tree_.steps.push_back({node, before});
    queue_.push_back({time_s, label});
    std::push_heap(queue_.begin(), queue_.end());
  }

  /// Settles a label; returns false if a settled label of the same node is as good after turning.
  bool settle(std::uint32_t index) {
    RouteLabel& label = labels_[index];
    for (std::uint32_t k = settled_[label.node]; k != no_label; k = labels_[k].next_settled) {
      if (labels_[k].time_s + turn_(labels_[k].heading_rad, label.heading_rad) <= label.time_s) return false;
    }
    label.next_settled = settled_[label.node];
    settled_[label.node] = index;
    return true;
  }

  void expand(std::uint32_t index) {
    const RouteLabel label = labels_[index];
    for (const SightLine& line : node_lines_.row(label.node)) {
      const double soonest = label.time_s + line.drive_s;
      if (soonest >= best_[line.to].hopeless_s) continue;
      push(line.to, soonest + turn_(label.heading_rad, line.heading_rad), line.heading_rad, index);
    }
    const auto targets = target_lines_.row(label.node);
    for (auto line = targets.rbegin(); line != targets.rend() && line->to >= query_.first_target; ++line) {
      const double soonest = label.time_s + line->drive_s;
      if (soonest >= tree_.arrivals[line->to].drive.time_s) continue;
      arrive(line->to, soonest + turn_(label.heading_rad, line->heading_rad), line->heading_rad, index);
    }
  }

  /// Updates the time after which no label can improve any arrival.
  void look_ahead() {
    horizon_s_ = 0.0;
    for (std::uint32_t k = query_.first_target; k < query_.targets; ++k) {
      horizon_s_ = std::max(horizon_s_, tree_.arrivals[k].drive.time_s);
    }
  }

  void note_departures() {
    for (Arrival& arrival : tree_.arrivals) {
      std::uint32_t first = arrival.last;
      while (first != no_label && tree_.steps[first].before != no_label) first = tree_.steps[first].before;
      arrival.drive.departure_rad =
          first == no_label ? arrival.drive.arrival_rad : labels_[first].heading_rad;
    }
  }

  void forget_unused_steps() {
    std::vector<std::uint32_t> renumbered(tree_.steps.size(), no_label);
    for (const Arrival& arrival : tree_.arrivals) {
      for (std::uint32_t k = arrival.last; k != no_label && renumbered[k] == no_label;) {
        renumbered[k] = 0;
        k = tree_.steps[k].before;
      }
    }
    const auto now = [&](std::uint32_t k) { return k == no_label ? no_label : renumbered[k]; };
    std::vector<Step> used;
    for (std::uint32_t k = 0; k < tree_.steps.size(); ++k) {  // a step stands after the one before it
      if (renumbered[k] == no_label) continue;
      renumbered[k] = static_cast<std::uint32_t>(used.size());
      used.push_back({tree_.steps[k].node, now(tree_.steps[k].before)});
    }
    for (Arrival& arrival : tree_.arrivals) arrival.last = now(arrival.last);
    used.shrink_to_fit();
    tree_.steps = std::move(used);
  }

  TurnTime turn_;
  const SightLines& node_lines_;
  const SightLines& target_lines_;
  const RouteQuery& query_;
  RouteTree& tree_;
  std::vector<Best> best_;
  std::vector<std::uint32_t> settled_;  // by node: the newest settled label
  std::vector<RouteLabel> labels_;
  std::vector<WaitingLabel> queue_;
  double horizon_s_ = inf;
};

}  // namespace

bool search_routes(const RobotModel& robot, const SightLines& node_lines, const SightLines& target_lines,
                   const RouteQuery& query, BudgetMeter& meter, RouteTree& tree) {
  return RouteTreeSearch(robot, node_lines, target_lines, query, tree).run(meter);
}

std::vector<std::uint32_t> nodes_to(const RouteTree& tree, std::uint32_t target) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t k = tree.arrivals[target].last; k != no_label; k = tree.steps[k].before) {
    nodes.push_back(tree.steps[k].node);
  }
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace outrider::routes
