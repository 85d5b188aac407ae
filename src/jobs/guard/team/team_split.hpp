// Splits targets among the robots of a team by estimates of how long each part takes.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/plan/stop_table.hpp"

namespace outrider {

/// The targets of each robot.
using TargetSplit = std::vector<std::vector<std::size_t>>;

/// A start of a robot as a stop of a tour problem.
struct SplitStart {
  std::size_t stop = 0;
  double heading_rad = 0.0;
};

/// Finds splits with a small estimated makespan. The estimate of a part is a short tour over precomputed
/// stops times a factor of its robot. The arguments must outlive it.
class SplitSearch {
 public:
  SplitSearch(const StopTable& stops, std::vector<SplitStart> starts, const Budget& budget)
      : stops_(stops), starts_(std::move(starts)), factors_(starts_.size(), 1.0), budget_(budget) {}

  /// Returns the estimate of a part, without the factor, s; infinite if it was cancelled.
  double estimate_s(std::size_t robot, const std::vector<std::size_t>& targets);
  void set_factor(std::size_t robot, double factor) { factors_[robot] = factor; }
  /// Returns the largest estimate of the robots, s.
  double makespan_s(const TargetSplit& split);
  /// Cuts the list into runs, one for each robot. Up to 13 places are tried as cuts. Some may be empty.
  TargetSplit cut(const std::vector<std::size_t>& order);
  /// Moves targets from the latest robot to others, or exchanges two, as long as the makespan falls.
  TargetSplit improve(TargetSplit split);
  /// Returns the targets by the shortest drive of the first robot to a stop that serves each.
  [[nodiscard]] std::vector<std::size_t> by_way(std::vector<std::size_t> targets) const;

 private:
  using Part = std::pair<std::size_t, std::vector<std::size_t>>;  // of a robot, ascending

  void estimate_all(std::vector<Part> parts);
  [[nodiscard]] double compute_s(const Part& part) const;
  double scaled_s(std::size_t robot, const std::vector<std::size_t>& targets) {
    return factors_[robot] * estimate_s(robot, targets);
  }
  /// All splits with one target of the latest robot moved, or exchanged for one of another robot.
  static std::vector<TargetSplit> neighbours(const TargetSplit& split, std::size_t latest);
  bool improve_once(TargetSplit& split);

  const StopTable& stops_;
  std::vector<SplitStart> starts_;
  std::vector<double> factors_;
  const Budget& budget_;
  std::map<Part, double> estimates_;
};

}  // namespace outrider
