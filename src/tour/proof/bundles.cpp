#include "proof/bundles.hpp"

#include <bit>
#include <map>

namespace outrider::tour {
namespace {

constexpr std::uint32_t most_nodes = 14;  // of a stop, for all their orders

/// Returns the goals that the stop can serve, among `goals[from]` and those after it.
GoalSet served_at(const Instance& instance, std::uint32_t stop, const std::vector<std::uint32_t>& goals,
                  std::size_t from) {
  GoalSet set = 0;
  for (std::size_t bit = from; bit < goals.size(); ++bit) {
    if (instance.node(stop, goals[bit]) != none) set |= GoalSet{1} << bit;
  }
  return set;
}

}  // namespace

VisitTimes::VisitTimes(const Instance& instance) : instance_(instance), least_(instance.stops) {
  for (std::uint32_t stop = 0; stop < instance.stops; ++stop) {
    if (instance.first[stop + 1] - instance.first[stop] <= most_nodes) solve(stop);
  }
}

/// Held and Karp's program over the nodes of the stop, both ends free.
void VisitTimes::solve(std::uint32_t stop) {
  const std::uint32_t count = instance_.first[stop + 1] - instance_.first[stop];
  const TourNode* const nodes = instance_.nodes.data() + instance_.first[stop];
  std::vector<float> aim(std::size_t{count} * count);
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = 0; b < count; ++b) {
      aim[a * count + b] =
          static_cast<float>(aim_time(instance_, nodes[a].yaw, nodes[a].pitch, nodes[b].yaw, nodes[b].pitch));
    }
  }
  std::vector<float> ending(std::size_t{count} << count);  // [set * count + last]
  least_[stop].assign(std::size_t{1} << count, std::numeric_limits<float>::infinity());
  least_[stop][0] = 0.0F;
  for (std::size_t set = 1; set < least_[stop].size(); ++set) {
    for (std::size_t lasts = set; lasts != 0; lasts &= lasts - 1) {
      const auto last = static_cast<std::uint32_t>(std::countr_zero(lasts));
      const std::size_t rest = set & ~(std::size_t{1} << last);
      float before = rest == 0 ? 0.0F : std::numeric_limits<float>::infinity();
      for (std::size_t bits = rest; bits != 0; bits &= bits - 1) {
        const auto previous = static_cast<std::uint32_t>(std::countr_zero(bits));
        before = std::min(before, ending[rest * count + previous] + aim[previous * count + last]);
      }
      const float time = before + static_cast<float>(nodes[last].duration);
      ending[set * count + last] = time;
      least_[stop][set] = std::min(least_[stop][set], time);
    }
  }
}

float VisitTimes::least(std::uint32_t stop, const std::vector<std::uint32_t>& goals, GoalSet set) const {
  std::size_t nodes = 0;
  double durations = 0.0;
  for (; set != 0; set &= set - 1) {
    const std::uint32_t node = instance_.node(stop, goals[static_cast<std::size_t>(std::countr_zero(set))]);
    durations += instance_.nodes[node].duration;
    if (!least_[stop].empty()) nodes |= std::size_t{1} << (node - instance_.first[stop]);
  }
  return least_[stop].empty() ? static_cast<float>(durations) : least_[stop][nodes];
}

Bundles extended(const Instance& instance, const VisitTimes& times, const Bundles& before,
                 const std::vector<std::uint32_t>& goals, std::size_t known) {
  std::vector<std::vector<GoalSet>> old(instance.stops, {0});
  for (const Bundle& bundle : before) {
    for (const Way& way : bundle.ways) {
      if (way.needed) old[way.stop].push_back(bundle.set);
    }
  }
  std::map<GoalSet, std::vector<Way>> found;
  for (std::uint32_t stop = 0; stop < instance.stops; ++stop) {
    const GoalSet fresh = served_at(instance, stop, goals, known);
    for (const GoalSet set : old[stop]) {
      for (GoalSet more = fresh;; more = (more - 1) & fresh) {
        const GoalSet both = set | more;
        if (both != 0) found[both].push_back({stop, times.least(stop, goals, both), false});
        if (more == 0) break;
      }
    }
  }
  Bundles bundles;
  for (auto& [set, ways] : found) bundles.push_back({set, std::move(ways)});
  return bundles;
}

}  // namespace outrider::tour
