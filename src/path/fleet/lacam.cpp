#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "outrider/path/fleet/planners.hpp"
#include "pibt.hpp"

namespace outrider {
namespace fleet {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// A constraint on the next step: that robot goes there, and so do those of the constraints before it.
struct Place {
  std::size_t before = none;  // in the list of the same node
  std::size_t robot = 0;
  State to = 0;
  std::size_t depth = 0;
};

/// A configuration: the cells of all robots, how it was reached first, and what was tried from it.
struct Configuration {
  const std::vector<State>* cells = nullptr;
  std::size_t parent = none;
  std::vector<double> priority;
  std::vector<std::size_t> order;  // robots, highest priority first
  std::vector<Place> places;       // the queue of constraints; the first has none
  std::size_t next = 0;            // of the queue
};

class Search {
 public:
  Search(const Query& query, const LacamOptions& options, BudgetMeter& meter)
      : query_(query),
        most_(static_cast<std::size_t>(options.most_configurations)),
        meter_(meter),
        pibt_(query) {}

  Outcome<FleetPlan> search() {
    add(query_.starts, none);
    while (!stack_.empty()) {
      const std::size_t id = stack_.back();
      if (*nodes_[id].cells == query_.goals) return plan_to(id);
      if (nodes_[id].next == nodes_[id].places.size()) {
        stack_.pop_back();
        continue;
      }
      if (!meter_.spend()) return meter_.refusal();
      if (!step_from(id)) continue;
      const auto known = ids_.find(pibt_.next());
      if (known != ids_.end()) {
        stack_.push_back(known->second);  // what is met again is tried again first
        continue;
      }
      if (nodes_.size() >= most_) {
        return fault(FaultCode::budget_exhausted,
                     fmt::format("{} configurations were reached; allow more by most_configurations", most_));
      }
      add(pibt_.next(), id);
    }
    return fault(FaultCode::no_path,
                 "the robots cannot reach their goals without a collision: all that they can do was tried");
  }

 private:
  /// Takes the next set of constraints of a node and makes a step under them. Returns false if there is none.
  bool step_from(std::size_t id) {
    Configuration& node = nodes_[id];
    const std::size_t at = node.next++;
    if (node.places[at].depth < query_.robots()) {
      const std::size_t depth = node.places[at].depth, robot = node.order[depth];
      query_.for_each_step((*node.cells)[robot],
                           [&](State to) { node.places.push_back({at, robot, to, depth + 1}); });
    }
    pibt_.begin(*node.cells);
    for (std::size_t p = at; node.places[p].depth > 0; p = node.places[p].before) {
      if (!pibt_.fix(node.places[p].robot, node.places[p].to)) return false;
    }
    return std::all_of(node.order.begin(), node.order.end(),
                       [&](std::size_t robot) { return pibt_.move(robot); });
  }

  void add(const std::vector<State>& cells, std::size_t parent) {
    const auto [place, is_new] = ids_.try_emplace(cells, nodes_.size());
    Configuration node{&place->first, parent, {}, {}, {{}}, 0};
    for (std::size_t i = 0; i < query_.robots(); ++i) {
      const double far = query_.steps[i][cells[i]], size = static_cast<double>(query_.ground.marks.size());
      const double before = parent == none ? far / size : nodes_[parent].priority[i];
      node.priority.push_back(far == 0.0 ? before - std::floor(before)
                                         : before + (parent == none ? 0.0 : 1.0));
    }
    node.order.resize(query_.robots());
    std::iota(node.order.begin(), node.order.end(), std::size_t{0});
    std::stable_sort(node.order.begin(), node.order.end(),
                     [&](std::size_t a, std::size_t b) { return node.priority[a] > node.priority[b]; });
    stack_.push_back(nodes_.size());
    nodes_.push_back(std::move(node));
  }

  [[nodiscard]] FleetPlan plan_to(std::size_t last) const {
    std::vector<Track> tracks(query_.robots());
    for (std::size_t id = last; id != none; id = nodes_[id].parent) {
      for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].push_back((*nodes_[id].cells)[i]);
    }
    for (Track& track : tracks) std::reverse(track.begin(), track.end());
    return plan_of(query_, tracks, meter_.spent());
  }

  const Query& query_;
  std::size_t most_;
  BudgetMeter& meter_;
  Pibt pibt_;
  std::map<std::vector<State>, std::size_t> ids_;  // nodes by configuration
  std::vector<Configuration> nodes_;
  std::vector<std::size_t> stack_;
};

}  // namespace
}  // namespace fleet

std::vector<Option> describe(LacamOptions& options) {
  return {{"most_configurations", "", 1, 1e8, "sets of cells of all robots that are kept",
           &options.most_configurations}};
}

Outcome<FleetPlan> lacam(const FleetProblem& problem, const LacamOptions& options, const Budget& budget) {
  LacamOptions copy = options;
  if (auto ok = check_ranges(describe(copy)); !ok) return pass_on(ok);
  auto query = fleet::query_of(problem, budget);
  if (!query) return pass_on(query);
  BudgetMeter meter(budget);
  return fleet::Search(*query, options, meter).search();
}

}  // namespace outrider
