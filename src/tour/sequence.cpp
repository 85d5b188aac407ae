#include "outrider/tour/sequence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double rounding_s = 1e-6;
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// A sequence by its last hit.
struct HitNode {
  double rank = 0.0;
  double time_s = 0.0;
  double sum_s = 0.0;
  double heading_rad = 0.0;
  double yaw_rad = 0.0;  // of the gun, relative to the body
  double pitch_rad = 0.0;
  std::uint64_t hit = 0;
  std::size_t stop = nowhere;
  std::size_t last = 0;
  std::size_t parent = nowhere;

  [[nodiscard]] auto key() const { return std::tuple(hit, stop, last); }
};

struct Asked {
  const TourProblem& table;
  const std::vector<PendingTarget>& pending;
  const RobotState& from;
  ArrivalObjective objective;
};

HitNode first(const RobotState& from) {
  HitNode node;
  node.time_s = from.time_s;
  node.heading_rad = from.heading_rad;
  node.yaw_rad = from.gun_yaw_rad;
  node.pitch_rad = from.gun_pitch_rad;
  return node;
}

/// Adds one hit to a sequence; its time is infinite without a drive.
HitNode extended(const Asked& asked, const HitNode& before, std::size_t stop, std::size_t who,
                 const Service& service) {
  const TourProblem& table = asked.table;
  HitNode node = before;
  node.stop = stop;
  node.last = who;
  node.hit |= std::uint64_t{1} << who;
  if (before.stop != stop) {
    const Drive drive = before.stop == nowhere ? asked.from.drives[stop]
                                               : table.drives[before.stop * table.services.size() + stop];
    node.time_s += drive.time_s;
    if (drive.time_s > 0.0) {
      node.time_s += duration(std::abs(wrap_angle(drive.departure_rad - before.heading_rad)), table.turning);
      node.heading_rad = drive.arrival_rad;
    }
  }
  node.yaw_rad = wrap_angle(service.yaw_rad - node.heading_rad);
  node.pitch_rad = service.pitch_rad;
  const double aim = std::max(std::abs(wrap_angle(node.yaw_rad - before.yaw_rad)) / table.yaw_rate_radps,
                              std::abs(node.pitch_rad - before.pitch_rad) / table.pitch_rate_radps);
  node.time_s = std::max(node.time_s, asked.pending[who].settles_s) + aim + service.duration_s;
  node.sum_s += node.time_s;
  return node;
}

/// One of the pending that a stop serves. Of those of one goal, the one that settles first is hit first,
/// which is never worse: `before` are the bits of these.
struct Offer {
  std::size_t who = 0;
  const Service* service = nullptr;
  std::uint64_t before = 0;
};
using Offers = std::vector<std::vector<Offer>>;

std::uint64_t before(const std::vector<PendingTarget>& pending, std::size_t who) {
  const auto turn = [&](std::size_t one) { return std::pair(pending[one].settles_s, one); };
  std::uint64_t others = 0;
  for (std::size_t other = 0; other < pending.size(); ++other) {
    if (pending[other].goal == pending[who].goal && turn(other) < turn(who))
      others |= std::uint64_t{1} << other;
  }
  return others;
}

Offers offers_of(const Asked& asked) {
  Offers offers(asked.table.services.size());
  for (std::size_t stop = 0; stop < offers.size(); ++stop) {
    for (const Service& service : asked.table.services[stop]) {
      for (std::size_t who = 0; who < asked.pending.size(); ++who) {
        if (asked.pending[who].goal == service.goal)
          offers[stop].push_back({who, &service, before(asked.pending, who)});
      }
    }
  }
  return offers;
}

/// As if everybody left were hit at the time of the last hit.
double rank_of(const Asked& asked, const HitNode& node) {
  if (asked.objective == ArrivalObjective::makespan) return node.time_s;
  const auto left = asked.pending.size() - static_cast<std::size_t>(std::popcount(node.hit));
  return node.sum_s + static_cast<double>(left) * node.time_s;
}

