#include "outrider/ballistics/blocked_flight.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "outrider/ballistics/aim.hpp"
#include "outrider/ballistics/firing_region.hpp"
#include "outrider/ballistics/sight.hpp"

namespace outrider {
namespace {

constexpr double coarse_places = 500.0;
constexpr double most_clearance_m = 1.0;

class Search {
 public:
  Search(const ShotRules& rules, const FlightSpace& space, const Target& target)
      : rules_(rules),
        space_(space),
        target_(target),
        box_(solid_of(target)),
        reach_m_(longest_range(rules, target)),
        pitches_(pitch_lattice(rules)) {}

  [[nodiscard]] bool in_reach(Vec2 place) const {
    return distance(place, xy(target_.base)) <= reach_m_ && clear_of(rules_, target_, place);
  }

  void try_place(Vec2 place) {
    for (const double pitch : pitches_) {
      const auto aimed = aim_through(rules_, {place, {}}, pitch, target_.centre());
      if (aimed) try_shot(place, aimed->shot);
    }
  }

  std::optional<BlockedFlight> best;

 private:
  void try_shot(Vec2 place, const Shot& shot) {
    const double ball_m = rules_.gun.ball_radius_m;
    const Flight flight = launch(rules_, {place, {}}, target_, shot);
    const Impact impact = fly(flight, ball_m, space_, target_, rules_.floor_z_m);
    if (!impact.hit && !impact.solid) return;
    BlockedFlight found{place, shot, impact, 0.0, impact.solid.value_or(0), impact.position, 0.0};
    if (impact.hit) {
      const Clearance near = space_.clearance(flight, ball_m, impact.time_s, most_clearance_m);
      found.solid = near.solid;
      found.at = flight.position(near.time_s);
      found.clearance_m = near.distance_m;
    } else {
      found.short_m = std::max(0.0, distance(impact.position, box_) - ball_m);
    }
    const auto key = [](const BlockedFlight& one) { return std::tuple(one.short_m, -one.clearance_m); };
    if (!best || key(found) < key(*best)) best = found;
  }

  const ShotRules& rules_;
  const FlightSpace& space_;
  const Target& target_;
  Solid box_;
  double reach_m_;
  std::vector<double> pitches_;
};

}  // namespace

std::optional<BlockedFlight> best_blocked_flight(const ShotRules& rules, const FlightSpace& space,
                                                 const Target& target, const GridFrame& frame,
                                                 const std::vector<std::uint8_t>& standable,
                                                 const std::stop_token& stop) {
  Search search(rules, space, target);
  std::size_t places = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    places += standable[i] != 0 && search.in_reach(frame.centre(frame.cell(i))) ? 1 : 0;
  const auto try_cell = [&](Cell cell) {
    if (stop.stop_requested() || !frame.contains(cell) || standable[frame.index(cell)] == 0) return;
    if (search.in_reach(frame.centre(cell))) search.try_place(frame.centre(cell));
  };
  int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(places) / coarse_places))));
  for (int y = 0; y < frame.height; y += step) {
    for (int x = 0; x < frame.width; x += step) try_cell({x, y});
  }
  while (step > 1 && search.best) {
    step = (step + 1) / 2;
    const Cell middle = frame.cell_at(search.best->position);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) try_cell({middle.x + dx * step, middle.y + dy * step});
    }
  }
  if (stop.stop_requested()) return std::nullopt;
  return search.best;
}

}  // namespace outrider
