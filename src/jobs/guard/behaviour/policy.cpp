#include "outrider/jobs/guard/behaviour/policy.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <deque>

#include "outrider/core/options.hpp"
#include "outrider/core/parallel.hpp"
#include "outrider/tour/sequence.hpp"

namespace outrider {
namespace {

std::size_t whenever_someone_enters(const ReplanState& state) {
  return state.idle || state.entered > 0 ? state.inside : 0;
}

constexpr double least_leave = 0.001;
constexpr std::size_t most_planned_survivors = 64;

struct Model {
  const GuardProblem& problem;
  const PrecomputedStops& precomputed;
  const ArrivalOptions& options;
  const ReplanPolicy& policy;
};

/// A hit to come: from where, and of whom.
struct NextHit {
  std::size_t stop = 0;
  std::size_t who = 0;
};

/// One mission in the model.
class Played {
 public:
  explicit Played(const Model& model) : model_(model) {
    const TourProblem& table = model.precomputed.table;
    for (std::uint32_t place = 0; place < table.goals; ++place) {
      if (model.precomputed.reachable[place] == 0) continue;
      inside_.push_back(everybody_.size());
      everybody_.push_back({place, 0.0});
    }
    entered_ = inside_.size();
    const auto row = table.drives.begin();
    now_.heading_rad = table.heading_rad;
    now_.drives = {row, row + static_cast<std::ptrdiff_t>(table.services.size())};
  }

  double time_s(Rng rng) {
    const auto group = static_cast<std::size_t>(model_.options.group);
    while (!inside_.empty()) {
      const std::size_t count = model_.policy.take({inside_.size(), entered_, hits_.empty(), group});
      if (count > 0) plan(std::min({count, inside_.size(), most_planned_survivors}));
      if (hits_.empty()) return now_.time_s;  // nobody of them can be hit
      hit(rng);
    }
    return now_.time_s;
  }

 private:
  void plan(std::size_t count) {
    std::vector<PendingTarget> pending;
    for (std::size_t i = 0; i < count; ++i) pending.push_back(everybody_[inside_[i]]);
    const PrecomputedStops& precomputed = model_.precomputed;
    std::size_t toured = 0;
    for (const Visit& visit : precomputed.tour) toured += visit.goals.size();
    const bool still = !planned_ && pending.size() == toured;
    const Sequence best =
        sequence_beside(precomputed.tour, precomputed.table, pending, now_, ArrivalObjective::makespan,
                        static_cast<std::size_t>(model_.options.beam), still);
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
    now_ = after_hit(model_.precomputed.table, everybody_[next_hit.who], now_, next_hit.stop);
    std::erase(inside_, next_hit.who);
    if (rng.uniform() < model_.options.leave) return;
    const auto& places = model_.problem.targets;
    PendingTarget& one = everybody_[next_hit.who];
    const std::size_t next = elsewhere(one.goal, places.size(), rng);
    const double way_m = distance(xy(places[one.goal].base), xy(places[next].base));
    const double walk_mps = model_.options.walk_mps;
    one = {static_cast<std::uint32_t>(next), now_.time_s + (walk_mps > 0.0 ? way_m / walk_mps : 0.0)};
    if (model_.precomputed.reachable[next] == 0) return;
    inside_.push_back(next_hit.who);
    ++entered_;
  }

  const Model& model_;
  std::vector<PendingTarget> everybody_;
  std::vector<std::size_t> inside_;  // those to be hit, who came last at the end
  std::deque<NextHit> hits_;
  std::size_t entered_ = 0;
  bool planned_ = false;
  RobotState now_;
};

}  // namespace

const std::vector<ReplanPolicy>& replan_policies() {
  static const std::vector<ReplanPolicy> policies = {
      {.name = "groups",
       .sentence =
           "When idle, plan for the few who have been inside longest; finish that before the next few.",
       .source = "the reference report's groups of k targets, k being arrivals.group",
       .take = [](const ReplanState& state) { return state.idle ? std::min(state.inside, state.group) : 0; }},
      {.name = "when_idle",
       .sentence = "When idle, plan for everybody inside; finish that before looking again.",
       .source = "the gated policy of polling systems, Takagi, 1986",
       .take = [](const ReplanState& state) { return state.idle ? state.inside : 0; }},
      {.name = "each_arrival",
       .sentence =
           "Plan anew for everybody inside whenever someone enters, at the next waypoint or after the shot.",
       .source = "re-optimization as in Bertsimas and van Ryzin, Operations Research 39(4), 1991",
       .take = whenever_someone_enters,
       .interrupts = true},
      {.name = "clairvoyant",
       .sentence = "Knows from the start who will enter when; for comparison.",
       .source = "what is left of the price of not knowing: Borodin and El-Yaniv, 1998",
       .take = whenever_someone_enters,
       .interrupts = true,
       .foresees = true},
  };
  return policies;
}

Outcome<ReplanPolicy> find_replan_policy(std::string_view name) {
  return find_row(replan_policies(), "policy", name, "arrivals.policy");
}

ExpectedTime expected_time(const GuardProblem& problem, const PrecomputedStops& precomputed,
                           const ArrivalOptions& options, const ReplanPolicy& policy, std::size_t missions,
                           const std::stop_token& stop) {
  const Model model{problem, precomputed, options, policy};
  const Rng draws = Rng(0).child("survivors");
  std::vector<double> times(missions);
  parallel_for(missions, stop, [&](std::size_t i) { times[i] = Played(model).time_s(draws.child(i)); });
  const auto n = static_cast<double>(missions);
  ExpectedTime expected;
  for (const double time : times) expected.mean_s += time / n;
  double squares = 0.0;
  for (const double time : times) squares += (time - expected.mean_s) * (time - expected.mean_s);
  expected.error_s = missions > 1 ? std::sqrt(squares / (n - 1.0) / n) : 0.0;
  return expected;
}

ArrivalOptions survivor_options(ArrivalOptions options) {
  options.beam = std::min<std::int64_t>(options.beam, 4);
  return options;
}

Status check_survivors(const GuardProblem& problem, const ArrivalOptions& options) {
  if (options.leave < least_leave) {
    return bad_input(fmt::format("with {:g} the mission would not end; give a probability from {:g} to 1",
                                 options.leave, least_leave),
                     "arrivals.leave");
  }
  if (options.may_survive() && problem.targets.size() < 2) {
    return bad_input("who does not leave goes to another target's place, and there is none; list two targets",
                     "arrivals.leave");
  }
  return {};
}

}  // namespace outrider
