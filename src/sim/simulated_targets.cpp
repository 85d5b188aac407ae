#include "outrider/sim/simulated_targets.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/sim/faults/execution_errors.hpp"

namespace outrider {

std::size_t elsewhere(std::size_t place, std::size_t places, Rng& rng) {
  const std::size_t other = rng.below(places - 1);
  return other < place ? other : other + 1;
}

SimulatedTargets::SimulatedTargets(const std::vector<Target>& targets, TargetSimParams params,
                                   std::uint64_t seed)
    : targets_(targets),
      params_(std::move(params)),
      survival_rng_(Rng(seed).child("survival")),
      sight_rng_(Rng(seed).child("sight")),
      gone_s_(params_.walks.size(), std::numeric_limits<double>::infinity()) {
  for (std::size_t i = 0; i < targets.size(); ++i) stands_at_.push_back(i);
}

bool SimulatedTargets::somebody_entered(double time_s) const {
  return told_ < params_.intruders.size() && (params_.foreseen || next_entry_s() <= time_s);
}

double SimulatedTargets::next_entry_s() const {
  const auto& intruders = params_.intruders;
  return told_ < intruders.size() ? intruders[told_].enters_s : std::numeric_limits<double>::infinity();
}

TargetReport SimulatedTargets::look(double time_s) {
  TargetReport report;
  for (; somebody_entered(time_s); ++told_) {
    const Intruder& one = params_.intruders[told_];
    report.arrivals.push_back({told_, one.settles_s, one.place});
  }
  std::erase_if(survived_, [&](const Survived& one) {
    const bool known = one.hit_s <= time_s + instant_s;
    if (known) report.arrivals.push_back(one.arrival);
    return known;
  });
  report.more_to_come = told_ < params_.intruders.size();
  if (params_.walks.empty()) return report;
  for (; static_cast<double>(looks_) * params_.look_s <= time_s; ++looks_) {
    const double when_s = static_cast<double>(looks_) * params_.look_s;
    for (std::size_t who = 0; who < params_.walks.size(); ++who) {
      const Vec2 off = random_in_disk(sight_rng_, params_.sight_m);
      if (when_s < gone_s_[who]) report.seen.push_back({who, when_s, params_.walks[who].at(when_s) + off});
    }
  }
  return report;
}

void SimulatedTargets::hit(std::size_t who, double time_s, LogQueue& queue) {
  if (!gone_s_.empty()) gone_s_[who] = time_s;
  const std::size_t first = params_.intruders.size();
  if (who >= first) return;
  if (params_.survival.leave >= 1.0 || survival_rng_.uniform() < params_.survival.leave) return;
  const std::size_t place = stands_at_[who] < first ? params_.intruders[who].place : stands_at_[who] - first;
  const std::size_t next = elsewhere(place, targets_.size() - first, survival_rng_);
  stands_at_[who] = first + next;
  const Vec2 from = xy(targets_[first + place].base);
  const Vec2 to = xy(targets_[first + next].base);
  const double walk_mps = params_.survival.walk_mps;
  const double walk_s = walk_mps > 0.0 ? distance(from, to) / walk_mps : 0.0;
  survived_.push_back({{who, time_s + walk_s, next}, time_s});
  const std::string& name = params_.intruders[who].name;
  queue.note_event(
      time_s, "survive",
      fmt::format("{} does not leave: it goes to the place of {}", name, targets_[first + next].name));
  const auto stands = [&](double when_s, std::size_t at, Vec2 position) {
    const double height = targets_[first + at].centre().z;
    queue.note(when_s, topic::target_positions,
               outrider_msgs::TargetPosition{name, {position.x, position.y, height}, point_of(position)});
  };
  stands(time_s, place, from);
  stands(time_s + walk_s, next, to);
}

}  // namespace outrider
