// NavigatedPursuer: a robot on two wheels that its navigator takes from cell to cell, around what no map has.
//
// The cells that are walls to the robot are walls, and so is the edge of the map. In each second the robot is
// driven towards the middle of the cell to which it is sent, or on to the next one if it need not stop. The
// mission plans from the cell that it has reached: a robot that is slow, or goes around something, is not
// where it was sent, and a quick one may be a cell ahead. A cell counts as closed while something stands in
// it that the map does not have, and for 30 s if the robot cannot get into it for 3 s, or if it lies behind
// two walls that meet at a corner.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/log/log.hpp"
#include "outrider/pursuit/problem.hpp"
#include "outrider/robot/robot.hpp"
#include "outrider/sim/bodies/navigated_body.hpp"
#include "outrider/sim/navigation.hpp"

namespace outrider {

/// The robot and what it meets.
struct PursuerOptions {
  PursuerOptions();
  RobotModel robot;     ///< quick enough for a cell of 1 m in a second
  double cell_m = 1.0;  ///< side of a cell
  std::string things;   ///< on no map, as in add_things(), in m from the lowest corner of the map
  NavigationOptions navigation;
};

class NavigatedPursuer final : public Robot {
 public:
  /// Stands in the middle of the start cell. It knows the path of the target until `known_s` seconds after
  /// the present time. The problem must outlive it, and the sides of its cells are in m. Faults: those of
  /// add_things() and Navigator::make(); bad_input for things that leave it no room where it starts, and for
  /// a map of too many pieces.
  static Outcome<NavigatedPursuer> make(const PursuitProblem& problem, const PursuerOptions& options,
                                        int known_s, std::uint64_t seed);

  /// Logs the yard now, and the way, scans and live map of the robot from now on. It may not be moved then.
  void log_to(Log& log, std::stop_token stop);

  Observation sense() override;
  /// Carries out a StepToCell, which takes one second. Other commands are ignored and take no time.
  void act(const Command& command) override;

  [[nodiscard]] const NavigatedBody& body() const { return body_; }

 private:
  NavigatedPursuer(const PursuitProblem& problem, int known_s, NavigatedBody body, double radius_m);

  [[nodiscard]] Cell cell_of(Vec2 place) const;
  [[nodiscard]] Order order_to(const StepToCell& step) const;
  [[nodiscard]] bool is_between_walls(Cell from, Cell to) const;
  void close(Cell cell, int for_s);
  void note_closed(GridObservation& grid);

  const PursuitProblem* problem_;
  int known_s_;
  NavigatedBody body_;
  double radius_m_;
  int time_s_ = 0;
  std::size_t told_ = 0;  // cells of the target's path that it was told
  Cell here_;
  int in_vain_s_ = 0;                        // for which it has not got into the cells to which it was sent
  std::map<std::size_t, int> closed_until_;  // by index of a cell
  std::vector<Cell> newly_closed_;
};

}  // namespace outrider
