// SimulatedTeam: robots on a grid that pursue a target and know its path for some seconds ahead.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/robot/robot.hpp"
#include "outrider/sim/faults/team_faults.hpp"

namespace outrider {

/// The number of times that each fault happened.
struct TeamFaultCounts {
  int missing = 0;  ///< sightings that did not come
  int late = 0;     ///< sightings that came late
  int wrong = 0;    ///< sightings that were wrong, as far as they came
  int stuck_s = 0;  ///< seconds in which a robot was sent on and did not move
  int blocked = 0;  ///< steps into closed cells that were not made
  bool kidnapped = false;
  int into_walls = 0;  ///< steps into walls of the map that were not made
};

class SimulatedTeam final : public Robot {
 public:
  /// `target` lists the cell of the target at second 0, 1, ... The robots know it until `known_s` seconds
  /// after the present time.
  SimulatedTeam(std::vector<Cell> robots, std::vector<Cell> target,
                int known_s = std::numeric_limits<int>::max());
  /// The robots suffer the faults, and feel whether they have caught the target. `free` says which cells of
  /// the map are no walls.
  SimulatedTeam(std::vector<Cell> robots, std::vector<Cell> target, int known_s, const TeamFaults& faults,
                std::function<bool(Cell)> free, const Rng& rng);

  Observation sense() override;
  /// Carries out a StepToCell, which takes one second. Other commands are ignored and take no time.
  void act(const Command& command) override;

  [[nodiscard]] const TeamFaultCounts& counts() const { return counts_; }

 private:
  struct Sighting {
    int second = 0;
    Cell cell;
    int due_s = 0;
  };
  void move(const StepToCell& step);
  void sight();
  void close_cells(std::size_t robot);
  [[nodiscard]] bool is_closed(Cell cell) const;
  void put_elsewhere(std::size_t robot);
  [[nodiscard]] GridObservation faulty_view();

  std::vector<Cell> robots_;
  std::vector<Cell> target_;
  int known_s_;
  int time_s_ = 0;
  std::size_t told_ = 0;  // cells of the target that were reported

  TeamFaults faults_;
  bool faulty_ = false;
  std::function<bool(Cell)> free_;
  Rng sighting_rng_{0};
  Rng place_rng_{0};
  std::vector<Sighting> coming_;  // in the order in which they are due
  std::optional<Cell> closed_;    // middle of the closed cells
  double closed_s_ = 0.0;         // when they closed
  std::size_t on_duty_ = 0;
  std::vector<Cell> found_closed_;  // the cell of the last step, if it could not be entered
  TeamFaultCounts counts_;
};

}  // namespace outrider
