#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

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

/// Returns the first collision of two robots.
std::optional<Collision> first_collision(const std::vector<const Track*>& tracks, std::size_t a,
                                         std::size_t b) {
  const std::size_t steps = std::max(tracks[a]->size(), tracks[b]->size());
  for (std::size_t t = 1; t < steps; ++t) {
    const State a_from = state_at(*tracks[a], t - 1), a_to = state_at(*tracks[a], t);
    const State b_from = state_at(*tracks[b], t - 1), b_to = state_at(*tracks[b], t);
    const int step = static_cast<int>(t);
    if (a_to == b_to) return Collision{a, b, a_to, a_to, b_to, b_to, step};
    if (a_to == b_from && b_to == a_from) return Collision{a, b, a_from, a_to, b_from, b_to, step};
  }
  return std::nullopt;
}

/// Returns the first collision of each pair that collides, the earliest first. A stop leaves pairs out.
std::vector<Collision> collisions_of(const std::vector<const Track*>& tracks, const std::stop_token& stop) {
  std::vector<Collision> all;
  for (std::size_t a = 0; a < tracks.size() && !stop.stop_requested(); ++a) {
    for (std::size_t b = a + 1; b < tracks.size(); ++b) {
      if (const auto one = first_collision(tracks, a, b)) all.push_back(*one);
    }
  }
  std::sort(all.begin(), all.end(), [](const Collision& x, const Collision& y) {
    return std::tie(x.step, x.a, x.b) < std::tie(y.step, y.a, y.b);
  });
  return all;
}

/// A node of the constraint tree: its parent, one constraint more, and the new track of that robot.
struct TreeNode {
  std::size_t parent = 0;
  Constraint constraint;
  Track track;
  std::uint64_t cost = 0;
  bool bypass = false;  ///< the track serves as well as the former one, and the constraint does not hold
};

/// The two ways to resolve a collision: a constraint on either robot, its new track (none if there is no
/// way), and by how much that costs more.
struct Split {
  static constexpr std::uint64_t no_way = std::numeric_limits<std::uint64_t>::max();

  std::array<Constraint, 2> constraints;
  std::array<Track, 2> tracks;
  std::array<std::uint64_t, 2> more{};

  /// Cardinal collisions (2) cost more either way, semi-cardinal ones (1) one way.
  [[nodiscard]] int rank() const { return (more[0] > 0 ? 1 : 0) + (more[1] > 0 ? 1 : 0); }
};

class Tree {
 public:
  Tree(const Query& query, const CbsOptions& options, BudgetMeter& meter, std::stop_token stop)
      : query_(query), options_(options), meter_(meter), stop_(std::move(stop)) {}

