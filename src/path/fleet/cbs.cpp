#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>

#include "outrider/path/fleet/planners.hpp"
#include "space_time.hpp"

namespace outrider {
namespace fleet {
namespace {

/// A robot must not go from `from` to `to` to arrive at that step; if both are the same, not be there.
struct Constraint {
  std::size_t robot = 0;
  State from = 0, to = 0;
  int step = 0;
};

/// The constraints of one robot, as rules of its search.
class Constraints {
 public:
  void add(const Constraint& c) {
    all_.emplace_back(c.step, c.from, c.to);
    last_ = std::max(last_, c.step);
  }
  void sort() { std::sort(all_.begin(), all_.end()); }

  [[nodiscard]] int last_step() const { return last_; }
  [[nodiscard]] bool vertex_blocked(State s, int step) const {
    return step <= last_ && std::binary_search(all_.begin(), all_.end(), std::tuple{step, s, s});
  }
  [[nodiscard]] bool edge_blocked(State from, State to, int step) const {
    return from != to && step <= last_ &&
           std::binary_search(all_.begin(), all_.end(), std::tuple{step, from, to});
  }
  [[nodiscard]] bool can_stay(State goal, int step) const {
    return std::none_of(all_.begin(), all_.end(), [&](const auto& each) {
      return std::get<0>(each) > step && std::get<1>(each) == goal && std::get<2>(each) == goal;
    });
  }

 private:
  std::vector<std::tuple<int, State, State>> all_;
  int last_ = 0;
};

struct Collision {
  std::size_t a = 0, b = 0;
  State a_from = 0, a_to = 0, b_from = 0, b_to = 0;
  int step = 0;
};

State state_at(const Track& track, std::size_t step) { return track[std::min(step, track.size() - 1)]; }

/// Returns the first collision, and the number of pairs that collide.
std::pair<std::optional<Collision>, int> collisions_of(const std::vector<const Track*>& tracks) {
  std::optional<Collision> first;
  int pairs = 0;
  for (std::size_t a = 0; a < tracks.size(); ++a) {
    for (std::size_t b = a + 1; b < tracks.size(); ++b) {
      const std::size_t steps = std::max(tracks[a]->size(), tracks[b]->size());
      for (std::size_t t = 1; t < steps; ++t) {
        const State a_from = state_at(*tracks[a], t - 1), a_to = state_at(*tracks[a], t);
        const State b_from = state_at(*tracks[b], t - 1), b_to = state_at(*tracks[b], t);
        const bool vertex = a_to == b_to, edge = a_to == b_from && b_to == a_from;
        if (!vertex && !edge) continue;
        ++pairs;
        const int step = static_cast<int>(t);
        if (!first || step < first->step) {
          first = vertex ? Collision{a, b, a_to, a_to, b_to, b_to, step}
                         : Collision{a, b, a_from, a_to, b_from, b_to, step};
        }
        break;
      }
    }
  }
  return {first, pairs};
}

/// A node of the constraint tree: its parent, one constraint more, and the new track of that robot.
struct Node {
  std::size_t parent = 0;
  Constraint constraint;
  Track track;
  std::uint64_t cost = 0;
};

class Tree {
 public:
  Tree(const Query& query, const CbsOptions& options, BudgetMeter& meter)
      : query_(query), options_(options), meter_(meter) {}

  Outcome<FleetPlan> search() {
    if (auto ok = add_root(); !ok) return pass_on(ok);
    while (!open_.empty()) {
      const std::size_t node = std::get<2>(open_.top());
      open_.pop();
      const auto tracks = tracks_of(node);
      const auto [collision, pairs] = collisions_of(tracks);
      if (!collision) return plan(tracks);
      const Collision& c = *collision;
      for (const Constraint& one :
           {Constraint{c.a, c.a_from, c.a_to, c.step}, Constraint{c.b, c.b_from, c.b_to, c.step}}) {
        if (auto ok = branch(node, one); !ok) return pass_on(ok);
      }
    }
    return fault(FaultCode::no_path, "every way of the robots round each other leads to a collision");
  }

 private:
  Status add_root() {
    std::uint64_t cost = 0;
    for (std::size_t robot = 0; robot < query_.robots(); ++robot) {
      auto track = track_of(query_, robot, Constraints{}, memory_, meter_);
      if (!track) return tl::unexpected<Fault>(track.error());
      cost += track->size() - 1;
      alone_.push_back(std::move(*track));
    }
    nodes_.push_back({0, {}, {}, cost});
    open_.emplace(cost, 0, 0);
    return {};
  }

  Status branch(std::size_t parent, const Constraint& one) {
    if (nodes_.size() >= static_cast<std::size_t>(options_.most_nodes)) {
      return fault(FaultCode::budget_exhausted,
                   fmt::format("the constraint tree has {} nodes; allow more by most_nodes, or take lacam, "
                               "which also proves that there is no plan",
                               nodes_.size()));
    }
    Constraints constraints;
    constraints.add(one);
    for (std::size_t n = parent; n != 0; n = nodes_[n].parent) {
      if (nodes_[n].constraint.robot == one.robot) constraints.add(nodes_[n].constraint);
    }
    constraints.sort();
    auto track = track_of(query_, one.robot, constraints, memory_, meter_);
    if (!track && track.error().code == FaultCode::no_path) return {};
    if (!track) return tl::unexpected<Fault>(track.error());
    const std::uint64_t before = tracks_of(parent)[one.robot]->size();
    nodes_.push_back({parent, one, std::move(*track), 0});
    nodes_.back().cost = nodes_[parent].cost + nodes_.back().track.size() - before;
    const std::size_t node = nodes_.size() - 1;
    open_.emplace(nodes_[node].cost, collisions_of(tracks_of(node)).second, node);
    return {};
  }

  /// The newest track of each robot on the way from the node to the root.
  [[nodiscard]] std::vector<const Track*> tracks_of(std::size_t node) const {
    std::vector<const Track*> tracks(query_.robots(), nullptr);
    for (std::size_t n = node; n != 0; n = nodes_[n].parent) {
      const Track*& track = tracks[nodes_[n].constraint.robot];
      if (track == nullptr) track = &nodes_[n].track;
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      if (tracks[i] == nullptr) tracks[i] = &alone_[i];
    }
    return tracks;
  }

  [[nodiscard]] FleetPlan plan(const std::vector<const Track*>& tracks) const {
    std::vector<Track> copies;
    copies.reserve(tracks.size());
    for (const Track* track : tracks) copies.push_back(*track);
    FleetPlan plan = plan_of(query_, copies, meter_.spent());
    plan.lower_bound = plan.cost;
    return plan;
  }

  using Entry = std::tuple<std::uint64_t, int, std::size_t>;  // cost, pairs that collide, node

  const Query& query_;
  const CbsOptions& options_;
  BudgetMeter& meter_;
  SearchMemory<int> memory_;
  std::vector<Track> alone_;
  std::vector<Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace
}  // namespace fleet

std::vector<Option> describe(CbsOptions& options) {
  return {{"most_nodes", "", 1, 1e8, "nodes of the constraint tree", &options.most_nodes}};
}

Outcome<FleetPlan> cbs(const FleetProblem& problem, const CbsOptions& options, const Budget& budget) {
  CbsOptions copy = options;
  if (auto ok = check_ranges(describe(copy)); !ok) return pass_on(ok);
  auto query = fleet::query_of(problem);
  if (!query) return pass_on(query);
  BudgetMeter meter(budget);
  return fleet::Tree(*query, options, meter).search();
}

}  // namespace outrider
