#include "outrider/ballistics/firing_region.hpp"

#include <cmath>
#include <limits>

#include "in_air.hpp"
#include "outrider/ballistics/sight.hpp"
#include "outrider/ballistics/stance.hpp"

namespace outrider {
namespace {

std::vector<Elevation> elevations(const ShotRules& rules) {
  std::vector<Elevation> all;
  for (const double pitch : pitch_lattice(rules)) all.push_back(elevation(rules, pitch));
  return all;
}

struct Choice {
  std::uint8_t pitch = FiringRegion::no_shot;
  float error_ratio = std::numeric_limits<float>::infinity();
  bool in_range = false;
  const Blocker* blocker = nullptr;  ///< blocker of the flattest arc
};

/// A place of the robot, and the blockers that may be in the way.
struct Post {
  Stance stance;
  Vec2 position;
  const std::vector<const Blocker*>& near;
};

/// Sets the sight to the target's centre at one pitch of the gun; returns the elevation of the flights there.
std::optional<Elevation> look(const ShotRules& rules, Sight& sight, const Post& from, Vec2 aim,
                              double pitch) {
  const auto line = line_of_fire(rules, from.stance, from.position, aim, pitch);
  if (!line) return std::nullopt;
  sight.look(line->from, aim, from.near);
  return line->at;
}

Choice choose(const ShotRules& rules, Sight& sight, const std::vector<Elevation>& lattice, const Post& from,
              Vec3 aim) {
  Choice choice;
  Window* last = nullptr;  // the window that stopped one arc often stops the next
  if (from.stance.level()) sight.look(from.position, xy(aim), from.near);
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    std::optional<Elevation> leaning;
    if (!from.stance.level()) {
      leaning = look(rules, sight, from, xy(aim), lattice[i].pitch_rad);
      if (!leaning) continue;
      last = nullptr;
    }
    const auto arc = sight.arc(leaning ? *leaning : lattice[i], aim.z);
    if (!arc) continue;
    const auto error_ratio = [&] { return static_cast<float>(sight.error_ratio(*arc)); };
    if (choice.pitch != FiringRegion::no_shot && error_ratio() >= choice.error_ratio) continue;
    Window* stop = last != nullptr && sight.stops(*last, *arc) ? last : sight.stopped_by(*arc);
    if (!choice.in_range && stop != nullptr) choice.blocker = stop->blocker;
    choice.in_range = true;
    if (stop != nullptr) {
      last = stop;
      continue;
    }
    choice.error_ratio = error_ratio();
    choice.pitch = static_cast<std::uint8_t>(i);
    if (choice.error_ratio <= good_error_ratio) break;
  }
  return choice;
}

}  // namespace

std::vector<double> pitch_lattice(const ShotRules& rules) {
  const double span = rules.gun.pitch_high_rad - rules.gun.pitch_low_rad;
  const double most = FiringRegion::no_shot - 1;
  const int steps = static_cast<int>(std::clamp(std::ceil(span / rules.pitch_step_rad - 1e-9), 0.0, most));
  std::vector<double> pitches{rules.gun.pitch_low_rad};
  for (int i = 1; i <= steps; ++i) pitches.push_back(rules.gun.pitch_low_rad + span * i / steps);
  return pitches;
}

FiringRegion firing_region(const ShotRules& rules, const FlightSpace& space, const Target& target,
                           const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                           const std::stop_token& stop) {
  if (!rules.air.none()) return firing_region_in_air(rules, space, target, frame, standable, stop);
  const auto lattice = elevations(rules);
  const auto all = blockers(space, rules.gun.ball_radius_m + rules.margin_m);
  const Vec3 centre = target.centre();
  FiringRegion region;
  const double range = longest_range(rules, target);
  region.pitch = GridPart(frame, xy(centre), range, FiringRegion::no_shot);
  region.error_ratio = GridPart(frame, xy(centre), range, std::numeric_limits<float>::infinity());
  region.blocked_by.assign(space.solids().size(), 0);
  for (const std::uint8_t cell : standable) region.places += cell;

  ShotRules here = rules;  // with the height of the ground at each place
  Sight sight(here, target);
  sweep(all, xy(centre), range, largest_lean_m(rules), frame, standable,
        [&](std::size_t cell, const std::vector<const Blocker*>& near) {
          const Vec2 position = frame.centre(frame.cell(cell));
          if (stop.stop_requested()) return false;
          if (!clear_of(rules, target, position)) return true;
          const Stance stance = stance_at(rules, position);
          here.floor_z_m = stance.ground_z_m;
          const Choice choice = choose(here, sight, lattice, {stance, position, near}, centre);
          region.pitch.set(cell, choice.pitch);
          region.error_ratio.set(cell, choice.error_ratio);
          region.in_range += choice.in_range ? 1 : 0;
          region.hits += choice.pitch != FiringRegion::no_shot ? 1 : 0;
          if (choice.blocker != nullptr) ++region.blocked_by[choice.blocker->solid];
          return true;
        });
  return region;
}

}  // namespace outrider
