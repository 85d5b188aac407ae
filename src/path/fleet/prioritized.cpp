#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "outrider/path/fleet/planners.hpp"
#include "space_time.hpp"

namespace outrider {
namespace fleet {
namespace {

/// The tracks of the robots that were planned before, as rules for the next one.
class Reserved {
 public:
  void add(Track track) {
    const std::size_t robot = tracks_.size();
    at_.resize(std::max(at_.size(), track.size()));
    for (std::size_t t = 0; t < track.size(); ++t) at_[t].emplace_back(track[t], robot);
    tracks_.push_back(std::move(track));
    for (std::size_t t = 0; t < at_.size(); ++t) {
      const std::size_t others = at_[t].size();
      for (std::size_t i = 0; i < tracks_.size() && others < tracks_.size(); ++i) {
        if (t >= tracks_[i].size() && !contains(t, i)) at_[t].emplace_back(tracks_[i].back(), i);
      }
      std::sort(at_[t].begin(), at_[t].end());
    }
  }

  [[nodiscard]] int last_step() const { return std::max(0, static_cast<int>(at_.size()) - 1); }
  [[nodiscard]] bool vertex_blocked(State s, int step) const { return robot_at(s, step).has_value(); }
  [[nodiscard]] bool edge_blocked(State from, State to, int step) const {
    const auto met = robot_at(to, step - 1);
    return met && robot_at(from, step) == met;
  }
  [[nodiscard]] bool can_stay(State goal, int step) const {
    for (int t = step + 1; t <= last_step(); ++t) {
      if (vertex_blocked(goal, t)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] bool contains(std::size_t t, std::size_t robot) const {
    return std::any_of(at_[t].begin(), at_[t].end(),
                       [&](const auto& place) { return place.second == robot; });
  }
  [[nodiscard]] std::optional<std::size_t> robot_at(State s, int step) const {
    if (at_.empty()) return std::nullopt;
    const auto& places = at_[static_cast<std::size_t>(std::min(step, last_step()))];
    const auto found = std::lower_bound(places.begin(), places.end(), std::pair{s, std::size_t{0}});
    if (found == places.end() || found->first != s) return std::nullopt;
    return found->second;
  }

  std::vector<Track> tracks_;
  std::vector<std::vector<std::pair<State, std::size_t>>> at_;  // by step: states and robots, sorted
};

constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();

/// Plans in that order. Returns the first robot without a path, or `nobody`.
Outcome<std::size_t> plan_in_order(const Query& query, const std::vector<std::size_t>& order,
                                   std::vector<Track>& tracks, BudgetMeter& meter,
                                   SearchMemory<int>& memory) {
  Reserved reserved;
  for (const std::size_t robot : order) {
    auto track = track_of(query, robot, reserved, memory, meter);
    if (!track && track.error().code == FaultCode::no_path) return robot;
    if (!track) return pass_on(track);
    tracks[robot] = *track;
    reserved.add(std::move(*track));
  }
  return nobody;
}

}  // namespace
}  // namespace fleet

std::vector<Option> describe(PrioritizedOptions& options) {
  return {{"attempts", "", 1, 1e6, "orders of the robots that are tried", &options.attempts}};
}

Outcome<FleetPlan> prioritized(const FleetProblem& problem, const PrioritizedOptions& options,
                               const Budget& budget) {
  PrioritizedOptions copy = options;
  if (auto ok = check_ranges(describe(copy)); !ok) return pass_on(ok);
  auto query = fleet::query_of(problem, budget);
  if (!query) return pass_on(query);
  std::vector<std::size_t> order(query->robots());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return query->steps[a][query->starts[a]] > query->steps[b][query->starts[b]];
  });
  BudgetMeter meter(budget);
  SearchMemory<int> memory;
  std::vector<fleet::Track> tracks(query->robots());
  std::size_t failed = 0;
  for (std::int64_t attempt = 0; attempt < options.attempts; ++attempt) {
    auto without = fleet::plan_in_order(*query, order, tracks, meter, memory);
    if (!without) return pass_on(without);
    if (*without == fleet::nobody) return fleet::plan_of(*query, tracks, meter.spent());
    failed = *without;
    const auto place = std::find(order.begin(), order.end(), failed);
    std::rotate(order.begin(), place, place + 1);
  }
  return fault(FaultCode::budget_exhausted,
               fmt::format("robot {} found no path round the others in the last of {} orders; there may be a "
                           "plan: take lacam, or cbs for few robots",
                           failed + 1, options.attempts));
}

}  // namespace outrider