/// Returns what no hit from that stop after the sequence can rank below: as if only the drive took time.
double least_rank(const Asked& asked, const HitNode& before, std::size_t stop) {
  HitNode there = before;
  if (before.stop == nowhere) {
    there.time_s += asked.from.drives[stop].time_s;
  } else if (before.stop != stop) {
    there.time_s += asked.table.drives[before.stop * asked.table.services.size() + stop].time_s;
  }
  return rank_of(asked, there);
}

bool better(const HitNode& a, const HitNode& b) {
  return std::tuple(a.rank, a.time_s, a.key(), a.parent) < std::tuple(b.rank, b.time_s, b.key(), b.parent);
}

/// Leaves the best `beam`, no two with the same key, in their order.
void keep_best(std::vector<HitNode>& nodes, std::size_t beam) {
  std::vector<const HitNode*> order;
  order.reserve(nodes.size());
  for (const HitNode& node : nodes) order.push_back(&node);
  std::ranges::sort(order, [](const HitNode* a, const HitNode* b) {
    return a->key() != b->key() ? a->key() < b->key() : better(*a, *b);
  });
  const auto same = std::ranges::unique(order, {}, [](const HitNode* node) { return node->key(); });
  order.erase(same.begin(), same.end());
  const auto kept = static_cast<std::ptrdiff_t>(std::min(beam, order.size()));
  std::ranges::partial_sort(order, order.begin() + kept,
                            [](const HitNode* a, const HitNode* b) { return better(*a, *b); });
  std::vector<HitNode> best;
  best.reserve(static_cast<std::size_t>(kept));
  for (auto node = order.begin(); node != order.begin() + kept; ++node) best.push_back(**node);
  nodes = std::move(best);
}

/// The best `beam` sequences of one layer, no two with the same key. Not many more than these are held, since
/// what is worse than `beam` others is not among the best.
class Layer {
 public:
  explicit Layer(std::size_t beam) : beam_(beam) {}

  [[nodiscard]] bool takes(double rank) const { return rank <= worst_; }
  void add(const HitNode& node) {
    nodes_.push_back(node);
    if (nodes_.size() < 4 * beam_ + 1024) return;
    keep_best(nodes_, beam_);
    if (nodes_.size() == beam_) worst_ = nodes_.back().rank;
  }
  std::vector<HitNode> best() {
    keep_best(nodes_, beam_);
    return std::move(nodes_);
  }

 private:
  std::size_t beam_;
  double worst_ = inf;
  std::vector<HitNode> nodes_;
};

/// Adds each hit from a stop after the sequence, which is that of the parent.
void add_hits(const Asked& asked, const std::vector<Offer>& offers, std::size_t stop, const HitNode& before,
              std::size_t parent, Layer& next) {
  for (const auto& [who, service, others] : offers) {
    if ((before.hit >> who & 1U) != 0 || (others & ~before.hit) != 0) continue;
    HitNode node = extended(asked, before, stop, who, *service);
    node.rank = rank_of(asked, node);
    node.parent = parent;
    if (std::isfinite(node.time_s) && next.takes(node.rank)) next.add(node);
  }
}

/// One hit more for each of the sequences, which are in the order of their ranks; the best `beam`.
std::vector<HitNode> next_layer(const Asked& asked, const Offers& offers, const std::vector<HitNode>& layer,
                                std::size_t beam) {
  Layer next(beam);
  for (std::size_t i = 0; i < layer.size() && next.takes(layer[i].rank - rounding_s); ++i) {
    for (std::size_t stop = 0; stop < offers.size(); ++stop) {
      if (!offers[stop].empty() && next.takes(least_rank(asked, layer[i], stop) - rounding_s))
        add_hits(asked, offers[stop], stop, layer[i], i, next);
    }
  }
  return next.best();
}

