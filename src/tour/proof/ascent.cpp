#include "proof/ascent.hpp"

#include <queue>

namespace outrider::tour {
namespace {

using Ticks = std::int32_t;

constexpr double ticks_per_s = 1e5;
constexpr Ticks endless = std::numeric_limits<Ticks>::max() / 2;
constexpr Ticks step = 1000;   // the most that a share grows at a time
constexpr double fee_s = 0.5;  // of a first service

Ticks ticks(double time_s) {
  return static_cast<Ticks>(std::min(std::floor(time_s * ticks_per_s), static_cast<double>(endless)));
}

float seconds(Ticks time) { return static_cast<float>(time / ticks_per_s); }

/// A place is a stop, or a node behind all stops.
class Ascent {
 public:
  Ascent(const Instance& instance, const AscentRules& rules);
  void run(BudgetMeter& meter);
  [[nodiscard]] Shares shares() const;

 private:
  enum class End { open, closed };

  void set_drives(const AscentRules& rules);
  void set_services();
  End grow(std::uint32_t goal);
  Ticks reach(std::uint32_t goal, End& end);
  void approach(std::uint32_t place, Ticks distance);
  template <typename Visitor>
  void for_each_entry(std::uint32_t place, Visitor visit);
  [[nodiscard]] std::uint32_t services(std::uint32_t stop) const {
    return instance_.first[stop + 1] - instance_.first[stop];
  }

  using Waiting = std::pair<Ticks, std::uint32_t>;

