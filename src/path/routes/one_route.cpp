#include "one_route.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "turn_time.hpp"

namespace outrider::routes {
namespace {

constexpr std::uint32_t none = 0xffffffffU;

/// A node that is got to, with the heading on arrival.
struct Label {
  double time_s = 0.0;
  double heading_rad = 0.0;
  std::uint32_t node = 0;
  std::uint32_t before = none;        // the label that the last leg came from
  std::uint32_t next_settled = none;  // next settled label of the same node
};

/// An entry of the queue: a label to settle, or a leg that is still to be tested.
struct LabelOrLeg {
  enum class Kind : std::uint8_t { label, from_start, to_goal };

  double least_s = 0.0;  ///< of all routes with it
  Kind kind = Kind::label;
  std::uint32_t index = 0;  ///< a label, or the node from the start; to the goal `none` for the start itself

  friend bool operator<(const LabelOrLeg& a, const LabelOrLeg& b) {  // std heaps keep the largest on top
    if (a.least_s != b.least_s) return a.least_s > b.least_s;
    return a.kind != b.kind ? a.kind > b.kind : a.index > b.index;
  }
};

class OneRouteSearch {
 public:
  OneRouteSearch(const NodeGraph& graph, const Pose2& start, Vec2 goal)
      : graph_(graph),
        start_(start),
        goal_(goal),
        turn_(graph.robot.turning()),
        best_(graph.nodes.size()),
        settled_(graph.nodes.size(), none),
        sees_goal_(graph.nodes.size(), Sight::untested) {}

  Outcome<std::vector<Vec2>> run(BudgetMeter& meter) {
    leave_start();
    while (!queue_.empty()) {
      if (!meter.spend()) return meter.refusal();
      std::pop_heap(queue_.begin(), queue_.end());
      const LabelOrLeg next = queue_.back();
      queue_.pop_back();
      switch (next.kind) {
        case LabelOrLeg::Kind::label:
          if (settle(next.index)) expand(next.index);
          break;
        case LabelOrLeg::Kind::from_start: try_from_start(next.index); break;
        case LabelOrLeg::Kind::to_goal:
          if (is_arrival(next)) return waypoints(next.index);
          break;
      }
    }
    return std::vector<Vec2>{};
  }

 private:
  enum class Sight : std::uint8_t { untested, free, blocked };

  /// The shortest label of a node so far.
  struct Best {
    double time_s = std::numeric_limits<double>::infinity();
    double heading_rad = 0.0;
  };

  [[nodiscard]] double straight_s(Vec2 from, Vec2 to) const {
    return duration(distance(from, to), graph_.robot.straight());
  }
  /// On a slope longer than straight_s().
  [[nodiscard]] double drive_s(Vec2 from, Vec2 to) const {
    return duration(graph_.ground.length({from, to}), graph_.robot.straight());
  }
  [[nodiscard]] bool is_free(Vec2 from, Vec2 to) const {
    return graph_.ground.segment_free({from, to}, graph_.robot.radius_m);
  }

  void wait(const LabelOrLeg& waiting) {
    queue_.push_back(waiting);
    std::push_heap(queue_.begin(), queue_.end());
  }

  void leave_start() {
    const Vec2 from = start_.position;
    queue_.push_back({straight_s(from, goal_), LabelOrLeg::Kind::to_goal, none});
    for (std::uint32_t k = 0; k < graph_.nodes.size(); ++k) {
      const Vec2 at = graph_.nodes[k].at;
      if (distance(from, at) <= same_place_m || !graph_.nodes[k].is_touched_from(from)) continue;
      queue_.push_back({straight_s(from, at) + straight_s(at, goal_), LabelOrLeg::Kind::from_start, k});
    }
    std::make_heap(queue_.begin(), queue_.end());
  }

  void try_from_start(std::uint32_t node) {
    const Vec2 from = start_.position, at = graph_.nodes[node].at;
    if (!is_free(from, at)) return;
    const double heading = heading_of(at - from);
    push({turn_(start_.heading_rad, heading) + drive_s(from, at), heading, node});
  }