/// A tour as far as it is about those pending.
std::vector<Visit> part_of_tour(const std::vector<Visit>& tour, const std::vector<PendingTarget>& pending) {
  std::vector<Visit> part;
  for (const Visit& visit : tour) {
    Visit kept{visit.stop, {}};
    for (const std::uint32_t goal : visit.goals) {
      for (std::uint32_t who = 0; who < pending.size(); ++who) {
        if (pending[who].goal == goal) kept.goals.push_back(who);
      }
    }
    if (!kept.goals.empty()) part.push_back(std::move(kept));
  }
  return part;
}

}  // namespace

Sequence best_sequence(const TourProblem& table, const std::vector<PendingTarget>& pending,
                       const RobotState& from, ArrivalObjective objective, std::size_t beam) {
  const Asked asked{table, pending, from, objective};
  const Offers offers = offers_of(asked);
  std::vector<std::vector<HitNode>> layers{{first(from)}};
  for (std::size_t hits = 1; hits <= pending.size(); ++hits) {
    layers.push_back(next_layer(asked, offers, layers.back(), beam));
    if (layers.back().empty()) return {{}, inf};
  }
  Sequence sequence{{}, layers.back().front().rank};
  std::vector<HitNode> hits;
  std::size_t at = 0;
  for (std::size_t layer = layers.size() - 1; layer > 0; --layer) {
    hits.push_back(layers[layer][at]);
    at = hits.back().parent;
  }
  for (auto hit = hits.rbegin(); hit != hits.rend(); ++hit) {
    if (sequence.visits.empty() || sequence.visits.back().stop != hit->stop) {
      sequence.visits.push_back({hit->stop, {}});
    }
    sequence.visits.back().goals.push_back(static_cast<std::uint32_t>(hit->last));
  }
  return sequence;
}

double value_of(const TourProblem& table, const std::vector<PendingTarget>& pending, const RobotState& from,
                ArrivalObjective objective, const std::vector<Visit>& visits) {
  const Asked asked{table, pending, from, objective};
  HitNode node = first(from);
  std::size_t hits = 0;
  for (const Visit& visit : visits) {
    for (const std::uint32_t who : visit.goals) {
      const auto& services = table.services[visit.stop];
      const auto service = std::find_if(services.begin(), services.end(),
                                        [&](const Service& s) { return s.goal == pending[who].goal; });
      if (service == services.end()) return inf;
      node = extended(asked, node, visit.stop, who, *service);
      ++hits;
    }
  }
  const bool whole = hits == pending.size() && std::popcount(node.hit) == static_cast<int>(hits);
  if (!whole) return inf;
  return objective == ArrivalObjective::makespan ? node.time_s : node.sum_s;
}

Sequence sequence_beside(const std::vector<Visit>& tour, const TourProblem& table,
                         const std::vector<PendingTarget>& pending, const RobotState& from,
                         ArrivalObjective objective, std::size_t beam, bool as_toured) {
  Sequence part{part_of_tour(tour, pending), 0.0};
  part.value = value_of(table, pending, from, objective, part.visits);
  if (as_toured && std::isfinite(part.value)) return part;
  Sequence best = best_sequence(table, pending, from, objective, beam);
  return part.value < best.value ? part : best;
}

RobotState after_hit(const TourProblem& table, const PendingTarget& whom, const RobotState& from,
                     std::size_t stop) {
  const std::vector<PendingTarget> pending{whom};
  const auto& services = table.services[stop];
  const auto service =
      std::find_if(services.begin(), services.end(), [&](const Service& s) { return s.goal == whom.goal; });
  RobotState after = from;
  after.time_s = inf;
  if (service == services.end()) return after;
  const HitNode node =
      extended({table, pending, from, ArrivalObjective::makespan}, first(from), stop, 0, *service);
  const auto row = table.drives.begin() + static_cast<std::ptrdiff_t>(stop * table.services.size());
  after = {node.time_s,
           node.heading_rad,
           node.yaw_rad,
           node.pitch_rad,
           {row, row + static_cast<std::ptrdiff_t>(table.services.size())}};
  after.drives[stop] = {0.0, node.heading_rad, node.heading_rad};
  return after;
}

}  // namespace outrider
