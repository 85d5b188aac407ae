#include "outrider/tour/sequence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
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

/// The pending that each stop serves, with the service.
using Offers = std::vector<std::vector<std::pair<std::size_t, const Service*>>>;

Offers offers_of(const Asked& asked) {
  Offers offers(asked.table.services.size());
  for (std::size_t stop = 0; stop < offers.size(); ++stop) {
    for (const Service& service : asked.table.services[stop]) {
      for (std::size_t who = 0; who < asked.pending.size(); ++who) {
        if (asked.pending[who].goal == service.goal) offers[stop].emplace_back(who, &service);
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

/// One hit more for each of the sequences; the best `beam`, no two with the same key.
std::vector<HitNode> next_layer(const Asked& asked, const Offers& offers, const std::vector<HitNode>& layer,
                                std::size_t beam) {
  std::vector<HitNode> next;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    for (std::size_t stop = 0; stop < offers.size(); ++stop) {
      for (const auto& [who, service] : offers[stop]) {
        if ((layer[i].hit >> who & 1U) != 0) continue;
        HitNode node = extended(asked, layer[i], stop, who, *service);
        if (!std::isfinite(node.time_s)) continue;
        node.rank = rank_of(asked, node);
        node.parent = i;
        next.push_back(node);
      }
    }
  }
  const auto better = [](const HitNode& a, const HitNode& b) {
    return std::tuple(a.rank, a.time_s, a.key(), a.parent) < std::tuple(b.rank, b.time_s, b.key(), b.parent);
  };
  std::sort(next.begin(), next.end(), [&](const HitNode& a, const HitNode& b) {
    return a.key() != b.key() ? a.key() < b.key() : better(a, b);
  });
  next.erase(std::unique(next.begin(), next.end(),
                         [](const HitNode& a, const HitNode& b) { return a.key() == b.key(); }),
             next.end());
  const auto kept = static_cast<std::ptrdiff_t>(std::min(beam, next.size()));
  std::partial_sort(next.begin(), next.begin() + kept, next.end(), better);
  next.resize(static_cast<std::size_t>(kept));
  return next;
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
