#include "proof/relaxation.hpp"

namespace outrider::tour {
namespace {

/// Least turn from any heading of the sector.
double least_turn(const Instance& instance, std::uint32_t sector, std::uint32_t sectors, double to) {
  if (sector_of(to, sectors) == sector) return 0.0;
  const double width = 2.0 * pi / sectors;
  const double low = -pi + sector * width;
  return std::min(turn_time(instance, low, to), turn_time(instance, low + width, to));
}

std::vector<float> least_aims(const Instance& instance) {
  std::vector<float> least(instance.nodes.size(), 0.0F);
  for (std::uint32_t n = 0; n < instance.nodes.size(); ++n) {
    const TourNode& node = instance.nodes[n];
    double time = infinity;
    for (std::uint32_t m = instance.first[node.stop]; m < instance.first[node.stop + 1]; ++m) {
      const TourNode& before = instance.nodes[m];
      if (m != n) time = std::min(time, aim_time(instance, before.yaw, before.pitch, node.yaw, node.pitch));
    }
    if (time < infinity) least[n] = static_cast<float>(time);
  }
  return least;
}

/// arrived[stop] = min over services of duration + served[rest]; served[stop] the same with the aim.
void serve(const Instance& instance, Relaxation& r, std::uint32_t set) {
  for (std::uint32_t bits = set; bits != 0; bits &= bits - 1) {
    const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
    const std::uint32_t rest = set & ~(1U << bit);
    for (const std::uint32_t n : instance.nodes_of[r.goals[bit]]) {
      const TourNode& node = instance.nodes[n];
      const auto duration = static_cast<float>(node.duration);
      const float* after = &r.served[r.index(rest, node.stop, 0)];
      float* arrived = &r.arrived[r.index(set, node.stop, 0)];
      float* served = &r.served[r.index(set, node.stop, 0)];
      for (std::uint32_t q = 0; q < r.sectors; ++q) {
        const float time = duration + after[q];
        arrived[q] = time < arrived[q] ? time : arrived[q];
        const float aimed = time + r.least_aim[n];
        served[q] = aimed < served[q] ? aimed : served[q];
      }
    }
  }
}

/// served[from] = min over drives to a stop with a service in the set.
void drive(const RelaxedDrives& drives, Relaxation& r, std::uint32_t set) {
  float* served = &r.served[r.index(set, 0, 0)];
  for (std::uint32_t to = 0; to < r.stops; ++to) {
    if ((r.covered[to] & set) == 0) continue;
    const std::size_t row = std::size_t{to} * r.stops;
    const float* arrived = &r.arrived[r.index(set, to, 0)];
    const float* time_to = &drives.time_to[row];
    if (r.sectors == 1) {
      const float there = *arrived;
      for (std::uint32_t from = 0; from < r.stops; ++from) {
        const float time = time_to[from] + there;
        served[from] = time < served[from] ? time : served[from];
      }
      continue;
    }
    for (std::uint32_t from = 0; from < r.stops; ++from) {
      float* best = served + std::size_t{from} * r.sectors;
      if (drives.arriving[row + from] == same_sector) {
        for (std::uint32_t q = 0; q < r.sectors; ++q) best[q] = arrived[q] < best[q] ? arrived[q] : best[q];
        continue;
      }
      const float there = time_to[from] + arrived[drives.arriving[row + from]];
      const float* turn = &drives.turn[(row + from) * r.sectors];
      for (std::uint32_t q = 0; q < r.sectors; ++q) {
        const float time = there + turn[q];
        best[q] = time < best[q] ? time : best[q];
      }
    }
  }
}

}  // namespace

std::uint32_t sector_of(double heading, std::uint32_t sectors) {
  const double part = (heading + pi) / (2.0 * pi) * sectors;
  return std::min(static_cast<std::uint32_t>(std::max(part, 0.0)), sectors - 1);
}

RelaxedDrives sectored(const Instance& instance, std::uint32_t sectors) {
  RelaxedDrives drives;
  drives.sectors = sectors;
  drives.time_to.assign(instance.time_to.begin(), instance.time_to.end());
  if (sectors == 1) return drives;
  const std::size_t size = drives.time_to.size();
  drives.turn.assign(size * sectors, 0.0F);
  drives.arriving.assign(size, 0);
  for (std::uint32_t to = 0; to < instance.stops; ++to) {
    for (std::uint32_t from = 0; from < instance.stops; ++from) {
      const std::size_t arc = instance.arc(from, to);
      const std::size_t entry = instance.arc(to, from);
      if (instance.time[arc] == 0.0) {
        drives.arriving[entry] = same_sector;
        continue;
      }
      drives.arriving[entry] = static_cast<std::uint8_t>(sector_of(instance.arrive[arc], sectors));
      for (std::uint32_t q = 0; q < sectors; ++q) {
        drives.turn[entry * sectors + q] =
            static_cast<float>(least_turn(instance, q, sectors, instance.depart[arc]));
      }
    }
  }
  return drives;
}

Outcome<Relaxation> relax(const Instance& instance, std::vector<std::uint32_t> goals,
                          const RelaxedDrives& drives, BudgetMeter& meter) {
  Relaxation r;
  r.stops = instance.stops;
  r.sectors = drives.sectors;
  r.goals = std::move(goals);
  r.least_aim = least_aims(instance);
  r.covered.assign(r.stops, 0);
  for (std::uint32_t bit = 0; bit < r.goals.size(); ++bit) {
    for (const std::uint32_t n : instance.nodes_of[r.goals[bit]])
      r.covered[instance.nodes[n].stop] |= 1U << bit;
  }
  const std::uint32_t sets = 1U << r.goals.size();
  r.arrived.assign(r.index(sets, 0, 0), never);
  r.served.assign(r.arrived.size(), never);
  std::fill_n(r.served.begin(), std::size_t{r.stops} * r.sectors, 0.0F);
  for (std::uint32_t set = 1; set < sets; ++set) {
    if (!meter.spend()) return meter.refusal();
    serve(instance, r, set);
    drive(drives, r, set);
  }
  return r;
}

}  // namespace outrider::tour