  void push(const Label& label) {
    Best& best = best_[label.node];
    if (label.time_s >= best.time_s + turn_(best.heading_rad, label.heading_rad)) return;
    if (label.time_s < best.time_s) best = {label.time_s, label.heading_rad};
    const auto index = static_cast<std::uint32_t>(labels_.size());
    labels_.push_back(label);
    wait({label.time_s + straight_s(graph_.nodes[label.node].at, goal_), LabelOrLeg::Kind::label, index});
  }

  /// Settles a label; returns false if a settled label of the same node is as good after turning.
  bool settle(std::uint32_t index) {
    Label& label = labels_[index];
    for (std::uint32_t k = settled_[label.node]; k != none; k = labels_[k].next_settled) {
      if (labels_[k].time_s + turn_(labels_[k].heading_rad, label.heading_rad) <= label.time_s) return false;
    }
    label.next_settled = settled_[label.node];
    settled_[label.node] = index;
    return true;
  }

  void expand(std::uint32_t index) {
    const Label label = labels_[index];
    for (const SightLine& line : graph_.lines.row(label.node)) {
      const double soonest = label.time_s + line.drive_s;
      if (soonest >= best_[line.to].time_s + turn_.half_turn_s()) continue;
      push({soonest + turn_(label.heading_rad, line.heading_rad), line.heading_rad, line.to, index});
    }
    const Node& node = graph_.nodes[label.node];
    if (sees_goal_[label.node] == Sight::blocked || !node.is_touched_from(goal_)) return;
    if (distance(node.at, goal_) <= same_place_m) return;
    wait({label.time_s + turn_(label.heading_rad, heading_of(goal_ - node.at)) + straight_s(node.at, goal_),
          LabelOrLeg::Kind::to_goal, index});
  }

  /// Returns true if the leg to the goal is free and none that waits may be sooner there.
  bool is_arrival(const LabelOrLeg& waiting) {
    const bool at_start = waiting.index == none;
    const Vec2 from = at_start ? start_.position : graph_.nodes[labels_[waiting.index].node].at;
    const double heading = heading_of(goal_ - from);
    const double arrival_s =
        (at_start ? turn_(start_.heading_rad, heading)
                  : labels_[waiting.index].time_s + turn_(labels_[waiting.index].heading_rad, heading)) +
        drive_s(from, goal_);
    Sight& sight = at_start ? start_sees_goal_ : sees_goal_[labels_[waiting.index].node];
    if (sight == Sight::untested) sight = is_free(from, goal_) ? Sight::free : Sight::blocked;
    if (sight == Sight::blocked) return false;
    if (arrival_s <= waiting.least_s) return true;
    wait({arrival_s, LabelOrLeg::Kind::to_goal, waiting.index});
    return false;
  }

  [[nodiscard]] std::vector<Vec2> waypoints(std::uint32_t last) const {
    std::vector<Vec2> points{goal_};
    for (std::uint32_t k = last; k != none; k = labels_[k].before)
      points.push_back(graph_.nodes[labels_[k].node].at);
    points.push_back(start_.position);
    std::ranges::reverse(points);
    return points;
  }

  const NodeGraph& graph_;
  Pose2 start_;
  Vec2 goal_;
  TurnTime turn_;
  std::vector<Best> best_;
  std::vector<std::uint32_t> settled_;  // by node: the newest settled label
  std::vector<Sight> sees_goal_;        // by node
  Sight start_sees_goal_ = Sight::untested;
  std::vector<Label> labels_;
  std::vector<LabelOrLeg> queue_;
};

}  // namespace

Outcome<std::vector<Vec2>> one_route(const NodeGraph& graph, const Pose2& start, Vec2 goal,
                                     BudgetMeter& meter) {
  return OneRouteSearch(graph, start, goal).run(meter);
}

}  // namespace outrider::routes