  Outcome<FleetPlan> search() {
    if (auto ok = add_root(); !ok) return pass_on(ok);
    while (!open_.empty()) {
      const std::size_t node = std::get<2>(open_.top());
      open_.pop();
      const auto tracks = tracks_of(node);
      const auto collisions = collisions_of(tracks, stop_);
      if (stop_.stop_requested()) return meter_.refusal();
      if (collisions.empty()) return plan(tracks);
      auto split = best_split(node, tracks, collisions);
      if (!split) return pass_on(split);
      if (bypassed(node, *split, collisions.size())) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        if (auto ok = branch(node, *split, k); !ok) return pass_on(ok);
      }
    }
    return fault(FaultCode::no_path, "every way of the robots round each other leads to a collision");
  }

 private:
  Status add_root() {
    std::uint64_t cost = 0;
    for (std::size_t robot = 0; robot < query_.robots(); ++robot) {
      auto track = track_of(query_, robot, Constraints{}, memory_, meter_);
      if (!track) return pass_on(track);
      cost += track->size() - 1;
      alone_.push_back(std::move(*track));
    }
    nodes_.push_back({0, {}, {}, cost});
    open_.emplace(cost, 0, 0);
    return {};
  }

  /// Returns the split of the first collision that is cardinal; else of the first of the highest rank among
  /// the earliest few.
  Outcome<Split> best_split(std::size_t node, const std::vector<const Track*>& tracks,
                            const std::vector<Collision>& collisions) {
    Split best;
    for (std::size_t i = 0; i < std::min(most_looked_at, collisions.size()); ++i) {
      auto split = split_of(node, tracks, collisions[i]);
      if (!split) return split;
      if (i == 0 || split->rank() > best.rank()) best = std::move(*split);
      if (best.rank() == 2) break;
    }
    return best;
  }

  Outcome<Split> split_of(std::size_t node, const std::vector<const Track*>& tracks, const Collision& c) {
    Split split;
    split.constraints = {Constraint{c.a, c.a_from, c.a_to, c.step},
                         Constraint{c.b, c.b_from, c.b_to, c.step}};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t robot = split.constraints[k].robot;
      auto track = track_of(query_, robot, constraints_of(node, split.constraints[k]), memory_, meter_);
      if (!track && track.error().code != FaultCode::no_path) return pass_on(track);
      split.more[k] = track ? track->size() - tracks[robot]->size() : Split::no_way;
      if (track) split.tracks[k] = std::move(*track);
    }
    return split;
  }

  /// The constraints on a robot at a node, and one more.
  [[nodiscard]] Constraints constraints_of(std::size_t node, const Constraint& one) const {
    Constraints constraints;
    constraints.add(one);
    for (std::size_t n = node; n != 0; n = nodes_[n].parent) {
      if (!nodes_[n].bypass && nodes_[n].constraint.robot == one.robot) constraints.add(nodes_[n].constraint);
    }
    constraints.sort();
    return constraints;
  }

  /// If one of the new tracks costs nothing and fewer pairs collide with it, takes it in place of the former
  /// one, without a constraint, and returns true.
  bool bypassed(std::size_t node, Split& split, std::size_t pairs) {
    for (std::size_t k = 0; k < 2; ++k) {
      if (split.more[k] != 0) continue;
      nodes_.push_back({node, split.constraints[k], std::move(split.tracks[k]), nodes_[node].cost, true});
      const std::size_t fewer = collisions_of(tracks_of(nodes_.size() - 1), stop_).size();
      if (fewer < pairs) {
        open_.emplace(nodes_[node].cost, fewer, nodes_.size() - 1);
        return true;
      }
      split.tracks[k] = std::move(nodes_.back().track);
      nodes_.pop_back();
    }
    return false;
  }

  Status branch(std::size_t parent, Split& split, std::size_t k) {
    if (split.more[k] == Split::no_way) return {};
    if (nodes_.size() >= static_cast<std::size_t>(options_.most_nodes)) {
      return fault(FaultCode::budget_exhausted,
                   fmt::format("the constraint tree has {} nodes; allow more by most_nodes, or take lacam, "
                               "which also proves that there is no plan",
                               nodes_.size()));
    }
    const std::uint64_t cost = nodes_[parent].cost + split.more[k];
    nodes_.push_back({parent, split.constraints[k], std::move(split.tracks[k]), cost});
    const std::size_t node = nodes_.size() - 1;
    open_.emplace(cost, collisions_of(tracks_of(node), stop_).size(), node);
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

  static constexpr std::size_t most_looked_at = 16;  // collisions of a node

  using Entry = std::tuple<std::uint64_t, std::size_t, std::size_t>;  // cost, pairs that collide, node

  const Query& query_;
  const CbsOptions& options_;
  BudgetMeter& meter_;
  std::stop_token stop_;
  SearchMemory<int> memory_;
  std::vector<Track> alone_;
  std::vector<TreeNode> nodes_;
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
  auto query = fleet::query_of(problem, budget);
  if (!query) return pass_on(query);
  BudgetMeter meter(budget);
  return fleet::Tree(*query, options, meter, budget.stop).search();
}

}  // namespace outrider
