#include "outrider/ballistics/firing_region.hpp"

#include <cmath>
#include <limits>

#include "outrider/ballistics/sight.hpp"

namespace outrider {
namespace {

constexpr double good_spread = 0.7;

/// What each pitch of the lattice needs again and again.
struct PitchTable {
  std::vector<double> pitch, tangent, cosine;
  std::vector<Vec2> tip;

  explicit PitchTable(const ShotRules& rules) : pitch(pitch_lattice(rules)) {
    for (const double p : pitch) {
      tangent.push_back(std::tan(p));
      cosine.push_back(std::cos(p));
      tip.push_back(muzzle(rules.gun, p));
    }
  }
  [[nodiscard]] std::optional<Arc> arc(const Sight& sight, std::size_t i, double aim_z) const {
    return sight.arc(pitch[i], tip[i], tangent[i], cosine[i], aim_z);
  }
};

struct Choice {
  std::uint8_t pitch = FiringRegion::no_shot;
  float spread = std::numeric_limits<float>::infinity();
  bool in_range = false;
  const Blocker* blocker = nullptr;  ///< of the flattest arc
};

Choice choose(const Sight& sight, const PitchTable& table, double aim_z) {
  Choice choice;
  for (std::size_t i = 0; i < table.pitch.size(); ++i) {
    const auto arc = table.arc(sight, i, aim_z);
    if (!arc) continue;
    const Blocker* blocker = sight.stopped_by(*arc);
    if (!choice.in_range) choice.blocker = blocker;
    choice.in_range = true;
    if (blocker != nullptr) continue;
    const Shot shot{heading_of(sight.along), arc->shot.pitch_rad, arc->shot.speed_mps};
    const auto s = static_cast<float>(spread(*sight.rules, *sight.target, sight.position, shot));
    if (s < choice.spread) {
      choice.spread = s;
      choice.pitch = static_cast<std::uint8_t>(i);
    }
    if (choice.spread <= good_spread) break;
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
                           const GridFrame& frame, const std::vector<std::uint8_t>& standable) {
  const PitchTable table(rules);
  const auto all = blockers(space, rules.gun.ball_radius_m + rules.margin_m);
  const Vec3 centre = target.centre();
  FiringRegion region;
  region.pitch.assign(frame.size(), FiringRegion::no_shot);
  region.spread.assign(frame.size(), std::numeric_limits<float>::infinity());
  region.blocked_by.assign(space.solids().size(), 0);
  for (const std::uint8_t cell : standable) region.places += cell;

  Sight sight;
  sweep(all, xy(centre), longest_range(rules, target), 0.0, frame, standable,
        [&](std::size_t cell, const std::vector<const Blocker*>& near) {
          const Vec2 position = frame.centre(frame.cell(cell));
          if (!clear_of(rules, target, position)) return true;
          look(sight, rules, target, position, xy(centre), near);
          const Choice choice = choose(sight, table, centre.z);
          region.pitch[cell] = choice.pitch;
          region.spread[cell] = choice.spread;
          region.in_range += choice.in_range ? 1 : 0;
          region.hits += choice.pitch != FiringRegion::no_shot ? 1 : 0;
          if (choice.blocker != nullptr) ++region.blocked_by[choice.blocker->solid];
          return true;
        });
  return region;
}

Exhausted exhaust(const ShotRules& rules, const FlightSpace& space, const Target& target,
                  const GridFrame& frame, const std::vector<std::uint8_t>& standable) {
  const PitchTable table(rules);
  const auto all = blockers(space, rules.gun.ball_radius_m + rules.margin_m);
  const Vec3 centre = target.centre();
  const double half_diagonal = 0.5 * std::hypot(target.size.x, target.size.y);
  const auto heights = offsets(-0.5 * target.size.z, 0.5 * target.size.z, rules.aim_step_m);
  Exhausted result;
  result.blocked_by.assign(space.solids().size(), 0);

  Sight sight;
  const auto try_aim = [&](std::size_t cell, Vec2 aim, double aim_z) {
    bool in_range = false;
    for (std::size_t i = 0; i < table.pitch.size() && !result.found; ++i) {
      const auto arc = table.arc(sight, i, aim_z);
      if (!arc) continue;
      in_range = true;
      ++result.flights;
      if (const Blocker* blocker = sight.stopped_by(*arc)) {
        ++result.blocked_by[blocker->solid];
      } else {
        result.found = cell;
        result.shot = {heading_of(aim - sight.position), arc->shot.pitch_rad, arc->shot.speed_mps};
      }
    }
    return in_range;
  };
  sweep(all, xy(centre), longest_range(rules, target), half_diagonal, frame, standable,
        [&](std::size_t cell, const std::vector<const Blocker*>& near) {
          const Vec2 position = frame.centre(frame.cell(cell));
          if (!clear_of(rules, target, position)) return true;
          bool in_range = false;
          for (const Vec2 aim : aim_points(target, position, rules.aim_step_m)) {
            look(sight, rules, target, position, aim, near);
            for (const double up : heights) {
              in_range = try_aim(cell, aim, centre.z + up) || in_range;
            }
          }
          result.places += in_range ? 1 : 0;
          return !result.found.has_value();
        });
  return result;
}

}  // namespace outrider
