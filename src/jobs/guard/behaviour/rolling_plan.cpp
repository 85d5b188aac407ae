#include "outrider/jobs/guard/behaviour/rolling_plan.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "outrider/core/parallel.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_planned = 64;

/// A hit to come: from where, and of whom.
struct NextHit {
  std::size_t stop = 0;
  std::size_t who = 0;
};

/// One mission in the model.
class Played {
 public:
  Played(const RollingPlan& plan, const ArrivalOptions& options) : plan_(plan), options_(options) {
    const TourProblem& table = plan.stops.table;
    for (std::uint32_t place = 0; place < table.goals; ++place) {
      if (plan.stops.reachable[place] == 0) continue;
      inside_.push_back(everybody_.size());
      everybody_.push_back({place, 0.0});
    }
    entered_ = inside_.size();
    const auto row = table.drives.begin();
    now_.heading_rad = table.heading_rad;
    now_.drives = {row, row + static_cast<std::ptrdiff_t>(table.services.size())};
  }

  double time_s(Rng rng) {
    while (!inside_.empty()) {
      const std::size_t count = plan_.wanted(inside_.size(), entered_, hits_.empty());
      if (count > 0) plan_anew(count);
      if (hits_.empty()) return now_.time_s;  // nobody of them can be hit
      hit(rng);
    }
    return now_.time_s;
  }

 private:
  void plan_anew(std::size_t count) {
    std::vector<PendingTarget> pending;
    pending.reserve(count);
    for (std::size_t i = 0; i < count; ++i) pending.push_back(everybody_[inside_[i]]);
    const Sequence best = plan_.next(pending, now_, !planned_);
    hits_.clear();
    for (const Visit& visit : best.visits) {
      for (const std::uint32_t who : visit.goals) hits_.push_back({visit.stop, inside_[who]});
    }
    entered_ = 0;
    planned_ = true;
  }

  void hit(Rng& rng) {
    const NextHit next_hit = hits_.front();
    hits_.pop_front();
    now_ = after_hit(plan_.stops.table, everybody_[next_hit.who], now_, next_hit.stop);
    std::erase(inside_, next_hit.who);
    if (rng.uniform() < options_.leave) return;
    const auto& targets = plan_.yard.problem.targets;
    PendingTarget& one = everybody_[next_hit.who];
    const std::size_t next = elsewhere(one.goal, plan_.yard.places(), rng);
    const double way_m = distance(xy(targets[plan_.yard.at_place(one.goal)].base),
                                  xy(targets[plan_.yard.at_place(next)].base));
    const double walk_mps = options_.walk_mps;
    one = {static_cast<std::uint32_t>(next), now_.time_s + (walk_mps > 0.0 ? way_m / walk_mps : 0.0)};
    if (plan_.stops.reachable[next] == 0) return;
    inside_.push_back(next_hit.who);
    ++entered_;
  }

  const RollingPlan& plan_;
  const ArrivalOptions& options_;
  std::vector<PendingTarget> everybody_;
  std::vector<std::size_t> inside_;  // those to be hit, who came last at the end
  std::deque<NextHit> hits_;
  std::size_t entered_ = 0;
  bool planned_ = false;
  RobotState now_;
};

}  // namespace

std::size_t RollingPlan::wanted(std::size_t inside, std::size_t entered, bool idle) const {
  return std::min({policy.take({inside, entered, idle, group}), inside, most_planned});
}

Sequence RollingPlan::next(const std::vector<PendingTarget>& pending, const RobotState& from,
                           bool first) const {
  std::size_t toured = 0;
  for (const Visit& visit : stops.tour) toured += visit.goals.size();
  const bool as_toured =
      first && objective == ArrivalObjective::makespan && pending.size() == toured &&
      std::ranges::all_of(pending, [&](const PendingTarget& one) { return one.settles_s <= from.time_s; });
  return sequence_beside(stops.tour, stops.table, pending, from, objective, beam, as_toured);
}

ExpectedTime expected_time(const RollingPlan& plan, const ArrivalOptions& options, std::size_t missions,
                           const std::stop_token& stop) {
  const Rng draws = Rng(0).child("survivors");
  std::vector<double> times(missions);
  parallel_for(missions, stop,
               [&](std::size_t i) { times[i] = Played(plan, options).time_s(draws.child(i)); });
  const auto n = static_cast<double>(missions);
  ExpectedTime expected;
  for (const double time : times) expected.mean_s += time / n;
  double squares = 0.0;
  for (const double time : times) squares += (time - expected.mean_s) * (time - expected.mean_s);
  expected.error_s = missions > 1 ? std::sqrt(squares / (n - 1.0) / n) : 0.0;
  return expected;
}

}  // namespace outrider