  const Instance& instance_;
  std::uint32_t stops_;
  std::vector<bool> apart_;              // goal
  std::vector<Ticks> drive_;             // [to * stops + from] what is left to pay, as in those below
  std::vector<Ticks> beyond_;            // the same: what shares may not pay
  std::vector<std::vector<Ticks>> aim_;  // stop -> [to * its services + from]
  std::vector<Ticks> first_;             // node -> of the fee
  std::vector<Ticks> service_;           // node -> of its duration
  std::int64_t total_ = 0;
  std::vector<Ticks> distance_;               // place -> to the goal at hand, endless if not within a step
  std::vector<std::uint32_t> near_, inside_;  // places: seen, and settled
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> open_;
};

Ascent::Ascent(const Instance& instance, const AscentRules& rules)
    : instance_(instance),
      stops_(instance.stops),
      apart_(instance.goals, false),
      distance_(stops_ + instance.nodes.size(), endless) {
  for (const std::uint32_t goal : rules.apart) apart_[goal] = true;
  first_.assign(instance.nodes.size(), 0);
  set_drives(rules);
  set_services();
}

void Ascent::set_drives(const AscentRules& rules) {
  drive_.assign(instance_.time_to.size(), endless);
  beyond_.assign(drive_.size(), 0);
  for (std::uint32_t to = 0; to < stops_; ++to) {
    const double* const times = &instance_.time_to[std::size_t{to} * stops_];
    const Ticks least = ticks(*std::min_element(times, times + stops_));
    const Ticks fee = to == 0 ? 0 : std::min(least, ticks(fee_s));
    std::fill(first_.begin() + instance_.first[to], first_.begin() + instance_.first[to + 1], fee);
    for (std::uint32_t from = 0; from < stops_; ++from) {
      if (times[from] == infinity) continue;
      const std::size_t arc = std::size_t{to} * stops_ + from;
      const Ticks time = ticks(times[from]) - fee;
      drive_[arc] = std::min(time, ticks(rules.most_s));
      beyond_[arc] = time - drive_[arc];
    }
  }
}

void Ascent::set_services() {
  for (const TourNode& node : instance_.nodes) service_.push_back(ticks(node.duration));
  aim_.resize(stops_);
  for (std::uint32_t stop = 0; stop < stops_; ++stop) {
    const std::uint32_t count = services(stop);
    const TourNode* const nodes = instance_.nodes.data() + instance_.first[stop];
    for (std::uint32_t to = 0; to < count; ++to) {
      for (std::uint32_t from = 0; from < count; ++from) {
        aim_[stop].push_back(
            ticks(aim_time(instance_, nodes[from].yaw, nodes[from].pitch, nodes[to].yaw, nodes[to].pitch)));
      }
    }
  }
}

/// Calls visit(place, what is left to pay) for the arcs into a place.
template <typename Visitor>
void Ascent::for_each_entry(std::uint32_t place, Visitor visit) {
  if (place < stops_) {
    Ticks* const row = &drive_[std::size_t{place} * stops_];
    for (std::uint32_t from = 0; from < stops_; ++from) visit(from, row[from]);
    return;
  }
  const std::uint32_t node = place - stops_;
  const std::uint32_t stop = instance_.nodes[node].stop;
  const std::uint32_t begin = instance_.first[stop];
  const std::uint32_t count = services(stop);
  Ticks* const row = &aim_[stop][std::size_t{node - begin} * count];
  for (std::uint32_t from = 0; from < count; ++from) visit(stops_ + begin + from, row[from]);
  visit(stop, first_[node]);
}

void Ascent::approach(std::uint32_t place, Ticks distance) {
  if (distance >= std::min(distance_[place], step)) return;
  if (distance_[place] == endless) near_.push_back(place);
  distance_[place] = distance;
  open_.push({distance, place});
}

/// Runs Dijkstra's search backward from the goal. Returns the distance to which it may grow: a step, or less
/// if it reaches its end before.
Ticks Ascent::reach(std::uint32_t goal, End& end) {
  for (const std::uint32_t node : instance_.nodes_of[goal]) approach(stops_ + node, service_[node]);
  while (!open_.empty()) {
    const auto [distance, place] = open_.top();
    open_.pop();
    if (distance > distance_[place]) continue;
    if (place == 0 || (apart_[goal] && place < stops_)) {
      end = End::closed;
      return distance;
    }
    inside_.push_back(place);
    for_each_entry(place, [&](std::uint32_t from, Ticks left) { approach(from, distance + left); });
  }
  return step;
}

/// Raises the share of the goal: each arc pays by how much nearer its end is.
Ascent::End Ascent::grow(std::uint32_t goal) {
  End end = End::open;
  near_.clear();
  inside_.clear();
  const Ticks radius = reach(goal, end);
  const auto within = [&](std::uint32_t place) { return std::min(distance_[place], radius); };
  for (const std::uint32_t node : instance_.nodes_of[goal]) service_[node] -= within(stops_ + node);
  for (const std::uint32_t place : inside_) {
    const Ticks here = distance_[place];
    if (here >= radius) continue;
    for_each_entry(place, [&](std::uint32_t from, Ticks& left) { left -= std::max(0, within(from) - here); });
  }
  for (const std::uint32_t place : near_) distance_[place] = endless;
  open_ = {};
  total_ += radius;
  return end;
}

void Ascent::run(BudgetMeter& meter) {
  using Sized = std::pair<std::size_t, std::uint32_t>;
  std::priority_queue<Sized, std::vector<Sized>, std::greater<>> goals;
  for (std::uint32_t goal = 0; goal < instance_.goals; ++goal) {
    goals.push({instance_.nodes_of[goal].size(), goal});
  }
  while (!goals.empty() && meter.spend()) {
    const std::uint32_t goal = goals.top().second;
    goals.pop();
    if (grow(goal) == End::open) goals.push({inside_.size(), goal});
  }
}

Shares Ascent::shares() const {
  Shares shares;
  shares.total = static_cast<double>(total_) / ticks_per_s;
  for (std::size_t arc = 0; arc < drive_.size(); ++arc) {
    shares.drive_left.push_back(drive_[arc] == endless ? std::numeric_limits<float>::infinity()
                                                       : seconds(drive_[arc] + beyond_[arc]));
  }
  for (std::uint32_t node = 0; node < instance_.nodes.size(); ++node) {
    const std::uint32_t stop = instance_.nodes[node].stop;
    const std::uint32_t begin = instance_.first[stop];
    Ticks entry = first_[node];
    for (std::uint32_t from = 0; from < services(stop); ++from) {
      if (begin + from != node) entry = std::min(entry, aim_[stop][(node - begin) * services(stop) + from]);
    }
    shares.serve_left.push_back(seconds(service_[node] + entry));
  }
  return shares;
}

}  // namespace

Shares ascend(const Instance& instance, const AscentRules& rules, BudgetMeter& meter) {
  Ascent ascent(instance, rules);
  ascent.run(meter);
  return ascent.shares();
}

}  // namespace outrider::tour
