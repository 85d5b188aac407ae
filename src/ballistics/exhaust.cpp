#include <algorithm>
#include <cmath>

#include "in_air.hpp"
#include "outrider/ballistics/firing_region.hpp"
#include "outrider/ballistics/sight.hpp"
#include "outrider/ballistics/stance.hpp"

namespace outrider {
namespace {

/// Aim heights of one pitch whose flights are not decided yet: [first, last).
struct Open {
  std::size_t pitch;
  std::size_t first;
  std::size_t last;
};

class Exhaustion {
 public:
  Exhaustion(const ShotRules& rules, const FlightSpace& space, const Target& target)
      : rules_(rules),
        target_(target),
        all_(blockers(space, rules.gun.ball_radius_m + rules.margin_m)),
        stopped_last_(all_.size(), 0),
        sight_(rules_, target) {
    for (const double pitch : pitch_lattice(rules)) level_.push_back(elevation(rules, pitch));
    lattice_ = level_;
    for (const double up : offsets(-0.5 * target.size.z, 0.5 * target.size.z, rules.aim_step_m)) {
      aim_z_.push_back(target.centre().z + up);
    }
    result.blocked_by.assign(space.solids().size(), 0);
  }

  [[nodiscard]] const std::vector<Blocker>& blockers_of_space() const { return all_; }

  /// Tries a place; false at the first hit.
  bool try_place(std::size_t cell, Vec2 position, const std::vector<const Blocker*>& near) {
    if (!clear_of(rules_, target_, position)) return true;
    ++visits_;
    near_ = near;  // blockers that stopped flights from earlier places come first
    std::stable_sort(near_.begin(), near_.end(), [this](const Blocker* a, const Blocker* b) {
      return stopped_last_[index(a)] > stopped_last_[index(b)];
    });
    const Stance stance = stance_at(rules_, position);
    rules_.floor_z_m = stance.ground_z_m;
    bool in_range = false;
    for (const Vec2 aim : aim_points(target_, position, rules_.aim_step_m)) {
      if (stance.level() ? try_level(cell, position, aim, in_range)
                         : try_leaning(cell, stance, position, aim, in_range)) {
        break;
      }
    }
    result.places += in_range ? 1 : 0;
    return !result.found.has_value();
  }

  Exhausted result;

 private:
  [[nodiscard]] std::size_t index(const Blocker* blocker) const {
    return static_cast<std::size_t>(blocker - all_.data());
  }

  void open(std::size_t pitch) {
    if (const std::size_t count = sight_.passes(lattice_[pitch], aim_z_)) open_.push_back({pitch, 0, count});
  }

  /// Tries all pitches on level ground, where all flights lie in one plane; returns true at the first hit.
  bool try_level(std::size_t cell, Vec2 position, Vec2 aim, bool& in_range) {
    sight_.look(position, aim, near_);
    lattice_ = level_;
    open_.clear();
    for (std::size_t i = 0; i < lattice_.size(); ++i) open(i);
    in_range = in_range || !open_.empty();
    decide_together();
    return decide_one_by_one(cell);
  }

  /// Tries all pitches on a slope, where each pitch has a plane of its own; returns true at the first hit.
  bool try_leaning(std::size_t cell, const Stance& stance, Vec2 position, Vec2 aim, bool& in_range) {
    for (std::size_t i = 0; i < level_.size(); ++i) {
      const auto line = line_of_fire(rules_, stance, position, aim, level_[i].pitch_rad);
      if (!line) continue;
      sight_.look(line->from, aim, near_);
      lattice_[i] = line->at;
      open_.clear();
      open(i);
      in_range = in_range || !open_.empty();
      decide_together();
      if (decide_one_by_one(cell)) return true;
    }
    return false;
  }

  void count(const Blocker& blocker, std::size_t flights) {
    result.flights += flights;
    result.blocked_by[blocker.solid] += flights;
    stopped_last_[index(&blocker)] = visits_;
  }

  /// Decides, window by window, the flights that enter a forbidden rectangle.
  void decide_together() {
    for (std::size_t w = 0; !open_.empty(); ++w) {
      Window* const window = sight_.window(w);
      if (window == nullptr) return;
      std::size_t stopped = 0;
      std::erase_if(open_, [&](Open& open) {
        const std::size_t before = open.last - open.first;
        sight_.trim(*window, lattice_[open.pitch], aim_z_, open.first, open.last);
        stopped += before - (open.last - open.first);
        return open.first == open.last;
      });
      if (stopped > 0) count(*window->blocker, stopped);
    }
  }

  /// Decides the remaining flights, from the lowest aim and the flattest pitch on; returns true at the first
  /// hit.
  bool decide_one_by_one(std::size_t cell) {
    for (std::size_t z = 0; !open_.empty() && z < aim_z_.size(); ++z) {
      for (const Open& open : open_) {
        if (z < open.first || z >= open.last) continue;
        const auto arc = sight_.arc(lattice_[open.pitch], aim_z_[z]);
        if (const Window* stop = sight_.stopped_by(*arc)) {
          count(*stop->blocker, 1);
          continue;
        }
        ++result.flights;
        result.found = cell;
        result.shot = sight_.shot(*arc);
        return true;
      }
    }
    return false;
  }

  ShotRules rules_;  ///< with the height of the ground at the present place
  const Target& target_;
  std::vector<Blocker> all_;
  std::vector<std::uint64_t> stopped_last_;  ///< by blocker: the last place from which it stopped a flight
  std::vector<Elevation> level_;             ///< by pitch, on level ground
  std::vector<Elevation> lattice_;           ///< at the present place
  std::vector<double> aim_z_;                ///< heights of the aim points, world, ascending
  Sight sight_;
  std::uint64_t visits_ = 0;
  std::vector<const Blocker*> near_;
  std::vector<Open> open_;
};

}  // namespace

Exhausted exhaust(const ShotRules& rules, const FlightSpace& space, const Target& target,
                  const GridFrame& frame, const std::vector<std::uint8_t>& standable,
                  const std::stop_token& stop) {
  if (!rules.air.none()) return exhaust_in_air(rules, space, target, frame, standable, stop);
  Exhaustion exhaustion(rules, space, target);
  sweep(exhaustion.blockers_of_space(), xy(target.base), longest_range(rules, target),
        0.5 * std::hypot(target.size.x, target.size.y) + largest_lean_m(rules), frame, standable,
        [&](std::size_t cell, const std::vector<const Blocker*>& near) {
          return !stop.stop_requested() && exhaustion.try_place(cell, frame.centre(frame.cell(cell)), near);
        });
  return std::move(exhaustion.result);
}

}  // namespace outrider
